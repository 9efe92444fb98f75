"""The radial distribution function: lattices, random places, freud's own g(r), and brute force."""

import csv

import numpy as np
import pytest

freud = pytest.importorskip("freud")

from lammps_foam.analysis import radial    # noqa: E402
from lammps_foam.command import analyse    # noqa: E402
from test_contacts import box_of, triangular, write_dump    # noqa: E402

BOXES = {"2D": box_of([20.0, 18.0, 1.0], 2), "2D tilted": box_of([20.0, 18.0, 1.0], 2, (6, 0, 0)),
         "3D": box_of([10.0, 9.0, 11.0], 3), "3D tilted": box_of([10.0, 9.0, 11.0], 3, (3, -2, 2.5))}


def g_of(x, box, edges):
    above, below = radial.g_of_r(x, box, edges, np.zeros(len(x), int), 1)
    return above[0] / below[0]


@pytest.mark.parametrize("name", BOXES)
def test_neighbours_by_brute_force(name, rng):
    """All distances below the limit, once from each side, through all faces. freud has single precision: 1e-5."""
    box = BOXES[name]
    x = rng.random((150, 3)) @ box.edges + rng.integers(-1, 2, (150, 3)) @ box.edges
    if box.dimension == 2:
        x[:, 2] = 0
    most = 0.49 * radial.least_width(box)
    d = box.minimum_image((x[:, None] - x[None]).reshape(-1, 3)).reshape(150, 150, 3)
    r = np.linalg.norm(d, axis=2)
    start, distance = radial.neighbours(x, box, most)
    assert np.array_equal(np.bincount(start, minlength=150), (r < most).sum(axis=1) - 1)
    np.testing.assert_allclose(np.sort(distance), np.sort(r[(r < most) & (r > 0)]), atol=1e-5)


@pytest.mark.parametrize("name", BOXES)
def test_random_places_have_1(name, rng):
    """g = 1 within its error, in r and in s; the error agrees with Poisson's."""
    box = BOXES[name]
    n = 2000
    x, radius = rng.random((n, 3)) @ box.edges, rng.uniform(0.1, 0.6, n)
    if box.dimension == 2:
        x[:, 2] = 0
    edges = np.linspace(0, 0.4 * radial.least_width(box), 9)
    block = radial.blocks(x, box, 4)
    for above, below in (radial.g_of_r(x, box, edges, block, 4**box.dimension),
                         radial.g_of_s(x, radius, box, np.linspace(0, 2.5, 9), block, 4**box.dimension)):
        pairs = below.sum(axis=0) / 2
        g = above.sum(axis=0) / below.sum(axis=0)
        assert np.all(np.abs(g - 1) < 4 * np.sqrt(1 / pairs + 1 / n))


def test_g_of_freud(rng):
    box = BOXES["3D tilted"]
    x = rng.random((500, 3)) @ box.edges
    place = freud.box.Box(10, 9, 11, 3 / 9, -2 / 11, 2.5 / 11)
    rdf = freud.density.RDF(20, 4.0, normalization_mode="finite_size")
    rdf.compute((place, place.wrap(x - box.edges.sum(axis=0) / 2)))
    # pairs that rounding to single precision puts into the next bin: a few of some hundred
    np.testing.assert_allclose(g_of(x, box, np.linspace(0, 4, 21)), rdf.rdf, rtol=0.02, atol=0.02)


def test_triangular_lattice():
    """Peaks at 1, sqrt 3 and 2 with 6 bubbles each; nothing between; also in units of the sum of radii."""
    x, box = triangular(8)
    n = len(x)
    edges = np.array([0.9, 1.1, 1.6, 1.8, 1.9, 2.1])
    above, below = radial.g_of_r(x, box, edges, np.zeros(n, int), 1)
    assert list(above[0] / n) == [6, 0, 6, 0, 6]
    np.testing.assert_allclose(below[0] / n, (n - 1) / box.volume * np.pi * np.diff(edges**2))
    above, _ = radial.g_of_s(x, np.full(n, 0.5), box, edges, np.zeros(n, int), 1)
    assert list(above[0] / n) == [6, 0, 6, 0, 6]


def test_expected_pairs_of_sums(rng):
    """The closed sum over pairs against the sum itself."""
    for name in ("2D", "3D"):
        box, radius = BOXES[name], rng.uniform(0.1, 0.5, 30)
        d, edges = box.dimension, np.array([0.0, 1.0])
        _, below = radial.g_of_s(rng.random((30, 3)), radius, box, edges, np.arange(30) % 4, 4)
        sums = np.array([sum((radius[i] + radius[j])**d for j in range(30) if j != i) for i in range(30)])
        expected = radial.shell(edges[:1], edges[1:], d) * np.bincount(np.arange(30) % 4, sums) / box.volume
        np.testing.assert_allclose(below[:, 0], expected, rtol=1e-12)


def test_command_and_refusals(tmp_path):
    x, box = triangular(8)
    write_dump(tmp_path / "foam.lammpstrj", [(x[:100], np.full(100, 0.5), box), (x, np.full(len(x), 0.5), box)])
    analyse("radial", [str(tmp_path), "--most", "5", "--bins", "50", "--out", str(tmp_path / "g")])
    with open(tmp_path / "g.csv") as file:
        rows = list(csv.DictReader(file))
    r = np.array([float(row["r/<R>"]) for row in rows])
    g = np.array([float(row["g"]) for row in rows])
    assert np.all(g[r < 1.9] == 0) and g[(r > 1.9) & (r < 2.1)].sum() > 0 and len(x) == 128
    assert (tmp_path / "g.png").exists() and (tmp_path / "g.pdf").exists()
    with pytest.raises(SystemExit, match="--most must be below"):
        analyse("radial", [str(tmp_path), "--most", "9", "--out", str(tmp_path / "h")])
    walls = box_of([8, 8 * np.sqrt(3), 1], 2, periodic=(True, False, True))
    write_dump(tmp_path / "walls", [(x, np.full(len(x), 0.5), walls)])
    with pytest.raises(SystemExit, match="periodic in all directions"):
        analyse("radial", [str(tmp_path / "walls"), "--most", "3", "--out", str(tmp_path / "h")])
    assert not list(tmp_path.glob("h*"))


def test_without_freud(tmp_path, monkeypatch):
    import lammps_foam.analysis.frames as frames

    def refuse(name):
        raise ImportError(name)
    monkeypatch.setattr(frames, "import_module", refuse)
    x, box = triangular(8)
    write_dump(tmp_path / "foam.lammpstrj", [(x, np.full(len(x), 0.5), box)])
    with pytest.raises(SystemExit, match=r'needs the Python package freud: pip install "lammps-foam\[analysis\]"'):
        analyse("radial", [str(tmp_path), "--most", "5", "--out", str(tmp_path / "g")])
