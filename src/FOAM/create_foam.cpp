/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "create_foam.h"

#include "foam_input.h"
#include "foam_physics.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "input.h"
#include "library.h"
#include "utils.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <vector>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   create_foam N seed keyword value ...
------------------------------------------------------------------------- */

void CreateFoam::command(int narg, char **arg)
{
  if (domain->box_exist)
    error->all(
        FLERR,
        "Create_foam makes the box and the bubbles in it, and must come before any other box");
  if (!atom->radius_flag)
    error->all(FLERR, "Create_foam needs atom_style sphere 1, in which radii change");
  for (int k = 0; k < domain->dimension; k++)
    if (domain->boundary[k][0] > 1 || domain->boundary[k][1] > 1)
      error->all(FLERR,
                 "Create_foam: boundaries must be p or f, those of a gas fraction, not s or m");
  settings(narg, arg);

  // a volume of 2 <R> cubed for each site, or what gives phi, in the shape that is wanted; every rank sums up all
  // bubbles, in the same order

  const int dim = domain->dimension;
  const Foam::Grid grid(dim, bubbles, relative);
  double volume = 1.0, shape = 1.0;
  for (int k = 0; k < dim; k++) {
    volume *= 2.0 * sizes.mean * static_cast<double>(grid.sites[k]);
    shape *= relative[k];
  }
  if (phi > 0.0) {
    double content = 0.0;
    for (bigint n = 0; n < bubbles; n++)
      content += std::pow(sizes.radius(Foam::Draws(seed, n), n, bubbles), dim);
    content *= Foam::with_dimension(dim, []<int D>() { return Foam::CONTENT<D>; });
    volume = content / phi;
  }
  double length[3] = {1.0, 1.0, 1.0};
  for (int k = 0; k < dim; k++) length[k] = relative[k] * std::pow(volume / shape, 1.0 / dim);

  for (int k = 0; k < dim; k++)
    if (length[k] < 2.0 * sizes.mean)
      error->all(
          FLERR,
          "Create_foam: the box is {:.3g} long in {}, less than a bubble: see keywords box and phi",
          length[k], "xyz"[k]);

  make_box(length);
  make_bubbles(grid, length);
  tell(length);
}

void CreateFoam::settings(int narg, char **arg)
{
  using Value = FoamInput::Value;
  const std::string name = "Create_foam";
  FoamInput input(error, name, narg, arg);
  bubbles = input.argument("N").count();
  if (bubbles < 1 || bubbles > MAXTAGINT)
    error->all(FLERR, "{}: N must be an integer from 1 to {}, not {}", name, MAXTAGINT, bubbles);
  seed = input.argument("seed").count();

  auto positive = [&](const std::string &what) {
    return input.argument(what).number(FoamInput::ABOVE, 0.0);
  };
  const int dim = domain->dimension;
  input.keywords(
      {{"start",
        [&](const Value &v) {
          on_grid = v.one_of({"grid", "random"}) == 0;
        }},
       {"box",    // the first is the value of the keyword
        [&](const Value &v) {
          relative[0] = v.number(FoamInput::ABOVE, 0.0);
          relative[1] = positive("box y");
          if (dim == 3) relative[2] = positive("box z");
        }},
       {"sizes",
        [&](const Value &v) {
          sizes.kind = static_cast<Foam::Sizes::Kind>(
              v.one_of({"equal", "normal", "lognormal", "bidisperse", "file"}));
          const std::string kind = v.word("");
          if (sizes.kind == Foam::Sizes::LISTED)
            read_sizes(input.argument("sizes file NAME").word("the name of a file"));
          else
            sizes.mean = positive("sizes " + kind + " mean");
          if (sizes.kind == Foam::Sizes::NORMAL || sizes.kind == Foam::Sizes::LOGNORMAL)
            sizes.std = input.argument("sizes " + kind + " std").number(FoamInput::AT_LEAST, 0.0);
          if (sizes.kind == Foam::Sizes::BIDISPERSE) {
            sizes.ratio = positive("sizes bidisperse ratio");
            sizes.share = input.argument("sizes bidisperse share").from_to(0.0, 1.0);
          }
        }},
       {"rmin",
        [&](const Value &v) {
          sizes.rmin = v.between(0.0, 1.0);
        }},
       {"types",
        [&](const Value &v) {
          types = v.integer(1, MAXSMALLINT);
        }},
       {"phi", [&](const Value &v) {
          phi = v.between(0.0, 2.0);
        }}});
}

// Radii, with white space between them; the rest of a line after # is for people

void CreateFoam::read_sizes(const std::string &file)
{
  std::string wrong;
  std::vector<double> &radii = sizes.listed;
  radii.clear();
  if (comm->me == 0) {
    std::ifstream in(file);
    if (!in) wrong = "cannot be read";
    std::string line, word;
    for (bigint number = 1; wrong.empty() && std::getline(in, line); number++) {
      std::istringstream words(line.substr(0, line.find('#')));
      while (wrong.empty() && words >> word) {
        const double R = utils::is_double(word) ? std::strtod(word.c_str(), nullptr) : NAN;
        if (R > 0.0 && std::isfinite(R))
          radii.push_back(R);
        else
          wrong = fmt::format("has {} in line {}, where a radius > 0 is wanted",
                              FoamInput::shown(word), number);
      }
    }
    if (wrong.empty() && radii.empty()) wrong = "has no radius in it";
    if (!wrong.empty()) error->one(FLERR, "Create_foam: the file {} {}", file, wrong);
  }
  bigint n = radii.size();
  MPI_Bcast(&n, 1, MPI_LMP_BIGINT, 0, world);
  radii.resize(n);
  constexpr bigint MOST = 1 << 27;    // MPI counts in int
  for (bigint at = 0; at < n; at += MOST)
    MPI_Bcast(radii.data() + at, static_cast<int>(std::min(MOST, n - at)), MPI_DOUBLE, 0, world);

  sizes.mean = 0.0;
  for (const double R : radii) sizes.mean += R / static_cast<double>(n);
}

void CreateFoam::make_box(const double (&length)[3])
{
  const bool flat = domain->dimension == 2;
  input->one(fmt::format("region create_foam block 0 {:.17g} 0 {:.17g} {} {:.17g} units box",
                         length[0], length[1], flat ? "-0.5" : "0", flat ? 0.5 : length[2]));
  input->one(fmt::format("create_box {} create_foam", types));
  input->one("region create_foam delete");
}

// In batches, of which each rank keeps those in its part of the box.  IDs are those of the sites.

void CreateFoam::make_bubbles(const Foam::Grid &grid, const double (&length)[3])
{
  const int dim = domain->dimension;
  constexpr bigint BATCH = 1 << 18;
  std::vector<tagint> ids;
  std::vector<int> types;
  std::vector<double> places;

  for (bigint from = 0; from < bubbles; from += BATCH) {
    const bigint to = std::min(bubbles, from + BATCH);
    ids.clear();
    places.clear();
    for (bigint n = from; n < to; n++) {
      const Foam::Draws draws(seed, n);
      double by[3] = {0.0, 0.0, 0.0};
      if (on_grid) Foam::displacement(dim, draws, by);
      ids.push_back(static_cast<tagint>(n + 1));
      for (int k = 0; k < 3; k++) {
        const double share =
            on_grid ? (grid.centre(k, n) + 0.5 * by[k]) / static_cast<double>(grid.sites[k])
                    : draws.uniform(Foam::PLACE + k);
        places.push_back(k < dim ? share * length[k] : 0.0);
      }
    }
    types.assign(ids.size(), 1);
    const int before = atom->nlocal;
    lammps_create_atoms(lmp, static_cast<int>(ids.size()), ids.data(), types.data(), places.data(),
                        nullptr, nullptr, 0);
    for (int i = before; i < atom->nlocal; i++) {
      const bigint n = atom->tag[i] - 1;
      const double R = sizes.radius(Foam::Draws(seed, n), n, bubbles);
      atom->radius[i] = R;
      atom->rmass[i] = Foam::CONTENT<3> * R * R * R;    // density 1, as LAMMPS has it at first
    }
  }
  if (atom->natoms != bubbles)
    error->all(FLERR, "Create_foam: {} of {} bubbles could be put into the box", atom->natoms,
               bubbles);
}

// as they are: of a distribution that was drawn from, and that has no negative or small radii

void CreateFoam::tell(const double (&length)[3])
{
  const double smallest = sizes.rmin * sizes.mean;
  double mine[2] = {0.0, 0.0}, all[2];    // radii, bubbles of the smallest
  for (int i = 0; i < atom->nlocal; i++) {
    mine[0] += atom->radius[i];
    if (sizes.kind != Foam::Sizes::LISTED && atom->radius[i] == smallest) mine[1]++;
  }
  MPI_Allreduce(mine, all, 2, MPI_DOUBLE, MPI_SUM, world);
  if (comm->me != 0) return;
  std::string lifted;
  if (all[1] > 0.0)
    lifted = fmt::format(" ({:.0f} are lifted to the smallest, {:.3g})", all[1], smallest);
  utils::logmesg(lmp,
                 "Create_foam: {} bubbles, mean radius {:.8g}{}, in a box of {:.8g} x {:.8g}{}\n",
                 bubbles, all[0] / static_cast<double>(bubbles), lifted, length[0], length[1],
                 domain->dimension == 3 ? fmt::format(" x {:.8g}", length[2]) : "");
}
