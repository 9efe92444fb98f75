#!/usr/bin/env python3
"""Figures and numbers of a liquid alone, from what run.py wrote.

    python3 plot.py DIR      writes tables (.csv) and figures (.pdf, .png) in DIR

Times are those of the CPU without set-up, by LAMMPS' log. Vortices, tanks and iterations are drawn here, all else by
dambreak.py, turbulence.py and precision.py.
"""
from __future__ import annotations

import argparse
from pathlib import Path
import sys
from typing import Any

from matplotlib import pyplot as plt
import numpy as np

from lammps_foam.analysis import figure
from lammps_foam.analysis.read import Unusable, read_frames

from dambreak import draw_dambreak
from precision import draw_precision
from rise import draw_rise
from run import FINE_TANKS, LIMITED, TANKS, VORTICES
from turbulence import draw_beltrami, draw_bubble, draw_turbulence
from written import Rows, complete, cost, folder, is_complete, read_table, report, settings

LINES = {"lattice": "--", "wide-0.001": ":"}
SETTLED = 0.1        # errors of vortices are those from then on
COLOURS = 7          # that a figure has


# ---------------------------------------------------------------- vortices

def vortex_row(path: Path) -> dict[str, Any]:
    s, series = settings(path, "in.vortex"), read_table(path / "vortex.csv")
    steps, seconds = cost(path / "log.liquid")
    late = series["time"] >= SETTLED
    energy, exact = np.log(series["energy"][late]), np.log(series["exact"][late])
    return {"run": path.name, "n": int(s["n"]), "h": s["h"], "dtmax": s["dtmax"], "steps": steps, "seconds": seconds,
            "rate": (energy[-1] - energy[0]) / (exact[-1] - exact[0]), "error": float(series["error"][late].mean()),
            "friction": float(series["friction"][late].mean()), "energy": series["energy"][-1],
            "iterations": float(series["iterations"][late].mean())}


def vortex_orders(rows: Rows) -> Rows:
    """Orders in the spacing of errors at the same longest step, and rates of decay for steps of no length."""
    found: Rows = []
    special = {folder(name) for name in VORTICES}
    for n, h in sorted({(row["n"], row["h"]) for row in rows}, key=lambda pair: (pair[1], pair[0])):
        by = {row["dtmax"]: row for row in rows if (row["n"], row["h"]) == (n, h) and row["run"] not in special}
        if not {0.004, 0.001} <= set(by):
            continue
        long, short = by[0.004], by[0.001]
        row = {"n": n, "h": h, "rate at dt 0": short["rate"] - (long["rate"] - short["rate"]) / 3,
               "slope of the rate": (long["rate"] - short["rate"]) / 0.003, "error at dt 0.001": short["error"],
               "order": np.nan}
        if found and found[-1]["h"] == h:
            row["order"] = np.log(found[-1]["error at dt 0.001"] / short["error"]) / np.log(n / found[-1]["n"])
        found.append(row)
    return found


def draw_vortex(out: Path) -> None:
    paths = complete(out / "vortex")
    rows = [vortex_row(path) for path in paths]
    report(rows, out / "vortex.csv")
    report(vortex_orders(rows), out / "vortex-orders.csv")
    fig, (left, right) = figure.panels(1, 2, width=3.0, height=2.5)
    colours = {dtmax: f"C{k}" for k, dtmax in enumerate(sorted({row["dtmax"] for row in rows}, reverse=True))}
    special = {"lattice": ", from a lattice", "wide-0.001": ", h = 1.5"}
    for path, row in zip(paths, rows):
        if row["run"].startswith("24-") or row["run"] in special:
            series = read_table(path / "vortex.csv")
            step = "by the flow" if row["dtmax"] == float(LIMITED) else f"below {row['dtmax']:g}"
            left.plot(series["time"], series["energy"] / series["exact"], LINES.get(row["run"], "-"),
                      color=colours[row["dtmax"]], label=f"steps {step}{special.get(row['run'], '')}")
    left.axhline(1, color="0.6", lw=0.7)
    left.set(xlabel="time", ylabel="kinetic energy / exact", title="n = 24")
    left.legend()
    sized = [row for row in rows if row["run"][0].isdigit()]
    for dtmax in sorted({row["dtmax"] for row in sized}, reverse=True):
        some = [row for row in sized if row["dtmax"] == dtmax]
        right.plot([row["n"] for row in some], [row["error"] for row in some], "o-", color=colours[dtmax],
                   label="steps by the flow" if dtmax == float(LIMITED) else f"steps below {dtmax:g}")
    size = np.array([min(row["n"] for row in sized), max(row["n"] for row in sized)])
    first = min(row["error"] for row in sized if row["n"] == size[0])
    for order, style in ((1, ":"), (2, "--")):
        right.plot(size, first * (size[0] / size)**order, style, color="0.6", label=f"order {order}")
    right.set(xlabel="particles along an edge", ylabel="error of velocities", xscale="log", yscale="log")
    figure.plain_ticks(right, "x")
    right.legend()
    figure.save(fig, out / "vortex")


# ---------------------------------------------------------------- a tank at rest

def tank_row(name: str, path: Path) -> dict[str, Any]:
    series = read_table(path / "tank.csv")
    frame = next(iter(read_frames(path / "tank.lammpstrj")))
    slope, head = np.polyfit(frame["z"], frame["p"], 1)
    late = series["step"] >= 0.5 * series["step"][-1]
    return {"run": name, "n": int(settings(path, "in.tank")["n"]), "steps": int(series["step"][-1]),
            "time": series["time"][-1],
            "rms": float(series["rms"][late].mean()), "fastest": float(series["fastest"][late].max()),
            "top": series["top"][-1] - series["top"][0], "mean": series["mean"][-1] - series["mean"][0],
            "slope": slope, "uneven": series["uneven"][-1], "iterations": float(series["iterations"][late].mean())}


def draw_tank(out: Path) -> None:
    paths = {name: out / "tank" / folder(name) for name in {**TANKS, **FINE_TANKS}}
    paths = {name: path for name, path in paths.items() if is_complete(path)}
    report([tank_row(name, path) for name, path in paths.items()], out / "tank.csv")
    fig, (left, middle, right) = figure.panels(1, 3, width=2.5, height=2.9)
    for k, (name, path) in enumerate(paths.items()):
        series = read_table(path / "tank.csv")
        look = "-" if k < COLOURS else "--"
        line = left.plot(series["step"][1:], np.maximum(series["rms"][1:], 1e-10), look, label=name)[0]
        middle.plot(series["step"], series["mean"] - series["mean"][0], look, color=line.get_color())
        if "published" not in name and "tol" not in name:
            frame = next(iter(read_frames(path / "tank.lammpstrj")))
            right.plot(frame["p"], frame["p"] + frame["z"] - series["top"][-1], ".", ms=2, color=line.get_color())
    left.set(xlabel="step", ylabel="root mean square of velocities", yscale="log", xscale="log", ylim=(1e-10, 1))
    middle.set(xlabel="step", ylabel="rise of the mean height", xscale="log", xlim=(100, 1.2e4))
    middle.set_yscale("symlog", linthresh=1e-3)
    right.axhline(0, color="0.6", lw=0.7)
    right.set(xlabel="pressure p at the end", ylabel="p + z - height of the surface")
    right.ticklabel_format(axis="y", style="sci", scilimits=(0, 0))
    fig.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=4)
    figure.save(fig, out / "tank")


# ---------------------------------------------------------------- iterations of the solver

def iterations_row(path: Path) -> dict[str, Any]:
    s, series = settings(path, "in.dambreak"), read_table(path / "dambreak.csv")
    steps, seconds = cost(path / "log.liquid")
    late = series["time"] >= 0.1
    return {"n": int(s["n"]), "ma": s["ma"], "steps": steps, "iterations": float(series["iterations"][late].mean()),
            "most": float(series["iterations"][late].max()), "ms of a step": 1e3 * seconds / steps,
            "us of a particle": 1e6 * seconds / steps / (8 * s["n"]**2)}


def draw_iterations(out: Path) -> None:
    rows = [iterations_row(path) for path in complete(out / "iterations")]
    report(rows, out / "iterations.csv")
    fig, (ax,) = figure.panels(1, 1, width=3.4, height=2.5)
    for ma in sorted({row["ma"] for row in rows}):
        some = sorted((row for row in rows if row["ma"] == ma), key=lambda row: row["n"])
        ax.plot([row["n"] for row in some], [row["iterations"] for row in some], "o-", label=f"Ma = {ma:g}")
    size = np.array(sorted({row["n"] for row in rows}))
    first = max(row["iterations"] for row in rows if row["n"] == size[0])
    ax.plot(size, first * size / size[0], ":", color="0.6", label="1 / spacing")
    ax.set(xlabel="particles over the height", ylabel="iterations a step", xscale="log", yscale="log")
    figure.plain_ticks(ax)
    ax.legend()
    figure.save(fig, out / "iterations")


def draw(out: Path) -> None:
    parts = {"vortex": draw_vortex, "beltrami": draw_beltrami, "turbulence": draw_turbulence, "bubble": draw_bubble,
             "rise": draw_rise, "tank": draw_tank, "projection": draw_dambreak, "precision": draw_precision,
             "iterations": draw_iterations}
    there = [name for name in parts if complete(out / name)]
    if not there:
        raise Unusable(f"{out} has no run of run.py")
    for name in there:
        parts[name](out)
    plt.close("all")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("directory", type=Path, metavar="DIR")
    try:
        draw(parser.parse_args().directory)
    except Unusable as wrong:
        sys.exit(str(wrong))
