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

  // what one pass over the neighbor list gathers beside each other
  enum Gather : unsigned {
    FORCE = 1,       // spring forces, energy and virial
    CONTACTS = 2,    // number of contacts
    VSUM = 4,        // sum of neighbors' velocities
    FILM = 8,        // sum of film exchange
    AREA = 16,       // sum of contact areas
    ENERGY = 32,     // each bubble's share of the energies
    DRAG = CONTACTS | VSUM,
    TO_LOOK_AT = CONTACTS | FILM | AREA | ENERGY
  };

  virtual void gather();              // TO_LOOK_AT of this state, for computes
  void refresh();                     // cutoffs, ghosts and bins for bubbles that have grown
  virtual bool outgrown() const;      // has the largest bubble of all ranks outgrown the cutoffs?
  double stiffest() const;            // largest sigma0
  void keep_means(double, double);    // <R_in>, <A_in> of a simulation that goes on

  double mu0;             // drag coefficient
  double rin, ain;        // <R_in>, <A_in>: means at the start of the first run
  bool neighbor_drag;     // drag relative to neighbors' mean velocity or to a liquid at rest
  unsigned gas_wanted;    // set by the integrator: FILM, AREA to gather in each compute()

  // sums over the contacts of each bubble, as gathered last; ghosts' parts are added in
  double *contacts;             // number of contacts
  double **vsum;                // sum of neighbors' velocities
  double *area;                 // sum of A_ij
  double *film;                 // sum of A_ij (1/R_j - 1/R_i)
  double *espring, *edurian;    // half of the springs' energies; energy of [L20]

 protected:
  bool rin_fixed, ain_fixed;    // given, or a run has started
  double headroom;              // cutoffs hold for radii up to headroom * present largest
  double cutoff_radius;         // the largest radius the present cutoffs are good for
  double **sigma0;              // per pair of types
  int nmax;                     // allocated length of the sums
  unsigned gathered;            // what is sent in reverse communication

  void allocate();
  virtual void grow_sums(unsigned);
  void clear_sums(unsigned, int);
  void dispatch(unsigned);
  template <int D, unsigned WHAT, bool TALLY, bool NEWTON> void eval();
};

}    // namespace LAMMPS_NS

#endif
#endif
