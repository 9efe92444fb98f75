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

#include "foam_cells.h"
#include "foam_half_list.h"
#include "foam_law.h"
#include "pair_foam.h"

#include "atom.h"

namespace LAMMPS_NS {

// Durian's bubble model: overlapping bubbles repel each other by a contact law (foam_laws.h)

class PairDurianFoam : public PairFoam {
 public:
  PairDurianFoam(class LAMMPS *);
  ~PairDurianFoam() override;

  void settings(int, char **) override;
  void coeff(int, char **) override;
  double init_one(int, int) override;
  void write_restart(FILE *) override;
  void read_restart(FILE *) override;
  void write_restart_settings(FILE *) override;
  void read_restart_settings(FILE *) override;
  void write_data(FILE *) override;
  void write_data_all(FILE *) override;
  double single(int, int, int, int, double, double, double, double &) override;
  void *extract(const char *, int &) override;
  double stiffest() const override;
  double range() const override;
  void take_list() override;
  double memory_usage() override;
  Foam::Coefficients coefficients() const override
  {
    return {sigma0[0], atom->ntypes, hub.record.rin};
  }
  void init_style() override;

 protected:
  double **sigma0;    // per pair of types

  struct Made {    // for which list, by LAMMPS' counters
    bigint ncalls = -1, lastcall = -1;
    bool of(const class Neighbor *);    // for LAMMPS' present list; from now on it is
  } list_made, pairs_made;
  FoamShortList near_list;    // where the law acts beyond contact, and LAMMPS makes the list
  FoamPairs pairs;            // for loops that take them in blocks
  Foam::Cells cells;          // for lists that this style makes
  std::vector<int> partners, found_near;
  Foam::Cells::Near near() const;

  virtual bool can_make_lists() const;
  void allocate();
  void gather(unsigned what) override;
  template <int D> void fill_list();
  struct Tally;
  template <int D, unsigned WHAT, class Law> void gather_in(const Law &, unsigned what);
};

}    // namespace LAMMPS_NS

#endif
#endif
