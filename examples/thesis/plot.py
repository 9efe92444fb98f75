#!/usr/bin/env python3
"""Figures and tables of the runs of run.py, by what lammps_foam.analysis has; run.py calls draw().

    python3 plot.py DIR                           of small runs; figures go into DIR
    python3 plot.py DIR --full --out FOLDER       of runs at the thesis' sizes
    python3 plot.py DIR --full --figure exponents avalanches

Runs that are not complete are left out, so figures can be drawn at any time. Tables keep what stands there of the
separation in runs that are not in DIR, so these long runs may be made in several places. Each figure is written as PNG
and PDF, with its numbers as CSV. runs.csv has what each run took, summary.csv compares with what the thesis has.
"""
from __future__ import annotations

import argparse
from pathlib import Path

import draw_avalanches
import draw_exponents
import draw_fewer
import draw_questions
import draw_separation
from common import Place, compare, end_of, minutes

PARTS = {"exponents": draw_exponents, "avalanches": draw_avalanches, "separation": draw_separation,
         "fewer": draw_fewer, "questions": draw_questions}


def draw(directory: Path, figures: dict[str, list[str]], out: Path | None = None, pdf: bool = True,
         command: str = "run.py") -> None:
    """figures: {name: names of runs}; figures whose runs are not there are left out."""
    place = Place(directory, out or directory, pdf)
    place.out.mkdir(parents=True, exist_ok=True)
    for name, wanted in figures.items():
        here = [run for run in wanted if place.has(run)]
        print(f"{name}: {len(here)} of {len(wanted)} runs", flush=True)
        if here:
            compare(place, PARTS[name].draw(place, here), f"{command} --figure {name}")


def list_runs(place: Place, wanted) -> None:
    """runs.csv: each run of run.py, with what it took, or that it is not there yet."""
    known = {row["run"]: row for row in place.read("runs")}
    rows = []
    for run in wanted:
        row = {"run": run.name, "gas fraction": f"{run.phi:.3f}", "κ": f"{run.kappa:g}", "seed": f"{run.seed}",
               "bubbles": f"{run.bubbles} to {run.end}"}
        if place.has(run.name):
            steps, tau, _ = end_of(place.run(run.name))
            row |= {"steps": f"{steps}", "last τ": f"{tau:.0f}", "minutes": f"{minutes(place.run(run.name)):.0f}"}
        else:    # it may have been done elsewhere
            row |= {"steps": "not yet run", "last τ": "", "minutes": ""}
            before = known.get(run.name, row)
            if all(before[key] == row[key] for key in ("gas fraction", "κ", "seed", "bubbles")):
                row = dict(before)
        rows.append(row)
    place.write(rows, "runs")


def main() -> None:
    import run
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("runs", type=Path, metavar="DIR", help="the --out of run.py")
    parser.add_argument("--out", type=Path, metavar="FOLDER", help="of figures and tables (default: DIR)")
    parser.add_argument("--figure", nargs="+", choices=PARTS, default=list(PARTS), help="figures (default: all)")
    parser.add_argument("--full", action="store_true", help="runs of run.py --full")
    parser.add_argument("--no-pdf", action="store_true", help="PNG alone")
    args = parser.parse_args()
    if not args.runs.is_dir():
        parser.error(f"{args.runs} is no directory; it should be the --out of run.py")
    seeds = sorted({int(path.name[8:]) for path in args.runs.glob("phi?.??-*") if path.name[8:].isdigit()}) or [1995]
    figures = {name: runs_of(args.full, seeds) for name, runs_of in run.FIGURES.items()}
    command = "run.py --full" if args.full else "run.py"
    draw(args.runs, {name: [one.name for one in figures[name]] for name in args.figure}, args.out, not args.no_pdf,
         command)
    unique = {one.name: one for wanted in figures.values() for one in wanted}
    list_runs(Place(args.runs, args.out or args.runs), unique.values())


if __name__ == "__main__":
    main()
