#!/usr/bin/env python3
"""A bounce head on at a horizontal wall with the drainage of the film resolved, beside the model that is not.

    python3 drainage.py [--out DIR] [--R 0.6e-3] [--rim 1.2] [--points 240]     a minute; writes drainage.png, .csv

The film between the wall and the bubble is axisymmetric: its thickness h(r, t) obeys the Reynolds equation, its
pressure the linearised Young-Laplace equation, and the bubble the same equation of motion as in.bounce, after Manica,
Klaseboer & Chan, Langmuir 31, 6763 (2015):

    dh/dt = (1 / m mu r) d/dr (r h^3 dp/dr),   p = 2 sigma / R - (sigma / r) d/dr (r dh/dr),   F = 2 pi int p r dr

m = 12 where liquid sticks to the bubble (contaminated), 3 where it slips along it. At the rim of the film, r = rim R,
the pressure is 0 and the surface moves with the bubble. The deformation for a force goes with the logarithm of the rim:
run 0.9 and 1.2 to see how much. Drag is the contaminated one with either m: the film alone makes the difference.
"""
from __future__ import annotations

import argparse
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.sparse import lil_matrix

from lammps_foam.analysis import figure, table

import reference
from reference import Bounce, PI

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Film:
    """Rings of equal width round the axis: their middles r, the circles between them, and their areas over 2 pi."""
    b: Bounce
    m: float
    rim: float        # over R
    points: int

    @property
    def r(self) -> Array:
        return np.linspace(0.0, self.rim * self.b.R, self.points)

    @property
    def between(self) -> Array:
        return 0.5 * (self.r[1:] + self.r[:-1])

    @property
    def areas(self) -> Array:
        edges = np.concatenate([[0.0], self.between, self.r[-1:]])
        return 0.5 * np.diff(edges**2)

    def divergence(self, flux: Array) -> Array:
        """Of r times a flow at the circles between; none through the axis, the rim is left to its condition."""
        return np.diff(np.concatenate([[0.0], flux, [0.0]])) / self.areas

    def pressure(self, h: Array) -> Array:
        step = self.r[1]
        p = 2.0 * self.b.sigma / self.b.R - self.b.sigma * self.divergence(self.between * np.diff(h) / step)
        p[-1] = 0.0
        return p

    def force(self, p: Array) -> float:
        return float(2.0 * PI * np.sum(p * self.areas))

    def rates(self, t: float, y: Array) -> Array:
        """d/dt of h, of the distance of the centre and of its rate."""
        b, h, w = self.b, y[:-2], float(y[-1])
        p = self.pressure(h)
        flux = self.between * (0.5 * (h[1:] + h[:-1]))**3 * np.diff(p) / (self.m * b.mu * self.r[1])
        dh = self.divergence(flux)
        dh[-1] = w
        lift = (b.rho - b.gas) * b.volume * b.g
        push = self.force(p) - lift - reference.drag_coefficient(b, abs(w)) * w
        return np.concatenate([dh, [w, push / b.mass]])

    def solve(self, times: Array, rtol: float = 1e-6) -> tuple[Array, Array]:
        """Distance of the centre and least thickness at these times, from release at rest. RuntimeError if it fails."""
        b, n = self.b, self.points
        start = np.concatenate([(b.release - 1.0) * b.R + self.r**2 / (2.0 * b.R), [b.release * b.R, 0.0]])
        pattern = lil_matrix((n + 2, n + 2))
        for shift in range(-3, 4):
            pattern.setdiag(1.0, shift)
        pattern[n - 1:, :] = 0.0
        pattern[n - 1:n + 1, n + 1] = 1.0
        pattern[n + 1, :] = 1.0
        scale = np.concatenate([np.full(n + 1, 0.1 * rtol * b.R), [0.1 * rtol]])
        done = solve_ivp(self.rates, (0.0, float(times[-1])), start, method="BDF", t_eval=times, rtol=rtol,
                         atol=scale, jac_sparsity=pattern.tocsr())
        if done.status < 0:
            raise RuntimeError(f"no solution beyond {done.t[-1]:.6g} s: {done.message}")
        return done.y[-2], done.y[:-2].min(axis=0)


def first_turns(times: Array, height: Array) -> dict[str, float]:
    """Times (ms) and heights of the deepest place and of the top of the first rebound, and the height at the end."""
    low = int(np.flatnonzero(np.diff(height) > 0)[0])
    falls = np.flatnonzero(np.diff(height[low:]) < 0)
    top = low + int(falls[0]) if len(falls) else len(height) - 1
    return {"deepest_ms": 1e3 * float(times[low]), "deepest": float(height[low]), "top_ms": 1e3 * float(times[top]),
            "top": float(height[top]), "end": float(height[-1]), "rebound": float(height[top] - height[-1])}


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--out", type=Path, default=Path(), metavar="DIR", help="where everything is written")
    parser.add_argument("--R", type=float, default=0.6e-3, help="radius in m (default %(default)s)")
    parser.add_argument("--rim", type=float, default=1.2, help="of the film, over R (default %(default)s)")
    parser.add_argument("--points", type=int, default=240, help="along the radius of the film (default %(default)s)")
    args = parser.parse_args()

    b = Bounce(R=args.R, tilt=0.0, time=0.1)
    times = np.linspace(0.0, b.time, 5001)
    heights = {}
    for label, m in (("drainage, no slip", 12.0), ("drainage, slip", 3.0)):
        distance, least = Film(b, m, args.rim, args.points).solve(times)
        heights[label] = distance / b.R
        print(f"{label}: the film is {1e6 * least.min():.3g} micrometres at its thinnest")
    for label, viscous in (("published", "published"), ("derived", "derived"), ("no film force", "none")):
        heights[label] = reference.solve(replace(b, viscous=viscous), rtol=1e-9)(times)[0] / b.R
    rows = [{"of": label, **first_turns(times, height)} for label, height in heights.items()]
    columns = {name: [row[name] for row in rows] for name in rows[0]}
    table.show(columns)
    table.write(columns, args.out / "drainage.csv")

    fig, (ax,) = figure.panels()
    for n, (label, height) in enumerate(heights.items()):
        ax.plot(1e3 * times, height, ("-", "-", "--", "-.", ":")[n], color=("C6", "0.6", "C0", "C1", "C2")[n],
                label=label)
    closes = 1e3 * float(times[int(np.argmax(heights["published"] < 1.1))])
    ax.set(xlabel="time (ms)", ylabel="distance of the centre / R", xlim=(closes - 3, closes + 30), ylim=(0.55, 1.3))
    ax.legend()
    figure.save(fig, args.out / "drainage")


if __name__ == "__main__":
    main()
