#!/usr/bin/env python3
"""Stress against strain, from what in.shear wrote.

    python3 plot.py [DIR]        DIR holds steady.csv and quasistatic.csv; writes DIR/shear.png
"""
import argparse
import csv
from pathlib import Path
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

NEEDED = ("strain", "stress")
CURVES = {"steady.csv": ("steady shear", "#c0582b"), "quasistatic.csv": ("quasi-static", "#1f5a96")}


def read(path):
    """Columns of a table by name."""
    if not path.is_file():
        sys.exit(f"there is no {path}: in.shear writes it")
    with open(path, newline="") as f:
        rows = [row for row in csv.reader(f) if row]
    names = rows[0] if rows else []
    missing = [name for name in NEEDED if name not in names]
    if missing:
        sys.exit(f"{path} lacks the columns: {', '.join(missing)}")
    try:
        table = np.array(rows[1:], dtype=float)
    except ValueError:
        sys.exit(f"{path}: each line below the first needs {len(names)} numbers")
    if len(table) < 2:
        sys.exit(f"{path} has {len(table)} lines of numbers: a curve needs two at least")
    return dict(zip(names, table.T))


def late(table):
    """Mean and standard deviation of the stress over the second half of the strain."""
    use = table["strain"] >= 0.5 * table["strain"][-1]
    # by strain, since the steps of a steady shear vary
    grid = np.linspace(table["strain"][use][0], table["strain"][-1], 400)
    stress = np.interp(grid, table["strain"], table["stress"])
    return stress.mean(), stress.std()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("directory", type=Path, nargs="?", default=Path())
    directory = parser.parse_args().directory
    tables = {name: read(directory / name) for name in CURVES}

    plt.rcParams.update({"font.size": 13, "axes.labelsize": 15, "axes.spines.top": False,
                         "axes.spines.right": False, "legend.frameon": False,
                         "mathtext.fontset": "cm", "savefig.dpi": 200})
    fig, ax = plt.subplots(figsize=(8, 4.6), layout="constrained")
    for name, (label, colour) in CURVES.items():
        table = tables[name]
        mean, deviation = late(table)
        ax.plot(table["strain"], table["stress"], color=colour, lw=1.8, label=label)
        print(f"{label:14s} stress {mean:.4g}, standard deviation {deviation:.2g} "
              f"(strain {0.5 * table['strain'][-1]:.3g} to {table['strain'][-1]:.3g})")
    ax.axhline(0, color="0.7", lw=0.8, zorder=0)
    ax.set(xlim=(0, None), xlabel="strain", ylabel=r"stress of the springs  $-P_{xy}$")
    ax.legend()
    fig.savefig(directory / "shear.png")
    print("picture:", directory / "shear.png")


if __name__ == "__main__":
    main()
