"""The files that the thesis' program wrote, made from those of LAMMPS: NAME.csv.N, and a line for each unit of tau."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .tables import Frame, frames, read_series, replace

SNAPSHOT = ["x", "y", "z", "r", "vx", "vy", "vz", "vtot", "path", "distance", "energy", "displacement", "index"]
RESULTS = ["tau", "R", "Rmax", "N", "path", "msd", "energy", "change", "edurian", "change_edurian"]


@dataclass
class Places:
    """Unwrapped, (n, 3), of bubbles by their IDs, in rising order."""
    ids: np.ndarray
    x: np.ndarray

    def moved(self, before: Places) -> np.ndarray:
        """Distances from those before, (n,); 0 for bubbles that were not there."""
        distance = np.zeros(len(self.ids))
        _, here, there = np.intersect1d(self.ids, before.ids, assume_unique=True, return_indices=True)
        distance[here] = np.linalg.norm(self.x[here] - before.x[there], axis=1)
        return distance


def snapshots(directory: Path, name: str) -> int:
    """Write NAME.csv.0, NAME.csv.1, ..., one for each snapshot of the run and the last state; returns how many.

    Lengths, velocities and energies in the units of the input; places from the lower corner of the box, in it.
    distance is from the place at the start of coarsening, displacement from that in the snapshot before, both straight;
    energy is half of the energies of the springs to the bubbles in contact, index counts from 0.
    """
    count = 0
    places = Places(np.empty(0, int), np.empty((0, 3)))
    for frame in _all_frames(directory):
        lines, places = _snapshot(frame, places)
        replace(directory / f"{name}.csv.{count}", "\n".join([",".join(SNAPSHOT), *lines]) + "\n")
        count += 1
    return count


def _all_frames(directory: Path) -> Iterator[Frame]:
    """Those of the dump, and the last state if it is later."""
    last = -1
    for name in ("foam.lammpstrj", "foam.lammpstrj.gz", "last.lammpstrj"):
        if (directory / name).exists():
            for frame in frames(directory / name):
                if frame.step > last:
                    yield frame
                    last = frame.step


ROW = ",".join(["%.9g"] * (len(SNAPSHOT) - 1) + ["%d"])


def _snapshot(frame: Frame, before: Places) -> tuple[list[str], Places]:
    """Lines of the table, and the places for the next one."""
    data = np.fromstring(b" ".join(frame.rows).decode(), sep=" ").reshape(len(frame.rows), len(frame.names))
    column = dict(zip(frame.names, data.T))
    lo, hi = np.array([bounds[:2] for bounds in frame.bounds]).T
    x = np.column_stack([column[axis] for axis in "xyz"])
    images = np.column_stack([column[f"i{axis}"] for axis in "xyz"])
    places = Places(column["id"].astype(int), x + images * (hi - lo))
    inside = x - lo
    # LAMMPS wraps when it builds lists; between, a bubble may be a little outside of a periodic box
    inside -= np.floor(inside / (hi - lo)) * (hi - lo)
    if np.all(x[:, 2] == 0.0):    # 2D
        inside[:, 2] = 0.0
    v = np.column_stack([column[f"v{axis}"] for axis in "xyz"])
    table = np.column_stack([inside, column["radius"], v, np.linalg.norm(v, axis=1), column["path"],
                             column["distance"], column["energy"], places.moved(before), places.ids - 1])
    return [ROW % tuple(row) for row in table.tolist()], places


def results(directory: Path) -> int:
    """Write results.csv: the first line of series.csv at or after tau = 1, 2, 3, ...; returns the number of lines.

    change is 2 |E2 - E1| / (E1 + E2) between these lines, the first from tau = 0: of the pair energy, and of the energy
    that the thesis reports (edurian; the thesis' program prints twice that, for sigma = 1).
    """
    series = read_series(directory / "series.csv")
    column = {name: series.column(name) for name in series.names}
    lines, wanted, before = [], 1, 0
    for n, tau in enumerate(column["tau"]):
        if tau < wanted:
            continue
        row = {name: column[name][n] for name in series.names}
        row["change"] = _change(column["energy"][before], column["energy"][n])
        row["change_edurian"] = _change(column["edurian"][before], column["edurian"][n])
        lines.append(",".join(f"{row[name]:.10g}" for name in RESULTS))
        wanted, before = math.floor(tau) + 1, n
    replace(directory / "results.csv", "\n".join([",".join(RESULTS), *lines]) + "\n")
    return len(lines)


def _change(before: float, now: float) -> float:
    both = before + now
    return 2.0 * abs(now - before) / both if both > 0.0 else 0.0
