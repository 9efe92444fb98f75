"""Tables: on the screen and as .csv."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from .files import whole

Table = Mapping[str, Any]    # columns of equal length by name: lists, arrays


def with_end(base: str | Path, end: str) -> Path:
    """base with `end` after its name, such as growth.csv of growth; dots in the name stay."""
    base = Path(base)
    return base.with_name(base.name + end)


def write(table: Table, path: str | Path) -> Path:
    """Write a .csv with a line of names, whole or not at all. nan is written as nothing."""
    path = Path(path)
    lines = [",".join(table)] + [",".join(_exact(value) for value in row) for row in zip(*table.values())]
    with whole(path) as part:
        part.write_text("\n".join(lines) + "\n")
    return path


def show(table: Table, most: int = 40) -> None:
    """Print columns one below the other; of a long table `most` rows at equal distances."""
    rows = [[_short(value) for value in row] for row in zip(*table.values())]
    if len(rows) > most:
        rows = [rows[round(n * (len(rows) - 1) / (most - 1))] for n in range(most)]
    cells = [list(table), *rows]
    widths = [max(len(row[column]) for row in cells) for column in range(len(table))]
    for row in cells:
        print("  ".join(cell.rjust(width) for cell, width in zip(row, widths)).rstrip())


def with_error(value: float, error: float) -> str:
    """A value and its error, to two digits of the error: 0.333 +- 0.012."""
    if not error > 0 or error == float("inf"):
        return f"{value:.4g} (no error known)"
    digits = max(0, 1 - int(f"{error:e}".split("e")[1]))
    return f"{value:.{digits}f} +- {error:.{digits}f}"


def _exact(value: Any) -> str:
    if isinstance(value, str):
        return f'"{value}"' if "," in value else value
    return "" if value != value else f"{value:.10g}"


def _short(value: Any) -> str:
    if isinstance(value, str):
        return value
    return "-" if value != value else f"{value:.5g}"
