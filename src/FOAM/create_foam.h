/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef COMMAND_CLASS
// clang-format off
CommandStyle(create_foam,CreateFoam);
// clang-format on
#else

#ifndef LMP_CREATE_FOAM_H
#define LMP_CREATE_FOAM_H

#include "command.h"
#include "foam_start.h"

#include <string>

namespace LAMMPS_NS {

// A box, and the bubbles in it, made directly: each rank goes over all of them and keeps its own.

class CreateFoam : public Command {
 public:
  CreateFoam(class LAMMPS *lmp) : Command(lmp) {}
  void command(int, char **) override;

 private:
  bigint bubbles = 0, seed = 0;
  int types = 1;    // of particles that the box has room for; bubbles are of type 1
  bool on_grid = true;
  double relative[3] = {1.0, 1.0, 1.0};    // lengths of the box
  double phi = 0.0;                        // its gas fraction; 0: sites of the grid are 2 <R> wide
  Foam::Sizes sizes;

  void settings(int, char **);
  void read_sizes(const std::string &file);
  void make_box(const double (&length)[3]);
  void make_bubbles(const Foam::Grid &, const double (&length)[3]);
  void tell(const double (&length)[3]);
};

}    // namespace LAMMPS_NS

#endif
#endif
