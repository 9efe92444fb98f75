"""Local gas fraction on a grid, its spread in time, and whether the liquid separates from the gas.

The local gas fraction of a cell of the grid is the area (volume) of the bubbles in it over its own. Overlaps count
twice, as in the gas fraction phi of the model, so the mean over all cells is phi. In 2D the areas are exact. In 3D each
bubble is cut into slices (Gauss-Legendre, 12 in each layer of cells): the sum over cells is exact, the part of a bubble
in one cell to about 1e-3 of the bubble.

spread      standard deviation of the local gas fraction over the cells
random      the same for these bubbles at independent random places (mean and scatter of --random trials): an ideal gas
clustering  the spread over what it would be if small cells, at least 4 <R> wide, were dealt at random to the cells of
            the grid. A uniform packing has less than 1, since a bubble more here is a bubble less beside it; random
            places give 1. Above 1, dense is beside dense: the foam separates at the scale of the grid

The spread grows while a foam coarsens, since fewer bubbles are in a cell; that alone is no separation. Compare with
random, which grows likewise, look whether clustering passes 1 and goes on growing, and compare with a run at a higher
gas fraction at the same number of bubbles. A fresh start may have more than 1, too: places where the bubbles happened
to be dense, which the springs have not yet evened out. With K small cells in each of m cells, dealing gives a variance
of S^2 / K, where S^2 is that of the small cells (sampling without replacement). Errors are standard errors over the m
cells, as if they were independent.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import figure, table
from .frames import STATES, add_every, phi_of, selected, time_axis
from .pairs import checked, images, into_brick
from .read import Array, Box, Unusable
from .runs import Range, add_range, add_runs

SLICES = 12             # of a sphere, in each layer of cells
CHUNK = 20_000          # bubbles at once: bounds the memory
SMALL = 4.0             # least width of small cells, in <R>


# ---------------------------------------------------------------- areas and volumes in cells

def area_below(x: Array, y: Array) -> Array:
    """Area of the part X <= x, Y <= y of the unit disc around the origin.

    Derived: with the corner (x, y) in the disc the area is x y + (x s(x) + y s(y) + asin x + asin y) / 2 + pi / 4,
    where s(x) = sqrt(1 - x^2); its derivative by x is y + s(x), the length of the cut. Outside, segments do not meet.
    """
    x, y = np.clip(x, -1.0, 1.0), np.clip(y, -1.0, 1.0)
    half_x = np.pi / 2 + x * np.sqrt(1 - x**2) + np.arcsin(x)    # area of X <= x
    half_y = np.pi / 2 + y * np.sqrt(1 - y**2) + np.arcsin(y)
    inside = x * y + (half_x + half_y) / 2 - np.pi / 4
    beside = np.where(x > 0, np.where(y > 0, half_x + half_y - np.pi, half_y), np.where(y > 0, half_x, 0.0))
    return np.where(x**2 + y**2 <= 1, inside, beside)


def gas_on_grid(x: Array, radius: Array, box: Box, counts: tuple[int, ...]) -> Array:
    """Area (volume) of bubbles in the cells of a grid, an array of the shape `counts` (d numbers).

    x (n, 3), radius (n,). The grid is that of the brick lo to lo + (lx, ly, lz), which repeats as a tilted box does
    (`pairs.into_brick`). What sticks out through a wall is not counted.
    """
    d = box.dimension
    index, places, _ = images(into_brick(x, box), box, radius)
    radius = radius[index]
    width = box.lengths[:d] / np.array(counts)
    low = np.floor((places[:, :d] - radius[:, None] - box.lo[:d]) / width).astype(np.intp)
    high = np.floor((places[:, :d] + radius[:, None] - box.lo[:d]) / width).astype(np.intp)
    touches = np.all((high >= 0) & (low < np.array(counts)), axis=1) & (radius > 0)
    low = np.clip(low, 0, np.array(counts) - 1)
    span = np.clip(high, 0, np.array(counts) - 1) - low
    total = np.zeros(int(np.prod(counts)))
    cut = _area_in_cells if d == 2 else _volume_in_cells
    for which, across in _alike(span, touches):
        corner = box.lo[:d] + low[which] * width - places[which, :d]
        parts = cut(corner, radius[which], width, across)
        cells = [low[which, axis].reshape(-1, *(1,) * d) + _along(axis, across[axis] + 1, d) for axis in range(d)]
        flat = np.ravel_multi_index(tuple(np.broadcast_arrays(*cells)), counts)
        total += np.bincount(flat.ravel(), parts.ravel(), len(total))
    return total.reshape(counts)


def _alike(span: NDArray[np.intp], touches: NDArray[np.bool_]) -> Iterator[tuple[NDArray[np.intp], tuple[int, ...]]]:
    """Numbers of bubbles that reach over equally many cells, and over how many beyond the first, in chunks."""
    kinds, kind = np.unique(span, axis=0, return_inverse=True)
    for number, across in enumerate(kinds):
        which = np.flatnonzero((kind.ravel() == number) & touches)
        for start in range(0, len(which), CHUNK):
            yield which[start:start + CHUNK], tuple(int(cells) for cells in across)


def _along(axis: int, count: int, d: int) -> NDArray[np.intp]:
    """0 to count - 1 along an axis of the cells, of shape (1, ..., count, ..., 1) with one axis before for bubbles."""
    return np.arange(count).reshape(*(count if a == axis + 1 else 1 for a in range(d + 1)))


def _area_in_cells(corner: Array, radius: Array, width: Array, across: tuple[int, ...]) -> Array:
    """(n, cells in x, cells in y): areas of discs; corner (n, 2) is that of the first cell from the centre."""
    x = (corner[:, :1] + width[0] * np.arange(across[0] + 2)) / radius[:, None]
    y = (corner[:, 1:2] + width[1] * np.arange(across[1] + 2)) / radius[:, None]
    below = area_below(x[:, :, None], y[:, None, :])
    return radius[:, None, None]**2 * np.diff(np.diff(below, axis=1), axis=2)


def _volume_in_cells(corner: Array, radius: Array, width: Array, across: tuple[int, ...]) -> Array:
    """(n, cells in x, in y, in z): volumes of spheres by slices; Gauss-Legendre is exact for a sphere as a whole."""
    nodes, weights = np.polynomial.legendre.leggauss(SLICES)
    layers = []
    for layer in range(across[2] + 1):
        low = np.clip(corner[:, 2] + layer * width[2], -radius, radius)
        high = np.clip(corner[:, 2] + (layer + 1) * width[2], -radius, radius)
        volume = np.zeros((len(radius), across[0] + 1, across[1] + 1))
        for node, weight in zip(nodes, weights):
            height = (low + high) / 2 + node * (high - low) / 2
            slice_radius = np.sqrt(np.maximum(radius**2 - height**2, 1.0e-30 * radius**2))
            area = _area_in_cells(corner[:, :2], slice_radius, width[:2], across[:2])
            volume += weight * ((high - low) / 2)[:, None, None] * area
        layers.append(volume)
    return np.stack(layers, axis=3)


def local_fraction(x: Array, radius: Array, box: Box, counts: tuple[int, ...]) -> Array:
    """Gas fraction of each cell of the grid, of the shape `counts`."""
    return gas_on_grid(x, radius, box, counts) / (box.volume / np.prod(counts))


# ---------------------------------------------------------------- spread and what to hold against it

def spread(local: Array) -> tuple[float, float]:
    """Standard deviation over cells, and its standard error by the fourth moment (independent cells); nan for one."""
    m = local.size
    if m < 2:
        return float("nan"), float("nan")
    deviation = local.ravel() - local.mean()
    variance = float(np.sum(deviation**2) / (m - 1))
    of_variance = np.sqrt(max(float(np.mean(deviation**4)) - variance**2, 0.0) / m)
    return float(np.sqrt(variance)), float(of_variance / (2 * np.sqrt(variance))) if variance > 0 else 0.0


def random_spread(radius: Array, box: Box, counts: tuple[int, ...], trials: int, seed: int = 1) -> tuple[float, float]:
    """Mean and standard deviation over trials of the spread of the same bubbles at random places."""
    rng, found = np.random.default_rng(seed), []
    for _ in range(trials):
        x = box.lo + rng.random((len(radius), 3)) * box.lengths
        found.append(spread(local_fraction(x, radius, box, counts))[0])
    return (float(np.mean(found)) if found else float("nan"),
            float(np.std(found, ddof=1)) if trials > 1 else float("nan"))


def coarser(fine: Array, split: int) -> Array:
    """Means over blocks of split^d cells of a grid."""
    for axis in range(fine.ndim):
        shape = (*fine.shape[:axis], fine.shape[axis] // split, split, *fine.shape[axis + 1:])
        fine = fine.reshape(shape).mean(axis=axis + 1)
    return fine


def clustering(fine: Array, split: int) -> tuple[float, float]:
    """Spread of blocks of split^d cells over that of random blocks, and its error; nan if a block is one cell."""
    if split < 2 or fine.size < 2 * split**fine.ndim:
        return float("nan"), float("nan")
    dealt = spread(fine)[0] / np.sqrt(split**fine.ndim)
    value, error = spread(coarser(fine, split))
    return (value / dealt, error / dealt) if dealt > 0 else (float("nan"), float("nan"))


def splits(radius: Array, box: Box, counts: tuple[int, ...]) -> int:
    """Into how many small cells an edge of a cell is cut, so that they are at least SMALL <R> wide; at least 1."""
    width = float(np.min(box.lengths[:box.dimension] / np.array(counts)))
    return max(1, int(width / (SMALL * radius.mean())))


# ---------------------------------------------------------------- command line

def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_runs(parser, STATES, "fraction")
    add_range(parser, "frames to look at", "all")
    add_every(parser)
    parser.add_argument("--cells", nargs="+", type=int, default=[10], metavar="M",
                        help="cells along the edges of the box; one number is for all edges (default: 10)")
    parser.add_argument("--random", type=int, default=5, metavar="TRIALS",
                        help="trials with bubbles at random places, 0 for none (default: 5)")
    parser.add_argument("--seed", type=int, default=1, help="of the random places (default: 1)")
    parser.epilog = ("also writes BASE-cells.csv (all cells of all frames), and BASE-map.pdf and .png: of the first\n"
                     "run the first, middle and last frame (in 3D the middle layer of cells)\n"
                     "example: the grid of the thesis, tau from 60 on\n"
                     "  lammps-foam fraction DIR --cells 10 --tau 60 1000 --out fraction")


def main(args: argparse.Namespace) -> int:
    if args.random < 0:
        raise Unusable(f"--random {args.random} must be 0 or more")
    rows: list[list[float]] = []
    maps: list[tuple[int, int, float, Array, Box]] = []
    for run, frame, tau in selected(args.runs, Range(args.tau, args.N), args.every):
        x, radius = checked(frame)
        counts = cell_counts(args.cells, frame.box.dimension)
        split = splits(radius, frame.box, counts)
        fine = local_fraction(x, radius, frame.box, tuple(count * split for count in counts))
        local = coarser(fine, split)
        rows.append([run + 1, frame.step, tau, len(frame), phi_of(frame), len(frame) / local.size, *spread(local),
                     *random_spread(radius, frame.box, counts, args.random, args.seed), *clustering(fine, split)])
        maps.append((run + 1, frame.step, tau, local, frame.box))
    names = ["run", "step", "tau", "N", "phi", "per_cell", "spread", "spread_error", "random", "random_scatter",
             "clustering", "clustering_error"]
    columns = dict(zip(names, np.array(rows, dtype=float).T))
    table.show(columns)
    table.write(columns, table.with_end(args.out, ".csv"))
    table.write(_cells(maps), table.with_end(args.out, "-cells.csv"))
    _draw(columns, args.out)
    _draw_maps([kept for kept in maps if kept[0] == 1] or maps, args.out)
    return 0


def cell_counts(cells: list[int], d: int) -> tuple[int, ...]:
    """--cells as d numbers."""
    if len(cells) not in (1, d) or min(cells) < 1:
        raise Unusable(f"--cells {' '.join(map(str, cells))} must be 1 or {d} numbers of 1 or more for a {d}D foam")
    return tuple(cells * d if len(cells) == 1 else cells)


def _cells(maps: list[tuple[int, int, float, Array, Box]]) -> dict[str, Array]:
    """A row for each cell: run, step, tau, numbers of the cell from 0, its gas fraction."""
    pieces = []
    for run, step, tau, local, _ in maps:
        numbers = np.indices(local.shape).reshape(local.ndim, -1)
        same = np.broadcast_to(np.array([[run], [step], [tau]], dtype=float), (3, local.size))
        pieces.append(np.concatenate([same, numbers, local.reshape(1, -1)]))
    names = ["run", "step", "tau", *"xyz"[:maps[0][3].ndim], "fraction"]
    return dict(zip(names, np.concatenate(pieces, axis=1)))


def _draw(columns: dict[str, Array], out: str) -> None:
    fig, (left, right) = figure.panels(1, 2)
    x = time_axis([left, right], columns["tau"], columns["step"])
    left.errorbar(x, columns["spread"], columns["spread_error"], fmt="o", lw=0.8, label="foam")
    left.errorbar(x, columns["random"], columns["random_scatter"], fmt="s", mfc="w", color="0.5", lw=0.8,
                  label="random places")
    left.set(ylabel="spread of the local gas fraction", yscale="log")
    left.legend()
    right.errorbar(x, columns["clustering"], columns["clustering_error"], fmt="o", lw=0.8)
    right.axhline(1, color="0.7", lw=0.8, zorder=0)
    highest = np.nanmax([1.0, *(columns["clustering"] + columns["clustering_error"])])
    right.set(ylabel="clustering", ylim=(0, 1.2 * highest), xlim=left.get_xlim())
    right.text(0.03, 0.04, "above 1: dense beside dense\nbelow 1: uniform", transform=right.transAxes, fontsize=7)
    figure.save(fig, out)


def _draw_maps(maps: list[tuple[int, int, float, Array, Box]], out: str) -> None:
    shown = [maps[n] for n in sorted({0, len(maps) // 2, len(maps) - 1})]
    mean = float(np.mean([local.mean() for *_, local, _ in shown]))
    most = max(float(np.abs(local - mean).max()) for *_, local, _ in shown) or 1.0
    aspect = float(shown[0][4].lengths[1] / shown[0][4].lengths[0])
    fig, axes = figure.panels(1, len(shown), width=2.0, height=min(2.0 * aspect, 6.0) + 0.35)
    picture: Any = None
    for ax, (_, step, tau, local, box) in zip(axes, shown):
        layer = local if local.ndim == 2 else local[:, :, local.shape[2] // 2]
        size = box.lengths[:2]
        picture = ax.imshow(layer.T, origin="lower", extent=(0, size[0], 0, size[1]), cmap="RdBu_r",
                            vmin=mean - most, vmax=mean + most, interpolation="nearest")
        ax.set(title=rf"$\tau$ = {tau:.3g}" if np.isfinite(tau) else f"step {step}", xticks=[], yticks=[])
        ax.minorticks_off()
    fig.colorbar(picture, ax=axes, shrink=0.85, label="gas fraction")
    figure.save(fig, table.with_end(out, "-map"))
