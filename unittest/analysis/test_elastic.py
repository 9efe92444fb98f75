"""Pressure and moduli: lattices with known moduli, and packings strained and relaxed again by another minimizer."""

import csv

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.optimize import minimize

from lammps_foam.analysis import elastic
from lammps_foam.analysis.pairs import Pairs, close_pairs
from lammps_foam.analysis.read import Box
from lammps_foam.command import analyse
from test_contacts import box_of, lattice, triangular, write_dump


def found_in(x, radius, box, spring=1.0):
    pairs = close_pairs(x, radius, box)
    return elastic.moduli(pairs, spring, len(x), box), pairs


@pytest.mark.parametrize("overlap", [1e-6, 0.1])
def test_triangular_lattice(overlap):
    """Central springs k at distance a with tension t = -f/a have mu = sqrt(3)/4 (k - 3 f/a) in simple shear at constant
    volume, derived from E'' = sum over the bonds of k n_x^2 n_y^2 a^2 - (f/a) n_y^4 a^2 over the area of a cell; bulk
    modulus sqrt(3)/2 (k + f/a), from p = sqrt(3) f/a; the lattice relaxes nothing."""
    x, box = triangular(4)
    k = 1 / (1 + overlap)
    f = k * overlap
    found, pairs = found_in(x, np.full(len(x), (1 + overlap) / 2), box)
    p = elastic.pressure(pairs, 1.0, box)
    assert p == pytest.approx(np.sqrt(3) * f, rel=1e-9)    # distances to 1e-16, overlaps to 1e-16 / 1e-6
    np.testing.assert_allclose(found.shears, np.sqrt(3) / 4 * (k - 3 * f), rtol=1e-9)    # isotropic
    # p(a) = sqrt(3) k (s - a) / a with s the sum of the radii; V ~ a^2: B = -(a/2) dp/da = sqrt(3)/2 k s / a
    assert found.bulk == pytest.approx(np.sqrt(3) / 2 * (k + f), rel=1e-9)
    assert elastic.residual(pairs, 1.0, len(x)) < 1e-8 and found.bubbles == len(x)


def test_cubic_lattices():
    """Affine sums over the 6 or 12 bonds of sc and fcc, by hand, with little overlap; sc has no c44 but -p."""
    s, a = 1e-7, 1.0
    fcc = lattice((3, 3, 3), [(0, 0, 0), (0.5, 0.5, 0), (0.5, 0, 0.5), (0, 0.5, 0.5)], np.sqrt(2) * np.eye(3))
    found, _ = found_in(fcc, np.full(len(fcc), (a + s) / 2), box_of(3 * [3 * np.sqrt(2)], 3))
    # density sqrt(2), 6 bonds per sphere: c44 = c12 = k / (a sqrt 2), c11 = 2 c44 (Cauchy): (c11 - c12) / 2 = c44 / 2
    c44 = 1 / np.sqrt(2)
    np.testing.assert_allclose(sorted(found.shears), sorted([c44] * 3 + [c44 / 2] * 2), rtol=1e-5)    # ~ s
    assert found.bulk == pytest.approx((2 * c44 + 2 * c44) / 3, rel=1e-5)
    sc = lattice((4, 4, 4), [(0, 0, 0)], np.eye(3))
    overlap = 0.01
    found, pairs = found_in(sc, np.full(64, (1 + overlap) / 2), box_of([4, 4, 4], 3))
    k, f = 1 / (1 + overlap), overlap / (1 + overlap)
    p = elastic.pressure(pairs, 1.0, box_of([4, 4, 4], 3))
    assert p == pytest.approx(f, rel=1e-12)
    assert found.bulk == pytest.approx((k + 2 * p) / 3, rel=1e-9)    # -(a/3) dp/da, p = k (s - a) / a^2
    assert np.sort(found.shears)[:3] == pytest.approx(-p, rel=1e-9)    # unstable: x -> x + e y pulls bonds long
    assert np.sort(found.shears)[3:] == pytest.approx(k / 2 - p / 2, rel=1e-9)
    assert found.lowest < 0


def random_packing(d, n, phi, seed, tilt=0.0):
    rng = np.random.default_rng(seed)
    radius = rng.uniform(0.7, 1.3, n)
    gas = np.pi * radius**2 if d == 2 else 4 / 3 * np.pi * radius**3
    L = (gas.sum() / phi) ** (1 / d)
    box = box_of([L, L, L if d == 3 else 1.0], d, (tilt * L, 0, 0))
    x = rng.random((n, 3)) @ box.edges
    if d == 2:
        x[:, 2] = 0
    return elastic.relaxed(x, radius, box, 1.0, rest=1e-11), radius, box


def rest_energy(x, radius, box, near):
    """Energy at rest by scipy's trust-region Newton with a list of neighbours; another minimizer than the module's."""
    d, n = box.dimension, len(x)

    def pairs_at(u):
        move = np.zeros((n, 3))
        move[:, :d] = u.reshape(n, d)
        return Pairs(near.i, near.j, near.vector + move[near.i] - move[near.j], near.sums)

    def value(u):
        now = pairs_at(u)
        return elastic.energy(now, 1.0), -elastic.net_forces(now, 1.0, n)[:, :d].ravel()
    found = minimize(value, np.zeros(n * d), jac=True, method="BFGS", options={"gtol": 1e-13, "maxiter": 3000})
    return found.fun


def strained(x, radius, box, A, e):
    """The list of neighbours of the packing, with all vectors deformed by exp(e A)."""
    near = close_pairs(x, radius, box, 1.15)
    F = np.eye(3)
    F[:len(A), :len(A)] = expm(e * A)
    return Pairs(near.i, near.j, near.vector @ F.T, near.sums)


@pytest.mark.parametrize("d, n, phi, tilt", [(2, 30, 0.95, 0.0), (2, 30, 0.92, 0.3), (3, 24, 0.80, 0.0)])
def test_moduli_by_straining_and_relaxing(d, n, phi, tilt):
    """Second differences of the energy at rest of a disordered packing, deformed and relaxed by another minimizer.

    Strain 1e-5: no contact opens or closes; truncation ~ strain^2, rounding of E: 1e-16 E / (e^2 V G) ~ 1e-5.
    """
    x, radius, box = random_packing(d, n, phi, 4, tilt)
    found, pairs = found_in(x, radius, box)
    assert elastic.residual(pairs, 1.0, n) < 1e-9 and found.lowest > 0 and found.bubbles > n / 2
    e = 2e-5
    for A, modulus in [*zip(elastic.directions(d), found.shears), (np.eye(d), None)]:
        energies = [rest_energy(x, radius, box, strained(x, radius, box, A, step)) for step in (-e, 0, e)]
        second = (energies[0] - 2 * energies[1] + energies[2]) / e**2
        first = (energies[2] - energies[0]) / (2 * e)
        p = elastic.pressure(pairs, 1.0, box)
        if modulus is None:
            assert first == pytest.approx(-d * p * box.volume, rel=1e-6)    # -dE/dV
            assert found.bulk == pytest.approx(second / (d**2 * box.volume) + p, rel=2e-3)
        else:
            assert modulus == pytest.approx(second / box.volume, rel=2e-3, abs=1e-5)


def test_rattlers_and_symmetry():
    """A loose bubble, a shift through the faces, other units and a tilt by a whole box change nothing."""
    x, radius, box = random_packing(2, 40, 0.95, 5)
    found, pairs = found_in(x, radius, box)
    moved, _ = found_in(x + [3.3, -7.1, 0], radius, box)
    tilted = Box(box.lo, box.hi, np.array([box.lengths[0], 0, 0]), box.periodic, 2)
    around, _ = found_in(x, radius, tilted)
    big, _ = found_in(10 * x, 10 * radius, box_of(10 * box.lengths, 2), spring=3.0)
    for other, factor in ((moved, 1), (around, 1), (big, 0.3)):
        np.testing.assert_allclose(other.shears, factor * found.shears, rtol=1e-6)
        assert other.bulk == pytest.approx(factor * found.bulk, rel=1e-6)
    gap = np.argmax([np.min(np.linalg.norm(box.minimum_image(x - place), axis=1) - radius)
                     for place in np.random.default_rng(0).random((4000, 3)) * [*box.lengths[:2], 0]])
    place = (np.random.default_rng(0).random((4000, 3)) * [*box.lengths[:2], 0])[gap]
    more, _ = found_in(np.vstack([x, place]), np.append(radius, 0.01), box)
    np.testing.assert_allclose(more.shears, found.shears, rtol=1e-9)
    assert more.bubbles == found.bubbles


def test_nothing_holds():
    box = box_of([10, 10, 1], 2)
    x, radius = np.array([[1.0, 1, 0], [5, 5, 0]]), np.ones(2)
    found, pairs = found_in(x, radius, box)
    assert found.shear == 0 and found.bulk == 0 and elastic.pressure(pairs, 1.0, box) == 0
    assert np.array_equal(elastic.relaxed(x, radius, box, 1.0), x)


def test_directions_are_shears_of_one_size():
    for d in (2, 3):
        shears = elastic.directions(d)
        assert len(shears) == (2 if d == 2 else 5)
        for A in shears:
            sym = (A + A.T) / 2
            assert np.trace(A) == pytest.approx(0, abs=1e-15) and np.sum(sym**2) == pytest.approx(0.5)


def test_command(tmp_path, capsys):
    for run in ("a", "b"):
        (tmp_path / run).mkdir()
        x, radius, box = random_packing(2, 25, 0.95, ord(run))
        write_dump(tmp_path / run / "foam.lammpstrj", [(x, radius, box)])
        (tmp_path / run / "series.csv").write_text(f"step,tau,R\n0,0.5,{float(radius.mean() / 2)!r}\n")
    runs = [str(tmp_path / "a"), str(tmp_path / "b")]
    analyse("elastic", [*runs, "--out", str(tmp_path / "e")])
    with open(tmp_path / "e.csv") as file:
        rows = list(csv.DictReader(file))
    x, radius, box = random_packing(2, 25, 0.95, ord("b"))
    assert float(rows[1]["p"]) == pytest.approx(elastic.pressure(close_pairs(x, radius, box), 2.0, box), rel=1e-6)
    assert "means over 2 runs" in capsys.readouterr().out
    (tmp_path / "a" / "series.csv").unlink()
    with pytest.raises(SystemExit, match="<R_in> is not known.*give --rin"):
        analyse("elastic", [*runs, "--out", str(tmp_path / "f")])
    with pytest.raises(SystemExit, match="lacks the column sxx"):
        analyse("elastic", [*runs, "--rin", "1", "--stress", "sxx", "syy", "--out", str(tmp_path / "f")])
    assert not list(tmp_path.glob("f*"))
