#!/usr/bin/env python3
"""What the viscous sum makes of the vortex of in.vortex on a lattice of particles, over its Laplacian.

    python3 viscous.py
    python3 viscous.py --h 1.5        with another smoothing length, over the spacing

The first number is the factor for n to infinity. It does not depend on the spacing. The others are what is lost besides
with n particles along an edge.
"""
from __future__ import annotations

import argparse

import numpy as np

from lammps_foam.analysis import table


def factor(h: float, k: float) -> float:
    """Morris' sum over -2 k^2, for cos kx cos ky, with the spacing as the unit of length; k = 0: its limit."""
    reach = int(2 * h) + 1
    one = np.arange(-reach, reach + 1, dtype=float)
    x, y, z = (part.ravel() for part in np.meshgrid(one, one, one, indexing="ij"))
    r = np.sqrt(x * x + y * y + z * z)
    near = (r > 0) & (r < 2 * h)
    x, y, r = x[near], y[near], r[near]
    slope = -21 / (16 * np.pi * h**4) * 5 * r / h * (1 - r / (2 * h))**3        # of the kernel, dW/dr
    difference = (1 - np.cos(k * x) * np.cos(k * y)) / (2 * k**2) if k > 0 else (x * x + y * y) / 4
    return float(-np.sum(2 * difference * slope / r))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--h", type=float, default=1.3, help="smoothing length over the spacing (default %(default)s)")
    parser.add_argument("--sizes", type=int, nargs="+", default=[12, 16, 24, 32, 48], help="particles along an edge")
    args = parser.parse_args()
    long = factor(args.h, 0.0)
    print(f"n to infinity: {long:.4f}")
    table.show({"n": args.sizes, "loss in %": [100 * (1 - factor(args.h, 2 * np.pi / n) / long) for n in args.sizes]})
