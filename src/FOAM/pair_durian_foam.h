/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef PAIR_CLASS
// clang-format off
PairStyle(durian/foam,PairDurianFoam);
// clang-format on
#else

#ifndef LMP_PAIR_DURIAN_FOAM_H
#define LMP_PAIR_DURIAN_FOAM_H

#include "foam_columns.h"
#include "foam_contacts.h"
#include "foam_gas.h"
#include "foam_law.h"
#include "pair.h"

namespace LAMMPS_NS {

class PairDurianFoam : public Pair {
 public:
  PairDurianFoam(class LAMMPS *);
  ~PairDurianFoam() override;

  void compute(int, int) override;
  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  double init_one(int, int) override;
  void setup() override;
  void write_restart(FILE *) override;
  void read_restart(FILE *) override;
  void write_restart_settings(FILE *) override;
  void read_restart_settings(FILE *) override;
  void write_data(FILE *) override;
  void write_data_all(FILE *) override;
  double single(int, int, int, int, double, double, double, double &) override;
  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;
  void *extract(const char *, int &) override;
  double memory_usage() override;

  void gather();     // Foam::TO_LOOK_AT of this state, for computes
  void refresh();    // cutoffs, ghosts and bins for bubbles that have grown
  bool outgrown(double R) const { return R > cutoff_radius; }    // have bubbles of this radius?
  double stiffest() const;                                       // largest sigma0

  // What belongs to the simulation as a whole, from its first run on, through later ones and restarts

  struct Record {
    double rin = 0.0, ain = 0.0;    // <R_in>, <A_in>: means at the start of the first run
    double tau = 0.0;               // integral of K dt / <R_in>^2
    double removed_bubbles = 0.0, removed_gas = 0.0;
  };
  Record record() const { return {rin, ain, tau, removed_bubbles, removed_gas}; }
  void go_on_from(const Record &);    // for a pair style that replaces another
  double tau = 0.0, removed_bubbles = 0.0, removed_gas = 0.0;    // counted by fix foam/coarsen

  static bool integrated_by(const class Fix *);    // does this fix move the bubbles of a foam?

  int groupbit = Foam::GROUP_ALL;    // of the bubbles: that of the fixes of the foam
  double mu0;                        // drag coefficient
  double rin, ain;                   // see Record
  bool neighbor_drag;     // drag relative to neighbors' mean velocity or to a liquid at rest
  unsigned gas_wanted;    // set by fix foam/coarsen: Foam::FILM, AREA to gather in each compute()

  // the sums over all bubbles that exchange through the liquid takes, where they come with compute()

  Foam::LiquidLaw liquid_law = Foam::LiquidLaw::AREA;    // set by fix foam/coarsen
  Foam::Sums<Foam::FreeSurface> free_surface;
  bool free_surface_known = false;

  bool radii_change = false;                            // set by the integrator
  virtual bool sends_radii() const { return false; }    // to ghosts, in compute(): else LAMMPS does

  // sums over the contacts of each bubble, as gathered last; ghosts' parts are added in

  FoamColumnList all_columns;    // their kind: the flag that asks for them
  enum { ESPRING, EDURIAN, NENERGIES };
  FoamColumns contacts{all_columns, "contacts", 1, Foam::CONTACTS};
  FoamColumns vsum{all_columns, "sums of velocities", 3, Foam::VSUM};
  FoamColumns area{all_columns, "contact areas", 1, Foam::AREA};
  FoamColumns film{all_columns, "film exchange", 1, Foam::FILM};
  FoamColumns energies{all_columns, "energies", NENERGIES, Foam::ENERGY};

  template <class Space> Foam::ContactSums contact_sums(Space &here)
  {
    return {here.column(contacts, 0),
            {here.column(vsum, 0), here.column(vsum, 1), here.column(vsum, 2)},
            here.column(area, 0),
            here.column(film, 0),
            here.column(energies, ESPRING),
            here.column(energies, EDURIAN),
            here.members(groupbit)};
  }

 protected:
  bool rin_fixed, ain_fixed;    // given, or a run has started
  double headroom;              // cutoffs hold for radii up to headroom * present largest
  double cutoff_radius;         // the largest radius the present cutoffs are good for
  double **sigma0;              // per pair of types
  Foam::LawChoice law;
  int list_flags;       // of the request for a neighbor list
  unsigned gathered;    // what is sent in reverse communication

  void allocate();
  void check_companions();
  void tell_means(const char *whence) const;
  bool rerun_told = false, inertia_told = false;
  void check_images(double largest);
  void fit_thickness();
  void gather(unsigned);
  virtual void gather_contacts(unsigned);    // the loop itself
  struct Tally;
  template <int D, unsigned WHAT, class Law> void gather_in(const Law &);
};

}    // namespace LAMMPS_NS

#endif
#endif
