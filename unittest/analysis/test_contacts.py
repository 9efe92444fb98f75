"""Contacts and rattlers, against lattices whose contacts are known and counting by hand."""

import csv

import numpy as np
import pytest

from lammps_foam.analysis import contacts
from lammps_foam.analysis.pairs import close_pairs
from lammps_foam.analysis.read import Box, Unusable
from lammps_foam.command import analyse


def box_of(lengths, dimension, tilt=(0, 0, 0), periodic=(True, True, True)):
    return Box(np.zeros(3), np.array(lengths, float), np.array(tilt, float), np.array(periodic), dimension)


def lattice(counts, cell, edges):
    """Points of a lattice: counts along the edges, the points of a cell in parts of its edges."""
    grid = np.stack(np.meshgrid(*(np.arange(c) for c in counts), indexing="ij"), axis=-1).reshape(-1, 3)
    return (grid[:, None] + np.array(cell)[None]).reshape(-1, 3) @ np.array(edges, float)


def triangular(n):
    """n x n cells of two discs, nearest neighbours at distance 1."""
    edges = np.diag([1, np.sqrt(3), 1.0])
    return lattice((n, n, 1), [(0, 0, 0), (0.5, 0.5, 0)], edges), box_of([n, n * np.sqrt(3), 1], 2)


@pytest.mark.parametrize("overlap", [1.001, 1.3])
@pytest.mark.parametrize("shift", [0.0, 0.37])
def test_lattices(overlap, shift):
    flat, plane = triangular(4)
    cubic = lattice((4, 4, 4), [(0, 0, 0)], np.eye(3))
    fcc = lattice((3, 3, 3), [(0, 0, 0), (0.5, 0.5, 0), (0.5, 0, 0.5), (0, 0.5, 0.5)], np.sqrt(2) * np.eye(3))
    for x, box, z in ((flat, plane, 6), (cubic, box_of([4, 4, 4], 3), 6), (fcc, box_of(3 * [3 * np.sqrt(2)], 3), 12)):
        found = contacts.contacts_of(x + shift, np.full(len(x), overlap / 2), box)
        assert np.all(found.number == z) and found.backbone.all() and found.z == found.z_backbone == z
        apart = contacts.contacts_of(x, np.full(len(x), 0.499), box)
        assert apart.z == 0 and not apart.backbone.any() and np.isnan(apart.z_backbone)
        sticky = contacts.contacts_of(x, np.full(len(x), 0.499), box, reach=1.01)
        assert sticky.z == z


def test_rattlers_are_removed_again_and_again():
    """A chain that hangs on a triangular cluster falls apart from its end; the cluster itself holds with 3 contacts."""
    flat, box = triangular(4)
    radius = np.full(len(flat), 0.505)
    wide = box_of([4, 4 * np.sqrt(3) + 10, 1], 2)    # free surfaces: contacts through y are gone
    top = flat[np.argmax(flat[:, 1])]
    chain = top + np.column_stack([np.zeros(4), 1.0 * np.arange(1, 5), np.zeros(4)])
    x, r = np.concatenate([flat, chain]), np.full(len(flat) + 4, 0.505)
    found = contacts.contacts_of(x, r, wide)
    assert not found.backbone[-4:].any() and found.backbone[:-4].all()
    assert list(found.number[-4:]) == [2, 2, 2, 1]
    alone = contacts.contacts_of(flat, radius, wide)
    assert np.array_equal(found.inner[:-4], alone.number) and found.z_backbone == alone.z
    assert contacts.contacts_of(x, r, wide, least=2).backbone.all() == False    # noqa: E712 - the end has one
    assert contacts.contacts_of(x, r, wide, least=1).backbone.all()
    assert not contacts.contacts_of(x, r, wide, least=6).backbone.any()    # the surfaces go, layer by layer


def test_backbone_against_removing_one_by_one():
    rng = np.random.default_rng(2)
    box = box_of([9, 9, 1], 2, tilt=(3, 0, 0))
    x = np.column_stack([9 * rng.random((120, 2)), np.zeros(120)])
    radius = rng.uniform(0.2, 0.7, 120)
    pairs = close_pairs(x, radius, box)
    left = set(range(120))
    while True:
        count = {k: sum((i == k) + (j == k) for i, j in zip(pairs.i, pairs.j) if i in left and j in left) for k in left}
        loose = next((k for k in left if count[k] < 3), None)
        if loose is None:
            break
        left.remove(loose)
    found = contacts.contacts_of(x, radius, box)
    assert 20 < len(left) < 120 and set(np.flatnonzero(found.backbone)) == left
    assert {k: int(found.inner[k]) for k in left} == count


def test_walls_count():
    box = box_of([3, 3, 1], 2, periodic=(False, True, True))
    x = np.array([[0.4, 1.0, 0], [2.0, 2.5, 0], [2.6, 1.2, 0]])
    radius = np.array([0.5, 0.5, 0.3])
    assert list(contacts.contacts_of(x, radius, box).number) == [1, 0, 0]
    assert list(contacts.contacts_of(x, radius, box, walls=False).number) == [0, 0, 0]
    with pytest.raises(Unusable, match="no-walls"):
        contacts.contacts_of(x, radius, box_of([3, 3, 1], 2, (1, 0, 0), (False, True, True)))


def test_error_is_that_of_independent_runs():
    """The error of z by blocks of one state, against the scatter of z over states made alike.

    Pieces of a larger foam, whose numbers of bubbles differ: with a fixed number in the box the scatter is smaller.
    """
    rng = np.random.default_rng(8)
    box = box_of([30, 30, 1], 2)
    values, errors = [], []
    for _ in range(40):
        n = rng.poisson(900)
        x = np.column_stack([30 * rng.random((n, 2)), np.zeros(n)])
        radius = np.full(n, 0.5)
        frame = frame_of(x, radius, box)
        found = contacts.contacts_of(x, radius, box)
        value, error = contacts.whole(frame, found).values()
        assert value[0] == pytest.approx(found.z)
        values.append(value[0])
        errors.append(error[0])
    # 40 states know their scatter to 1/sqrt(80) = 11 %; 3 sigma
    assert np.mean(errors) == pytest.approx(np.std(values, ddof=1), rel=0.33)


def frame_of(x, radius, box, step=0, **columns):
    from lammps_foam.analysis.read import Frame
    return Frame(step, None, box, {"x": x[:, 0], "y": x[:, 1], "z": x[:, 2], "radius": radius, **columns}, "frame")


def write_dump(path, frames):
    """Frames (x, radius, box) as LAMMPS writes them."""
    with open(path, "w") as file:
        for step, (x, radius, box) in enumerate(frames):
            flags = " ".join("pp" if p else "ff" for p in box.periodic)
            print(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{len(x)}\nITEM: BOX BOUNDS {flags}", file=file)
            for low, high in zip(box.lo, box.hi):
                print(repr(float(low)), repr(float(high)), file=file)
            print("ITEM: ATOMS id x y z radius", file=file)
            for number, (place, r) in enumerate(zip(x, radius), 1):
                print(number, *map(float, place), float(r), file=file)


def test_command(tmp_path, capsys):
    flat, box = triangular(6)
    write_dump(tmp_path / "foam.lammpstrj", [(flat, np.full(len(flat), r), box) for r in (0.49, 0.51)])
    assert analyse("contacts", [str(tmp_path), "--out", str(tmp_path / "c")]) == 0
    with open(tmp_path / "c.csv") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["z"]) for row in rows] == [0, 6] and [float(row["rattlers"]) for row in rows] == [1, 0]
    with open(tmp_path / "c-distribution.csv") as file:
        assert [float(row["share"]) for row in csv.DictReader(file)] == [0, 0, 0, 0, 0, 0, 1]
    for end in (".pdf", ".png", "-size.csv"):
        assert (tmp_path / f"c{end}").stat().st_size > 0


@pytest.mark.parametrize("change, words", [
    (["--reach", "0"], "--reach 0 must be above 0"),
    (["--every", "0"], "--every 0 must be 1 or more"),
    (["--N", "5", "3"], "no frame with bubbles in this range"),
])
def test_refusals(tmp_path, change, words):
    flat, box = triangular(4)
    write_dump(tmp_path / "foam.lammpstrj", [(flat, np.full(len(flat), 0.5), box)])
    with pytest.raises(SystemExit, match=words):
        analyse("contacts", [str(tmp_path), "--out", str(tmp_path / "c"), *change])
    assert not list(tmp_path.glob("c*"))


def test_not_a_number_is_named(tmp_path):
    flat, box = triangular(4)
    radius = np.full(len(flat), 0.5)
    radius[4] = np.nan
    write_dump(tmp_path / "foam.lammpstrj", [(flat, radius, box)])
    with pytest.raises(SystemExit, match="step 0: the bubble id 5 has a position or a radius that is not finite"):
        analyse("contacts", [str(tmp_path), "--out", str(tmp_path / "c")])


def test_one_bubble(tmp_path):
    box = box_of([3, 3, 1], 2)
    write_dump(tmp_path / "foam.lammpstrj", [(np.array([[1.0, 1.0, 0.0]]), np.array([0.5]), box)])
    assert analyse("contacts", [str(tmp_path), "--out", str(tmp_path / "c")]) == 0
