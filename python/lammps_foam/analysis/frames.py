"""What the words that look at states have in common: which frames, their axis of time, progress."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
import sys
from typing import Any

from matplotlib.axes import Axes
import numpy as np

from . import figure
from .read import Array, Frame, Unusable
from .runs import Range, chosen_frames

STATES = "dumps with the columns x y z radius (foam.lammpstrj of a directory)"


def optional(name: str) -> Any:
    """A module that not every user has installed, or one line that says how to get it."""
    try:
        return import_module(name)
    except ImportError:
        raise Unusable(f'this needs the Python package {name.split(".")[0]}: '
                       'pip install "lammps-foam[analysis]"') from None


def add_every(parser: argparse.ArgumentParser) -> None:
    """Add --every."""
    parser.add_argument("--every", type=int, default=1, metavar="M", help="of these frames each M-th (default: 1)")


def selected(paths: list[Path], which: Range, every: int = 1) -> Iterator[tuple[int, Frame, float]]:
    """Of each run the chosen frames that have bubbles: number of the run, frame, tau (nan if it is not known)."""
    if every < 1:
        raise Unusable(f"--every {every} must be 1 or more")
    found = 0
    for run, path in enumerate(paths):
        for number, (frame, tau) in enumerate(chosen_frames(path, which)):
            if number % every == 0 and len(frame):
                found += 1
                say(f"{path}: step {frame.step}, tau {tau:.4g}, {len(frame)} bubbles")
                yield run, frame, tau
    say("")
    if not found:
        raise Unusable(f"{', '.join(map(str, paths))}: no frame with bubbles {'in this range' if which else 'yet'}")


def say(text: str) -> None:
    """Progress on one line of a terminal; nothing where the output goes to a file."""
    if sys.stderr.isatty():
        print(f"\r{text[:100]:<100}", end="\r" if not text else "", file=sys.stderr, flush=True)


def phi_of(frame: Frame) -> float:
    """Gas fraction: sum of the areas or volumes of the bubbles over that of the box; overlaps count twice."""
    return float(np.sum(gas(frame.radius, frame.box.dimension)) / frame.box.volume)


def gas(radius: Array, d: int) -> Array:
    """Areas of discs (d = 2) or volumes of spheres (d = 3)."""
    return np.asarray(np.pi * radius**2 if d == 2 else 4 / 3 * np.pi * radius**3)


def time_axis(axes: list[Axes], tau: Array, step: Array) -> Array:
    """Labels the axes of time; the values to draw against: tau if it is known, else the step."""
    known = bool(np.isfinite(tau).all())
    x = tau if known else step
    positive = x[x > 0]
    for ax in axes:
        ax.set_xlabel(figure.TAU if known else "step")
        if len(positive) > 1 and positive.max() > 20 * positive.min():
            ax.set_xscale("log")
            figure.plain_ticks(ax, "x")
    return x
