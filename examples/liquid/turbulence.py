"""Beltrami flows that decay by viscosity, turbulence that they become, and shifts by a bubble: numbers and figures."""
from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lammps_foam.analysis import figure
from lammps_foam.analysis.read import Frame, read_frames

from run import CLOSURES, LIMITED, PUSHED
from spectrum import arrays, interpolated, spectrum
from written import Array, Rows, Series, complete, cost, read_table, report, settings

SETTLED = 0.05       # errors of decays are those from then on
BROKEN_UP = 4.0      # time of spectra: the flow has lost its first shape
SETTLED_PUSH = 0.75  # of the time of a push: its mean energy is that from then on
SHOWN = 72           # points along an edge of a picture
FIRST_SHELL = 2      # that of the Beltrami flow, |k| = sqrt(3)


# ---------------------------------------------------------------- decay at a low Reynolds number

def beltrami_row(path: Path) -> dict[str, Any]:
    s, series = settings(path, "in.turbulence"), read_table(path / "turbulence.csv")
    steps, seconds = cost(path / "log.liquid")
    late = series["time"] >= SETTLED
    energy, exact = np.log(series["energy"][late]), np.log(series["exact"][late])
    return {"run": path.name, "n": int(s["n"]), "dtmax": s["dtmax"], "steps": steps, "seconds": seconds,
            "error": float(series["error"][late].mean()), "order": np.nan,
            "rate": (energy[-1] - energy[0]) / (exact[-1] - exact[0]),
            "iterations": float(series["iterations"][late].mean())}


def with_orders(rows: Rows) -> Rows:
    """Orders in the spacing of errors at the same longest step."""
    rows = sorted(rows, key=lambda row: (-row["dtmax"], row["n"]))
    for before, row in zip(rows, rows[1:]):
        if before["dtmax"] == row["dtmax"]:
            row["order"] = np.log(before["error"] / row["error"]) / np.log(row["n"] / before["n"])
    return rows


def draw_beltrami(out: Path) -> None:
    rows = with_orders([beltrami_row(path) for path in complete(out / "beltrami")])
    report([{name: value for name, value in row.items() if name != "run"} for row in rows], out / "beltrami.csv")
    fig, (left, right) = figure.panels(1, 2, width=3.0, height=2.5)
    for dtmax in sorted({row["dtmax"] for row in rows}, reverse=True):
        some = [row for row in rows if row["dtmax"] == dtmax]
        label = "steps by the flow" if dtmax == float(LIMITED) else f"steps below {dtmax:g}"
        sizes = [row["n"] for row in some]
        left.plot(sizes, [row["error"] for row in some], "o-", label=label)
        right.plot(sizes, [row["rate"] for row in some], "o-", label=label)
    size = np.array([min(row["n"] for row in rows), max(row["n"] for row in rows)])
    least = min(row["error"] for row in rows if row["n"] == size[1])
    left.plot(size, 0.8 * least * (size / size[1])**-2.0, ":", color="0.6", label="second order")
    right.axhline(1, color="0.6", lw=0.7)
    left.set(xlabel="particles along an edge", ylabel="error of velocities", xscale="log", yscale="log")
    right.set(xlabel="particles along an edge", ylabel="rate of decay / exact", xscale="log")
    figure.plain_ticks(left)
    figure.plain_ticks(right, "x")
    left.legend()
    figure.save(fig, out / "beltrami")


# ---------------------------------------------------------------- turbulence

def frame_near(path: Path, time: float) -> Frame:
    return min(read_frames(path / "turbulence.lammpstrj"), key=lambda frame: abs((frame.time or 0.0) - time))


def slope(k: Array, energy: Array, last: float) -> float:
    """Exponent of the spectrum from the shell above that of the first flow to the last."""
    some = (k > FIRST_SHELL) & (k <= last)
    return float(np.polyfit(np.log(k[some]), np.log(energy[some]), 1)[0])


def spent(series: Series) -> Array:
    """By viscosity and closure, from the start on; energy was 1/2 then."""
    rate, dt = series["dissipated"], np.diff(series["time"])
    return 2 * np.concatenate(([0.0], np.cumsum(0.5 * (rate[1:] + rate[:-1]) * dt)))


def turbulence_row(path: Path) -> dict[str, Any]:
    s, series = settings(path, "in.turbulence"), read_table(path / "turbulence.csv")
    steps, seconds = cost(path / "log.liquid")
    t, energy = series["time"], series["energy"]
    last = len(t) - 1
    k, E = spectrum(frame_near(path, BROKEN_UP))
    row = {"run": path.name, "n": int(s["n"]), "steps": steps, "seconds": seconds,
           "half at": float(np.interp(0.5, energy[::-1], t[::-1])) if energy.min() < 0.5 else np.nan}
    for time in (1.0, 2.0, 4.0):
        row[f"energy at {time:g}"] = float(np.interp(time, t, energy))
    early = t <= 0.5
    row["loss before 0.5"] = float(-np.polyfit(t[early], energy[early], 1)[0])
    row["share of closure"] = float(spent(series)[last]) / (energy[0] - energy[last])
    row["slope"] = slope(k, E, row["n"] / 3)
    row["iterations"] = float(series["iterations"].mean())
    return row


def pushed_row(path: Path) -> dict[str, Any]:
    """Energies over that of the start; the loss is that after the push."""
    s, series = settings(path, "in.turbulence"), read_table(path / "turbulence.csv")
    steps, seconds = cost(path / "log.liquid")
    t, energy, until = series["time"], series["energy"], s["push"]
    before, after = t < until, t >= until
    late = before & (t >= SETTLED_PUSH * until)
    k, E = spectrum(frame_near(path, until))
    left = energy / energy[after][0]
    return {"n": int(s["n"]), "steps": steps, "seconds": seconds, "most": float(energy.max()),
            "at": float(t[energy.argmax()]), "mean from 3 to 4": float(energy[late].mean()),
            "half after": float(np.interp(0.5, left[after][::-1], t[after][::-1])) - until,
            "energy at 6": float(np.interp(6.0, t, energy)),
            "share of closure": float(spent(series)[-1] - spent(series)[after][0]) / (energy[after][0] - energy[-1]),
            "slope": slope(k, E, s["n"] / 3), "iterations": float(series["iterations"].mean())}


def draw_slices(out: Path, paths: list[Path]) -> None:
    """Speeds in the middle of the cube, over their root mean square."""
    one = (np.arange(SHOWN) + 0.5) / SHOWN
    where = np.stack([*np.meshgrid(one, one, indexing="ij"), np.full((SHOWN, SHOWN), 0.5)], axis=-1).reshape(-1, 3)
    times = (0.0, 1.5, 2.5, 4.0)
    fig, axes = figure.panels(len(paths), len(times), width=1.55, height=1.6)
    picture = None
    for row, path in enumerate(paths):
        n, closure = path.name.split("-")
        for column, time in enumerate(times):
            ax, frame = axes[len(times) * row + column], frame_near(path, time)
            u = interpolated(*arrays(frame), where, 1 / int(n))
            speed = np.sqrt(np.sum(u**2, axis=1) / np.mean(arrays(frame)[1]**2) / 3).reshape(SHOWN, SHOWN)
            picture = ax.imshow(speed.T, origin="lower", extent=(0, 1, 0, 1), cmap="viridis", vmin=0, vmax=2)
            ax.set(title=f"{closure}, t = {frame.time:.1f}", xticks=(), yticks=())
            ax.minorticks_off()
    fig.colorbar(picture, ax=axes, label="speed / root mean square", shrink=0.8)
    figure.save(fig, out / "turbulence-slices")


def draw_turbulence(out: Path) -> None:
    paths = complete(out / "turbulence")
    free = [path for path in paths if path.name[0].isdigit()]
    pushed = [path for path in paths if path.name.startswith("pushed")]
    report([turbulence_row(path) for path in free], out / "turbulence.csv")
    report([pushed_row(path) for path in pushed], out / "turbulence-pushed.csv")
    fig, (left, middle, right) = figure.panels(1, 3, width=2.5, height=2.6)
    colours = {name: f"C{k}" for k, name in enumerate(CLOSURES)}
    styles = {24: "-", 32: "--", 48: ":"}
    for path in free:
        n, closure = path.name.split("-")
        series = read_table(path / "turbulence.csv")
        left.plot(series["time"], series["energy"], styles.get(int(n), "-."), color=colours[closure],
                  label=f"{closure}, n = {n}")
        k, energy = spectrum(frame_near(path, BROKEN_UP))
        right.plot(k, energy / energy.sum(), styles.get(int(n), "-."), color=colours[closure])
    for path in pushed:
        n = int(path.name.split("-")[1])
        series = read_table(path / "turbulence.csv")
        middle.plot(series["time"], series["energy"], styles.get(n, "-."), color=colours["mixed"],
                    label=f"mixed, n = {n}")
    middle.axvline(float(PUSHED["push"]), color="0.6", lw=0.7)
    k = np.array([2.0, 16.0])
    right.plot(k, 0.9 * (k / k[0])**(-5 / 3), ":", color="0.5", label="$k^{-5/3}$")
    left.set(xlabel="time", ylabel="energy / that of the start", yscale="log")
    middle.set(xlabel="time", ylabel="energy / that of the start", yscale="log",
               title=f"pushed until t = {PUSHED['push']}")
    right.set(xlabel="wave number", ylabel="energy of a shell / all", title=f"t = {BROKEN_UP:g}", xscale="log",
              yscale="log")
    figure.plain_ticks(middle, "y")
    figure.plain_ticks(right, "x")
    for ax in (left, middle, right):
        if ax.lines:
            ax.legend(fontsize=6)
    figure.save(fig, out / "turbulence")
    named = {path.name: path for path in free}
    both = [n for n in styles if {f"{n}-none", f"{n}-mixed"} <= set(named)]
    if both:
        draw_slices(out, [named[f"{max(both)}-{closure}"] for closure in ("mixed", "none")])


# ---------------------------------------------------------------- a bubble that is put in

def bubble_rows(out: Path) -> Rows:
    """Largest |u_ps| of a step, in its first step and later, over places of the bubble."""
    runs: dict[float, list[Array]] = {}
    for path in complete(out / "bubble"):
        if not path.name.startswith("dt"):
            runs.setdefault(settings(path, "in.bubble")["a"], []).append(read_table(path / "bubble.csv")["shift"][1:])
    rows: Rows = []
    for a, some in sorted(runs.items()):
        all_of = np.array(some)
        peak, ratios = all_of[:, 0], all_of[:, 1:] / all_of[:, :-1]
        rows.append({"radius": a, "places": len(some), "peak": float(peak.mean()), "least": float(peak.min()),
                     "most": float(peak.max()), "peak / a^3": float(peak.mean()) / a**3,
                     **{f"step {step}": float(-1 / np.log(ratios[:, step - 2]).mean()) for step in (2, 3, 4, 6, 10)}})
    return rows


def draw_bubble(out: Path) -> None:
    rows = bubble_rows(out)
    report(rows, out / "bubble.csv")
    other = [{"dt": settings(path, "in.bubble")["dt"],
              "peak times dt": settings(path, "in.bubble")["dt"] * float(read_table(path / "bubble.csv")["shift"][1])}
             for path in complete(out / "bubble") if path.name.startswith("dt")]
    report(other, out / "bubble-steps.csv")
    fig, (left, right) = figure.panels(1, 2, width=3.0, height=2.5)
    radii = sorted({row["radius"] for row in rows})
    for path in complete(out / "bubble"):
        if path.name.startswith("dt"):
            continue
        s, series = settings(path, "in.bubble"), read_table(path / "bubble.csv")
        colour = f"C{radii.index(s['a'])}"
        step = np.arange(1, len(series["shift"]))
        left.plot(step, series["shift"][1:] * s["dt"] / s["a"]**3, "-", color=colour, lw=0.8,
                  label=f"a = {s['a']:g} dr" if path.name.endswith("-0") else None)
    step = np.linspace(1, 6, 20)
    first = float(np.mean([row["peak / a^3"] for row in rows])) * 0.1
    left.plot(step, first * np.exp(-1.5 * (step - 1)), ":", color="0.4", label="2 dt / 3, the source")
    left.set(xlabel="step", ylabel=r"$\max|u_{ps}|\,\mathrm{dt}\,/\,a^3$", yscale="log", xlim=(1, 12))
    left.legend()
    right.errorbar(radii, [row["peak"] for row in rows],
                   yerr=[[row["peak"] - row["least"] for row in rows], [row["most"] - row["peak"] for row in rows]],
                   fmt="o")
    line = np.array([radii[0], radii[-1]])
    right.plot(line, rows[0]["peak"] * (line / line[0])**3, ":", color="0.4", label="$a^3$")
    right.set(xlabel="radius / dr", ylabel=r"first $\max|u_{ps}|$", xscale="log", yscale="log")
    figure.plain_ticks(right, "x")
    right.legend()
    figure.save(fig, out / "bubble")


