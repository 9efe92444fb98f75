#!/usr/bin/env python3
"""Random close packing of the sizes that foams have in their late states: packing.lmp with radii of run.py's snapshots.

    python3 packing.py DIR --lmp lmp          a packing of 2000 bubbles: a minute

DIR is the --out of run.py. Radii are those of the first late state with at most 2000 bubbles. Writes DIR/packing/NAME,
which plot.py reads. A packing that is there is not made again.
"""
from __future__ import annotations

import argparse
from pathlib import Path
import re
import subprocess
import sys

import numpy as np

from lammps_foam.analysis import sizes
from lammps_foam.analysis.read import read_frames

from run import command_words
from states import NAME, is_late

MOST = 2000             # bubbles of a packing
SEEDS = (1, 2, 3)       # places
NEAR = 0.04             # jammed packings at gas fractions up to so much above the last one take part in the fit
PRESSED = 1.0e-5        # pressure, in units of sigma0 <R> / R^2, below which a packing is not jammed


def radii_of(directory: Path) -> np.ndarray | None:
    """Radii over their mean, of the first late state with at most MOST bubbles; None if there is none."""
    frames = [frame.radius for frame in read_frames(directory / "left.lammpstrj")]
    first = int(re.search(r"-var N (\d+)", (directory / "complete").read_text()).group(1))
    late = [R for R in frames if len(R) <= MOST and is_late(len(R), first)]
    return late[0] / late[0].mean() if late else None


def pack(lmp: list[str], radii: np.ndarray, seed: int, place: Path) -> None:
    if (place / "complete").exists():
        return
    place.mkdir(parents=True, exist_ok=True)
    np.savetxt(place / "radii.txt", radii, fmt="%.8g")
    command = [*lmp, "-in", str(Path(__file__).resolve().with_name("packing.lmp")), "-var", "N", str(len(radii)),
               "-var", "seed", str(seed)]
    with (place / "screen").open("w") as screen:
        status = subprocess.run(command, cwd=place, stdin=subprocess.DEVNULL, stdout=screen,
                                stderr=subprocess.STDOUT).returncode
    if status != 0:
        sys.exit(f"LAMMPS stopped with status {status}: see {place / 'screen'}")
    (place / "complete").write_text("")


def jamming(place: Path) -> float:
    """Gas fraction at which the pressure, a straight line in it (law spring), is gone; nan if too few are jammed."""
    phi, pressure, _ = np.loadtxt(place / "jam.txt").reshape(-1, 3).T
    jammed = pressure > PRESSED
    near = jammed & (phi < phi[jammed].min() + NEAR) if jammed.any() else jammed
    if np.count_nonzero(near) < 3:
        return float("nan")
    slope, height = np.polyfit(phi[near], pressure[near], 1)
    return float(-height / slope)


def packings(directory: Path) -> dict[tuple[str, float], dict[str, float]]:
    """Liquid fraction of random close packing, for the sizes of each foam that was packed; over seeds."""
    found: dict[tuple[str, float], list[tuple[float, float]]] = {}
    for done in sorted((directory / "packing").glob("*/complete")):
        match = NAME.match(done.parent.name)
        radii = np.loadtxt(done.parent / "radii.txt")
        found.setdefault((match["series"], float(match["fraction"])), []).append(
            (1 - jamming(done.parent), float(sizes.moments(radii)[0])))
    return {key: {"rcp": float(np.mean([a for a, _ in pairs])), "width": pairs[0][1], "seeds": len(pairs),
                  "rcp_error": float(np.std([a for a, _ in pairs], ddof=1) / np.sqrt(len(pairs))) if len(pairs) > 1
                  else float("nan")} for key, pairs in found.items()}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("directory", type=Path, metavar="DIR", help="the --out of run.py")
    parser.add_argument("--lmp", default="lmp", metavar="COMMAND",
                        help='how to start LAMMPS, as one string (default "%(default)s")')
    parser.add_argument("--series", nargs="+", default=["spring", "sticky0.05"],
                        help="of run.py (default: %(default)s)")
    parser.add_argument("--fractions", nargs="+", type=float, metavar="X", help="liquid fractions (default: all)")
    args = parser.parse_args()
    for done in sorted(args.directory.glob("*/complete")):
        match = NAME.match(done.parent.name)
        if not match or match["series"] not in args.series or match["seed"] != "1":
            continue
        if args.fractions and float(match["fraction"]) not in args.fractions:
            continue
        radii = radii_of(done.parent)
        for seed in SEEDS if radii is not None else ():
            name = f"{match['series']}-{match['fraction']}-{seed}"
            print(name, flush=True)
            pack(command_words(args.lmp), radii, seed, args.directory / "packing" / name)


if __name__ == "__main__":
    main()
