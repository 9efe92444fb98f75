"""What run.py and plot.py have in common here and in ../wave."""
from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from pathlib import Path
import sys
from typing import Any

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
import numpy as np

from lammps_foam.analysis.read import Frame, read_frames

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "liquid"))
from run import Run, command_words, do, is_complete    # noqa: E402  how a run is done there
from written import cost    # noqa: E402
del sys.path[0]

__all__ = ["Run", "columns", "complete", "cost", "film", "frames_of", "parser_of", "run_all"]


def run_all(wanted: list[Run], args: argparse.Namespace) -> None:
    """Those that are not complete."""
    if args.dry_run:
        for run in wanted:
            print(f"{run.name:24}", *run.arguments())
        return
    missing = [run for run in wanted if not is_complete(run, args.out / run.name)]
    print(f"{len(wanted)} runs, {len(wanted) - len(missing)} of them complete", flush=True)
    for done, run in enumerate(missing):
        print(f"run {done + 1} of {len(missing)}: {run.name}", flush=True)
        do(run, command_words(args.lmp), args.out / run.name)


def parser_of(text: str, groups: tuple[str, ...]) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(description=text.splitlines()[0])
    parser.add_argument("--lmp", default="lmp", metavar="COMMAND",
                        help='how to start LAMMPS, as one string (default "%(default)s")')
    parser.add_argument("--out", default="out", type=Path, metavar="DIR", help="where everything is written")
    parser.add_argument("--full", action="store_true", help="the size for a GPU, too")
    parser.add_argument("--only", nargs="+", choices=groups, default=list(groups), help="these runs (default: all)")
    parser.add_argument("--dry-run", action="store_true", help="list the runs, and end")
    parser.add_argument("--no-plots", action="store_true", help="runs alone")
    return parser


def frames_of(dump: Path) -> Iterator[Frame]:
    """Without those that a run wrote again when it went on from a restart file."""
    last = -1
    for frame in read_frames(dump):
        if frame.step > last:
            last = frame.step
            yield frame


def complete(out: Path, group: str) -> list[Path]:
    """Runs of a group, those of numbers by size."""
    found = [path.parent for path in (out / group).glob("*/complete")]
    return sorted(found, key=lambda path: (not path.name.isdigit(), int(path.name) if path.name.isdigit() else 0))


def columns(rows: list[dict[str, Any]]) -> dict[str, list[Any]]:
    """For tables: numbers have four digits."""
    return {name: [float(f"{row[name]:.4g}") if isinstance(row[name], float) else row[name] for row in rows]
            for name in rows[0]}


def film(frames: Iterator[Frame], fig: Figure, draw: Callable[[Frame], None], base: Path, kind: str = "auto") -> None:
    """A movie of pictures that `draw` makes in the figure."""
    from lammps_foam.analysis.movie import Writer, kind_of_file

    canvas, good = FigureCanvasAgg(fig), False
    writer = Writer(str(base), kind_of_file(kind), 12.0)
    try:
        for frame in frames:
            draw(frame)
            canvas.draw()
            writer.add(np.asarray(canvas.buffer_rgba())[..., :3])
        good = True
    finally:
        writer.close(good)
