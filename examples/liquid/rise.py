"""One bubble that rises: start and speed beside the law of the drag, and how it comes to rest at the surface."""
from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lammps_foam.analysis import figure

from run import RISES
from written import Array, Series, folder, is_complete, read_table, report, settings

VIRTUAL_MASS = 0.5
SLOWED = 0.99        # of the speed before: it has met the surface
SHOWN = 0.12         # time of the start in the figure


def acceleration(u: float, s: dict[str, float]) -> float:
    """In a liquid at rest: buoyancy and drag (Schiller and Naumann) over the mass of the gas and the virtual one."""
    reynolds = 2 * s["a"] * max(u, 1e-12) * s["Re"]
    coefficient = 24 / reynolds * (1 + 0.15 * reynolds**0.687) if reynolds <= 1000 else 0.44
    drag = 3 / 8 * coefficient * u**2 / s["a"]
    return ((1 - 1 / s["beta"]) / s["Fr"]**2 - drag) / (1 / s["beta"] + VIRTUAL_MASS)


def law(s: dict[str, float], end: float) -> tuple[Array, Array]:
    """Speed from rest, by Runge-Kutta steps of the fourth order, short beside the time of the drag."""
    t = np.linspace(0, end, 4001)
    dt, u = t[1], [0.0]
    for _ in t[1:]:
        k1 = acceleration(u[-1], s)
        k2 = acceleration(u[-1] + dt / 2 * k1, s)
        k3 = acceleration(u[-1] + dt / 2 * k2, s)
        k4 = acceleration(u[-1] + dt * k3, s)
        u.append(u[-1] + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4))
    return t, np.array(u)


def there(path: Path) -> Series:
    """The series while the bubble is there."""
    series = read_table(path / "rise.csv")
    alive = series["bubbles"] > 0
    return {name: values[alive] for name, values in series.items()}


def meeting(series: Series) -> tuple[int, float]:
    """The step in which it is slowed down, and its speed before that."""
    fastest = float(series["relative"].max())
    steady = np.flatnonzero(series["relative"] > SLOWED * fastest)
    return int(steady[-1]), fastest


def rise_row(name: str, path: Path) -> dict[str, Any]:
    s, series = settings(path, "in.rise"), there(path)
    met, speed = meeting(series)
    slow = s["dr"] / speed
    expected = float(law(s, 2.0)[1][-1])
    depth = (series["surface"] - series["height"]) / s["dr"]
    t, u = law(s, SHOWN)
    first = series["time"] <= SHOWN
    return {"run": name, "radius": s["a"], "dr": s["dr"], "speed": speed, "law": expected, "over law": speed / expected,
            "start": float(np.abs(series["relative"][first] - np.interp(series["time"][first], t, u)).max() / expected),
            "meets at": depth[met], "T_c": slow, "slowed for": (series["time"][-1] - series["time"][met]) / slow,
            "last speed": series["relative"][-1] / speed, "ends at": depth[-1]}


def draw_rise(out: Path) -> None:
    paths = {name: out / "rise" / folder(name) for name in RISES}
    paths = {name: path for name, path in paths.items() if is_complete(path)}
    report([rise_row(name, path) for name, path in paths.items()], out / "rise.csv")
    fig, (left, middle, right) = figure.panels(1, 3, width=2.5, height=2.7)
    for k, (name, path) in enumerate(paths.items()):
        s, series = settings(path, "in.rise"), there(path)
        met, speed = meeting(series)
        late = (series["time"] - series["time"][met]) * speed / s["dr"]
        label = f"a = {s['a']:g}, dr = {s['dr']:g}"
        t, u = law(s, SHOWN)
        left.plot(series["time"], series["relative"], "o", ms=2.5, color=f"C{k}", label=label)
        left.plot(t, u, "-", color="0.3", lw=0.7)
        middle.plot(late, (series["height"] - series["surface"]) / s["dr"], "-", color=f"C{k}")
        right.plot(late, series["relative"] / speed, "-", color=f"C{k}")
    right.plot([0, 1], [1, 0], ":", color="0.4", label=r"$1 - (t - t_0)/T_c$")
    left.set(xlabel="time", ylabel="speed in the liquid", xlim=(0, SHOWN), ylim=(0, None))
    left.legend(fontsize=6)
    middle.axhline(0, color="0.6", lw=0.7)
    middle.set(xlabel=r"$(t - t_0)/T_c$", ylabel="height above the surface / dr", xlim=(-2, 1.5), ylim=(-5, 0.5))
    right.set(xlabel=r"$(t - t_0)/T_c$", ylabel="speed / that before", xlim=(-1, 1.5), ylim=(0, 1.1))
    right.legend()
    figure.save(fig, out / "rising")
