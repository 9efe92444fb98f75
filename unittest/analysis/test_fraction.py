"""Local gas fraction: areas and volumes in cells against sampling and whole bubbles; spreads with known answers."""

import csv

import numpy as np
import pytest

from lammps_foam.analysis import fraction
from lammps_foam.analysis.frames import gas
from lammps_foam.command import analyse
from test_contacts import box_of, write_dump

BOXES = {
    "2D": box_of([7.0, 5.0, 1.0], 2),
    "2D tilted": box_of([7.0, 5.0, 1.0], 2, (2.2, 0, 0)),
    "2D small": box_of([1.4, 1.1, 1.0], 2, (-0.3, 0, 0)),
    "3D": box_of([5.0, 4.0, 6.0], 3),
    "3D tilted": box_of([5.0, 4.0, 6.0], 3, (1.0, -1.5, 0.7)),
}


@pytest.mark.parametrize("name", BOXES)
def test_parts_add_up(name, rng):
    """No gas is lost at faces: the sum over cells is that of whole bubbles, to rounding; also in boxes smaller than
    a bubble."""
    box = BOXES[name]
    x, radius = 20 * rng.random((50, 3)) - 7, rng.uniform(0.01, 1.3, 50)
    counts = (4, 3, 5)[:box.dimension]
    found = fraction.gas_on_grid(x, radius, box, counts)
    assert found.shape == counts and np.all(found >= -1e-12)
    assert found.sum() == pytest.approx(gas(radius, box.dimension).sum(), rel=1e-12)
    assert fraction.local_fraction(x, radius, box, counts).mean() == pytest.approx(
        gas(radius, box.dimension).sum() / box.volume, rel=1e-12)


@pytest.mark.parametrize("name", BOXES)
def test_moves_with_the_box(name, rng):
    """A shift by one cell shifts the map; through the tilted faces too, where the box is shifted along x alone."""
    box = BOXES[name]
    x, radius = 20 * rng.random((30, 3)), rng.uniform(0.1, 0.9, 30)
    counts = (4, 3, 5)[:box.dimension]
    found = fraction.gas_on_grid(x, radius, box, counts)
    moved = fraction.gas_on_grid(x + [box.lengths[0] / 4, 0, 0], radius, box, counts)
    np.testing.assert_allclose(moved, np.roll(found, 1, axis=0), atol=1e-10)
    images = x + rng.integers(-2, 3, (30, 3)) * (np.arange(3) < box.dimension) @ box.edges
    np.testing.assert_allclose(fraction.gas_on_grid(images, radius, box, counts), found, atol=1e-10)


@pytest.mark.parametrize("dimension", [2, 3])
def test_against_points_in_bubbles(dimension, rng):
    """Cells of some bubbles against counting points of a fine mesh."""
    box = box_of([3.0, 2.0, 2.5], dimension, (0.7, 0, 0))
    x, radius = rng.random((6, 3)) * box.lengths, rng.uniform(0.2, 0.8, 6)
    if dimension == 2:
        x[:, 2] = 0
    counts, each = (3, 2, 2)[:dimension], {2: 120, 3: 16}[dimension]
    found = fraction.gas_on_grid(x, radius, box, counts)
    mesh = [box.lengths[a] * (np.arange(counts[a] * each) + 0.5) / (counts[a] * each) for a in range(dimension)]
    points = np.stack(np.meshgrid(*mesh, indexing="ij"), axis=-1)
    inside = np.zeros(points.shape[:-1])
    for center, r in zip(x, radius):
        for shift in np.ndindex(*(3,) * dimension):
            image = center + (np.array([*shift, 1][:3]) - 1) @ box.edges
            inside += np.sum((points - image[:dimension])**2, axis=-1) < r**2
    cell = box.volume / np.prod(counts)
    counted = fraction.coarser(inside, each) * cell if dimension == 2 else None
    if dimension == 3:
        blocks = inside.reshape(counts[0], each, counts[1], each, counts[2], each)
        counted = blocks.mean(axis=(1, 3, 5)) * cell
    # points at borders are in or out: about sqrt(points on the border) of them are wrong
    np.testing.assert_allclose(found, counted, atol=cell * 3 * each ** (-(dimension + 1) / 2))


def test_a_disc_on_a_corner():
    """Quarters, and a square that is all inside a disc."""
    box = box_of([4.0, 4.0, 1.0], 2)
    one = fraction.gas_on_grid(np.array([[2.0, 2.0, 0.0]]), np.array([0.7]), box, (2, 2))
    np.testing.assert_allclose(one, np.pi * 0.49 / 4, rtol=1e-14)
    full = fraction.gas_on_grid(np.array([[2.0, 2.0, 0.0]]), np.array([1.9]), box, (8, 8))
    assert full[3, 3] == pytest.approx(0.25, rel=1e-12) and full[0, 0] == pytest.approx(0.0, abs=1e-14)


def test_spheres_error_is_as_said(rng, monkeypatch):
    """Octants of a sphere, an edge and corners off centre: the parts of a cell to 1e-3 of the sphere."""
    box = box_of([8.0, 8.0, 8.0], 3)
    coarse, worst = fraction.SLICES, 0.0
    for _ in range(20):
        x, r = 4 + rng.uniform(-0.9, 0.9, (1, 3)), np.array([1.0])
        found = fraction.gas_on_grid(x, r, box, (2, 2, 2))
        monkeypatch.setattr(fraction, "SLICES", 200)
        exact = fraction.gas_on_grid(x, r, box, (2, 2, 2))
        monkeypatch.setattr(fraction, "SLICES", coarse)
        worst = max(worst, np.abs(found - exact).max() / (4 / 3 * np.pi))
    assert worst < 1e-3
    octants = fraction.gas_on_grid(np.full((1, 3), 4.0), np.array([1.0]), box, (2, 2, 2))
    np.testing.assert_allclose(octants, 4 / 3 * np.pi / 8, rtol=1e-12)


def test_random_places_are_poisson(rng):
    """Small bubbles at random: the number in a cell is binomial, so the variance of the gas fraction is known, and
    clustering is 1."""
    box = box_of([100.0, 100.0, 1.0], 2)
    radius = np.full(20000, 0.05)
    value, scatter = fraction.random_spread(radius, box, (10, 10), 20)
    v, cell = np.pi * 0.05**2, 100.0
    expected = v / cell * np.sqrt(20000 * 0.01 * 0.99)
    # m = 100 cells know their standard deviation to 1/sqrt(2 * 99) = 7 %; 20 trials to 1.6 %; 4 sigma
    assert value == pytest.approx(expected, rel=0.064)
    assert scatter == pytest.approx(value / np.sqrt(198), rel=0.5)
    x = 100 * rng.random((20000, 3))
    fine = fraction.local_fraction(x, radius, box, (50, 50))
    ratio, error = fraction.clustering(fine, 5)
    assert abs(ratio - 1) < 4 * error and error == pytest.approx(1 / np.sqrt(198), rel=0.3)


def test_separation_is_told_from_uniform(rng):
    """A lattice with noise has less than 1, a foam with a gap more than 1."""
    box = box_of([40.0, 40.0, 1.0], 2)
    grid = np.stack(np.meshgrid(np.arange(40) + 0.5, np.arange(40) + 0.5, [0.0], indexing="ij"), -1).reshape(-1, 3)
    x, radius = grid + rng.normal(0, 0.2, grid.shape), np.full(1600, 0.5)
    split = fraction.splits(radius, box, (4, 4))
    assert split == 5
    uniform = fraction.local_fraction(x, radius, box, (4 * split, 4 * split))
    ratio, error = fraction.clustering(uniform, split)
    assert ratio + 3 * error < 1
    gap = x[:, 0] > 12
    separated = fraction.local_fraction(x[gap], radius[gap], box, (4 * split, 4 * split))
    ratio, error = fraction.clustering(separated, split)
    assert ratio > 3
    assert fraction.spread(fraction.coarser(separated, split))[0] > 3 * fraction.random_spread(
        radius[gap], box, (4, 4), 3)[0]


def test_spread_and_its_error(rng):
    cells = rng.normal(0.9, 0.02, (400, 10))
    values, errors = zip(*(fraction.spread(row) for row in rng.normal(0.9, 0.02, (300, 100))))
    assert fraction.spread(cells)[0] == pytest.approx(cells.std(ddof=1))
    assert np.mean(errors) == pytest.approx(np.std(values, ddof=1), rel=0.15)    # 300 draws: 4 %, bias of m = 100: 2 %
    assert np.isnan(fraction.spread(np.array([0.9]))[0])
    assert fraction.spread(np.full(9, 0.5)) == (0.0, 0.0)


@pytest.mark.parametrize("dimension", [2, 3])
def test_command(tmp_path, rng, dimension):
    box = box_of([10, 10, 10 if dimension == 3 else 1], dimension)
    x = rng.random((200, 3)) * box.lengths
    if dimension == 2:
        x[:, 2] = 0
    write_dump(tmp_path / "foam.lammpstrj", [(x, np.full(200, 0.4), box), (x[:50], np.full(50, 0.6), box)])
    (tmp_path / "series.csv").write_text("step,tau\n0,0.0\n1,2.5\n")
    analyse("fraction", [str(tmp_path), "--cells", "5", "--out", str(tmp_path / "f")])
    with open(tmp_path / "f.csv") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["tau"]) for row in rows] == [0, 2.5] and [float(row["N"]) for row in rows] == [200, 50]
    with open(tmp_path / "f-cells.csv") as file:
        cells = [float(row["fraction"]) for row in csv.DictReader(file) if row["step"] == "1"]
    assert len(cells) == 5**dimension and np.mean(cells) == pytest.approx(float(rows[1]["phi"]), rel=1e-8)
    for end in (".pdf", ".png", "-map.pdf", "-map.png"):
        assert (tmp_path / f"f{end}").stat().st_size > 0
    with pytest.raises(SystemExit, match="--cells 5 5 5 5 must be 1 or"):
        analyse("fraction", [str(tmp_path), "--cells", "5", "5", "5", "5", "--out", str(tmp_path / "g")])


def test_one_bubble_and_walls():
    box = box_of([4.0, 4.0, 1.0], 2, periodic=(False, False, True))
    x, r = np.array([[0.0, 2.0, 0.0]]), np.array([1.0])
    assert fraction.gas_on_grid(x, r, box, (3, 3)).sum() == pytest.approx(np.pi / 2)    # half of it is in the box
    assert fraction.gas_on_grid(np.empty((0, 3)), np.empty(0), box, (3, 3)).sum() == 0
