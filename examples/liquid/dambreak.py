"""Fronts of dam breaks beside a potential flow, and what they cost beside LAMMPS' own SPH.

Half of a row of particles across the floor, 4 of 8, is further away from the wall than the front, and it is half a
spacing beyond them. Its error is the root mean square over frames until t = 1.75 of what it differs from the potential
flow of reference.py.

Measured fronts: Martin and Moyce, Phil. Trans. R. Soc. Lond. A 244, 312 (1952), square column of 2.25 inches, as
redrawn by Leakey et al., arXiv:2108.08769 (2021), figure 7, and Lobovsky et al., arXiv:1308.0115 (2013), figure 12.
The zero of their time is uncertain, since a gate was pulled away.
"""
from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lammps_foam.analysis import figure
from lammps_foam.analysis.read import Frame, Unusable, read_frames

from run import EXPLICIT, LIMITED, METHODS, PAIRED, RHEO, SETTINGS, SHORT_STEPS
from written import (Array, Rows, Series, complete, cost, folder, is_complete, of_sizes, read_table, report,
                     settings)

UNTIL = 1.75         # errors of fronts are those until then: later ones of reference.py depend on its nodes
MEASURED = (         # time and front
    (0.43, 1.11), (0.62, 1.22), (0.80, 1.44), (0.97, 1.67), (1.14, 1.89), (1.29, 2.11), (1.45, 2.33), (1.62, 2.56),
    (1.76, 2.78), (1.93, 3.00), (2.07, 3.22), (2.24, 3.44), (2.40, 3.67), (2.54, 3.89), (2.71, 4.11))
WAY = (1.67, 2.78)   # of the front, for its speed
TITLES = {"projection": "this package", "explicit": "sph/taitwater", "rheo": "RHEO"}
PAIR_TITLES = {**TITLES, "quick": "quick"}
MARKS = {"projection": "o-", "explicit": "s--", "rheo": "^:"}


def fronts(path: Path, n: int) -> tuple[Array, Array]:
    """Times of frames, and fronts."""
    frames = [frame for frame in read_frames(path / "dambreak.lammpstrj") if len(frame) >= 4]
    return (np.array([frame.time or 0.0 for frame in frames]),
            np.array([np.sort(frame["x"])[-4] + 0.5 / n for frame in frames]))


def frame_at(frames: list[Frame], time: float) -> Frame:
    return min(frames, key=lambda frame: abs((frame.time or 0.0) - time))


def energy(frame: Frame) -> float:
    """Kinetic and potential, of a particle."""
    return float(np.mean(0.5 * (frame["vx"]**2 + frame["vz"]**2) + frame["z"]))


def speed(t: Array, x: Array) -> float:
    """Of the front on its way, whatever the zero of time is."""
    return (WAY[1] - WAY[0]) / float(np.diff(np.interp(WAY, x, t))[0])


def dambreak_row(name: str, path: Path, method: str, potential: Series) -> dict[str, Any]:
    n = int(settings(path, METHODS[method])["n"])
    steps, seconds = cost(path / "log.liquid")
    t, x = fronts(path, n)
    off = x - np.interp(t, potential["time"], potential["front"])
    early = (t > 0) & (t <= UNTIL)
    row = {"run": name, "method": method, "n": n, "steps": steps, "seconds": seconds,
           "error": float(np.sqrt(np.mean(off[early]**2)))}
    for time in (0.5, 1.0, 1.5):
        row[f"off at {time:g}"] = float(np.interp(time, t, off))
    measured = np.array([pair for pair in MEASURED if pair[0] <= UNTIL])
    row["off measured"] = float(np.sqrt(np.mean((np.interp(measured[:, 0], t, x) - measured[:, 1])**2)))
    row["speed"] = speed(t, x)
    frames = list(read_frames(path / "dambreak.lammpstrj"))
    row["energy"] = energy(frame_at(frames, UNTIL)) / energy(frames[0])
    row["iterations"] = np.nan
    if method == "projection":
        row["iterations"] = float(read_table(path / "dambreak.csv")["iterations"].mean())
    return row


def at_same_error(rows: Rows) -> Rows:
    """Seconds that the explicit methods need for the errors of ours, on power laws from one size to the next.

    Where the finest run of one is worse than that, its seconds are the least that it needs: they have a >.
    """
    found: Rows = []
    for row in rows:
        if row["method"] != "projection":
            continue
        new = {"n": row["n"], "error": row["error"], "seconds": row["seconds"]}
        for method in ("explicit", "rheo"):
            theirs = sorted((one for one in rows if one["method"] == method), key=lambda one: -one["error"])
            if not theirs:
                continue
            error = np.log([one["error"] for one in theirs])
            needs = float(np.exp(np.interp(-np.log(row["error"]), -error, np.log([one["seconds"] for one in theirs]))))
            more = "> " if np.log(row["error"]) < error[-1] else ""
            new[f"{TITLES[method]} needs"] = f"{more}{needs:.3g}"
            new[f"{TITLES[method]} / this"] = f"{more}{needs / row['seconds']:.2g}"
        found.append(new)
    return found


def pairs(out: Path, potential: Series) -> Rows:
    """Seconds of methods that ran one after the other, some times: medians, ranges of ratios; and errors."""
    found: dict[int, dict[str, dict[str, dict[str, Any]]]] = {}
    for path in complete(out / "pairs"):
        n, repeat, method = path.name.split("-")
        its = dambreak_row(path.name, path, "projection" if method == "quick" else method, potential)
        found.setdefault(int(n), {}).setdefault(repeat, {})[method] = its
    rows: Rows = []
    for n, repeats in found.items():
        all_of_them = [run for run in repeats.values() if len(run) == len(PAIRED)]
        if not all_of_them:
            continue
        row: dict[str, Any] = {"n": n, "runs": len(all_of_them)}
        seconds = {method: np.array([run[method]["seconds"] for run in all_of_them]) for method in PAIRED}
        for method, of in seconds.items():
            row[PAIR_TITLES[method]] = float(np.median(of))
        for method in ("projection", "quick"):
            ratio = seconds["explicit"] / seconds[method]
            row[f"sph/taitwater over {PAIR_TITLES[method]}"] = \
                f"{np.median(ratio):.2f} ({ratio.min():.2f} to {ratio.max():.2f})"
        for method in PAIRED:
            row[f"error, {PAIR_TITLES[method]}"] = all_of_them[0][method]["error"]
        rows.append(row)
    return rows


# ---------------------------------------------------------------- figures

def draw_pictures(out: Path, n: int, potential: Series) -> None:
    fig, axes = figure.panels(3, 2, width=3.1, height=1.1)
    points = None
    for column, method in enumerate(("projection", "explicit")):
        frames = list(read_frames(out / method / str(n) / "dambreak.lammpstrj"))
        for row, time in enumerate((0.5, 1.25, 2.0)):
            ax, frame = axes[2 * row + column], frame_at(frames, time)
            points = ax.scatter(frame["x"], frame["z"], s=18.0 / n, c=np.hypot(frame["vx"], frame["vz"]), lw=0,
                                cmap="viridis", vmin=0, vmax=2, rasterized=True)
            exact = np.interp(frame.time or 0.0, potential["time"], potential["front"])
            ax.plot(exact, 0.03, "v", color="#D55E00", ms=4)
            ax.set(xlim=(0, 4), ylim=(0, 1.05), aspect="equal", title=f"{TITLES[method]}, t = {frame.time:.2f}")
            ax.minorticks_off()
    fig.colorbar(points, ax=axes, label="speed", shrink=0.7)
    figure.save(fig, out / "dambreak")


def draw_front(out: Path, rows: Rows, n: int, potential: Series) -> None:
    fig, (left, middle, right) = figure.panels(1, 3, width=2.5, height=2.6)
    left.plot(potential["time"], potential["front"], "k-", label="potential flow")
    left.plot(*np.array(MEASURED).T, "s", color="0.5", label="Martin and Moyce")
    finest = {method: max((row["n"] for row in of_sizes(rows) if row["method"] == method), default=n)
              for method in MARKS}
    for method, style in (("projection", "-"), ("explicit", "--"), ("rheo", ":")):
        for size, colour in ((8, "#56B4E9"), (finest[method], "#0072B2")):
            path = out / method / str(size)
            if is_complete(path):
                left.plot(*fronts(path, size), style, color=colour, label=f"{TITLES[method]}, n = {size}")
    left.set(xlabel=r"$t\,\sqrt{g/a}$", ylabel="front / a", xlim=(0, 2.3), ylim=(1, 4.6))
    left.legend(fontsize=6)
    for method, style in MARKS.items():
        some = [row for row in of_sizes(rows) if row["method"] == method]
        middle.plot([row["seconds"] for row in some], [row["error"] for row in some], style, label=TITLES[method])
        for row in some:
            middle.annotate(str(row["n"]), (row["seconds"], row["error"]), (6, -2) if method == "rheo" else (3, 3),
                            textcoords="offset points", fontsize=6)
    middle.set(xlabel="seconds of CPU", ylabel="error of the front / a", xscale="log", yscale="log")
    middle.margins(0.12)
    middle.legend()
    names = ["16", "shift-published", *(folder(name) for name in SHORT_STEPS)]
    colours: dict[float, str] = {}
    for name in names:
        path = out / "projection" / name
        if is_complete(path):
            t, x = fronts(path, 16)
            dtmax = settings(path, "in.dambreak")["dtmax"]
            label = "steps by the flow" if dtmax == float(LIMITED) else f"below {dtmax:g}"
            right.plot(t, x - np.interp(t, potential["time"], potential["front"]), "--" if "published" in name else "-",
                       color=colours.setdefault(dtmax, f"C{len(colours)}"),
                       label=label + (", shift published" if "published" in name else ""))
    right.axhline(0, color="0.6", lw=0.7)
    right.set(xlabel=r"$t\,\sqrt{g/a}$", ylabel="front - potential flow", title="n = 16",
              xlim=(0, UNTIL), ylim=(-0.25, 0.3))
    right.legend(fontsize=6, loc="upper left")
    figure.save(fig, out / "front")


def rows_of(out: Path) -> tuple[Rows, Series]:
    file = max(out.glob("potential-*.csv"), key=lambda path: int(path.stem.split("-")[1]), default=None)
    if file is None:
        raise Unusable(f"{out} has no potential-*.csv: run.py writes it")
    potential = read_table(file)
    rows: Rows = []
    for method, variants in (("projection", {**SETTINGS, **SHORT_STEPS}), ("explicit", EXPLICIT), ("rheo", RHEO)):
        names = {path.name: path for path in complete(out / method) if path.name.isdigit()}
        names.update({name: out / method / folder(name) for name in variants})
        rows += [dambreak_row(name, path, method, potential) for name, path in names.items() if is_complete(path)]
    return rows, potential


def draw_dambreak(out: Path) -> None:
    rows, potential = rows_of(out)
    print(f"speed of the front: potential flow {speed(potential['time'], potential['front']):.3f}, "
          f"measured {speed(*np.array(MEASURED).T):.3f}")
    for method in METHODS:
        report([{name: value for name, value in row.items() if name != "method"}
                for row in rows if row["method"] == method], out / f"dambreak-{method}.csv")
    sized = of_sizes(rows)
    report(at_same_error(sized), out / "same-error.csv")
    report(pairs(out, potential), out / "pairs.csv")
    both = [row["n"] for row in sized if row["method"] == "projection" and is_complete(out / f"explicit/{row['n']}")]
    if both:
        draw_pictures(out, max(both), potential)
        draw_front(out, rows, max(both), potential)
