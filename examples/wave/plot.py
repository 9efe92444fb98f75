#!/usr/bin/env python3
"""A wave by in.wave: pictures of it, its energy, the gas that it entrains, and the sizes of the bubbles.

    python3 plot.py DIR [--at T ...]      of DIR/wave.lammpstrj and DIR/series.csv; figures and tables go into DIR

Sizes are those of all snapshots, a bubble in each of them. Lines are the powers that the source expects below and above
the size of Hinze, a_H = We^(-3/5) / 2: -3/2 and -10/3.
"""
from __future__ import annotations

import argparse
from pathlib import Path
import sys

from matplotlib import pyplot as plt
import numpy as np

from lammps_foam.analysis import figure, table
from lammps_foam.analysis.read import Frame, Series, Unusable, read_frames, read_series

WE = 1.98e4
CLASSES = np.geomspace(1e-4, 3e-2, 21)


def draw_wave(frames: list[Frame], times: list[float], out: Path) -> None:
    """Particles from the side, by their speed, and bubbles."""
    fig, axes = figure.panels(len(times), 1, width=5.0, height=2.9)
    for ax, time in zip(axes, times):
        frame = min(frames, key=lambda one: abs(one.time - time))
        liquid = frame["type"] == 1
        speed = np.sqrt(frame["vx"]**2 + frame["vy"]**2 + frame["vz"]**2)
        order = np.argsort(frame["y"][liquid])[::-1]    # from the back to the front
        drawn = ax.scatter(frame["x"][liquid][order], frame["z"][liquid][order], c=speed[liquid][order], s=3,
                           cmap="viridis", vmin=0, vmax=0.6, linewidths=0)
        ax.scatter(frame["x"][~liquid], frame["z"][~liquid], s=2e6 * frame["radius"][~liquid]**2, facecolors="none",
                   edgecolors="C3", linewidths=0.5)
        ax.set(xlim=(0, 1), ylim=(0.2, 0.75), aspect="equal", xlabel="x", ylabel="z",
               title=f"t = {frame.time:.2f}, {np.count_nonzero(~liquid)} bubbles")
        fig.colorbar(drawn, ax=ax, shrink=0.8, label="speed")
    save(fig, out / "wave-pictures")


def draw_series(series: Series, frames: list[Frame], out: Path) -> None:
    fig, (left, middle, right) = figure.panels(1, 3, width=2.6, height=2.4)
    left.plot(series["time"], series["energy"] / series["energy"][0], label="energy")
    left.plot(series["time"], series["kinetic"] / series["kinetic"][0], "--", label="kinetic")
    left.set(xlabel="t", ylabel="over that at the start")
    left.legend()
    middle.plot(series["time"], series["gas"])
    middle.set(xlabel="t", ylabel="volume of the bubbles")
    radii = np.concatenate([frame["radius"][frame["type"] == 2] for frame in frames])
    if len(radii) > 10:
        number, _ = np.histogram(radii, CLASSES)
        a = np.sqrt(CLASSES[1:] * CLASSES[:-1])
        density = number / np.diff(CLASSES) / len(radii)
        right.plot(a[number > 0], density[number > 0], "o")
        hinze = WE**-0.6 / 2
        level = np.interp(hinze, a, density)
        right.plot(a[a < hinze], level * (a[a < hinze] / hinze)**-1.5, "k--", lw=0.8, label="-3/2")
        right.plot(a[a > hinze], level * (a[a > hinze] / hinze)**(-10 / 3), "k:", lw=0.8, label="-10/3")
        right.legend()
        table.write({"a": a, "density": density, "bubbles": number}, out / "sizes.csv")
    right.set(xscale="log", yscale="log", xlabel="radius a", ylabel="density of sizes")
    save(fig, out / "wave-series")


def save(fig: plt.Figure, base: Path) -> None:
    fig.savefig(base.with_suffix(".png"), dpi=150)
    plt.close(fig)


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("directory", type=Path, metavar="DIR")
    parser.add_argument("--at", nargs="+", type=float, metavar="T", help="times of pictures (default: five)")
    args = parser.parse_args()
    try:
        frames = list(read_frames(args.directory / "wave.lammpstrj"))
        series = read_series(args.directory / "series.csv")
        if len(frames) < 2:
            raise Unusable(f"{args.directory / 'wave.lammpstrj'} has {len(frames)} snapshots: two are needed")
        times = args.at or list(np.linspace(0, frames[-1].time or 0.0, 5))
        draw_wave(frames, times, args.directory)
        draw_series(series, frames, args.directory)
    except Unusable as wrong:
        sys.exit(f"plot.py: {wrong}")


if __name__ == "__main__":
    main()
