"""What the figures of this directory have in common: where runs and pictures are, ranges of tau, what a run took."""
from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
import re

from matplotlib import pyplot as plt
import numpy as np
from PIL import Image

from lammps_foam.analysis import runs, table

LATE = 5.0     # exponents are of what comes after so many times fewer bubbles are left, and before
LAST = 1.3     # so many times as many as in the last line
DPI = 200


@dataclass(frozen=True)
class Place:
    """Where the runs are, where figures and tables go, and whether PDF are wanted besides PNG."""

    runs: Path
    out: Path
    pdf: bool = True

    def run(self, name: str) -> Path:
        return self.runs / name / "run"

    def has(self, name: str) -> bool:
        return (self.run(name) / "complete").exists()

    def save(self, fig, name: str, dpi: int = DPI, colors: int = 0) -> None:
        """PNG and PDF; with `colors` the PNG has so few, which makes pictures of many bubbles small."""
        png = self.out / f"{name}.png"
        fig.savefig(png, dpi=dpi)
        if self.pdf:
            fig.savefig(self.out / f"{name}.pdf", dpi=dpi)
        plt.close(fig)
        if colors:
            with Image.open(png) as picture:
                few = picture.convert("RGB").quantize(colors)
            few.save(png, optimize=True)

    def write(self, rows: list[dict[str, object]], name: str) -> None:
        """A table of rows with the same keys. Text goes as it is, numbers with all digits."""
        table.write({key: [row[key] for row in rows] for key in rows[0]}, self.out / f"{name}.csv")

    def read(self, name: str) -> list[dict[str, str]]:
        """The rows of a table that is there, or none."""
        path = self.out / f"{name}.csv"
        if not path.exists():
            return []
        with path.open(newline="") as file:
            return list(csv.DictReader(file))

    def merge(self, rows: list[dict[str, object]], name: str, order: Sequence[str]) -> list[dict[str, object]]:
        """As write(), of rows that begin with the name of a run. Those of other runs, which were made elsewhere and
        stand in the table that is there, stay. So runs of a night need not be in one place."""
        key = next(iter(rows[0]))
        ours = {row[key] for row in rows}
        kept = [row for row in self.read(name) if row[key] not in ours and list(row) == list(rows[0])]
        places = {run: place for place, run in enumerate(order)}
        merged = sorted([*kept, *rows], key=lambda row: places.get(str(row[key]), len(places)))    # stable
        self.write(merged, name)
        return merged


@dataclass(frozen=True)
class Result:
    """A line of the table that compares with the thesis."""

    figure: str
    published: str
    ours: str
    names: list[str]     # of the runs it needs


def with_error(value: float, error: float) -> str:
    return table.with_error(value, error).replace("+-", "±")


def range_of(values, digits: str = ".2f") -> str:
    return f"{min(values):{digits}} to {max(values):{digits}}"


# ------------------------------------------------------------------ runs

def tables(place: Place, names: list[str]):
    return runs.read_runs([place.run(name) for name in names], ["R", "N"])


def late(series) -> tuple[float, float]:
    """Range of tau of the runs in which the exponent is taken."""
    start = max(runs.tau_of_N(one, one["N"][0] / LATE) for one in series)
    return start, min(runs.tau_of_N(one, LAST * one["N"][-1]) for one in series)


def minutes(directory: Path) -> float:
    """Wall time of a run by its logs. The last line of an interrupted part may have waited: the one before counts."""
    total = 0.0
    for log in directory.glob("log.foam*"):
        text = log.read_text(errors="replace")
        whole = re.search(r"^Total wall time: (\d+):(\d+):(\d+)", text, re.MULTILINE)
        if whole:
            hours, minute, second = map(int, whole.groups())
            total += 3600 * hours + 60 * minute + second
            continue
        total += sum(map(float, re.findall(r"^Loop time of (\S+)", text, re.MULTILINE)))
        lines = re.split(r"^ *Step .*CPU *$", text, flags=re.MULTILINE)[-1]     # of the last table
        if "Loop time" not in lines:
            rows = re.findall(r"^ *\d+ .*? ([\d.e+-]+) *$", lines, re.MULTILINE)
            total += float(rows[max(len(rows) - 2, 0)]) if rows else 0.0
    return total / 60


def minutes_of(place: Place, name: str) -> float:
    """Of a run that is here, or that stands in the table of runs."""
    if place.has(name):
        return minutes(place.run(name))
    return next((float(row["minutes"] or 0) for row in place.read("runs") if row["run"] == name), 0.0)


def end_of(directory: Path) -> tuple[int, float, int]:
    """Step, tau and bubbles at the end of a complete run."""
    text = (directory / "complete").read_text()
    step, tau, left = re.search(r"step (\d+), tau (\S+), (\d+) bubbles", text).groups()
    return int(step), float(tau), int(left)


def shown_minutes(values) -> str:
    return f"{np.sum(values):.0f}"


# ------------------------------------------------------------------ the table that compares

def compare(place: Place, results: list[Result], command: str) -> None:
    """Put results into summary.csv, in the place of older ones of the same figures."""
    path = place.out / "summary.csv"
    head = ["figure", "published", "ours", "command", "minutes"]
    rows = {row["figure"]: row for row in place.read("summary")}
    for one in results:
        spent = shown_minutes([minutes_of(place, name) for name in one.names])
        rows[one.figure] = dict(zip(head, (one.figure, one.published, one.ours, f":code:`{command}`", spent)))
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, head, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows[key] for key in sorted(rows, key=place_of))


def place_of(figure: str) -> tuple[float, ...]:
    """4.10 comes after 4.9; what has no number comes last."""
    numbers = re.findall(r"\d+", figure)[:2]
    return tuple(map(float, numbers)) if numbers else (99.0,)
