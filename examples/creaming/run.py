#!/usr/bin/env python3
"""The creaming column of in.creaming, the equation of state of in.osmotic, and figures by plot.py.

    python3 run.py --lmp "mpiexec -n 2 lmp" --out DIR                     10^5 bubbles
    python3 run.py --lmp "mpiexec -n 2 lmp" --out DIR --bubbles 30000     fewer
    python3 run.py --lmp lmp --out DIR --only terms                       what each term costs: 2000 bubbles

A run that is complete is not done again, so that this can be stopped and started; --dry-run lists the runs. plot.py
needs the Python package lammps_foam (pip install . in the top directory).
"""
from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import dataclass
import json
from pathlib import Path
import shlex
import subprocess
import sys
import time

HERE = Path(__file__).resolve().parent
SMALL = {"N": "2000", "coarsen": "no", "dt": "1e-4"}     # stable for these, not for the smallest of more bubbles
TERMS: dict[str, dict[str, str]] = {     # what differs from the settings of in.creaming
    "as it is": {},
    "reach 1": {"reach": "1.0"},
    "no lubrication": {"lubrication": "no"},
    "no viscous force": {"viscous": "none", "lubrication": "no"},
    "tangential": {"tangential": "all"},
    "film yes": {"film": "yes"},
    "h0 1e-5": {"h0": "1.0e-5"},
    "spring": {"elastic": "spring"},
    "one type": {"large": "9"},
    "dt 5e-5": {"dt": "5e-5", "sample": "40", "report": "1000"},
    "dt 1.5e-4": {"dt": "1.5e-4"},
    "tol 1e-3": {"tol": "1e-3"},
    "tol 1e-4": {"tol": "1e-4"},
}


@dataclass(frozen=True)
class Run:
    name: str
    script: str
    words: tuple[tuple[str, str], ...] = ()

    def arguments(self) -> list[str]:
        return [word for key, value in self.words for word in ("-var", key, value)]


def runs(groups: list[str], bubbles: int) -> Iterator[Run]:
    if "column" in groups:
        yield Run("column", "in.creaming", (("N", str(bubbles)),))
    if "osmotic" in groups:
        yield Run("osmotic", "in.osmotic")
    if "terms" in groups:
        for name, words in TERMS.items():
            yield Run(f"terms/{name.replace(' ', '-')}", "in.creaming", tuple({**SMALL, **words}.items()))


def command_words(command: str) -> list[str]:
    """Words of the command, paths made absolute, since LAMMPS will run in another directory."""
    return [str(Path(word).absolute()) if "/" in word and Path(word).exists() else word
            for word in shlex.split(command)]


def do(run: Run, lmp: list[str], directory: Path) -> None:
    """One run in its directory; it is complete only if LAMMPS came to its end."""
    directory.mkdir(parents=True, exist_ok=True)
    command = [*lmp, "-in", str(HERE / run.script), "-log", "log.creaming", *run.arguments()]
    started = time.perf_counter()
    try:
        with (directory / "screen").open("w") as screen:
            status = subprocess.run(command, cwd=directory, stdin=subprocess.DEVNULL, stdout=screen,
                                    stderr=subprocess.STDOUT).returncode
    except FileNotFoundError:
        sys.exit(f"cannot start LAMMPS: there is no program {command[0]} (option --lmp)")
    if status != 0:
        sys.exit(f"LAMMPS stopped with status {status}: see {directory / 'screen'}")
    (directory / "settings.json").write_text(json.dumps(dict(run.words), indent=1) + "\n")
    (directory / "complete").write_text(shlex.join(run.arguments()) + "\n")
    print(f"    {time.perf_counter() - started:.0f} s", flush=True)


def is_complete(run: Run, directory: Path) -> bool:
    """By the same arguments: a run of others must not pass for it."""
    done = directory / "complete"
    if not done.exists():
        return False
    if done.read_text().strip() != shlex.join(run.arguments()):
        sys.exit(f"{directory} has a run of other settings ({done.read_text().strip()}): choose another --out")
    return True


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--lmp", default="lmp", metavar="COMMAND",
                        help='how to start LAMMPS, as one string (default "%(default)s")')
    parser.add_argument("--out", default="out", type=Path, metavar="DIR", help="where everything is written")
    parser.add_argument("--bubbles", default=100000, type=int, metavar="N", help="in the column (default %(default)s)")
    parser.add_argument("--only", nargs="+", choices=["column", "osmotic", "terms"], default=["column", "osmotic"],
                        help="these runs (default: column osmotic)")
    parser.add_argument("--dry-run", action="store_true", help="list the runs, and end")
    parser.add_argument("--no-plots", action="store_true", help="runs alone")
    args = parser.parse_args()
    if args.bubbles < 100:
        parser.error(f"--bubbles is {args.bubbles}: at least 100 are needed")

    wanted = list(runs(args.only, args.bubbles))
    if args.dry_run:
        for run in wanted:
            print(f"{run.name:24} {run.script:12}", *run.arguments())
        return
    missing = [run for run in wanted if not is_complete(run, args.out / run.name)]
    print(f"{len(wanted)} runs, {len(wanted) - len(missing)} of them complete", flush=True)
    for done, run in enumerate(missing):
        print(f"run {done + 1} of {len(missing)}: {run.name}", flush=True)
        do(run, command_words(args.lmp), args.out / run.name)
    if not args.no_plots:
        import plot
        plot.draw(args.out)


if __name__ == "__main__":
    main()
