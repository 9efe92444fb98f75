"""Strange foams end in the right answer or in a clear error."""

import math
from fractions import Fraction

import numpy as np
import pytest

from runner import HEAD, PRECISE, data_file

OUTPUT = f"""
compute       b all foam/bubble contacts area vfilm vliquid espring
thermo_style  custom step atoms time pe f_step[*]
{PRECISE}
thermo        10
dump          d all custom 10 dump id x y z vx vy vz fx fy fz radius c_b[*]
dump_modify   d sort id format float %.17g
"""


def foam(dim=2, pair="", gas="1e-2 0.1", step="1e-3", before="", neighbor="0.3 bin", run="run 50"):
    gas = f"fix gas all foam/coarsen {gas}" if gas else ""
    return HEAD.format(dim=dim) + f"""
read_data     data
neighbor      {neighbor}
pair_style    durian/foam 1.0 {pair}
pair_coeff    * * 1.0
{gas}
fix           step all foam/abm {step}
{OUTPUT}
{before}
{run}
print         "reached the end"
"""


FOUR = [[3, 3], [4.5, 3], [7, 7], [7.5, 8]], [1, 1, 0.9, 1.1]


# ---- numbers that are none ----------------------------------------------------------------------

@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("radius", [0.0, -1.0])
@pytest.mark.parametrize("gas", ["1e-2 0.1", ""])
def test_radius_not_positive(lmp, radius, gas, ranks):
    x, R = FOUR
    result = lmp(foam(gas=gas), files={"data": data_file([10, 10], x, [1, 1, radius, 1])},
                 ranks=ranks, check=False)
    assert result.returncode > 0
    assert "foam/abm" in result.errors[0] and "radius of bubble 3 " in result.errors[0]


# a formula in LAMMPS that gives NaN without stopping there
NAN = "variable nan atom 10^400-10^400\nset atom 3 {} v_nan"


@pytest.mark.parametrize("what, words", [("diameter", ("foam/abm", "radius of bubble 3 ")),
                                         ("x", ("Non-numeric atom coords",)),
                                         ("y", ("Non-numeric atom coords",))])
def test_nan(lmp, what, words):
    x, R = FOUR
    result = lmp(foam(before=NAN.format(what)), files={"data": data_file([10, 10], x, R)},
                 check=False)
    assert result.returncode > 0
    for word in words:
        assert word in result.errors[0]


def test_infinite_radius(lmp):
    x, R = FOUR
    result = lmp(foam(before=NAN.format("diameter").replace("-10^400", "")),
                 files={"data": data_file([10, 10], x, R)}, check=False)
    assert result.returncode > 0
    assert "foam/abm" in result.errors[0] and "radius of bubble 3 " in result.errors[0]


def test_velocity_nan(lmp):
    """With static drag velocities are results, so a bad one before the run does no harm."""
    x, R = FOUR
    bad = lmp(foam(before=NAN.format("vx")), files={"data": data_file([10, 10], x, R)})
    good = lmp(foam(), files={"data": data_file([10, 10], x, R)})
    for column in ("x", "vx", "radius"):
        assert np.isfinite(bad.dump("dump")[-1][column]).all()
    # the start is not a continuation of anything in either run
    assert np.array_equal(bad.dump("dump")[-1]["x"], good.dump("dump")[-1]["x"])


def test_velocity_nan_with_neighbor_drag(lmp):
    """Here they are given: the error says where to look."""
    x, R = FOUR
    result = lmp(foam(before=NAN.format("vx"), pair="drag neighbor"),
                 files={"data": data_file([10, 10], x, R)}, check=False)
    assert result.returncode > 0
    assert "foam/abm" in result.errors[0] and "step 1," in result.errors[0]


def test_infinite_force(lmp):
    x, R = FOUR
    result = lmp(foam(before="fix a all addforce 1e308 0 0\nfix b all addforce 1e308 0 0"),
                 files={"data": data_file([10, 10], x, R)}, check=False)
    assert result.returncode > 0
    assert "foam/abm" in result.errors[0] and "step 1," in result.errors[0]


# ---- coincident, nested, alone ------------------------------------------------------------------

@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("dim", [2, 3])
def test_coincident(lmp, dim, ranks):
    """All centres at one point: the energy of full overlap, no NaN, then they come apart."""
    R = np.array([1.0, 1.0, 0.9, 1.1, 0.6])
    box = [10.0] * dim
    result = lmp(foam(dim, run="run 200", gas="0 0"), ranks=ranks,
                 files={"data": data_file(box, np.full((5, dim), 5.0), R)})
    first, last = result.dump("dump")[0], result.dump("dump")[-1]
    # U_ij = sigma0 <R_in> (R_i + R_j) / 2 for each of 10 pairs
    energy = R.mean() * 0.5 * 4 * R.sum()
    assert result.thermo[0]["PotEng"][0] == pytest.approx(energy, rel=1e-14)
    forces = first.array("fx", "fy", "fz")
    # F = sigma0 <R_in> in the direction of x, from the bubbles of lower number and of higher
    assert forces[:, 0] == pytest.approx(R.mean() * np.array([4, 2, 0, -2, -4]), abs=1e-14)
    assert np.all(forces[:, 1:] == 0.0)
    energy = result.thermo[0]["PotEng"]
    assert np.all(np.diff(energy)[energy[:-1] > 0] < 0)
    x = last.array("x", "y", "z")
    assert np.isfinite(x).all()
    # on a line, no pair of neighbors on it overlaps any more
    order = np.argsort(x[:, 0])
    assert np.all(np.diff(x[order, 0]) > (R[order][1:] + R[order][:-1]) - 1e-3)
    assert x[:, 0].mean() == pytest.approx(5.0, abs=1e-9)    # no force from outside


@pytest.mark.parametrize("ranks", [1, 2])
def test_nested(lmp, ranks):
    """A small bubble inside a large one touches it over its full cross-section, and gives its gas
    away until it vanishes."""
    x, R = [[5.0, 5.0], [5.2, 5.0]], [2.0, 0.5]
    result = lmp(foam(gas="1e-2 0", run="run 200"), files={"data": data_file([10, 10], x, R)},
                 ranks=ranks)
    first, last = result.dump("dump")[0], result.dump("dump")[-1]
    assert first["c_b[2]"] == pytest.approx([1.0, 1.0], rel=1e-15)    # 2 min(R)
    assert first["c_b[3]"] == pytest.approx([1e-2 * 1.5, -1e-2 * 1.5], rel=1e-14)
    # overlap 2.3, stiffness <R_in> = 1.25
    assert first["fx"] == pytest.approx([-1.25 * 2.3 / 2.5, 1.25 * 2.3 / 2.5], rel=1e-14)
    # if the large bubble took the other before that came out, one is left with all gas
    assert (last["radius"]**2).sum() == pytest.approx(4.25, rel=1e-14)
    assert np.all(last["radius"] > 0)


@pytest.mark.parametrize("ranks", [1, 4])
@pytest.mark.parametrize("dim", [2, 3])
def test_one_bubble(lmp, dim, ranks):
    """Nothing to exchange gas with: rho is its own radius; it stays as and where it is."""
    result = lmp(foam(dim), files={"data": data_file([10.0] * dim, [[5.0] * dim], [1.3])},
                 ranks=ranks)
    last = result.dump("dump")[-1]
    assert last["radius"] == pytest.approx([1.3], rel=1e-14)
    assert np.all(last.array("x", "y")[0] == 5.0)
    assert result.thermo[0]["Atoms"][-1] == 1
    assert result.thermo[0]["f_step[4]"][-1] == 0


def test_no_bubble(lmp):
    result = lmp(foam(), files={"data": data_file([10, 10], np.zeros((0, 2)), [])}, check=False)
    assert result.returncode > 0
    assert "durian/foam" in result.errors[0] and "no bubble" in result.errors[0]


def test_no_bubble_but_a_mean_radius(lmp):
    """Then there is nothing wrong, and nothing to do."""
    result = lmp(foam(pair="rin 1.0"), files={"data": data_file([10, 10], np.zeros((0, 2)), [])})
    assert "0 bubbles are left" in result.screen
    assert "reached the end" in result.screen


def test_all_below_rmin(lmp):
    x, R = FOUR
    result = lmp(foam(gas="1e-2 0.1 rmin 3"), files={"data": data_file([10, 10], x, R)},
                 check=False)
    assert result.returncode > 0
    assert "no bubbles are left" in result.errors[0] and "step 1," in result.errors[0]


def test_all_but_one_below_rmin(lmp):
    """The last bubble takes all gas."""
    x, _ = FOUR
    R = np.array([1.0, 0.05, 0.05, 0.04])
    result = lmp(foam(gas="1e-4 0.1 rmin 0.5"), files={"data": data_file([10, 10], x, R)})
    last = result.dump("dump")[-1]
    assert len(last) == 1
    assert last["radius"][0]**2 == pytest.approx((R**2).sum(), rel=1e-14)


@pytest.mark.parametrize("dim", [2, 3])
def test_rmin_zero(lmp, dim):
    """Bubbles may shrink away altogether; gas is kept and no radius is ever negative or NaN."""
    x = [[3, 3, 3], [4.5, 3, 3], [7, 7, 7], [7.5, 8, 7]]
    R = np.array([1, 0.5, 0.9, 0.3])
    result = lmp(foam(dim, gas="1e-2 1.0 rmin 0", run="run 1500"),
                 files={"data": data_file([10.0] * dim, np.array(x)[:, :dim], R)})
    last = result.dump("dump")[-1]
    assert len(last) < 4
    assert (last["radius"]**dim).sum() == pytest.approx((R**dim).sum(), rel=1e-12)
    for frame in result.dump("dump"):
        assert np.all(frame["radius"] > 0)


# ---- too large ----------------------------------------------------------------------------------

def by_direct_sum(x, R, box, images):
    """Contacts, areas, film exchange, forces and energy over all images, by the formulae."""
    n, dim = x.shape
    grid = np.stack(np.meshgrid(*[np.arange(-images, images + 1)] * dim), -1).reshape(-1, dim) * box
    contacts, area, film = np.zeros(n), np.zeros(n), np.zeros(n)
    force, energy = np.zeros((n, dim)), 0.0
    for i in range(n):
        for j in range(n):
            d = x[i] - x[j] - grid
            r = np.sqrt((d**2).sum(1))
            touch = (r < R[i] + R[j]) & ((r > 0) | (i != j))
            d, r, both = d[touch], r[touch], R[i] + R[j]
            a = (r**2 + R[j]**2 - R[i]**2) / (2 * r)
            h = np.where(r**2 <= abs(R[i]**2 - R[j]**2), min(R[i], R[j]),
                         np.sqrt(np.maximum(R[j]**2 - a**2, 0)))
            A = (2 * h if dim == 2 else math.pi * h**2).sum()
            contacts[i] += len(r)
            area[i] += A
            film[i] += A * (1 / R[j] - 1 / R[i])
            force[i] += (R.mean() * (both - r) / both / r) @ d
            energy += (R.mean() * (both - r)**2 / (4 * both)).sum()
    return contacts, area, film, force, energy


@pytest.mark.parametrize("ranks", [1, 2, 4])
def test_larger_than_the_box(lmp, ranks):
    """A bubble that reaches its own images, and others several times over."""
    x = np.array([[5, 5], [1, 1.3], [3.0, 8.0], [6, 1.0]])
    R = np.array([27.0, 1.0, 7.0, 0.3])
    result = lmp(foam(run="run 0"), files={"data": data_file([10, 10], x, R)}, ranks=ranks)
    contacts, area, film, force, energy = by_direct_sum(x, R, 10.0, 8)
    frame = result.dump("dump")[0]
    assert np.array_equal(frame["c_b[1]"], contacts)
    # some hundred terms of one size: 1e-13
    assert frame["c_b[2]"] == pytest.approx(area, rel=1e-13)
    assert frame["c_b[3]"] == pytest.approx(1e-2 * film, rel=1e-13)
    assert frame.array("fx", "fy") == pytest.approx(force, abs=1e-13 * np.abs(area).max())
    assert result.thermo[0]["PotEng"][0] == pytest.approx(energy, rel=1e-13)


@pytest.mark.parametrize("ranks", [1, 2])
def test_spans_the_box(lmp, ranks):
    """Not coarsened: that is an end, not an error; without gas exchange it relaxes."""
    files = {"data": data_file([10, 10], [[5, 5], [1, 1.3]], [7.0, 1.0])}
    result = lmp(foam(), files=files, ranks=ranks)
    assert "spans the box" in result.screen and "reached the end" in result.screen
    assert list(result.thermo[0]["Step"]) == [0]
    result = lmp(foam(gas=""), files=files, ranks=ranks)
    energy = result.thermo[0]["PotEng"]
    assert energy[2] < energy[1] < energy[0]
    # at rest but for the error allowed, 1e-3 <R_in>, whose energy is of second order in it
    assert len(energy) == 6 and np.ptp(energy[2:]) < 1e-5 * energy[0]


# ---- extreme numbers ----------------------------------------------------------------------------

def test_huge_first_step(lmp):
    """It is refused until it is right."""
    x, R = FOUR
    files = {"data": data_file([10, 10], x, R)}
    huge = lmp(foam(step="1e-5 dt0 1e9", gas="", run="run 300"), files=files)
    small = lmp(foam(step="1e-5 dt0 1e-4", gas="", run="run 300"), files=files)
    a, b = huge.dump("dump")[-1], small.dump("dump")[-1]
    # both are relaxed: overlaps are gone but for some tolerance
    assert a.array("x", "y") == pytest.approx(b.array("x", "y"), abs=1e-4)


@pytest.mark.parametrize("gas", ["0 0.1", "1e-2 0", "0 0"])
def test_no_exchange_costs_no_change(lmp, gas):
    x, R = FOUR
    result = lmp(foam(gas=gas), files={"data": data_file([10, 10], x, R)})
    last = result.dump("dump")[-1]
    assert np.array_equal(last["radius"], R) == gas.startswith("0 ")
    assert np.array_equal(last["c_b[4]"], np.zeros(4))


def test_no_springs(lmp):
    """sigma0 = 0: gas moves, bubbles do not."""
    x, R = FOUR
    result = lmp(foam(before="pair_coeff * * 0.0", run="run 10"),
                 files={"data": data_file([10, 10], x, R)})
    last = result.dump("dump")[-1]
    assert np.array_equal(last.array("x", "y"), np.array(x, float))
    assert np.all(last["radius"] != R)


def test_radii_of_many_sizes(lmp):
    """R_max / R_min = 1e6, and a contact between them."""
    x, R = [[50.0, 50.0], [60.0 + 5e-6, 50.0]], [10.0, 1e-5]
    result = lmp(foam(gas="1e-3 0.1 rmin 0", run="run 0"),
                 files={"data": data_file([100, 100], x, R)})
    frame = result.dump("dump")[0]
    assert np.array_equal(frame["c_b[1]"], [1, 1])
    # the formulae in exact numbers, since the numbers read from the file are exact
    r = Fraction(x[1][0]) - Fraction(x[0][0])
    Ri, Rj = map(Fraction, R)
    a = (r**2 + Rj**2 - Ri**2) / (2 * r)
    area = 2 * math.sqrt(Rj**2 - a**2)
    force = (Ri + Rj) / 2 * (Ri + Rj - r) / (Ri + Rj)
    # R_i + R_j - r takes numbers of 10 to one of 5e-6: 1e-15 becomes 2e-9
    assert frame["fx"] == pytest.approx([-float(force), float(force)], rel=1e-8)
    assert frame["c_b[2]"] == pytest.approx([area, area], rel=1e-8)
    exchange = 1e-3 * area * float(1 / Rj - 1 / Ri)
    assert frame["c_b[3]"] == pytest.approx([exchange, -exchange], rel=1e-8)
