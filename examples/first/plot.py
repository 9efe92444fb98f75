#!/usr/bin/env python3
"""Picture and numbers of in.stir: plot.py [DIR], where DIR has tank.lammpstrj (default: here). Writes stir.png, .pdf.

Left: the liquid in the middle plane and the bubbles at the end. Right: the upward speed of the liquid against the
distance from the axis at mid-height, mean and scatter over the later half of the run. Printed: how fast bubbles rise
through the liquid around them, and the terminal speed of one bubble alone.
"""
from pathlib import Path
import sys

import numpy as np
from scipy.optimize import brentq
from scipy.spatial import cKDTree

from lammps_foam.analysis import figure
from lammps_foam.analysis.read import read_frames

RE, RADIUS, BETA = 1.0e5, 0.01, 833    # of in.stir; gravity is 1
RINGS = np.arange(0.0, 0.51, 0.1)


def terminal_speed():
    """Where drag by Schiller and Naumann is buoyancy: C_d u^2 = (8/3) a g (1 - 1/beta)."""
    def excess(u):
        re = 2 * RADIUS * u * RE
        return 24 / re * (1 + 0.15 * re**0.687) * u**2 - 8 / 3 * RADIUS * (1 - 1 / BETA)
    return brentq(excess, 1e-4, 10.0)


def look(frame):
    """Upward speed of the liquid by ring at mid-height, and that of bubbles there past the liquid near the axis."""
    half = abs(frame["z"] - 0.5) < 0.15
    liquid, gas = half & (frame["type"] == 1), half & (frame["type"] == 2)
    r = np.hypot(frame["x"], frame["y"])
    number, speed = (np.histogram(r[liquid], RINGS, weights=w)[0] for w in (None, frame["vz"][liquid]))
    if not gas.any():
        return speed / number, np.nan
    places = np.column_stack([frame["x"], frame["y"], frame["z"]])
    _, nearest = cKDTree(places[liquid]).query(places[gas], k=8)
    return speed / number, (frame["vz"][gas] - frame["vz"][liquid][nearest].mean(axis=1)).mean()


def main():
    where = Path(sys.argv[1]) if len(sys.argv) > 1 else Path()
    frames = list(read_frames(where / "tank.lammpstrj"))
    speeds, slips = zip(*(look(frame) for frame in frames[len(frames) // 2:]), strict=True)
    last = frames[-1]
    fig, (left, right) = figure.panels(1, 2, width=3.0, height=3.0)
    liquid, gas = (last["type"] == 1) & (abs(last["y"]) < 0.06), last["type"] == 2
    arrows = left.quiver(last["x"][liquid], last["z"][liquid], last["vx"][liquid], last["vz"][liquid],
                         last["vz"][liquid], scale=1.0, width=0.006, cmap="viridis")
    left.scatter(last["x"][gas], last["z"][gas], s=8, facecolor="none", edgecolor="#D55E00", lw=0.7)
    left.set(aspect="equal", xlim=(-0.52, 0.52), ylim=(0, 1.1), xlabel="x", ylabel="z", title=f"t = {last.time:.1f}")
    fig.colorbar(arrows, ax=left, label="upward speed of the water", location="bottom", shrink=0.8)
    middles = (RINGS[:-1] + RINGS[1:]) / 2
    right.errorbar(middles, np.mean(speeds, axis=0), np.std(speeds, axis=0), fmt="o-")
    right.axhline(0, color="0.7", lw=0.7)
    right.set(xlabel="distance from the axis", ylabel="upward speed of the water", title="z = 0.35 to 0.65")
    figure.save(fig, where / "stir")
    print(f"bubbles rise through the water around them at {np.nanmean(slips):.3f}; one alone: {terminal_speed():.3f}")


if __name__ == "__main__":
    main()
