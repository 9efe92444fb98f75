/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_liquid_flow.h"

#include "fix_liquid_flow_loops.h"
#include "foam_host.h"
#include "foam_input.h"
#include "foam_order.h"
#include "foam_timestep.h"
#include "foam_variable.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "modify.h"
#include "output.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace FixConst;

const std::vector<std::string> FixLiquidFlow::FACES{"xlo", "xhi", "ylo", "yhi", "zlo", "zhi"};

/* ----------------------------------------------------------------------
   fix ID group-ID liquid/flow RE FR keyword value ...
------------------------------------------------------------------------- */

FixLiquidFlow::FixLiquidFlow(LAMMPS *lmp, int narg, char **arg)
    : FixFoamTravelling(lmp, narg, arg), out(lmp)
{
  using Value = FoamInput::Value;
  FoamInput input(error, "Fix liquid/flow", narg - 3, arg + 3);
  set.Re = input.argument("RE").number(FoamInput::ABOVE, 0.0);
  const Value fr = input.argument("FR");
  if (!fr.is("none")) {
    const double Fr = fr.number(FoamInput::ABOVE, 0.0);
    set.gravity[2] = -1.0 / (Fr * Fr);
  }
  state.use(atom->nmax);
  auto from_variable = [&](const Value &v, int column) {
    const std::string name = v.word("v_name, an atom-style variable");
    if (name.compare(0, 2, "v_") != 0) v.reject("v_name, an atom-style variable");
    check_atom_variable(lmp, "liquid/flow", name.substr(2));
    given.emplace_back(column, name.substr(2));
  };
  input.keywords(
      {{"ma",
        [&](const Value &v) {
          set.Ma = v.number(FoamInput::AT_LEAST, 0.0);
        }},
       {"les",
        [&](const Value &v) {
          set.closure.kind =
              static_cast<Liquid::Closure::Kind>(v.one_of({"none", "smagorinsky", "mixed"}));
          if (set.closure.kind != Liquid::Closure::NONE)
            set.closure.constant =
                input
                    .argument(set.closure.kind == Liquid::Closure::MIXED ? "CM of les"
                                                                         : "CS of les")
                    .number(FoamInput::AT_LEAST, 0.0);
        }},
       {"wall",
        [&](const Value &v) {
          const int face = v.one_of(FACES);
          const int how =
              input.argument("kind of wall " + FACES[face]).one_of({"noslip", "slip", "symmetric"});
          walls.kind[face / 2][face % 2] = how == 0 ? Liquid::Walls::NOSLIP : Liquid::Walls::SLIP;
        }},
       {"solver",
        [&](const Value &v) {
          tolerance = v.between(0.0, 1.0);
          most_iterations = input.argument("MAXITER of solver").integer(1, 1000000);
        }},
       {"shift",
        [&](const Value &v) {
          const int how = v.one_of({"no", "yes", "published"});
          set.shifts = how != 0;
          set.slides = how == 1;
        }},
       {"momentum",
        [&](const Value &v) {
          set.published = v.one_of({"standard", "published"});
        }},
       {"gravity",
        [&](const Value &v) {
          set.balanced = v.one_of({"published", "balanced"});
        }},
       {"divergence",
        [&](const Value &v) {
          set.sticks = v.one_of({"slip", "published"});
        }},
       {"pressure",
        [&](const Value &v) {
          from_variable(v, PRESSURE);
        }},
       {"acceleration",
        [&](const Value &v) {
          from_variable(v, ACCELERATION);
          from_variable(input.argument("ay of acceleration"), ACCELERATION + 1);
          from_variable(input.argument("az of acceleration"), ACCELERATION + 2);
        }},
       {"courant",
        [&](const Value &v) {
          courant = v.between(0.0, 1.0);
        }},
       {"dtmax", [&](const Value &v) {
          longest = v.number(FoamInput::ABOVE, 0.0);
        }}});

  if (set.published) set.balanced = false;    // of its pressure, alpha p, nothing is known at rest
  time_integrate = 1;
  force_reneighbor = 1;
  next_reneighbor = -1;
  nevery = 1;
  vector_flag = 1;
  size_vector = 9;
  extvector = 0;
  global_freq = 1;
  restart_global = 1;
  maxexchange = STATE;
  comm_forward = 7;

  add_callbacks();
}

// once the columns are where they stay; what a restart file has comes later

void FixLiquidFlow::post_constructor()
{
  for (const auto &[column, name] : given)
    take_atom_variable(lmp, "liquid/flow", name, igroup, state[column]);
}

FixLiquidFlow *FixLiquidFlow::of(LAMMPS *lmp)
{
  for (auto &fix : lmp->modify->get_fix_list())
    if (auto *its = dynamic_cast<FixLiquidFlow *>(fix)) return its;
  return nullptr;
}

int FixLiquidFlow::setmask()
{
  return INITIAL_INTEGRATE | PRE_EXCHANGE | FINAL_INTEGRATE | END_OF_STEP |
         PRE_FORCE;    // the last for set-up
}

double FixLiquidFlow::froude() const
{
  const double *g = set.gravity, square = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
  return square > 0.0 ? 1.0 / std::sqrt(std::sqrt(square)) : 0.0;
}

/* ----------------------------------------------------------------------
   steps
------------------------------------------------------------------------- */

// A run from a restart file finds the atoms in another order than the run that wrote it, and on other ranks.  So the first step
// of a run, and the one after a restart file, put them in an order of their own: then both go on alike, bit by bit.

void FixLiquidFlow::pre_exchange()
{
  if (update->ntimestep != next_reneighbor) return;
  domain->pbc();
  comm->exchange();
  order();
  atom->nextsort = update->ntimestep;    // into bins from there
}

// The state as it is: all columns for output, and the first step of a run that has none

void FixLiquidFlow::setup_pre_force(int)
{
  work.use(atom->nmax);
  vectors.use(atom->nmax);
}

void FixLiquidFlow::setup(int)
{
  check_lists();
  next_reneighbor = update->ntimestep + 1;
  gather(0.0);
  look();
  const bool first = !(now.next_dt > 0.0);
  if (first) now.next_dt = longest_step(totals.nu);
  limit_step();
  if (first && given.empty() && compute_vector(6) > 0.0) find_pressure();
  for (int tries = 1; !solve(now.next_dt); tries++)
    now.limit = now.next_dt = shorter(now.next_dt, tries);
  foam_set_timestep(lmp, now.next_dt);
}

// A pressure of 0 at the start would be that of a liquid that expands as soon as gravity acts: it would fall.  So the first is
// that of a liquid a thousand times less compressible.  Without a surface nothing says how high it is.

void FixLiquidFlow::find_pressure()
{
  const double Ma = set.Ma;
  set.Ma *= 1.0e-3;
  if (!solve(now.next_dt)) stop(now.next_dt);    // a shorter step would not help
  set.Ma = Ma;
  keep_pressure();
}

void FixLiquidFlow::initial_integrate(int)
{
  out.begin_step();
  begin_run();
  advance(update->dt);
}

// What another run has left may be far too long by now.  A step that is a little too long goes on, as it does in one run: so runs
// from restart files, too, which know the forces of other fixes at places a little further on.

void FixLiquidFlow::limit_step()
{
  const double limit = longest_step(0.0);
  if (now.next_dt > 2.0 * limit) now.next_dt = limit;
  if (longest > 0.0) now.next_dt = std::min(now.next_dt, longest);
}

// Forces of other fixes are known since setup(); a run with "pre no" has none, and begins with the timestep of the user

void FixLiquidFlow::begin_run()
{
  if (update->ntimestep != update->firststep + 1) return;
  look();
  limit_step();
  if (update->dt > now.next_dt) foam_shorten_timestep(lmp, now.next_dt);
}

void FixLiquidFlow::final_integrate()
{
  work.use(atom->nmax);
  vectors.use(atom->nmax);
  const double listed = update->dt;
  gather(update->dt);
  for (int tries = 1; !solve(update->dt); tries++) {
    begin_again(shorter(update->dt, tries));
    check_way_back(listed - update->dt);
    gather(update->dt);
  }
  now.done_dt = update->dt;
  move(now.done_dt);
}

// The pressure: whether it was found.  Without a surface it has no level.  It is then kept without its mean, which would grow
// step by step; and an incompressible liquid is compressible by so little that velocities do not tell.

bool FixLiquidFlow::solve(double dt)
{
  constexpr double LEAST_MA = 1.0e-3;
  const double Ma = set.Ma;
  without_level = !(compute_vector(6) > 0.0);
  if (without_level) set.Ma = std::max(Ma, LEAST_MA);
  project(dt);
  set.Ma = Ma;
  return solved.end == Liquid::Solved::CONVERGED;
}

// A step in which it was not found is done again with half of its length: the matrix is then closer to a diagonal one.

double FixLiquidFlow::shorter(double dt, int tries) const
{
  constexpr int MOST = 8;
  if (tries > MOST) stop(dt);
  return 0.5 * dt;
}

void FixLiquidFlow::stop(double dt) const
{
  error->all(FLERR,
             "Fix liquid/flow: the pressure was not found at step {} with a timestep of {}: "
             "residual {} after {} iterations, wanted {} in at most {}",
             update->ntimestep, dt, solved.residual, solved.iterations, tolerance, most_iterations);
}

// From x* back to where a shorter step leads; what a wall has stopped stays there

void FixLiquidFlow::begin_again(double dt)
{
  const double back = dt - update->dt;
  if (gas) {
    gas->go_back();
    gas->advance(back);
  }
  advance(back);
  comm->forward_comm();
  foam_shorten_timestep(lmp, dt);
  now.limit = dt;
  now.repeated += 1.0;
}

void FixLiquidFlow::end_of_step()
{
  now.next_dt = choose_step();
  foam_set_timestep(lmp, now.next_dt);
  out.schedule_time_dumps(now.done_dt, now.next_dt);
  if (!(update->atime + now.next_dt > update->atime))
    error->all(FLERR, "Fix liquid/flow: the timestep at step {} is {}: time {} does not go on",
               update->ntimestep, now.next_dt, update->atime);
  if (update->ntimestep != output->next_restart) return;
  domain->pbc();    // as who reads the file does
  next_reneighbor = update->ntimestep + 1;
}

// After a step that was repeated they grow slowly

double FixLiquidFlow::choose_step()
{
  constexpr double GROWTH = 1.2;
  const double step = longest_step(totals.nu);
  if (!(now.limit > 0.0)) return step;
  now.limit = GROWTH * now.done_dt;
  if (now.limit < step) return now.limit;
  now.limit = 0.0;
  return step;
}

double FixLiquidFlow::longest_step(double nu)    // viscosity of this rank
{
  const double *g = set.gravity;
  const double falls =
      g[0] * g[0] + g[1] * g[1] + g[2] * g[2];    // also where there is no particle
  double mine[] = {speeds.speed, nu, totals.gas, gas ? gas->fastest() : 0.0,
                   std::max<double>(speeds.push, falls)};
  double all[5];
  MPI_Allreduce(mine, all, 5, MPI_DOUBLE, MPI_MAX, world);
  if (!told_of_gas && all[2] >= Liquid::MOST_GAS) {
    told_of_gas = true;
    if (comm->me == 0)
      error->warning(FLERR,
                     "Fix liquid/flow: particles are full of gas at step {}, c = {}: more is not "
                     "counted in the volume of the liquid",
                     update->ntimestep, Liquid::MOST_GAS);
  }
  const double step = Liquid::longest_step(courant, set.h0, std::sqrt(all[0]), std::sqrt(all[3]),
                                           set.Re, all[1], std::sqrt(all[4]));
  return longest > 0.0 ? std::min(step, longest) : step;
}

void FixLiquidFlow::post_run()
{
  foam_set_timestep(lmp, given_dt);
}

/* ----------------------------------------------------------------------
   loops
------------------------------------------------------------------------- */

void FixLiquidFlow::advance(double dt)
{
  FoamHost space(lmp, groupbit);
  advance_in(space, dt);
}

void FixLiquidFlow::order()
{
  foam_order_by_tag(lmp);
}

void FixLiquidFlow::look()
{
  FoamHost space(lmp, groupbit);
  look_in(space);
}

void FixLiquidFlow::keep_pressure()
{
  FoamHost space(lmp, groupbit);
  keep_pressure_in(space);
}

void FixLiquidFlow::gather(double dt)
{
  FoamHost space(lmp, groupbit);
  gather_in(space, *pair, room, dt);
}

void FixLiquidFlow::project(double dt)
{
  FoamHost space(lmp, groupbit);
  project_in(space, *pair, room, dt);
}

void FixLiquidFlow::move(double dt)
{
  FoamHost space(lmp, groupbit);
  move_in(space, dt);
}

Liquid::CloseRows<true> FixLiquidFlow::HostRoom::close(size_t rows, size_t width)
{
  if (partners.size() < rows * width) partners.resize(rows * width);
  if (sizes.size() < rows) sizes.resize(rows);
  return {partners.data(), sizes.data(), rows, width};
}

Liquid::Matrix<true> FixLiquidFlow::HostRoom::matrix(const Liquid::CloseRows<true> &close)
{
  if (entries.size() < close.rows * close.width) entries.resize(close.rows * close.width);
  if (used.size() < close.rows) used.resize(close.rows);
  return {close, entries.data(), used.data()};
}

double FixLiquidFlow::HostRoom::bytes() const
{
  return sizeof(double) * double(entries.capacity()) +
         sizeof(int) * double(partners.capacity() + sizes.capacity() + used.capacity());
}

double FixLiquidFlow::memory_usage()
{
  return FixFoamTravelling::memory_usage() + room.bytes();
}

/* ----------------------------------------------------------------------
   columns of ghosts
------------------------------------------------------------------------- */

void FixLiquidFlow::send(FoamColumns &columns, int first, int count)
{
  sent = &columns;
  sent_first = first;
  sent_count = count;
  comm->forward_comm(this, count);
}

int FixLiquidFlow::pack_forward_comm(int n, int *list, double *buf, int, int *)
{
  int m = 0;
  for (int k = 0; k < sent_count; k++) {
    const double *const column = (*sent)[sent_first + k];
    for (int i = 0; i < n; i++) buf[m++] = column[list[i]];
  }
  return m;
}

void FixLiquidFlow::unpack_forward_comm(int n, int first, double *buf)
{
  int m = 0;
  for (int k = 0; k < sent_count; k++) {
    double *const column = (*sent)[sent_first + k];
    for (int i = first; i < first + n; i++) column[i] = buf[m++];
  }
}

/* ----------------------------------------------------------------------
   output and restart
------------------------------------------------------------------------- */

double FixLiquidFlow::compute_vector(int n)
{
  const double mine[] = {speeds.kinetic, totals.dissipated, totals.surface, totals.volume_of_gas};
  if (n == 8) return now.repeated;
  if (n >= 4) {
    double all;
    MPI_Allreduce(&mine[n - 4], &all, 1, MPI_DOUBLE, MPI_SUM, world);
    return all;
  }
  if (n == 0) return update->atime;
  if (n == 1) return now.next_dt;
  if (n == 2) return solved.iterations;
  return solved.residual;
}

void FixLiquidFlow::write_restart(FILE *fp)
{
  if (comm->me != 0) return;
  const int size = sizeof(now);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(&now, size, 1, fp);
}

void FixLiquidFlow::restart(char *buf)
{
  now = *(const Progress *) buf;
}
