#!/usr/bin/env python3
"""Bounces of in.bounce over scenes, models and steps, and figures of them by plot.py.

    python3 run.py --lmp lmp --out DIR              scenes, variants of the model, sizes of steps: six minutes
    python3 run.py --lmp lmp --out DIR --full       and a map of radii and tilts: a quarter of an hour

A run that is complete is not done again, so that this can be stopped and started; --dry-run lists the runs. plot.py
needs the Python package lammps_foam (pip install . in the top directory).
"""
from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
import json
from pathlib import Path
import shlex
import subprocess
import sys
import time

SCRIPT = Path(__file__).resolve().with_name("in.bounce")
Settings = dict[str, object]

# radius in mm, tilt in degrees: the three of the source, a small bubble and a steep wall that should not rebound
SCENES = [(0.6, 20), (0.6, 30), (0.8, 45), (0.3, 30), (0.6, 70)]
FILMS = ("published", "derived")
DRAGS = ("contaminated", "clean")
SPRINGS: Settings = {"viscous": "none", "lubrication": "no", "tangential": "no"}
# steps of the bounces, and a line each 0.1 ms: a film of `derived` is 24 times as stiff when it closes
FINE: dict[str, Settings] = {"published": {"dt": 2e-6, "every": 50, "report": 1000000},
                             "derived": {"dt": 2e-7, "every": 500, "report": 1000000}}

# the trade of steps: what is run
TRADE: dict[str, Settings] = {
    "springs": {"R": 0.6e-3, "tilt": 30, **SPRINGS},
    "published": {"R": 0.6e-3, "tilt": 30},
    "derived": {"R": 0.6e-3, "tilt": 30, "viscous": "derived"},
    "small": {"R": 0.05e-3, "tilt": 30, "time": 0.2},
    "small-derived": {"R": 0.05e-3, "tilt": 30, "time": 0.2, "viscous": "derived"},
}
GRID = 1e-3       # seconds between the times at which steps are compared
PARTS = [2, 4, 10, 20, 40, 100, 200, 400, 1000, 2000, 4000]    # steps in GRID, where all are equal
TOLERANCES = [1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 1e-8]


@dataclass(frozen=True)
class Run:
    name: str
    words: tuple[tuple[str, str], ...]

    @classmethod
    def of(cls, name: str, settings: Settings) -> Run:
        return cls(name, tuple((key, f"{value:g}" if isinstance(value, float) else str(value))
                               for key, value in settings.items()))

    @property
    def settings(self) -> dict[str, str]:
        return dict(self.words)

    def arguments(self) -> list[str]:
        return [word for key, value in self.words for word in ("-var", key, value)]


def scene(R: float, tilt: float) -> str:
    return f"{R:g}mm-{tilt:g}"


def bounces() -> Iterator[Run]:
    """Scenes by both viscous forces and drags; those of the source also without history of h0, and the exact film."""
    for (R, tilt), film, drag in product(SCENES, FILMS, DRAGS):
        base: Settings = {"R": R * 1e-3, "tilt": tilt, "viscous": film, "drag": drag, **FINE[film]}
        name = f"bounce/{scene(R, tilt)}-{film}-{drag}"
        yield Run.of(name, base)
        if (R, tilt) in SCENES[:3]:
            yield Run.of(f"{name}-current", {**base, "h0": "current"})
            yield Run.of(f"{name}-exact", {**base, "integral": "exact"})
    for (R, tilt), drag in product(SCENES[:3], DRAGS):
        base = {"R": R * 1e-3, "tilt": tilt, "drag": drag}
        name = f"variant/{scene(R, tilt)}"
        yield Run.of(f"{name}-springs-{drag}", {**base, **FINE["published"], **SPRINGS})
        for film in FILMS:
            yield Run.of(f"{name}-{film}-{drag}", {**base, "viscous": film, **FINE[film], "tangential": "no"})


def trade() -> Iterator[Run]:
    """Fixed steps, explicit and with implicit drag, and steps chosen by tolerances."""
    for name, settings in TRADE.items():
        for (kind, implicit), n in product((("explicit", "no"), ("implicit", "yes")), PARTS):
            yield Run.of(f"trade/{name}-{kind}-{n}",
                         {**settings, "implicit": implicit, "dt": GRID / n, "every": n, "report": 1000000})
        for tol in TOLERANCES:
            yield Run.of(f"trade/{name}-chosen-{tol:g}", {**settings, "tol": tol, "every": 1, "report": 1000000})


def chart() -> Iterator[Run]:
    """Radii and tilts, for a map of where bubbles rebound."""
    for film, drag, R, tilt in product(FILMS, DRAGS, range(2, 11), range(0, 81, 10)):
        yield Run.of(f"map/{scene(R / 10, tilt)}-{film}-{drag}",
                     {"R": R * 1e-4, "tilt": tilt, "viscous": film, "drag": drag, "time": 0.5, "dt": 5e-6, "every": 50,
                      "report": 1000000})


GROUPS = {"bounce": bounces, "trade": trade, "map": chart}


def command_words(command: str) -> list[str]:
    """Words of the command, paths made absolute, since LAMMPS will run in another directory."""
    return [str(Path(word).absolute()) if "/" in word and Path(word).exists() else word
            for word in shlex.split(command)]


def hours(seconds: float) -> str:
    if seconds > 5400:
        return f"{seconds / 3600:.1f} h"
    return f"{seconds / 60:.0f} min" if seconds > 90 else f"{seconds:.0f} s"


def do(run: Run, lmp: list[str], directory: Path) -> None:
    """One run in its directory; it is complete only if LAMMPS came to its end. An unstable step may end it: that is a
    result of the trade, and its directory says so."""
    directory.mkdir(parents=True, exist_ok=True)
    (directory / "settings.json").write_text(json.dumps(run.settings, indent=1) + "\n")
    command = [*lmp, "-in", str(SCRIPT), "-log", "log.bounce", *run.arguments()]
    try:
        with (directory / "screen").open("w") as screen:
            status = subprocess.run(command, cwd=directory, stdin=subprocess.DEVNULL, stdout=screen,
                                    stderr=subprocess.STDOUT).returncode
    except FileNotFoundError:
        sys.exit(f"cannot start LAMMPS: there is no program {command[0]} (option --lmp)")
    blown = run.name.startswith("trade/") and "ERROR: Lost atoms" in (directory / "screen").read_text()
    if status != 0 and not blown:
        sys.exit(f"LAMMPS stopped with status {status}: see {directory / 'screen'}")
    (directory / "complete").write_text(shlex.join(run.arguments()) + "\n" + ("unstable\n" if blown else ""))


def is_complete(run: Run, directory: Path) -> bool:
    """By the same arguments: a run of others must not pass for it."""
    done = directory / "complete"
    if not done.exists():
        return False
    if done.read_text().splitlines()[0].strip() != shlex.join(run.arguments()):
        sys.exit(f"{directory} has a run of other settings ({done.read_text().strip()}): choose another --out")
    return True


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--lmp", default="lmp", metavar="COMMAND",
                        help='how to start LAMMPS, as one string (default "%(default)s")')
    parser.add_argument("--out", default="out", type=Path, metavar="DIR", help="where everything is written")
    parser.add_argument("--full", action="store_true", help="also the map of radii and tilts")
    parser.add_argument("--only", nargs="+", choices=GROUPS, help="these groups of runs (default: bounce, trade)")
    parser.add_argument("--dry-run", action="store_true", help="list the runs, and end")
    parser.add_argument("--no-plots", action="store_true", help="runs alone")
    args = parser.parse_args()

    groups = args.only or (list(GROUPS) if args.full else ["bounce", "trade"])
    wanted = [run for group in groups for run in GROUPS[group]()]
    if args.dry_run:
        for run in wanted:
            print(f"{run.name:44}", *run.arguments())
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
