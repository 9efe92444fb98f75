"""A run: its table and its frames together, and which part of it is meant."""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from .read import Array, Frame, Series, Unusable, need, read_frames, read_series


def growing(series: Series, path: str | Path) -> Series:
    """The rows of `series` with finite tau that increases."""
    need(series, ["tau"], path)
    series = {name: column[np.isfinite(series["tau"])] for name, column in series.items()}
    later = np.append(np.inf, np.diff(series["tau"])) > 0
    return {name: column[later] for name, column in series.items()}


def read_runs(paths: list[Path], names: list[str]) -> list[Series]:
    """The tables of several runs with increasing tau; each has the columns `names`."""
    runs = []
    for path in paths:
        series = growing(read_series(path), path)
        need(series, names, path)
        runs.append(series)
    return runs


def tau_of_N(series: Series, N: float) -> float:
    """tau at which the number of bubbles first is `N` or less; nan if it never is."""
    below = np.flatnonzero(series["N"] <= N)
    return float(series["tau"][below[0]]) if len(below) else float("nan")


def at(series: Series, name: str, tau: Array | float) -> Array:
    """A column at values of tau, linear between lines; nan outside."""
    return np.asarray(np.interp(tau, series["tau"], series[name], left=np.nan, right=np.nan))


# ---------------------------------------------------------------- frames

class Clock:
    """tau and <R_in> of frames: from series.csv beside the dump, if there is one."""

    def __init__(self, path: Path) -> None:
        directory = path if path.is_dir() else path.parent
        self.series: Series | None = None
        if any((directory / name).is_file() for name in ("series.csv", "series.csv.gz")):
            series = read_series(directory)
            if {"step", "tau"} <= set(series):
                self.series = series

    def _at(self, name: str, frame: Frame) -> float:
        if self.series is None or name not in self.series:
            return float("nan")
        return float(np.interp(frame.step, self.series["step"], self.series[name], left=np.nan, right=np.nan))

    def tau(self, frame: Frame) -> float:
        """tau of a frame; nan if it is not known."""
        return self._at("tau", frame)

    def start_radius(self, frame: Frame) -> float:
        """<R_in>: mean radius of the frame over the column R of the series; nan if that is not known."""
        return float(np.mean(frame.radius)) / self._at("R", frame)

    def exchange(self, frame: Frame) -> float:
        """K = tau <R_in>^2 / t, from the whole table; nan if it is not known."""
        if self.series is None or not {"time", "tau", "R"} <= set(self.series):
            return float("nan")
        tau, time = (self.series[name][-1] - self.series[name][0] for name in ("tau", "time"))
        return float(tau / time) * self.start_radius(frame) ** 2 if time > 0 and tau > 0 else float("nan")


class Range:
    """Which frames or lines are meant: --tau FROM TO or --N FROM TO."""

    def __init__(self, tau: list[float] | None, N: list[float] | None) -> None:
        if tau and N:
            raise Unusable("--tau and --N exclude each other")
        self.tau = (min(tau), max(tau)) if tau else None
        self.N = (min(N), max(N)) if N else None

    def __bool__(self) -> bool:
        return self.tau is not None or self.N is not None

    def has(self, tau: float, N: float) -> bool:
        """Whether a state is meant. Unknown tau (nan) never is, where tau is asked for."""
        return ((self.tau is None or self.tau[0] <= tau <= self.tau[1])
                and (self.N is None or self.N[0] <= N <= self.N[1]))


def add_range(parser: argparse.ArgumentParser, what: str, default: str) -> None:
    """Add --tau and --N."""
    parser.add_argument("--tau", nargs=2, type=float, metavar=("FROM", "TO"), help=f"{what} (default: {default})")
    parser.add_argument("--N", nargs=2, type=float, metavar=("FROM", "TO"), help="the same in numbers of bubbles")


def without_end(name: str) -> str:
    """growth of growth.png: all files are named by what comes before."""
    return re.sub(r"\.(csv|pdf|png|mp4|gif|vtu)$", "", name)


def add_runs(parser: argparse.ArgumentParser, what: str, out: str) -> None:
    """Add the arguments that all words have: runs and --out."""
    parser.add_argument("runs", nargs="+", type=Path, metavar="DIR|FILE",
                        help=f"directories of runs, or files: {what}. Several: runs of the same foam with other seeds")
    parser.add_argument("--out", default=out, metavar="BASE", type=without_end,
                        help=f"writes BASE.csv, BASE.pdf, BASE.png (default: {out})")


def alive(frame: Frame) -> Frame:
    """The frame without bubbles of radius 0: those that fix foam/coarsen has removed, but LAMMPS still has."""
    radius = frame.columns.get("radius")
    if radius is None or np.all((radius > 0) & np.isfinite(radius)):
        return frame
    wrong = np.flatnonzero(~(np.isfinite(radius) & (radius >= 0)))
    if len(wrong):
        name = f"id {frame['id'][wrong[0]]:.0f}" if "id" in frame.columns else f"number {wrong[0] + 1}"
        raise Unusable(f"{frame.path}, step {frame.step}: the bubble {name} has a position or a radius that is "
                       f"not finite, or a negative radius: {radius[wrong[0]]:g}")
    return replace(frame, columns={name: column[radius > 0] for name, column in frame.columns.items()})


def chosen_frames(path: Path, which: Range) -> Iterator[tuple[Frame, float]]:
    """Frames of a run in a range, each with its tau (nan if not known); without dead bubbles."""
    clock = Clock(path)
    if which.tau is not None and clock.series is None:
        raise Unusable(f"--tau needs a series.csv with the columns step and tau beside {path}")
    for frame in map(alive, read_frames(path)):
        tau = clock.tau(frame)
        if which.has(tau, len(frame)):
            yield frame, tau
