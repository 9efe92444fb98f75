#!/usr/bin/env python3
"""Foams of several liquid fractions and laws by in.microgravity, and figures of them by plot.py.

    python3 run.py --lmp "mpiexec -n 2 lmp" --out DIR              2000 bubbles each: ten minutes
    python3 run.py --lmp "mpiexec -n 2 lmp" --out DIR --full       30 000 bubbles each: some hours

A run that is complete is not done again, so that this can be stopped and started; --dry-run lists the runs. plot.py
needs the Python package lammps_foam (pip install . in the top directory).
"""
import argparse
from dataclasses import dataclass
from pathlib import Path
import shlex
import subprocess
import sys
import time

SCRIPT = Path(__file__).resolve().with_name("in.microgravity")
SERIES = {                 # name: law of contact, law of the exchange through the liquid, kappa
    "spring": ("spring", "lsw", 0.1),
    "sticky0.01": ("sticky 0.01", "lsw", 0.1),
    "sticky0.05": ("sticky 0.05", "lsw", 0.1),
    "area": ("spring", "area", 0.1),
    "sticky0.01-area": ("sticky 0.01", "area", 0.1),
    "kappa0.01": ("spring", "lsw", 0.01),
    "kappa1": ("spring", "lsw", 1.0),
    "films": ("spring", "lsw", 0.0),
}
CHECKS = {                 # the same, with one more thing changed: does it matter?
    "slow": (*SERIES["spring"], "K", 1.0e-4),
    "sticky0.05-slow": (*SERIES["sticky0.05"], "K", 1.0e-4),
    "fine": (*SERIES["spring"], "tol", 1.0e-4),
    "narrow": (*SERIES["spring"], "std", 0.2),
}
ALL = {**SERIES, **CHECKS}
FRACTIONS = [0.15, 0.20, 0.25, 0.30, 0.33, 0.36, 0.40, 0.45, 0.50]


@dataclass(frozen=True)
class Run:
    series: str
    liquid_fraction: float
    seed: int
    full: bool

    @property
    def name(self):
        return f"{self.series}-{self.liquid_fraction:.2f}-{self.seed}"

    @property
    def bubbles(self):
        return 30000 if self.full else 2000

    def arguments(self):
        law, liquid, kappa, *more = ALL[self.series]
        left = [15000, 10000, 7500, 5000, 3750, 2500, 1875, 1400, 1000] if self.full else [1000, 700, 500, 350, 250]
        words = ["-var", "N", self.bubbles, "-var", "left", *left, "-var", "liquidfraction", self.liquid_fraction]
        words += ["-var", "law", law, "-var", "liquid", liquid, "-var", "kappa", kappa, "-var", "seed", self.seed]
        if more:
            words += ["-var", *more]
        return list(map(str, words))


def command_words(command):
    """Words of the command, paths made absolute, since LAMMPS will run in another directory."""
    return [str(Path(word).absolute()) if "/" in word and Path(word).exists() else word
            for word in shlex.split(command)]


def hours(seconds):
    if seconds > 5400:
        return f"{seconds / 3600:.1f} h"
    return f"{seconds / 60:.0f} min" if seconds > 90 else f"{seconds:.0f} s"


def do(run, lmp, directory):
    """One run in its directory; it is complete only if LAMMPS came to its end."""
    directory.mkdir(parents=True, exist_ok=True)
    command = [*lmp, "-in", str(SCRIPT), "-log", "log.microgravity", *run.arguments()]
    try:
        with (directory / "screen").open("w") as screen:
            status = subprocess.run(command, cwd=directory, stdin=subprocess.DEVNULL, stdout=screen,
                                    stderr=subprocess.STDOUT).returncode
    except FileNotFoundError:
        sys.exit(f"cannot start LAMMPS: there is no program {command[0]} (option --lmp)")
    if status != 0:
        sys.exit(f"LAMMPS stopped with status {status}: see {directory / 'screen'}")
    (directory / "complete").write_text(shlex.join(run.arguments()) + "\n")


def is_complete(run, directory):
    """By the same arguments: a run of others must not pass for it."""
    done = directory / "complete"
    if not done.exists():
        return False
    if done.read_text().strip() != shlex.join(run.arguments()):
        sys.exit(f"{directory} has a run of other settings ({done.read_text().strip()}): choose another --out")
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lmp", default="lmp", metavar="COMMAND",
                        help='how to start LAMMPS, as one string (default "%(default)s")')
    parser.add_argument("--out", default="out", type=Path, metavar="DIR", help="where everything is written")
    parser.add_argument("--full", action="store_true", help="30 000 bubbles in the place of 2000")
    parser.add_argument("--series", nargs="+", choices=ALL,
                        help="laws (default: spring, sticky0.05; with --full all but checks)")
    parser.add_argument("--fractions", nargs="+", type=float, metavar="X",
                        help="liquid fractions (default: 0.20 0.30 0.36 0.45; with --full 0.15 to 0.50)")
    parser.add_argument("--seeds", nargs="+", type=int, default=[1])
    parser.add_argument("--dry-run", action="store_true", help="list the runs, and end")
    parser.add_argument("--no-plots", action="store_true", help="runs alone")
    args = parser.parse_args()

    series = args.series or (list(SERIES) if args.full else ["spring", "sticky0.05"])
    fractions = args.fractions or (FRACTIONS if args.full else [0.20, 0.30, 0.36, 0.45])
    wanted = [Run(name, fraction, seed, args.full) for seed in args.seeds for name in series for fraction in fractions]
    if args.dry_run:
        for run in wanted:
            print(f"{run.name:24}", *run.arguments())
        return
    missing = [run for run in wanted if not is_complete(run, args.out / run.name)]
    print(f"{len(wanted)} runs, {len(wanted) - len(missing)} of them complete", flush=True)
    lmp, started = command_words(args.lmp), time.perf_counter()
    for done, run in enumerate(missing):
        spent = time.perf_counter() - started
        left = f"; about {hours(spent * (len(missing) - done) / done)} to go" if done else ""
        print(f"run {done + 1} of {len(missing)}: {run.name}{left}", flush=True)
        do(run, lmp, args.out / run.name)
    if not args.no_plots:
        import plot
        plot.draw(args.out)


if __name__ == "__main__":
    main()
