/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_PAIR_FOAM_H
#define LMP_PAIR_FOAM_H

#include "foam_columns.h"
#include "foam_contacts.h"
#include "foam_hub.h"
#include "pair.h"

namespace LAMMPS_NS {

// What every pair style of a foam is to the fixes and computes: the sums over contacts, the drag, cutoffs that follow
// the bubbles, and the hub.  A style, such as PairDurianFoam, adds its commands and its loop.

class PairFoam : public Pair {
 public:
  PairFoam(class LAMMPS *, const char *name);
  static PairFoam *of(class LAMMPS *);    // the one in use, or none

  // the one in use, for a style of this name that must run where it does; else an error

  static PairFoam *for_style(class LAMMPS *, const char *name, int kokkosable, int execution_space);

  void compute(int, int) override;
  void init_style() override;
  void setup() override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;
  double memory_usage() override;

  FoamHub hub;

  void gather_diagnostics();    // Foam::DIAGNOSTICS of this state, for computes
  void make_room(unsigned what);
  virtual void send_given();    // what owned bubbles have in `given`, to ghosts
  void sum_given();             // numbers of contacts, and sums of `given` over them
  void refresh();               // cutoffs, ghosts and bins for bubbles that have grown
  bool outgrown(double R) const { return R > cutoff_radius; }    // have bubbles of this radius?
  virtual double stiffest() const = 0;                           // largest spring constant
  virtual double range() const { return 1.0; }    // forces act at r < range (R_i + R_j)

  // contact law, foam_laws.h, and its coefficients where the style runs: of walls, too

  Foam::LawChoice law;
  virtual Foam::Coefficients coefficients() const = 0;

  // drag, see foam_drag.h

  double mu0 = 1.0;               // coefficient
  bool neighbor_drag = false;     // relative to neighbors' mean velocity, of evaluations before
  bool neighbor_solve = false;    // the same of this evaluation; mu_c = mu0
  double mu_c = 0.0;    // coefficient between bubbles in contact; 0: nothing is to be solved

  // where LAMMPS' communication does not do it: radii of ghosts, or, on a single rank, all of ghosts

  enum class Ghosts { RADII, EVERYTHING };
  virtual bool sends_radii() const { return false; }       // in compute()
  virtual bool refresh_ghosts(Ghosts) { return false; }    // true: done
  virtual void take_list() {}    // LAMMPS has built it, and ghosts are where their owners are

  // sums over the contacts of each bubble, as gathered last; ghosts' parts are added in

  FoamColumnList all_columns;    // their kind: the flag that asks for them
  enum { ESPRING, EDURIAN, NENERGIES };
  FoamColumns contacts{all_columns, "contacts", 1, Foam::CONTACTS};
  FoamColumns vsum{all_columns, "sums of velocities", 3, Foam::VSUM};
  FoamColumns area{all_columns, "contact areas", 1, Foam::AREA};
  FoamColumns film{all_columns, "film exchange", 1, Foam::FILM};
  FoamColumns given{all_columns, "given velocities", 3, Foam::GIVEN};    // not a sum
  FoamColumns energies{all_columns, "energies", NENERGIES, Foam::ENERGY};

  template <class Space> Foam::ContactSums contact_sums(Space &space)
  {
    return {space.column(contacts, 0),
            {space.column(vsum, 0), space.column(vsum, 1), space.column(vsum, 2)},
            {space.column(given, 0), space.column(given, 1), space.column(given, 2)},
            space.column(area, 0),
            space.column(film, 0),
            space.column(energies, ESPRING),
            space.column(energies, EDURIAN),
            space.members(hub.groupbit)};
  }

 protected:
  const char *const name;
  double headroom = 1.2;         // cutoffs hold for radii up to headroom * present largest
  double cutoff_radius = 0.0;    // the largest radius the present cutoffs are good for
  int list_flags;                // of the request for a neighbor list
  unsigned gathered = 0;         // what is sent in reverse communication

  unsigned gathered_with_forces() const;
  virtual void gather(unsigned what) = 0;    // makes room, and runs the loop over contacts

 private:
  bool rerun_told = false, inertia_told = false;
  void check_companions();
  void check_images(double largest);
  void fit_thickness();
};

}    // namespace LAMMPS_NS

#endif
