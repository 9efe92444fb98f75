"""Restart files of a run, and what has to be done so that a run goes on from one of them."""

from __future__ import annotations

import math
import os
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Callable

from . import lammps_input, tables
from .thesis_input import Unusable

MAGIC = b"LammpS RestartT\0"    # LAMMPS begins and ends a restart file with it
NAME = re.compile(r"restart\.(\d+)")
DUMPS = ("foam.lammpstrj", "foam.lammpstrj.gz")


def files(directory: Path) -> list[tuple[int, Path]]:
    """Restart files by their steps, the newest first."""
    found = [(int(match[1]), path) for path in directory.iterdir() if (match := NAME.fullmatch(path.name))]
    return sorted(found, reverse=True)


def damage(path: Path) -> str | None:
    """What is wrong with a restart file, None if it is whole. It is written from its beginning to its end."""
    try:
        with open(path, "rb") as file:
            begins = file.read(len(MAGIC))
            length = file.seek(0, os.SEEK_END)
            file.seek(max(0, length - len(MAGIC)))
            ends = file.read()
    except OSError as error:
        return f"cannot be read: {error.strerror}"
    if begins != MAGIC:
        return "is no restart file of LAMMPS" if begins else "is empty"
    if ends != MAGIC or length < 2 * len(MAGIC):
        return f"is cut short, after {length} bytes"
    return None


def processors(directory: Path, ranks: int | None) -> str | None:
    """The grid of ranks of the last run that told it, such as 2 1 1; None for one rank, or if there are others now.

    ranks: how many there are now; None if there are as many as before.

    LAMMPS would choose it anew, and in a square box it chooses by the last digits of the sides.
    """
    found = None
    for path in sorted(directory.glob("log.foam*"), key=lambda path: path.stat().st_mtime):
        for match in re.finditer(r"^ +(\d+) by (\d+) by (\d+) MPI processor grid", path.read_text(errors="replace"),
                                 flags=re.M):
            found = " ".join(match.groups())
    if found is None or found == "1 1 1":
        return None
    return found if ranks in (None, math.prod(map(int, found.split()))) else None


def prune(directory: Path, keep: int = 2) -> None:
    """Remove restart files but for the last whole ones; those that are being written stay, too."""
    whole = 0
    for _, path in files(directory):
        if whole >= keep:
            path.unlink(missing_ok=True)
        whole += damage(path) is None


@dataclass
class Plan:
    """What resume is going to do; nothing has been changed yet."""
    input: str                            # name of the input that LAMMPS gets
    text: str | None = None            # of in.resume
    series: str | None = None          # series.csv, cut
    cuts: list[tables.Cut] = field(default_factory=list)
    remove: list[Path] = field(default_factory=list)
    told: list[str] = field(default_factory=list)

    def do(self, directory: Path) -> None:
        if self.text is not None:
            tables.replace(directory / "in.resume", self.text)    # first: it holds a line that series.csv will lack
        if self.series is not None:
            tables.replace(directory / "series.csv", self.series)
        for cut in self.cuts:
            cut.do()
        for path in self.remove:
            path.unlink(missing_ok=True)


def plan(directory: Path, readable: Callable[[Path], str | None] = lambda path: None,
         ranks: int | None = None) -> Plan:
    """How a run goes on. readable(PATH) tries a restart file, and returns what is wrong with it.

    ranks: on how many it goes on; None for as many as before. If there are as many, they share the box as before.

    Raises Unusable if it cannot, and nothing is touched.
    """
    input_file = directory / "in.foam"
    if not input_file.is_file():
        raise Unusable(f"{directory}: no in.foam there, so no run of lammps-foam")
    told: list[str] = []
    for step, path in files(directory):
        wrong = damage(path) or readable(path)
        if wrong is None:
            return _from(directory, step, path, told, processors(directory, ranks))
        told.append(f"{path} {wrong}; taking the one before")
    if told:
        raise Unusable("\n".join([*told[:-1], told[-1].replace("; taking the one before", "; there is no other one. "
                                                               "Nothing was changed")]))
    return _anew(directory)


def _anew(directory: Path) -> Plan:
    """Before the first restart file there are no tables."""
    there = [name for name in ("series.csv", *DUMPS) if tables.size(directory / name) > 0]
    if there:
        series = directory / "series.csv"
        if there != ["series.csv"] or tables.read_series(series).lines:
            raise Unusable(f"{directory}: there is {there[0]}, but no restart file to go on from. Nothing was changed; "
                           "another run needs another directory")
    told = []
    if list(directory.glob("log.*")):
        told.append("ended before coarsening began, when there is no restart file yet: it begins again")
    return Plan("in.foam", told=told)


def _from(directory: Path, step: int, path: Path, told: list[str], grid: str | None) -> Plan:
    text = (directory / "in.foam").read_text()
    series_file = directory / "series.csv"
    title, cut_series = None, None
    if step > 0:
        kept, names = _lines_before(directory, series_file, step, path.name)
        # fix print begins a table with a title, always: so LAMMPS writes the last of these lines again
        title, cut_series = kept[-1], "\n".join([",".join(names), *kept[:-1]]) + "\n"
    cuts, remove = [], []
    for name in DUMPS:
        if (directory / name).exists():
            if title is None:
                remove.append(directory / name)
            else:
                cuts.append(tables.plan_cut(directory / name, step))
    resumed = lammps_input.going_on(text, str(directory / "in.foam"), path.name, title, grid)
    told.append(f"goes on from step {step}")
    return Plan("in.resume", resumed, cut_series, cuts, remove, told)


def _lines_before(directory: Path, series_file: Path, step: int, restart: str) -> tuple[list[str], list[str]]:
    """Whole lines before the step of the restart file, and the names of columns. LAMMPS writes that of the step."""
    if not series_file.exists():
        raise Unusable(f"{series_file}: is not there, which should go on from {restart}. Nothing was changed")
    series = tables.read_series(series_file)
    lines = [*series.lines, *_lost_line(directory, series)]
    steps = [int(line.split(",", 1)[0]) for line in lines]
    kept = [line for line, at in zip(lines, steps) if at < step]
    if not kept:
        raise Unusable(f"{series_file}: has no line before step {step}, so it cannot go on from {restart}. Nothing was "
                       "changed")
    if len(steps) > 1:
        apart = [at - before for before, at in zip(steps, steps[1:])]
        # `every` may have been changed before a resume: what comes again and again is one, and the first is
        distance = max(one for one in set(apart) if one == apart[0] or apart.count(one) >= 2)
        gaps = [before for before, at in zip(steps, steps[1:]) if at - before > distance and at < step]
        last = max(at for at in steps if at < step)
        if gaps or step - last > max(apart):
            raise Unusable(f"{series_file}: lines are missing after step {gaps[0] if gaps else last} (a disk that was "
                           f"full?), so it cannot go on from {restart}. Nothing was changed")
    return kept, series.names


def _lost_line(directory: Path, series: tables.Series) -> list[str]:
    """The line that in.resume was going to write, if LAMMPS was killed before it did."""
    try:
        text = (directory / "in.resume").read_text()
    except OSError:
        return []
    match = re.search(r'^variable +title string "(.*)"$', text, flags=re.M)
    lost = match[1] if match else ""
    at = tables.step_of(lost, len(series.names))
    last = int(series.lines[-1].split(",", 1)[0]) if series.lines else -1
    return [lost] if at is not None and at > last else []
