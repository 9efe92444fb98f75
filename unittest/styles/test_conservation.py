"""Gas is conserved while most bubbles vanish, and every bubble is accounted for."""

import numpy as np
import pytest

from runner import HEAD, PRECISE, data_file

RMIN = 0.1


def random_foam(dim):
    """Box, centres and radii: displaced from a grid, so dense that most bubbles touch."""
    rng = np.random.default_rng(7)
    sites, spacing = (20, 1.9) if dim == 2 else (8, 1.65)
    axis = (np.arange(sites) + 0.5) * spacing
    x = np.stack(np.meshgrid(*[axis] * dim, indexing="ij"), axis=-1).reshape(-1, dim)
    x += rng.uniform(-0.5, 0.5, x.shape)
    return [sites * spacing] * dim, x, rng.uniform(0.4, 1.6, len(x))


def coarsen(lmp, dim, gas="0.1 liquid area", step="abm 1e-3", pair="", every=10):
    """Coarsen until a tenth of the bubbles is left: radii before, thermo and frames of the run."""
    box, x, R = random_foam(dim)
    result = lmp(HEAD.format(dim=dim) + f"""
read_data     data
pair_style    durian/foam 1.0 {pair}
pair_coeff    * * 1.0
neighbor      0.5 bin
fix           gas all foam/coarsen 0.05 {gas} rmin {RMIN} nmin {len(R) // 10}
fix           step all foam/{step}
thermo        1
thermo_style  custom step atoms f_gas[2] f_gas[5] f_gas[7] f_gas[8]
{PRECISE}
dump          d all custom {every} dump id radius
dump_modify   d sort id format float %.17g
run           100000
""", files={"data": data_file(box, x, R)})
    return R, result.thermo[0], result.dump("dump")


def gas_of(frame, dim):
    return np.sum(frame["radius"]**dim)


# A step changes the sum of gas by the rounding of some hundred terms, 1e-15. Over a run that adds
# up to a few of them: 4e-15 measured after 1000 to 3000 steps.
EACH_STEP, IN_ALL = 1e-14, 1e-12


# A bubble that is used up within a step overshoots by what the tolerance allows.  With lsw in 3D the sum of removed
# gas, 2 at most, is 0.1 +- 0.1 with abm 1e-3 and -0.6 +- 0.1 with rkc 1e-4 (over all back ends); with those here 0.6
# and 0.8.
ALL = [(dim, gas, "abm 1e-3") for dim in (2, 3)
       for gas in ("0.1 liquid area", "0.1 liquid lsw", "0.0", "0.3 film no")
       if (dim, gas) != (3, "0.1 liquid lsw")]
ALL += [(3, "0.1 liquid lsw", "abm 3e-4"), (3, "0.1 liquid lsw", "rkc 1e-5"),
        (2, "0.1 liquid area", "rkc 1e-3")]


@pytest.mark.parametrize("dim, gas, step", ALL)
def test_gas_and_bubbles_are_conserved(each_lmp, dim, gas, step):
    R, thermo, frames = coarsen(each_lmp, dim, gas, step)
    n = len(R)
    left, phi, removed, removed_gas = (thermo[f"f_gas[{k}]"] for k in (2, 5, 7, 8))
    assert left[-1] <= n // 10

    # every bubble is there or has been removed, and no dead one is to be seen
    assert np.array_equal(left + removed, np.full(len(left), n))
    assert np.array_equal(left, thermo["Atoms"])
    for frame in frames:
        assert len(frame) == left[frame.step]
        assert np.min(frame["radius"]) >= RMIN * np.mean(R)

    # the fix's own figure, in every step, and the radii themselves
    assert np.max(np.abs(phi / phi[0] - 1)) < IN_ALL
    for frame in frames:
        assert abs(gas_of(frame, dim) / np.sum(R**dim) - 1) < IN_ALL

    # a bubble that goes is smaller than rmin, and takes no more gas with it than that
    ball = np.pi if dim == 2 else 4 * np.pi / 3
    each = ball * (RMIN * np.mean(R))**dim
    assert np.all(np.diff(removed_gas) <= np.diff(removed) * each)
    assert 0 < removed_gas[-1] < removed[-1] * each


# (neighbor drag needs many more steps when the tolerance is tight)
@pytest.mark.parametrize("pair, step", [("drag static", "abm 1e-3"), ("drag neighbor", "abm 1e-2"),
                                        ("drag static", "rkc 1e-4")])
def test_rates_are_evaluated_again_after_a_removal(each_lmp, pair, step):
    """Rates from before a removal no longer add up to zero: the next step would lose gas.

    With `scheme source`, which keeps them, steps after removals change it by up to 1e-5.
    """
    _, thermo, _ = coarsen(each_lmp, 2, step=step, pair=pair)
    phi, removed = thermo["f_gas[5]"], thermo["f_gas[7]"]
    after = np.flatnonzero(np.diff(removed)) + 1
    after = after[after + 1 < len(phi)]
    assert len(after) > 100
    assert np.max(np.abs(phi[after + 1] - phi[after])) < EACH_STEP * phi[0]
    assert np.max(np.abs(np.diff(phi))) < EACH_STEP * phi[0]


def test_drift_of_the_options_kept_for_comparison(lmp):
    """`variable radius` and `scheme source` do not conserve gas, but stay within bounds.

    Measured, with nine tenths of the bubbles gone: radius 5e-5, source 6e-4.
    """
    def drift(step):
        R, thermo, _ = coarsen(lmp, 2, step=f"abm 1e-3 {step}", every=100000)
        assert np.all(thermo["f_gas[2]"] + thermo["f_gas[7]"] == len(R))
        return np.max(np.abs(thermo["f_gas[5]"] / thermo["f_gas[5]"][0] - 1))

    volume, radius = drift("variable volume"), drift("variable radius")
    source = drift("scheme source")
    print(f"drift of gas: volume {volume:.1e}, radius {radius:.1e}, source {source:.1e}")
    assert volume < IN_ALL
    assert 1e-7 < radius < 1e-3
    assert 1e-6 < source < 1e-2


# ---- a removal on its own -----------------------------------------------------------------------

@pytest.mark.parametrize("variable", ["volume", "radius"])
@pytest.mark.parametrize("dim", [2, 3])
def test_survivors_grow_in_proportion(lmp, dim, variable):
    """One bubble below rmin, no exchange: V -> V (1 + Vexcess / sum V) in the first step."""
    x = np.full((3, dim), 5.0)
    x[:, 0] = [2.0, 6.0, 12.0]
    R = np.array([0.3, 1.0, 2.0])
    result = lmp(HEAD.format(dim=dim) + f"""
read_data     data
pair_style    durian/foam 1.0
pair_coeff    * * 1.0
fix           gas all foam/coarsen 0.0 0.0 rmin 0.5
fix           step all foam/abm 1e-3 variable {variable}
thermo        1
thermo_style  custom step atoms f_gas[2] f_gas[3] f_gas[4] f_gas[7] f_gas[8]
{PRECISE}
dump          d all custom 1 dump id radius
dump_modify   d sort id format float %.17g
run           2
""", files={"data": data_file([16.0] * dim, x, R)})
    grown = R[1:] * (1 + 0.3**dim / (1 + 2.0**dim))**(1 / dim)
    for frame in result.dump("dump")[1:]:
        assert np.array_equal(frame["id"], [2, 3])
        assert np.allclose(frame["radius"], grown, rtol=1e-14, atol=0)

    thermo, mean = result.thermo[0], np.mean(R)
    assert np.array_equal(thermo["Atoms"], [3, 2, 2])
    assert np.array_equal(thermo["f_gas[2]"], [3, 2, 2])
    assert np.array_equal(thermo["f_gas[7]"], [0, 1, 1])
    assert thermo["f_gas[3]"][1] == pytest.approx(np.mean(grown) / mean, rel=1e-14)
    assert thermo["f_gas[4]"][1] == pytest.approx(grown[1] / mean, rel=1e-14)
    ball = np.pi if dim == 2 else 4 * np.pi / 3
    assert thermo["f_gas[8]"][1] == pytest.approx(ball * 0.3**dim, rel=1e-14)


@pytest.mark.parametrize("integrator", ["abm", "rkc"])
def test_contacts_after_a_removal(lmp, integrator):
    """Survivors that grow by the gas of many find new neighbors, also without exchange: two bubbles are
    pushed together, and reach each other as they do with an exchange too slow to see."""
    x = [[20, 50], [22.31, 50], [60, 90], *([10 + 4 * k, 10] for k in range(20))]
    R = [1.0] * 3 + [0.212] * 20
    frames = [lmp(HEAD.format(dim=2) + f"""
read_data     data
pair_style    durian/foam 1.0 rin 1.0
pair_coeff    * * 1.0
fix           gas all foam/coarsen {K} 0.0 rmin 0.5
group         a id 1
group         b id 2
fix           fa a addforce 1.0 0 0
fix           fb b addforce -1.0 0 0
fix           step all foam/{integrator} 10 dt0 0.001 dtmax 0.13 growth 500
run           3
write_dump    all custom dump id x radius modify sort id format float %.17g
""", files={"data": data_file([100, 100], x, R)}).dump("dump")[0] for K in (0, 1e-200)]
    for frame in frames:
        assert np.array_equal(frame["id"], [1, 2, 3])
    assert frames[0]["radius"] == pytest.approx(frames[1]["radius"], rel=1e-14)
    assert frames[0]["x"] == pytest.approx(frames[1]["x"], rel=1e-14)
    assert np.ptp(frames[0]["x"][:2]) < 2 * frames[0]["radius"][0]    # in contact by now


@pytest.mark.parametrize("rmin", [0.1, 0.0])
@pytest.mark.parametrize("dim", [2, 3])
def test_last_bubble_has_all_gas(lmp, dim, rmin):
    """Of two bubbles the larger swallows the smaller; rmin = 0 lets it shrink to nothing."""
    x = np.full((2, dim), 5.0)
    x[1, 0] = 6.0
    R = np.array([1.2, 0.8])
    result = lmp(HEAD.format(dim=dim) + f"""
read_data     data
pair_style    durian/foam 1.0
pair_coeff    * * 0.0
fix           gas all foam/coarsen 1.0 0.1 rmin {rmin} nmin 1
fix           step all foam/abm 1e-4
thermo        1
thermo_style  custom step f_gas[2] f_gas[5]
{PRECISE}
run           10000
write_dump    all custom dump id radius modify format float %.17g
""", files={"data": data_file([12.0] * dim, x, R)})
    frame = result.dump("dump")[0]
    assert np.array_equal(frame["id"], [1])
    assert frame["radius"][0] == pytest.approx(np.sum(R**dim)**(1 / dim), rel=1e-13)
    phi = result.thermo[0]["f_gas[5]"]
    assert np.max(np.abs(phi / phi[0] - 1)) < 1e-13
    assert "coarsening ended" in result.screen


@pytest.mark.parametrize("dim", [2, 3])
def test_radius_as_variable_without_rmin(lmp, dim):
    """With rmin 0 a bubble vanishes where Rdot is singular, and R of a trial overshoots far below
    0: that is no gas, neither positive (R^2) nor negative (R^3)."""
    box, x, R = random_foam(dim)
    result = lmp(HEAD.format(dim=dim) + f"""
read_data     data
pair_style    durian/foam 1.0
pair_coeff    * * 1.0
neighbor      0.5 bin
fix           gas all foam/coarsen 0.05 0.1 rmin 0 nmin {len(R) // 2}
fix           step all foam/abm 1e-4 variable radius
thermo        10
thermo_style  custom step f_gas[2] f_gas[5] f_gas[8]
{PRECISE}
run           100000
""", files={"data": data_file(box, x, R)})
    phi, gas = (result.thermo[0][f"f_gas[{k}]"] for k in (5, 8))
    assert gas.min() >= 0.0
    # counting the overshoot changed phi by 4 % (2D) and -4 % (3D); what remains is the error of the
    # last step of each bubble, whose R falls to 0 like a root: 1e-3 is well between
    assert np.abs(phi / phi[0] - 1).max() < 1e-3
