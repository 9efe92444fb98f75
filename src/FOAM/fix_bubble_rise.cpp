/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_bubble_rise.h"

#include "foam_host.h"
#include "foam_input.h"
#include "foam_variable.h"

#include "comm.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;

/* ----------------------------------------------------------------------
   fix ID group-ID bubble/rise RHO_F MU gx gy gz keyword value ...
------------------------------------------------------------------------- */

FixBubbleRise::FixBubbleRise(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
  using Value = FoamInput::Value;
  FoamInput input(error, "Fix bubble/rise", narg - 3, arg + 3);
  liquid.rho = input.argument("RHO_F").number(FoamInput::ABOVE, 0.0);
  liquid.mu = input.argument("MU").number(FoamInput::ABOVE, 0.0);
  const char *const names[] = {"gx", "gy", "gz"};
  for (int k = 0; k < 3; k++) liquid.g[k] = input.argument(names[k]).number();
  auto component = [&](int k, const Value &v) {
    const std::string allowed = "v_NAME of an atom-style variable, 0 or NULL";
    const std::string word = v.word(allowed);
    if (word == "NULL" || word == "0") return;
    if (!utils::strmatch(word, "^v_.")) v.reject(allowed);
    flow[k] = word.substr(2);
    flows = true;
  };
  input.keywords({{"added",
                   [&](const Value &v) {
                     liquid.added = v.number(FoamInput::AT_LEAST, 0.0);
                   }},
                  {"drag",
                   [&](const Value &v) {
                     liquid.drag = Bubble::Drag(v.one_of({"none", "contaminated", "clean"}));
                   }},
                  {"implicit",
                   [&](const Value &v) {
                     implicit = v.one_of({"no", "yes"});
                   }},
                  {"flow", [&](const Value &v) {
                     component(0, v);
                     component(1, input.argument("v_uy of flow"));
                     component(2, input.argument("v_uz of flow"));
                   }}});

  vector_flag = 1;
  size_vector = ALL;
  extvector = 1;
  global_freq = 1;
  restart_global = 1;
}

FixBubbleRise *FixBubbleRise::of(LAMMPS *lmp)
{
  for (auto &fix : lmp->modify->get_fix_list())
    if (auto *rise = dynamic_cast<FixBubbleRise *>(fix)) return rise;
  return nullptr;
}

int FixBubbleRise::setmask()
{
  return POST_FORCE | PRE_REVERSE;    // the latter for set-up
}

void FixBubbleRise::init()
{
  if (!atom->radius_flag || !atom->rmass_flag)
    error->all(FLERR, "Fix bubble/rise needs atom_style sphere");
  int others = 0;
  for (auto &fix : modify->get_fix_list()) others += dynamic_cast<FixBubbleRise *>(fix) ? 1 : 0;
  if (others > 1) error->all(FLERR, "Fix bubble/rise: there can be one liquid, not {}", others);
  for (const std::string &name : flow)
    if (!name.empty()) check_atom_variable(lmp, "bubble/rise", name);
}

void FixBubbleRise::check_place(const char *style, int its_kokkosable, int its_space) const
{
  if (its_kokkosable != kokkosable || (kokkosable && its_space != execution_space))
    error->all(FLERR,
               "{} and fix bubble/rise must run in the same place: use the suffix kk for all "
               "styles of bubbles or for none",
               style);
}

/* ----------------------------------------------------------------------
   forces
------------------------------------------------------------------------- */

// before setup() of any fix: fix bubble/nve gives bubbles back their velocities there

void FixBubbleRise::setup_pre_reverse(int, int)
{
  push();
  before[0] = totals.buoyancy;
  before[1] = totals.drag;
}

void FixBubbleRise::post_force(int)
{
  push();
  const double power[] = {totals.buoyancy, totals.drag};
  for (int k = 0; k < 2; k++) {    // trapezoidal rule
    work[k] += 0.5 * update->dt * (before[k] + power[k]);
    before[k] = power[k];
  }
}

void FixBubbleRise::push()
{
  prepare();
  act();
  reduced = false;
}

void FixBubbleRise::take_flow()
{
  if (!flows) return;
  host_reads();
  modify->clearstep_compute();
  for (int k = 0; k < 3; k++)
    if (!flow[k].empty()) take_atom_variable(lmp, "bubble/rise", flow[k], igroup, columns[VX + k]);
  modify->addstep_compute(update->ntimestep + 1);
}

void FixBubbleRise::prepare()    // columns, before a loop
{
  if (flows || implicit) columns.use(atom->nmax);
  take_flow();
}

void FixBubbleRise::act()
{
  FoamHost space(lmp, groupbit);
  act_in(space);
}

FoamColumns &FixBubbleRise::look()
{
  prepare();
  looks.use(atom->nmax);
  fill_looks();
  return looks;
}

void FixBubbleRise::fill_looks()
{
  FoamHost space(lmp, groupbit);
  fill_looks_in(space);
}

/* ----------------------------------------------------------------------
   output: powers are those of the last evaluation, the kinetic energy is that of the present velocities
------------------------------------------------------------------------- */

void FixBubbleRise::reduce()
{
  if (reduced) return;
  const double mine[ALL] = {work[0], work[1], totals.buoyancy, totals.drag, kinetic()};
  MPI_Allreduce(mine, all, ALL, MPI_DOUBLE, MPI_SUM, world);
  reduced = true;
}

double FixBubbleRise::kinetic()
{
  FoamHost space(lmp, groupbit);
  return kinetic_in(space);
}

double FixBubbleRise::compute_vector(int n)
{
  reduce();
  return all[n];
}

void FixBubbleRise::write_restart(FILE *fp)
{
  double sums[2];
  MPI_Reduce(work, sums, 2, MPI_DOUBLE, MPI_SUM, 0, world);
  if (comm->me != 0) return;
  const int size = sizeof(sums);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(sums, size, 1, fp);
}

void FixBubbleRise::restart(char *buf)
{
  const auto *sums = (const double *) buf;
  for (int k = 0; k < 2; k++) work[k] = comm->me == 0 ? sums[k] : 0.0;
}

double FixBubbleRise::memory_usage()
{
  return bytes(all_columns);
}
