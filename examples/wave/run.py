#!/usr/bin/env python3
"""Waves by in.wave, and figures by plot.py.

    python3 run.py --lmp lmp --out DIR                          dr 1/40 to 1/100: some hours on two cores
    python3 run.py --lmp lmp --out DIR --only steepness         some of them
    python3 run.py --lmp "lmp -k on g 1 -sf kk" --out DIR --full        dr 1/300 too, for a GPU

wave: one that breaks, at several spacings. steepness: which ones break. seeds: the same with other random numbers. A
run that is complete is not done again, so that this can be stopped and started; --dry-run lists the runs.
Needs the Python package lammps_foam (pip install . in the top directory).
"""
from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
import sys

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent / "plume"))
from common import Run, parser_of, run_all    # noqa: E402

GROUPS = ("wave", "steepness", "seeds")
LONG = {"T": "5", "frame": "0.05"}
STEEP = {"40": ("0.30", "0.35", "0.40", "0.45", "0.50"), "60": ("0.30", "0.40", "0.50")}     # those of wave have 0.55
SEEDS = {"2": "langevin 4 breakup 5 entrain 6", "3": "langevin 7 breakup 8 entrain 9"}


def runs(groups: list[str], full: bool) -> Iterator[Run]:
    def run(name: str, words: dict[str, str]) -> Run:
        return Run(name, str(HERE / "in.wave"), tuple({**words, **LONG}.items()))

    if "wave" in groups:
        for n in ("40", "60"):
            yield run(f"wave/{n}", {"n": n})
        for n in ("100", "300") if full else ("100",):
            yield run(f"wave/{n}", {"n": n, "restart": "100"})
    if "steepness" in groups:
        for n, every in STEEP.items():
            for steep in every:
                yield run(f"steepness/{steep}-{n}", {"n": n, "steep": steep, "report": "5"})
    if "seeds" in groups:
        for name, seeds in SEEDS.items():
            yield run(f"seeds/{name}", {"n": "60", "bubbles": seeds})


def main() -> None:
    args = parser_of(__doc__ or "", GROUPS).parse_args()
    run_all(list(runs(args.only, args.full)), args)
    if not (args.dry_run or args.no_plots):
        import plot
        plot.draw(args.out)


if __name__ == "__main__":
    main()
