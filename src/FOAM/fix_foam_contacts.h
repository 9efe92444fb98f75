/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(foam/contacts,FixFoamContacts);
// clang-format on
#else

#ifndef LMP_FIX_FOAM_CONTACTS_H
#define LMP_FIX_FOAM_CONTACTS_H

#include "fix_foam_records.h"
#include "foam_ages.h"
#include "foam_reduce.h"
#include "pair_foam.h"

#include "atom.h"
#include "domain.h"

namespace LAMMPS_NS {

// How long each contact has lasted, from one accepted step to the next

class FixFoamContacts : public FixFoamRecords, public FoamFollower {
 public:
  FixFoamContacts(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void init_list(int, class NeighList *) override;
  void setup(int) override;
  void attempted(double) override;
  void accepted(double, bool) override;
  void post_run() override;
  double compute_vector(int) override;

  void write_restart(FILE *) override;
  void restart(char *) override;

 protected:
  PairFoam *pair = nullptr;
  FoamReduce<Foam::ContactTotals> reduce;

  FoamColumns shown{all_columns, "ages of contacts", Foam::SHOWN, FoamHistory::STAYS};

  // the contacts of this state, on trial: those committed are so much older

  virtual Foam::ContactTotals follow(double later);
  template <class Space, class List>
  Foam::ContactTotals follow_in(Space &space, const List &list, int nrows, int chunk, double later);
  bool images_may_touch() const;
  virtual void show_there();
  template <class Space> void show_in(Space &space);
  virtual void host_reads() {}

 private:
  class NeighList *list = nullptr;    // of its own, or that of the pair style
  bool list_of_pair = true;
  bool tries = false;       // in attempts, too
  bool is_shown = false;    // the present state

  bool started = false;                     // kept in restarts, with:
  double at_first = 0.0;                    // contacts when this fix began
  double formed = 0.0;                      // since then, by bubbles of this rank
  Foam::ContactTotals last, last_of_all;    // of the state that is committed
  bool reduced = false;    // the latter, with all that have formed in place of formed

  Foam::ContactTotals try_out(double later);
  void take(const Foam::ContactTotals &);
  void show();
  void look_at(int) override;
  bool ids_have_changed();
  const Foam::ContactTotals &of_all_ranks();
};

template <class Space, class List>
Foam::ContactTotals FixFoamContacts::follow_in(Space &space, const List &rows, int nrows, int chunk,
                                               double later)
{
  const int nlocal = atom->nlocal, nchunks = (nlocal + chunk - 1) / chunk;
  const Foam::FollowContacts<typename Space::Bubbles, List> functor{
      space.bubbles(),
      rows,
      space.members(groupbit),
      history.records(space, history.committed),
      history.records(space, history.trial),
      later,
      nrows,
      nlocal,
      chunk,
      domain->dimension == 2,
      images_may_touch()};
  return space.template totals<Foam::ContactTotals>(nchunks, functor);
}

template <class Space> void FixFoamContacts::show_in(Space &space)
{
  const Foam::ShowAges functor{history.records(space, history.committed),
                               {space.column(shown, Foam::SHOWN_COUNT),
                                space.column(shown, Foam::SHOWN_OLDEST),
                                space.column(shown, Foam::SHOWN_MEAN)}};
  space.for_each(atom->nlocal, functor);
}

}    // namespace LAMMPS_NS

#endif
#endif
