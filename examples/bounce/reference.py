#!/usr/bin/env python3
"""The bounce of in.bounce once more, as an ordinary differential equation for scipy: a reference for tests.

    python3 reference.py DIR ...   compares DIR/series.csv of in.bounce, its -var settings in DIR/settings.json

Written from the equations of Heitkam et al., J. Phys.: Condens. Matter 29, 124005 (2017), and not from the styles: it
shares no code with them. Radau's method with tight tolerances; the film closes and opens, and forces begin and end, at
events, so that every piece that is integrated is smooth. The fit of the film's integral alone (`integral fit`).

State: distance of the centre from the wall, place along it, and their rates; SI units.
"""
from __future__ import annotations

import argparse
import csv
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, fields
import json
import math
from pathlib import Path
import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]
PI = np.pi


@dataclass(frozen=True)
class Bounce:
    """Settings by the names and with the defaults of in.bounce."""
    R: float = 0.6e-3
    tilt: float = 20.0             # degrees
    release: float = 11.3          # over R
    viscous: str = "published"     # none | published | derived
    tangential: str = "yes"
    lubrication: str = "yes"
    elastic: str = "quadratic"     # quadratic | spring | none
    h0: str = "contact"            # contact | current
    hmin: float = 1.0e-5
    drag: str = "contaminated"     # contaminated | clean | none
    sigma: float = 0.03
    mu: float = 1.0e-3
    rho: float = 1000.0
    gas: float = 1.2
    g: float = 9.81
    time: float = 0.3

    @property
    def volume(self) -> float:
        return 4.0 / 3.0 * PI * self.R**3

    @property
    def mass(self) -> float:
        """Of the gas, and half of the liquid that it displaces."""
        return (self.gas + 0.5 * self.rho) * self.volume


def drag_coefficient(b: Bounce, speed: float) -> float:
    """Force over speed: C_D rho pi R^2 speed / 2, C_D of Schiller & Naumann or of Mei, Klausner & Lawrence."""
    if b.drag == "none" or speed < 1e-30:
        return {"none": 0.0, "contaminated": 6.0 * PI * b.mu * b.R, "clean": 4.0 * PI * b.mu * b.R}[b.drag]
    Re = 2.0 * b.R * b.rho * speed / b.mu
    if b.drag == "contaminated":
        C_D = 24.0 / Re * (1.0 + 0.15 * Re**0.687) if Re <= 1000.0 else 0.44
    else:
        C_D = 16.0 / Re * (1.0 + 1.0 / (8.0 / Re + 0.5 * (1.0 + 3.315 / math.sqrt(Re))))
    return C_D * b.rho * PI * b.R**2 * speed / 2.0


def film_at(b: Bounce, approach: float) -> float:
    """Thickness at which the surface stops, eq. 14, not below hmin."""
    return max(b.hmin, math.sqrt(3.0 / 8.0 * b.mu * max(approach, 0.0) * b.R**2 / b.sigma))


def elastic_force(b: Bounce, Delta: float) -> float:
    """Eq. 9, or the spring of eq. 1."""
    if Delta <= 0.0 or b.elastic == "none":
        return 0.0
    if b.elastic == "spring":
        return 4.0 * PI * b.sigma * Delta
    return b.sigma * b.R * (18.5 * (Delta / b.R)**2 + 2.0 * Delta / b.R)


def film_coefficient(b: Bounce, Delta: float, h0: float) -> float:
    """Viscous force over approach speed of a closed film, eq. 17, with D or, as it is derived, D squared."""
    if b.viscous == "none":
        return 0.0
    x = max(Delta, 0.0) / b.R
    D = 0.34 / math.sqrt(x + 0.0002)
    Ra = b.R * (-0.04 + math.sqrt(0.0016 + 9.44 * x)) / 4.72
    return 12.0 * b.mu / (2.0 * PI) * (D if b.viscous == "published" else D * D) * (
        4.0 * math.sqrt(b.R**3 / h0) + 3.0 * Ra * b.R / h0)


@dataclass(frozen=True)
class Mode:
    """Which forces act. h0: that of a closed film, None while it is open (or, `current`, always that of the speed)."""
    closed: bool
    h0: float | None
    near: bool     # gap < R: lubrication and the force along the wall
    thin: bool     # gap < hmin: the force along the wall no longer depends on it

    def thickness(self, b: Bounce, u: float) -> float:
        if self.h0 is not None:
            return self.h0
        return film_at(b, abs(u) if b.h0 == "current" else u)


def rates(b: Bounce, mode: Mode, y: Array) -> Array:
    """d/dt of (distance, place, rate of distance, rate of place) in this mode."""
    gap, u, ut = y[0] - b.R, -y[2], y[3]
    width = max(gap, 0.1 * b.hmin)    # trial states beyond an event, which are not kept, must have rates, too
    tilt = b.tilt * PI / 180.0
    lift = (b.rho - b.gas) * b.volume * b.g
    drag = drag_coefficient(b, float(np.hypot(y[2], y[3])))
    normal = -lift * np.cos(tilt) + drag * u
    along = lift * np.sin(tilt) - drag * ut
    if mode.closed:
        h0 = mode.thickness(b, u)
        normal += elastic_force(b, h0 - gap) + film_coefficient(b, h0 - gap, h0) * u
    elif mode.near and b.lubrication == "yes":
        normal += 6.0 * PI * b.mu * b.R**2 * u / width
    if mode.near and b.tangential == "yes":
        along += 3.2 * PI * b.mu * b.R * ut * np.log((b.hmin if mode.thin else width) / b.R)
    return np.array([y[2], y[3], normal / b.mass, along / b.mass])


@dataclass
class Trajectory:
    """A solution: pieces between events."""
    ends: list[float]                    # ends[n] to ends[n + 1] is piece n
    pieces: list[Callable[[Any], Any]]
    modes: list[Mode]
    evaluations: int

    def __call__(self, t: Sequence[float] | Array) -> Array:
        """State at these times, shape (4, times)."""
        times = np.asarray(t, dtype=float)
        at = np.clip(np.searchsorted(self.ends, times, side="right") - 1, 0, len(self.pieces) - 1)
        out = np.empty((4, len(times)))
        for n, piece in enumerate(self.pieces):
            if np.any(at == n):
                out[:, at == n] = piece(times[at == n])
        return out

    def contacts(self) -> list[tuple[float, float, float]]:
        """(closes, opens, h0 at the closing) of each; the last may end with the run."""
        found: list[tuple[float, float, float]] = []
        for n, mode in enumerate(self.modes):
            if mode.closed and n and self.modes[n - 1].closed:
                found[-1] = (found[-1][0], self.ends[n + 1], found[-1][2])
            elif mode.closed:
                found.append((self.ends[n], self.ends[n + 1], mode.h0 if mode.h0 is not None else np.nan))
        return found


def solve(b: Bounce, rtol: float = 1e-11) -> Trajectory:
    """From release at rest to b.time. Raises RuntimeError if the integrator gives up."""
    state = np.array([b.release * b.R, 0.0, 0.0, 0.0])
    gap = state[0] - b.R
    mode = Mode(False, None, gap < b.R, gap < b.hmin)
    path = Trajectory([0.0], [], [], 0)
    absolute = rtol * np.array([b.R, b.R, 0.1, 0.1])

    def film(t: float, y: Array) -> float:
        return float(y[0] - b.R - mode.thickness(b, -y[2])) / b.R

    def reach(t: float, y: Array) -> float:
        return float(y[0] - 2.0 * b.R) / b.R

    def bottom(t: float, y: Array) -> float:
        return float(y[0] - b.R - b.hmin) / b.R

    events: list[Any] = [film, reach, bottom]
    for event in events:
        event.terminal = True
    t = 0.0
    while t < b.time:
        film.direction = 1.0 if mode.closed else -1.0       # type: ignore[attr-defined]
        reach.direction = -1.0 if not mode.near else 1.0    # type: ignore[attr-defined]
        bottom.direction = -1.0 if not mode.thin else 1.0   # type: ignore[attr-defined]
        held = mode
        done = solve_ivp(lambda t, y: rates(b, held, y), (t, b.time), state, method="Radau", rtol=rtol, atol=absolute,
                         events=events, dense_output=True, max_step=b.time / 100)
        if done.status < 0 or done.sol is None or done.t_events is None:
            raise RuntimeError(f"no solution beyond {done.t[-1]:.6g} s: {done.message}")
        path.pieces.append(done.sol)
        path.modes.append(mode)
        path.ends.append(float(done.t[-1]))
        path.evaluations += done.nfev
        t, state = float(done.t[-1]), done.y[:, -1]
        happened = [len(times) > 0 for times in done.t_events]
        if happened[0]:
            kept = film_at(b, -state[2]) if not mode.closed and b.h0 == "contact" else None
            mode = Mode(not mode.closed, kept, mode.near, mode.thin)
        if happened[1]:
            mode = Mode(mode.closed, mode.h0, not mode.near, mode.thin)
        if happened[2]:
            mode = Mode(mode.closed, mode.h0, mode.near, not mode.thin)
    return path


def read_settings(path: Path) -> Bounce:
    """Of the names above those that the file has; others are not the model's."""
    known = {field.name: type(getattr(Bounce(), field.name)) for field in fields(Bounce)}
    given = json.loads(path.read_text())
    return Bounce(**{name: known[name](value) for name, value in given.items() if name in known})


def compare(directory: Path) -> dict[str, float]:
    """Largest differences of series.csv from the reference: distance and place over R, speeds over the fastest."""
    b = read_settings(directory / "settings.json")
    with (directory / "series.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    t, *columns = (np.array([float(row[name]) for row in rows]) for name in ("time", "height", "slide", "un", "ut"))
    height, slide, un, ut = columns
    y = solve(b)(t)
    fastest = float(np.hypot(y[2], y[3]).max())
    return {"height": float(np.abs(height - y[0] / b.R).max()), "slide": float(np.abs(slide - y[1] / b.R).max()),
            "un": float(np.abs(un - y[2]).max() / fastest), "ut": float(np.abs(ut - y[3]).max() / fastest)}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("directory", type=Path, nargs="+", metavar="DIR")
    for directory in parser.parse_args().directory:
        if not (directory / "settings.json").is_file() or not (directory / "series.csv").is_file():
            sys.exit(f"{directory} needs series.csv and settings.json")
        print(asdict(read_settings(directory / "settings.json")))
        print(directory, *(f"{name} {value:.2e}" for name, value in compare(directory).items()))


if __name__ == "__main__":
    main()
