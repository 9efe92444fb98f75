#!/usr/bin/env python3
"""What a liquid alone has to show: flows whose laws are known, turbulence, a tank at rest, a dam break beside that of
LAMMPS' own SPH, what precision costs; figures by plot.py.

    python3 run.py --lmp lmp --out DIR                        a quarter of an hour on one core
    python3 run.py --lmp lmp --out DIR --full                 finer ones too: five hours
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

from written import folder

HERE = Path(__file__).resolve().parent
GROUPS = ("vortex", "beltrami", "turbulence", "bubble", "rise", "tank", "dambreak", "pairs", "precision", "iterations")
LIMITED = "1.0"                                        # longest step: what the flow allows
CLOSURES = {"none": "none", "mixed": "mixed 0.06", "smagorinsky": "smagorinsky 0.1"}
PUSHED = {"force": "1.0", "push": "4", "T": "6"}       # pushed until 4, then left alone
RADII = ("0.1", "0.2", "0.4")                          # of a bubble, over the spacing
PLACES = (("0.1", "0.2", "0.3"), ("0.0", "0.0", "0.0"), ("0.5", "0.5", "0.5"), ("0.4", "0.1", "0.25"))
RISES: dict[str, dict[str, str]] = {                   # of a bubble, below the surface
    "1 mm": {},
    "0.5 mm": {"a": "5.0e-4"},
    "2 mm": {"a": "2.0e-3"},
    "dr 0.01": {"dr": "0.01"},
}
VORTICES: dict[str, dict[str, str]] = {                # what differs from in.vortex with steps below 0.004
    "lattice": {"n": "24", "jiggle": "0"},
    "tol 1e-3": {"tol": "1.0e-3"},
    "tol 1e-9": {"tol": "1.0e-9"},
    "ma 0.01": {"ma": "0.01"},
    "ma 0": {"ma": "0"},
}
TANKS: dict[str, dict[str, str]] = {
    "Re 100": {"Re": "100", "les": "none"},
    "Re 100 mixed": {"Re": "100"},
    "Re 1e4": {"les": "none"},
    "Re 1e4 mixed": {},
    "gravity published": {"les": "none", "gravity": "published", "shift": "published", "steps": "2000"},
    "shift published": {"les": "none", "shift": "published"},
    "divergence published": {"les": "none", "divergence": "published"},
    "tol 1e-3": {"tol": "1.0e-3", "steps": "2000"},
}
FINE_TANKS: dict[str, dict[str, str]] = {
    "Re 1e4 n 24": {"les": "none", "n": "24"},
}
QUICK = {"courant": "0.5", "tol": "1.0e-3"}            # as long as the error of the front does not tell
SETTINGS: dict[str, dict[str, str]] = {                # what differs from in.dambreak
    "no eddies": {"les": "none"},
    "Re 1e4": {"Re": "1.0e4"},
    "ma 0": {"ma": "0"},
    "ma 0.1": {"ma": "0.1"},
    "ma 0.2": {"ma": "0.2"},
    "tol 1e-1": {"tol": "1.0e-1"},
    "tol 1e-2": {"tol": "1.0e-2"},
    "tol 1e-3": {"tol": "1.0e-3"},
    "tol 1e-4": {"tol": "1.0e-4"},
    "tol 1e-8": {"tol": "1.0e-8"},
    "courant 0.1": {"courant": "0.1"},
    "courant 0.3": {"courant": "0.3"},
    "courant 0.5": {"courant": "0.5"},
    "courant 0.8": {"courant": "0.8"},
    "quick": QUICK,
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
    "alpha 0.1": {"alpha": "0.1"},
    "alpha 0.05": {"alpha": "0.05"},
    "alpha 0.01": {"alpha": "0.01"},
    "steps twice as long": {"courant": "0.2"},
    "steps half as long": {"courant": "0.05"},
    "c 5": {"c": "5"},
    "c 14": {"c": "14"},
    "c 20": {"c": "20"},
    "c 20 alpha 0.01": {"c": "20", "alpha": "0.01"},
    "reach 2.2": {"reach": "2.2"},
    "reach 3": {"reach": "3.0"},
    "hydrostatic": {"start": "hydrostatic"},
    "walls reflect": {"walls": "reflect"},
}
RHEO: dict[str, dict[str, str]] = {                    # what differs from rheo.lmp
    "steps twice as long": {"courant": "0.2"},
    "c 5": {"c": "5"},
    "without shifts": {"more": "surface/detection divergence 2.4 8 interface/reconstruct"},
}
PRECISION: dict[str, dict[str, str]] = {               # what differs from in.turbulence at Re 50
    "ma 0.01": {"ma": "0.01"},
    "ma 0.2": {"ma": "0.2"},
    "ma 0.5": {"ma": "0.5"},
    "tol 1e-1": {"tol": "1.0e-1"},
    "tol 1e-2": {"tol": "1.0e-2"},
    "tol 1e-3": {"tol": "1.0e-3"},
    "tol 1e-4": {"tol": "1.0e-4"},
    "tol 1e-8": {"tol": "1.0e-8"},
    "dt 1/2": {"dtmax": "0.005"},                      # the flow begins with 0.010 at n = 16
    "dt 1/4": {"dtmax": "0.0025"},
    "dt 1/8": {"dtmax": "0.00125"},
    "courant 0.4": {"courant": "0.4"},
    "courant 0.8": {"courant": "0.8"},
}
METHODS = {"projection": "in.dambreak", "explicit": "explicit.lmp", "rheo": "rheo.lmp"}
PAIRED: dict[str, tuple[str, dict[str, str]]] = {      # they run in turn
    "projection": ("in.dambreak", {}),
    "quick": ("in.dambreak", QUICK),
    "explicit": ("explicit.lmp", {}),
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
    few, more = {"vortex": ([12, 16, 24], [32, 48]), "beltrami": ([8, 12, 16, 24], [32, 48]),
                 "turbulence": ([24], [32, 64]), "pushed": ([24], [32, 64]), "dambreak": ([8, 12, 16, 24], [32, 48]),
                 "rheo": ([8, 12, 16], [24]), "pairs": ([8, 16], [24, 32]),
                 "iterations": ([8, 12, 16, 24], [32, 48, 64])}[group]
    return few + more if full else few


def runs_of_vortices(groups: list[str], full: bool) -> Iterator[Run]:
    if "vortex" in groups:
        for n in sizes("vortex", full):
            for dtmax in (LIMITED, "0.004", "0.001"):
                yield Run(f"vortex/{n}-{dtmax}", "in.vortex", (("n", str(n)), ("dtmax", dtmax)))
        for name, words in VORTICES.items():
            yield Run(f"vortex/{folder(name)}", "in.vortex", tuple({"dtmax": "0.004", **words}.items()))
        for dtmax in ("0.004", "0.001") if full else ():
            yield Run(f"vortex/wide-{dtmax}", "in.vortex",
                      (("n", "24"), ("dtmax", dtmax), ("h", "1.5"), ("layers", "7")))
    if "beltrami" in groups:
        for n in sizes("beltrami", full):
            for dtmax in (LIMITED, "0.002"):
                yield Run(f"beltrami/{n}-{dtmax}", "in.turbulence", (("n", str(n)), ("dtmax", dtmax), ("frame", "1")))
    if "turbulence" in groups:
        high = {"Re": "1.0e6", "frame": "0.5", "report": "50"}
        for n in sizes("turbulence", full):
            for name in CLOSURES if n == 24 else ("none", "mixed"):
                yield Run(f"turbulence/{n}-{name}", "in.turbulence",
                          tuple({"n": str(n), **high, "les": CLOSURES[name], "T": "4"}.items()))
        for n in sizes("pushed", full):
            yield Run(f"turbulence/pushed-{n}", "in.turbulence",
                      tuple({"n": str(n), **high, "les": CLOSURES["mixed"], **PUSHED}.items()))


def runs_of_columns(groups: list[str], full: bool) -> Iterator[Run]:
    if "dambreak" in groups:
        for method, script in METHODS.items():
            for n in sizes("rheo" if method == "rheo" else "dambreak", full):
                yield Run(f"{method}/{n}", script, (("n", str(n)),))
        variants = {"projection": {**SETTINGS, **(SHORT_STEPS if full else {})}, "explicit": EXPLICIT,
                    "rheo": RHEO if full else {}}
        for method, some in variants.items():
            for name, words in some.items():
                yield Run(f"{method}/{folder(name)}", METHODS[method], tuple(words.items()))
    if "pairs" in groups:
        for n in sizes("pairs", full):
            for repeat in range(1, 6 if n < 24 else 4):
                for method, (script, words) in PAIRED.items():
                    yield Run(f"pairs/{n}-{repeat}-{method}", script, tuple({"n": str(n), **words}.items()))
    if "iterations" in groups:
        for n in sizes("iterations", full):
            for ma in ("0", "0.05", "0.2"):
                yield Run(f"iterations/{n}-{ma}", "in.dambreak", (("n", str(n)), ("ma", ma), ("T", "0.5")))


def runs(groups: list[str], full: bool) -> Iterator[Run]:
    yield from runs_of_vortices(groups, full)
    if "bubble" in groups:
        for radius in RADII:
            for number, place in enumerate(PLACES):
                yield Run(f"bubble/{radius}-{number}", "in.bubble",
                          (("a", radius), *zip(("px", "py", "pz"), place)))
        for dt in ("0.01", "1.0"):
            yield Run(f"bubble/dt-{dt}", "in.bubble", (("dt", dt),))
    if "rise" in groups:
        for name, words in RISES.items():
            yield Run(f"rise/{folder(name)}", "in.rise", tuple(words.items()))
    if "tank" in groups:
        for name, words in {**TANKS, **(FINE_TANKS if full else {})}.items():
            yield Run(f"tank/{folder(name)}", "in.tank", tuple({"steps": "10000", **words}.items()))
    yield from runs_of_columns(groups, full)
    if "precision" in groups:
        for name, words in PRECISION.items():
            yield Run(f"precision/{folder(name)}", "in.turbulence", tuple({**words, "frame": "1"}.items()))


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
