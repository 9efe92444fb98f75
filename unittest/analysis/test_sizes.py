"""Sizes: the closed forms solve their equations, and averages and errors are those of known samples."""

import numpy as np
import pytest
from scipy.integrate import trapezoid

from lammps_foam.analysis import sizes
from written import dump_text, lammps_foam

BOTH = pytest.mark.parametrize("theory", sizes.THEORIES)
DIMENSIONS = pytest.mark.parametrize("dimension", [2, 3])
POWER = {"lsw": 1, "lemlich": 0}    # dR/dt = R^-m (1/R_c - 1/R)
GAMMA = {"lsw": 4 / 27, "lemlich": 1 / 4}


@BOTH
@DIMENSIONS
def test_normalised(theory, dimension):
    assert sizes.theory_moment(theory, 0, dimension) == pytest.approx(1, abs=1e-9)    # quadrature
    for density, end in ((sizes.density_over_mean, 3), (sizes.volume_density, 3**dimension)):
        w = np.geomspace(1e-12, end, 200_001)
        assert trapezoid(density(theory, w, dimension) * w, np.log(w)) == pytest.approx(1, abs=1e-6)
        mean = trapezoid(density(theory, w, dimension) * w**2, np.log(w))
        assert mean == pytest.approx(1, abs=1e-6)    # of R/<R>, and of V/<V>


@BOTH
@DIMENSIONS
def test_critical_radius_conserves_gas(theory, dimension):
    """sum R^(d-1) dR/dt = 0: R_c = <R^(d-1-m)> / <R^(d-2-m)>, which is 1 in units of R_c. For lemlich in 3D this is
    <R^2>/<R>, for lsw in 3D <R>."""
    m = POWER[theory]
    above, below = (sizes.theory_moment(theory, dimension - k - m, dimension) for k in (1, 2))
    assert above / below == pytest.approx(1, abs=1e-8)


@BOTH
@DIMENSIONS
def test_continuity(theory, dimension):
    """d(f v)/dz = d f, by central differences: their error is h^2/6 of a third derivative of order 100 = 2e-9."""
    z, h = np.linspace(0.05, sizes.END[theory] - 0.1, 300), 1e-5
    flux = [sizes.density(theory, z + s * h, dimension) * sizes.velocity(theory, z + s * h) for s in (-1, 1)]
    left = (flux[1] - flux[0]) / (2 * h)
    np.testing.assert_allclose(left, dimension * sizes.density(theory, z, dimension), atol=1e-7)


@BOTH
def test_velocity_is_the_law(theory):
    """v = z^-m (1 - 1/z)/gamma - z, with a zero at the end."""
    z = np.linspace(0.1, sizes.END[theory] - 0.01, 50)
    law = z ** -POWER[theory] * (1 - 1 / z) / GAMMA[theory] - z
    np.testing.assert_allclose(sizes.velocity(theory, z), law, rtol=1e-10)
    end = sizes.END[theory]
    assert end ** -POWER[theory] * (1 - 1 / end) / GAMMA[theory] - end == pytest.approx(0, abs=1e-12)


@BOTH
@DIMENSIONS
def test_bubbles_of_the_theory_stay_it(theory, dimension):
    """Bubbles of the density grow by the law; R_c is that which conserves gas. What is left has the density."""
    m, n = POWER[theory], 20_000
    z = np.linspace(0, sizes.END[theory], 20_001)
    share = np.cumsum(sizes.density(theory, z, dimension))
    start = np.interp((np.arange(n) + 0.5) / n, share / share[-1], z)
    V, dt = start**dimension, 5e-4
    while len(V) > n / 2:    # Euler: its error is of order dt
        R = V ** (1 / dimension)
        Rc = np.sum(R ** (dimension - 1 - m)) / np.sum(R ** (dimension - 2 - m))
        V = V + dt * dimension * R ** (dimension - 1 - m) * (1 / Rc - 1 / R)
        V = V[V > 0]
    late, expected = V ** (1 / dimension), sizes.theory_moments(theory, dimension)
    assert late.mean() / start.mean() == pytest.approx(2 ** (1 / dimension), rel=0.02)    # gas is conserved
    # spread, and <R^2>/<R>^2 to <R^3>^(1/3)/<R>; 1 % of each for the steps
    np.testing.assert_allclose(sizes.moments(late)[[0, 2, 3, 4, 5]], expected[[0, 2, 3, 4, 5]], rtol=0.01)


@pytest.mark.parametrize(("theory", "dimension", "spread", "skewness"), [
    ("lsw", 3, 0.243, -0.59), ("lemlich", 2, 0.356, -0.23), ("lemlich", 3, 0.372, -0.10)])
def test_mean_field_from_a_normal_start(theory, dimension, spread, skewness, rng):
    """The numbers of doc/analysis.rst: 10 000 bubbles, sd 0.21, averages while 2500 to 700 are left. Means over
    five starts, which scatter by 0.005 and 0.05; limits are three times that."""
    m, found, next_N = POWER[theory], [], 2500.0
    V = np.abs(rng.normal(1, 0.21, 10_000)) ** dimension
    while len(V) > 700:
        R = V ** (1 / dimension)
        if len(V) <= next_N:
            found.append(sizes.moments(R)[:2])
            next_N = len(V) / 1.2
        Rc = np.sum(R ** (dimension - 1 - m)) / np.sum(R ** (dimension - 2 - m))
        dt = 4e-3 * R.mean() ** (2 + m)    # the foam's own time
        V = V + dt * dimension * R ** (dimension - 1 - m) * (1 / Rc - 1 / R)
        V = V[V > 1e-3]
    mean = np.mean(found, axis=0)
    assert mean[0] == pytest.approx(spread, abs=0.015) and mean[1] == pytest.approx(skewness, abs=0.15)


def test_known_values():
    """LSW in 3D: <R> = R_c (exact), density 0 from 3/2 on, its maximum 2.15 at 1.135 as the papers plot it."""
    z = np.linspace(0, 1.5, 3001)
    f = sizes.density("lsw", z, 3)
    assert sizes.theory_moment("lsw", 1, 3) == pytest.approx(1, abs=1e-9)
    assert z[np.argmax(f)] == pytest.approx(1.135, abs=2e-3) and f.max() == pytest.approx(2.15, abs=0.02)
    assert sizes.density("lsw", np.array([1.5, 2, -1]), 3).tolist() == [0, 0, 0]
    assert sizes.theory_moment("lemlich", 1, 3) == pytest.approx(8 / 9, abs=1e-9)


# ---------------------------------------------------------------- measured

def test_moments_of_equal_and_two_sizes():
    np.testing.assert_allclose(sizes.moments(np.full(5, 3.0)), [0, np.nan, 1, 1, 1, 1, 0, 1], atol=1e-12)
    R = np.array([1.0, 1.0, 1.0, 5.0])    # mean 2, variance 3, third moment (3 (-1) + 27)/4 = 6
    root = np.cbrt(32)                     # <R^2> = 7, <R^3> = 32
    expected = [np.sqrt(3) / 2, 6 / 3**1.5, 7 / 4, 32 / 7 / 2, np.sqrt(7) / 2, root / 2, root**2 / 7 - 1, 2.5]
    np.testing.assert_allclose(sizes.moments(R), expected, rtol=1e-12)


@BOTH
def test_moments_of_theory_against_a_sample(theory, rng):
    z = np.linspace(0, sizes.END[theory], 100_001)
    share = np.cumsum(sizes.density(theory, z, 3))
    sample = np.interp(rng.random(400_000), share / share[-1], z)
    expected = sizes.theory_moments(theory, 3)
    # the counting error is 1/sqrt(400 000) = 2e-3, of the skewness sqrt(6) times that
    np.testing.assert_allclose(sizes.moments(sample)[:-1], expected[:-1], atol=1e-2)
    assert sizes.moments(sample)[-1] < expected[-1] + 0.01


def test_histogram_counts_all():
    """What lies beyond the bins counts in the norm."""
    np.testing.assert_allclose(sizes.histogram(np.array([0.5, 1.5, 9.0, 0.6]), np.array([0.0, 1, 3])), [0.5, 0.125])


def test_apart():
    assert sizes.apart([1000, 900, 800, 500, 450, 400, 300], 1.5) == [2, 4, 6]    # from the end: 300, 450, 800
    assert sizes.apart([5], 1.5) == [0]


def test_average_over_runs_and_frames():
    runs = [[np.array([1.0]), np.array([3.0])], [np.array([4.0])]]
    both = sizes.average(runs, [], [])
    assert both.mean == 3 and both.error == pytest.approx(np.std([2, 4], ddof=1) / np.sqrt(2))
    one = sizes.average(runs[:1], [np.array([1.0]), np.array([2.0])], [4, 1])
    assert one.mean == 2 and one.error == pytest.approx(np.sqrt(1 + 4 + 2 * 2 / 2) / 2)
    assert sizes.average(runs[1:], [np.array([0.25])], [9]).error == 0.25


def test_error_of_one_run_whose_frames_share_their_bubbles(rng):
    """A run that loses bubbles at random: means over its frames scatter as is said. 400 runs give a standard deviation
    to 3.5 %, here 4 of these. The scatter of the frames, which forgets what they share, is a quarter of it."""
    counts = [1000, 770, 590, 450, 350]
    runs = np.array([[np.mean(R[:n]) for n in counts] for R in rng.gamma(4, 0.25, (400, 1000))])
    each = np.array([0.5 / np.sqrt(n) for n in counts])    # the gamma distribution has a standard deviation of 0.5
    assert sizes.error_of_one_run(each, np.array(counts)) == pytest.approx(runs.mean(axis=1).std(), rel=0.14)


def test_bootstrap_is_the_counting_error(rng):
    """That of the spread of n normal numbers is 1/sqrt(2 n) of it; 200 samples give it to 5 %, here 4 of these."""
    R = rng.normal(1, 0.1, 2000)
    _, _, errors = sizes.bootstrap_error(R, 3, [np.linspace(0, 3, 31), np.linspace(0, 9, 31)])
    assert errors[0] == pytest.approx(0.1 / np.sqrt(4000), rel=0.2)


def dump(path, radii, dimension):
    depth = (-0.5, 0.5) if dimension == 2 else (0, 10)
    frames = [(step, [[n + 1, n % 10, n // 10 % 10, 0 if dimension == 2 else n % 7, r] for n, r in enumerate(R)])
              for step, R in enumerate(radii)]
    path.write_text(dump_text(frames, ["id", "x", "y", "z", "radius"], box=((0, 10), (0, 10), depth)))


@DIMENSIONS
def test_command(tmp_path, dimension, capsys, rng):
    for seed in range(2):
        radii = [rng.lognormal(0, 0.3, n) for n in (1000, 240, 150)]
        (tmp_path / f"seed{seed}").mkdir()
        dump(tmp_path / f"seed{seed}" / "foam.lammpstrj", radii, dimension)
    assert lammps_foam("sizes", tmp_path / "seed0", tmp_path / "seed1", "--out", tmp_path / "s") == 0
    said = capsys.readouterr().out
    assert f"4 frames of 2 run(s) in {dimension}D, of 240 to 150 bubbles; standard errors from the scatter of 2" in said
    for end in (".csv", "-moments.csv", ".pdf", ".png"):
        assert (tmp_path / f"s{end}").stat().st_size > 100
    table = np.genfromtxt(tmp_path / "s.csv", delimiter=",", names=True)
    for of in "RV":    # no bubble lies outside of the bins
        assert np.sum(table[f"P_{of}"]) * (table[of][1] - table[of][0]) == pytest.approx(1, abs=1e-8)


@pytest.mark.parametrize(("arguments", "message"), [
    (["--N", 5, 2], "no frame with two bubbles or more in the range"),
    (["--tau", 5, 2], "needs a series.csv"),
    (["--bins", 1], "--bins 1 must be 2 or more"),
])
def test_wrong_arguments(tmp_path, arguments, message, rng):
    dump(tmp_path / "foam.lammpstrj", [rng.random(50) + 1], 2)
    with pytest.raises(SystemExit, match=message):
        lammps_foam("sizes", tmp_path, *arguments, "--out", tmp_path / "out")
    assert not list(tmp_path.glob("out*"))
