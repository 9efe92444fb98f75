/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef PAIR_CLASS
// clang-format off
PairStyle(liquid/sph,PairLiquidSPH);
// clang-format on
#else

#ifndef LMP_PAIR_LIQUID_SPH_H
#define LMP_PAIR_LIQUID_SPH_H

#include "foam_half_list.h"
#include "pair.h"

#include <vector>

namespace LAMMPS_NS {

// Particles of a resolved liquid, and bubbles in it: how far they see, and who is near whom.  Forces are the integrator's, fix liquid/flow.

class PairLiquidSPH : public Pair {
 public:
  PairLiquidSPH(class LAMMPS *);
  ~PairLiquidSPH() override;
  static PairLiquidSPH *of(class LAMMPS *);    // the one in use, or none

  void compute(int, int) override;
  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  double init_one(int, int) override;
  void write_restart(FILE *) override;
  void read_restart(FILE *) override;
  void write_restart_settings(FILE *) override;
  void read_restart_settings(FILE *) override;
  void write_data(FILE *) override;
  void write_data_all(FILE *) override;

  double dr = 0.0;           // spacing of the particles
  double h_over_dr = 1.3;    // smoothing length without gas
  double h0() const { return h_over_dr * dr; }
  double reach() const;    // the longest distance between neighbors

  // Who is around whom: rows of particles of the liquid with others, with bubbles, and rows of bubbles with particles

  enum Kind { LIQUID, BUBBLES_OF_LIQUID, LIQUID_OF_BUBBLES, KINDS };
  int liquidbit = 1, gasbit = 0;    // of groups; none: no bubbles
  int nrows(Kind) const;
  FoamHalfList<true> rows(Kind) const;
  void check_place(const char *style, int kokkosable, int execution_space) const;    // or an error

 protected:
  virtual void request_list();
  virtual void take_lists();    // new ones of LAMMPS

 private:
  struct Rows {
    std::vector<int> of;
    FoamShortList near;
  };
  Rows lists[KINDS];

  std::vector<int> wet;    // of each type

  void allocate();
  void find_wet_types();
  bool all_liquid() const { return liquidbit == 1 && gasbit == 0; }
};

}    // namespace LAMMPS_NS

#endif
#endif
