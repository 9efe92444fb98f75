#!/usr/bin/env python3
"""Contacts, pressure and moduli against the distance to jamming, from what run.py left in a directory.

    python3 plot.py DIR [--bubbles N]

Writes DIR/jamming.png, jamming-sticky.png, and the means in jamming-means.csv. Prints jamming points, and exponents for
several windows. What one packing gives is in packing.py.
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

from packing import read_packing

# dimension, ratio of radii, phi_J of O'Hern et al. (2003) for endless packings, what it is
SYSTEMS = {"2d": (2, 1.4, 0.842, "2D, radii 1 and 1.4"), "3d": (3, 1.0, 0.639, "3D, one radius"),
           "3d-mixed": (3, 1.4, 0.648, "3D, radii 1 and 1.4")}
STYLE = {"font.size": 12, "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False,
         "mathtext.fontset": "cm", "savefig.dpi": 110}
COLOURS = {("2d", 2.0): "#1f5a96", ("2d", 2.5): "#7fb2e0", ("3d", 2.0): "#c0582b", ("3d", 2.5): "#eda876"}
CONVERGED = 1e-6        # largest force left on a bubble, relative to the mean force of a contact
AGREE = 0.1             # moduli by strain agree with those by second derivatives, or are not counted: see read_all()
REST = 1e-9             # largest force left on a bubble with attraction, whose forces are some 1e-3 to 1e-2
RIGID = 1e-5            # a packing with a larger shear modulus is jammed; without contacts across it is 1e-7 or less
WINDOWS = ((1e-4, 3e-3), (3e-4, 1e-2), (1e-3, 3e-2), (3e-3, 1e-1))    # of fits
QUANTITIES = {          # name: exponent, text, label
    "excess": (lambda alpha: 0.5, "Z - 2d", r"$Z - 2d$"),
    "excess_n": (lambda alpha: 0.5, "Z - 2d(1 - 1/N)", r"$Z - 2d\,(1 - 1/N)$"),
    "pressure": (lambda alpha: alpha - 1, "pressure", r"pressure  $p / \sigma_0$"),
    "bulk": (lambda alpha: alpha - 2, "bulk modulus", r"bulk modulus  $B / \sigma_0$"),
    "shear": (lambda alpha: alpha - 1.5, "shear modulus", r"shear modulus  $G / \sigma_0$"),
    "shear_every": (lambda alpha: alpha - 1.5, "shear, all directions", r"shear modulus  $G / \sigma_0$"),
}


# ------------------------------------------------------------------ reading

def read_all(directory):
    """Points of all packings by (system, alpha, bubbles) and seed.

    A step of strain, small as it is, can make a packing give way somewhere. Then what is seen is not its modulus.
    """
    packings, refused = collections.defaultdict(dict), 0
    for path in sorted(directory.glob("packing-*.csv")):
        found = re.fullmatch(r"packing-(\dd(?:-mixed)?)-([\d.]+)-(\d+)-(\d+)", path.stem)
        if found:
            system, alpha, bubbles, seed = found.groups()
            points, bad = read_packing(path, float(alpha), SYSTEMS[system][0], CONVERGED)
            packings[system, float(alpha), int(bubbles)][int(seed)] = points
            refused += bad
    points = [p for seeds in packings.values() for points in seeds.values() for p in points]
    if points:
        off = np.array([[off_by(p, name) for name in ("shear", "bulk")] for p in points])
        print(f"{len(points)} points; refused, since not at rest: {refused}; largest force left, relative to the mean "
              f"force of a contact: {max(p.residual for p in points):.1e}\n"
              f"moduli by strain and by second derivatives differ by {np.median(off):.1e} in the median; by more than "
              f"{AGREE:.0%}, and not counted: {(off[:, 0] > AGREE).sum()} shear, {(off[:, 1] > AGREE).sum()} bulk; "
              f"shear modulus < 0: {sum(p.shear_exact < 0 for p in points)}")
    return packings


def off_by(point, name):
    exact = getattr(point, f"{name}_exact")
    return abs(getattr(point, name) / exact - 1)


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
                if name not in ("shear", "bulk") or off_by(p, name) <= AGREE:
                    table[name][row, column] = getattr(p, name)
    return table


def middle(values, name):
    """Of each column the mean over packings; the median for shear moduli, which are far below zero where one is about
    to give way."""
    some = np.isfinite(values).any(0)
    result = np.full(values.shape[1], np.nan)
    result[some] = (np.nanmedian if name.startswith("shear") else np.nanmean)(values[:, some], 0)
    return result


def slope(x, y, use):
    if use.sum() < 3 or not np.all(y[use] > 0):
        return np.nan
    return np.polyfit(np.log(x[use]), np.log(y[use]), 1)[0]


def draws(count, times=400):
    """Packings drawn anew, for errors."""
    return np.random.default_rng(1).integers(0, count, (times, count)) if count > 2 else []


def values(table, name):
    """Distances, values, and their errors."""
    y = table[name]
    spread = [middle(y[pick], name) for pick in draws(len(y))]
    return middle(table["x"], "x"), middle(y, name), (np.nanstd(spread, 0) if spread else np.full(y.shape[1], np.nan))


def exponent(table, name, low, high, root=None):
    """Slope of the middle over packings, its error, and how often draws have no slope.

    With `root`, against pressure^(1/root) in the place of the distance.
    """
    def one(pick):
        x = middle(table["x"], "x")
        use = (x > 0.9 * low) & (x < 1.1 * high)
        if root:
            x = middle(table["pressure"][pick], "pressure")**(1 / root)
        return slope(x, middle(table[name][pick], name), use)

    spread = np.array([one(pick) for pick in draws(len(table["x"]))])
    good = spread[np.isfinite(spread)]
    return one(slice(None)), good.std() if len(good) > 1 else np.nan, len(spread) - len(good)


def report(packings, bubbles):
    print("\nphi_J: mean over packings, its error, and their standard deviation")
    for (system, alpha, n), seeds in sorted(packings.items()):
        next_to = [points[0] for points in seeds.values() if points]
        phi_j, loose, spare = (np.array([getattr(p, what) for p in next_to]) for what in ("phi_j", "rattlers", "spare"))
        if len(phi_j) > 1:
            print(f"  {system:9s}alpha {alpha:g}  {n:4d} bubbles, {len(phi_j):2d} packings: {phi_j.mean():.4f} +- "
                  f"{phi_j.std(ddof=1) / np.sqrt(len(phi_j)):.4f}, {phi_j.std(ddof=1):.4f}  (published "
                  f"{SYSTEMS[system][2]});  rattlers {loose.mean():.1%};  contacts above d(N-1), next to it: "
                  f"{min(spare)} to {max(spare)}")
    print(f"\nexponents, packings of {bubbles} bubbles: published, then by window of phi - phi_J; errors over packings")
    print(" " * 49 + "".join(f"{f'{low:g} to {high:g}':>17s}" for low, high in WINDOWS))
    for (system, alpha, n), seeds in sorted(packings.items()):
        table = curves(seeds)
        if n != bubbles or table["x"].shape[1] < 4:
            continue
        lines = [(name, text, power, None) for name, (power, text, _) in QUANTITIES.items()]
        lines.insert(2, ("excess_n", "the same, by pressure", QUANTITIES["excess_n"][0], alpha - 1))
        for name, text, power, root in lines:
            line = f"  {system:4s}alpha {alpha:<5g}{text:24s}{power(alpha):8.2f}    "
            for window in WINDOWS:
                value, error, without = exponent(table, name, *window, root)
                line += f"{value:8.3f} +-{error:5.3f}" + ("*" if without else " ")
            print(line)
    print("  * some of the packings drawn anew have no slope, since a modulus is < 0: the error is too small")


def write_table(packings, path):
    with open(path, "w", newline="") as f:
        table = csv.writer(f)
        table.writerow(["system", "alpha", "bubbles", "packings", "phi-phi_J",
                        *(f"{name}{what}" for name in QUANTITIES for what in ("", "_error"))])
        for (system, alpha, n), seeds in sorted(packings.items()):
            curve = curves(seeds)
            columns = [values(curve, name) for name in QUANTITIES]
            for k, x in enumerate(columns[0][0]):
                table.writerow([system, alpha, n, len(seeds), f"{x:.6g}",
                                *(f"{value[k]:.6g}" for _, *both in columns for value in both)])


# ------------------------------------------------------------------ attraction

def report_sticky(directory):
    """Of in.sticky by depth: gas fractions, median of the moduli, pressure, share of packings that are jammed."""
    found = collections.defaultdict(list)
    refused = count = 0
    for path in sorted(directory.glob("sticky-*.csv")):
        depth = re.match(r"sticky-([\d.]+)-\d+-\d+\.csv", path.name)
        if not depth:
            continue
        with open(path, newline="") as f:
            for row in csv.DictReader(f):
                row = {key: float(value) for key, value in row.items()}
                count += 1
                if row["residual"] > REST:
                    refused += 1
                    continue
                modulus = (row["stress_up"] - row["stress_down"]) / (2 * row["strain"])
                found[float(depth[1])].append((row["phi"], modulus, row["pressure"], row["contacts"]))
    if not found:
        return {}
    print(f"\nattraction: jammed packings (|G| > {RIGID:g} sigma_0) of all, by gas fraction; {count} packings; "
          f"refused, since not at rest: {refused}")
    result = {}
    for depth, rows in sorted(found.items()):
        rows = np.array(rows)
        phis = np.unique(rows[:, 0])
        of = [rows[rows[:, 0] == phi] for phi in phis]
        jammed = np.array([(np.abs(row[:, 1]) > RIGID).mean() for row in of])
        result[depth] = phis, jammed, [np.median(row[:, 1]) for row in of], [row[:, 2].mean() for row in of]
        print(f"  A = {depth:<6g}" + "  ".join(f"{phi:.2f}: {share:.0%} of {len(row)}"
                                              for phi, share, row in zip(phis, jammed, of) if 0 < share < 1)
              + f"   none at {phis[jammed == 0].max(initial=0):.2f}, all from {phis[jammed == 1].min(initial=1):.2f}")
    return result


def draw_sticky(sticky, path):
    fig, axes = plt.subplots(1, 3, figsize=(13, 4.2), layout="constrained")
    for (depth, (phis, jammed, modulus, pressure)), colour in zip(sticky.items(), ("0.3", "#1f5a96", "#c0582b")):
        style = dict(color=colour, marker="o", ms=4, lw=1.1, label=f"sticky {depth:g}" if depth else "spring")
        for ax, y in zip(axes, (jammed, modulus, pressure)):
            ax.plot(phis, y, **style)
    axes[1].set_yscale("symlog", linthresh=1e-4)
    axes[1].set_ylim(-1e-5, 0.1)
    for ax, title in zip(axes, ("share of jammed packings", r"shear modulus  $G / \sigma_0$",
                                r"pressure  $p / \sigma_0$")):
        ax.axvline(SYSTEMS["2d"][2], color="0.7", lw=0.9, zorder=0)
        ax.set(xlabel=r"gas fraction  $\phi$", title=title)
    axes[2].set_yscale("symlog", linthresh=1e-5)
    axes[0].legend(fontsize=10, loc="upper left")
    fig.savefig(path)
    plt.close(fig)


# ------------------------------------------------------------------ pictures

def draw(packings, bubbles, path):
    fig, axes = plt.subplots(1, 4, figsize=(16, 4.4), layout="constrained")
    for ax, name in zip(axes, ("excess_n", "pressure", "bulk", "shear_every")):
        power, _, label = QUANTITIES[name]
        for (system, alpha), colour in COLOURS.items():
            seeds = packings.get((system, alpha, bubbles))
            if not seeds or len(next(iter(seeds.values()))) < 4:
                continue
            x, y, error = values(curves(seeds), name)
            text = f"{system[0]}D, " + ("spring" if alpha == 2 else rf"power {alpha:g}")
            ax.errorbar(x, y, error, color=colour, marker="o" if alpha == 2 else "s", ms=5, ls="", label=text)
            ax.plot(x, y[3] * (x / x[3])**power(alpha), color=colour, lw=1.0, zorder=0)
        ax.set(xscale="log", yscale="log", xlabel=r"$\phi - \phi_J$", title=label)
    if axes[0].lines:
        axes[0].legend(fontsize=10, handlelength=1.0)
    fig.savefig(path)
    plt.close(fig)


def make_pictures(directory, bubbles=None):
    packings = read_all(directory)
    if packings:
        report(packings, bubbles or 500)
        write_table(packings, directory / "jamming-means.csv")
    sticky = report_sticky(directory)
    with plt.rc_context(STYLE):
        if packings:
            draw(packings, bubbles or 500, directory / "jamming.png")
        if sticky:
            draw_sticky(sticky, directory / "jamming-sticky.png")
    print(f"\npictures and jamming-means.csv are in {directory}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("directory", type=Path)
    parser.add_argument("--bubbles", type=int, help="size of the packings that are fitted and drawn (500)")
    args = parser.parse_args()
    make_pictures(args.directory, args.bubbles)


if __name__ == "__main__":
    main()
