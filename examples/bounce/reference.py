#!/usr/bin/env python3
"""The bounce of in.bounce once more, as an ordinary differential equation for scipy: a reference for tests.

    python3 reference.py DIR ...   compares DIR/series.csv of in.bounce, its -var settings in DIR/settings.json

Written from the equations of Heitkam et al., J. Phys.: Condens. Matter 29, 124005 (2017), and not from the styles: it
shares no code with them. Radau's method with tight tolerances; the film closes and opens, and forces begin and end, at
events, so that every piece that is integrated is smooth.

With `h0 current` a film that closes may slow the bubble so much that h0 falls below the gap at once. The film opens,
the bubble gains speed, the film closes, and so on: in the limit of short steps on the line gap = h0(speed). The bubble
then creeps: its speed is that of the line, as Filippov defines solutions of equations with a jump, until the forces of
the open or of the closed film lead away from the line.

State: distance of the centre from the wall, place along it, and their rates; SI units.
"""
from __future__ import annotations

import argparse
import csv
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, fields, replace
from enum import Enum
from functools import lru_cache
import json
import math
from pathlib import Path
import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import quad, solve_ivp
from scipy.interpolate import CubicSpline

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
    h0: str = "contact"            # contact | current | VALUE
    hmin: float = 1.0e-5
    integral: str = "fit"          # fit | exact, the latter not with h0 current
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
    """Thickness at which the surface stops: eq. 14, not below hmin; or a number."""
    if b.h0 not in ("contact", "current"):
        return float(b.h0)
    speed = abs(approach) if b.h0 == "current" else max(approach, 0.0)
    return max(b.hmin, math.sqrt(3.0 / 8.0 * b.mu * speed * b.R**2 / b.sigma))


def elastic_force(b: Bounce, Delta: float) -> float:
    """Eq. 9, or the spring of eq. 1."""
    if Delta <= 0.0 or b.elastic == "none":
        return 0.0
    if b.elastic == "spring":
        return 4.0 * PI * b.sigma * Delta
    return b.sigma * b.R * (18.5 * (Delta / b.R)**2 + 2.0 * Delta / b.R)


def rim(h: float, a: float) -> float:
    """The integral (B.12), in units of R, with y = sin(t); see "The integral of the film" in doc/collision.rst."""
    def integrand(t: float) -> float:
        low = 2.0 * math.sin(0.5 * t)**2
        q = PI * (t - 0.5 * math.sin(2.0 * t) + 2.0 * a * low)
        return float(q * q / ((a + math.sin(t)) * (h + low)**3) * math.cos(t))
    ends = [0.0, *np.geomspace(0.1 * math.sqrt(h), 0.5 * PI, 8)]    # it varies at t = sqrt(h)
    return math.fsum(quad(integrand, *pair, epsrel=1e-11)[0] for pair in zip(ends, ends[1:]))


@lru_cache(maxsize=64)
def rims(h: float) -> CubicSpline:
    """ln of the integral of a film of this thickness over asinh of its radius over sqrt(h)."""
    at = np.linspace(0.0, math.asinh(1.0 / math.sqrt(h)), 200)
    return CubicSpline(at, [math.log(rim(h, math.sinh(s) * math.sqrt(h))) for s in at])


def film_integral(b: Bounce, h: float, a: float) -> float:
    """By the fit of eq. 17, or by quadrature."""
    if b.integral == "fit":
        return 4.0 / math.sqrt(h) + 3.0 * a / h
    return math.exp(float(rims(h)(math.asinh(a / math.sqrt(h)))))


def film_coefficient(b: Bounce, Delta: float, h0: float) -> float:
    """Viscous force over approach speed of a closed film, eq. 17, with D or, as it is derived, D squared."""
    if b.viscous == "none":
        return 0.0
    x = max(Delta, 0.0) / b.R
    D = 0.34 / math.sqrt(x + 0.0002)
    a = (-0.04 + math.sqrt(0.0016 + 9.44 * x)) / 4.72
    power = D if b.viscous == "published" else D * D
    return 12.0 * b.mu / (2.0 * PI) * power * b.R * film_integral(b, h0 / b.R, a)


class Film(Enum):
    OPEN = 0
    CLOSED = 1
    CREEPS = 2    # between both, gap = h0(speed)


@dataclass(frozen=True)
class Mode:
    """Which forces act. h0: that of a closed film, None where it is that of the speed."""
    film: Film
    h0: float | None
    near: bool     # gap < R: lubrication and the force along the wall
    thin: bool     # gap < hmin: the force along the wall no longer depends on it

    @property
    def closed(self) -> bool:
        return self.film is not Film.OPEN

    def thickness(self, b: Bounce, u: float) -> float:
        return self.h0 if self.h0 is not None else film_at(b, u)


def rates(b: Bounce, mode: Mode, y: Array) -> Array:
    """d/dt of (distance, place, rate of distance, rate of place) in this mode."""
    gap, u, ut = y[0] - b.R, -y[2], y[3]
    width = max(gap, 0.1 * b.hmin)    # trial states beyond an event, which are not kept, must have rates, too
    tilt = b.tilt * PI / 180.0
    lift = (b.rho - b.gas) * b.volume * b.g
    drag = drag_coefficient(b, float(np.hypot(y[2], y[3])))
    normal = -lift * np.cos(tilt) + drag * u
    along = lift * np.sin(tilt) - drag * ut
    if mode.film is Film.CLOSED:
        h0 = mode.thickness(b, u)
        normal += elastic_force(b, h0 - gap) + film_coefficient(b, h0 - gap, h0) * u
    elif mode.near and b.lubrication == "yes":
        normal += 6.0 * PI * b.mu * b.R**2 * u / width
    if mode.near and b.tangential == "yes":
        along += 3.2 * PI * b.mu * b.R * ut * np.log((b.hmin if mode.thin else width) / b.R)
    if mode.film is Film.CREEPS:    # |u| goes with the square of the gap
        return np.array([y[2], y[3], 2.0 * y[2]**2 / width, along / b.mass])
    return np.array([y[2], y[3], normal / b.mass, along / b.mass])


def opening(b: Bounce, mode: Mode, y: Array, film: Film) -> float:
    """How fast gap - h0 grows with the forces of an open, or of a closed, film, in R per second."""
    u = -float(y[2])
    h0 = mode.thickness(b, u)
    follows = b.h0 == "current" and h0 > b.hmin    # the bound does not depend on the speed
    slope = 0.5 * h0 / u if follows else 0.0       # h0 goes with the root of |u|
    return float(y[2] + slope * rates(b, replace(mode, film=film), y)[2]) / b.R


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


SAME = 1e-11    # over R: events that are nearer to each other are one; roots are found to 1e-14


def after(b: Bounce, mode: Mode, y: Array, happened: list[bool]) -> Mode:
    """The mode that follows the events of a film, of the reach and of hmin; or those of a film that creeps."""
    film, h0 = mode.film, mode.h0
    if mode.film is Film.CREEPS:
        if happened[0] or happened[2]:
            film = Film.CLOSED
        elif happened[3]:
            film = Film.OPEN
    elif happened[0]:
        film = Film.OPEN if mode.closed else Film.CLOSED
        h0 = film_at(b, -float(y[2])) if film is Film.CLOSED and b.h0 == "contact" else None
        if b.h0 == "current" and opening(b, mode, y, film) * (1.0 if film is Film.CLOSED else -1.0) > 0.0:
            film = Film.CREEPS    # its forces lead back
    return Mode(film, h0, mode.near != happened[1], mode.thin != happened[2])


def solve(b: Bounce, rtol: float = 1e-11) -> Trajectory:
    """From release at rest to b.time. Raises RuntimeError if the integrator gives up."""
    if b.integral == "exact" and b.h0 == "current":
        raise ValueError("reference: integral exact needs h0 contact or a number: its table is for one thickness")
    state = np.array([b.release * b.R, 0.0, 0.0, 0.0])
    gap = float(state[0]) - b.R
    mode = Mode(Film.OPEN, None, gap < b.R, gap < b.hmin)
    path = Trajectory([0.0], [], [], 0)
    absolute = rtol * np.array([b.R, b.R, 0.1, 0.1])
    t = 0.0
    while t < b.time:
        held = mode

        def film(t: float, y: Array, held: Mode = held) -> float:
            return float(y[0] - b.R - held.thickness(b, -y[2])) / b.R

        def reach(t: float, y: Array) -> float:
            return float(y[0] - 2.0 * b.R) / b.R

        def bottom(t: float, y: Array) -> float:
            return float(y[0] - b.R - b.hmin) / b.R

        def closes(t: float, y: Array, held: Mode = held) -> float:
            return opening(b, held, y, Film.CLOSED)

        def opens(t: float, y: Array, held: Mode = held) -> float:
            return opening(b, held, y, Film.OPEN)

        creeps = held.film is Film.CREEPS
        events: list[Any] = [closes if creeps else film, reach, bottom, *([opens] if creeps else [])]
        directions = [1.0 if held.film is Film.CLOSED else -1.0, 1.0 if held.near else -1.0,
                      1.0 if held.thin else -1.0, 1.0]
        for event, direction in zip(events, directions):
            event.terminal, event.direction = True, direction
        done = solve_ivp(lambda t, y: rates(b, held, y), (t, b.time), state, method="Radau", rtol=rtol, atol=absolute,
                         events=events, dense_output=True, max_step=b.time / 100)
        if done.status < 0 or done.sol is None or done.t_events is None:
            raise RuntimeError(f"no solution beyond {done.t[-1]:.6g} s: {done.message}")
        path.pieces.append(done.sol)
        path.modes.append(mode)
        path.ends.append(float(done.t[-1]))
        path.evaluations += done.nfev
        t, state = float(done.t[-1]), done.y[:, -1]
        # scipy ends with the first event and forgets others at the same time: a film that closes at hmin is two
        happened = [len(times) > 0 or n < 3 and not (creeps and n == 0) and event(t, state) * direction > -SAME
                    for n, (times, event, direction) in enumerate(zip(done.t_events, events, directions))]
        mode = after(b, mode, state, [*happened, False][:4])
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
