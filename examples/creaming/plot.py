#!/usr/bin/env python3
"""Figures and numbers of a creaming column, from what run.py wrote.

    python3 plot.py DIR      writes numbers.csv, profile.csv, terms.csv and figures (.pdf, .png) in DIR

Liquid fraction: 1 minus the volume of the spheres in a slice, exact for each sphere. Overlaps count twice, since a
bubble has the gas of its whole sphere. Depths are below the lid. The prediction of the profile takes the osmotic
pressure Pi of osmotic.csv: dPi/dz = (rho - rho_gas) g phi, and at the lid Pi carries all bubbles. It has no
parameter. The law of real foams is that of Maestro et al., Soft Matter 9, 2531 (2013), for disordered ones.
"""
from __future__ import annotations

import argparse
from collections.abc import Callable
import csv
import json
from pathlib import Path
import re
import sys
from typing import Any

from matplotlib import pyplot as plt
from matplotlib.collections import EllipseCollection
import numpy as np
from numpy.typing import NDArray

from lammps_foam.analysis import figure, table
from lammps_foam.analysis.read import Frame, Unusable, read_frames

from run import TERMS

Array = NDArray[np.float64]
Series = dict[str, Array]
HERE = Path(__file__).resolve().parent
SLICE = 2.0          # thickness of slices, in mean radii
SHOWN = 90.0         # width of the pictures, in mean radii
REAL = (3.2, 0.36)   # Pi = 3.2 sigma/R32 (phi_c - phi_l)^2 / sqrt(phi_l), phi_c = 0.36


# ---------------------------------------------------------------- what run.py wrote

def settings(directory: Path) -> dict[str, float]:
    """Numbers that a run had: those of in.creaming, but for those that it was given."""
    given = re.findall(r"^variable\s+(\w+)\s+index\s+(\S+)", (HERE / "in.creaming").read_text(), re.M)
    words = dict(given)
    if (directory / "settings.json").is_file():
        words.update(json.loads((directory / "settings.json").read_text()))
    return {name: float(value) for name, value in words.items() if re.fullmatch(r"[-+.\deE]+", value)}


def read_table(path: Path, needed: tuple[str, ...]) -> Series:
    if not path.is_file():
        raise Unusable(f"there is no {path}: run.py writes it")
    with path.open(newline="") as file:
        rows = [row for row in csv.reader(file) if row]
    missing = [name for name in needed if not rows or name not in rows[0]]
    if missing:
        raise Unusable(f"{path} lacks the columns: {', '.join(missing)}")
    if len(rows) < 3:
        raise Unusable(f"{path} needs two lines of numbers at least")
    return dict(zip(rows[0], np.array(rows[1:], dtype=float).T))


def frame_at(frames: list[Frame], time: float) -> Frame:
    return min(frames, key=lambda frame: abs((frame.time or 0.0) - time))


# ---------------------------------------------------------------- liquid fraction against depth

def volume_below(z: Array, R: Array, height: float) -> float:
    """Volume of the parts of these spheres that are below a height."""
    h = np.clip(height - z, -R, R) + R
    return float(np.sum(np.pi * h**2 * (R - h / 3)))


def profile(frame: Frame, unit: float) -> tuple[Array, Array]:
    """Depths of the middles of slices over the unit, and liquid fractions."""
    top, bottom = frame.box.hi[2], frame.box.lo[2]
    edges = top - unit * SLICE * np.arange(int((top - bottom) / (unit * SLICE)) + 1)
    below = np.array([volume_below(frame["z"], frame["radius"], height) for height in edges])
    area = float(np.prod(frame.box.hi[:2] - frame.box.lo[:2]))
    return (top - 0.5 * (edges[1:] + edges[:-1])) / unit, 1 - (below[:-1] - below[1:]) / (area * unit * SLICE)


def hydrostatic(gas_fraction: Callable[[Array], Array], bond: float, column: float, slices: int) -> Array:
    """Mean liquid fractions of slices from the lid down, where a column (lengths over R) of gas rests in balance."""
    fine = 200
    step, pressure = SLICE / fine, bond * column
    phi = np.zeros(slices * fine)
    for n in range(len(phi)):
        if pressure <= 0:
            break
        phi[n] = gas_fraction(np.array(pressure))
        pressure -= bond * phi[n] * step
    return 1 - phi.reshape(slices, fine).mean(axis=1)


def of_packing(state: Series) -> Callable[[Array], Array]:
    """Gas fraction by osmotic pressure (in sigma/R) of the packings of osmotic.csv."""
    return lambda pressure: np.interp(pressure, state["pressure"], state["phi"])


def of_real_foam(sauter: float) -> Callable[[Array], Array]:
    """The same by the law of real foams; sauter = R32/R."""
    liquid = np.linspace(REAL[1], 1e-3, 4000)
    pressure = REAL[0] / sauter * (REAL[1] - liquid)**2 / np.sqrt(liquid)
    return lambda wanted: np.interp(wanted, pressure, 1 - liquid)


# ---------------------------------------------------------------- a bubble alone

def terminal_speed(R: Array, s: dict[str, float]) -> Array:
    """Where buoyancy is the drag of a rigid sphere, Re < 1000."""
    stokes = 2 / 9 * (s["rho"] - s["gas"]) * s["g"] * R**2 / s["mu"]
    speed = stokes.copy()
    for _ in range(300):
        Re = 2 * R * s["rho"] * speed / s["mu"]
        speed = 0.5 * (speed + stokes / (1 + 0.15 * Re**0.687))
    return speed


def swarm(frames: list[Frame], s: dict[str, float]) -> dict[str, float]:
    """Speeds of bubbles in the lower half at 0.05 s, where no layer is in their way, beside those of each one alone."""
    frame = frame_at(frames, 0.05)
    half = frame["z"] < 0.5 * (frame.box.lo[2] + frame.box.hi[2])
    R, speed = frame["radius"][half], frame["vz"][half]
    alone = terminal_speed(R, s)
    found = {"swarm_speed": float(speed.mean()), "speed_alone": float(alone.mean()),
             "swarm_gas_speed": float(np.average(speed, weights=R**3)),
             "gas_speed_alone": float(np.average(alone, weights=R**3))}
    for name, some in (("small", R < 0.75 * s["R"]), ("large", R > 1.25 * s["R"])):
        if some.any():
            found[f"{name}_over_alone"] = float(np.mean(speed[some] / alone[some]))
    return found


# ---------------------------------------------------------------- figures

def draw_cut(ax: Any, frame: Frame, unit: float, colour: Any) -> Any:
    """A vertical cut through the middle: circles where it meets spheres."""
    y = frame["y"] - 0.5 * (frame.box.lo[1] + frame.box.hi[1])
    met = np.abs(y) < frame["radius"]
    x = (frame["x"][met] - frame.box.lo[0]) / unit
    depth = (frame["z"][met] - frame.box.hi[2]) / unit
    width = 2 * np.sqrt(frame["radius"][met]**2 - y[met]**2) / unit
    circles = EllipseCollection(width, width, np.zeros_like(width), units="xy", offsets=np.column_stack([x, depth]),
                                offset_transform=ax.transData, array=frame["radius"][met] / unit, linewidths=0.2,
                                edgecolors="0.2", **colour)
    ax.add_collection(circles)
    ax.set(xlim=(0, min(SHOWN, (frame.box.hi[0] - frame.box.lo[0]) / unit)), aspect="equal",
           ylim=(-(frame.box.hi[2] - frame.box.lo[2]) / unit, 0.5))
    ax.axhline(0, color="k", lw=1.5)
    ax.set_facecolor("#eaf2f8")
    ax.minorticks_off()
    return circles


def draw_state(frames: list[Frame], layer: list[Frame], s: dict[str, float], directory: Path) -> None:
    """The column at three times, and the layer when half of its bubbles have gone."""
    shown = [frame_at(frames, time) for time in (0.0, 0.1)] + [frames[-1]]
    titles = [f"{frame.time:.2g} s" for frame in shown]
    if layer:
        shown.append(layer[-1])
        titles.append(f"{layer[-1].time / 3600:.1f} h later")    # type: ignore[operator]
    fig, axes = figure.panels(2, 2, width=3.3, height=2.4)
    colour = {"cmap": "viridis", "clim": (0.6, 1.6)}
    for ax, frame, title in zip(axes, shown, titles):
        circles = draw_cut(ax, frame, s["R"], colour)
        ax.set(title=title, xlabel="x / R", ylabel="height below the lid / R")
    fig.colorbar(circles, ax=axes, label="radius / R", shrink=0.7, extend="max")
    figure.save(fig, directory / "state")


def draw_profiles(frames: list[Frame], lines: dict[str, Array], s: dict[str, float], directory: Path) -> None:
    fig, (left, right) = figure.panels(1, 2, width=2.9, height=2.8)
    for n, time in enumerate((0.0, 0.05, 0.1, 0.15, 0.2, 0.4)):
        frame = frame_at(frames, time)
        depth, liquid = profile(frame, s["R"])
        left.plot(liquid, -depth, color=plt.get_cmap("viridis")(n / 5.5), label=f"{frame.time:.2g} s")
    left.set(xlabel="liquid fraction", ylabel="height below the lid / R", xlim=(0, 1))
    left.legend()
    right.plot(lines["liquid"], -lines["depth"], "o", label="at rest")
    for name, label, style in (("packing", "by osmotic.csv", "-"), ("real", "law of real foams", "--")):
        if name in lines:
            right.plot(lines[name], -lines["depth"], style, label=label)
    right.set(xlabel="liquid fraction", ylim=(-24, 0), xlim=(0, 1))
    right.legend()
    figure.save(fig, directory / "profiles")


def draw_rise(series: Series, s: dict[str, float], directory: Path) -> None:
    fig, (left, right) = figure.panels(1, 2, width=2.9, height=2.4)
    t = series["time"]
    left.plot(t, series["lid"], label="force on the lid / buoyancy")
    left.plot(t, series["speed"] / series["speed"].max(), label="mean speed / its maximum")
    left.set(xlabel="time (s)", ylim=(0, 1.1))
    left.legend(loc="center right")
    whole = series["buoyancy"][-1]
    for name in ("drag", "lubrication", "film", "elastic", "kinetic"):
        right.plot(t[1:], series[name][1:] / whole, label=name)
    right.set(xlabel="time (s)", ylabel="energy / work of buoyancy", yscale="log", ylim=(1e-5, 2))
    right.legend()
    figure.save(fig, directory / "rise")


def draw_coarsening(series: Series, layer: list[Frame], s: dict[str, float], directory: Path) -> None:
    fig, (left, middle, right) = figure.panels(1, 3, width=2.4, height=2.4)
    hours = series["time"] / 3600
    left.plot(hours, series["N"] / series["N"][0], label=r"$N/N_0$")
    left.plot(hours, series["R"], label=r"$\langle R\rangle/\langle R_\mathrm{in}\rangle$")
    left.plot(hours, series["R32"] / series["R32"][0], label=r"$R_{32}/R_{32,\mathrm{in}}$")
    left.set(xlabel="time (h)", ylim=(0.4, 1.6))
    left.legend()
    for frame, name in zip((layer[0], layer[-1]), ("before", "after")):
        depth, liquid = profile(frame, s["R"])
        middle.plot(liquid, -depth, label=name)
        size = frame["radius"] / frame["radius"].mean()
        right.hist(size, np.linspace(0, 2.5, 51), density=True, histtype="step", label=name)
    middle.set(xlabel="liquid fraction", ylabel="height below the lid / R", xlim=(0, 1), ylim=(-24, 0))
    middle.legend()
    right.set(xlabel=r"$R/\langle R\rangle$", ylabel="probability density")
    right.legend()
    figure.save(fig, directory / "coarsening")


# ---------------------------------------------------------------- numbers

def profiles_of_rest(frame: Frame, state: Series | None, s: dict[str, float]) -> dict[str, Array]:
    R, depth_liquid = frame["radius"], profile(frame, s["R"])
    area = float(np.prod(frame.box.hi[:2] - frame.box.lo[:2]))
    column = 4 / 3 * np.pi * float(np.sum(R**3)) / area / s["R"]
    bond = (s["rho"] - s["gas"]) * s["g"] * s["R"]**2 / s["sigma"]
    lines = {"depth": depth_liquid[0], "liquid": depth_liquid[1]}
    if state is not None:
        lines["packing"] = hydrostatic(of_packing(state), bond, column, len(lines["depth"]))
    sauter = float(np.mean(R**3) / np.mean(R**2)) / s["R"]
    lines["real"] = hydrostatic(of_real_foam(sauter), bond, column, len(lines["depth"]))
    top = frame.box.hi[2]
    slices = [np.abs((top - frame["z"]) / s["R"] - depth) < 0.5 * SLICE for depth in lines["depth"]]
    lines["radius"] = np.array([R[some].mean() / s["R"] if some.any() else np.nan for some in slices])
    return lines


def numbers_of(directory: Path, frames: list[Frame], lines: dict[str, Array], s: dict[str, float]) -> dict[str, float]:
    series = read_table(directory / "rise.csv", ("time", "lid", "speed", "buoyancy", "budget"))
    found = {"bubbles": float(len(frames[0])), "bond": (s["rho"] - s["gas"]) * s["g"] * s["R"]**2 / s["sigma"],
             **swarm(frames, s), "lid": series["lid"][-1],
             "lid_last": float(series["lid"][series["time"] > series["time"][-1] - 0.05].mean()),
             "budget": series["budget"][-1] / series["buoyancy"][-1],
             "half_time": float(np.interp(0.5, series["lid"], series["time"]))}
    for name in ("drag", "film", "lubrication", "elastic", "kinetic"):
        found[name] = series[name][-1] / series["buoyancy"][-1]
    if "packing" in lines:
        inside = (lines["depth"] > SLICE) & (lines["packing"] < 0.36)    # not the lid's layer, nor the lower edge
        found["off_packing"] = float(np.sqrt(np.mean((lines["liquid"] - lines["packing"])[inside]**2)))
    return found


def draw_column(directory: Path, out: Path, state: Series | None) -> None:
    s = settings(directory)
    frames = list(read_frames(directory / "rise.lammpstrj"))
    layer = list(read_frames(directory / "layer.lammpstrj")) if (directory / "layer.lammpstrj").is_file() else []
    lines = profiles_of_rest(frames[-1], state, s)
    found = numbers_of(directory, frames, lines, s)
    table.write({"name": list(found), "value": list(found.values())}, out / "numbers.csv")
    table.show({"name": list(found), "value": list(found.values())})
    table.write(lines, out / "profile.csv")
    table.show({name: values[:14] for name, values in lines.items()})
    draw_state(frames, layer, s, out)
    draw_profiles(frames, lines, s, out)
    draw_rise(read_table(directory / "rise.csv", ("time",)), s, out)
    if (directory / "coarsen.csv").is_file() and len(layer) > 1:
        draw_coarsening(read_table(directory / "coarsen.csv", ("time", "N", "R", "R32")), layer, s, out)


def cost(log: Path, bubbles: float) -> tuple[int, float]:
    """Steps of the rise, and microseconds of CPU a bubble and step: LAMMPS says which part of the time it had."""
    found = re.search(r"Loop time of (\S+) on (\d+) procs for (\d+) steps[^%]*?([\d.]+)% CPU use", log.read_text())
    if not found:
        raise Unusable(f"{log} has no 'CPU use'")
    steps = int(found[3])
    return steps, 1e6 * float(found[1]) * float(found[2]) * float(found[4]) / 100 / steps / bubbles


def terms_of(directory: Path) -> dict[str, list[Any]]:
    rows = []
    for name in TERMS:
        path = directory / name.replace(" ", "-")
        if not (path / "complete").is_file():
            continue
        s = settings(path)
        series = read_table(path / "rise.csv", ("time", "lid", "elastic", "buoyancy", "budget"))
        frame = list(read_frames(path / "rise.lammpstrj"))[-1]
        depth, liquid = profile(frame, s["R"])
        steps, micro = cost(path / "log.creaming", len(frame))
        volume = frame["radius"]**3
        rows.append({"run": name, "steps": steps, "us": micro,
                     "half_ms": 1e3 * float(np.interp(0.5, series["lid"], series["time"])),
                     "rest_ms": 1e3 * float(np.interp(0.99, series["lid"], series["time"])), "lid": series["lid"][-1],
                     "depth": float(np.sum((frame.box.hi[2] - frame["z"]) * volume) / np.sum(volume)) / s["R"],
                     "top": liquid[1], "elastic": series["elastic"][-1] / series["buoyancy"][-1],
                     "budget": series["budget"][-1] / series["buoyancy"][-1]})
    return {name: [row[name] for row in rows] for name in rows[0]} if rows else {}


def draw(out: Path) -> None:
    column, terms = out / "column", terms_of(out / "terms")
    if not (column / "rise.lammpstrj").is_file() and not terms:
        raise Unusable(f"{out} has no run of run.py")
    if terms:
        table.show(terms)
        table.write(terms, out / "terms.csv")
    if (column / "rise.lammpstrj").is_file():
        osmotic = out / "osmotic" / "osmotic.csv"
        draw_column(column, out, read_table(osmotic, ("phi", "pressure")) if osmotic.is_file() else None)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("directory", type=Path, metavar="DIR")
    try:
        draw(parser.parse_args().directory)
    except Unusable as wrong:
        sys.exit(str(wrong))
