#!/usr/bin/env python3
"""The elastic force of two equal bubbles, beside Yade's.

    python3 elastic.py --lmp lmp --yade yade --out DIR      seconds; writes elastic.csv

Yade (https://yade-dem.org, Debian's package yade) has BubbleMat after Chan, Klaseboer & Manica, Soft Matter 7, 2235
(2011): for equal bubbles the overlap is (F / 2 pi sigma) ln (8 pi sigma R / F), the elastic force alone. The column
chan is that formula solved here, in case that there is no Yade.
"""
from __future__ import annotations

import argparse
import csv
import os
from pathlib import Path
import re
import shlex
import subprocess
import sys

import numpy as np
from scipy.optimize import brentq

from lammps_foam.analysis import table

from run import command_words

HERE = Path(__file__).resolve().parent


def lammps(lmp: list[str], directory: Path, R: float, sigma: float, elastic: str) -> tuple[list[float], list[float]]:
    """Overlaps over R, and forces in N."""
    words = ["-var", "R", str(R), "-var", "sigma", str(sigma), "-var", "elastic", elastic]
    done = subprocess.run([*lmp, "-in", str(HERE / "press.lmp"), "-log", "none", *words], cwd=directory,
                          stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"LAMMPS stopped with status {done.returncode}:\n{done.stdout[-1000:]}")
    with (directory / "press.csv").open(newline="") as file:
        rows = [(float(row["overlap"]), float(row["force"])) for row in csv.DictReader(file)]
    return [row[0] for row in rows], [row[1] for row in rows]


def yade(command: str, R: float, sigma: float, overlaps: list[float]) -> list[float]:
    settings = {"R": str(R), "SIGMA": str(sigma), "OVERLAPS": " ".join(map(str, overlaps))}
    done = subprocess.run([*shlex.split(command), "-n", "-x", str(HERE / "yade_pair.py")], capture_output=True,
                          text=True, stdin=subprocess.DEVNULL, env={**os.environ, **settings})
    forces = [float(found) for found in re.findall(r"^force \S+ (\S+)", done.stdout, re.M)]
    if len(forces) != len(overlaps):
        sys.exit(f"Yade gave {len(forces)} forces for {len(overlaps)} overlaps:\n{(done.stdout + done.stderr)[-1000:]}")
    return forces


def chan(overlap: float, R: float, sigma: float) -> float:
    """Force at an overlap in m; the branch that goes through 0."""
    most = 8.0 * np.pi * sigma * R / np.e    # at which the overlap of the formula is the largest
    return float(brentq(lambda F: F / (2 * np.pi * sigma) * np.log(8 * np.pi * sigma * R / F) - overlap,
                        1e-12 * most, most, xtol=1e-20, rtol=1e-12))


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--lmp", default="lmp", metavar="COMMAND", help="how to start LAMMPS (default %(default)s)")
    parser.add_argument("--yade", metavar="COMMAND", help="how to start Yade; without, there is no column of it")
    parser.add_argument("--R", type=float, default=0.6e-3, help="radius in m (default %(default)s)")
    parser.add_argument("--sigma", type=float, default=0.07, help="surface tension in N/m (default %(default)s)")
    parser.add_argument("--out", type=Path, default=Path(), metavar="DIR", help="where everything is written")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    lmp = command_words(args.lmp)
    overlaps, quadratic = lammps(lmp, args.out, args.R, args.sigma, "quadratic")
    spring = lammps(lmp, args.out, args.R, args.sigma, "spring")[1]
    columns = {"overlap": overlaps, "quadratic": quadratic, "spring": spring,
               "chan": [chan(x * args.R, args.R, args.sigma) for x in overlaps]}
    if args.yade:
        columns["yade"] = yade(args.yade, args.R, args.sigma, overlaps)
    other = columns["yade" if args.yade else "chan"]
    columns["quadratic_over_it"] = [a / b for a, b in zip(quadratic, other)]
    table.show(columns)
    table.write(columns, args.out / "elastic.csv")


if __name__ == "__main__":
    main()
