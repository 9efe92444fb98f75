"""The words run and resume of the command lammps-foam."""

from __future__ import annotations

import argparse
import json
import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from . import lammps_input, launch, restart, snapshots, tables, thesis_input
from .thesis_input import Foam, Unusable

# what shows that there is a run in a directory
TRACES = ("in.foam", "run.json", "series.csv", "complete", "foam.lammpstrj", "foam.lammpstrj.gz", "last.lammpstrj")


def run(arguments: list[str]) -> int:
    given, extra = _split(arguments)
    options = _run_parser().parse_args(given)
    return _status(lambda: _run(options, extra))


def resume(arguments: list[str]) -> int:
    given, extra = _split(arguments)
    options = _resume_parser().parse_args(given)
    return _status(lambda: _resume(options, extra))


def _status(work: Callable[[], int]) -> int:
    """The exit status of a word; what is wrong is told."""
    try:
        return work()
    except Unusable as error:
        launch.say(str(error), sys.stderr)
        return 1
    except OSError as error:
        launch.say(f"{error.filename or 'lammps-foam'}: {error.strerror or error}", sys.stderr)
        return 1
    except KeyboardInterrupt:    # before or after LAMMPS has run
        launch.say("interrupted", sys.stderr)
        return 130


def _split(arguments: list[str]) -> tuple[list[str], list[str] | None]:
    """What stands behind -- is for LAMMPS."""
    if "--" not in arguments:
        return arguments, None
    at = arguments.index("--")
    return arguments[:at], arguments[at + 1:]


# ---- command line ---------------------------------------------------------------------------------------------------

def _run_parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="lammps-foam run", description="Run a foam that an input of the thesis' program describes.",
        epilog="Arguments after -- are for LAMMPS: lammps-foam run foam.json --out DIR -- -var every 10")
    parser.add_argument("input", type=Path, metavar="INPUT.json", help="input, in either of the published forms")
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="directory for all files; may be new")
    parser.add_argument("--integrator", choices=("abm", "rkc"), default="abm",
                        help="abm: predictor-corrector, largest error, as the thesis (default); rkc: several times as "
                             "fast, root mean square of the error")
    parser.add_argument("--tol", type=_positive, metavar="T",
                        help="error allowed in a step (default: that of the input with abm, 1e-3 with rkc)")
    parser.add_argument("--dimension", type=int, choices=(2, 3), help="for a flat input that does not say it")
    parser.add_argument("--walls", type=_axes, metavar="XYZ", help="axes with walls, such as y; for a flat input, too")
    parser.add_argument("--flow", action="store_true", default=None, help="impose the flow; for a flat input, too")
    parser.add_argument("--gzip", action="store_true", help="snapshots as foam.lammpstrj.gz")
    parser.add_argument("--save", type=_positive, default=600.0, metavar="SECONDS",
                        help="wall time between restart files (default 600)")
    parser.add_argument("--save-steps", type=_count, metavar="STEPS",
                        help="steps between them instead; then two runs are the same bit by bit")
    _add_lammps(parser)
    parser.add_argument("--dry-run", action="store_true",
                        help="write the input for LAMMPS, and do not run it; lammps-foam resume DIR does")
    return parser


def _resume_parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="lammps-foam resume", description="Go on with a run that has ended too early.",
        epilog="LAMMPS, --np and the arguments after -- are those of the run, unless they are given again.")
    parser.add_argument("directory", type=Path, metavar="DIR", help="that of lammps-foam run --out")
    _add_lammps(parser)
    return parser


def _add_lammps(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--lmp", metavar="COMMAND", help="LAMMPS (default: lammps-foam lmp of this environment)")
    parser.add_argument("--np", type=_count, metavar="N", help="MPI ranks (default 1)")


def _positive(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0.0 < value < 1e30:
        raise argparse.ArgumentTypeError(f"'{text}' is no number above 0")
    return value


def _count(text: str) -> int:
    if not text.isdecimal() or not 0 < int(text) < 2**31:
        raise argparse.ArgumentTypeError(f"'{text}' is no whole number from 1 on")
    return int(text)


def _axes(text: str) -> str:
    if not text or set(text) - set("xyz"):
        raise argparse.ArgumentTypeError(f"'{text}' is none of the axes x, y, z or several of them")
    return text


# ---- run ------------------------------------------------------------------------------------------------------------

def _run(options: argparse.Namespace, extra: list[str] | None) -> int:
    foam = thesis_input.read(options.input, options.dimension, options.walls, options.flow)
    directory: Path = options.out
    _refuse_used(directory)
    lammps = launch.find_lammps(options.lmp)
    ranks = options.np or 1
    launch.find_mpiexec(ranks, lammps)
    if not options.dry_run or options.gzip:
        has = launch.styles(lammps)
        if options.gzip and "custom/gz" not in has:
            raise Unusable("--gzip: this LAMMPS has no dump custom/gz (package COMPRESS)")
    tolerance = options.tol or (1.0e-3 if options.integrator == "rkc" else None)
    text = lammps_input.new_run(foam, options.input.name, options.integrator, tolerance, options.gzip, options.save,
                                options.save_steps)
    for note in foam.notes:
        launch.say(f"{options.input}: {note}")
    _write(directory, options.input, text, {
        "lmp": lammps, "np": ranks, "arguments": extra or [], "snapshots": foam.filename, "end": foam.end,
        "frequency": foam.frequency})
    if options.dry_run:
        launch.say(f"{directory / 'in.foam'} is written; lammps-foam resume {directory} runs it")
        return 0
    with launch.Lock(directory) as lock:
        return _launch(lock, directory, "in.foam", _record(directory), _summary(foam))


def _refuse_used(directory: Path) -> None:
    if directory.exists() and not directory.is_dir():
        raise Unusable(f"--out {directory}: is no directory")
    found = [name for name in TRACES if (directory / name).exists()]
    if directory.is_dir():
        found += [path.name for _, path in restart.files(directory)]
    if found:
        raise Unusable(f"--out {directory}: there is a run already ({found[0]}): lammps-foam resume {directory} goes "
                       "on with it; a new one needs another directory")


def _write(directory: Path, source: Path, text: str, record: dict[str, Any]) -> None:
    try:
        directory.mkdir(parents=True, exist_ok=True)
        if source.resolve() != (directory / "input.json").resolve():
            shutil.copyfile(source, directory / "input.json")
    except OSError as error:
        raise Unusable(f"--out {directory}: cannot be written: {error.strerror}") from None
    tables.replace(directory / "run.json", json.dumps(record, indent=1) + "\n")
    tables.replace(directory / "in.foam", text)


def _record(directory: Path) -> dict[str, Any]:
    path = directory / "run.json"
    try:
        record: dict[str, Any] = json.loads(path.read_text())
        launch.settings(record)
        return {"snapshots": record["snapshots"], "end": record["end"], "frequency": record["frequency"], **record}
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise Unusable(f"{path}: cannot be used: {error!r}") from None


def _summary(foam: Foam) -> str:
    walls = "".join(axis for axis, wall in zip("xyz", foam.walls) if wall)
    return (f"{foam.bubbles} bubbles in {foam.dimension}D, gas fraction {foam.phi:g}, to {foam.end}"
            f"{f', walls across {walls}' if walls else ''}{', with an imposed flow' if foam.flow else ''}")


# ---- resume ---------------------------------------------------------------------------------------------------------

def _resume(options: argparse.Namespace, extra: list[str] | None) -> int:
    directory: Path = options.directory
    if not directory.is_dir():
        raise Unusable(f"{directory}: there is no such directory")
    if not (directory / "in.foam").is_file():
        raise Unusable(f"{directory}: no in.foam there, so no run of lammps-foam")
    record = _record(directory)
    if tables.size(directory / "complete") > 0:
        told = (directory / "complete").read_text().strip().lstrip("- ")
        launch.say(f"{directory}: {told}; nothing is left to do")
        return 0
    if options.lmp is not None:
        record["lmp"] = launch.find_lammps(options.lmp)
    record["np"] = options.np or record["np"]
    record["arguments"] = record["arguments"] if extra is None else extra
    lammps, _, _ = launch.settings(record)
    launch.styles(lammps)
    with launch.Lock(directory) as lock:
        # an mpiexec may be in the command of the run, too
        ranks = None if options.lmp is None and options.np is None else record["np"]
        plan = restart.plan(directory, lambda path: launch.readable(lammps, path), ranks)
        for line in plan.told:
            launch.say(f"{directory}: {line}")
        plan.do(directory)
        tables.replace(directory / "run.json", json.dumps(record, indent=1) + "\n")
        return _launch(lock, directory, plan.input, record, f"resumed by {plan.input}")


# ---- both -----------------------------------------------------------------------------------------------------------

def _launch(lock: launch.Lock, directory: Path, name: str, record: dict[str, Any], what: str) -> int:
    lammps, ranks, extra = launch.settings(record)
    command = launch.arguments(lammps, ranks, name, launch.new_log(directory), extra)
    launch.say(f"{directory}: {what}")
    ended = launch.Run(directory, command, record["end"], sys.stdout)(lock)
    if not ended.full:
        _derived(directory, record)
    if ended.complete:
        launch.say(f"{directory}: {ended.message}")
        _tell_files(directory, record)
        return 0
    launch.say(f"{directory}: {ended.message}", sys.stderr)
    does = "goes on" if restart.files(directory) else "begins again"
    launch.say(f"{directory}: lammps-foam resume {directory} {does}", sys.stderr)
    return 130 if ended.interrupted else 1


def _derived(directory: Path, record: dict[str, Any]) -> None:
    """The tables of the thesis' program, of as much as there is."""
    try:
        if (directory / "series.csv").exists():
            snapshots.results(directory)
        record["written"] = snapshots.snapshots(directory, record["snapshots"]) if record["frequency"] > 0 else 0
    except (Unusable, KeyError) as error:
        launch.say(str(error), sys.stderr)


def _tell_files(directory: Path, record: dict[str, Any]) -> None:
    rows = [("in.foam", "input for LAMMPS, to keep and to change"),
            ("series.csv", "time series"), ("results.csv", "one line for each unit of tau"),
            ("foam.lammpstrj", "snapshots"), ("foam.lammpstrj.gz", "snapshots"), ("last.lammpstrj", "the last state")]
    for name, text in rows:
        if (directory / name).exists():
            launch.say(f"  {directory / name}: {text}")
    if record.get("written"):
        launch.say(f"  {directory / record['snapshots']}.csv.0 to .{record['written'] - 1}: snapshots as tables")
