#!/usr/bin/env python3
"""What a liquid alone has to show: a vortex, a tank at rest, a dam break beside LAMMPS' own SPH; figures by plot.py.

    python3 run.py --lmp lmp --out DIR                        some minutes on one core
    python3 run.py --lmp lmp --out DIR --full                 finer ones too
    python3 run.py --lmp lmp --out DIR --only vortex tank     some of them

A run that is complete is not done again, so that this can be stopped and started; --dry-run lists the runs. Times are
compared, so run them one after the other, on one rank. reference.py and plot.py need the Python package lammps_foam
(pip install . in the top directory).
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
GROUPS = ("vortex", "tank", "dambreak", "iterations")
LIMITED = "1.0"                                        # longest step: what the flow allows
TANKS: dict[str, dict[str, str]] = {
    "Re 100": {"Re": "100", "les": "none"},
    "Re 100 mixed": {"Re": "100"},
    "Re 1e4": {"les": "none"},
    "Re 1e4 mixed": {},
    "gravity published": {"les": "none", "gravity": "published", "shift": "published", "steps": "2000"},
    "shift published": {"les": "none", "shift": "published"},
}
FINE_TANKS: dict[str, dict[str, str]] = {
    "Re 1e4 n 24": {"les": "none", "n": "24"},
}
SETTINGS: dict[str, dict[str, str]] = {                # what differs from in.dambreak
    "no eddies": {"les": "none"},
    "Re 1e4": {"Re": "1.0e4"},
    "ma 0": {"ma": "0"},
    "tol 1e-4": {"tol": "1.0e-4"},
    "published": {"gravity": "published", "shift": "published"},
    "shift published": {"shift": "published"},
}
SHORT_STEPS: dict[str, dict[str, str]] = {             # the flow allows 0.01 or so
    "dt 0.005": {"dtmax": "0.005"},
    "dt 0.0025": {"dtmax": "0.0025"},
    "dt 0.00125": {"dtmax": "0.00125"},
    "shift published dt 0.0025": {"shift": "published", "dtmax": "0.0025"},
    "shift published dt 0.00125": {"shift": "published", "dtmax": "0.00125"},
}
EXPLICIT: dict[str, dict[str, str]] = {                # what differs from explicit.lmp
    "alpha 0.02": {"alpha": "0.02"},
    "alpha 0.02 half steps": {"alpha": "0.02", "courant": "0.1"},
    "c 5": {"c": "5"},
    "c 20": {"c": "20"},
    "reach 3": {"reach": "3.0"},
    "walls reflect": {"walls": "reflect"},
}


@dataclass(frozen=True)
class Run:
    name: str
    script: str
    words: tuple[tuple[str, str], ...] = ()

    def arguments(self) -> list[str]:
        return [word for key, value in self.words for word in ("-var", key, value)]


def sizes(group: str, full: bool) -> list[int]:
    """Particles along a unit of length."""
    few, more = {"vortex": ([12, 16, 24], [32, 48]), "dambreak": ([8, 12, 16, 24], [32, 48]),
                 "iterations": ([8, 12, 16, 24], [32, 48, 64])}[group]
    return few + more if full else few


def runs(groups: list[str], full: bool) -> Iterator[Run]:
    if "vortex" in groups:
        for n in sizes("vortex", full):
            for dtmax in (LIMITED, "0.004", "0.001"):
                yield Run(f"vortex/{n}-{dtmax}", "in.vortex", (("n", str(n)), ("dtmax", dtmax)))
        yield Run("vortex/lattice", "in.vortex", (("n", "24"), ("dtmax", "0.004"), ("jiggle", "0")))
        for dtmax in ("0.004", "0.001") if full else ():
            yield Run(f"vortex/wide-{dtmax}", "in.vortex",
                      (("n", "24"), ("dtmax", dtmax), ("h", "1.5"), ("layers", "7")))
    if "tank" in groups:
        for name, words in {**TANKS, **(FINE_TANKS if full else {})}.items():
            yield Run(f"tank/{name.replace(' ', '-')}", "in.tank", tuple({"steps": "10000", **words}.items()))
    if "dambreak" in groups:
        for n in sizes("dambreak", full):
            yield Run(f"dambreak/{n}", "in.dambreak", (("n", str(n)),))
            yield Run(f"explicit/{n}", "explicit.lmp", (("n", str(n)),))
        for name, words in {**SETTINGS, **(SHORT_STEPS if full else {})}.items():
            yield Run(f"dambreak/{name.replace(' ', '-')}", "in.dambreak", tuple(words.items()))
        for name, words in EXPLICIT.items():
            yield Run(f"explicit/{name.replace(' ', '-')}", "explicit.lmp", tuple(words.items()))
    if "iterations" in groups:
        for n in sizes("iterations", full):
            for ma in ("0", "0.05", "0.2"):
                yield Run(f"iterations/{n}-{ma}", "in.dambreak", (("n", str(n)), ("ma", ma), ("T", "0.5")))


def command_words(command: str) -> list[str]:
    """Words of the command, paths made absolute, since LAMMPS will run in another directory."""
    return [str(Path(word).absolute()) if "/" in word and Path(word).exists() else word
            for word in shlex.split(command)]


def do(run: Run, lmp: list[str], directory: Path) -> None:
    """One run in its directory; it is complete only if LAMMPS came to its end."""
    directory.mkdir(parents=True, exist_ok=True)
    command = [*lmp, "-in", str(HERE / run.script), "-log", "log.liquid", *run.arguments()]
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


def do_reference(out: Path, nodes: int) -> None:
    file = out / f"potential-{nodes}.csv"
    if not file.is_file():
        print(f"potential flow with {nodes} nodes", flush=True)
        subprocess.run([sys.executable, str(HERE / "reference.py"), str(file), "--nodes", str(nodes)], check=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--lmp", default="lmp", metavar="COMMAND",
                        help='how to start LAMMPS, as one string (default "%(default)s")')
    parser.add_argument("--out", default="out", type=Path, metavar="DIR", help="where everything is written")
    parser.add_argument("--full", action="store_true", help="finer runs too")
    parser.add_argument("--only", nargs="+", choices=GROUPS, default=list(GROUPS), help="these runs (default: all)")
    parser.add_argument("--dry-run", action="store_true", help="list the runs, and end")
    parser.add_argument("--no-plots", action="store_true", help="runs alone")
    args = parser.parse_args()

    wanted = list(runs(args.only, args.full))
    if args.dry_run:
        for run in wanted:
            print(f"{run.name:24} {run.script:12}", *run.arguments())
        return
    missing = [run for run in wanted if not is_complete(run, args.out / run.name)]
    print(f"{len(wanted)} runs, {len(wanted) - len(missing)} of them complete", flush=True)
    for done, run in enumerate(missing):
        print(f"run {done + 1} of {len(missing)}: {run.name}", flush=True)
        do(run, command_words(args.lmp), args.out / run.name)
    if "dambreak" in args.only:
        do_reference(args.out, 160 if args.full else 80)
    if not args.no_plots:
        import plot
        plot.draw(args.out)


if __name__ == "__main__":
    main()
