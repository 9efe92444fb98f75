#!/usr/bin/env python3
"""Figures and numbers of a liquid alone, from what run.py wrote.

    python3 plot.py DIR      writes tables (.csv) and figures (.pdf, .png) in DIR

Front of a dam break: half of a row of particles across the floor, 4 of 8, is further away from the wall than it, and it
is half a spacing beyond them. Its error is the root mean square over frames until t = 1.75 of what it differs from
the potential flow of reference.py. Times are those of the CPU without set-up, by LAMMPS' log.

Measured fronts: Martin and Moyce, Phil. Trans. R. Soc. Lond. A 244, 312 (1952), square column of 2.25 inches, as
redrawn by Leakey et al., arXiv:2108.08769 (2021), figure 7, and Lobovsky et al., arXiv:1308.0115 (2013), figure 12.
The zero of their time is uncertain, since a gate was pulled away.
"""
from __future__ import annotations

import argparse
import csv
import json
from pathlib import Path
import re
import sys
from typing import Any

from matplotlib import pyplot as plt
import numpy as np
from numpy.typing import NDArray

from lammps_foam.analysis import figure, table
from lammps_foam.analysis.read import Frame, Unusable, read_frames

from run import EXPLICIT, FINE_TANKS, LIMITED, SETTINGS, SHORT_STEPS, TANKS

Array = NDArray[np.float64]
Series = dict[str, Array]
Rows = list[dict[str, Any]]
HERE = Path(__file__).resolve().parent
LINES = {"lattice": "--", "wide-0.001": ":"}
UNTIL = 1.75         # errors of fronts are those until then: later ones of reference.py depend on its nodes
SETTLED = 0.1        # and those of vortices from then on
MEASURED = (         # time and front
    (0.43, 1.11), (0.62, 1.22), (0.80, 1.44), (0.97, 1.67), (1.14, 1.89), (1.29, 2.11), (1.45, 2.33), (1.62, 2.56),
    (1.76, 2.78), (1.93, 3.00), (2.07, 3.22), (2.24, 3.44), (2.40, 3.67), (2.54, 3.89), (2.71, 4.11))


# ---------------------------------------------------------------- what run.py wrote

def settings(directory: Path, script: str) -> dict[str, float]:
    """Numbers that a run had: those of its script, but for those that it was given."""
    words = dict(re.findall(r"^variable\s+(\w+)\s+index\s+(\S+)", (HERE / script).read_text(), re.M))
    words.update(json.loads((directory / "settings.json").read_text()))
    return {name: float(value) for name, value in words.items() if re.fullmatch(r"[-+.\deE]+", value)}


def read_table(path: Path) -> Series:
    if not path.is_file():
        raise Unusable(f"there is no {path}: run.py writes it")
    with path.open(newline="") as file:
        rows = [row for row in csv.reader(file) if row]
    if len(rows) < 3:
        raise Unusable(f"{path} needs two lines of numbers at least")
    return dict(zip(rows[0], np.array(rows[1:], dtype=float).T))


def complete(directory: Path) -> list[Path]:
    """Runs below it, those of numbers by size."""
    found = [path.parent for path in directory.glob("*/complete")]
    return sorted(found, key=lambda path: (not path.name[0].isdigit(), float(path.name.split("-")[0])
                                           if path.name[0].isdigit() else 0.0, path.name))


def cost(log: Path) -> tuple[int, float]:
    """Steps, and seconds of CPU: LAMMPS says which part of the time it had."""
    found = re.search(r"Loop time of (\S+) on (\d+) procs for (\d+) steps[^%]*?([\d.]+)% CPU use", log.read_text())
    if not found:
        raise Unusable(f"{log} has no 'CPU use'")
    return int(found[3]), float(found[1]) * float(found[2]) * float(found[4]) / 100


def columns(rows: Rows) -> dict[str, list[Any]]:
    return {name: [row[name] for row in rows] for name in rows[0]} if rows else {}


def report(rows: Rows, path: Path) -> None:
    if rows:
        table.show(columns(rows))
        table.write(columns(rows), path)


# ---------------------------------------------------------------- vortices

def vortex_row(path: Path) -> dict[str, Any]:
    s, series = settings(path, "in.vortex"), read_table(path / "vortex.csv")
    steps, seconds = cost(path / "log.liquid")
    late = series["time"] >= SETTLED
    energy, exact = np.log(series["energy"][late]), np.log(series["exact"][late])
    return {"run": path.name, "n": int(s["n"]), "h": s["h"], "dtmax": s["dtmax"], "steps": steps, "seconds": seconds,
            "rate": (energy[-1] - energy[0]) / (exact[-1] - exact[0]), "error": float(series["error"][late].mean()),
            "iterations": float(series["iterations"][late].mean())}


def of_sizes(rows: Rows) -> Rows:
    """Those that are named by their size alone."""
    return [row for row in rows if row["run"][0].isdigit()]


def vortex_orders(rows: Rows) -> Rows:
    """Orders in the spacing of errors at the same longest step, and rates of decay for steps of no length."""
    found: Rows = []
    for n, h in sorted({(row["n"], row["h"]) for row in rows}, key=lambda pair: (pair[1], pair[0])):
        by = {row["dtmax"]: row for row in rows if (row["n"], row["h"]) == (n, h) and row["run"] != "lattice"}
        if not {0.004, 0.001} <= set(by):
            continue
        long, short = by[0.004], by[0.001]
        row = {"n": n, "h": h, "rate_dt_0": short["rate"] - (long["rate"] - short["rate"]) / 3,
               "rate_by_dt": (long["rate"] - short["rate"]) / 0.003, "error_dt_0.001": short["error"], "order": np.nan}
        if found and found[-1]["h"] == h:
            row["order"] = np.log(found[-1]["error_dt_0.001"] / short["error"]) / np.log(n / found[-1]["n"])
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
    sized = of_sizes(rows)
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
    steps, seconds = cost(path / "log.liquid")
    frame = next(iter(read_frames(path / "tank.lammpstrj")))
    slope, head = np.polyfit(frame["z"], frame["p"], 1)
    late = series["step"] >= 0.5 * series["step"][-1]
    return {"run": name, "n": int(settings(path, "in.tank")["n"]), "steps": steps, "time": series["time"][-1],
            "rms": float(series["rms"][late].mean()), "fastest": float(series["fastest"][late].max()),
            "top": series["top"][-1] - series["top"][0], "mean": series["mean"][-1] - series["mean"][0],
            "slope": slope, "uneven": series["uneven"][-1], "iterations": float(series["iterations"][late].mean()),
            "ms_step": 1e3 * seconds / steps}


def draw_tank(out: Path) -> None:
    paths = {name: out / "tank" / name.replace(" ", "-") for name in {**TANKS, **FINE_TANKS}}
    paths = {name: path for name, path in paths.items() if (path / "complete").is_file()}
    report([tank_row(name, path) for name, path in paths.items()], out / "tank.csv")
    fig, (left, middle, right) = figure.panels(1, 3, width=2.5, height=2.9)
    for name, path in paths.items():
        series = read_table(path / "tank.csv")
        line = left.plot(series["step"][1:], np.maximum(series["rms"][1:], 1e-10), label=name)[0]
        middle.plot(series["step"], series["mean"] - series["mean"][0], color=line.get_color())
        if "published" not in name:
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


# ---------------------------------------------------------------- dam breaks

def fronts(path: Path, n: int) -> tuple[Array, Array]:
    """Times of frames, and fronts: half of a row of 8 particles is beyond."""
    frames = [frame for frame in read_frames(path / "dambreak.lammpstrj") if len(frame) >= 4]
    return (np.array([frame.time or 0.0 for frame in frames]),
            np.array([np.sort(frame["x"])[-4] + 0.5 / n for frame in frames]))


def frame_at(frames: list[Frame], time: float) -> Frame:
    return min(frames, key=lambda frame: abs((frame.time or 0.0) - time))


def energy(frame: Frame) -> float:
    """Kinetic and potential, of a particle."""
    return float(np.mean(0.5 * (frame["vx"]**2 + frame["vz"]**2) + frame["z"]))


def dambreak_row(name: str, path: Path, script: str, potential: Series) -> dict[str, Any]:
    n = int(settings(path, script)["n"])
    steps, seconds = cost(path / "log.liquid")
    t, x = fronts(path, n)
    off = x - np.interp(t, potential["time"], potential["front"])
    early = (t > 0) & (t <= UNTIL)
    row = {"run": name, "method": "explicit" if script == "explicit.lmp" else "projection", "n": n, "steps": steps,
           "seconds": seconds, "error": float(np.sqrt(np.mean(off[early]**2)))}
    for time in (0.5, 1.0, 1.5):
        row[f"off_{time:g}"] = float(np.interp(time, t, off))
    frames = list(read_frames(path / "dambreak.lammpstrj"))
    row["energy"] = energy(frame_at(frames, UNTIL)) / energy(frames[0])
    row["iterations"] = np.nan
    if script == "in.dambreak":
        row["iterations"] = float(read_table(path / "dambreak.csv")["iterations"].mean())
    return row


def at_same_error(rows: Rows) -> Rows:
    """Seconds that the explicit method needs for the errors of ours, on power laws from one size to the next.

    Where its finest run is worse than that, its seconds are the least that it needs.
    """
    theirs = sorted((row for row in rows if row["method"] == "explicit"), key=lambda row: -row["error"])
    same_size = {row["n"]: row for row in theirs}
    error = np.log([row["error"] for row in theirs])
    seconds = np.log([row["seconds"] for row in theirs])
    found: Rows = []
    for row in rows:
        if row["method"] != "projection" or row["n"] not in same_size:
            continue
        needs = float(np.exp(np.interp(-np.log(row["error"]), -error, seconds)))
        twin = same_size[row["n"]]
        found.append({"n": row["n"], "error": row["error"], "seconds": row["seconds"],
                      "explicit_error": twin["error"], "explicit_seconds": twin["seconds"],
                      "explicit_needs": needs, "at_least": "yes" if np.log(row["error"]) < error[-1] else "no",
                      "ratio": needs / row["seconds"]})
    return found


def draw_pictures(out: Path, n: int, potential: Series) -> None:
    fig, axes = figure.panels(3, 2, width=3.1, height=1.25)
    points = None
    for column, (group, title) in enumerate((("dambreak", "this package"), ("explicit", "LAMMPS' explicit SPH"))):
        frames = list(read_frames(out / group / str(n) / "dambreak.lammpstrj"))
        for row, time in enumerate((0.5, 1.25, 2.0)):
            ax, frame = axes[2 * row + column], frame_at(frames, time)
            points = ax.scatter(frame["x"], frame["z"], s=18.0 / n, c=np.hypot(frame["vx"], frame["vz"]), lw=0,
                                cmap="viridis", vmin=0, vmax=2, rasterized=True)
            exact = np.interp(frame.time or 0.0, potential["time"], potential["front"])
            ax.plot(exact, 0.03, "v", color="#D55E00", ms=4)
            ax.set(xlim=(0, 4), ylim=(0, 1.05), aspect="equal", title=f"{title}, t = {frame.time:.2f}")
            ax.minorticks_off()
    fig.colorbar(points, ax=axes, label="speed", shrink=0.7)
    figure.save(fig, out / "dambreak")


def draw_front(out: Path, rows: Rows, n: int, potential: Series) -> None:
    fig, (left, middle, right) = figure.panels(1, 3, width=2.5, height=2.6)
    left.plot(potential["time"], potential["front"], "k-", label="potential flow")
    left.plot(*np.array(MEASURED).T, "s", color="0.5", label="Martin and Moyce")
    for group, label, style in (("dambreak", "this package", "-"), ("explicit", "explicit SPH", "--")):
        for size, colour in ((8, "#56B4E9"), (n, "#0072B2")):
            path = out / group / str(size)
            if (path / "complete").is_file():
                left.plot(*fronts(path, size), style, color=colour, label=f"{label}, n = {size}")
    left.set(xlabel=r"$t\,\sqrt{g/a}$", ylabel="front / a", xlim=(0, 2.3), ylim=(1, 4.6))
    left.legend(fontsize=6)
    for method, label, style in (("projection", "this package", "o-"), ("explicit", "explicit SPH", "s--")):
        some = [row for row in of_sizes(rows) if row["method"] == method]
        middle.plot([row["seconds"] for row in some], [row["error"] for row in some], style, label=label)
        for row in some:
            middle.annotate(str(row["n"]), (row["seconds"], row["error"]), (3, 3), textcoords="offset points",
                            fontsize=6)
    middle.set(xlabel="seconds of CPU", ylabel="error of the front / a", xscale="log", yscale="log")
    middle.legend()
    names = ["16", "shift-published", *(name.replace(" ", "-") for name in SHORT_STEPS)]
    colours: dict[float, str] = {}
    for name in names:
        path = out / "dambreak" / name
        if (path / "complete").is_file():
            t, x = fronts(path, 16)
            dtmax = settings(path, "in.dambreak")["dtmax"]
            label = "steps by the flow" if dtmax == float(LIMITED) else f"below {dtmax:g}"
            right.plot(t, x - np.interp(t, potential["time"], potential["front"]), "--" if "published" in name else "-",
                       color=colours.setdefault(dtmax, f"C{len(colours)}"),
                       label=label + (", shift published" if "published" in name else ""))
    right.axhline(0, color="0.6", lw=0.7)
    right.set(xlabel=r"$t\,\sqrt{g/a}$", ylabel="front - potential flow", title="n = 16",
              xlim=(0, UNTIL), ylim=(-0.25, 0.45))
    right.legend(fontsize=6, loc="upper left")
    figure.save(fig, out / "front")


def draw_dambreak(out: Path) -> None:
    file = max(out.glob("potential-*.csv"), key=lambda path: int(path.stem.split("-")[1]), default=None)
    if file is None:
        raise Unusable(f"{out} has no potential-*.csv: run.py writes it")
    potential = read_table(file)
    rows: Rows = []
    for group, script, variants in (("dambreak", "in.dambreak", {**SETTINGS, **SHORT_STEPS}),
                                    ("explicit", "explicit.lmp", EXPLICIT)):
        names = {path.name: path for path in complete(out / group) if path.name.isdigit()}
        names.update({name: out / group / name.replace(" ", "-") for name in variants})
        for name, path in names.items():
            if (path / "complete").is_file():
                rows.append(dambreak_row(name, path, script, potential))
    report(rows, out / "dambreak.csv")
    sized = of_sizes(rows)
    report(at_same_error(sized), out / "same-error.csv")
    both = [row["n"] for row in sized if (out / "explicit" / str(row["n"]) / "complete").is_file()]
    if both:
        draw_pictures(out, max(both), potential)
        draw_front(out, rows, max(both), potential)


# ---------------------------------------------------------------- iterations of the solver

def iterations_row(path: Path) -> dict[str, Any]:
    s, series = settings(path, "in.dambreak"), read_table(path / "dambreak.csv")
    steps, seconds = cost(path / "log.liquid")
    late = series["time"] >= 0.1
    return {"n": int(s["n"]), "ma": s["ma"], "steps": steps, "iterations": float(series["iterations"][late].mean()),
            "most": float(series["iterations"][late].max()), "ms_step": 1e3 * seconds / steps,
            "us_particle": 1e6 * seconds / steps / (8 * s["n"]**2)}


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
    parts = {"vortex": draw_vortex, "tank": draw_tank, "dambreak": draw_dambreak, "iterations": draw_iterations}
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
