/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_BUBBLE_INPUT_H
#define LMP_BUBBLE_INPUT_H

#include "bubble_collision.h"
#include "foam_input.h"

#include "update.h"

#include <cstring>

namespace LAMMPS_NS {

// The keywords that pairs and walls have in common

inline FoamInput::Keywords collision_keywords(Bubble::Collision &c, bool &exact)
{
  using Value = FoamInput::Value;
  using namespace Bubble;
  return {
      {"elastic",
       [&](const Value &v) {
         c.elastic = Elastic(v.one_of({"none", "spring", "quadratic"}));
       }},
      {"viscous",
       [&](const Value &v) {
         c.viscous = Viscous(v.one_of({"none", "published", "derived"}));
       }},
      {"integral",
       [&](const Value &v) {
         exact = v.one_of({"fit", "exact"}) == 1;
       }},
      {"h0",
       [&](const Value &v) {
         c.stop = v.is("contact") ? Stop::CONTACT : v.is("current") ? Stop::CURRENT : Stop::GIVEN;
         if (c.stop == Stop::GIVEN) c.h0 = v.number(FoamInput::ABOVE, 0.0);
       }},
      {"hmin",
       [&](const Value &v) {
         c.hmin = v.number(FoamInput::ABOVE, 0.0);
       }},
      {"film",
       [&](const Value &v) {
         c.film = v.one_of({"no", "yes"});
       }},
      {"lubrication",
       [&](const Value &v) {
         c.lubrication = v.one_of({"no", "yes"});
       }},
      {"reach",
       [&](const Value &v) {
         c.reach = v.number(FoamInput::AT_LEAST, 0.0);
       }},
  };
}

// 10 micrometres, as [H17] take it for the thickness of a film of soapy water; 0 where LAMMPS' units have no metre

inline double default_hmin(const Update *update)
{
  struct Unit {
    const char *style;
    double length;    // 10 micrometres
  };
  for (const Unit &unit :
       {Unit{"si", 1.0e-5}, Unit{"cgs", 1.0e-3}, Unit{"micro", 10.0}, Unit{"nano", 1.0e4}})
    if (strcmp(update->unit_style, unit.style) == 0) return unit.length;
  return 0.0;
}

}    // namespace LAMMPS_NS

#endif
