/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "pair_bubble_collision.h"

#include "bubble_input.h"
#include "foam_host.h"
#include "foam_input.h"
#include "lammps_compat.h"

#include "comm.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "modify.h"

#include <algorithm>

using namespace LAMMPS_NS;

static const char FILMS[] = "BUBBLE_FILMS";

PairBubbleCollision::PairBubbleCollision(LAMMPS *lmp) : Pair(lmp)
{
  single_enable = 0;
  restartinfo = 1;
  writedata = 1;
  no_virial_fdotr_compute = 1;    // forces on ghosts are not known
  nextra = 4;
  pvector = new double[nextra];
  std::fill_n(pvector, nextra, 0.0);
}

PairBubbleCollision::~PairBubbleCollision()
{
  delete[] pvector;
  pvector = nullptr;
  if (allocated) {
    memory->destroy(setflag);
    memory->destroy(cutsq);
  }
  if (films && modify && modify->get_fix_by_id(FILMS)) modify->delete_fix(FILMS);
}

PairBubbleCollision *PairBubbleCollision::of(LAMMPS *lmp)
{
  return dynamic_cast<PairBubbleCollision *>(lmp->force->pair_match("bubble/collision", 0));
}

void PairBubbleCollision::check_place(const char *name, int its_kokkosable, int its_space) const
{
  if (its_kokkosable != kokkosable || (kokkosable && its_space != execution_space))
    error->all(FLERR,
               "{} and pair style bubble/collision must run in the same place: use the suffix kk "
               "for all styles of bubbles or for none",
               name);
}

/* ----------------------------------------------------------------------
   pair_style bubble/collision SIGMA MU keyword value ...
------------------------------------------------------------------------- */

void PairBubbleCollision::settings(int narg, char **arg)
{
  using Value = FoamInput::Value;
  FoamInput input(error, "Pair style bubble/collision", narg, arg);
  model = Bubble::Collision();
  exact = false;
  model.sigma = input.argument("SIGMA").number(FoamInput::ABOVE, 0.0);
  model.mu = input.argument("MU").number(FoamInput::AT_LEAST, 0.0);
  model.hmin = default_hmin(update);
  FoamInput::Keywords keywords = collision_keywords(model, exact);
  keywords.emplace_back("tangential", [&](const Value &v) {
    model.slides = v.one_of({"none", "all"}) == 1;
  });
  largest_to_come = 0.0;
  keywords.emplace_back("rmax",
                        [&](const Value &v) { largest_to_come = v.number(FoamInput::ABOVE, 0.0); });
  input.keywords(keywords);
  if (!(model.hmin > 0.0))
    error->all(FLERR,
               "Pair style bubble/collision: units {} have no meter, so that hmin, the least "
               "thickness of a film, must be given",
               update->unit_style);
}

// the liquid is the same everywhere

void PairBubbleCollision::coeff(int narg, char **arg)
{
  if (narg != 2)
    error->all(FLERR, "Pair style bubble/collision: pair_coeff has two types and no numbers: "
                      "pair_coeff * *");
  if (!allocated) allocate();
  int ilo, ihi, jlo, jhi;
  utils::bounds(FLERR, arg[0], 1, atom->ntypes, ilo, ihi, error);
  utils::bounds(FLERR, arg[1], 1, atom->ntypes, jlo, jhi, error);
  for (int i = ilo; i <= ihi; i++)
    for (int j = MAX(jlo, i); j <= jhi; j++) setflag[i][j] = 1;
}

void PairBubbleCollision::allocate()
{
  const int n = atom->ntypes + 1;
  memory->create(setflag, n, n, "pair:setflag");
  memory->create(cutsq, n, n, "pair:cutsq");
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) setflag[i][j] = 0;
  allocated = 1;
}

void PairBubbleCollision::init_style()
{
  if (!atom->radius_flag || !atom->rmass_flag)
    error->all(FLERR, "Pair style bubble/collision needs atom_style sphere");
  if (!atom->tag_enable)
    error->all(FLERR, "Pair style bubble/collision needs atom IDs: use atom_modify id yes");
  if (!comm->ghost_velocity)
    error->all(
        FLERR,
        "Pair style bubble/collision needs the velocities of ghost atoms: comm_modify vel yes");

  if (exact && table.empty()) table = Bubble::film_table();
  model.integral.first = exact ? table.data() : nullptr;
  request_list();
  listed_ncalls = -1;    // LAMMPS' counters are the same again in another run from the same step

  const bool remembers = model.stop == Bubble::Stop::CONTACT;
  films = dynamic_cast<FixBubbleFilms *>(modify->get_fix_by_id(FILMS));
  if (remembers && !films)
    films = dynamic_cast<FixBubbleFilms *>(
        modify->add_fix(fmt::format("{} all {}", FILMS, style_of_films())));
  if (!remembers) films = nullptr;

  host_reads();
  std::vector<double> mine(atom->ntypes + 1, 0.0);
  for (int i = 0; i < atom->nlocal; i++)
    mine[atom->type[i]] = std::max(mine[atom->type[i]], atom->radius[i]);
  largest.resize(mine.size());
  MPI_Allreduce(mine.data(), largest.data(), static_cast<int>(mine.size()), MPI_DOUBLE, MPI_MAX,
                world);
  for (double &radius : largest) radius = std::max(radius, largest_to_come);
}

// lists reach as far as the forces do: LAMMPS' lists by radius would end at contact

double PairBubbleCollision::init_one(int i, int j)
{
  if (setflag[i][j] == 0)
    error->all(FLERR,
               "Pair style bubble/collision: pair_coeff {} {} is missing: pair_coeff * * covers "
               "all types",
               i, j);
  const double Ri = largest[i], Rj = largest[j];
  if (!(Ri > 0.0 && Rj > 0.0)) return Ri + Rj;
  return Ri + Rj + model.range(Bubble::Gap::to_bubble(Ri, Rj));
}

void PairBubbleCollision::check_radii()
{
  host_reads();
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->radius[i] > largest[atom->type[i]] || !(atom->radius[i] > 0.0))
      error->one(FLERR,
                 "Pair style bubble/collision: bubble {} of type {} has radius {}: it must be > 0, "
                 "and no larger than the largest of its type at the start of the run, or rmax: {}",
                 atom->tag[i], atom->type[i], atom->radius[i], largest[atom->type[i]]);
}

/* ----------------------------------------------------------------------
   forces
------------------------------------------------------------------------- */

void PairBubbleCollision::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  if (neighbor->ago == 0) check_radii();
  if (eflag_atom) looks.use(atom->nmax);
  if (vflag_atom) stress.use(atom->nmax);
  if (list_is_new()) take_list();
  collide();
  if (evflag) take_totals();
}

bool PairBubbleCollision::list_is_new()
{
  if (listed_ncalls == neighbor->ncalls && listed_lastcall == neighbor->lastcall) return false;
  listed_ncalls = neighbor->ncalls;
  listed_lastcall = neighbor->lastcall;
  return true;
}

void PairBubbleCollision::request_list()
{
  neighbor->add_request(this, NeighConst::REQ_FULL);
}

void PairBubbleCollision::take_list()
{
  FoamHost space(lmp);
  near_list.take(list->inum, list->ilist, list->numneigh, list->firstneigh, atom->nlocal,
                 comes_near(space.bubbles()));
}

FoamHalfList<true> PairBubbleCollision::rows() const
{
  return {list->ilist, near_list.numneigh.data(), near_list.firstneigh.data(), atom->nlocal};
}

void PairBubbleCollision::collide()
{
  FoamHost space(lmp);
  collide_in(space, rows(), list->inum);
}

FoamColumns &PairBubbleCollision::look()
{
  looks.use(atom->nmax);
  fill_looks();
  return looks;
}

void PairBubbleCollision::fill_looks()
{
  FoamHost space(lmp);
  fill_looks_in(space, rows(), list->inum);
}

// energies and powers of this rank: compute pair adds those of all

void PairBubbleCollision::take_totals()
{
  const double powers[] = {totals.viscous, totals.lubrication, totals.sliding, totals.closed};
  std::copy_n(powers, nextra, pvector);
  const double sums[6] = {totals.xx, totals.yy, totals.zz, totals.xy, totals.xz, totals.yz};
  if (eflag_global) eng_vdwl += totals.energy;
  if (vflag_global)
    for (int k = 0; k < 6; k++) virial[k] += sums[k];
  for (int i = 0; i < atom->nlocal; i++) {
    if (eflag_atom) eatom[i] += looks[Bubble::ENERGY][i];
    if (vflag_atom)
      for (int k = 0; k < 6; k++) vatom[i][k] += stress[k][i];
  }
}

/* ----------------------------------------------------------------------
   restart and data files
------------------------------------------------------------------------- */

void PairBubbleCollision::write_restart(FILE *fp)
{
  write_restart_settings(fp);
}

void PairBubbleCollision::read_restart(FILE *fp)
{
  read_restart_settings(fp);
  allocate();
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) setflag[i][j] = 1;
}

void PairBubbleCollision::write_restart_settings(FILE *fp)
{
  Bubble::Collision settings = model;
  settings.integral.first = nullptr;
  const int with = exact;
  fwrite(&settings, sizeof(settings), 1, fp);
  fwrite(&with, sizeof(with), 1, fp);
  fwrite(&largest_to_come, sizeof(largest_to_come), 1, fp);
}

void PairBubbleCollision::read_restart_settings(FILE *fp)
{
  int with = 0;
  if (comm->me == 0) {
    utils::sfread(FLERR, &model, sizeof(model), 1, fp, nullptr, error);
    utils::sfread(FLERR, &with, sizeof(with), 1, fp, nullptr, error);
    utils::sfread(FLERR, &largest_to_come, sizeof(largest_to_come), 1, fp, nullptr, error);
  }
  MPI_Bcast(&model, sizeof(model), MPI_BYTE, 0, world);
  MPI_Bcast(&with, 1, MPI_INT, 0, world);
  MPI_Bcast(&largest_to_come, 1, MPI_DOUBLE, 0, world);
  exact = with;
}

void PairBubbleCollision::write_data(FILE *fp)
{
  for (int i = 1; i <= atom->ntypes; i++) utils::print(fp, "{}\n", i);
}

void PairBubbleCollision::write_data_all(FILE *fp)
{
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) utils::print(fp, "{} {}\n", i, j);
}

double PairBubbleCollision::memory_usage()
{
  return Pair::memory_usage() + bytes(all_columns) + near_list.bytes();
}
