"""Radial distribution function g(r), by freud, against r / <R> and against r / (R_i + R_j).

g(r) is the density of bubbles at distance r from a bubble over the mean density, (N - 1) / V: 1 without order. freud
(Ramasubramani et al., Comput. Phys. Commun. 254, 107275 (2020)) finds the neighbours, also in tilted boxes, as far as
half the least width of the box. Against s = r / (R_i + R_j) the pairs are held against what bubbles of these radii
would have at random places: g(s) ds = pairs in ds / sum over pairs of the shell's share of the box; contacts are s < 1.

Means are over the frames and runs that are chosen, each frame with the same weight. Errors are standard errors (one
sigma), by leaving out one block of space after the other (4 x 4 in 2D, 3 x 3 x 3 in 3D, of the bubbles from which one
looks); with several runs, from their scatter. Frames of one run are not independent, so more of them do not make the
error smaller: blocks of the same place are left out in all frames together.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator

import numpy as np

from . import figure, table
from .contacts import BLOCKS
from .frames import STATES, add_every, optional, selected
from .pairs import Index, blocks, checked, into_brick, jackknife, pair_chunks
from .read import Array, Box, Frame, Unusable
from .runs import Range, add_range, add_runs


def shell(inner: Array, outer: Array, d: int) -> Array:
    """Area of rings or volume of shells."""
    return np.asarray(np.pi * (outer**2 - inner**2) if d == 2 else 4 / 3 * np.pi * (outer**3 - inner**3))


def least_width(box: Box) -> float:
    """The least distance of opposite faces: 1 / the length of the rows of the inverse matrix of edges."""
    d = box.dimension
    return float(np.min(1 / np.linalg.norm(np.linalg.inv(box.edges[:d, :d]), axis=0)))


def neighbours(x: Array, box: Box, most: float) -> tuple[Index, Array]:
    """Both (m,): of all ordered pairs nearer than `most`, from which bubble, and how far. By freud."""
    freud = optional("freud")
    d = box.dimension
    lx, ly, lz = box.lengths
    xy, xz, yz = box.tilt[0] / ly, box.tilt[1] / lz, box.tilt[2] / lz    # freud has tilts in parts of a length
    place = freud.box.Box(lx, ly, lz, xy, xz, yz) if d == 3 else freud.box.Box(lx, ly, xy=xy, is2D=True)
    points = into_brick(x, box) - box.lo - box.edges[:d].sum(axis=0) / 2    # freud's origin is the middle
    if d == 2:
        points[:, 2] = 0.0
    points = place.wrap(points)
    found = freud.locality.AABBQuery(place, points).query(points, {"r_max": most, "exclude_ii": True}).toNeighborList()
    return np.asarray(found.query_point_indices, dtype=np.intp), np.asarray(found.distances, dtype=float)


def g_of_r(x: Array, box: Box, edges: Array, block: Index, count: int) -> tuple[Array, Array]:
    """Pairs in bins of r, and what random places have, each (count, bins): by the block of the bubble one looks from.

    x (n, 3); edges (bins + 1,) of r; block (n,) of count. Their ratio, summed over blocks, is g(r).
    """
    n = len(x)
    start, distance = neighbours(x, box, float(edges[-1]))
    place = np.searchsorted(edges, distance, side="right") - 1
    inside = (place >= 0) & (place < len(edges) - 1)
    flat = block[start[inside]] * (len(edges) - 1) + place[inside]
    pairs = np.bincount(flat, minlength=count * (len(edges) - 1)).reshape(count, -1).astype(float)
    members = np.bincount(block, minlength=count).astype(float)
    return pairs, members[:, None] * (n - 1) / box.volume * shell(edges[:-1], edges[1:], box.dimension)


def g_of_s(x: Array, radius: Array, box: Box, edges: Array, block: Index, count: int) -> tuple[Array, Array]:
    """The same for s = r / (R_i + R_j), with all periodic images."""
    d, bins = box.dimension, len(edges) - 1
    pairs = np.zeros((count, bins))
    for near in pair_chunks(x, radius, box, float(edges[-1])):
        place = np.searchsorted(edges, near.distance / near.sums, side="right") - 1
        inside = (place >= 0) & (place < bins) & (near.i != near.j)
        for side in (near.i, near.j):
            flat = block[side[inside]] * bins + place[inside]
            pairs += np.bincount(flat, minlength=count * bins).reshape(count, bins)
    # sum over j, other than i, of (R_i + R_j)^d, by the moments of the radii
    m1, m2, m3, n = radius.sum(), (radius**2).sum(), (radius**3).sum(), len(radius)
    powers = n * radius**2 + 2 * radius * m1 + m2 if d == 2 else n * radius**3 + 3 * (radius**2 * m1 + radius * m2) + m3
    powers = powers - (2 * radius)**d
    return pairs, np.bincount(block, powers, count)[:, None] / box.volume * shell(edges[:-1], edges[1:], d)


# ---------------------------------------------------------------- means over frames and runs

class Mean:
    """g of the frames of each run, each frame with the same weight."""

    def __init__(self) -> None:
        self.above: dict[int, Array] = {}
        self.below: dict[int, Array] = {}

    def add(self, run: int, n: int, above: Array, below: Array) -> None:
        """Sums of a frame of n bubbles in blocks (blocks, bins)."""
        self.above[run] = self.above.get(run, 0.0) + above / n
        self.below[run] = self.below.get(run, 0.0) + below / n

    def values(self) -> tuple[Array, Array]:
        """g and its error, both (bins,)."""
        if len(self.above) == 1:
            return jackknife(next(iter(self.above.values())), next(iter(self.below.values())))
        each = np.array([self.above[run].sum(axis=0) / self.below[run].sum(axis=0) for run in self.above])
        return each.mean(axis=0), each.std(axis=0, ddof=1) / np.sqrt(len(each))


# ---------------------------------------------------------------- command line

def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_runs(parser, STATES, "radial")
    add_range(parser, "frames to average over", "the last frame")
    add_every(parser)
    parser.add_argument("--most", type=float, default=10.0, metavar="R", help="largest r / <R> (default: 10)")
    parser.add_argument("--most-sums", type=float, default=3.0, metavar="S",
                        help="largest r / (R_i + R_j) (default: 3)")
    parser.add_argument("--bins", type=int, default=100, metavar="M", help="bins of each (default: 100)")
    parser.epilog = ("example: g(r) of the scaling state, while 5000 to 1000 bubbles are left\n"
                     "  lammps-foam radial DIR --N 5000 1000 --out radial")


def main(args: argparse.Namespace) -> int:
    if args.bins < 1 or not args.most > 0 or not args.most_sums > 0:
        raise Unusable("--bins, --most and --most-sums must be above 0")
    which = Range(args.tau, args.N)
    plain, sums, frames, bubbles = Mean(), Mean(), 0, 0
    r_edges, s_edges = np.linspace(0, args.most, args.bins + 1), np.linspace(0, args.most_sums, args.bins + 1)
    for run, frame in _frames(args, which):
        x, radius = checked(frame)
        _check(frame, args.most * radius.mean())
        each = BLOCKS[frame.box.dimension]
        block, count = blocks(x, frame.box, each), each**frame.box.dimension
        plain.add(run, len(x), *g_of_r(x, frame.box, r_edges * radius.mean(), block, count))
        sums.add(run, len(x), *g_of_s(x, radius, frame.box, s_edges, block, count))
        frames, bubbles = frames + 1, bubbles + len(x)
    columns: dict[str, Array] = {"r/<R>": (r_edges[1:] + r_edges[:-1]) / 2}
    columns["g"], columns["g_error"] = plain.values()
    columns["r/(Ri+Rj)"] = (s_edges[1:] + s_edges[:-1]) / 2
    columns["gs"], columns["gs_error"] = sums.values()
    table.show(columns)
    print(f"\n{frames} frames with {bubbles} bubbles in all")
    table.write(columns, table.with_end(args.out, ".csv"))
    _draw(columns, args.out)
    return 0


def _frames(args: argparse.Namespace, which: Range) -> Iterator[tuple[int, Frame]]:
    """The chosen frames; the last of each run if none are chosen."""
    last: dict[int, Frame] = {}
    for run, frame, _ in selected(args.runs, which, args.every):
        if which:
            yield run, frame
        else:
            last[run] = frame
    yield from last.items()


def _check(frame: Frame, most: float) -> None:
    box = frame.box
    if len(frame) < 2:
        raise Unusable(f"{frame.path}, step {frame.step}: g(r) needs two bubbles or more")
    if not box.periodic[:box.dimension].all():
        raise Unusable(f"{frame.path}, step {frame.step}: g(r) needs a box that is periodic in all directions")
    if most >= least_width(box) / 2:
        limit = least_width(box) / 2 / frame.radius.mean()
        raise Unusable(f"{frame.path}, step {frame.step}: --most must be below {limit:.4g} there, "
                       "half the least width of the box in <R>")


def _draw(columns: dict[str, Array], out: str) -> None:
    fig, axes = figure.panels(1, 2)
    for ax, r, g, label in ((axes[0], "r/<R>", "g", r"$r\,/\,\langle R\rangle$"),
                            (axes[1], "r/(Ri+Rj)", "gs", r"$r\,/\,(R_i+R_j)$")):
        x, y, error = columns[r], columns[g], np.nan_to_num(columns[f"{g}_error"])
        ax.axhline(1, color="0.7", lw=0.8, zorder=0)
        ax.fill_between(x, y - error, y + error, alpha=0.3, lw=0)
        ax.plot(x, y)
        ax.set(xlabel=label, ylabel=r"$g$", xlim=(0, x[-1]), ylim=(0, None))
    axes[1].axvline(1, color="0.7", lw=0.8, ls="--", zorder=0)
    figure.save(fig, out)
