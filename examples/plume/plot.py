#!/usr/bin/env python3
"""A plume by in.plume: the tank, the speed against the distance from the axis, and along it.

    python3 plot.py DIR [--from T]        of DIR/plume.lammpstrj and DIR/series.csv; figures and tables go into DIR

Means are over the snapshots from the time T on (default: the later half). At each height the vertical speed of the
liquid is fitted by a Gaussian, w = w_0 exp(-r^2/b^2). Errors are by the scatter of four parts of the time.
"""
from __future__ import annotations

import argparse
from pathlib import Path
import sys

from matplotlib import pyplot as plt
import numpy as np
from numpy.typing import NDArray
from scipy.optimize import curve_fit

from lammps_foam.analysis import figure, table
from lammps_foam.analysis.read import Frame, Unusable, read_frames, read_series

Array = NDArray[np.float64]
HEIGHTS = np.arange(0.2, 0.91, 0.1)
HALF = 0.05               # of a layer
RINGS = np.arange(0.0, 0.41, 0.04)


def gaussian(r: Array, w0: float, b: float) -> Array:
    return w0 * np.exp(-(r / b)**2)


def frames_of(directory: Path, start: float | None) -> tuple[list[Frame], Frame]:
    """Those from the time `start` on, and the last."""
    every = list(read_frames(directory / "plume.lammpstrj"))
    if len(every) < 3:
        raise Unusable(f"{directory / 'plume.lammpstrj'} has {len(every)} snapshots: three are needed")
    start = every[-1].time / 2 if start is None else start
    chosen = [one for one in every if one.time >= start]
    if not chosen:
        raise Unusable(f"there is no snapshot from the time {start} on: the last is of {every[-1].time}")
    return chosen, every[-1]


def profiles(frames: list[Frame]) -> list[dict[str, float]]:
    """Of each height: w_0, b and their errors, by the scatter of quarters of the time."""
    rows = []
    for z in HEIGHTS:
        w, r = rings(frames, z)
        fit = fitted(r, w)
        parts = [fitted(*reversed(rings(part, z))) for part in quarters(frames)]
        errors = np.std(parts, axis=0, ddof=1) / np.sqrt(len(parts)) if len(parts) > 1 else (np.nan, np.nan)
        rows.append({"z": z, "w0": fit[0], "w0_error": errors[0], "b": fit[1], "b_error": errors[1]})
    return rows


def quarters(frames: list[Frame]) -> list[list[Frame]]:
    return [[frames[n] for n in part] for part in np.array_split(np.arange(len(frames)), 4) if len(part)]


def rings(frames: list[Frame], z: float) -> tuple[Array, Array]:
    """Mean vertical speed of the liquid in rings around the axis at the height z, and their radii."""
    w, r = [], []
    for frame in frames:
        mine = (frame["type"] == 1) & (abs(frame["z"] - z) < HALF)
        w.append(frame["vz"][mine])
        r.append(np.hypot(frame["x"][mine], frame["y"][mine]))
    speeds, radii = np.concatenate(w), np.concatenate(r)
    which = np.digitize(radii, RINGS)
    there = [n for n in range(1, len(RINGS)) if np.any(which == n)]
    return (np.array([speeds[which == n].mean() for n in there]), np.array([radii[which == n].mean() for n in there]))


def fitted(r: Array, w: Array) -> tuple[float, float]:
    (w0, b), _ = curve_fit(gaussian, r, w, p0=(max(w[0], 1e-3), 0.1))
    return float(w0), abs(float(b))


# ------------------------------------------------------------------ figures

def draw_tank(frame: Frame, out: Path) -> None:
    fig, (left, right) = figure.panels(1, 2, width=3.0, height=3.4)
    liquid, near = frame["type"] == 1, abs(frame["y"]) < 0.04
    mine = liquid & near
    speed = np.hypot(frame["vx"][mine], frame["vz"][mine])
    drawn = left.quiver(frame["x"][mine], frame["z"][mine], frame["vx"][mine], frame["vz"][mine], speed, cmap="viridis",
                        scale=3.0, width=0.004)
    fig.colorbar(drawn, ax=left, shrink=0.7, label="speed")
    mine = ~liquid & (abs(frame["y"]) < 0.1)
    right.plot(frame["x"][mine], frame["z"][mine], "k.", ms=0.8)
    for ax in (left, right):
        ax.set(xlim=(-0.5, 0.5), ylim=(0, 1.15), aspect="equal", xlabel="x", ylabel="z")
    left.set(title=f"liquid, t = {frame.time:.1f}")
    right.set(title=f"{np.count_nonzero(~liquid)} bubbles")
    save(fig, out / "plume-tank")


def draw_profiles(frames: list[Frame], rows: list[dict[str, float]], out: Path) -> None:
    fig, (left, right) = figure.panels(1, 2, width=3.0, height=2.5)
    x = np.linspace(0, 3, 100)
    for row in rows:
        w, r = rings(frames, row["z"])
        left.plot(r / row["b"], w / row["w0"], "o", ms=3, label=f"z = {row['z']:.1f}")
    left.plot(x, np.exp(-x**2), "k-", lw=0.8)
    left.set(xlabel=r"$r/b$", ylabel=r"$w/w_0$", xlim=(0, 3))
    left.legend(ncols=2)
    columns = {key: np.array([row[key] for row in rows]) for key in rows[0]}
    right.errorbar(columns["z"], columns["w0"], columns["w0_error"], fmt="o-", label=r"$w_0$")
    right.errorbar(columns["z"], columns["b"], columns["b_error"], fmt="s--", label=r"$b$")
    right.set(xlabel="z", ylabel=r"speed on the axis $w_0$, width $b$", ylim=(0, None))
    right.legend()
    save(fig, out / "plume-profiles")


def save(fig: plt.Figure, base: Path) -> None:
    fig.savefig(base.with_suffix(".png"), dpi=160)
    plt.close(fig)


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("directory", type=Path, metavar="DIR")
    parser.add_argument("--from", dest="start", type=float, metavar="T", help="first time of means (default: half)")
    args = parser.parse_args()
    try:
        frames, last = frames_of(args.directory, args.start)
        read_series(args.directory / "series.csv")
    except Unusable as wrong:
        sys.exit(f"plot.py: {wrong}")
    rows = profiles(frames)
    table.write({key: [row[key] for row in rows] for key in rows[0]}, args.directory / "profiles.csv")
    draw_tank(last, args.directory)
    draw_profiles(frames, rows, args.directory)
    for row in rows:
        print(f"z {row['z']:.1f}: w_0 {table.with_error(row['w0'], row['w0_error'])}, "
              f"b {table.with_error(row['b'], row['b_error'])}")


if __name__ == "__main__":
    main()
