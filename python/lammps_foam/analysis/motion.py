"""Mean squared displacement and mean path against tau, and the distribution of displacements.

From the table, if it has msd or path: averages over the bubbles that are left, in <R_in>. From the frames otherwise, or
with --frames: bubbles are followed by id, and each is moved on by the nearest periodic image of where it was in the
frame before. This is right as long as no bubble goes further than half a box between frames; the columns xu yu zu make
it right always. The path from frames is a sum of straight pieces, so it is a lower bound, unless there is a column
path. Both count from the first frame of the range, path columns of the table from the start of the run.

Errors are standard errors over runs, at the same tau. One run has none: its bubbles move together, and the scatter
among them says nothing of another run.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from . import figure, table
from .read import Array, Frame, Series, Unusable, find, read_series
from .runs import Clock, Range, add_range, add_runs, chosen_frames, growing

POINTS = 60    # of the table, at equal steps of ln(tau)


# ---------------------------------------------------------------- following bubbles

class Followed:
    """Displacements of the bubbles that are left since the first frame, through periodic faces."""

    def __init__(self, first: Frame) -> None:
        self.id, self.at, self.path_column = _by_id(first)
        self.displacement = np.zeros_like(self.at)    # (n, 3)
        self.path = np.zeros(len(self.at))            # (n,)

    def go_on(self, frame: Frame) -> None:
        """Take the next frame. Bubbles that are gone are forgotten; new ones are not followed."""
        ids, at, path = _by_id(frame)
        _, before, now = np.intersect1d(self.id, ids, assume_unique=True, return_indices=True)
        step = at[now] - self.at[before]
        if "xu" not in frame.columns:
            step = frame.box.minimum_image(step)
        further = np.linalg.norm(step, axis=1)
        if path is not None and self.path_column is not None:
            further = path[now] - self.path_column[before]
        self.displacement = self.displacement[before] + step
        self.path = self.path[before] + further
        self.id, self.at, self.path_column = ids[now], at[now], None if path is None else path[now]


def _by_id(frame: Frame) -> tuple[Array, Array, Array | None]:
    """id, position (xu yu zu if there), path (None if not there), in the order of id."""
    order = np.argsort(frame["id"])
    ids = frame["id"][order]
    if np.any(ids[1:] == ids[:-1]):
        raise Unusable(f"{frame.path}, step {frame.step}: two bubbles have the same id")
    at = frame.positions
    if "xu" in frame.columns:
        at = np.column_stack([frame["xu"], frame["yu"], frame.columns.get("zu", np.zeros(len(frame)))])
    return ids, at[order], frame["path"][order] if "path" in frame.columns else None


@dataclass
class Motion:
    """Columns of the motion of a run; msd and path in units of the length that is said."""

    tau: list[float] = field(default_factory=list)
    bubbles: list[float] = field(default_factory=list)
    msd: list[float] = field(default_factory=list)
    path: list[float] = field(default_factory=list)
    drift: list[float] = field(default_factory=list)         # |mean displacement|
    last: Array = field(default_factory=lambda: np.empty((0, 3)))    # displacements at the end

    def columns(self) -> Series:
        names = ("tau", "bubbles", "msd", "path", "drift")
        return {name: np.array(getattr(self, name), dtype=float) for name in names}


def follow(frames: Iterable[tuple[Frame, float]], unit: float = 1.0) -> Motion:
    """The motion over frames, given with their tau; lengths are divided by `unit`."""
    motion, bubbles = Motion(), None
    for frame, tau in frames:
        if bubbles is None:
            bubbles = Followed(frame)
        else:
            bubbles.go_on(frame)
        if len(bubbles.id) == 0:
            break
        squares = np.sum(bubbles.displacement**2, axis=1)
        motion.tau.append(tau)
        motion.bubbles.append(len(bubbles.id))
        motion.msd.append(float(np.mean(squares)) / unit**2)
        motion.path.append(float(np.mean(bubbles.path)) / unit)
        motion.drift.append(float(np.linalg.norm(np.mean(bubbles.displacement, axis=0))) / unit)
        motion.last = bubbles.displacement / unit
    return motion


def non_gaussian(d: Array, dimension: int) -> float:
    """alpha_2 = D <d^4> / ((D + 2) <d^2>^2) - 1 of displacements (n, 3) less their mean: 0 if they are normal.

    Rahman, Phys. Rev. 136, A405 (1964), for three dimensions.
    """
    square = np.sum((d - d.mean(axis=0)) ** 2, axis=1)
    return float(dimension * np.mean(square**2) / ((dimension + 2) * np.mean(square) ** 2) - 1)


def components(d: Array, dimension: int) -> Array:
    """All components of displacements (n, 3), less their mean and over their standard deviation."""
    d = d[:, :dimension] - d[:, :dimension].mean(axis=0)
    return np.asarray(d / d.std(axis=0)).ravel()


# ---------------------------------------------------------------- command line

def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_runs(parser, "tables with msd or path, or dumps with the column id", "motion")
    add_range(parser, "frames that are followed; lines that are shown", "all")
    parser.add_argument("--frames", action="store_true", help="follow bubbles in the dumps, though tables have msd")
    parser.epilog = ("example: displacements from tau 10 on\n"
                     "  lammps-foam motion phi0.95 --frames --tau 10 100 --out motion")


def main(args: argparse.Namespace) -> int:
    which = Range(args.tau, args.N)
    runs, ends = [], []
    for path in args.runs:
        columns = None if args.frames else _of_table(path, which)
        if columns is None:
            columns, end = _of_frames(path, which)
            ends.append(end)
        runs.append(columns)
    names = sorted(set.intersection(*map(set, runs)), key=list(runs[0]).index)
    together = _together([{name: run[name] for name in names} for run in runs])
    table.show(together)
    print("\nlengths in <R_in>; " + (f"standard errors from the scatter of {len(runs)} runs" if len(runs) > 1 else
                                     "no errors from one run: give several seeds"))
    distribution = _distribution(ends)
    if distribution:
        table.write(distribution, table.with_end(args.out, "-displacements.csv"))
    table.write(together, table.with_end(args.out, ".csv"))
    _draw(together, distribution, args.out)
    return 0


def _of_table(path: Path, which: Range) -> Series | None:
    """tau, bubbles, msd, path of a table; None if it has neither msd nor path."""
    try:
        series = growing(read_series(path), path)
    except Unusable:
        return None    # a dump, or a directory without a table: its frames are followed
    if not {"msd", "path"} & set(series):
        return None
    N = series.get("N", np.full(len(series["tau"]), np.nan))
    meant = np.array([which.has(tau, n) for tau, n in zip(series["tau"], N)])
    if not meant.any():
        raise Unusable(f"{path} has no line in the range of --tau or --N")
    columns = {"tau": series["tau"], "bubbles": N}
    columns.update({name: series[name] for name in ("msd", "path") if name in series})
    return {name: column[meant] for name, column in columns.items()}


def _of_frames(path: Path, which: Range) -> tuple[Series, tuple[Array, int]]:
    """The same and drift from frames; and the last displacements with the dimension."""
    if not path.is_dir():
        find(path, ())
    clock, unit, dimension = Clock(path), 0.0, 2
    if clock.series is None:
        raise Unusable(f"frames need a series.csv with the columns step and tau beside {path}")

    def frames() -> Iterable[tuple[Frame, float]]:
        nonlocal unit, dimension
        for frame, tau in chosen_frames(path, which):
            if not unit:
                unit, dimension = clock.start_radius(frame), frame.box.dimension
            if np.isfinite(tau):
                yield frame, tau

    motion = follow(frames())
    if len(motion.tau) < 2:
        raise Unusable(f"{path} has no two frames in the range that share bubbles")
    if not np.isfinite(unit):
        raise Unusable(f"the series.csv beside {path} lacks the column R at the first frame of the range")
    columns = motion.columns()
    for name, power in (("msd", 2), ("path", 1), ("drift", 1)):
        columns[name] = columns[name] / unit**power
    return columns, (motion.last / unit, dimension)


def _together(runs: list[Series]) -> dict[str, Array]:
    """Columns at common values of tau, with standard errors over runs."""
    tau = _common_tau(runs)
    columns: dict[str, Array] = {"tau": tau}
    for name in runs[0]:
        if name == "tau":
            continue
        values = np.array([_between(tau, run["tau"], run[name]) for run in runs])
        columns[name] = values.mean(axis=0)
        if len(runs) > 1:
            columns[f"{name}_error"] = values.std(axis=0, ddof=1) / np.sqrt(len(runs))
    return columns


def _between(tau: Array, at: Array, values: Array) -> Array:
    """Linear between lines; in the logarithms, where values are above 0: displacements grow like powers."""
    later = (at > 0) & (values > 0)
    linear = np.interp(tau, at, values)
    if np.count_nonzero(later) < 2:
        return np.asarray(linear)
    powers = np.exp(np.interp(np.log(tau, where=tau > 0, out=np.full(len(tau), -np.inf)), np.log(at[later]),
                              np.log(values[later])))
    return np.where(tau >= at[later][0], powers, linear)


def _common_tau(runs: list[Series]) -> Array:
    if len(runs) == 1 and len(runs[0]["tau"]) <= POINTS:
        return runs[0]["tau"]
    first = max(run["tau"][run["tau"] > 0][0] for run in runs if np.any(run["tau"] > 0))
    last = min(float(run["tau"][-1]) for run in runs)
    if not first < last:
        raise Unusable("the runs have no range of tau in common")
    return np.geomspace(max(first, last * 1e-4), last, POINTS)


def _distribution(ends: list[tuple[Array, int]]) -> dict[str, Array]:
    """Density of the components of the last displacements, pooled, and the standard normal density."""
    if not ends or min(len(d) for d, _ in ends) < 20:
        return {}
    dimension = ends[0][1]
    pooled = np.concatenate([components(d, dimension) for d, _ in ends])
    alpha = [non_gaussian(d, dimension) for d, _ in ends]
    print(f"displacements at the end: alpha_2 = {np.mean(alpha):.3f}"
          + (f" +- {np.std(alpha, ddof=1) / np.sqrt(len(alpha)):.3f}" if len(alpha) > 1 else "")
          + " (0 if they are normal)")
    edges = np.linspace(-6, 6, 41)
    middle, width = (edges[1:] + edges[:-1]) / 2, edges[1] - edges[0]
    counts = np.histogram(pooled, edges)[0]
    return {"d": middle, "P": counts / (len(pooled) * width), "error": np.sqrt(counts) / (len(pooled) * width),
            "normal": np.exp(-middle**2 / 2) / np.sqrt(2 * np.pi)}


def _draw(columns: dict[str, Array], distribution: dict[str, Array], out: str) -> None:
    labels = {"msd": r"$\langle \Delta r^2\rangle\,/\,\langle R_\mathrm{in}\rangle^2$",
              "path": r"mean path $/\,\langle R_\mathrm{in}\rangle$"}
    names = [name for name in labels if name in columns]
    fig, axes = figure.panels(1, len(names) + bool(distribution))
    for ax, name in zip(axes, names):
        shown = (columns["tau"] > 0) & (columns[name] > 0)
        error = columns.get(f"{name}_error", np.zeros(len(shown)))
        ax.errorbar(columns["tau"][shown], columns[name][shown], error[shown], fmt="o-", lw=0.8, ms=2)
        ax.set(xscale="log", yscale="log", xlabel=figure.TAU, ylabel=labels[name])
    if distribution:
        some, last = distribution["P"] > 0, axes[-1]
        last.errorbar(distribution["d"][some], distribution["P"][some], distribution["error"][some], fmt="o",
                      color="k", lw=0.7, label="at the end")
        last.plot(distribution["d"], distribution["normal"], "--", color="C1", label="normal")
        last.set(yscale="log", xlabel=r"$\Delta x\,/\,\sigma$", ylabel="probability density",
                 ylim=(min(distribution["P"][some]) / 3, 2))
        last.legend(loc="upper right")
    figure.save(fig, out)
