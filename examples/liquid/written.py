"""What run.py wrote: settings, series, times of runs; and tables of them."""
from __future__ import annotations

import csv
import json
from pathlib import Path
import re
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lammps_foam.analysis import table
from lammps_foam.analysis.read import Unusable

Array = NDArray[np.float64]
Series = dict[str, Array]
Rows = list[dict[str, Any]]
HERE = Path(__file__).resolve().parent


def settings(directory: Path, script: str) -> dict[str, float]:
    """Numbers that a run had: those of its script, but for those that it was given."""
    words = dict(re.findall(r"^variable\s+(\w+)\s+index\s+(\S+)", (HERE / script).read_text(), re.M))
    words.update(json.loads((directory / "settings.json").read_text()))
    return {name: float(value) for name, value in words.items() if re.fullmatch(r"[-+.\deE]+", value)}


def read_table(path: Path) -> Series:
    if not path.is_file():
        raise Unusable(f"there is no {path}: run.py writes it")
    with path.open(newline="") as file:
        rows = [row for row in csv.reader(file) if row]
    if len(rows) < 3:
        raise Unusable(f"{path} needs two lines of numbers at least")
    return dict(zip(rows[0], np.array(rows[1:], dtype=float).T))


def complete(directory: Path) -> list[Path]:
    """Runs below it, those of numbers by size."""
    found = [path.parent for path in directory.glob("*/complete")]
    return sorted(found, key=lambda path: (not path.name[0].isdigit(), float(path.name.split("-")[0])
                                           if path.name[0].isdigit() else 0.0, path.name))


def is_complete(directory: Path) -> bool:
    return (directory / "complete").is_file()


def folder(name: str) -> str:
    """Of the run of that name."""
    return name.replace(" ", "-").replace("/", "-")


def cost(log: Path) -> tuple[int, float]:
    """Steps, and seconds that the processor spent on them: LAMMPS counts those of the program alone."""
    found = re.search(r"Loop time of (\S+) on (\d+) procs for (\d+) steps[^%]*?([\d.]+)% CPU use", log.read_text())
    if not found:
        raise Unusable(f"{log} has no 'CPU use'")
    return int(found[3]), float(found[1]) * float(found[2]) * float(found[4]) / 100


def of_sizes(rows: Rows) -> Rows:
    """Those that are named by their size alone."""
    return [row for row in rows if row["run"].isdigit()]


def columns(rows: Rows) -> dict[str, list[Any]]:
    return {name: [row[name] for row in rows] for name in rows[0]} if rows else {}


def report(rows: Rows, path: Path, digits: int = 4) -> None:
    """Write a table, of so many digits, and show it."""
    if not rows:
        return
    rounded = {name: [float(f"{value:.{digits}g}") if isinstance(value, (float, np.floating)) else value
                      for value in column] for name, column in columns(rows).items()}
    table.show(rounded)
    table.write(rounded, path)
