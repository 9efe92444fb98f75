#!/usr/bin/env python3
"""Do the runs of the thesis' figures by lammps-foam run, and draw them with plot.py.

    python3 run.py --out DIR                                  small foams: minutes
    python3 run.py --out DIR --full --np 2                    at the thesis' sizes: a night
    python3 run.py --out DIR --full --figure exponents --seeds 1995 1996

Each run has a directory of its own with the thesis' input, foam.json, and the LAMMPS input in.foam that it means. What
the thesis' input cannot say is changed there. Relaxation and errors of steps are those of our examples (fix foam/rkc,
root mean square 1e-3), not the thesis' 1e-5 of the largest error. A run that is complete is not done again, and one
that was stopped goes on; --dry-run lists the runs. It needs the Python package lammps_foam (pip install . in the top
directory).
"""
import argparse
from dataclasses import dataclass, field
import json
from pathlib import Path
import re
import subprocess
import sys
import time


@dataclass(frozen=True)
class Run:
    name: str                  # of its directory
    phi: float
    bubbles: int
    end: int
    seed: int
    frequency: float = 0.0     # snapshots per unit of tau
    kappa: float = 0.1
    every: int = 1             # steps between lines of series.csv
    changes: tuple = field(default=())    # (old, new) parts of lines in in.foam; a blank stands for any number

    def input(self):
        """The thesis' input, nested form: its listings B.1 and B.2 but for sizes and relaxation."""
        return {
            "bubbles": {"numStart": self.bubbles, "numEnd": self.end, "radius": {"mean": 1.0, "std": 0.21}},
            "box": {"dimensionality": 2, "relativeDimensions": {"x": 1.0, "y": 1.0, "z": 1.0},
                    "wall": {"drag": 0.0, "x": 0, "y": 0, "z": 0}},
            "flow": {"impose": 0, "velocity": {"x": 0.0, "y": 0.0, "z": 0.0}, "lbb": {"x": 0.0, "y": 0.0, "z": 0.0},
                     "tfr": {"x": 1.0, "y": 1.0, "z": 1.0}},
            "constants": {"phi": {"value": self.phi}, "mu": {"value": 1.0}, "sigma": {"value": 1.0},
                          "kappa": {"value": self.kappa}, "K": {"value": 1.0e-3}},
            "errorTolerance": {"value": 1.0e-5}, "rngSeed": {"value": self.seed},
            "stabilization": {"steps": 50, "maxDeltaEnergy": 1.0},
            "snapShot": {"frequency": self.frequency, "filename": "bubbles"},
        }


def exponents(full, seeds):
    """Figure 4.1: growth exponents against the gas fraction."""
    phis = [0.80, 0.85, 0.90, 0.95, 1.00]
    if full:    # the rest later: what is done at any time makes a figure
        phis += [round(0.80 + 0.01 * n, 2) for n in range(21) if n % 5]
    return [foam(phi, full, seed) for seed in seeds for phi in phis]


def avalanches(full, seeds):
    """Figures 4.2 to 4.5: energy, its drops, and the variance of velocities."""
    return [foam(phi, full, seeds[0]) for phi in ([1.00, 0.95, 0.90, 0.87] if full else [1.00, 0.95, 0.90])]


def foam(phi, full, seed):
    return Run(f"phi{phi:.2f}-{seed}", phi, *((100000, 300) if full else (2000, 100)), seed)


DILUTED = (("relax_foam phi ${phi}", "relax_foam phi 0.9 steps ${nrelax} rounds ${rounds} limit ${limit}\n"
            "relax_foam phi ${phi}"),)


def separation(full, seeds):
    """Figures 4.6 to 4.14: does the liquid separate? With the start that is diluted, which the thesis did not try."""
    foams = [(0.851, ""), (0.851, "-diluted"), (0.876, ""), (0.840, ""), (0.865, ""), (0.852, "")]
    size = (1000000, 2000) if full else (5000, 300)
    return [Run(f"large{phi:.3f}{how}-{seeds[0]}", phi, *size, seeds[0], frequency=0.05, every=5,
                changes=DILUTED if how else ()) for phi, how in foams[:None if full else 3]]


def fewer(full, seeds):
    """Does the liquid separate with fewer bubbles, too? Those of figure 4.1 have no snapshots."""
    return [Run(f"fewer{bubbles}-{seeds[0]}", 0.85, bubbles, end, seeds[0], frequency=0.05, every=5)
            for bubbles, end in (((100000, 1000), (10000, 1000)) if full else ((2000, 300),))]


def sizes(what):
    return (("sizes normal ${mean} ${std}", f"sizes {what}"),)


FLOW = (("fix gas all", "variable ux atom 0.02*sin(2*PI*y/ly)\n"
         "fix flow all foam/flow field v_ux NULL NULL\nfix gas all"),)


def questions(full, seeds):
    """What the thesis leaves open: other kappa, other sizes, imposed flow."""
    cases = {"kappa0": {"kappa": 0.0}, "kappa0.01": {"kappa": 0.01}, "kappa1": {"kappa": 1.0},
             "equal": {"changes": sizes("normal ${mean} 0.05")},
             "lognormal": {"changes": sizes("lognormal ${mean} 0.5")},
             "bidisperse": {"changes": sizes("bidisperse ${mean} 2.0 0.5")}, "flow": {"changes": FLOW}}
    size = (100000, 300) if full else (2000, 100)
    return [foam(0.90, full, seeds[0]),
            *(Run(f"question-{name}-{seeds[0]}", 0.90, *size, seeds[0], frequency=0.05, **case)
              for name, case in cases.items())]


FIGURES = {"exponents": exponents, "avalanches": avalanches, "separation": separation, "fewer": fewer,
           "questions": questions}


# ------------------------------------------------------------------ running

def hours(seconds):
    if seconds > 5400:
        return f"{seconds / 3600:.1f} h"
    return f"{seconds / 60:.0f} min" if seconds > 90 else f"{seconds:.0f} s"


def lammps_foam(*arguments):
    """Our own command, in this Python. Ctrl-C reaches it and LAMMPS: then this ends, too."""
    command = [sys.executable, "-c", "from lammps_foam.command import main; main()", *map(str, arguments)]
    try:
        status = subprocess.run(command, stdin=subprocess.DEVNULL).returncode
    except KeyboardInterrupt:
        status = 130
    if status:
        sys.exit(status)


def prepare(run, directory):
    """foam.json and in.foam of a run, which `lammps-foam resume` then begins."""
    directory.mkdir(parents=True)
    (directory / "foam.json").write_text(json.dumps(run.input(), indent=2) + "\n")
    try:
        lammps_foam("run", directory / "foam.json", "--out", directory / "run", "--integrator", "rkc", "--gzip",
                    "--dry-run", "--", "-var", "every", run.every)
        script = directory / "run" / "in.foam"
        text = script.read_text()
        for old, new in run.changes:
            text, count = re.subn(re.escape(old).replace("\\ ", " +"), lambda _: new, text)
            if count != 1:
                sys.exit(f"{script} should have '{old}' once, and has it {count} times")
        script.write_text(text)
    except BaseException:
        (directory / "foam.json").unlink()    # is prepared again
        raise


def do(run, directory, np):
    source = directory / "foam.json"
    if not source.exists():
        prepare(run, directory)
    elif json.loads(source.read_text()) != run.input():
        sys.exit(f"{directory} has a run of other settings: choose another --out")
    lammps_foam("resume", directory / "run", "--np", np)


def is_complete(directory):
    return (directory / "run" / "complete").exists()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", default="out", type=Path, metavar="DIR", help="where everything is written")
    parser.add_argument("--figure", nargs="+", choices=FIGURES, default=list(FIGURES), help="figures (default: all)")
    parser.add_argument("--full", action="store_true", help="foams as large as those of the thesis")
    parser.add_argument("--seeds", nargs="+", type=int, default=[1995],
                        help="of the exponents: one run each; of the others the first")
    parser.add_argument("--only", nargs="+", metavar="RUN", help="some of these runs, by the names of --dry-run")
    parser.add_argument("--np", type=int, default=1, help="MPI ranks (default 1)")
    parser.add_argument("--dry-run", action="store_true", help="list the runs, and end")
    parser.add_argument("--no-plots", action="store_true", help="runs alone")
    args = parser.parse_args()

    wanted = {run.name: run for name in args.figure for run in FIGURES[name](args.full, args.seeds)}
    unknown = set(args.only or ()) - wanted.keys()
    if unknown:
        parser.error(f"no such run: {', '.join(sorted(unknown))} (--dry-run lists them)")
    wanted = {name: run for name, run in wanted.items() if not args.only or name in args.only}
    if args.dry_run:
        for run in wanted.values():
            print(f"{run.name:22}{run.bubbles:9} bubbles to {run.end}, phi {run.phi}, kappa {run.kappa}, "
                  f"seed {run.seed}")
        return
    missing = [run for run in wanted.values() if not is_complete(args.out / run.name)]
    print(f"{len(wanted)} runs, {len(wanted) - len(missing)} of them complete", flush=True)
    spent, done = 0.0, 0
    for number, run in enumerate(missing, 1):
        ahead = sum(other.bubbles for other in missing[number - 1:])
        left = f"; about {hours(spent * ahead / done)} to go for all" if done else ""
        print(f"run {number} of {len(missing)}: {run.name}, {run.bubbles} bubbles{left}", flush=True)
        started = time.perf_counter()
        do(run, args.out / run.name, args.np)
        spent += time.perf_counter() - started
        done += run.bubbles
    if not args.no_plots:
        import plot
        plot.draw(args.out, {name: [run.name for run in FIGURES[name](args.full, args.seeds)] for name in args.figure})


if __name__ == "__main__":
    main()
