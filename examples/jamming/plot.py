#!/usr/bin/env python3
"""Contacts, pressure and moduli against the distance to jamming, from what run.py left in a directory.

    python3 plot.py DIR [--bubbles N]

Writes DIR/jamming.png, and the means in jamming-means.csv. Prints jamming points, and exponents for several windows.
"""
import argparse
import collections
import csv
from pathlib import Path
import re

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

# dimension, ratio of radii, phi_J of O'Hern et al. (2003) for endless packings, what it is
SYSTEMS = {"2d": (2, 1.4, 0.842, "2D, radii 1 and 1.4"), "3d": (3, 1.0, 0.639, "3D, one radius"),
           "3d-mixed": (3, 1.4, 0.648, "3D, radii 1 and 1.4")}
STYLE = {"font.size": 12, "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False,
         "mathtext.fontset": "cm", "savefig.dpi": 110}
COLOURS = {("2d", 2.0): "#1f5a96", ("2d", 2.5): "#7fb2e0", ("3d", 2.0): "#c0582b", ("3d", 2.5): "#eda876"}
CONVERGED = 1e-6        # largest force left on a bubble, relative to the mean force of a contact
LINEAR = 0.1            # the moduli of shear to the two sides differ by no more than this
WINDOWS = ((1e-4, 3e-3), (3e-4, 1e-2), (1e-3, 3e-2), (3e-3, 1e-1))    # of fits
QUANTITIES = {          # name: exponent, text, label
    "excess": (lambda alpha: 0.5, "Z - 2d", r"$Z - 2d$"),
    "excess_n": (lambda alpha: 0.5, "Z - 2d(1 - 1/N)", r"$Z - 2d\,(1 - 1/N)$"),
    "pressure": (lambda alpha: alpha - 1, "pressure", r"pressure  $p / \sigma_0$"),
    "bulk": (lambda alpha: alpha - 2, "bulk modulus", r"bulk modulus  $B / \sigma_0$"),
    "shear": (lambda alpha: alpha - 1.5, "shear modulus", r"shear modulus  $G / \sigma_0$"),
}


def name_of(system, alpha, bubbles, seed):
    return f"packing-{system}-{alpha:g}-{bubbles}-{seed}"


# ------------------------------------------------------------------ contacts

def read_frames(path):
    """Of each frame of a dump: places, radii, edges of the box (which has no tilt there)."""
    lines = path.read_text().split("\n")
    at = 0
    while at + 9 < len(lines):
        n = int(lines[at + 3])
        bounds = np.array([line.split() for line in lines[at + 5:at + 8]], float)
        if np.any(bounds[:, 2:] != 0):
            raise SystemExit(f"{path}: the box has a tilt")
        rows = np.array([line.split() for line in lines[at + 9:at + 9 + n]], float)
        yield rows[:, 1:4], rows[:, 4], bounds[:, 1] - bounds[:, 0]
        at += 9 + n


def overlaps(places, radii, edges, dim, reach=1.0):
    """Pairs closer than reach times the sum of their radii: i, j, and overlap relative to that sum."""
    found = []
    for i in range(len(radii) - 1):
        apart = places[i + 1:, :dim] - places[i, :dim]
        apart -= edges[:dim] * np.round(apart / edges[:dim])
        sums = radii[i + 1:] + radii[i]
        relative = 1 - np.sqrt((apart**2).sum(1)) / sums
        near = np.flatnonzero(relative > 1 - reach)
        found.append(np.column_stack([np.full(len(near), i), near + i + 1, relative[near]]))
    found = np.concatenate(found)
    return found[:, :2].astype(int), found[:, 2]


def without_rattlers(pairs, n, dim):
    """Which pairs are left when bubbles with fewer than dim+1 contacts are taken out until there are none."""
    keep = np.ones(len(pairs), bool)
    while True:
        contacts = np.bincount(pairs[keep].ravel(), minlength=n)
        loose = (contacts > 0) & (contacts <= dim)
        if not loose.any():
            return keep, np.count_nonzero(contacts)
        keep &= ~loose[pairs].any(1)


Point = collections.namedtuple("Point", "distance phi phi_j pressure bulk shear excess excess_n rattlers spare "
                               "residual skew")


def read_packing(path, alpha, dim):
    """Points of one packing, and how many were refused."""
    with open(path, newline="") as f:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(f)]
    # phi_J: pressure^(1/(alpha-1)) of the two points next to it goes to zero linearly
    root = [row["pressure"]**(1 / (alpha - 1)) for row in rows[:2]]
    phi_j = rows[0]["phi"] - root[0] * (rows[1]["phi"] - rows[0]["phi"]) / (root[1] - root[0])
    points, refused = [], 0
    for row, (places, radii, edges) in zip(rows, read_frames(path.with_suffix(".lammpstrj"))):
        pairs, overlap = overlaps(places, radii, edges, dim)
        keep, n = without_rattlers(pairs, len(radii), dim)
        force = (overlap[keep]**(alpha - 1)).mean() * radii_mean(radii)
        if not row["residual"] < CONVERGED * force:
            refused += 1
            continue
        up, down = row["stress_up"] - row["stress"], row["stress"] - row["stress_down"]
        z = 2 * keep.sum() / n
        points.append(Point(
            row["distance"], row["phi"], phi_j, row["pressure"],
            row["phi"] * (row["pressure_more"] - row["pressure"]) / (row["phi_more"] - row["phi"]),
            (up + down) / (2 * row["strain"]), z - 2 * dim, z - 2 * dim * (1 - 1 / n), 1 - n / len(radii),
            keep.sum() - dim * (n - 1), row["residual"] / force, abs(up - down) / abs(up + down)))
    return points, refused


def radii_mean(radii):
    """rin of in.jamming: the force of a contact is in proportion to it."""
    return (radii.min() + radii.max()) / 2


def read_all(directory):
    """Points of all packings by (system, alpha, bubbles) and seed."""
    packings, refused, bent, count = collections.defaultdict(dict), 0, 0, 0
    for path in sorted(directory.glob("packing-*.csv")):
        found = re.fullmatch(r"packing-(\w+(?:-mixed)?)-([\d.]+)-(\d+)-(\d+)", path.stem)
        if not found:
            continue
        system, alpha, bubbles, seed = found.groups()
        points, bad = read_packing(path, float(alpha), SYSTEMS[system][0])
        packings[system, float(alpha), int(bubbles)][int(seed)] = points
        refused += bad
        count += len(points)
        bent += sum(point.skew > LINEAR for point in points)
    worst = max((p.residual for seeds in packings.values() for points in seeds.values() for p in points), default=0)
    print(f"{count} points; refused, since not at rest: {refused}; largest force left, relative to the mean force of a "
          f"contact: {worst:.1e}\nshear to the two sides differs by more than {LINEAR:.0%}, not counted for the shear "
          f"modulus: {bent}")
    return packings


# ------------------------------------------------------------------ means and fits

def curves(seeds):
    """By quantity: distances of the lines, and values of each packing (nan where there is none)."""
    distances = sorted({p.distance for points in seeds.values() for p in points})
    table = {name: np.full((len(seeds), len(distances)), np.nan) for name in ("x", *QUANTITIES)}
    for row, points in enumerate(seeds.values()):
        for p in points:
            column = distances.index(p.distance)
            table["x"][row, column] = p.phi - p.phi_j
            for name in QUANTITIES:
                if name != "shear" or p.skew <= LINEAR:
                    table[name][row, column] = getattr(p, name)
    return table


def mean_error(values):
    n = np.maximum(np.isfinite(values).sum(0), 1)
    return np.nanmean(values, 0), np.nanstd(values, 0, ddof=1) / np.sqrt(n)


def slope(x, values, low, high):
    x, y = np.nanmean(x, 0), np.nanmean(values, 0)
    use = (x > 0.9 * low) & (x < 1.1 * high)
    if use.sum() < 3 or np.any(y[use] <= 0):
        return np.nan
    return np.polyfit(np.log(x[use]), np.log(y[use]), 1)[0]


def exponent(x, values, low, high, times=400):
    """Slope of the mean over packings, and its error by drawing packings anew."""
    random = np.random.default_rng(1)
    draws = [slope(x[pick], values[pick], low, high)
             for pick in random.integers(0, len(x), (times, len(x)))] if len(x) > 2 else [np.nan]
    return slope(x, values, low, high), np.nanstd(draws)


def report(packings, bubbles):
    print("\nphi_J: mean over packings, its error, and their standard deviation")
    for (system, alpha, n), seeds in sorted(packings.items()):
        values = np.array([points[0].phi_j for points in seeds.values() if points])
        loose = np.array([points[0].rattlers for points in seeds.values() if points])
        spare = [points[0].spare for points in seeds.values() if points]
        print(f"  {system:9s}alpha {alpha:g}  {n:5d} bubbles, {len(values):3d} packings: {values.mean():.4f} +- "
              f"{values.std(ddof=1) / np.sqrt(len(values)):.4f}, {values.std(ddof=1):.4f}  (published "
              f"{SYSTEMS[system][2]})   rattlers {loose.mean():.1%}, contacts above d(N-1) next to it: "
              f"{min(spare)} to {max(spare)}")
    print("\nexponents: published, then by window of phi - phi_J with their errors over packings")
    print(" " * 47 + "".join(f"{f'{low:g} to {high:g}':>16s}" for low, high in WINDOWS))
    for (system, alpha, n), seeds in sorted(packings.items()):
        table = curves(seeds)
        if table["x"].shape[1] < 4 or n != bubbles:
            continue
        for name, (power, text, _) in QUANTITIES.items():
            fits = [exponent(table["x"], table[name], *window) for window in WINDOWS]
            print(f"  {system:9s}alpha {alpha:g}  {text:20s}{power(alpha):8.2f}  "
                  + "".join(f"{value:8.3f} +-{error:5.3f}" for value, error in fits))


def write_table(packings, path):
    with open(path, "w", newline="") as f:
        table = csv.writer(f)
        table.writerow(["system", "alpha", "bubbles", "packings", "phi-phi_J",
                        *(f"{name}{what}" for name in QUANTITIES for what in ("", "_error"))])
        for (system, alpha, n), seeds in sorted(packings.items()):
            curve = curves(seeds)
            means = [mean_error(curve[name]) for name in QUANTITIES]
            for k, x in enumerate(np.nanmean(curve["x"], 0)):
                table.writerow([system, alpha, n, len(seeds), f"{x:.6g}",
                                *(f"{value[k]:.6g}" for mean in means for value in mean)])


# ------------------------------------------------------------------ pictures

def draw(packings, bubbles, path):
    fig, axes = plt.subplots(1, 4, figsize=(16, 4.4), layout="constrained")
    for ax, name in zip(axes, ("excess_n", "pressure", "bulk", "shear")):
        power, _, label = QUANTITIES[name]
        for (system, alpha), colour in COLOURS.items():
            seeds = packings.get((system, alpha, bubbles))
            if not seeds:
                continue
            table = curves(seeds)
            x = np.nanmean(table["x"], 0)
            y, error = mean_error(table[name])
            text = f"{system[0]}D, " + ("spring" if alpha == 2 else rf"power {alpha:g}")
            ax.errorbar(x, y, error, color=colour, marker="o" if alpha == 2 else "s", ms=5, ls="", label=text)
            middle = len(x) // 2
            ax.plot(x, y[middle] * (x / x[middle])**power(alpha), color=colour, lw=1.0, zorder=0)
        ax.set(xscale="log", yscale="log", xlabel=r"$\phi - \phi_J$", title=label)
    axes[0].legend(fontsize=10, handlelength=1.0)
    fig.savefig(path)
    plt.close(fig)


def make_pictures(directory, bubbles=None):
    packings = read_all(directory)
    if not packings:
        raise SystemExit(f"{directory}: no packings")
    bubbles = bubbles or 500
    report(packings, bubbles)
    write_table(packings, directory / "jamming-means.csv")
    with plt.rc_context(STYLE):
        draw(packings, bubbles, directory / "jamming.png")
    print(f"\n{directory}: jamming.png, jamming-means.csv")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("directory", type=Path)
    parser.add_argument("--bubbles", type=int, help="size of the packings that are fitted and drawn (500)")
    args = parser.parse_args()
    make_pictures(args.directory, args.bubbles)


if __name__ == "__main__":
    main()
