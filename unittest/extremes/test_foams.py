"""Foams at the ends of what is possible: how much gas, which sizes, which box."""

import numpy as np
import pytest

from foams import SHORT
from runner import on_device
from scenes import INTEGRATORS, Scene, anywhere, cases, last, radii

PHI = [0.01, 0.3, 0.64, 0.84, 1.0, 1.3]


@cases("phi, dim, integrator", PHI, [2, 3], INTEGRATORS)
def test_gas_fraction(lmp, dim, phi, integrator):
    """From bubbles in chance positions: coarsening, with what the fix says of phi."""
    scene = anywhere(dim, 150, phi, integrator=integrator, kappa=1.0, run=300)
    result = scene(lmp)
    assert result.thermo[0]["f_gas[5]"] == pytest.approx(phi, rel=1e-12)
    assert result.thermo[0]["Time"][-1] > 10    # steps are not much shorter than springs relax


@cases("phi, dim, integrator", PHI, [2, 3], INTEGRATORS)
def test_relaxation(lmp, dim, phi, integrator):
    """At fixed radii energy never rises, and is gone where bubbles have room enough.

    A contact that opens may open a little too far, or another close: by the error allowed. N
    overlaps of that size, sigma0 <R_in> (tol <R_in>)^2 / (2 <R_in>) each, are what it may rise by.
    """
    tol = 1e-4
    scene = anywhere(dim, 100, phi, integrator=integrator, tol=tol, K=None, run=600, every=50, thermo=1)
    energy = scene(lmp).thermo[0]["PotEng"]
    assert np.diff(energy).max() <= 100 * tol**2
    if phi < 0.6:
        assert energy[-1] <= 100 * tol**2
    assert energy[-1] < 0.5 * energy[0]


# ---- sizes --------------------------------------------------------------------------------------

@cases("dim, kappa, integrator", [2, 3], [0.0, 1.0], INTEGRATORS)
def test_equal_bubbles(lmp, dim, kappa, integrator):
    """Without a spread of radii there is no exchange: 1/rho - 1/R is rounding."""
    scene = anywhere(dim, 100, 0.9, spread=0.0, kappa=kappa, K=1.0, integrator=integrator, run=200)
    end = last(scene(lmp))
    assert end["radius"] == pytest.approx(scene.R, rel=1e-13)    # 200 steps of 1e-16 each
    assert len(end) == 100


@cases("spread, dim, integrator", [0.01, 0.5, 1.0], [2, 3], INTEGRATORS)
def test_spread_of_radii(lmp, dim, spread, integrator):
    scene = anywhere(dim, 200, 0.9, spread=spread, integrator=integrator, run=400, K=0.1)
    result = scene(lmp)
    thermo, R = result.thermo[0], last(result)["radius"]
    assert R.max() > scene.R.max()
    if spread < 0.1:    # equal sizes part first: until the small are gone, the mean falls
        assert R.std() / R.mean() > scene.R.std() / scene.R.mean()
    else:
        assert thermo["f_gas[7]"][-1] > 0
        assert thermo["f_gas[3]"][-1] > 1.0


@cases("ratio, dim, integrator", [10, 100, 1000], [2, 3], INTEGRATORS)
def test_one_giant(lmp, dim, ratio, integrator):
    """Small bubbles on top of one that is up to 1000 times larger, in it and outside: it gets all
    gas in the end. Their size is what counts: the giant alone would be the mean of few."""
    random = np.random.default_rng(2)
    n = 60
    R = radii(random, n, 0.21)
    R[0] = ratio
    box = [4.0 * ratio] * dim
    x = random.normal(size=(n, dim))
    x *= ((ratio + random.uniform(-2, 2, n)) / np.linalg.norm(x, axis=1))[:, None]
    x[0] = 0.0
    scene = Scene(2.0 * ratio + x, R, box, integrator=integrator, rin=1.0, K=0.1,
                  gas="nmin 1", run=100000, every=20)
    end = last(scene(lmp))
    assert list(end["id"]) == [1]
    assert (end["radius"]**dim)[0] == pytest.approx((R**dim).sum(), rel=1e-12)


@cases("dim, n, integrator", [2, 3], [2, 3, 10, 50], INTEGRATORS)
def test_down_to_the_last(lmp, dim, n, integrator):
    """Through films and liquid, until one is left."""
    scene = anywhere(dim, n, 0.5, spread=0.5, seed=n, K=1.0, kappa=1.0, gas="nmin 1",
                     integrator=integrator, run=100000)
    result = scene(lmp)
    if "spans the box" not in result.screen:
        assert result.thermo[0]["Atoms"][-1] == 1


@cases("dim, n, integrator", [2, 3], [1, 2, 3], INTEGRATORS)
def test_few(lmp, dim, n, integrator):
    """They may run for ever: the last one stays."""
    scene = anywhere(dim, n, 0.1, spread=0.5, seed=n, K=1.0, kappa=1.0, integrator=integrator, run=2000,
                     every=100)
    thermo = scene(lmp).thermo[0]
    assert thermo["Atoms"][-1] == 1
    assert thermo["Step"][-1] == 2000


# ---- on top of each other -----------------------------------------------------------------------

@cases("dim, gas, integrator", [2, 3], [None, 0.1], INTEGRATORS)
def test_all_in_one_point(lmp, dim, gas, integrator):
    random = np.random.default_rng(3)
    R = radii(random, 40, 0.5)
    scene = Scene(np.full((40, dim), 7.5), R, [100.0] * dim, integrator=integrator, K=gas, run=200)
    result = scene(lmp)
    x = last(result).array("x", "y", "z")
    assert np.ptp(x[:, 0]) > 3.0
    # where nothing tells other directions from each other, nothing goes there
    assert np.all(x[:, 1:dim] == 7.5)


@cases("dim, gas, integrator", [2, 3], [None, 0.1], INTEGRATORS)
def test_nested(lmp, dim, gas, integrator):
    """Each bubble swallows the next, 2 times smaller."""
    n = 8
    R = 8.0 * 0.5**np.arange(n)
    x = np.full((n, dim), 30.0)
    x[:, 0] += 0.1 * R
    scene = Scene(x, R, [60.0] * dim, integrator=integrator, K=gas, rin=1.0, rmin=0.05,
                  run=3000, every=20)
    end = last(scene(lmp))
    if gas is None:    # all come out
        x = end.array("x", "y", "z")
        d = np.linalg.norm(x[:, None] - x, axis=2)
        apart = d - (R[:, None] + R)
        assert apart[~np.eye(n, dtype=bool)].min() > -3e-3    # but for the tolerance


# ---- boxes --------------------------------------------------------------------------------------

@cases("dim, gas, integrator", [2, 3], [None, 1e-2], INTEGRATORS)
def test_thinner_than_a_bubble(lmp, dim, gas, integrator):
    """The end of coarsening, at once; at fixed radii the foam relaxes."""
    shape = [1.0] * (dim - 1) + [0.01]
    scene = anywhere(dim, 40, 0.7, shape=shape, K=gas, integrator=integrator, run=200)
    assert scene.box[-1] < 2 * scene.R.max()
    result = scene(lmp)
    energy = result.thermo[0]["PotEng"]
    if gas is None:
        assert energy[-1] < energy[0]
    else:
        assert "spans the box" in result.screen and len(energy) == 1


@cases("dim, ranks, integrator", [2, 3], [1, 2], INTEGRATORS)
def test_long_box(lmp, dim, ranks, integrator):
    """1:1000, and on two ranks."""
    shape = [1000.0] + [1.0] * (dim - 1)
    scene = anywhere(dim, 3000, 0.9 if dim == 2 else 0.2, spread=0.1, shape=shape,
                     integrator=integrator, run=100, every=50, K=1e-3)
    assert scene.box[-1] > 2 * scene.R.max()
    thermo = scene(lmp, ranks=ranks).thermo[0]
    assert thermo["Step"][-1] == 100


# Runs that sums in another order leave the same within SHORT. The choice of the step multiplies rounding:
# with steps as long as foam/rkc may take, 2e-13 after 18 of them becomes 1e-3 after 58, at the same
# error. So none is longer than what accuracy allows at most times.
SHORT_RUN = {"run": 60, "dtmax": 0.1}


def images_apart(a, b, vectors):
    """Largest distance of the places a from b, up to lattice vectors (rows)."""
    d = np.linalg.solve(vectors.T, (a - b).T).T
    return np.abs((d - np.round(d)) @ vectors).max()


# boxes of one lattice: the sides of the second are sums of those of the first, c = c - b + a in the last
SAME_LATTICE = [(None, (1, 0, 0)), (None, (-3, 0, 0)), (None, (1, 2, -1)),
                ((0.5, -0.5, 0.5), (-0.5, 0, -0.5))]


@cases("dim, tilts, integrator", [2, 3], SAME_LATTICE, INTEGRATORS)
def test_triclinic(lmp, dim, tilts, integrator):
    """A lattice has many boxes: tilted by whole vectors the foam is the same."""
    plain = anywhere(dim, 60, 0.8, integrator=integrator, K=0.05, **SHORT_RUN)
    L = plain.box[0]
    scenes = [plain.but(tilt=tilt and tuple(t * L for t in (tilt if dim == 3 else (tilt[0], 0, 0))))
              for tilt in tilts]
    f, g = (last(scene(lmp)) for scene in scenes)
    assert np.array_equal(f["id"], g["id"])
    assert f["radius"] == pytest.approx(g["radius"], rel=SHORT)
    columns, vectors = ["x", "y", "z"][:dim], L * np.eye(3)
    vectors[1, 0], vectors[2, 0], vectors[2, 1] = scenes[0].tilt or (0, 0, 0)
    assert images_apart(f.array(*columns), g.array(*columns), vectors[:dim, :dim]) < SHORT * L


@cases("dim, boundary, integrator", [2, 3], ["s s s", "m m m", "f f f", "p s f"], INTEGRATORS)
def test_not_periodic(lmp, dim, boundary, integrator):
    """A cluster that reaches no border does not know of what kind that is."""
    boundary = boundary if dim == 3 else boundary[:3] + " p"
    random = np.random.default_rng(4)
    R = radii(random, 30, 0.3)
    x = 50.0 + random.uniform(-4, 4, (30, dim))
    plain = Scene(x, R, [100.0] * dim, integrator=integrator, K=0.1, kappa=0.0, **SHORT_RUN)
    other = plain.but(boundary=boundary)
    f, g = (last(s(lmp)) for s in (plain, other))
    assert np.array_equal(f["id"], g["id"])
    for column in ("x", "y", "z", "radius"):
        assert f[column] == pytest.approx(g[column], rel=SHORT), column


@cases("integrator", INTEGRATORS)
def test_own_images_in_a_small_tilted_box(lmp, integrator):
    """A thin box in units of a thousandth: right with lists that the pair style makes, and with newton off; where
    LAMMPS' lists would count contacts with the own images twice, refused."""
    scene = anywhere(3, 12, 1.0, shape=[1.0, 1.0, 0.05], K=None, integrator=integrator, run=30,
                     before="newton off")
    scene = scene.but(tilt=(0.3 * scene.box[0], 0.0, 0.0))
    assert scene.box[2] < 2 * scene.R.min()
    small, on = scene.scaled(2.0**-10), scene.scaled(2.0**-10).but(before="newton on")
    a, b = last(scene(lmp)), last(small(lmp))
    assert np.array_equal(a.array("x", "y", "z"), b.array("x", "y", "z") * 2.0**10)
    if on_device(lmp):
        return    # neigh full of the KOKKOS package goes with newton off only
    c = last(on(lmp))
    assert c.array("x", "y", "z") == pytest.approx(b.array("x", "y", "z"), abs=SHORT * small.box[0])
    if not lmp.kokkos:
        result = on.but(neighbor="nsq")(lmp, check=False)
        assert result.returncode > 0 and "newton" in result.errors[0]


CHANGES = {"shear": "xy variable v_shift v_rate", "squash": "x scale 0.02",
           "press": "x scale 0.1 y scale 0.1", "blow up": "x scale 10 y scale 10"}


@cases("change, integrator", CHANGES, INTEGRATORS)
def test_moving_box(lmp, change, integrator):
    """Sheared 12 times its width, blown up, squashed until bubbles span the box: gas stays."""
    fix = f"""
variable shift equal 0.5*f_step[1]*ly
variable rate equal 0.5*ly
fix box all deform 1 {CHANGES[change]} remap x"""
    scene = anywhere(2, 100, 0.9, K=1e-3, integrator=integrator, run=500, every=50, dtmax=0.05,
                     tilt=(0, 0, 0), after=fix, box_moves=True)
    result = scene(lmp)
    assert ("spans the box" in result.screen) == (change in ("squash", "press"))


def test_box_without_width(base_lmp):
    """One bubble in a box that shrinks around it: a clear stop, that names the way out."""
    alone = Scene([[5.0, 5.0]], [1.0], [10.0, 10.0], boundary="s s p", K=None)
    result = alone(base_lmp, check=False)
    assert result.returncode > 0
    assert "boundary m" in result.errors[0] and "nsq" in result.errors[0]
    for way_out in alone.but(boundary="m m p"), alone.but(neighbor="nsq"):
        assert np.array_equal(last(way_out(base_lmp)).array("x", "y"), alone.x)


def test_lost(base_lmp):
    """Out of a fixed box: LAMMPS says so."""
    scene = Scene([[9.5, 5.0], [9.0, 5.0], [3.0, 3.0]], [1.0, 1.0, 1.2], [10.0, 10.0],
                  boundary="f f p", run=2000)
    result = scene(base_lmp, check=False)
    assert result.returncode > 0
    assert "Lost atoms" in result.errors[0]
