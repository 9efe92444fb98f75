"""Exponents of growth: of exact power laws, with an origin, and whether the errors are those of many runs."""

import numpy as np
import pytest

from lammps_foam.analysis import growth
from lammps_foam.analysis.read import Unusable
from written import lammps_foam, write_series

TAU = np.geomspace(0.01, 100, 4000)


def run(R, tau=TAU, N=None):
    return {"tau": tau, "R": R, "N": 1.0e4 * R**-2.0 if N is None else N}


def walks(count, beta, step, rng):
    """Runs whose ln R is a power law plus a random walk in ln tau: `step` is its deviation in one unit of ln tau."""
    h = np.diff(np.log(TAU))
    noise = np.concatenate([np.zeros((count, 1)), np.cumsum(rng.normal(0, step * np.sqrt(h), (count, len(h))), 1)], 1)
    return [run(TAU**beta * np.exp(row)) for row in noise]


@pytest.mark.parametrize("beta", [1 / 4, 1 / 3, 1 / 2, 0.0])
def test_power_law(beta):
    """Without noise: the exponent to rounding (interpolation is exact for a line), and no error."""
    whole = growth.fit([run(2.5 * TAU**beta)], 1, 100)
    assert whole.beta == pytest.approx(beta, abs=1e-10)
    assert whole.beta_error < 1e-10


@pytest.mark.parametrize(("n", "k", "start"), [(2, 0.13, 1.0), (3, 0.4, 1.0), (2, 0.13, 2.0)])
def test_origin(n, k, start):
    """R^n = R0^n + k tau: found to the tolerance of the fit (1e-8) and of interpolation between 4000 lines (1e-6)."""
    whole = growth.fit([run((start**n + k * TAU) ** (1 / n))], 1, 100)
    np.testing.assert_allclose(whole.origin, [n, -start**n / k, k], rtol=2e-4)
    late = growth.fit([run((start**n + k * TAU) ** (1 / n))], 10, 100)
    tau0 = start**n / k
    assert 10 / (n * (10 + tau0)) < late.beta < 100 / (n * (100 + tau0))    # the slope lies between those at the ends


def test_origin_makes_local_slopes_flat():
    n, k = 2, 0.5
    runs = [run((1 + k * TAU) ** (1 / n))]
    windows = growth.windows_of(runs, 0.5, 1, 100, by_N=False)
    biased = growth.local_exponents(runs, windows)["beta"]
    flat = growth.local_exponents(runs, windows, origin=-1 / k)["beta"]
    assert biased[0] < 0.4 and np.all(np.diff(biased) > 0)
    np.testing.assert_allclose(flat, 1 / n, atol=1e-5)    # interpolation


def test_units_of_R_and_tau_do_not_matter():
    rng = np.random.default_rng(3)
    (one,) = walks(1, 0.4, 0.05, rng)
    a = growth.fit([one], 1, 100)
    b = growth.fit([run(7 * one["R"], TAU * 1000)], 1000, 100_000)
    assert b.beta == pytest.approx(a.beta, rel=1e-9) and b.beta_error == pytest.approx(a.beta_error, rel=1e-6)


def test_error_of_one_run_is_the_scatter_of_many(rng):
    """The bootstrap's error against the scatter of 200 runs. A random walk gives it to 10 %: (1) the scatter of 200 is
    known to 5 %, (2) the mean of 200 errors, each known to a third (8 blocks), to 2.5 %; a few per cent of bias are
    left to blocks. The error of least squares, from the residuals, would be five times too small."""
    runs = walks(200, 0.4, 0.05, rng)
    pieces = [growth.resample(one["tau"], one["R"], 1, 100) for one in runs]
    found = [growth.estimate(*piece) for piece in pieces]
    scatter = np.std([value[0] for value, _ in found], ddof=1)
    errors = np.array([error[0] for _, error in found])
    assert np.sqrt(np.mean(errors**2)) == pytest.approx(scatter, rel=0.2)
    naive = []
    for x, y in pieces:
        _, covariance = np.polyfit(x, y, 1, cov=True)
        naive.append(np.sqrt(covariance[0, 0]))
    assert np.mean(naive) < 0.35 * scatter


def test_error_with_memory_is_not_too_small(rng):
    """ln R that returns to the law within a time of one unit of ln tau, as <R> ~ tau^(1/2) does after a disturbance."""
    h = np.log(TAU[1] / TAU[0])
    noise = np.zeros((200, len(TAU)))
    kicks = rng.normal(0, 0.05 * np.sqrt(h), noise.shape)
    for n in range(1, len(TAU)):    # dx = -x dlnt + kicks
        noise[:, n] = noise[:, n - 1] * (1 - h) + kicks[:, n]
    found = [growth.estimate(*growth.resample(TAU, TAU**0.5 * np.exp(row), 1, 100)) for row in noise]
    scatter = np.std([value[0] for value, _ in found], ddof=1)
    assert 1.0 < np.sqrt(np.mean([error[0] ** 2 for _, error in found])) / scatter < 2.5


def test_errors_over_runs(rng):
    """With four runs and more the error is the standard error of their exponents."""
    runs = walks(9, 0.4, 0.05, rng)
    whole = growth.fit(runs, 1, 100)
    each = [growth.fit([one], 1, 100).beta for one in runs]
    assert whole.beta == pytest.approx(np.mean(each))
    assert whole.beta_error == pytest.approx(np.std(each, ddof=1) / 3)


def test_two_like_runs_are_no_proof(rng):
    """Two runs that agree by chance: the error stays that of their own bootstraps."""
    (one,) = walks(1, 0.4, 0.05, rng)
    assert growth.fit([one, one], 1, 100).beta_error == pytest.approx(growth.fit([one], 1, 100).beta_error / np.sqrt(2))


def test_crossover_shows_in_windows():
    """R = tau^(1/2), then tau^(1/3) from tau = 1: windows aside of it have those slopes, by tau and by N."""
    runs = [run(np.where(TAU < 1, TAU**0.5, TAU ** (1 / 3)))]
    for width, by_N in ((0.5, False), (2.0, True)):
        columns = growth.local_exponents(runs, growth.windows_of(runs, width, 0.02, 100, by_N))
        early, late = columns["tau"] < 0.4, columns["tau"] > 3
        assert early.sum() > 2 and late.sum() > 2
        np.testing.assert_allclose(columns["beta"][early], 1 / 2, atol=1e-9)
        np.testing.assert_allclose(columns["beta"][late], 1 / 3, atol=1e-9)


def test_windows_by_N_follow_each_run():
    """A run that is twice as slow has its windows at twice the tau, and the same exponent."""
    runs = [run(TAU**0.5), run((TAU / 2) ** 0.5)]
    (first, second), *_ = growth.windows_of(runs, 2.0, 1, 50, by_N=True)
    np.testing.assert_allclose(np.array(second) / first, 2, rtol=0.01)    # lines are 0.2 % of tau apart


@pytest.mark.parametrize(("start", "end"), [(50, 200), (0.001, 1), (1, 1.001)])
def test_range_beyond_the_data(start, end):
    with pytest.raises(Unusable, match="lines with tau > 0"):
        growth.fit([run(TAU**0.5)], start, end)


def test_command(tmp_path, capsys, rng):
    paths = []
    for number, one in enumerate(walks(3, 0.4, 0.02, rng)):
        (tmp_path / f"seed{number}").mkdir()
        paths.append(write_series(tmp_path / f"seed{number}" / "series.csv", step=np.arange(len(TAU)), **one))
    out = tmp_path / "a.b"
    assert lammps_foam("growth", *(path.parent for path in paths), "--tau", 1, 100, "--out", out) == 0
    assert "errors from the scatter of 3 runs, or the bootstrap" in capsys.readouterr().out
    for end in (".csv", "-fit.csv", ".pdf", ".png"):
        assert (tmp_path / f"a.b{end}").stat().st_size > 100
    names = (tmp_path / "a.b.csv").read_text().splitlines()[0]
    assert names == "tau,N,R,beta,error"
    assert not list(tmp_path.glob(".*"))    # nothing half-written is left


@pytest.mark.parametrize(("arguments", "message"), [
    (["--tau", 1, 500], "range of tau 1 to 500"),
    (["--N", 100, 1], "not all runs go from 100 to 1 bubbles"),
    (["--tau", 1, 2, "--N", 100, 50], "exclude each other"),
    (["--origin", "x"], "--origin x must be a value of tau, or fit"),
    (["--window", -1], "must be above 0"),
])
def test_wrong_arguments(tmp_path, arguments, message):
    write_series(tmp_path / "series.csv", **run(TAU**0.5))
    with pytest.raises(SystemExit, match=message):
        lammps_foam("growth", tmp_path, *arguments, "--out", tmp_path / "out")
    assert not list(tmp_path.glob("out*"))
