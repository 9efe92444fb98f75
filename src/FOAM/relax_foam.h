/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef COMMAND_CLASS
// clang-format off
CommandStyle(relax_foam,RelaxFoam);
// clang-format on
#else

#ifndef LMP_RELAX_FOAM_H
#define LMP_RELAX_FOAM_H

#include "command.h"

#include <string>

namespace LAMMPS_NS {

// Relaxes a foam, by runs or minimizations of LAMMPS, and scales the box to a gas fraction or a pressure.

class RelaxFoam : public Command {
 public:
  RelaxFoam(class LAMMPS *lmp) : Command(lmp) {}
  void command(int, char **) override;

 private:
  double phi = 0.0;         // gas fraction to reach; 0: none is given
  double pressure = 0.0;    // pressure to reach; 0: none is given
  double tolerance = 1.0e-2;
  int steps = 50, rounds = 50;
  double limit = -1.0;    // rest: relative change of energy in a unit of time; below 0: the default
  std::string minimize;    // arguments of that command; empty: runs
  double etol = 0.0, ftol = 0.0;

  class PairFoam *pair = nullptr;
  double energy_most = 0.0;

  void settings(int, char **);
  void check();
  void relax();                 // a run of so many steps, or a minimization
  double relax_until_rest();    // the time that it took
  void relax_for(double time);
  void reach_pressure();
  void scale(double factor);    // lengths of the box, and distances of centres
  double energy();
  double pressure_now();
  double gas_fraction();
};

}    // namespace LAMMPS_NS

#endif
#endif
