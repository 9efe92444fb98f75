#!/usr/bin/env python3
"""Figures and numbers of plumes.

    python3 plot.py DIR [--from T]     of one run: DIR/plume.lammpstrj and DIR/series.csv
    python3 plot.py DIR                of all that run.py wrote in its --out DIR

Tables (.csv), figures (.pdf, .png) and a movie go into DIR. Means are over the snapshots from the time T on (default:
the later half). At each height the vertical speed of the liquid is fitted by w = w_0 exp(-r^2/b^2) where r < 1.5 b.
Errors are by the scatter of four parts of the time.

Theory is that of a plume in an unbounded liquid, for Gaussian profiles of speed and gas, that of the gas lambda times
as wide: volume dV/dz = 2 pi alpha b w_0, V = pi b^2 w_0; momentum gamma dJ/dz = g Q / (w_0/(1 + lambda^2) + u_s),
J = pi b^2 w_0^2 / 2. u_s is the terminal speed of a bubble. It begins with w_0 and b of the lowest height.
"""
from __future__ import annotations

import argparse
from functools import cached_property
from pathlib import Path
import sys
from typing import Any

from matplotlib import pyplot as plt
from matplotlib.axes import Axes
import numpy as np
from numpy.typing import NDArray
from scipy.integrate import cumulative_trapezoid, solve_ivp
from scipy.optimize import brentq, least_squares

from common import columns, complete, cost, film, frames_of
from lammps_foam.analysis import figure, table
from lammps_foam.analysis.read import Frame, Unusable, read_series

Array = NDArray[np.float64]
Rows = list[dict[str, Any]]
DUMP = "plume.lammpstrj"
GRAVITY, FLUX, RADIUS, REYNOLDS, BETA = 9.81, 1.67e-5, 1.0e-3, 1.0e6, 1000 / 1.2      # of in.plume
HEIGHTS = np.arange(0.2, 0.91, 0.1)
HALF = 0.05               # of a layer
GAS_RINGS = np.arange(0.0, 0.2, 0.005)
PARTS = 4                 # of the time
WIDTHS = 1.5              # fits are out to there
TOP = 0.85                # the surface turns the flow from there on
# Socolofsky et al. (2008); their alpha is for profiles like a hat, which makes it larger by sqrt(2)
ALPHA, GAMMA = 0.055 / np.sqrt(2), 1.1


# ---------------------------------------------------------------- means

class Plume:
    """Sums over snapshots by part of the time, height and ring around the axis; and all bubbles."""

    def __init__(self, last: Frame) -> None:
        self.n = round(np.count_nonzero(last["type"] == 1)**(1 / 3))      # particles along an edge of the tank
        self.edges = np.arange(0.0, 0.49, 0.5 / self.n)                   # of rings
        self.areas = np.pi * np.diff(self.edges**2)
        self.frames = np.zeros(PARTS)
        self.sums = np.zeros((4, PARTS, len(HEIGHTS), len(self.areas)))   # of 1, r, w, w^2 over particles
        self.last = last
        self.bubbles: list[Array] = []

    def add(self, frame: Frame, part: int) -> None:
        liquid = frame["type"] == 1
        r = np.hypot(frame["x"], frame["y"])
        self.frames[part] += 1
        for k, z in enumerate(HEIGHTS):
            mine = liquid & (abs(frame["z"] - z) < HALF)
            w = frame["vz"][mine]
            for sums, weights in zip(self.sums, (np.ones_like(w), r[mine], w, w**2)):
                sums[part, k] += np.histogram(r[mine], self.edges, weights=weights)[0]
        gas = ~liquid
        self.bubbles.append(np.column_stack([np.full(np.count_nonzero(gas), part), frame["z"][gas], r[gas],
                                             frame["radius"][gas], frame["vz"][gas]]))

    @cached_property
    def gas(self) -> Array:
        """Bubbles of all snapshots: part of the time, z, r, radius, vertical speed."""
        return np.concatenate(self.bubbles)

    def rings(self, k: int, part: int | None = None) -> tuple[Array, Array, Array]:
        """Radii, mean speed, and number of particles, where there are any at the height k."""
        sums = self.sums[:, :, k].sum(axis=1) if part is None else self.sums[:, part, k]
        number, r, w, _ = sums
        there = number > 0
        return r[there] / number[there], w[there] / number[there], number[there]

    def near(self, z: float) -> Array:
        """Bubbles of all snapshots at a height."""
        return self.gas[abs(self.gas[:, 1] - z) < HALF]


def read(directory: Path, start: float | None = None) -> Plume:
    end = float(read_series(directory / "series.csv")["time"][-1])
    start = end / 2 if start is None else start
    plume = None
    for frame in frames_of(directory / DUMP):
        plume = plume or Plume(frame)
        plume.last, time = frame, frame.time or 0.0
        if time >= start:
            plume.add(frame, min(PARTS - 1, int(PARTS * (time - start) / max(end - start, 1e-12))))
    if plume is None or not plume.frames.all():
        raise Unusable(f"{directory / DUMP} has too few snapshots from the time {start:g} on: {PARTS} are needed")
    return plume


def gaussian(r: Array, w0: float, b: float) -> Array:
    return w0 * np.exp(-(r / b)**2)


def fitted(r: Array, w: Array, number: Array) -> tuple[float, float]:
    """w_0 and b, where r < 1.5 b."""
    w0, b = max(w[0], 1e-3), 0.1
    for _ in range(5):
        near = (r < WIDTHS * b) | (np.arange(len(r)) < 4)
        weight = np.sqrt(number[near])
        w0, b = least_squares(lambda p: weight * (gaussian(r[near], *p) - w[near]), (w0, b), method="lm").x
        b = abs(b)
    return float(w0), float(b)


def profiles(plume: Plume) -> Rows:
    """Of each height: speed on the axis, width, flux of momentum, gas, and errors by the parts of the time."""
    rows: Rows = []
    for k, z in enumerate(HEIGHTS):
        fits = [fitted(*plume.rings(k, part)) for part in range(PARTS)]
        w0, b = fitted(*plume.rings(k))
        errors = np.std(fits, axis=0, ddof=1) / np.sqrt(PARTS)
        gas = plume.near(z)
        spread = [np.sqrt(np.mean(gas[gas[:, 0] == part, 2]**2)) for part in range(PARTS)]
        number, _, w, w2 = plume.sums[:, :, k].sum(axis=1)
        w, w2 = w / np.maximum(number, 1), w2 / np.maximum(number, 1)
        up = np.cumprod((w > 0) | (number == 0)) > 0       # to where the liquid goes down
        rows.append({
            "z": z, "w0": w0, "w0_error": errors[0], "b": b, "b_error": errors[1],
            "gas_width": np.sqrt(np.mean(gas[:, 2]**2)), "gas_width_error": np.std(spread, ddof=1) / np.sqrt(PARTS),
            "rise": np.mean(gas[:, 4]), "momentum": np.sum((w2 * plume.areas)[up]),
            "turbulent": 1 - np.sum((w**2 * plume.areas)[up]) / np.sum((w2 * plume.areas)[up]),
            "gas_area": np.sum(4 / 3 * np.pi * gas[:, 3]**3) / (2 * HALF * plume.frames.sum())})
    return rows


def column(rows: Rows, name: str) -> Array:
    return np.array([row[name] for row in rows])


def buoyancy_of(rows: Rows) -> float:
    """Momentum that the plume gains, below its top, over the weight of liquid that the gas displaces."""
    below = column(rows, "z") < TOP
    z, gained = column(rows, "z")[below], column(rows, "momentum")[below]
    pushed = cumulative_trapezoid(GRAVITY * column(rows, "gas_area")[below], z, initial=0)
    return float(np.polyfit(pushed, gained, 1)[0])


# ---------------------------------------------------------------- theory

def terminal_speed() -> float:
    """Of a bubble, by the drag of Schiller and Naumann."""
    def excess(u: float) -> float:
        re = 2 * RADIUS * u * REYNOLDS
        return 24 / re * (1 + 0.15 * re**0.687) * u**2 - 8 / 3 * RADIUS * GRAVITY * (1 - 1 / BETA)
    return float(brentq(excess, 1e-4, 1.0))


def theory(z: Array, w0: float, b: float, alpha: float, wide: float, gamma: float = GAMMA) -> tuple[Array, Array]:
    """w_0 and b at the heights z from those at the first."""
    slip = terminal_speed()

    def change(_: float, y: Array) -> list[float]:
        volume, J = y
        speed, width = 2 * J / volume, volume / np.sqrt(2 * np.pi * J)
        return [2 * np.pi * alpha * width * speed, GRAVITY * FLUX / (speed / (1 + wide**2) + slip) / gamma]

    start = [np.pi * b**2 * w0, np.pi * b**2 * w0**2 / 2]
    volume, J = solve_ivp(change, (z[0], z[-1]), start, t_eval=z, rtol=1e-8).y
    return 2 * J / volume, volume / np.sqrt(2 * np.pi * J)


def spreading(rows: Rows) -> tuple[float, float]:
    """alpha that fits best, and lambda as it is: the width of the gas over that of the speed."""
    below = column(rows, "z") < TOP
    z, w0, b = (column(rows, name)[below] for name in ("z", "w0", "b"))
    wide = float(np.mean(column(rows, "gas_width")[below] / b))

    def off(alpha: Array) -> Array:
        speed, width = theory(z, w0[0], b[0], alpha[0], wide)
        return np.concatenate([speed / w0 - 1, width / b - 1])
    return float(least_squares(off, [ALPHA], bounds=(0, 1)).x[0]), wide


# ---------------------------------------------------------------- figures

def middle_plane(frame: Frame, ax: Axes, what: str, n: int) -> Any:
    mine = (frame["type"] == 1) & (abs(frame["y"]) < 0.6 / n)
    x, z = frame["x"][mine], frame["z"][mine]
    size = (150 / n)**2
    if what == "curl":
        drawn = ax.scatter(x, z, c=frame["curl"][mine], s=size, marker="s", lw=0, cmap="RdBu", vmin=-4, vmax=4,
                           rasterized=True)
    else:
        speed = np.hypot(frame["vx"][mine], frame["vz"][mine])
        drawn = ax.scatter(x, z, c=speed, s=size, marker="s", lw=0, cmap="viridis", vmin=0, vmax=0.35, rasterized=True)
    return drawn


def tank_axes(ax: Axes) -> None:
    ax.set(xlim=(-0.5, 0.5), ylim=(0, 1.04), aspect="equal", xlabel="x", ylabel="z", xticks=(-0.4, 0, 0.4))


def draw_bubbles(frame: Frame, ax: Axes) -> None:
    gas = frame["type"] == 2
    ax.scatter(frame["x"][gas], frame["z"][gas], c=frame["y"][gas], s=0.5, lw=0, cmap="cividis", vmin=-0.06, vmax=0.06,
               rasterized=True)


def draw_tank(frame: Frame, out: Path, n: int) -> None:
    fig, (left, middle, right) = figure.panels(1, 3, width=2.5, height=2.8)
    drawn = middle_plane(frame, left, "speed", n)
    fig.colorbar(drawn, ax=left, shrink=0.6, label="speed", location="bottom")
    mine = (frame["type"] == 1) & (abs(frame["y"]) < 0.6 / n)
    left.quiver(frame["x"][mine], frame["z"][mine], frame["vx"][mine], frame["vz"][mine], color="w", scale=8,
                width=0.002)
    fig.colorbar(middle_plane(frame, middle, "curl", n), ax=middle, shrink=0.6, label="vorticity along y",
                 location="bottom")
    draw_bubbles(frame, right)
    for ax in (left, middle, right):
        tank_axes(ax)
    left.set(title=f"liquid, t = {frame.time:.1f}, n = {n}")
    right.set(title=f"{np.count_nonzero(frame['type'] == 2)} bubbles")
    figure.save(fig, out / "plume-tank")


def draw_film(directory: Path, out: Path, n: int) -> None:
    fig, (left, right) = figure.panels(1, 2, width=2.4, height=2.6)
    fig.set_dpi(90)

    def draw(frame: Frame) -> None:
        for ax in (left, right):
            ax.clear()
            tank_axes(ax)
            ax.minorticks_off()
        middle_plane(frame, left, "speed", n)
        draw_bubbles(frame, right)
        left.set(title=f"speed, t = {frame.time:4.1f}")
        right.set(title="bubbles")

    every = (frame for number, frame in enumerate(frames_of(directory / DUMP)) if number % 2 == 0)
    film(every, fig, draw, out / "plume")
    plt.close(fig)


def shape(plume: Plume, rows: Rows) -> Rows:
    """w / w_0 against r / b: mean and scatter over heights below the top."""
    edges = np.arange(0, 3.01, 0.25)
    r, w = [], []
    for k, row in enumerate(rows):
        if row["z"] < TOP:
            radii, speeds, _ = plume.rings(k)
            r.append(radii / row["b"])
            w.append(speeds / row["w0"])
    which, speeds = np.digitize(np.concatenate(r), edges), np.concatenate(w)
    found: Rows = []
    for n in range(1, len(edges)):
        if np.any(which == n):
            x = np.concatenate(r)[which == n]
            found.append({"r_b": x.mean(), "w_w0": speeds[which == n].mean(), "scatter": speeds[which == n].std(),
                          "gaussian": np.exp(-x**2).mean()})
    return found


def draw_profiles(plume: Plume, rows: Rows, out: Path) -> None:
    fig, (left, right) = figure.panels(1, 2, width=3.0, height=2.6)
    x = np.linspace(0, 4, 200)
    for k, row in enumerate(rows):
        r, w, _ = plume.rings(k)
        left.plot(r / row["b"], w / row["w0"], "o", ms=2.5, color=plt.cm.viridis(k / len(rows)),
                  label=f"z = {row['z']:.1f}")
        gas = plume.near(row["z"])
        volume, _ = np.histogram(gas[:, 2], GAS_RINGS, weights=gas[:, 3]**3)
        c, width = volume / (np.pi * np.diff(GAS_RINGS**2)), row["gas_width"]
        total = np.sum(volume) / (np.pi * width**2)        # on the axis, if it were a Gaussian
        right.plot((GAS_RINGS[1:] + GAS_RINGS[:-1]) / 2 / width, c / total, "o", ms=2.5,
                   color=plt.cm.viridis(k / len(rows)))
    for ax in (left, right):
        ax.plot(x, np.exp(-x**2), "k-", lw=0.8)
        ax.axhline(0, color="0.7", lw=0.6)
    left.axvline(WIDTHS, color="0.7", lw=0.6, ls="--")
    left.set(xlabel=r"$r/b$", ylabel=r"$w/w_0$", xlim=(0, 4), ylim=(-0.25, 1.2), title="speed of the liquid")
    left.legend(ncols=2)
    right.set(xlabel=r"$r/b_\mathrm{gas}$", ylabel=r"$c/c_0$", xlim=(0, 3), title="gas")
    figure.save(fig, out / "plume-profiles")


def draw_heights(every: dict[str, Rows], out: Path, name: str, with_theory: bool) -> None:
    """Speed on the axis and widths against height."""
    fig, (left, right) = figure.panels(1, 2, width=3.0, height=2.6)
    for m, (label, rows) in enumerate(every.items()):
        z = column(rows, "z")
        for ax, key in ((left, "w0"), (right, "b")):
            ax.errorbar(z, column(rows, key), column(rows, f"{key}_error"), fmt="os^d"[m % 4], color=f"C{m}",
                        label=label)
        right.plot(z, column(rows, "gas_width"), "os^d"[m % 4], mfc="none", color=f"C{m}")
        if with_theory:
            fine = np.linspace(z[0], z[-1], 50)
            alpha, wide = spreading(rows)
            for a, style, words in ((alpha, "-", "fitted"), (ALPHA, "--", "of the literature")):
                for ax, curve in zip((left, right), theory(fine, rows[0]["w0"], rows[0]["b"], a, wide)):
                    ax.plot(fine, curve, style, lw=0.9, color=f"C{m}", label=rf"$\alpha$ = {a:.3f}, {words}")
    left.set(xlabel="z", ylabel=r"speed on the axis $w_0$", ylim=(0, None))
    right.set(xlabel="z", ylabel=r"width $b$; open: of the gas", ylim=(0, None))
    left.legend(fontsize=6)
    figure.save(fig, out / f"plume-{name}")


def draw_sizes(every: dict[str, Plume], out: Path) -> None:
    """Mean radius against the distance from the axis, and spread against height: figures 8 to 10 of the source."""
    fig, (left, middle, right) = figure.panels(1, 3, width=2.4, height=2.5)
    edges = np.array([0, 0.006, 0.012, 0.018, 0.024, 0.03, 0.04, 0.05, 0.06, 0.08, 0.1])
    found: Rows = []
    for m, (label, plume) in enumerate(every.items()):
        gas = plume.gas[(plume.gas[:, 1] > 0.4) & (plume.gas[:, 1] < TOP)]
        which = np.digitize(gas[:, 2], edges)
        for n in range(1, len(edges)):
            parts = [gas[(which == n) & (gas[:, 0] == part), 3] for part in range(PARTS)]
            if min(map(len, parts)) > 20:
                means = [np.mean(part) for part in parts]
                found.append({"run": label, "r": gas[which == n, 2].mean(), "radius": gas[which == n, 3].mean(),
                              "error": np.std(means, ddof=1) / np.sqrt(PARTS), "bubbles": np.count_nonzero(which == n)})
        mine = [row for row in found if row["run"] == label]
        left.errorbar(column(mine, "r"), column(mine, "radius") / RADIUS, column(mine, "error") / RADIUS, fmt="os"[m],
                      ls="-", label=label)
        z = np.arange(0.15, 0.96, 0.1)
        middle.plot(z, [np.sqrt(np.mean(plume.near(h)[:, 2]**2)) for h in z], "os"[m] + "-", label=label)
        sizes = np.arange(0.4, 1.81, 0.2) * RADIUS
        classes = np.digitize(gas[:, 3], sizes)
        there = [n for n in range(1, len(sizes)) if np.count_nonzero(classes == n) > 100]
        right.plot([gas[classes == n, 3].mean() / RADIUS for n in there],
                   [np.sqrt(np.mean(gas[classes == n, 2]**2)) for n in there], "os"[m] + "-", label=label)
    left.set(xlabel="distance from the axis r", ylabel="mean radius / 0.001", title=f"0.4 < z < {TOP}")
    middle.set(xlabel="z", ylabel="root mean square of r", ylim=(0, None))
    right.set(xlabel="radius / 0.001", ylabel="root mean square of r", ylim=(0, None), title=f"0.4 < z < {TOP}")
    left.legend()
    figure.save(fig, out / "plume-sizes")
    table.write(columns(found), out / "sizes.csv")


# ---------------------------------------------------------------- tables

def summary(directory: Path, plume: Plume, rows: Rows) -> dict[str, Any]:
    """One line of a run: at mid-height, over all heights below the top, and what it costs."""
    middle = min(rows, key=lambda row: abs(row["z"] - 0.5))
    alpha, wide = spreading(rows)
    steps, seconds = cost(directory / "log.liquid")
    series = read_series(directory / "series.csv")
    rest = series["time"] >= series["time"][-1] / 2
    return {"run": directory.name, **{key: middle[key] for key in ("w0", "w0_error", "b", "b_error", "gas_width",
                                                                   "gas_width_error")},
            "lambda": wide, "alpha": alpha, "buoyancy": buoyancy_of(rows), "kinetic": series["kinetic"][rest].mean(),
            "bubbles": series["bubbles"][rest].mean(), "iterations": series["iterations"][rest].mean(), "steps": steps,
            "ms_step": 1e3 * seconds / steps}


def of_one(directory: Path, out: Path, start: float | None = None) -> tuple[Plume, Rows]:
    plume = read(directory, start)
    rows = profiles(plume)
    table.write(columns(rows), out / "profiles.csv")
    draw_tank(plume.last, out, plume.n)
    draw_profiles(plume, rows, out)
    table.write(columns(shape(plume, rows)), out / "shape.csv")
    return plume, rows


def draw_closures(rows: Rows, out: Path) -> None:
    """What differs from the first run, which has all of them."""
    panels = {"w0": "speed on the axis", "b": "width", "gas_width": "width of the bubbles", "kinetic": "kinetic energy",
              "ms_step": "ms of a step"}
    fig, axes = figure.panels(1, len(panels), width=1.75, height=2.6)
    names = [row["run"] for row in rows]
    place = np.arange(len(rows))[::-1]
    for ax, (name, label) in zip(axes, panels.items()):
        error = column(rows, f"{name}_error") if f"{name}_error" in rows[0] else None
        ax.errorbar(column(rows, name), place, xerr=error, fmt="o", ms=4)
        ax.axvline(rows[0][name], color="0.6", lw=0.7)
        ax.set(xlabel=label, ylim=(-0.5, len(rows) - 0.5), xlim=(0, 1.15 * column(rows, name).max()))
        ax.set_yticks(place, names if ax is axes[0] else [])
        ax.tick_params(axis="y", which="minor", left=False, right=False)
    figure.save(fig, out / "plume-closures")


def draw(out: Path) -> None:
    """All that run.py wrote."""
    read_already: dict[Path, tuple[Plume, Rows]] = {}

    def get(path: Path) -> tuple[Plume, Rows]:
        if path not in read_already:
            print(f"reading {path}", flush=True)
            plume = read(path)
            read_already[path] = plume, profiles(plume)
        return read_already[path]

    plumes, published, closures = (complete(out, group) for group in ("plume", "momentum", "closures"))
    if plumes:
        finest = plumes[-1]
        read_already[finest] = of_one(finest, out)
        draw_film(finest, out, int(finest.name))
        draw_heights({f"n = {path.name}": get(path)[1] for path in plumes}, out, "theory", True)
    if plumes and published:
        draw_heights({"standard": get(plumes[0])[1], "published": get(published[0])[1]}, out, "momentum", False)
    closures.sort()
    sizes = complete(out, "sizes")
    if sizes:
        draw_sizes({"langevin" if path.name == "langevin" else "none": get(path)[0] for path in sizes}, out)
    for name, paths in (("summary", [*plumes, *published]), ("closures", [*plumes[:1], *closures] if closures else [])):
        if not paths:
            continue
        rows = [summary(path, *get(path)) for path in paths]
        if name == "closures":
            if plumes:
                rows[0]["run"] = "all of them"
            draw_closures(rows, out)
        table.show(columns(rows))
        table.write(columns(rows), out / f"{name}.csv")
    if not (plumes or published or sizes or closures):
        raise Unusable(f"{out} has no run of run.py, and no {DUMP}")


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("directory", type=Path, metavar="DIR")
    parser.add_argument("--from", dest="start", type=float, metavar="T", help="first time of means (default: half)")
    args = parser.parse_args()
    try:
        if not (args.directory / DUMP).is_file():
            draw(args.directory)
            return
        _, rows = of_one(args.directory, args.directory, args.start)
        draw_heights({"run": rows}, args.directory, "theory", True)
        table.show(columns(rows))
    except Unusable as wrong:
        sys.exit(f"plot.py: {wrong}")


if __name__ == "__main__":
    main()
