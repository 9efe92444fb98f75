/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "pair_durian_foam.h"

#include "foam_input.h"
#include "foam_half_list.h"
#include "foam_host.h"
#include "foam_laws.h"

#include "atom.h"
#include "comm.h"
#include "compute.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "input.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include <cmath>
#include <algorithm>
#include <cstring>
#include <vector>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

PairDurianFoam::PairDurianFoam(LAMMPS *lmp) : Pair(lmp), sigma0(nullptr)
{
  single_enable = 1;
  restartinfo = 1;
  writedata = 1;
  finitecutflag = 1;
  no_virial_fdotr_compute = 1;    // a bubble may touch its own image: tally pair by pair
  comm_reverse = capacity(all_columns);

  mu0 = 1.0;
  rin = ain = 0.0;
  rin_fixed = ain_fixed = false;
  neighbor_drag = false;
  gas_wanted = 0;
  headroom = 1.2;
  cutoff_radius = 0.0;
  list_flags = NeighConst::REQ_SIZE;
  gathered = 0;
}

/* ---------------------------------------------------------------------- */

PairDurianFoam::~PairDurianFoam()
{
  if (copymode) return;

  if (allocated) {
    memory->destroy(setflag);
    memory->destroy(cutsq);
    memory->destroy(sigma0);
  }
}

/* ----------------------------------------------------------------------
   spring forces, and beside them, in the same pass, what drag and gas exchange need
------------------------------------------------------------------------- */

void PairDurianFoam::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  gather(Foam::FORCE | (neighbor_drag ? Foam::DRAG : 0u) | gas_wanted);
}

void PairDurianFoam::gather()
{
  ev_unset();
  if (domain->box_change) comm->forward_comm();    // at output the box may have moved once more
  gather(Foam::TO_LOOK_AT);
}

void PairDurianFoam::gather(unsigned what)
{
  for (FoamColumns *sums : chosen(all_columns, what)) sums->use(atom->nmax);
  gather_contacts(what);
}

// here over LAMMPS' half list, each pair once: ghosts collect their part, and send it home

void PairDurianFoam::gather_contacts(unsigned what)
{
  bool done = false;
  Foam::with_law(law, [&](const auto &chosen) {
    done = Foam::for_each_gathered(what, [&]<unsigned WHAT>() {
      Foam::with_dimension(domain->dimension, [&]<int D>() { gather_in<D, WHAT>(chosen); });
    });
  });
  if (!done) error->one(FLERR, "Pair style durian/foam: no loop gathers {}", what);

  gathered = what & ~Foam::FORCE;
  if (force->newton_pair && gathered) comm->reverse_comm(this);
}

struct PairDurianFoam::Tally {
  static constexpr bool ON = true;
  PairDurianFoam *style;
  int nlocal, newton;
  void pair(int i, int j, bool, double energy, double F_over_r, const double *del)
  {
    style->ev_tally(i, j, nlocal, newton, energy, 0.0, F_over_r, del[0], del[1], del[2]);
  }
};

template <int D, unsigned WHAT, class Law> void PairDurianFoam::gather_in(const Law &chosen)
{
  FoamHost here(lmp);
  const int nlocal = atom->nlocal, newton = force->newton_pair;
  const Foam::Coefficients coefficients{sigma0[0], atom->ntypes, rin};
  const Foam::ContactSums sums = contact_sums(here);
  const int nall = nlocal + (newton ? atom->nghost : 0);
  for (int i = 0; i < nall; i++) sums.clear<WHAT>(i);

  auto loop = [&]<bool NEWTON, class T>(T tally) {
    using List = FoamHalfList<NEWTON>;
    const List half{list->ilist, list->numneigh, list->firstneigh, nlocal};
    const Foam::ContactLoop<D, WHAT, false, Law, Foam::HostBubbles, List, T> body{
        here.bubbles(), half, chosen, coefficients, sums, true};
    for (int n = 0; n < list->inum; n++) body(n, tally);
  };
  if (evflag) {
    const Tally tally{this, nlocal, newton};
    newton ? loop.template operator()<true>(tally) : loop.template operator()<false>(tally);
  } else {
    const Foam::NoTally none;
    newton ? loop.template operator()<true>(none) : loop.template operator()<false>(none);
  }
}

/* ---------------------------------------------------------------------- */

int PairDurianFoam::pack_reverse_comm(int n, int first, double *buf)
{
  int m = 0;
  for (FoamColumns *sums : chosen(all_columns, gathered))
    for (int c = 0; c < sums->active(); c++, m += n) std::copy_n((*sums)[c] + first, n, buf + m);
  return m;
}

void PairDurianFoam::unpack_reverse_comm(int n, int *sendlist, double *buf)
{
  for (FoamColumns *sums : chosen(all_columns, gathered))
    for (int c = 0; c < sums->active(); c++) {
      double *const sum = (*sums)[c];
      for (int ii = 0; ii < n; ii++) sum[sendlist[ii]] += *buf++;
    }
}

/* ---------------------------------------------------------------------- */

void PairDurianFoam::init_style()
{
  if (!atom->radius_flag)
    error->all(FLERR, "Pair style durian/foam needs bubbles with radii: use atom_style sphere 1");
  if (!atom->tag_enable)
    error->all(FLERR, "Pair style durian/foam needs atom IDs: use atom_modify id yes");
  if (force->ftm2v != 1.0 || force->mvv2e != 1.0)
    error->all(
        FLERR,
        "Pair style durian/foam needs consistent units: use units lj, si, cgs, micro or nano");

  check_companions();

  // the drag asks for the neighbors' velocities; this is read by Comm::init() further on

  if (neighbor_drag) comm->ghost_velocity = 1;

  groupbit = Foam::GROUP_ALL;    // see FixFoamIntegrate::check_companions()
  for (auto &ifix : modify->get_fix_list())
    if (integrated_by(ifix) || utils::strmatch(ifix->style, "^foam/coarsen"))
      groupbit = ifix->groupbit;

  // <R_in> and <A_in> are those of the first run; commands that initialise before it
  // see preliminary ones.  The largest radius sets all cutoffs, with head-room to grow; that of a
  // particle that is no bubble, too.

  const double *const radius = atom->radius;
  double mine[3] = {0.0, 0.0, 0.0}, all[3], largest = 0.0;
  for (int i = 0; i < atom->nlocal; i++)
    if (radius[i] > 0.0) {
      largest = MAX(largest, radius[i]);
      if (!(atom->mask[i] & groupbit)) continue;
      mine[0] += 1.0;
      mine[1] += radius[i];
      mine[2] += Foam::with_dimension(domain->dimension,
                                      [&]<int D>() { return Foam::surface<D>(radius[i]); });
    }
  MPI_Allreduce(mine, all, 3, MPI_DOUBLE, MPI_SUM, world);
  if (!rin_fixed) rin = all[0] > 0.0 ? all[1] / all[0] : 0.0;
  if (!ain_fixed) ain = all[0] > 0.0 ? all[2] / all[0] : 0.0;
  MPI_Allreduce(&largest, &cutoff_radius, 1, MPI_DOUBLE, MPI_MAX, world);
  largest = cutoff_radius;

  // Coarsening ends when a bubble is as wide as the box: head-room beyond that would only mean more
  // ghosts.  Tiled communication reaches no further than the box, skin included.

  double side = INFINITY;
  for (int k = 0; k < domain->dimension; k++) side = MIN(side, domain->prd[k]);
  if (comm->style == Comm::TILED) side -= neighbor->skin;
  cutoff_radius = MAX(largest, MIN(headroom * largest, 0.5 * side));
  check_images(largest);

  if (domain->dimension == 2) fit_thickness();
  neighbor->add_request(this, list_flags);
}

bool PairDurianFoam::integrated_by(const Fix *fix)
{
  return fix->time_integrate && utils::strmatch(fix->style, "^foam/");
}

// LAMMPS commands that run beside a foam and give wrong numbers without a word of their own

void PairDurianFoam::check_companions()
{
  const bool rerun = input->command && strcmp(input->command, "rerun") == 0;
  if (rerun && !modify->get_fix_by_style("^foam/coarsen").empty())
    error->all(
        FLERR,
        "Pair style durian/foam: rerun reads no radii and keeps bubbles that have vanished, so "
        "that a foam with fix foam/coarsen would be another one: write restart or data files "
        "during the run and read these");
  if (comm->me != 0) return;
  if (rerun && !rerun_told) {
    rerun_told = true;
    error->warning(
        FLERR, "Pair style durian/foam: rerun takes places from the dump, but neither radii nor "
               "the number of bubbles: energies and contacts are right only for a foam that has "
               "not coarsened");
  }
  if (update->whichflag != 1 || inertia_told) return;
  for (auto &ifix : modify->get_fix_list())
    if (ifix->time_integrate && !integrated_by(ifix)) {
      inertia_told = true;
      error->warning(
          FLERR,
          "Pair style durian/foam: fix {} moves the bubbles by their inertia, without the "
          "drag mu0: massless bubbles are moved by fix foam/rkc or foam/abm",
          ifix->style);
    }
}

// LAMMPS keeps each image of a bubble that others can touch, and sorts bubbles into bins half a cutoff
// wide, which may be a hundred times as wide as the box.  Radii in the wrong units ask for more, and
// what fails then does not tell why.

void PairDurianFoam::check_images(double largest)
{
  if (!std::isfinite(largest)) return;    // the integrator tells which it is
  double images = double(atom->natoms), side = INFINITY;
  for (int k = 0; k < domain->dimension; k++) {
    if (domain->periodicity[k]) images *= 1.0 + 4.0 * largest / domain->prd[k];
    if (domain->periodicity[k] || neighbor->style) side = MIN(side, domain->prd[k]);
  }
  constexpr double WIDEST = 100.0;
  if (images > MAXSMALLINT || 2.0 * largest > WIDEST * side)
    error->all(
        FLERR,
        "Pair style durian/foam: the largest bubble, of radius {:.8}, is too large for a box "
        "whose shortest side is {:.8} ({:.3} images are within reach): radii must be in the "
        "units of the box, and below {:.8}{}",
        largest, side, images, 0.5 * WIDEST * side,
        domain->nonperiodic == 2 ? "; a box that shrinks around so few bubbles needs boundary m "
                                   "instead of s, or neighbor nsq"
                                 : "");

  // To count a pair of a bubble and its own image once, LAMMPS' lists in a tilted box compare their
  // places, and take those for equal that differ by less than this

  const double blurred = 0.01 * force->angstrom;
  if (domain->triclinic && force->newton_pair && 2.0 * largest >= side && side < blurred)
    error->all(
        FLERR,
        "Pair style durian/foam: contacts of bubbles with their own images in a triclinic box "
        "with sides below {} need newton off, or another unit of length",
        blurred);
}

// In 2D the box has a thickness that means nothing, except that LAMMPS refuses to sort bubbles into
// bins, half a cutoff wide, if these are a hundred times wider than thick, or 2^31 times thinner.

void PairDurianFoam::fit_thickness()
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
                   "Pair style durian/foam: the 2D box was {:.8} thick, which is no thickness for "
                   "neighbor bins of bubbles of this size; it is {:.8} thick now\n",
                   thick, domain->zprd);
}

double PairDurianFoam::init_one(int i, int j)
{
  if (setflag[i][j] == 0) sigma0[i][j] = mix_energy(sigma0[i][i], sigma0[j][j], 1.0, 1.0);
  sigma0[j][i] = sigma0[i][j];
  return 2.0 * cutoff_radius;
}

// a new pair style in the middle of a simulation takes over what is not given anew

void PairDurianFoam::go_on_from(const Record &before)
{
  if (ain_fixed) return;    // it is not new
  if (!rin_fixed) rin = before.rin;
  ain = before.ain;
  rin_fixed = ain_fixed = true;
  tau = before.tau;
  removed_bubbles = before.removed_bubbles;
  removed_gas = before.removed_gas;
  tell_means("as before");
}

void PairDurianFoam::tell_means(const char *whence) const
{
  if (comm->me == 0)
    utils::logmesg(lmp, "Pair style durian/foam: <R_in> = {:.8}, <A_in> = {:.8}, {}\n", rin, ain,
                   whence);
}

void PairDurianFoam::setup()
{
  if (!(rin > 0.0))
    error->all(FLERR,
               "Pair style durian/foam: the mean radius <R_in> is {}, so there is no bubble "
               "with a radius > 0: create bubbles, set their diameters or give keyword rin",
               rin);
  if (rin_fixed && ain_fixed) return;
  tell_means(rin_fixed ? "the former as given" : "means of the present bubbles");

  // IDs are not used twice: gaps are left by bubbles that have vanished

  tagint mine = 0, largest;
  for (int i = 0; i < atom->nlocal; i++) mine = MAX(mine, atom->tag[i]);
  MPI_Allreduce(&mine, &largest, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  if (!rin_fixed && largest > atom->natoms && comm->me == 0)
    error->warning(
        FLERR,
        "Pair style durian/foam: the IDs of {} bubbles go up to {}, as in a foam that has "
        "coarsened already: then give its first mean radius by keyword rin, else use "
        "reset_atoms id",
        atom->natoms, largest);
  rin_fixed = ain_fixed = true;
}

/* ----------------------------------------------------------------------
   Bubbles grow by an order of magnitude in a run, but LAMMPS sets cutoffs, the reach of
   ghosts and bins at its start.  To be called just before an exchange, whatever has lists
   asks for them again.  Other fixes are left alone: a second init() may restart them.
------------------------------------------------------------------------- */

void PairDurianFoam::refresh()
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

double PairDurianFoam::stiffest() const
{
  double most = 0.0;
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) most = MAX(most, sigma0[i][j]);
  return most;
}

/* ---------------------------------------------------------------------- */

double PairDurianFoam::single(int i, int j, int itype, int jtype, double rsq, double, double,
                              double &fforce)
{
  fforce = 0.0;
  const double Ri = atom->radius[i], Rj = atom->radius[j], Rsum = Ri + Rj;
  if (!(rsq < Rsum * Rsum) || !(Ri > 0.0) || !(Rj > 0.0)) return 0.0;
  const double r = std::sqrt(rsq), stiffness = sigma0[itype][jtype] * rin;
  double energy = 0.0;
  Foam::with_law(law, [&](const auto &chosen) {
    if (r > 0.0) fforce = chosen.force(stiffness, Rsum - r, Rsum) / r;
    energy = chosen.energy(stiffness, Rsum - r, Rsum);
  });
  return energy;
}

void *PairDurianFoam::extract(const char *name, int &dim)
{
  dim = 2;
  if (strcmp(name, "sigma0") == 0) return sigma0;
  dim = 0;
  if (strcmp(name, "mu0") == 0) return &mu0;
  if (strcmp(name, "rin") == 0) return &rin;
  return nullptr;
}

double PairDurianFoam::memory_usage()
{
  return Pair::memory_usage() + bytes(all_columns);
}
