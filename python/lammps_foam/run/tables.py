"""The files that a run writes line by line: read what is whole, and cut back to the step of a restart file."""

from __future__ import annotations

import gzip
import os
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from .thesis_input import Unusable


def replace(path: Path, text: str | bytes) -> None:
    """Write a file, whole or not at all."""
    raw = text.encode() if isinstance(text, str) else text
    new = path.with_name(f".{path.name}.new")
    try:
        with open(new, "wb") as file:
            file.write(raw)
            file.flush()
            os.fsync(file.fileno())
        os.replace(new, path)
    except OSError as error:
        new.unlink(missing_ok=True)
        raise Unusable(f"{path}: cannot be written: {error.strerror}") from None


# ---- series.csv -----------------------------------------------------------------------------------------------------

@dataclass
class Series:
    """Whole lines of a series.csv, without their ends; `rest` is a last line without an end, cut by a kill."""
    names: list[str]
    lines: list[str]
    rest: str

    def column(self, name: str) -> list[float]:
        at = self.names.index(name)
        return [float(line.split(",")[at]) for line in self.lines]


def read_series(path: Path) -> Series:
    """Raises Unusable, with the number of the line, for one that is not as the others or that goes back in time."""
    try:
        text = path.read_text(encoding="ascii")
    except (OSError, UnicodeDecodeError) as error:
        raise Unusable(f"{path}: cannot be read: {error}") from None
    *lines, rest = text.split("\n")
    if not lines:
        return Series([], [], rest)
    names = lines[0].split(",")
    if names[0] != "step":
        raise Unusable(f"{path}:1: no names of columns, of which the first is step: {lines[0][:60]!r}")
    before = -1
    for number, line in enumerate(lines[1:], 2):
        step = step_of(line, len(names))
        if step is None:
            raise Unusable(f"{path}:{number}: not a line of {len(names)} numbers, the file is damaged: {line[:60]!r}")
        if step <= before:
            raise Unusable(f"{path}:{number}: step {step} after step {before}, the file is damaged")
        before = step
    return Series(names, lines[1:], rest)


def step_of(line: str, fields: int) -> int | None:
    """None if the line is not so many numbers."""
    words = line.split(",")
    try:
        for word in words:
            float(word)
        return int(words[0]) if len(words) == fields else None
    except ValueError:
        return None


# ---- dumps ----------------------------------------------------------------------------------------------------------

@dataclass
class Frame:
    """A snapshot as LAMMPS wrote it; begin and end are bytes of the (unpacked) file."""
    step: int
    time: float | None
    bounds: list[list[float]]
    names: list[str]
    rows: list[bytes]
    begin: int
    end: int


class Lines:
    """Of a dump, with the bytes and lines before the next. A cut ends the file, wherever it is."""

    def __init__(self, path: Path) -> None:
        self.path, self.at, self.number = path, 0, 0
        self.cut = False
        self.file: IO[bytes] = gzip.open(path, "rb") if path.suffix == ".gz" else open(path, "rb")  # type: ignore

    def next(self) -> bytes | None:
        """None at the end."""
        try:
            line = self.file.readline()
        except (EOFError, zlib.error, gzip.BadGzipFile):    # a stream that was cut
            line, self.cut = b"", True
        if not line.endswith(b"\n"):
            self.cut = self.cut or bool(line)
            return None
        self.at += len(line)
        self.number += 1
        return line.rstrip()


def frames(path: Path, rows: bool = True) -> Iterator[Frame]:
    """Those that are whole; a last one that is cut is left out. rows: False to leave their lines out.

    Raises Unusable, with the number of the line, where something else stands.
    """
    lines = Lines(path)
    with lines.file:
        while True:
            frame = _frame(lines, rows)
            if frame is None:
                return
            yield frame


def _frame(lines: Lines, rows: bool) -> Frame | None:
    begin, time, step, count = lines.at, None, None, 0
    bounds: list[list[float]] = []
    try:
        while True:
            line = lines.next()
            if line is None:
                return None
            if line in (b"ITEM: TIME", b"ITEM: TIMESTEP", b"ITEM: NUMBER OF ATOMS"):
                value = lines.next()
                if value is None:
                    return None
                if line == b"ITEM: TIME":
                    time = float(value)
                elif line == b"ITEM: TIMESTEP":
                    step = int(value)
                else:
                    count = int(value)
            elif line.startswith(b"ITEM: UNITS"):
                lines.next()
            elif line.startswith(b"ITEM: BOX BOUNDS"):
                for _ in range(3):
                    value = lines.next()
                    if value is None:
                        return None
                    bounds.append([float(word) for word in value.split()])
            elif line.startswith(b"ITEM: ATOMS") and step is not None:
                break
            else:
                raise ValueError
        names = line.decode().split()[2:]
        kept = []
        for _ in range(count):
            value = lines.next()
            if value is None:
                return None
            if value.startswith(b"ITEM"):
                raise ValueError
            if rows:
                kept.append(value)
        return Frame(step, time, bounds, names, kept, begin, lines.at)
    except ValueError:
        raise Unusable(f"{lines.path}:{lines.number}: no line of a LAMMPS dump, the file is damaged") from None


@dataclass
class Cut:
    """Where a dump is to be cut: so many bytes (unpacked) are kept."""
    path: Path
    keep: int

    def do(self) -> None:
        try:
            if self.path.suffix == ".gz":
                self._packed()
            elif self.path.stat().st_size > self.keep:
                os.truncate(self.path, self.keep)
        except OSError as error:
            raise Unusable(f"{self.path}: cannot be cut back: {error.strerror}") from None

    def _packed(self) -> None:
        new = self.path.with_name(f".{self.path.name}.new")
        left = self.keep
        with gzip.open(self.path, "rb") as old, gzip.open(new, "wb", 6) as file:
            while left > 0:
                part = old.read(min(left, 1 << 20))
                file.write(part)
                left -= len(part)
        os.replace(new, self.path)


def plan_cut(path: Path, step: int) -> Cut:
    """Frames up to this step are kept. Reads, and changes nothing."""
    keep = 0
    for frame in frames(path, rows=False):
        if frame.step > step:
            break
        keep = frame.end
    return Cut(path, keep)


def size(path: Path) -> int:
    try:
        return path.stat().st_size
    except OSError:
        return 0


def last_line(path: Path, most: int = 4096) -> str | None:
    """The last whole line of a file that may be growing; None if there is none."""
    try:
        with open(path, "rb") as file:
            file.seek(max(0, size(path) - most))
            whole = file.read().split(b"\n")[:-1]
    except OSError:
        return None
    return whole[-1].decode("ascii", "replace") if whole else None


def values(names: list[str], line: str) -> dict[str, Any]:
    """Of a line of a table; empty if it is none."""
    words = line.split(",")
    try:
        return dict(zip(names, map(float, words))) if len(words) == len(names) else {}
    except ValueError:
        return {}
