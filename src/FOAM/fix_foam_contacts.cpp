/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_foam_contacts.h"

#include "foam_half_list.h"
#include "foam_host.h"
#include "foam_input.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"

using namespace LAMMPS_NS;
using namespace FixConst;

/* ---------------------------------------------------------------------- */

FixFoamContacts::FixFoamContacts(LAMMPS *lmp, int narg, char **arg)
    : FixFoamRecords(lmp, narg, arg, Foam::AGE_VALUES), reduce(world)
{
  using Value = FoamInput::Value;
  FoamInput input(error, "Fix foam/contacts", narg - 3, arg + 3);
  input.keywords({{"trial", [&](const Value &v) {
                     tries = v.one_of({"no", "yes"});
                   }}});

  vector_flag = 1;
  size_vector = 5;
  extvector = 0;
  global_freq = 1;
  peratom_flag = 1;
  size_peratom_cols = Foam::SHOWN;
  peratom_freq = 1;

  restart_global = 1;
  keep_records();
}

int FixFoamContacts::setmask()
{
  return PRE_EXCHANGE | MIN_PRE_EXCHANGE;
}

void FixFoamContacts::init()
{
  pair = PairFoam::for_style(lmp, "Fix foam/contacts", kokkosable, execution_space);
  Fix *integrator = nullptr;
  for (auto &ifix : modify->get_fix_list())
    if (FoamHub::integrates(ifix)) integrator = ifix;
  if (!integrator)
    error->all(FLERR,
               "Fix foam/contacts needs a fix that integrates the foam, fix foam/rkc or foam/abm");
  if (integrator->igroup != igroup)
    error->all(FLERR,
               "Fix foam/contacts has group {} and fix {} group {}: the group says who is a "
               "bubble, and must be the same",
               group->names[igroup], integrator->style, group->names[integrator->igroup]);

  // each rank needs all contacts of its bubbles. With newton on, a half list has those across ranks on one
  // of them only: then a list of its own

  list_of_pair = kokkosable || !force->newton_pair;
  if (list_of_pair) return;
  if (utils::strmatch(force->pair_style, "^hybrid"))
    error->all(FLERR, "Fix foam/contacts with pair_style hybrid needs newton off");
  neighbor->add_request(this, NeighConst::REQ_SIZE | NeighConst::REQ_NEWTON_OFF);
}

void FixFoamContacts::init_list(int, NeighList *its_own)
{
  list = its_own;
}

/* ----------------------------------------------------------------------
   from state to state
------------------------------------------------------------------------- */

Foam::ContactTotals FixFoamContacts::try_out(double later)
{
  while (true) {
    history.use(atom->nmax);
    const Foam::ContactTotals found = follow(later);
    const int most = static_cast<int>(found.most);
    if (most <= history.slots()) return found;
    make_room(most);
  }
}

Foam::ContactTotals FixFoamContacts::follow(double later)
{
  if (list_of_pair) list = pair->list;
  const int nlocal = atom->nlocal;
  FoamHost space(lmp);
  const FoamHalfList<false> rows{list->ilist, list->numneigh, list->firstneigh, nlocal};
  return follow_in(space, rows, list->inum, MAX(1, nlocal), later);
}

// only if the reach of a contact is half a side of the box or more

bool FixFoamContacts::images_may_touch() const
{
  bool may = domain->triclinic;
  for (int k = 0; k < domain->dimension; k++)
    if (domain->periodicity[k] && domain->prd[k] <= 2.0 * neighbor->cutneighmax) may = true;
  return may;
}

void FixFoamContacts::take(const Foam::ContactTotals &found)
{
  history.commit();
  last = found;
  formed += found.formed;
  reduced = is_shown = false;
}

// what an evaluation on the way says is forgotten, unless it is the last before take()

void FixFoamContacts::attempted(double later)
{
  if (tries) try_out(later);
}

void FixFoamContacts::accepted(double step, bool output_due)
{
  take(try_out(step));
  if (output_due) show();
}

// Commands may have moved bubbles apart or together: no time has passed.

void FixFoamContacts::setup(int)
{
  if (started && ids_have_changed()) {
    if (comm->me == 0)
      error->warning(FLERR,
                     "Fix foam/contacts: the IDs of bubbles have changed, by which contacts are "
                     "known: their ages begin anew");
    for (int i = 0; i < atom->nlocal; i++) history.committed.clear(i);
    started = false;
  }
  take(try_out(0.0));
  if (!started) {
    formed = 0.0;
    at_first = of_all_ranks().present;
    started = true;
  }
  show();
}

bool FixFoamContacts::ids_have_changed()
{
  host_reads();
  const double *const known = history.committed[FoamHistory::Records::ID];
  int changed = 0, any;
  for (int i = 0; i < atom->nlocal; i++)
    if (known[i] != 0.0 && known[i] != static_cast<double>(atom->tag[i])) changed = 1;
  MPI_Allreduce(&changed, &any, 1, MPI_INT, MPI_MAX, world);
  return any;
}

void FixFoamContacts::post_run()
{
  pre_exchange();    // for commands that exchange bubbles
  if (!is_shown) show();
}

/* ----------------------------------------------------------------------
   output
------------------------------------------------------------------------- */

void FixFoamContacts::show()
{
  shown.use(atom->nmax);
  show_there();
  is_shown = true;
  for (int i = 0; i < atom->nlocal; i++)
    for (int k = 0; k < Foam::SHOWN; k++) array_atom[i][k] = shown[k][i];
}

void FixFoamContacts::show_there()
{
  FoamHost space(lmp);
  show_in(space);
}

void FixFoamContacts::look_at(int i)    // between two runs
{
  FoamHost space(lmp);
  Foam::ShowAges{history.records(space, history.committed), {}}.fill(i, array_atom[i]);
}

const Foam::ContactTotals &FixFoamContacts::of_all_ranks()
{
  if (!reduced) {
    Foam::ContactTotals mine = last;
    mine.formed.value = formed;
    last_of_all = reduce(mine);
    reduced = true;
  }
  return last_of_all;
}

double FixFoamContacts::compute_vector(int n)
{
  using namespace Foam;
  const Foam::ContactTotals &all = of_all_ranks();
  const double present = all.present;
  switch (n) {
    case 0:
      return present;
    case 1:
      return all.formed;
    case 2:
      return at_first + all.formed - present;
    case 3:
      return present > 0.0 ? all.ages / present : 0.0;
    default:
      return all.oldest;
  }
}

void FixFoamContacts::write_restart(FILE *fp)
{
  const double values[] = {double(started), at_first, of_all_ranks().formed};
  if (comm->me != 0) return;
  const int size = sizeof(values);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(values, size, 1, fp);
}

void FixFoamContacts::restart(char *buf)
{
  const auto *values = (const double *) buf;
  started = values[0] != 0.0;
  at_first = values[1];
  formed = comm->me == 0 ? values[2] : 0.0;
}
