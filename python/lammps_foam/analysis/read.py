"""Reads what LAMMPS wrote: tables (series) and dumps of bubbles (frames), also gzipped, also while a run writes them.

A table is series.csv as `fix print` writes it, the output of `fix ave/time` (scalars), or the thermo output of a log.
Frames are read one after the other, so that a file may be larger than the memory; each is read by numpy in one go.
What is cut at the end, since the run is still writing or was killed, is left out.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
import gzip
from itertools import islice
from pathlib import Path
from typing import IO, Union, cast
import warnings
import zlib

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Path_ = Union[str, Path]
Series = dict[str, Array]

SERIES = ("series.csv", "series.csv.gz")
FRAMES = ("foam.lammpstrj", "foam.lammpstrj.gz")
OTHER_NAMES = {"TimeStep": "step", "Step": "step", "Time": "time", "PotEng": "energy"}    # of LAMMPS' own tables


class Unusable(Exception):
    """What is wrong with a file or an argument of the user's, in one line."""


# ---------------------------------------------------------------- files

def find(path: Path_, names: Iterable[str]) -> Path:
    """The file that `path` means: itself, or the first of `names` in it if it is a directory."""
    path = Path(path)
    if path.is_dir():
        for name in names:
            if (path / name).is_file():
                return path / name
        raise Unusable(f"the directory {path} has none of the files {', '.join(names)}")
    if not path.is_file():
        raise Unusable(f"there is no file or directory {path}")
    return path


def open_bytes(path: Path) -> IO[bytes]:
    """The file, unpacked if it begins as gzip does, whatever its name is."""
    with open(path, "rb") as file:
        packed = file.read(2) == b"\x1f\x8b"
    return cast("IO[bytes]", gzip.open(path, "rb")) if packed else open(path, "rb")


def lines_of(file: IO[bytes], path: Path) -> Iterator[bytes]:
    """Whole lines. Those of a gzip file that is still being written, up to where it is cut."""
    try:
        for line in file:
            if line.endswith(b"\n"):
                yield line
    except EOFError:    # gzip: no end mark yet
        return
    except (zlib.error, gzip.BadGzipFile) as wrong:
        raise Unusable(f"{path} is damaged: {wrong}") from None


def numbers(rows: list[bytes], columns: int, path: Path, first: int) -> Array:
    """The numbers of `rows` as an array (rows, columns). `first` is the number of the first line in the file."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", DeprecationWarning)    # numpy's, of text that is no number
            table = np.fromstring(b"".join(rows), sep=" ")
    except (ValueError, DeprecationWarning):
        table = np.empty(0)
    if table.size != len(rows) * columns:
        raise Unusable(f"{path}: {_bad_line(rows, columns, first)}")
    return cast(Array, table.reshape(len(rows), columns))


def _bad_line(rows: list[bytes], columns: int, first: int) -> str:
    for number, row in enumerate(rows, first):
        words = row.split()
        if len(words) != columns:
            return f"line {number} has {len(words)} values, not {columns}"
        for word in words:
            try:
                float(word)
            except ValueError:
                return f"line {number}: '{word.decode(errors='replace')}' is no number"
    return f"lines {first} to {first + len(rows) - 1} are not {columns} numbers each"


# ---------------------------------------------------------------- series

def read_series(path: Path_) -> Series:
    """Columns by name of a table, or of series.csv if `path` is a directory.

    A line that does not end is left out. Where the step goes back, as after a restart, the later lines count.
    Of a log the last thermo table is read, with those before it that have the same columns and lead up to it.
    """
    file = find(path, SERIES)
    with open_bytes(file) as stream:
        lines = list(lines_of(stream, file))
    head = next((line for line in lines if line.strip()), b"")
    if head.startswith(b"#"):
        names, table = _ave_time(lines, file)
    elif not head.startswith(b"LAMMPS") and (b"," in head or len(head.split()) == 1):
        names, table = _comma_separated(lines, file)
    else:
        names, table = _thermo(lines, file)
    if len(table) == 0:
        raise Unusable(f"{file} has no line of numbers yet")
    series = {OTHER_NAMES.get(name, name): table[:, column] for column, name in enumerate(names)}
    if "step" in series:
        series = select(series, _last_of_each(series["step"]))
    return series


def select(series: Series, which: NDArray[np.bool_]) -> Series:
    """The rows `which` of all columns."""
    return {name: column[which] for name, column in series.items()}


def need(series: Series, names: Iterable[str], path: Path_) -> None:
    """Complain if a column is missing."""
    missing = [name for name in names if name not in series]
    if missing:
        raise Unusable(f"{path} lacks {_listed(missing)}; it has {_listed(series)}")


def _listed(names: Iterable[str]) -> str:
    return ", ".join(names) or "none"


def _last_of_each(step: Array) -> NDArray[np.bool_]:
    """True for rows that no later row repeats or precedes."""
    least_after = np.minimum.accumulate(step[::-1])[::-1]
    return np.append(step[:-1] < least_after[1:], True)


def _comma_separated(lines: list[bytes], path: Path) -> tuple[list[str], Array]:
    rows = [(number, line) for number, line in enumerate(lines, 1) if line.strip()]
    names = [name.strip() for name in rows[0][1].decode(errors="replace").split(",")] if rows else []
    if not names or any(_is_number(name) for name in names):
        raise Unusable(f"{path}: its first line must be names with commas between, such as step,tau,N,R")
    blank = rows[-1][0] != len(rows)    # blank lines: rare, so line numbers of an error are found slowly
    body = [line.replace(b",", b" ") for number, line in rows[1:]]
    if blank:
        for number, line in rows[1:]:
            numbers([line.replace(b",", b" ")], len(names), path, number)
    return names, numbers(body, len(names), path, 2) if body else np.empty((0, len(names)))


def _ave_time(lines: list[bytes], path: Path) -> tuple[list[str], Array]:
    """`fix ave/time` of scalars: comments, the last of which has the names; then rows."""
    comments = next((n for n, line in enumerate(lines) if not line.startswith(b"#")), len(lines))
    names = lines[comments - 1].decode(errors="replace").lstrip("#").replace(",", " ").split()
    body = lines[comments:]
    return names, numbers(body, len(names), path, comments + 1) if body else np.empty((0, len(names)))


def _thermo(lines: list[bytes], path: Path) -> tuple[list[str], Array]:
    """Thermo output of a log: a line that begins with Step, and rows of numbers until something else comes."""
    tables: list[tuple[list[str], Array]] = []
    starts = [n for n, line in enumerate(lines) if line.split()[:1] == [b"Step"]]
    for start in starts:
        names = lines[start].decode(errors="replace").split()
        body = []
        for line in lines[start + 1:]:
            if line.startswith((b"WARNING", b"Loop time")) or not line.strip():
                if line.startswith(b"WARNING"):
                    continue
                break
            if not _is_number(line.split()[0].decode(errors="replace")):
                break
            body.append(line)
        if body:
            tables.append((names, numbers(body, len(names), path, start + 2)))
    if not tables:
        raise Unusable(f"{path} is no table: neither names with commas between, nor `# TimeStep ...` as of "
                       "fix ave/time, nor a log with a line `Step ...`")
    names, rows = tables.pop()
    for other, before in reversed(tables):
        if other != names or before[-1, 0] > rows[0, 0]:
            break
        rows = np.concatenate([before, rows])
    return names, rows


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


# ---------------------------------------------------------------- boxes

@dataclass(frozen=True)
class Box:
    """A box of LAMMPS: corner lo, hi = lo + edge lengths, tilt factors, and what is periodic.

    Its edges are a = (lx, 0, 0), b = (xy, ly, 0), c = (xz, yz, lz). In 2D, z counts for nothing.
    """

    lo: Array                         # (3,)
    hi: Array                         # (3,)
    tilt: Array                       # (3,): xy, xz, yz
    periodic: NDArray[np.bool_]       # (3,)
    dimension: int                    # 2 or 3

    @property
    def lengths(self) -> Array:
        """(3,): lx, ly, lz."""
        return self.hi - self.lo

    @property
    def edges(self) -> Array:
        """(3, 3): the edges a, b, c in rows."""
        (lx, ly, lz), (xy, xz, yz) = self.lengths, self.tilt
        return np.array([[lx, 0.0, 0.0], [xy, ly, 0.0], [xz, yz, lz]])

    @property
    def volume(self) -> float:
        """Volume; the area in 2D."""
        return float(np.prod(self.lengths[:self.dimension]))

    def _axes(self) -> list[int]:
        """Periodic directions, the last first: b and c have components along those before them."""
        return [axis for axis in reversed(range(self.dimension)) if self.periodic[axis]]

    def wrap(self, x: Array) -> Array:
        """Positions (n, 3) moved into the box through its periodic faces."""
        x, edges = np.array(x, dtype=float), self.edges
        for axis in self._axes():
            corner = (x - self.lo) @ np.linalg.inv(edges)[:, axis]    # 0 to 1 inside
            x -= np.floor(corner)[..., None] * edges[axis]
        return x

    def minimum_image(self, d: Array) -> Array:
        """The shortest of all periodic images of vectors (n, 3), for any tilt along periodic directions."""
        d = self._shortened(np.array(d, dtype=float), below=3)
        if not np.any(self.tilt):
            return d
        images = [d]
        for axis in self._axes():
            if axis > 0:    # the nearest rows along c, then b: with a tilt they may come closer along the axes below
                images = [self._shortened(image + shift * self.edges[axis], below=axis)
                          for image in images for shift in (-1, 0, 1)]
        best = d
        for image in images:
            shorter = np.sum(image**2, axis=-1) < np.sum(best**2, axis=-1)
            best = np.where(shorter[..., None], image, best)
        return best

    def _shortened(self, d: Array, below: int) -> Array:
        """d less whole edges, the last first, until no component along an axis is longer than half its edge."""
        for axis in self._axes():
            if axis < below:
                d = d - np.round(d[..., axis] / self.lengths[axis])[..., None] * self.edges[axis]
        return d


# ---------------------------------------------------------------- frames

@dataclass(frozen=True)
class Frame:
    """One snapshot: step, time (None if the dump has none), box, and columns by name, each (n,)."""

    step: int
    time: float | None
    box: Box
    columns: dict[str, Array]
    path: str = "frame"

    def __len__(self) -> int:
        return len(next(iter(self.columns.values()), ()))

    def __getitem__(self, name: str) -> Array:
        """A column, or a complaint that says what there is."""
        if name not in self.columns:
            raise Unusable(f"{self.path}, step {self.step}, lacks the column {name}; it has {_listed(self.columns)}")
        return self.columns[name]

    @property
    def positions(self) -> Array:
        """(n, 3): x y z; or xu yu zu or xs ys zs if those are there, moved into the box. z = 0 if there is none."""
        columns = self.columns
        if "xs" in columns and "x" not in columns and "xu" not in columns:
            return self.box.wrap(self.box.lo + self._three("xs", "ys", "zs") @ self.box.edges)
        if "xu" in columns and "x" not in columns:
            return self.box.wrap(self._three("xu", "yu", "zu"))
        return self._three("x", "y", "z")

    def _three(self, x: str, y: str, z: str) -> Array:
        last = self.columns.get(z) if self.box.dimension == 2 else self[z]
        return np.column_stack([self[x], self[y], np.zeros(len(self)) if last is None else last])

    @property
    def radius(self) -> Array:
        """(n,)"""
        return self["radius"]


def read_frames(path: Path_) -> Iterator[Frame]:
    """The frames of a dump (`dump custom`, text), one by one; of foam.lammpstrj if `path` is a directory.

    An incomplete frame at the end is left out. The first frame tells the dimension: 2 if all z are equal.
    """
    file = find(path, FRAMES)
    dimension = None
    with open_bytes(file) as stream:
        reader = _Lines(lines_of(stream, file), file)
        while True:
            frame = _next_frame(reader, dimension)
            if frame is None:
                return
            dimension = frame.box.dimension
            yield frame


class _Lines:
    """Lines of a file, and the number of the last one that was read."""

    def __init__(self, lines: Iterator[bytes], path: Path) -> None:
        self.lines, self.path, self.number = lines, path, 0

    def take(self, count: int) -> list[bytes]:
        """`count` lines, or fewer at the end."""
        taken = list(islice(self.lines, count))
        self.number += len(taken)
        return taken

    def wrong(self, what: str) -> Unusable:
        return Unusable(f"{self.path}: line {self.number} {what}")


def _next_frame(reader: _Lines, dimension: int | None) -> Frame | None:
    """The next frame, or None if the file ends before the frame does."""
    items: dict[str, str] = {}
    lengths = {"UNITS": 1, "TIME": 1, "TIMESTEP": 1, "NUMBER OF ATOMS": 1, "BOX BOUNDS": 3}
    while True:
        head = b"".join(reader.take(1)).decode(errors="replace").strip()
        if not head:
            return None
        name = next((name for name in ("ATOMS", "BOX BOUNDS", "NUMBER OF ATOMS", "TIMESTEP", "TIME", "UNITS")
                     if head.startswith(f"ITEM: {name}")), None)
        if name is None:
            raise reader.wrong(f"is '{head[:60]}', where a dump (custom, text) has 'ITEM: ...'")
        items[f"{name} head"] = head[len(f"ITEM: {name}"):].strip()
        if name == "ATOMS":
            return _frame(reader, items, dimension)
        values = reader.take(lengths[name])
        if len(values) < lengths[name]:
            return None
        items[name] = b"".join(values).decode(errors="replace")


def _frame(reader: _Lines, items: dict[str, str], dimension: int | None) -> Frame | None:
    for name in ("TIMESTEP", "NUMBER OF ATOMS", "BOX BOUNDS"):
        if name not in items:
            raise reader.wrong(f"begins bubbles, but no 'ITEM: {name}' came before")
    try:
        step, count = int(items["TIMESTEP"]), int(items["NUMBER OF ATOMS"])
        time = float(items["TIME"]) if "TIME" in items else None
        bounds = np.array(items["BOX BOUNDS"].split(), dtype=float).reshape(3, -1)
    except ValueError as wrong:
        raise reader.wrong(f"begins bubbles whose heading is wrong: {wrong}") from None
    names, first = items["ATOMS head"].split(), reader.number + 1
    if not names:
        raise reader.wrong("names no columns")
    rows = reader.take(count)
    if len(rows) < count:
        return None
    columns = _columns(names, rows, reader, first)
    if dimension is None:
        dimension = _dimension(columns, bounds)
    return Frame(step, time, _box(items["BOX BOUNDS head"], bounds, dimension, reader), columns, str(reader.path))


def _columns(names: list[str], rows: list[bytes], reader: _Lines, first: int) -> dict[str, Array]:
    """Columns of numbers by name. Those of text, such as element, are left out."""
    if not rows:
        return {name: np.empty(0) for name in names}
    words = rows[0].split()
    text = [column for column, word in enumerate(words) if not _is_number(word.decode(errors="replace"))]
    if text and len(words) == len(names):
        kept = [column for column in range(len(names)) if column not in text]
        rows = [b" ".join(row.split()[column] for column in kept) + b"\n" for row in rows
                if len(row.split()) == len(names)]
        names = [names[column] for column in kept]
    table = np.ascontiguousarray(numbers(rows, len(names), reader.path, first).T)
    return dict(zip(names, table))


def _dimension(columns: dict[str, Array], bounds: Array) -> int:
    """2 if all z are equal. A single bubble does not tell: then 2 if the box is thinnest in z."""
    z = next((columns[name] for name in ("z", "zu", "zs") if name in columns), None)
    if z is None:
        return 2
    thin = bounds[2, 1] - bounds[2, 0] < min(bounds[:2, 1] - bounds[:2, 0])
    return 2 if np.all(z == z[:1]) and (len(z) > 1 or thin) else 3


def _box(head: str, bounds: Array, dimension: int, reader: _Lines) -> Box:
    """LAMMPS writes the bounding box of a tilted box, and the tilt in a third column (Howto_triclinic)."""
    words = head.split()
    if "abc" in words:
        raise Unusable(f"{reader.path}: a general triclinic box; write the dump without triclinic/general")
    if bounds.shape[1] != (3 if "xy" in words else 2):
        raise reader.wrong(f"ends a heading whose box bounds '{head}' do not have 2 columns, or 3 of a tilted box")
    periodic = np.array([word == "pp" for word in words if word not in ("xy", "xz", "yz")] or [True] * 3)
    if len(periodic) != 3:
        raise reader.wrong(f"ends a heading whose box bounds '{head}' do not name three boundaries, such as pp pp pp")
    lo, hi = bounds[:, 0].copy(), bounds[:, 1].copy()
    tilt = bounds[:, 2].copy() if bounds.shape[1] == 3 else np.zeros(3)
    xy, xz, yz = tilt
    lo[0] -= min(0.0, xy, xz, xy + xz)
    hi[0] -= max(0.0, xy, xz, xy + xz)
    lo[1] -= min(0.0, yz)
    hi[1] -= max(0.0, yz)
    return Box(lo, hi, tilt, periodic, dimension)
