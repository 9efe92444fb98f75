/* ----------------------------------------------------------------------
   Wet foams for LAMMPS. This file is only part of the plugin: in a LAMMPS
   that has the styles compiled in, the style macros of the headers
   register them.
   Distributed under the GNU General Public License, version 2: see LICENSE.
------------------------------------------------------------------------- */

#include "compute_foam_bubble.h"
#include "create_foam.h"
#include "compute_bubble_collision.h"
#include "fix_bubble_films.h"
#include "fix_bubble_nve.h"
#include "fix_bubble_rise.h"
#include "fix_foam_abm.h"
#include "fix_foam_coarsen.h"
#include "fix_foam_contacts.h"
#include "fix_foam_flow.h"
#include "fix_foam_rkc.h"
#include "fix_foam_wall.h"
#include "fix_wall_bubble.h"
#include "pair_bubble_collision.h"
#include "pair_durian_foam.h"
#include "relax_foam.h"

#ifdef FOAM_KOKKOS
#include "compute_foam_bubble_kokkos.h"
#include "fix_foam_abm_kokkos.h"
#include "fix_foam_coarsen_kokkos.h"
#include "fix_foam_contacts_kokkos.h"
#include "fix_foam_flow_kokkos.h"
#include "fix_foam_rkc_kokkos.h"
#include "fix_foam_wall_kokkos.h"
#include "pair_durian_foam_kokkos.h"
#endif

#include "comm.h"
#include "lammps.h"
#include "utils.h"

#include <functional>
#include <string>

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
    void *(*v1)(void *);                  // pair styles, commands
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

template <class Style> void *make_command(void *lmp)
{
  return static_cast<Command *>(new Style(static_cast<LAMMPS *>(lmp)));
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

  std::string styles;
  const auto told = [&](const char *category, const std::string &name) {
    styles += fmt::format("{}{} {}", styles.empty() ? "" : ", ", category, name);
  };
  std::function<void(const char *, const std::string &)> brought = told;
  auto pair = [&]<class Style>(const char *name, const char *info) {
    plugin.style = "pair";
    plugin.name = name;
    plugin.info = info;
    plugin.creator.v1 = make_pair_style<Style>;
    announce(&plugin, lmp);
    brought("pair_style", name);
  };
  auto fix = [&]<class Style>(const char *name, const char *info) {
    plugin.style = "fix";
    plugin.name = name;
    plugin.info = info;
    plugin.creator.v2 = make_style<Fix, Style>;
    announce(&plugin, lmp);
    brought("fix", name);
  };
  auto compute = [&]<class Style>(const char *name, const char *info) {
    plugin.style = "compute";
    plugin.name = name;
    plugin.info = info;
    plugin.creator.v2 = make_style<Compute, Style>;
    announce(&plugin, lmp);
    brought("compute", name);
  };
  auto command = [&]<class Style>(const char *name, const char *info) {
    plugin.style = "command";
    plugin.name = name;
    plugin.info = info;
    plugin.creator.v1 = make_command<Style>;
    announce(&plugin, lmp);
    brought("command", name);
  };
  const char *const durian = "pair style durian/foam: bubbles that touch, Durian's bubble model";
  const char *const bubble =
      "compute foam/bubble: contacts, free surface and growth of each bubble";
  const char *const coarsen = "fix foam/coarsen: gas exchange between bubbles";
  const char *const ages = "fix foam/contacts: how long bubbles have been in contact";
  const char *const flow = "fix foam/flow: a flow of the liquid between the bubbles";
  const char *const abm = "fix foam/abm: adaptive Adams-Bashforth-Moulton steps";
  const char *const rkc = "fix foam/rkc: adaptive stabilised Runge-Kutta-Chebyshev steps";
  const char *const wall = "fix foam/wall: walls at faces of the box";

  pair.operator()<PairDurianFoam>("durian/foam", durian);
  fix.operator()<FixFoamCoarsen>("foam/coarsen", coarsen);
  fix.operator()<FixFoamContacts>("foam/contacts", ages);
  fix.operator()<FixFoamFlow>("foam/flow", flow);
  fix.operator()<FixFoamABM>("foam/abm", abm);
  fix.operator()<FixFoamRKC>("foam/rkc", rkc);
  fix.operator()<FixFoamWall>("foam/wall", wall);
  compute.operator()<ComputeFoamBubble>("foam/bubble", bubble);

#ifdef FOAM_KOKKOS
  styles += ", each also with /kk";
  brought = [](const char *, const std::string &) {
  };
  pair.operator()<PairDurianFoamKokkos<LMPDeviceType>>("durian/foam/kk", durian);
  fix.operator()<FixFoamCoarsenKokkos<LMPDeviceType>>("foam/coarsen/kk", coarsen);
  fix.operator()<FixFoamContactsKokkos<LMPDeviceType>>("foam/contacts/kk", ages);
  fix.operator()<FixFoamFlowKokkos<LMPDeviceType>>("foam/flow/kk", flow);
  fix.operator()<FixFoamABMKokkos<LMPDeviceType>>("foam/abm/kk", abm);
  fix.operator()<FixFoamRKCKokkos<LMPDeviceType>>("foam/rkc/kk", rkc);
  fix.operator()<FixFoamWallKokkos<LMPDeviceType>>("foam/wall/kk", wall);
  compute.operator()<ComputeFoamBubbleKokkos<LMPDeviceType>>("foam/bubble/kk", bubble);

  pair.operator()<PairDurianFoamKokkos<LMPDeviceType>>("durian/foam/kk/device", durian);
  fix.operator()<FixFoamCoarsenKokkos<LMPDeviceType>>("foam/coarsen/kk/device", coarsen);
  fix.operator()<FixFoamContactsKokkos<LMPDeviceType>>("foam/contacts/kk/device", ages);
  fix.operator()<FixFoamFlowKokkos<LMPDeviceType>>("foam/flow/kk/device", flow);
  fix.operator()<FixFoamABMKokkos<LMPDeviceType>>("foam/abm/kk/device", abm);
  fix.operator()<FixFoamRKCKokkos<LMPDeviceType>>("foam/rkc/kk/device", rkc);
  fix.operator()<FixFoamWallKokkos<LMPDeviceType>>("foam/wall/kk/device", wall);
  compute.operator()<ComputeFoamBubbleKokkos<LMPDeviceType>>("foam/bubble/kk/device", bubble);

  pair.operator()<PairDurianFoamKokkos<LMPHostType>>("durian/foam/kk/host", durian);
  fix.operator()<FixFoamCoarsenKokkos<LMPHostType>>("foam/coarsen/kk/host", coarsen);
  fix.operator()<FixFoamContactsKokkos<LMPHostType>>("foam/contacts/kk/host", ages);
  fix.operator()<FixFoamFlowKokkos<LMPHostType>>("foam/flow/kk/host", flow);
  fix.operator()<FixFoamABMKokkos<LMPHostType>>("foam/abm/kk/host", abm);
  fix.operator()<FixFoamRKCKokkos<LMPHostType>>("foam/rkc/kk/host", rkc);
  fix.operator()<FixFoamWallKokkos<LMPHostType>>("foam/wall/kk/host", wall);
  compute.operator()<ComputeFoamBubbleKokkos<LMPHostType>>("foam/bubble/kk/host", bubble);
  brought = told;
#endif

  pair.operator()<PairBubbleCollision>(
      "bubble/collision", "pair style bubble/collision: bubbles with inertia that collide");
  fix.operator()<FixBubbleRise>("bubble/rise", "fix bubble/rise: buoyancy, drag and added mass");
  fix.operator()<FixWallBubble>("wall/bubble", "fix wall/bubble: walls for bubbles with inertia");
  fix.operator()<FixBubbleNVE>("bubble/nve", "fix bubble/nve: motion of bubbles with inertia");
  compute.operator()<ComputeBubbleCollision>(
      "bubble/collision", "compute bubble/collision: forces on each bubble by term");
  brought = [](const char *, const std::string &) {
  };
  fix.operator()<FixBubbleFilms>("bubble/films",
                                 "fix bubble/films: made by pair style bubble/collision");
  brought = told;

  command.operator()<CreateFoam>("create_foam", "create_foam: a box, and bubbles in it");
  command.operator()<RelaxFoam>("relax_foam", "relax_foam: to rest, at a gas fraction or pressure");

  // lmp -h was made before any plugin came

  auto *const lammps = static_cast<LAMMPS *>(lmp);
  if (lammps->comm->me == 0) utils::logmesg(lammps, "Foam package: {}\n", styles);
}
