"""Pairs of bubbles that are close, through periodic faces of any box: also tilted, also smaller than the bubbles reach.

A pair is counted for each periodic image in which it is close. So two bubbles may touch more than once, and a bubble
may touch its own image, as in LAMMPS, whose ghost atoms are such images.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from .read import Array, Box, Frame, Unusable

Index = NDArray[np.intp]
CHUNK = 100_000         # bubbles searched at once: bounds the memory
CLASS_RATIO = 1.5       # of the largest to the smallest radius of a class of sizes


@dataclass(frozen=True)
class Pairs:
    """m pairs, each once: i touches an image of j. i = j where a bubble meets its own image."""

    i: Index            # (m,)
    j: Index            # (m,)
    vector: Array       # (m, 3): from the image of j to i
    sums: Array         # (m,): R_i + R_j

    @property
    def distance(self) -> Array:
        """(m,)"""
        return np.asarray(np.sqrt(np.sum(self.vector**2, axis=1)))

    def __len__(self) -> int:
        return len(self.i)

    def only(self, which: NDArray[np.bool_]) -> Pairs:
        """The pairs of a mask (m,)."""
        return Pairs(self.i[which], self.j[which], self.vector[which], self.sums[which])

    def per_bubble(self, n: int) -> Index:
        """(n,): how many of the pairs each bubble has; one with its own image counts twice, once for each side."""
        return np.asarray(np.bincount(self.i, minlength=n) + np.bincount(self.j, minlength=n))


def checked(frame: Frame) -> tuple[Array, Array]:
    """Positions (n, 3) and radii (n,) of a frame; refuses numbers that are not finite and negative radii."""
    x, radius = frame.positions, frame.radius
    bad = ~(np.isfinite(x).all(axis=1) & np.isfinite(radius) & (radius >= 0))
    if bad.any():
        first = int(np.flatnonzero(bad)[0])
        name = f"id {frame.columns['id'][first]:.0f}" if "id" in frame.columns else f"number {first + 1}"
        raise Unusable(f"{frame.path}, step {frame.step}: the bubble {name} has a position or a radius that is "
                       "not finite, or a negative radius")
    return x, radius


def into_brick(x: Array, box: Box) -> Array:
    """Positions (n, 3) moved through periodic faces into the brick lo to lo + (lx, ly, lz).

    The edges of a box are a = (lx, 0, 0), b = (xy, ly, 0), c = (xz, yz, lz): the brick has the same volume and,
    repeated along a, b and c, fills space as the tilted box does.
    """
    x = np.array(x, dtype=float)
    for axis in reversed(range(box.dimension)):
        if box.periodic[axis]:
            turns = np.floor((x[:, axis] - box.lo[axis]) / box.lengths[axis])
            x -= turns[:, None] * box.edges[axis]
            edge = x[:, axis] >= box.hi[axis]    # by rounding
            x[edge, axis] = box.lo[axis]
    return x


def images(x: Array, box: Box, reach: Array | float) -> tuple[Index, Array, NDArray[np.int64]]:
    """All images of bubbles that are no farther than `reach` ((n,) or one number) from the brick, along each axis.

    x (n, 3) lies in the brick (`into_brick`). Returns which bubble it is (m,), where it is (m, 3), and how often it was
    moved along a, b, c (m, 3). Those with 0 0 0 are the bubbles themselves, and come first.
    """
    index = np.arange(len(x))
    reach = np.broadcast_to(np.asarray(reach, dtype=float), (len(x),))
    shift = np.zeros((len(x), 3), dtype=np.int64)
    for axis in reversed(range(box.dimension)):
        if not box.periodic[axis] or len(index) == 0:
            continue
        length, low = box.lengths[axis], box.lo[axis]
        first = -np.floor((x[:, axis] - low) / length).astype(np.int64)    # into the brick; then so many more each way
        most = int(np.ceil(reach.max() / length))
        kept = []
        for turn in sorted(range(-most, most + 1), key=abs):
            turns = first + turn
            place = x[:, axis] + turns * length
            near = np.flatnonzero((place >= low - reach[index]) & (place <= low + length + reach[index])
                                  if turn else np.ones(len(x), dtype=bool))
            moved = shift[near].copy()
            moved[:, axis] += turns[near]
            kept.append((index[near], x[near] + turns[near, None] * box.edges[axis], moved))
        index, x, shift = (np.concatenate(parts) for parts in zip(*kept))
    own = np.argsort(np.any(shift != 0, axis=1), kind="stable")
    return index[own], x[own], shift[own]


def pair_chunks(x: Array, radius: Array, box: Box, reach: float = 1.0) -> Iterator[Pairs]:
    """The pairs with a distance r < reach * (R_i + R_j), in pieces that fit into memory; each pair once.

    x (n, 3), radius (n,). Bubbles are searched by classes of size, so that a few large ones do not make all others
    look far.
    """
    if len(x) == 0 or not np.any(radius > 0):
        return
    x = into_brick(x, box)
    index, places, shift = images(x, box, reach * (radius + radius.max()))
    kind = _size_classes(radius)
    kinds = np.unique(kind)
    of_kind = {k: np.flatnonzero(kind[index] == k) for k in kinds}
    trees = {k: cKDTree(places[of_kind[k]]) for k in kinds}
    for a in kinds:
        members = np.flatnonzero(kind == a)
        for b in kinds[kinds >= a]:
            cutoff = reach * (radius[kind == a].max() + radius[kind == b].max())
            for start in range(0, len(members), CHUNK):
                part = members[start:start + CHUNK]
                near = cKDTree(x[part]).sparse_distance_matrix(trees[b], cutoff, output_type="ndarray")
                i, image = part[near["i"]], of_kind[b][near["j"]]
                j = index[image]
                close = near["v"] < reach * (radius[i] + radius[j])
                if a == b:
                    close &= (i < j) | ((i == j) & _forward(shift[image]))
                i, j, image = i[close], j[close], image[close]
                yield Pairs(i, j, x[i] - places[image], radius[i] + radius[j])


def close_pairs(x: Array, radius: Array, box: Box, reach: float = 1.0) -> Pairs:
    """All pairs with a distance r < reach * (R_i + R_j), each once: the contacts if reach = 1."""
    chunks = list(pair_chunks(x, radius, box, reach))
    if not chunks:
        none = np.empty(0, dtype=np.intp)
        return Pairs(none, none, np.empty((0, 3)), np.empty(0))
    return Pairs(*(np.concatenate([getattr(chunk, name) for chunk in chunks])
                   for name in ("i", "j", "vector", "sums")))


def _size_classes(radius: Array) -> NDArray[np.int64]:
    """(n,): classes of radii, each up to CLASS_RATIO wide; what is smaller than a hundredth of the largest is one."""
    least = max(radius.min(), radius.max() / 100)
    return np.asarray(np.log(np.maximum(radius, least) / least) / np.log(CLASS_RATIO)).astype(np.int64)


def _forward(shift: NDArray[np.int64]) -> NDArray[np.bool_]:
    """(m,): one of each pair of opposite shifts (m, 3): the first number that is not 0 is positive."""
    code = shift @ np.array([1_000_000, 1_000, 1])
    return np.asarray(code > 0)


# ---------------------------------------------------------------- uncertainty within one state

def blocks(x: Array, box: Box, each: int) -> Index:
    """(n,): in which of each^d equal blocks of the box a bubble lies."""
    d = box.dimension
    corner = (into_brick(x, box) - box.lo)[:, :d] / box.lengths[:d]
    place = np.clip((corner * each).astype(np.intp), 0, each - 1)
    return np.asarray(np.ravel_multi_index(tuple(place.T), (each,) * d))


def jackknife(above: Array, below: Array) -> tuple[Array, Array]:
    """The ratios sum(above) / sum(below) over blocks (first axis), and their standard errors by leaving out one block.

    Blocks have to be larger than the distance over which the state is correlated. nan where nothing is below.
    """
    count = len(above)
    with np.errstate(invalid="ignore", divide="ignore"):
        value = above.sum(axis=0) / below.sum(axis=0)
        left = (above.sum(axis=0) - above) / (below.sum(axis=0) - below)
        error = np.sqrt((count - 1) / count * np.sum((left - left.mean(axis=0))**2, axis=0))
    return np.asarray(value), np.asarray(error)
