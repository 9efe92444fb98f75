#!/usr/bin/env python3
"""The dam break of in.dambreak once more, as a potential flow: a reference for the front, apart from LAMMPS.

    python3 reference.py FILE [--nodes 80] [--end 2.2]      writes time, front, height at the wall, area

The liquid is inviscid, two-dimensional and starts from rest, so that its velocity has a potential phi. Nodes on the
free surface move with the liquid, and d phi/dt = u^2/2 - z follows them, since the pressure is 0 there. The normal
velocity is the solution of Green's integral equation on the surface and its mirror images in wall and floor, by
linear elements whose integrals are exact. Time steps of Runge and Kutta, fourth order. After each step nodes are
spread anew along the surface, closer to the front; in each fifth step places and potentials are smoothed, as Longuet-
Higgins and Cokelet did, Proc. R. Soc. Lond. A 350, 1 (1976). The upper edge of the column is rounded by 0.05.

Units as in in.dambreak: the column is 1 wide and 1 high, gravity 1.
"""
from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from lammps_foam.analysis import table

Array = NDArray[np.float64]
ROUNDED = 0.05
CLOSER = 2.0        # the distance of nodes falls by exp(-2) from the wall to the front
SMOOTHED = 5        # steps from one smoothing to the next
COURANT = 0.3
LONG = 20.0         # logarithms are of lengths over this one, so that no body has the size for which they vanish


def elements(points: Array, start: Array, end: Array) -> tuple[Array, Array, Array, Array]:
    """Integrals over straight elements of ln r, and of its normal derivative, times the weights of both ends.

    The normal is to the right of start - end.
    """
    along = end - start
    length = np.hypot(*along.T)
    t = along / length[:, None]
    r = points[:, None, :] - start
    a = np.einsum("ijk,jk->ij", r, t)
    off = r[:, :, 0] * t[:, 1] - r[:, :, 1] * t[:, 0]

    def integrals(s: Array) -> tuple[Array, Array, Array, Array]:    # of 1 and s, at distance s from the foot
        q = s * s + off * off
        log = np.log(np.where(q > 0, q, 1.0))
        angle = np.where(np.abs(off) > 1e-14, np.arctan(s / np.where(off == 0, 1.0, off)), 0.0)
        return 0.5 * s * log - s + off * angle, 0.25 * (q * log - s * s), -angle, -0.5 * off * log

    single, single_s, double, double_s = (b - a for a, b in zip(integrals(-a), integrals(length - a)))
    single = single - np.log(LONG) * length
    single_s = single_s - np.log(LONG) * 0.5 * ((length - a)**2 - a**2)
    second, second_normal = (single_s + a * single) / length, (double_s + a * double) / length
    return single - second, second, double - second_normal, second_normal


def normal_velocity(x: Array, phi: Array) -> Array:
    """Outwards, at nodes from the wall to the front."""
    n = len(x)
    single, double = np.zeros((n, n)), np.zeros((n, n))
    for mirror in ((1, 1), (-1, 1), (1, -1), (-1, -1)):
        image = x * np.array(mirror)
        first, last = slice(0, n - 1), slice(1, n)
        if mirror[0] * mirror[1] > 0:       # the liquid is to the left of start - end
            first, last = last, first
        one, two, one_normal, two_normal = elements(x, image[first], image[last])
        single[:, first] += one
        single[:, last] += two
        double[:, first] += one_normal
        double[:, last] += two_normal
    return np.linalg.solve(single, double @ phi - double.sum(axis=1) * phi)


def arc(x: Array) -> Array:
    return np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(x, axis=0).T))])


def rates(x: Array, phi: Array) -> tuple[Array, Array]:
    """Velocities of the nodes, and d phi/dt."""
    s = arc(x)
    t = CubicSpline(s, x)(s, 1)
    t[0] = 1.0, 0.0
    t /= np.hypot(*t.T)[:, None]
    slope = CubicSpline(s, phi)(s, 1)
    slope[0] = 0.0
    u = slope[:, None] * t + normal_velocity(x, phi)[:, None] * np.column_stack([-t[:, 1], t[:, 0]])
    u[0, 0] = u[-1, 1] = 0.0
    return u, 0.5 * np.sum(u**2, axis=1) - x[:, 1]


def spread(x: Array, phi: Array, nodes: int) -> tuple[Array, Array]:
    s = arc(x)
    where = s[-1] * (1 - np.exp(-CLOSER * np.linspace(0, 1, nodes))) / (1 - np.exp(-CLOSER))
    state = CubicSpline(s, np.column_stack([x, phi]))(where)
    x, phi = state[:, :2], state[:, 2]
    x[0, 0] = x[-1, 1] = 0.0
    return x, phi


def smooth(values: Array, at_wall: int, at_front: int) -> Array:
    """By five points; beyond the ends the values go on, or are reversed, as a mirror image is."""
    more = np.concatenate([at_wall * values[2:0:-1], values, at_front * values[-2:-4:-1]])
    return (-more[:-4] + 4 * more[1:-3] + 10 * more[2:-2] + 4 * more[3:-1] - more[4:]) / 16


def column(nodes: int) -> Array:
    turn = np.linspace(np.pi / 2, 0, 100)[1:-1]
    corner = 1 - ROUNDED + ROUNDED * np.column_stack([np.cos(turn), np.sin(turn)])
    straight = np.linspace(0, 1 - ROUNDED, 400)
    outline = np.concatenate([np.column_stack([straight, np.ones(400)]), corner,
                              np.column_stack([np.ones(400), straight[::-1]])])
    s = arc(outline)
    where = s[-1] * (1 - np.exp(-CLOSER * np.linspace(0, 1, nodes))) / (1 - np.exp(-CLOSER))
    return np.column_stack([np.interp(where, s, outline[:, k]) for k in range(2)])


def collapse(nodes: int, end: float) -> dict[str, list[float]]:
    x, phi, t = column(nodes), np.zeros(nodes), 0.0
    rows = []
    for step in range(1_000_000):
        area = float(np.sum(0.5 * (x[1:, 1] + x[:-1, 1]) * np.diff(x[:, 0])))
        rows.append({"time": t, "front": float(x[-1, 0]), "height": float(x[0, 1]), "area": area})
        if t >= end:
            break
        u, p = rates(x, phi)
        near = float(np.hypot(*np.diff(x, axis=0).T).min())
        dt = min(0.01, COURANT * near / max(float(np.abs(u).max()), 0.3))
        u2, p2 = rates(x + 0.5 * dt * u, phi + 0.5 * dt * p)
        u3, p3 = rates(x + 0.5 * dt * u2, phi + 0.5 * dt * p2)
        u4, p4 = rates(x + dt * u3, phi + dt * p3)
        x = x + dt / 6 * (u + 2 * u2 + 2 * u3 + u4)
        phi = phi + dt / 6 * (p + 2 * p2 + 2 * p3 + p4)
        t += dt
        x, phi = spread(x, phi, nodes)
        if step % SMOOTHED == 0:
            x = np.column_stack([smooth(x[:, 0], -1, 1), smooth(x[:, 1], 1, -1)])
            phi = smooth(phi, 1, 1)
            x[0, 0] = x[-1, 1] = 0.0
    return {name: [row[name] for row in rows] for name in rows[0]}


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("file", type=Path)
    parser.add_argument("--nodes", type=int, default=80, help="along the surface (default %(default)s)")
    parser.add_argument("--end", type=float, default=2.2, help="time (default %(default)s)")
    args = parser.parse_args()
    table.write(collapse(args.nodes, args.end), args.file)
