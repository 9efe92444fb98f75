/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

// PairDurianFoam: its commands, restart and data files

#include "pair_durian_foam.h"

#include "foam_input.h"
#include "foam_laws.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "memory.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

// numbers of a restart file
static constexpr int SETTINGS = 12 + Foam::LawChoice::MOST;

void PairDurianFoam::allocate()
{
  allocated = 1;
  const int n = atom->ntypes + 1;
  memory->create(setflag, n, n, "pair:setflag");
  for (int i = 1; i < n; i++)
    for (int j = i; j < n; j++) setflag[i][j] = 0;
  memory->create(cutsq, n, n, "pair:cutsq");
  memory->create(sigma0, n, n, "pair:sigma0");
  std::fill_n(sigma0[0], n * n, 0.0);
}

void PairDurianFoam::settings(int narg, char **arg)
{
  using Value = FoamInput::Value;
  FoamInput input(error, "Pair style durian/foam", narg, arg);
  mu0 = input.argument("mu0").number(FoamInput::ABOVE, 0.0);

  neighbor_drag = neighbor_solve = false;
  mu_c = 0.0;
  headroom = 1.2;
  law = {};
  input.keywords(
      {{"law",
        [&](const Value &v) {
          law.index = v.one_of(Foam::names_of_laws());
          Foam::with_law(law, [&](const auto &chosen) {
            auto number = law.parameters.begin();
            for (const auto &[name, limit, or_equal] : chosen.PARAMETERS)
              *number++ = input.argument(fmt::format("{} of law {}", name, chosen.NAME))
                              .number(or_equal ? FoamInput::AT_LEAST : FoamInput::ABOVE, limit);
          });
        }},
       {"drag",
        [&](const Value &v) {
          const int drag = v.one_of({"static", "neighbor", "contact"});
          neighbor_solve = drag == 1 && input.option("solve");
          neighbor_drag = drag == 1 && !neighbor_solve;
          mu_c = drag == 2 ? input.argument("MUC of drag contact").number(FoamInput::AT_LEAST, 0.0)
                 : neighbor_solve ? mu0
                                  : 0.0;
        }},
       {"rin",
        [&](const Value &v) {
          hub.record.rin = v.number(FoamInput::ABOVE, 0.0);
          hub.rin_fixed = true;
        }},
       {"headroom", [&](const Value &v) {
          headroom = v.number(FoamInput::AT_LEAST, 1.0);
        }}});
}

void PairDurianFoam::coeff(int narg, char **arg)
{
  if (narg > 3)
    error->all(FLERR, "Pair style durian/foam: pair_coeff needs two types and sigma0, not {} words",
               narg);
  if (!allocated) allocate();

  FoamInput input(error, "Pair style durian/foam", narg, arg);
  const auto [ilo, ihi] = input.argument("type I in pair_coeff").types(atom->ntypes);
  const auto [jlo, jhi] = input.argument("type J in pair_coeff").types(atom->ntypes);
  const double value = input.argument("sigma0 in pair_coeff").number(FoamInput::AT_LEAST, 0.0);

  int count = 0;
  for (int i = ilo; i <= ihi; i++)
    for (int j = MAX(jlo, i); j <= jhi; j++) {
      sigma0[i][j] = value;
      setflag[i][j] = 1;
      count++;
    }
  if (count == 0)
    error->all(FLERR, "Pair style durian/foam: pair_coeff {} {} names no pair of types I <= J",
               arg[0], arg[1]);
}

/* ---------------------------------------------------------------------- */

void PairDurianFoam::write_restart(FILE *fp)
{
  write_restart_settings(fp);
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) {
      fwrite(&setflag[i][j], sizeof(int), 1, fp);
      if (setflag[i][j]) fwrite(&sigma0[i][j], sizeof(double), 1, fp);
    }
}

void PairDurianFoam::read_restart(FILE *fp)
{
  read_restart_settings(fp);
  if (!allocated) allocate();
  const int me = comm->me;
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) {
      if (me == 0) utils::sfread(FLERR, &setflag[i][j], sizeof(int), 1, fp, nullptr, error);
      MPI_Bcast(&setflag[i][j], 1, MPI_INT, 0, world);
      if (setflag[i][j]) {
        if (me == 0) utils::sfread(FLERR, &sigma0[i][j], sizeof(double), 1, fp, nullptr, error);
        MPI_Bcast(&sigma0[i][j], 1, MPI_DOUBLE, 0, world);
      }
    }
}

void PairDurianFoam::write_restart_settings(FILE *fp)
{
  const FoamHub::Record &r = hub.record;
  double values[SETTINGS] = {mu0,
                             r.rin,
                             double(hub.rin_fixed),
                             r.ain,
                             double(hub.ain_fixed),
                             double(neighbor_drag    ? 1
                                    : neighbor_solve ? 2
                                                     : 0),
                             mu_c,
                             headroom,
                             r.tau,
                             r.removed_bubbles,
                             r.removed_gas,
                             double(law.index)};
  std::copy(law.parameters.begin(), law.parameters.end(),
            values + SETTINGS - law.parameters.size());
  fwrite(values, sizeof(double), SETTINGS, fp);
}

void PairDurianFoam::read_restart_settings(FILE *fp)
{
  double values[SETTINGS];
  if (comm->me == 0) utils::sfread(FLERR, values, sizeof(double), SETTINGS, fp, nullptr, error);
  MPI_Bcast(values, SETTINGS, MPI_DOUBLE, 0, world);
  FoamHub::Record &r = hub.record;
  mu0 = values[0];
  r.rin = values[1];
  hub.rin_fixed = values[2] != 0.0;
  r.ain = values[3];
  hub.ain_fixed = values[4] != 0.0;
  neighbor_drag = values[5] == 1.0;
  neighbor_solve = values[5] == 2.0;
  mu_c = values[6];
  headroom = values[7];
  r.tau = values[8];
  r.removed_bubbles = values[9];
  r.removed_gas = values[10];
  law.index = static_cast<int>(values[11]);
  std::copy_n(values + SETTINGS - law.parameters.size(), law.parameters.size(),
              law.parameters.begin());

  // LAMMPS reads what is there, be it a damaged file or that of another version of this style

  const bool sound = mu0 > 0.0 && mu_c >= 0.0 && r.rin >= 0.0 && r.ain >= 0.0 && headroom >= 1.0 &&
                     r.tau >= 0.0 && r.removed_bubbles >= 0.0 &&
                     (values[5] == 0.0 || values[5] == 1.0 || (neighbor_solve && mu_c > 0.0));
  if (!sound || !std::isfinite(mu0 + mu_c + r.rin + r.ain + headroom + r.tau + r.removed_bubbles +
                               r.removed_gas))
    error->all(FLERR,
               "Pair style durian/foam: the restart file has mu0 {} (must be > 0), mu_c {} (must "
               "be >= 0), "
               "mean radius {} and mean surface {} (must be >= 0), headroom {} (must be >= 1), tau "
               "{} and {} removed bubbles "
               "(must be >= 0): it is damaged, or of another version of this style",
               mu0, mu_c, r.rin, r.ain, headroom, r.tau, r.removed_bubbles);
  bool law_known = false;
  Foam::with_law(law, [&](const auto &chosen) {
    law_known = true;
    for (size_t n = 0; n < chosen.PARAMETERS.size(); n++)
      if (!chosen.PARAMETERS[n].allows(law.parameters[n]) || !std::isfinite(law.parameters[n]))
        law_known = false;
  });
  if (!law_known)
    error->all(FLERR,
               "Pair style durian/foam: the restart file has no law that this version knows: it is "
               "damaged, or of another version of this style");
  if (hub.rin_fixed && hub.ain_fixed) hub.tell_means("from the restart file");
}

void PairDurianFoam::write_data(FILE *fp)
{
  for (int i = 1; i <= atom->ntypes; i++) fprintf(fp, "%d %.17g\n", i, sigma0[i][i]);
}

void PairDurianFoam::write_data_all(FILE *fp)
{
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) fprintf(fp, "%d %d %.17g\n", i, j, sigma0[i][j]);
}
