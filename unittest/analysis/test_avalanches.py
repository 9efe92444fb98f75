"""Avalanches: planted drops and spikes are found, with their sizes; coincidences by chance are called so."""

import numpy as np
import pytest

from lammps_foam.analysis import avalanches
from lammps_foam.analysis.read import Unusable
from written import lammps_foam, write_series

TAU = np.geomspace(1, 20, 3001)
LN_TAU = np.log(TAU)
WHERE = np.array([0.5, 1.0, 1.6, 2.5])     # ln(tau) of the planted drops
FALL = np.array([0.1, 0.05, 0.2, 0.1])     # of ln(E)
WIDTH = 0.02                               # of the planted Gaussian rate, its standard deviation


def planted(rng, where=WHERE, spikes=WHERE, noise=0.02):
    """ln(E) falls by 0.4 ln(tau), plus steps; the variance of the velocities falls like 1/tau and has spikes."""
    def bumps(at, height):
        return sum(h * np.exp(-(LN_TAU - x) ** 2 / (2 * WIDTH**2)) for x, h in zip(at, height))

    rate = 0.4 + rng.normal(0, noise, len(TAU)) + bumps(where, FALL / (np.sqrt(2 * np.pi) * WIDTH))
    ln_E = -np.concatenate([[0], np.cumsum((rate[1:] + rate[:-1]) / 2 * np.diff(LN_TAU))])
    vvar = 1e-6 / TAU * np.exp(rng.normal(0, noise, len(TAU))) * (1 + bumps(spikes, np.full(len(spikes), 2.0)))
    return {"tau": TAU, "energy": 5 * np.exp(ln_E), "vvar": vvar, "N": 1e4 / TAU}


def test_planted_drops(rng):
    """Each is found once, where it is, with its width. A Gaussian has 76 % of its area in its width at half height;
    there is the steady fall, 0.4 times the width. Limits: noise and steps of ln(tau), which are 0.001."""
    found = avalanches.analyse(planted(rng), 1, 20, 6, 1)
    np.testing.assert_allclose(found.drops.peak, WHERE, atol=0.2 * WIDTH)
    full_width = 2 * np.sqrt(2 * np.log(2)) * WIDTH
    np.testing.assert_allclose(found.drops.end - found.drops.start, full_width, rtol=0.1)
    np.testing.assert_allclose(found.size, 1 - np.exp(-0.761 * FALL - 0.4 * full_width), rtol=0.07)
    np.testing.assert_allclose(found.spikes.peak, WHERE, atol=0.2 * WIDTH)
    assert found.with_spike.tolist() == [1, 1, 1, 1]
    assert np.mean(found.shares) < 0.3
    assert (1 + np.count_nonzero(found.shares >= 1)) / 1001 < 0.01


def test_spikes_elsewhere_do_not_coincide(rng):
    found = avalanches.analyse(planted(rng, spikes=WHERE + 0.2), 1, 20, 6, 1)
    assert len(found.spikes) == 4 and not found.with_spike.any()


def test_chance_is_the_covered_share(rng):
    """Drops at random: the share that meets a spike is (width of a spike + of a drop) * number of spikes / length."""
    drops = rng.uniform(0, 1, 2000)
    at = np.linspace(0.05, 0.95, 10)
    share = avalanches.chance(avalanches.Events(drops, drops - 0.005, drops + 0.005),
                              avalanches.Events(at, at - 0.01, at + 0.01), 0, 1)
    assert share.mean() == pytest.approx(10 * 0.03, abs=0.02)    # 2000 drops: 1 %, one of ten spikes crosses the end


def test_independent_signals_have_no_small_p(rng):
    """p is uniform for 40 independent pairs of drops and spikes: below 0.1 are 4 +- 1.9, so fewer than 10."""
    small = 0
    for _ in range(40):
        a, b = (np.sort(rng.uniform(0, 3, 12)) for _ in range(2))
        drops, spikes = (avalanches.Events(x, x - 0.03, x + 0.03) for x in (a, b))
        shares = avalanches.chance(drops, spikes, 0, 3)
        small += (1 + np.count_nonzero(shares >= np.mean(avalanches.coincide(drops, spikes)))) / 1001 < 0.1
    assert small < 10


def test_smooth_energy_has_no_drops():
    energy = 3 * TAU**-0.5
    found = avalanches.analyse({"tau": TAU, "energy": energy}, 1, 20, 3, 1)
    np.testing.assert_allclose(found.loss, 0.5, atol=1e-9)
    assert len(found.size) == 0 and found.spikes is None and np.isnan(found.correlation)


def test_noise_alone_seldom_stands_out(rng):
    """Normal noise exceeds 5 of its deviations once in 3 10^6 points."""
    signal = avalanches.standing_out(rng.normal(7, 0.3, 3000), 300)
    assert np.std(signal) == pytest.approx(1, abs=0.1)
    assert len(avalanches.events(np.arange(3000.0), signal, 5.0)) == 0


def test_units_do_not_matter(rng):
    run = planted(rng)
    a = avalanches.analyse(run, 1, 20, 5, 1)
    b = avalanches.analyse({"tau": 30 * TAU, "energy": 1e-5 * run["energy"], "vvar": 7 * run["vvar"]}, 30, 600, 5, 1)
    np.testing.assert_allclose(a.size, b.size, rtol=1e-6)
    np.testing.assert_allclose(a.drops.peak, b.drops.peak - np.log(30), atol=1e-9)


def test_unusable(rng):
    run = planted(rng)
    with pytest.raises(Unusable, match="energy is not above 0"):
        avalanches.analyse({**run, "energy": run["energy"] * 0}, 1, 20, 5, 1)
    with pytest.raises(Unusable, match="50 are needed"):
        avalanches.analyse(run, 1, 1.01, 5, 1)


@pytest.mark.parametrize("with_vvar", [True, False])
def test_command(tmp_path, capsys, rng, with_vvar):
    for seed in range(2):
        (tmp_path / f"s{seed}").mkdir()
        columns = planted(rng)
        write_series(tmp_path / f"s{seed}" / "series.csv", **(columns if with_vvar else {
            name: column for name, column in columns.items() if name != "vvar"}))
    assert lammps_foam("avalanches", tmp_path / "s0", tmp_path / "s1", "--threshold", 6, "--tau", 1, 20,
                       "--out", tmp_path / "a") == 0
    said = capsys.readouterr().out
    assert "scatter of the runs' means" in said and ("p of chance" in said) == with_vvar
    table = np.genfromtxt(tmp_path / "a.csv", delimiter=",", names=True)
    assert len(table) == 8
    np.testing.assert_allclose(table["waiting"][[1, 2, 3]], np.diff(np.exp(WHERE)), atol=0.1)
    for end in ("-summary.csv", ".pdf", ".png"):
        assert (tmp_path / f"a{end}").stat().st_size > 100
