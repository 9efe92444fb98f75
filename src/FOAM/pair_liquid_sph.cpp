/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "pair_liquid_sph.h"

#include "foam_input.h"
#include "liquid_physics.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"

#include <algorithm>

using namespace LAMMPS_NS;

PairLiquidSPH::PairLiquidSPH(LAMMPS *lmp) : Pair(lmp)
{
  single_enable = 0;
  restartinfo = 1;
  writedata = 1;
  no_virial_fdotr_compute = 1;    // there is no force
}

PairLiquidSPH::~PairLiquidSPH()
{
  if (!allocated) return;
  memory->destroy(setflag);
  memory->destroy(cutsq);
}

PairLiquidSPH *PairLiquidSPH::of(LAMMPS *lmp)
{
  return dynamic_cast<PairLiquidSPH *>(lmp->force->pair_match("liquid/sph", 0));
}

void PairLiquidSPH::check_place(const char *name, int its_kokkosable, int its_space) const
{
  if (its_kokkosable != kokkosable || (kokkosable && its_space != execution_space))
    error->all(FLERR,
               "{} and pair style liquid/sph must run in the same place: use the suffix kk for all "
               "styles of a liquid and its bubbles or for none",
               name);
}

/* ----------------------------------------------------------------------
   pair_style liquid/sph DR keyword value ...
------------------------------------------------------------------------- */

void PairLiquidSPH::settings(int narg, char **arg)
{
  using Value = FoamInput::Value;
  FoamInput input(error, "Pair style liquid/sph", narg, arg);
  dr = input.argument("DR").number(FoamInput::ABOVE, 0.0);
  h_over_dr = 1.3;
  input.keywords({{"h", [&](const Value &v) {
                     h_over_dr = v.from_to(1.0, 3.0);
                   }}});
}

void PairLiquidSPH::coeff(int narg, char **arg)
{
  if (narg != 2)
    error->all(FLERR, "Pair style liquid/sph: pair_coeff has two types and no numbers: "
                      "pair_coeff * *");
  if (!allocated) allocate();
  int ilo, ihi, jlo, jhi;
  utils::bounds(FLERR, arg[0], 1, atom->ntypes, ilo, ihi, error);
  utils::bounds(FLERR, arg[1], 1, atom->ntypes, jlo, jhi, error);
  for (int i = ilo; i <= ihi; i++)
    for (int j = std::max(jlo, i); j <= jhi; j++) setflag[i][j] = 1;
}

void PairLiquidSPH::allocate()
{
  const int n = atom->ntypes + 1;
  memory->create(setflag, n, n, "pair:setflag");
  memory->create(cutsq, n, n, "pair:cutsq");
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) setflag[i][j] = 0;
  allocated = 1;
}

// with bubbles a particle that is full of gas sees further

double PairLiquidSPH::reach() const
{
  const bool gas = !modify->get_fix_by_style("^bubble/flow").empty();
  return Liquid::SUPPORT *
         Liquid::smoothing_length(h0(), Liquid::liquid_fraction(gas ? Liquid::MOST_GAS : 0.0));
}

void PairLiquidSPH::init_style()
{
  if (domain->dimension != 3)
    error->all(FLERR, "Pair style liquid/sph needs dimension 3, not {}", domain->dimension);
  if (domain->triclinic)
    error->all(FLERR, "Pair style liquid/sph needs an orthogonal box: this one is triclinic");
  if (!comm->ghost_velocity)
    error->all(FLERR,
               "Pair style liquid/sph needs the velocities of ghost atoms: comm_modify vel yes");
  find_wet_types();
  request_list();
}

void PairLiquidSPH::request_list()
{
  neighbor->add_request(this, NeighConst::REQ_FULL);
}

// Types of which there may be liquid: all but those of bubbles alone, which are there or will be born.  Bubbles are many, and
// see none of each other: their rows would be longer than all others.

void PairLiquidSPH::find_wet_types()
{
  const std::vector<Fix *> flows = modify->get_fix_by_style("^liquid/flow");
  const std::vector<Fix *> gases = modify->get_fix_by_style("^bubble/flow");
  const int bit = flows.empty() ? 1 : flows[0]->groupbit;
  const int its = gases.empty() ? 0 : gases[0]->groupbit;
  const int n = atom->ntypes + 1;
  std::vector<int> mine(2 * n, 0), all(2 * n);    // liquid, and bubbles
  for (int i = 0; i < atom->nlocal; i++) {
    if (atom->mask[i] & bit) mine[atom->type[i]] = 1;
    if (atom->mask[i] & its) mine[n + atom->type[i]] = 1;
  }
  for (Fix *fix : modify->get_fix_by_style("^bubble/")) {
    int dim;
    const auto *const born = static_cast<const int *>(fix->extract("type of bubbles", dim));
    if (born && *born < n) mine[n + *born] = 1;
  }
  MPI_Allreduce(mine.data(), all.data(), 2 * n, MPI_INT, MPI_MAX, world);
  wet.resize(n);
  for (int type = 0; type < n; type++) wet[type] = all[type] || !all[n + type];
  for (int i = 1; i < n; i++)
    for (int j = 1; j < n; j++)    // those of other styles are left to them
      if (all[i] && (all[j] || all[n + j]) && !setflag[std::min(i, j)][std::max(i, j)])
        error->all(
            FLERR,
            "Pair style liquid/sph: liquid of type {} does not see type {}: pair_coeff {} {} "
            "is missing",
            i, j, std::min(i, j), std::max(i, j));
}

double PairLiquidSPH::init_one(int i, int j)
{
  if (setflag[i][j] == 0)
    error->all(FLERR,
               "Pair style liquid/sph: pair_coeff {} {} is missing: pair_coeff * * covers all "
               "types",
               i, j);
  return wet[i] || wet[j] ? reach() : 0.0;
}

void PairLiquidSPH::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  if (neighbor->ago == 0) take_lists();
}

void PairLiquidSPH::take_lists()
{
  if (all_liquid()) return;
  const int *const mask = atom->mask;
  const int of[KINDS] = {liquidbit, liquidbit, gasbit},
            with[KINDS] = {liquidbit, gasbit, liquidbit};
  for (int kind = 0; kind < KINDS; kind++) {
    const int mine = of[kind], its = with[kind];
    Rows &rows = lists[kind];
    rows.of.clear();
    for (int n = 0; n < list->inum; n++)
      if (mask[list->ilist[n]] & mine) rows.of.push_back(list->ilist[n]);
    rows.near.take(static_cast<int>(rows.of.size()), rows.of.data(), list->numneigh,
                   list->firstneigh, atom->nlocal,
                   [=](int, int j) { return (mask[j] & its) != 0; });
  }
}

int PairLiquidSPH::nrows(Kind kind) const
{
  return all_liquid() ? list->inum : static_cast<int>(lists[kind].of.size());
}

FoamHalfList<true> PairLiquidSPH::rows(Kind kind) const
{
  if (all_liquid()) return {list->ilist, list->numneigh, list->firstneigh, atom->nlocal};
  const FoamShortList &near = lists[kind].near;
  return {lists[kind].of.data(), near.numneigh.data(), near.firstneigh.data(), atom->nlocal};
}

/* ----------------------------------------------------------------------
   restart and data files
------------------------------------------------------------------------- */

void PairLiquidSPH::write_restart(FILE *fp)
{
  write_restart_settings(fp);
}

void PairLiquidSPH::read_restart(FILE *fp)
{
  read_restart_settings(fp);
  allocate();
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) setflag[i][j] = 1;
}

void PairLiquidSPH::write_restart_settings(FILE *fp)
{
  const double values[] = {dr, h_over_dr};
  fwrite(values, sizeof(values), 1, fp);
}

void PairLiquidSPH::read_restart_settings(FILE *fp)
{
  double values[2];
  if (comm->me == 0) utils::sfread(FLERR, values, sizeof(values), 1, fp, nullptr, error);
  MPI_Bcast(values, 2, MPI_DOUBLE, 0, world);
  dr = values[0];
  h_over_dr = values[1];
  if (!(dr > 0.0 && h_over_dr >= 1.0 && h_over_dr <= 3.0))
    error->all(FLERR,
               "Pair style liquid/sph: the restart file has spacing {} (must be > 0) and h {} "
               "(must be from 1 to 3): it is damaged, or of another version of this style",
               dr, h_over_dr);
}

void PairLiquidSPH::write_data(FILE *fp)
{
  for (int i = 1; i <= atom->ntypes; i++) utils::print(fp, "{}\n", i);
}

void PairLiquidSPH::write_data_all(FILE *fp)
{
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) utils::print(fp, "{} {}\n", i, j);
}
