"""Pairs through periodic faces, against counting all images one by one."""

import itertools

import numpy as np
import pytest

from lammps_foam.analysis.pairs import blocks, close_pairs, images, into_brick, jackknife
from lammps_foam.analysis.read import Box


def box_of(lengths, tilt=(0, 0, 0), periodic=(True, True, True), dimension=3, lo=(-1.0, 2.0, 0.5)):
    lo = np.array(lo, float)
    return Box(lo, lo + lengths, np.array(tilt, float), np.array(periodic), dimension)


def brute(x, radius, box, reach=1.0, turns=4):
    """Contacts per bubble and the sorted distances, by looking at (2 turns + 1)^d images of each pair."""
    ranges = [range(-turns, turns + 1) if box.periodic[a] and a < box.dimension else [0] for a in range(3)]
    number, distances = np.zeros(len(x), int), []
    for shift in itertools.product(*ranges):
        r = np.linalg.norm(x[:, None] - x[None] - np.array(shift) @ box.edges, axis=2)
        close = r < reach * (radius[:, None] + radius[None])
        if shift == (0, 0, 0):
            np.fill_diagonal(close, False)
        number += close.sum(axis=1)
        distances.append(r[close])
    return number, np.sort(np.concatenate(distances))[::2]    # each pair was seen from both sides


BOXES = {
    "2D": box_of([5.0, 4.0, 1.0], dimension=2),
    "2D tilted": box_of([5.0, 4.0, 1.0], (2.3, 0, 0), dimension=2),
    "2D tilted far": box_of([5.0, 4.0, 1.0], (-7.7, 0, 0), dimension=2),
    "2D small": box_of([1.5, 1.2, 1.0], (0.4, 0, 0), dimension=2),
    "2D walls": box_of([5.0, 4.0, 1.0], periodic=(True, False, True), dimension=2),
    "3D": box_of([4.0, 3.0, 3.5]),
    "3D tilted": box_of([4.0, 3.0, 3.5], (1.0, -0.7, 1.2)),
    "3D small": box_of([1.1, 1.5, 1.2], (0.3, 0.2, -0.5)),
    "3D walls": box_of([4.0, 3.0, 3.5], (0, 1.0, 0), (True, False, True)),
}


@pytest.mark.parametrize("name", BOXES)
@pytest.mark.parametrize("reach", [1.0, 1.4])
def test_all_pairs_are_found_once(name, reach):
    box = BOXES[name]
    rng = np.random.default_rng(3)
    n = 6 if "small" in name else 40
    x = box.lo + rng.random((n, 3)) @ box.edges
    x[:, 2] = 0.5 if box.dimension == 2 else x[:, 2]
    radius = rng.uniform(0.05, 0.9, n)
    number, distances = brute(x, radius, box, reach)
    moved = x + (rng.integers(-3, 4, (n, 3)) * box.periodic * (np.arange(3) < box.dimension)) @ box.edges
    for places in (x, moved):
        pairs = close_pairs(places, radius, box, reach)
        assert np.array_equal(pairs.per_bubble(n), number)
        np.testing.assert_allclose(np.sort(pairs.distance), distances, rtol=1e-12)
        assert np.array_equal(pairs.sums, radius[pairs.i] + radius[pairs.j])
    assert len(distances) > 3    # the test has something to find


def test_one_bubble_meets_its_images():
    box = box_of([1.0, 1.0, 1.0], dimension=2)
    x = np.array([[0.0, 2.5, 0.5]])
    assert len(close_pairs(x, np.array([0.4]), box)) == 0
    assert close_pairs(x, np.array([0.6]), box).per_bubble(1)[0] == 4     # 4 neighbours at 1 < 1.2
    assert close_pairs(x, np.array([0.75]), box).per_bubble(1)[0] == 8    # and 4 at sqrt(2) < 1.5


def test_nothing_and_no_size():
    box = BOXES["2D"]
    assert len(close_pairs(np.empty((0, 3)), np.empty(0), box)) == 0
    assert len(close_pairs(np.zeros((5, 3)), np.zeros(5), box)) == 0


def test_sizes_far_apart():
    """A giant among crumbs: classes of size lose no pair."""
    box = box_of([20.0, 20.0, 1.0], dimension=2)
    rng = np.random.default_rng(1)
    x = np.column_stack([box.lo[:2] + 20 * rng.random((300, 2)), np.full(300, 0.5)])
    radius = 10 ** rng.uniform(-3, 0.9, 300)
    pairs = close_pairs(x, radius, box)
    number, distances = brute(x, radius, box, turns=2)
    assert np.array_equal(pairs.per_bubble(300), number)


def test_brick_has_the_same_lattice():
    box = BOXES["3D tilted"]
    x = box.lo + np.random.default_rng(0).normal(0, 20, (50, 3))
    y = into_brick(x, box)
    assert np.all((y >= box.lo) & (y < box.hi))
    turns = (y - x) @ np.linalg.inv(box.edges)
    np.testing.assert_allclose(turns, np.round(turns), atol=1e-12)    # rounding of numbers up to 60
    index, places, shift = images(y, box, 0.0)
    assert np.array_equal(index[:50], np.arange(50)) and np.array_equal(places[:50], y) and not shift[:50].any()


def test_blocks_and_jackknife():
    """Independent numbers: the jackknife of their mean gives the standard error of the mean."""
    rng = np.random.default_rng(5)
    box = box_of([4.0, 4.0, 1.0], dimension=2)
    x = np.column_stack([box.lo[:2] + 4 * rng.random((4000, 2)), np.zeros(4000)])
    which = blocks(x, box, 4)
    assert which.min() == 0 and which.max() == 15
    assert np.all(which[(x[:, 0] < 0) & (x[:, 1] < 3)] == 0)
    above, below = rng.normal(1, 1, 400), np.ones(400)
    value, error = jackknife(above, below)
    assert value == pytest.approx(above.mean())
    assert error == pytest.approx(above.std(ddof=1) / 20, rel=1e-9)    # an identity for equal denominators
