#!/usr/bin/env python3
"""Plumes by in.plume, and figures by plot.py.

    python3 run.py --lmp lmp --out DIR                          dr 1/25 and 1/50: some hours on two cores
    python3 run.py --lmp lmp --out DIR --only closures          some of them
    python3 run.py --lmp "lmp -k on g 1 -sf kk" --out DIR --full        dr 1/100 too, for a GPU

plume: two spacings. momentum: the momentum as the source prints it. sizes: bubbles of several sizes, with the process
of Langevin and without. closures: what each of them does and costs. A run that is complete is not done again, so that
this can be stopped and started; --dry-run lists the runs. Times of closures are compared, so run these one by one.
Needs the Python package lammps_foam (pip install . in the top directory).
"""
from __future__ import annotations

from collections.abc import Iterator

from common import HERE, Run, parser_of, run_all

GROUPS = ("plume", "momentum", "sizes", "closures")
COARSE = {"n": "25", "T": "10", "frame": "0.1"}
NOTHING = "surface yes"                                # words of fix bubble/flow that change nothing
SIZES: dict[str, dict[str, str]] = {
    "langevin": {"spread": "0.3"},
    "without": {"spread": "0.3", "bubbles": NOTHING},
}
CLOSURES: dict[str, dict[str, str]] = {                # what differs from the first of plume
    "les none": {"les": "none"},
    "les smagorinsky": {"les": "smagorinsky 0.13"},
    "no langevin": {"bubbles": NOTHING},
    "no lift": {"bubbles": "langevin 1 lift no"},
    "no virtual mass": {"bubbles": "langevin 1 virtual no"},
    "breakup": {"bubbles": "langevin 1 breakup 2"},
    "viscosity published": {"bubbles": "langevin 1 viscosity published"},
    "drag alone": {"les": "none", "bubbles": "lift no virtual no"},
}


def runs(groups: list[str], full: bool) -> Iterator[Run]:
    def run(name: str, words: dict[str, str]) -> Run:
        return Run(name.replace(" ", "-"), str(HERE / "in.plume"), tuple(words.items()))

    if "plume" in groups:
        yield run("plume/25", COARSE)
        for n in ("50", "100") if full else ("50",):
            yield run(f"plume/{n}", {**COARSE, "n": n, "restart": "100"})
    if "momentum" in groups:
        yield run("momentum/published", {**COARSE, "momentum": "published"})
    for group, every in (("sizes", SIZES), ("closures", CLOSURES)):
        for name, words in every.items() if group in groups else ():
            yield run(f"{group}/{name}", {**COARSE, **words})


def main() -> None:
    args = parser_of(__doc__ or "", GROUPS).parse_args()
    run_all(list(runs(args.only, args.full)), args)
    if not (args.dry_run or args.no_plots):
        import plot
        plot.draw(args.out)


if __name__ == "__main__":
    main()
