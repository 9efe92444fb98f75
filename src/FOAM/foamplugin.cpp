/* ----------------------------------------------------------------------
   Wet foams for LAMMPS. This file is only part of the plugin: in a LAMMPS
   that has the styles compiled in, the style macros of the headers
   register them.
   Distributed under the GNU General Public License, version 2: see LICENSE.
------------------------------------------------------------------------- */

#include "compute_foam_bubble.h"
#include "fix_foam_abm.h"
#include "fix_foam_coarsen.h"
#include "pair_durian_foam.h"

using namespace LAMMPS_NS;

// The C interface by which a plugin announces a style, as documented on LAMMPS' page "Writing
// plugins". Installed copies of LAMMPS lack the header (lammpsplugin.h) that declares it.

extern "C" {
struct lammpsplugin {
  const char *version;
  const char *style;
  const char *name;
  const char *info;
  const char *author;
  union {
    void *(*v1)(void *);                  // pair styles
    void *(*v2)(void *, int, char **);    // fixes and computes
  } creator;
  void *handle;
};
using lammpsplugin_register = void(lammpsplugin *, void *);

void lammpsplugin_init(void *lmp, void *handle, void *regfunc);
}

namespace {

// LAMMPS takes the pointers back as Pair *, Fix *, Compute *, hence the conversion before void *

template <class Style> void *make_pair_style(void *lmp)
{
  return static_cast<Pair *>(new Style(static_cast<LAMMPS *>(lmp)));
}

template <class Base, class Style> void *make_style(void *lmp, int narg, char **arg)
{
  return static_cast<Base *>(new Style(static_cast<LAMMPS *>(lmp), narg, arg));
}

}    // namespace

void lammpsplugin_init(void *lmp, void *handle, void *regfunc)
{
  auto *announce = reinterpret_cast<lammpsplugin_register *>(regfunc);

  lammpsplugin plugin;
  plugin.version = FOAM_LAMMPS_VERSION;
  plugin.author = "lammps-foam";
  plugin.handle = handle;

  plugin.style = "pair";
  plugin.name = "durian/foam";
  plugin.info = "pair style durian/foam: bubbles that touch, Durian's bubble model";
  plugin.creator.v1 = make_pair_style<PairDurianFoam>;
  announce(&plugin, lmp);

  plugin.style = "fix";
  plugin.name = "foam/coarsen";
  plugin.info = "fix foam/coarsen: gas exchange between bubbles";
  plugin.creator.v2 = make_style<Fix, FixFoamCoarsen>;
  announce(&plugin, lmp);

  plugin.name = "foam/abm";
  plugin.info = "fix foam/abm: adaptive Adams-Bashforth-Moulton steps";
  plugin.creator.v2 = make_style<Fix, FixFoamABM>;
  announce(&plugin, lmp);

  plugin.style = "compute";
  plugin.name = "foam/bubble";
  plugin.info = "compute foam/bubble: contacts, free surface and growth of each bubble";
  plugin.creator.v2 = make_style<Compute, ComputeFoamBubble>;
  announce(&plugin, lmp);
}
