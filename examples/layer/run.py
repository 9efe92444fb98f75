#!/usr/bin/env python3
"""Layers of foam by in.layer, and figures by plot.py.

    python3 run.py --lmp lmp --out DIR                     all: seven minutes on one core
    python3 run.py --lmp lmp --out DIR --only stiff        some of them
    python3 run.py --lmp lmp --out DIR --full              a wider tank, too

scene: a tank with three layers of bubbles. stiff: contacts in the plume that are as hard as bubbles, and softer ones.
liquid: a finer liquid. rules: bubbles that burst at the surface, eddies that are not resolved, walls that the liquid
sticks to. A run that is complete is not done again, so that this can be stopped and started; --dry-run lists the runs.
Times are compared, so run them one by one. Needs the Python package lammps_foam (pip install . in the top directory).
"""
from __future__ import annotations

from collections.abc import Iterator
import argparse
from pathlib import Path
import sys

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "plume"))
from common import Run, parser_of, run_all    # noqa: E402  how runs are done there
del sys.path[0]

GROUPS = ("scene", "stiff", "liquid", "rules")
VARIANTS: dict[str, dict[str, dict[str, str]]] = {       # what differs from in.layer
    "scene": {"": {"W": "0.03", "n": "12", "N": "4000", "fill": "3", "calm": "0.7", "stiff": "1"}},
    "stiff": {"1": {"stiff": "1"}, "0.1": {}, "0.02": {"stiff": "0.02"}},
    "liquid": {"n12": {"n": "12"}},
    "rules": {"bursting": {"more": "surface yes"}, "lasting": {"more": "surface yes persist 1.0e9"},
              "langevin": {"more": "surface no langevin 1"}, "noslip": {"side": "noslip"}},
}
WIDE = {"W": "0.06", "n": "24", "N": "24000", "fill": "5", "calm": "1.0"}


def runs(groups: list[str], full: bool) -> Iterator[Run]:
    def run(name: str, words: dict[str, str]) -> Run:
        return Run(name, str(HERE / "in.layer"), tuple(words.items()))

    for group in groups:
        for name, words in VARIANTS[group].items():
            yield run(f"{group}/{name}".rstrip("/"), words)
    if full:
        yield run("wide", WIDE)


def main() -> None:
    args: argparse.Namespace = parser_of(__doc__ or "", GROUPS).parse_args()
    run_all(list(runs(args.only, args.full)), args)
    if not (args.dry_run or args.no_plots):
        import plot
        plot.draw(args.out)


if __name__ == "__main__":
    main()
