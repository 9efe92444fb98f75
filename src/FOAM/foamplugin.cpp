/* ----------------------------------------------------------------------
   Wet foams for LAMMPS. This file is only part of the plugin: in a LAMMPS
   that has the styles compiled in, the style macros of the headers
   register them.
   Distributed under the GNU General Public License, version 2: see LICENSE.
------------------------------------------------------------------------- */

#include "compute_bubble_collision.h"
#include "compute_bubble_flow.h"
#include "compute_foam_bubble.h"
#include "compute_liquid_particle.h"
#include "create_foam.h"
#include "fix_bubble_films.h"
#include "fix_bubble_flow.h"
#include "fix_bubble_nve.h"
#include "fix_bubble_rise.h"
#include "fix_bubble_sparger.h"
#include "fix_foam_abm.h"
#include "fix_foam_coarsen.h"
#include "fix_foam_contacts.h"
#include "fix_foam_flow.h"
#include "fix_foam_rkc.h"
#include "fix_foam_wall.h"
#include "fix_liquid_flow.h"
#include "fix_wall_bubble.h"
#include "pair_bubble_collision.h"
#include "pair_durian_foam.h"
#include "pair_liquid_sph.h"
#include "relax_foam.h"

#ifdef FOAM_KOKKOS
#include "compute_foam_bubble_kokkos.h"
#include "fix_bubble_films_kokkos.h"
#include "fix_bubble_flow_kokkos.h"
#include "fix_bubble_nve_kokkos.h"
#include "fix_bubble_rise_kokkos.h"
#include "fix_foam_abm_kokkos.h"
#include "fix_foam_coarsen_kokkos.h"
#include "fix_foam_contacts_kokkos.h"
#include "fix_foam_flow_kokkos.h"
#include "fix_foam_rkc_kokkos.h"
#include "fix_foam_wall_kokkos.h"
#include "fix_liquid_flow_kokkos.h"
#include "fix_wall_bubble_kokkos.h"
#include "pair_bubble_collision_kokkos.h"
#include "pair_durian_foam_kokkos.h"
#include "pair_liquid_sph_kokkos.h"
#endif

#include "comm.h"
#include "lammps.h"
#include "utils.h"

#include <deque>
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
  const char *const collision = "pair style bubble/collision: bubbles with inertia that collide";
  const char *const rise = "fix bubble/rise: buoyancy, drag and added mass";
  const char *const of_bubbles = "fix wall/bubble: walls for bubbles with inertia";
  const char *const nve = "fix bubble/nve: motion of bubbles with inertia";
  const char *const films = "fix bubble/films: made by pair style bubble/collision";
  const char *const particles = "pair style liquid/sph: particles of a resolved liquid";
  const char *const resolved = "fix liquid/flow: the flow of a resolved liquid";
  const char *const carried = "fix bubble/flow: bubbles in a resolved liquid";

  pair.operator()<PairDurianFoam>("durian/foam", durian);
  fix.operator()<FixFoamCoarsen>("foam/coarsen", coarsen);
  fix.operator()<FixFoamContacts>("foam/contacts", ages);
  fix.operator()<FixFoamFlow>("foam/flow", flow);
  fix.operator()<FixFoamABM>("foam/abm", abm);
  fix.operator()<FixFoamRKC>("foam/rkc", rkc);
  fix.operator()<FixFoamWall>("foam/wall", wall);
  compute.operator()<ComputeFoamBubble>("foam/bubble", bubble);

  pair.operator()<PairBubbleCollision>("bubble/collision", collision);
  fix.operator()<FixBubbleRise>("bubble/rise", rise);
  fix.operator()<FixWallBubble>("wall/bubble", of_bubbles);
  fix.operator()<FixBubbleNVE>("bubble/nve", nve);

  pair.operator()<PairLiquidSPH>("liquid/sph", particles);
  fix.operator()<FixLiquidFlow>("liquid/flow", resolved);
  fix.operator()<FixBubbleFlow>("bubble/flow", carried);
  brought = [](const char *, const std::string &) {
  };
  fix.operator()<FixBubbleFilms>("bubble/films", films);

#ifdef FOAM_KOKKOS
  static std::deque<std::string> names;    // LAMMPS keeps pointers to them
  auto kokkos = [&]<class Device>(const std::string &suffix) {
    auto kk = [&](const char *name) {
      return names.emplace_back(name + suffix).c_str();
    };
    pair.operator()<PairDurianFoamKokkos<Device>>(kk("durian/foam"), durian);
    fix.operator()<FixFoamCoarsenKokkos<Device>>(kk("foam/coarsen"), coarsen);
    fix.operator()<FixFoamContactsKokkos<Device>>(kk("foam/contacts"), ages);
    fix.operator()<FixFoamFlowKokkos<Device>>(kk("foam/flow"), flow);
    fix.operator()<FixFoamABMKokkos<Device>>(kk("foam/abm"), abm);
    fix.operator()<FixFoamRKCKokkos<Device>>(kk("foam/rkc"), rkc);
    fix.operator()<FixFoamWallKokkos<Device>>(kk("foam/wall"), wall);
    compute.operator()<ComputeFoamBubbleKokkos<Device>>(kk("foam/bubble"), bubble);
    pair.operator()<PairBubbleCollisionKokkos<Device>>(kk("bubble/collision"), collision);
    fix.operator()<FixBubbleRiseKokkos<Device>>(kk("bubble/rise"), rise);
    fix.operator()<FixWallBubbleKokkos<Device>>(kk("wall/bubble"), of_bubbles);
    fix.operator()<FixBubbleNVEKokkos<Device>>(kk("bubble/nve"), nve);
    fix.operator()<FixBubbleFilmsKokkos<Device>>(kk("bubble/films"), films);
    pair.operator()<PairLiquidSPHKokkos<Device>>(kk("liquid/sph"), particles);
    fix.operator()<FixLiquidFlowKokkos<Device>>(kk("liquid/flow"), resolved);
    fix.operator()<FixBubbleFlowKokkos<Device>>(kk("bubble/flow"), carried);
  };
  kokkos.operator()<LMPDeviceType>("/kk");
  kokkos.operator()<LMPDeviceType>("/kk/device");
  kokkos.operator()<LMPHostType>("/kk/host");
  styles += ", each also with /kk";
#endif
  brought = told;

  compute.operator()<ComputeBubbleCollision>(
      "bubble/collision", "compute bubble/collision: forces on each bubble by term");
  fix.operator()<FixBubbleSparger>("bubble/sparger",
                                   "fix bubble/sparger: gas that flows into a liquid");
  compute.operator()<ComputeLiquidParticle>(
      "liquid/particle", "compute liquid/particle: what is known of each particle");
  compute.operator()<ComputeBubbleFlow>("bubble/flow",
                                        "compute bubble/flow: forces on each bubble in a liquid");
  command.operator()<CreateFoam>("create_foam", "create_foam: a box, and bubbles in it");
  command.operator()<RelaxFoam>("relax_foam", "relax_foam: to rest, at a gas fraction or pressure");

  // lmp -h was made before any plugin came

  auto *const lammps = static_cast<LAMMPS *>(lmp);
  if (lammps->comm->me == 0) utils::logmesg(lammps, "Foam package: {}\n", styles);
}
