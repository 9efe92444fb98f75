/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "pair_foam.h"

#include "atom.h"
#include "comm.h"
#include "compute.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "input.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

PairFoam::PairFoam(LAMMPS *lmp, const char *name) : Pair(lmp), hub(lmp, name), name(name)
{
  restartinfo = 1;
  writedata = 1;
  finitecutflag = 1;
  no_virial_fdotr_compute = 1;    // a bubble may touch its own image: tally pair by pair
  comm_forward = 3;               // given velocities
  comm_reverse = capacity(all_columns);
  list_flags = NeighConst::REQ_SIZE;
}

PairFoam *PairFoam::of(LAMMPS *lmp)
{
  return dynamic_cast<PairFoam *>(lmp->force->pair_match("foam", 0));
}

PairFoam *PairFoam::for_style(LAMMPS *lmp, const char *name, int kokkosable, int execution_space)
{
  PairFoam *const pair = of(lmp);
  Error *const error = lmp->error;
  if (!pair) error->all(FLERR, "{} needs one pair_style durian/foam", name);
  if (pair->kokkosable != kokkosable || (kokkosable && pair->execution_space != execution_space))
    error->all(FLERR,
               "{} and pair style durian/foam must run in the same place: use the suffix kk for "
               "all styles of the foam or for none",
               name);
  return pair;
}

/* ----------------------------------------------------------------------
   one pass over the contacts
------------------------------------------------------------------------- */

void PairFoam::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  gather(gathered_with_forces());
}

unsigned PairFoam::gathered_with_forces() const
{
  return Foam::FORCE | (neighbor_drag ? Foam::DRAG : 0u) | hub.gas_wanted;
}

void PairFoam::gather_diagnostics()
{
  ev_unset();
  if (domain->box_change) comm->forward_comm();    // at output the box may have moved once more
  gather(Foam::DIAGNOSTICS);
}

// a product with the matrix of drag between bubbles in contact: foam_contact_drag.h

void PairFoam::sum_given()
{
  ev_unset();
  gather(Foam::DRAG | Foam::GIVEN);
}

void PairFoam::send_given()
{
  comm->forward_comm(this);
}

int PairFoam::pack_forward_comm(int n, int *sent, double *buf, int, int *)
{
  int m = 0;
  for (int c = 0; c < 3; c++)
    for (int ii = 0; ii < n; ii++) buf[m++] = given[c][sent[ii]];
  return m;
}

void PairFoam::unpack_forward_comm(int n, int first, double *buf)
{
  for (int c = 0; c < 3; c++, buf += n) std::copy_n(buf, n, given[c] + first);
}

void PairFoam::make_room(unsigned what)
{
  for (FoamColumns *sums : chosen(all_columns, what)) sums->use(atom->nmax);
}

int PairFoam::pack_reverse_comm(int n, int first, double *buf)
{
  int m = 0;
  for (FoamColumns *sums : chosen(all_columns, gathered))
    for (int c = 0; c < sums->active(); c++, m += n) std::copy_n((*sums)[c] + first, n, buf + m);
  return m;
}

void PairFoam::unpack_reverse_comm(int n, int *sendlist, double *buf)
{
  for (FoamColumns *sums : chosen(all_columns, gathered))
    for (int c = 0; c < sums->active(); c++) {
      double *const sum = (*sums)[c];
      for (int ii = 0; ii < n; ii++) sum[sendlist[ii]] += *buf++;
    }
}

/* ----------------------------------------------------------------------
   before a run
------------------------------------------------------------------------- */

void PairFoam::init_style()
{
  if (!atom->radius_flag)
    error->all(FLERR, "Pair style {} needs bubbles with radii: use atom_style sphere 1", name);
  if (!atom->tag_enable)
    error->all(FLERR, "Pair style {} needs atom IDs: use atom_modify id yes", name);
  if (force->ftm2v != 1.0 || force->mvv2e != 1.0)
    error->all(FLERR, "Pair style {} needs consistent units: use units lj, si, cgs, micro or nano",
               name);
  check_companions();

  // the drag asks for the neighbors' velocities; this is read by Comm::init() further on

  if (neighbor_drag) comm->ghost_velocity = 1;

  hub.find_group();

  // <R_in> and <A_in> are those of the first run; commands that initialise before it
  // see preliminary ones.  The largest radius sets all cutoffs, with head-room to grow; that of a
  // particle that is no bubble, too.

  hub.take_means();
  double mine = 0.0, largest;
  for (int i = 0; i < atom->nlocal; i++)
    mine = MAX(mine, atom->radius[i] > 0.0 ? atom->radius[i] : 0.0);
  MPI_Allreduce(&mine, &largest, 1, MPI_DOUBLE, MPI_MAX, world);

  // Coarsening ends when a bubble is as wide as the box: head-room beyond that would only mean more
  // ghosts.  Tiled communication reaches no further than the box, skin included.

  double side = INFINITY;
  for (int k = 0; k < domain->dimension; k++) side = MIN(side, domain->prd[k]);
  if (comm->style == Comm::TILED) side -= neighbor->skin;
  cutoff_radius = MAX(largest, MIN(headroom * largest, 0.5 * side));
  check_images(largest);

  if (domain->dimension == 2) fit_thickness();

  // LAMMPS' lists of pairs by size hold those closer than R_i + R_j and the skin: for forces that reach further, those
  // by the cutoff of the types do

  neighbor->add_request(this, range() > 1.0 ? list_flags & ~NeighConst::REQ_SIZE : list_flags);
}

// LAMMPS commands that run beside a foam and give wrong numbers without a word of their own

void PairFoam::check_companions()
{
  const bool rerun = input->command && strcmp(input->command, "rerun") == 0;
  if (rerun && !modify->get_fix_by_style("^foam/coarsen").empty())
    error->all(
        FLERR,
        "Pair style {}: rerun reads no radii and keeps bubbles that have vanished, so "
        "that a foam with fix foam/coarsen would be another one: write restart or data files "
        "during the run and read these",
        name);
  if (comm->me != 0) return;
  if (rerun && !rerun_told) {
    rerun_told = true;
    error->warning(
        FLERR,
        "Pair style {}: rerun takes places from the dump, but neither radii nor "
        "the number of bubbles: energies and contacts are right only for a foam that has "
        "not coarsened",
        name);
  }
  if (update->whichflag != 1 || inertia_told) return;
  for (auto &ifix : modify->get_fix_list())
    if (ifix->time_integrate && !FoamHub::integrates(ifix)) {
      inertia_told = true;
      error->warning(FLERR,
                     "Pair style {}: fix {} moves the bubbles by their inertia, without the "
                     "drag mu0: massless bubbles are moved by fix foam/rkc or foam/abm",
                     name, ifix->style);
    }
}

// LAMMPS keeps each image of a bubble that others can touch, and sorts bubbles into bins half a cutoff
// wide, which may be a hundred times as wide as the box.  Radii in the wrong units ask for more, and
// what fails then does not tell why.

void PairFoam::check_images(double largest)
{
  if (!std::isfinite(largest)) return;    // the integrator tells which it is
  double images = double(atom->natoms), side = INFINITY;
  for (int k = 0; k < domain->dimension; k++) {
    if (domain->periodicity[k]) images *= 1.0 + 4.0 * largest / domain->prd[k];
    if (domain->periodicity[k] || neighbor->style) side = MIN(side, domain->prd[k]);
  }
  constexpr double WIDEST = 100.0;
  if (images > MAXSMALLINT || 2.0 * largest > WIDEST * side)
    error->all(FLERR,
               "Pair style {}: the largest bubble, of radius {:.8}, is too large for a box "
               "whose shortest side is {:.8} ({:.3} images are within reach): radii must be in the "
               "units of the box, and below {:.8}{}",
               name, largest, side, images, 0.5 * WIDEST * side,
               domain->nonperiodic == 2
                   ? "; a box that shrinks around so few bubbles needs boundary m "
                     "instead of s, or neighbor nsq"
                   : "");

  // To count a pair of a bubble and its own image once, lists that LAMMPS makes compare their places in a tilted box, and
  // take those for equal that differ by less than this

  const double blurred = 0.01 * force->angstrom;
  const bool compares = force->newton_pair &&
                        !(list_flags & (NeighConst::REQ_NEWTON_OFF | NeighConst::REQ_OCCASIONAL));
  if (compares && domain->triclinic && 2.0 * largest >= side && side < blurred)
    error->all(FLERR,
               "Pair style {}: contacts of bubbles with their own images in a triclinic box "
               "with sides below {} need newton off, or another unit of length",
               name, blurred);
}

// In 2D the box has a thickness that means nothing, except that LAMMPS refuses to sort bubbles into
// bins, half a cutoff wide, if these are a hundred times wider than thick, or 2^31 times thinner.

void PairFoam::fit_thickness()
{
  const double bin = 0.5 * (2.0 * cutoff_radius + neighbor->skin), thick = domain->zprd;
  if (thick >= 0.02 * bin && thick <= 1.0e8 * bin) return;    // with a factor to spare
  const double factor = std::exp2(std::round(std::log2(2.0 * bin / thick)));    // rounds no z
  domain->boxlo[2] *= factor;
  domain->boxhi[2] *= factor;
  domain->set_global_box();
  if (domain->triclinic) domain->set_lamda_box();
  domain->set_local_box();
  if (comm->me == 0)
    utils::logmesg(lmp,
                   "Pair style {}: the 2D box was {:.8} thick, which is no thickness for "
                   "neighbor bins of bubbles of this size; it is {:.8} thick now\n",
                   name, thick, domain->zprd);
}

void PairFoam::setup()
{
  hub.fix_means();
}

/* ----------------------------------------------------------------------
   Bubbles grow by an order of magnitude in a run, but LAMMPS sets cutoffs, the reach of
   ghosts and bins at its start.  To be called just before an exchange, whatever has lists
   asks for them again.  Other fixes are left alone: a second init() may restart them.
------------------------------------------------------------------------- */

void PairFoam::refresh()
{
  const int manybody = force->pair->manybody_flag;
  force->pair->manybody_flag = 1;    // no message on mixed coefficients in mid-run
  force->pair->init();
  force->pair->manybody_flag = manybody;
  for (auto &ifix : modify->get_fix_list())
    if (neighbor->find_list(ifix)) ifix->init();
  for (auto &icompute : modify->get_compute_list())
    if (neighbor->find_list(icompute)) icompute->init();
  const bigint ncalls = neighbor->ncalls, ndanger = neighbor->ndanger;
  neighbor->init();
  neighbor->ncalls = ncalls;    // the counts go on
  neighbor->ndanger = ndanger;
  comm->setup();
  if (neighbor->style) neighbor->setup_bins();
}

double PairFoam::memory_usage()
{
  return Pair::memory_usage() + bytes(all_columns);
}
