#!/usr/bin/env python3
"""Speeds, as Weber numbers rho v^2 R / sigma, at which a centre passes a wall or another bubble: eq. 9 is soft.

    python3 weber.py --lmp lmp --out DIR      some minutes; writes weber.csv

By bisection, to 1 % of the number.
"""
from __future__ import annotations

import argparse
import math
from pathlib import Path
import subprocess
import sys

from lammps_foam.analysis import table

from run import command_words

SCRIPT = Path(__file__).resolve().with_name("pass.lmp")
SIGMA, RHO = 0.03, 1000.0
MODELS = {"no viscous forces": ("none", "no"), "published": ("published", "yes"), "derived": ("derived", "yes")}


def passes(lmp: list[str], partner: str, R: float, weber: float, viscous: str, lubrication: str) -> bool:
    settings = {"with": partner, "R": R, "speed": math.sqrt(weber * SIGMA / (RHO * R)), "viscous": viscous,
                "lubrication": lubrication, "sigma": SIGMA}
    words = [word for key, value in settings.items() for word in ("-var", key, f"{value}")]
    done = subprocess.run([*lmp, "-in", str(SCRIPT), "-log", "none", *words], stdin=subprocess.DEVNULL,
                          capture_output=True, text=True)
    lines = done.stdout.splitlines()
    if done.returncode or not {"passed yes", "passed no"} & set(lines):
        sys.exit(f"LAMMPS stopped with status {done.returncode}:\n{done.stdout[-1000:]}")
    return "passed yes" in lines


def limit(lmp: list[str], partner: str, R: float, viscous: str, lubrication: str) -> float:
    low, high = 4.0, 20.0
    while high - low > 0.01 * high:
        middle = 0.5 * (low + high)
        if passes(lmp, partner, R, middle, viscous, lubrication):
            high = middle
        else:
            low = middle
    return 0.5 * (low + high)


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--lmp", default="lmp", metavar="COMMAND", help="how to start LAMMPS (default %(default)s)")
    parser.add_argument("--out", type=Path, default=Path(), metavar="DIR", help="where everything is written")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    lmp = command_words(args.lmp)
    rows = [(partner, R) for partner in ("pair", "wall") for R in (0.6e-3, 3e-3)]
    columns = {"with": [row[0] for row in rows], "R_mm": [1e3 * row[1] for row in rows],
               **{name: [limit(lmp, *row, *model) for row in rows] for name, model in MODELS.items()}}
    table.show(columns)
    table.write(columns, args.out / "weber.csv")


if __name__ == "__main__":
    main()
