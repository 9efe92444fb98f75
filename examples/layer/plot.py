#!/usr/bin/env python3
"""Figures and numbers of a layer of foam, from the sparger on, by in.layer.

    python3 plot.py DIR      of one run in DIR; or of all that run.py wrote in its --out DIR

Writes numbers.csv, profile.csv and figures (.pdf, .png) in DIR, and variants.csv if there are several runs. Gas
fraction: volume of the spheres in a slice, exact for each sphere. Overlaps count twice, since a bubble has the gas of
its whole sphere. Depths are below the lid, the level of the water before gas came.
"""
from __future__ import annotations

import argparse
from pathlib import Path
import re
import sys
from typing import Any

from matplotlib import pyplot as plt
from matplotlib.collections import EllipseCollection
import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from lammps_foam.analysis import figure, table
from lammps_foam.analysis.read import Frame, Unusable, read_frames, read_series

Array = NDArray[np.float64]
Series = dict[str, Array]
SLICE = 0.5                # thickness of slices, in mean radii
PLUME, CALM, PACK = 1, 2, 3
LOGS = ("log.liquid", "log.lammps")
BUBBLES, FOAM = "bubbles.lammpstrj", "foam.lammpstrj"
DEEPEST = 12.0             # of the cuts, in mean radii
SIZES = {"cmap": "plasma", "clim": (0.6, 1.8)}


# ---------------------------------------------------------------- what a run wrote

class Run:
    def __init__(self, directory: Path) -> None:
        self.directory = directory
        self.s = {name: float(values[0]) for name, values in read_series(directory / "settings.csv").items()}
        self.series = read_series(directory / "series.csv")
        self.frames = list(read_frames(directory / BUBBLES))
        self.foam = list(read_frames(directory / FOAM)) if (directory / FOAM).is_file() else []
        self.coarsening = read_series(directory / "coarsen.csv") if (directory / "coarsen.csv").is_file() else None
        if not self.frames:
            raise Unusable(f"{directory / BUBBLES} has no snapshot")

    def seconds(self, frame: Frame) -> float:
        return (frame.time or 0.0) / self.s["second"]

    def at(self, seconds: float) -> Frame:
        """The last snapshot until then."""
        return [frame for frame in self.frames if self.seconds(frame) < seconds + 1e-9][-1]

    def stages(self) -> dict[str, Frame]:
        """A snapshot of each: while gas comes, when it has come, at rest, and after coarsening."""
        s = self.s
        found = {"plume": self.at(0.5 * s["fill"]), "last gas": self.at(s["fill"]),
                 "calm": self.at(s["fill"] + s["calm"]), "packed": self.frames[-1]}
        if len(self.foam) > 1:
            found["coarsened"] = self.foam[-1]
        return {name: frame for name, frame in found.items() if len(gas_of(frame)["z"])}


def gas_of(frame: Frame) -> dict[str, Array]:
    """Places and radii of the bubbles."""
    gas = np.asarray(frame["type"] == 2) if "type" in frame.columns else np.ones(len(frame["x"]), bool)
    return {name: np.asarray(frame[name][gas]) for name in ("x", "y", "z", "radius")}


def steps_of(log: Path) -> list[tuple[int, float]]:
    """Steps of each run, and its seconds of CPU: LAMMPS says which part of the time it had."""
    found = re.findall(r"Loop time of (\S+) on (\d+) procs for (\d+) steps[^%]*?([\d.]+)% CPU use", log.read_text())
    return [(int(steps), float(time) * float(ranks) * float(part) / 100) for time, ranks, steps, part in found]


# ---------------------------------------------------------------- the layer

def volume_below(z: Array, R: Array, height: float) -> float:
    """Volume of the parts of these spheres that are below a height."""
    h = np.clip(height - z, -R, R) + R
    return float(np.sum(np.pi * h**2 * (R - h / 3)))


def profile(gas: dict[str, Array], s: dict[str, float], depth: float = 20.0) -> tuple[Array, Array]:
    """Depths of the middles of slices over the mean radius, and gas fractions."""
    edges = 1 - s["a"] * SLICE * np.arange(int(depth / SLICE) + 1)
    below = np.array([volume_below(gas["z"], gas["radius"], height) for height in edges])
    return (1 - 0.5 * (edges[1:] + edges[:-1])) / s["a"], (below[:-1] - below[1:]) / (s["a"] * SLICE)


def heights(gas: dict[str, Array], s: dict[str, float], rings: int = 6) -> tuple[Array, Array]:
    """Distance from the axis over half of the width, and height of the gas over the mean radius there."""
    r = np.hypot(gas["x"], gas["y"])
    near = gas["z"] > 1 - 2 * np.sum(4 / 3 * np.pi * gas["radius"]**3) - 2 * s["a"]
    edges = np.linspace(0, 0.5, rings + 1)
    volume, _ = np.histogram(r[near], edges, weights=4 / 3 * np.pi * gas["radius"][near]**3)
    return edges[1:] + edges[:-1], volume / (np.pi * np.diff(edges**2)) / s["a"]


def mean_depth(gas: dict[str, Array], s: dict[str, float]) -> float:
    weight = gas["radius"]**3
    return float(np.average(1 - gas["z"], weights=weight)) / s["a"]


def alone(s: dict[str, float]) -> tuple[float, float, float]:
    """A bubble of the mean radius by itself: speed (m/s) where buoyancy is the drag of a rigid sphere, Re and We."""
    def excess(u: float) -> float:
        re = 2 * s["R"] * s["rho"] * u / s["mu"]
        return 24 / re * (1 + 0.15 * re**0.687) * u**2 - 8 / 3 * s["R"] * s["g"] * (1 - s["gas"] / s["rho"])
    u = float(brentq(excess, 1e-6, 10.0))
    return u, 2 * s["R"] * s["rho"] * u / s["mu"], 2 * s["R"] * s["rho"] * u**2 / s["sigma"]


def on_axis(run: Run) -> float:
    """Mean speed of the liquid upwards near the axis (m/s), in the later half of the time in which gas comes."""
    s, speeds = run.s, []
    for frame in run.frames:
        if 0.5 * s["fill"] < run.seconds(frame) < s["fill"]:
            mine = (frame["type"] == 1) & (np.hypot(frame["x"], frame["y"]) < 0.1) & (abs(frame["z"] - 0.55) < 0.2)
            speeds.append(frame["vz"][mine])
    return float(np.mean(np.concatenate(speeds))) * s["W"] * s["second"]


def of_real_foam(pressure: float) -> float:
    """Gas fraction by the osmotic pressure over sigma/R32: Maestro et al., Soft Matter 9, 2531 (2013), disordered."""
    liquid = np.linspace(0.36, 1e-3, 4000)
    return float(np.interp(pressure, 3.2 * (0.36 - liquid)**2 / np.sqrt(liquid), 1 - liquid))


def numbers(run: Run) -> dict[str, float]:
    s, series = run.s, run.series
    mm3 = 1e9 * s["W"]**3
    last = {stage: np.flatnonzero(series["stage"] <= stage)[-1] for stage in (PLUME, CALM, PACK)}
    later = (series["seconds"] > 0.5 * s["fill"]) & (series["seconds"] < s["fill"])
    found = {"time_ms": 1e3 / s["second"], "Re": s["Re"], "We": s["We"], "radius": s["a"],
             "radius_over_dr": s["a"] / s["dr"], "bond": (s["rho"] - s["gas"]) * s["g"] * s["R"]**2 / s["sigma"],
             **dict(zip(("alone_speed", "alone_Re", "alone_We"), alone(s))), "axis_speed": on_axis(run),
             "on_their_way": float(np.mean((series["bubbles"] - series["layer"])[later])),
             "bubbles": series["bubbles"][last[CALM]], "given_mm3": mm3 * series["given"][last[CALM]],
             "burst_mm3": mm3 * series["burst"][-1],
             "seen": series["seen"][last[CALM]] / max(series["gas"][last[CALM]], 1e-30),
             "kinetic": float(series["kinetic"].max()),
             "missing": float(np.max(np.abs(series["given"] - series["gas"] - series["burst"])) / series["given"][-1]),
             "column": series["gas"][-1] / s["a"],
             "lid_calm": series["lid"][last[CALM]], "lid_packed": series["lid"][last[PACK]]}
    for name, frame in run.stages().items():
        found[f"depth_{name.replace(' ', '_')}"] = mean_depth(gas_of(frame), s)
    depth, phi = profile(gas_of(run.frames[-1]), s)
    top = (depth > 0.5) & (depth < 2)
    found["top"] = float(phi[top].mean())
    radius = gas_of(run.frames[-1])["radius"] if found["column"] else np.ones(1)
    carried = found["column"] - phi[depth < 0.5].sum() * SLICE - 0.5 * phi[top].sum() * SLICE       # gas below, over R
    found["top_real"] = of_real_foam(found["bond"] * carried * np.sum(radius**3) / np.sum(radius**2) / s["a"])
    if run.coarsening is not None:
        c = run.coarsening
        found.update({"hours": c["seconds"][-1] / 3600, "tau": c["tau"][-1], "left": c["bubbles"][-1],
                      "R_end": c["R"][-1], "R32_end": c["R32"][-1] / c["R32"][0],
                      "gas_end": c["gas"][-1] / series["given"][-1], "contacts": c["contacts"][0],
                      "evaluations": c["evaluations"][-1] - c["evaluations"][0]})
    log = next((run.directory / name for name in LOGS if (run.directory / name).is_file()), None)
    if log:
        for name, (steps, seconds) in zip(("plume", "calm", "pack", "coarsen"), steps_of(log)):
            found.update({f"steps_{name}": float(steps), f"cpu_{name}": seconds})
    return found


# ---------------------------------------------------------------- figures

def draw_bubbles(ax: Any, frame: Frame, s: dict[str, float], cut: bool) -> Any:
    """Bubbles to scale: all that are in front of the middle plane, or circles where the plane cuts them."""
    gas = gas_of(frame)
    order = np.argsort(-gas["y"])
    gas = {name: values[order] for name, values in gas.items()}
    some = np.abs(gas["y"]) < gas["radius"] if cut else gas["y"] < 0
    width = 2 * (np.sqrt(gas["radius"][some]**2 - gas["y"][some]**2) if cut else gas["radius"][some])
    mm = 1e3 * s["W"]
    circles = EllipseCollection(mm * width, mm * width, np.zeros_like(width), units="xy",
                                offsets=mm * np.column_stack([gas["x"][some], gas["z"][some]]),
                                offset_transform=ax.transData, array=gas["radius"][some] / s["a"], linewidths=0.2,
                                edgecolors="0.2", alpha=0.85, **SIZES)
    ax.add_collection(circles)
    ax.axhline(mm, color="k", lw=0.8)
    return circles


def draw_liquid(ax: Any, frame: Frame, s: dict[str, float], key: bool) -> None:
    """Velocity of the liquid in the middle plane."""
    mine = (frame["type"] == 1) & (np.abs(frame["y"]) < 0.8 * s["dr"])
    mm, speed = 1e3 * s["W"], s["W"] * s["second"]
    if mine.any():
        arrows = ax.quiver(mm * frame["x"][mine], mm * frame["z"][mine], speed * frame["vx"][mine],
                           speed * frame["vz"][mine], color="C0", scale=0.6, width=0.006, zorder=3)
        if key:
            ax.quiverkey(arrows, 0.14, 0.06, 0.1, "0.1 m/s", labelpos="E", fontproperties={"size": 6})


def draw_state(run: Run, out: Path) -> None:
    """Tanks with bubbles in front of the middle plane above, cuts through the layer below."""
    s, mm = run.s, 1e3 * run.s["W"]
    stages = run.stages()
    wet = [name for name in stages if name not in ("packed", "coarsened")]
    dry = [name for name in stages if name not in wet]
    figure.panels()                                        # sets the style
    plt.close()
    rows = [[name for name in wet for _ in dry or wet]] + [[name for name in dry for _ in wet]] * bool(dry)
    fig, axes = plt.subplot_mosaic(rows, figsize=(7.2, 4.4), height_ratios=(1, 0.6)[:len(rows)])
    for name, frame in stages.items():
        ax = axes[name]
        ax.set(xlim=(-0.5 * mm, 0.5 * mm), aspect="equal", xlabel="x (mm)")
        if name in wet:
            ax.set(ylim=(0, 1.04 * mm))
            draw_liquid(ax, frame, s, key=name == wet[0])
        else:
            ax.set(ylim=(mm * (1 - DEEPEST * s["a"]), mm * (1 + 0.5 * s["a"])))
        circles = draw_bubbles(ax, frame, s, cut=name in dry)
        when = f"{run.seconds(frame) / 3600:.1f} h" if name == "coarsened" else f"{run.seconds(frame):.1f} s"
        ax.set_title(f"{name}, {when}: {len(gas_of(frame)['z'])} bubbles")
        ax.minorticks_off()
    for name in (wet[0], *dry[:1]):
        axes[name].set(ylabel="z (mm)")
    fig.colorbar(circles, ax=list(axes.values()), label="radius / R", shrink=0.6, extend="both")
    figure.save(fig, out / "state")


def draw_budget(run: Run, out: Path) -> None:
    series, s = run.series, run.s
    t, mm3 = series["seconds"], 1e9 * s["W"]**3
    fig, (left, middle, right) = figure.panels(1, 3, width=2.3, height=2.3)
    left.plot(t, series["bubbles"] - series["layer"], label="in the liquid")
    left.plot(t, series["layer"], label="in the layer")
    left.set(xlabel="time (s)", ylabel="bubbles")
    middle.plot(t, mm3 * series["given"], label="sparged")
    middle.plot(t, mm3 * series["gas"], "--", label="in bubbles")
    middle.plot(t, mm3 * series["gas"] * np.clip(series["lid"], 0, 1.2), lw=0.6, label="carried by the lid")
    if series["burst"][-1] > 0:
        middle.plot(t, mm3 * series["burst"], label="burst")
    middle.set(xlabel="time (s)", ylabel="gas (mm$^3$)", ylim=(0, 1.25 * mm3 * series["given"][-1]))
    for ax in (left, middle):
        for end in (s["fill"], s["fill"] + s["calm"]):
            ax.axvline(end, color="0.7", lw=0.6)
        ax.legend()
    if run.coarsening is not None:
        c = run.coarsening
        hours = c["seconds"] / 3600
        right.plot(hours, c["R"], label=figure.R)
        right.plot(hours, c["R32"] / c["R32"][0], label=r"$R_{32}/R_{32,\mathrm{in}}$")
        right.plot(hours, c["bubbles"] / c["bubbles"][0], label=r"$N/N_\mathrm{in}$")
        right.plot(hours, c["gas"] / series["given"][-1], "--", color="0.5", label="gas / sparged")
        right.set(xlabel="time (h)", ylim=(0.4, 1.6))
        right.legend()
    figure.save(fig, out / "budget")


def draw_layer(run: Run, out: Path) -> None:
    s = run.s
    fig, (left, middle, right) = figure.panels(1, 3, width=2.3, height=2.4)
    columns: dict[str, Array] = {}
    for m, (name, frame) in enumerate(run.stages().items()):
        gas = gas_of(frame)
        columns["depth"], phi = profile(gas, s)
        columns[name.replace(" ", "_")] = phi
        left.plot(phi, -columns["depth"], color=f"C{m}", label=name)
        middle.plot(*heights(gas, s), "o-", color=f"C{m}", label=name)
        if name in ("packed", "coarsened"):
            size = gas["radius"] / gas["radius"].mean()
            right.hist(size, np.linspace(0, 2.2, 23), density=True, histtype="step", color=f"C{m}", label=name)
    left.set(xlabel="gas fraction", ylabel="height below the lid / R", xlim=(0, 1), ylim=(-12, 0))
    middle.set(xlabel="distance from the axis / half width", ylabel="height of gas / R", ylim=(0, None))
    right.set(xlabel=r"$R/\langle R\rangle$", ylabel="probability density")
    for ax in (left, middle, right):
        if ax.get_legend_handles_labels()[0]:
            ax.legend(fontsize=6)
    figure.save(fig, out / "layer")
    table.write(columns, out / "profile.csv")


def draw_stiff(runs: list[Run], out: Path) -> None:
    """Layers below contacts of several stiffnesses, in the liquid and at rest, and how they coarsen."""
    fig, (left, middle, right) = figure.panels(1, 3, width=2.3, height=2.4)
    for m, run in enumerate(sorted(runs, key=lambda run: -run.s["stiff"])):
        s, stages, c = run.s, run.stages(), run.coarsening
        for ax, name in ((left, "calm"), (middle, "packed")):
            depth, phi = profile(gas_of(stages[name]), s)
            ax.plot(phi, -depth, color=f"C{m}", label=f"stiff {s['stiff']:g}")
            ax.set(xlabel="gas fraction", xlim=(0, 1.5), ylim=(-8, 0), title=name)
        if c is not None:
            right.plot(c["seconds"] / 3600, c["bubbles"] / c["bubbles"][0], color=f"C{m}")
            right.plot(c["seconds"] / 3600, c["R32"] / c["R32"][0], "--", color=f"C{m}")
    left.set(ylabel="height below the lid / R")
    right.set(xlabel="time (h)", ylabel=r"$N/N_\mathrm{in}$; dashed: $R_{32}/R_{32,\mathrm{in}}$", title="coarsening")
    middle.legend()
    figure.save(fig, out / "stiff")


def draw_one(directory: Path, out: Path) -> dict[str, float]:
    run = Run(directory)
    found = numbers(run)
    table.write({"name": list(found), "value": list(found.values())}, out / "numbers.csv")
    draw_state(run, out)
    draw_budget(run, out)
    draw_layer(run, out)
    return found


def draw(out: Path) -> None:
    if (out / "series.csv").is_file():
        found = draw_one(out, out)
        table.show({"name": list(found), "value": list(found.values())}, most=100)
        return
    every = sorted(path.parent for path in out.glob("**/complete"))
    if not every:
        raise Unusable(f"{out} has no run of in.layer")
    rows = {str(path.relative_to(out)): draw_one(path, path) for path in every}
    stiff = [Run(path) for path in every if path.parent.name == "stiff"]
    if stiff:
        draw_stiff(stiff, out)
    names = list(dict.fromkeys(name for row in rows.values() for name in row))
    columns = {"run": list(rows), **{name: [row.get(name, np.nan) for row in rows.values()] for name in names}}
    table.write(columns, out / "variants.csv")
    for name, values in columns.items():
        if name != "run":
            print(f"{name:18}", *(f"{value:12.5g}" for value in values))
        else:
            print(f"{name:18}", *(f"{value:>12}" for value in values))
    plt.close("all")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("directory", type=Path, metavar="DIR")
    try:
        draw(parser.parse_args().directory)
    except Unusable as wrong:
        sys.exit(str(wrong))
