#!/usr/bin/env python3
"""Spectrum of the kinetic energy of particles in a periodic cube.

    python3 spectrum.py FILE.lammpstrj [--time T]      writes FILE.spectrum.csv; without a time, of the last frame

Velocities are brought to a lattice of as many nodes as there are particles. At each node a polynomial of the second
degree goes through the particles around, by least squares with the weights of a kernel: unlike a mean, it leaves waves
as they are up to the fourth power of their number. --test tells how much of a wave is left.
E(k) is the energy of the shell around k, k in units of 2 pi over the edge. Their sum is the energy of a unit of volume.
"""
from __future__ import annotations

import argparse
from pathlib import Path
import sys

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from lammps_foam.analysis import table
from lammps_foam.analysis.read import Frame, Unusable, read_frames

Array = NDArray[np.float64]
REACH = 2.3            # of a node, over the spacing: 51 particles
AT_ONCE = 4096         # nodes


def nodes(n: int) -> Array:
    one = (np.arange(n) + 0.5) / n
    return np.stack(np.meshgrid(one, one, one, indexing="ij"), axis=-1).reshape(-1, 3)


def interpolated(places: Array, values: Array, where: Array, spacing: float) -> Array:
    """Values of particles in a periodic cube of edge 1, elsewhere."""
    tree, reach = cKDTree(places % 1.0, boxsize=1.0), REACH * spacing
    found = np.empty((len(where), values.shape[1]))
    for first in range(0, len(where), AT_ONCE):
        some = where[first:first + AT_ONCE]
        near = tree.query_ball_point(some, reach)
        sizes = np.array([len(row) for row in near])
        index = np.zeros((len(some), sizes.max()), dtype=int)
        there = np.arange(sizes.max()) < sizes[:, None]
        index[there] = np.concatenate([np.asarray(row, dtype=int) for row in near])
        d = places[index] - some[:, None, :]
        d = (d - np.round(d)) / reach
        x, y, z = d[..., 0], d[..., 1], d[..., 2]
        q = np.minimum(np.sqrt(x * x + y * y + z * z), 1.0)
        weight = (1 - q)**4 * (1 + 4 * q) * there
        basis = np.stack([np.ones_like(x), x, y, z, x * x, y * y, z * z, x * y, y * z, z * x], axis=-1)
        weighted = basis * weight[..., None]
        matrix = np.einsum("nja,njb->nab", weighted, basis)
        right = np.einsum("nja,njv->nav", weighted, values[index])
        found[first:first + AT_ONCE] = np.linalg.solve(matrix, right)[:, 0, :]
    return found


def on_lattice(places: Array, values: Array, n: int) -> Array:
    return interpolated(places, values, nodes(n), 1 / n).reshape(n, n, n, -1)


def shells(field: Array) -> tuple[Array, Array]:
    """Wave numbers, and energies of the shells around them."""
    n = field.shape[0]
    waves = np.fft.fftn(field, axes=(0, 1, 2)) / n**3
    energy = 0.5 * np.sum(np.abs(waves)**2, axis=-1)
    one = np.fft.fftfreq(n, 1 / n)
    k = np.sqrt(one[:, None, None]**2 + one[None, :, None]**2 + one[None, None, :]**2)
    shell = np.rint(k).astype(int).ravel()
    return np.arange(1, n // 2 + 1, dtype=float), np.bincount(shell, energy.ravel())[1:n // 2 + 1]


def spectrum(frame: Frame) -> tuple[Array, Array]:
    n = round(len(frame)**(1 / 3))
    if n**3 != len(frame):
        raise Unusable(f"{len(frame)} particles are not those of a cube")
    return shells(on_lattice(*arrays(frame), n))


def arrays(frame: Frame) -> tuple[Array, Array]:
    return np.column_stack([frame[key] for key in "xyz"]), np.column_stack([frame["v" + key] for key in "xyz"])


def what_is_left(n: int = 24, jiggle: float = 0.2) -> dict[str, list[float]]:
    """Energy that waves along x have on the lattice, over that which they have at particles that are in disorder."""
    places = (nodes(n) + np.random.default_rng(1).uniform(-jiggle, jiggle, (n**3, 3)) / n) % 1.0
    rows: dict[str, list[float]] = {"k": [], "of_nyquist": [], "left": []}
    for k in range(1, n // 2 + 1):
        field = on_lattice(places, np.column_stack([np.cos(2 * np.pi * k * places[:, 0]),
                                                    np.sin(2 * np.pi * k * places[:, 0])]), n)
        rows["k"].append(k)
        rows["of_nyquist"].append(2 * k / n)
        rows["left"].append(2 * float(shells(field)[1][k - 1]))
    return rows


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("file", type=Path, nargs="?")
    parser.add_argument("--time", type=float, help="of the frame (default: the last)")
    parser.add_argument("--test", action="store_true", help="how much of a wave is left on the lattice")
    args = parser.parse_args()
    try:
        if args.test:
            table.show(what_is_left())
        elif args.file is None:
            parser.error("a file of frames is needed")
        else:
            frames = list(read_frames(args.file))
            frame = frames[-1] if args.time is None else min(frames, key=lambda f: abs((f.time or 0.0) - args.time))
            k, energy = spectrum(frame)
            columns = {"k": k, "energy": energy}
            table.show(columns)
            table.write(columns, args.file.with_suffix(".spectrum.csv"))
    except Unusable as wrong:
        sys.exit(str(wrong))
