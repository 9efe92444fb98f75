#!/usr/bin/env python3
"""What laws, drags and walls cost and change: a foam of 10^4 bubbles relaxes and coarsens with each.

    python3 doc/scripts/costs.py --lmp "./foam lmp" [--bubbles N] [--what laws|drags|walls|tolerances]

Prints a table: processor time for a bubble and an evaluation (one core; the same run without coarsening is taken off),
evaluations until a tenth of the bubbles has vanished, and the state there. The machine should do nothing else.
"""

import argparse
from pathlib import Path
import re
import resource
import shlex
import subprocess

ABM, RKC = "abm 1e-3 norm rms", "rkc 1e-3"
LAWS = [
    (dim, law, "static", "no", style)
    for dim, style in ((2, ABM), (2, RKC), (3, RKC))
    for law in ("spring", "power 2.5", "sticky 0.05", "surface 1.0")
    if dim == 3 or law != "surface 1.0"
]
DRAGS = [
    (dim, "spring", drag, "no", style)
    for dim in (2, 3)
    for style in (ABM, RKC)
    for drag in ("static", "neighbor", "neighbor solve", "contact 0.1", "contact 1.0", "contact 10.0")
]
WALLS = [(2, "spring", "static", walls, RKC) for walls in ("no", "yes")]
TOLERANCES = [
    (2, law, drag, "no", style)
    for law, drag in (
        ("spring", "static"),
        ("sticky 0.05", "static"),
        ("spring", "contact 1.0"),
        ("spring", "neighbor solve"),
    )
    for style in ("rkc 1e-2", RKC, "rkc 1e-4", "abm 1e-2 norm rms", ABM, "abm 1e-4 norm rms")
    if drag != "neighbor solve" or "abm" in style
]


def run(lmp, bubbles, nmin, dim, law, drag, walls, style):
    """Lines that in.costs prints, by their first word, and seconds of processor time."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    script = Path(__file__).resolve().with_name("in.costs")
    done = subprocess.run(
        [
            *shlex.split(lmp),
            "-in",
            str(script),
            "-log",
            "none",
            "-var",
            "N",
            str(bubbles),
            "-var",
            "dim",
            str(dim),
            "-var",
            "law",
            law,
            "-var",
            "drag",
            drag,
            "-var",
            "walls",
            walls,
            "-var",
            "style",
            style,
            "-var",
            "nmin",
            str(nmin),
        ],
        check=False,
        capture_output=True,
        text=True,
    )
    if done.returncode:
        raise SystemExit(f"LAMMPS failed: {shlex.join(done.args)}\n{done.stdout[-2000:]}")
    lines = {
        m[1]: [float(word) for word in m[2].split()]
        for m in re.finditer(r"^(RELAXED|COARSE) (.*)$", done.stdout, re.M)
    }
    return lines, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lmp", default="lmp")
    parser.add_argument("--bubbles", type=int, default=10000)
    parser.add_argument(
        "--what", choices=("laws", "drags", "walls", "tolerances"), nargs="*", default=("laws", "drags", "walls")
    )
    args = parser.parse_args()
    tables = dict(laws=LAWS, drags=DRAGS, walls=WALLS, tolerances=TOLERANCES)
    for what in args.what:
        print(
            f"{what}, {args.bubbles} bubbles\n{'':52s}ns per bubble     evaluations  contacts   pressure     tau    <R>"
        )
        for way in tables[what]:
            _, start = run(args.lmp, args.bubbles, args.bubbles, *way)
            lines, whole = run(args.lmp, args.bubbles, round(0.9 * args.bubbles), *way)
            relaxed, coarse = lines["RELAXED"], lines["COARSE"]
            evaluations = coarse[0] - relaxed[0]
            cost = 1e9 * (whole - start) / evaluations / (0.95 * args.bubbles)
            dim, law, drag, walls, style = way
            name = f"{dim}D {law}, {drag}{', walls' if walls == 'yes' else ''}, {style}"
            print(
                f"{name:52s}{cost:8.0f}{evaluations:20.0f}{coarse[1]:10.3f}{coarse[2]:12.5f}{coarse[3]:9.4f}{coarse[5]:8.4f}",
                flush=True,
            )


if __name__ == "__main__":
    main()
