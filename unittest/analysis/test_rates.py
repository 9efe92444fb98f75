"""Rates of growth: of bubbles that follow a known law, by column and from two frames; medians and their errors."""

import numpy as np
import pytest

from lammps_foam.analysis import rates
from lammps_foam.analysis.read import Box, Frame, Unusable
from written import dump_text, lammps_foam, write_series

BOX = Box(np.zeros(3), np.full(3, 100.0), np.zeros(3), np.full(3, True), 3)


def frame(radius, x=None, time=0.0, ids=None, **more):
    radius = np.asarray(radius, dtype=float)
    x = np.arange(len(radius))[:, None] * [10.0, 0, 0] if x is None else np.asarray(x, dtype=float)
    ids = np.arange(1.0, len(radius) + 1) if ids is None else np.asarray(ids, dtype=float)
    return Frame(0, time, BOX, {"id": ids, **dict(zip("xyz", x.T)), "radius": radius, **more})


def test_spring_energy():
    """Two of radius 1 and 2 that overlap by 0.5 share 0.5^2/(2 3); the third, through the face, touches the first with
    0.2 of overlap; the fourth is alone."""
    x = [[0.5, 50, 50], [3.0, 50, 50], [98.7, 50, 50], [50, 50, 50]]
    energy = rates.spring_energy(frame([1, 2, 1, 1], x))
    np.testing.assert_allclose(energy, [0.25 / 12 + 0.04 / 8, 0.25 / 12, 0.04 / 8, 0], atol=1e-12)


def test_column_energy_goes_first():
    assert rates.energy_of(frame([1, 1], energy=np.array([3.0, 4.0]))).tolist() == [3, 4]


def test_rates_are_numbers(rng):
    """With lengths times 3 and times times 7, K is times 9/7 and the rates stay."""
    R, rdot = rng.uniform(1, 2, 50), rng.normal(0, 1, 50)
    a = rates.from_column(frame(R, rdot=rdot), 0.1)
    b = rates.from_column(frame(3 * R, rdot=3 / 7 * rdot), 0.1 * 9 / 7)
    np.testing.assert_allclose(a.rate, b.rate)
    np.testing.assert_allclose(a.radius, b.radius)
    np.testing.assert_allclose(a.rate, rdot * R.mean() / 0.1)


def test_from_two_frames():
    """Bubbles in both, in any order: 7 grows by 0.2 in 4, 5 shrinks by 0.1; 9 is gone."""
    found = rates.from_two(frame([1.0, 2.0, 0.5], ids=[7, 5, 9]), frame([1.9, 1.2], ids=[5, 7], time=4.0), K=0.5)
    mean = (3.5 / 3 + 3.1 / 2) / 2
    assert found.id.tolist() == [5, 7]
    np.testing.assert_allclose(found.rate, np.array([-0.1, 0.2]) / 4 * mean / 0.5)
    np.testing.assert_allclose(found.radius, np.array([1.95, 1.1]) / mean)


def test_two_frames_need_times():
    with pytest.raises(Unusable, match="dump_modify time yes"):
        rates.from_two(frame([1.0], time=None), frame([1.0], time=None), 1.0)


def test_quartiles(rng):
    groups = rates.quartiles(rng.permutation(np.arange(100.0)))
    assert [np.count_nonzero(groups == q) for q in (1, 2, 3, 4)] == [25, 25, 25, 25]
    many_without = np.concatenate([np.zeros(60), np.arange(1.0, 41)])    # quartiles at 0, 0 and 15.25
    groups = rates.quartiles(many_without)
    assert np.all(groups[:60] == 1) and np.all(groups[60:75] == 3) and np.all(groups[75:] == 4)
    bins = np.repeat([1.0, 2.0], 50)
    within = rates.quartiles_within(np.concatenate([np.arange(50.0), 1000 + np.arange(50.0)]), bins)
    np.testing.assert_array_equal(within[:50], within[50:])


def test_weighted_median(rng):
    """Against numpy's median of values that are repeated."""
    values = rng.normal(0, 1, 30)
    weights = rng.poisson(1.0, (50, 30)).astype(float)
    expected = [np.median(np.repeat(values, row.astype(int))) for row in weights]
    np.testing.assert_allclose(rates.weighted_median(values, weights), expected)
    assert np.isnan(rates.weighted_median(values, np.zeros((1, 30)))).all()


def test_error_of_a_median(rng):
    """Of n normal numbers: sqrt(pi / (2 n)) = 0.0396 for 1000. One bootstrap's error scatters by some 10 %, the mean of
    20 by 3 %; the bootstrap of a median is known to be a few per cent too large."""
    errors = [rates.median(rng.normal(0, 1, 1000), np.arange(1000), seed)[1] for seed in range(20)]
    assert np.mean(errors) == pytest.approx(np.sqrt(np.pi / 2000), rel=0.12)


def test_error_knows_that_bubbles_come_again(rng):
    """The same 200 bubbles in five frames: the error is that of 200, not of 1000."""
    values = rng.normal(0, 1, 200)
    once = rates.median(values, np.arange(200))[1]
    assert rates.median(np.tile(values, 5), np.tile(np.arange(200), 5))[1] == pytest.approx(once, rel=0.2)


def test_medians_by_quartile(rng):
    """Rates that depend on radius and energy in a known way: x - 1 - energy."""
    n = 4000
    one = rates.Rates(np.arange(n, dtype=float), rng.uniform(0, 2, n), np.zeros(n), rng.uniform(0, 1, n))
    one.rate = one.radius - 1 - one.energy
    columns = rates.medians([one], np.arange(0, 2.1, 0.5), within=True)
    assert len(columns["R"]) == 16 and columns["count"].sum() == n
    expected = columns["R"] - 1 - (columns["quartile"] - 0.5) / 4
    # the median of some 250, which scatter by 0.16, has an error of 0.013; 4 of these
    np.testing.assert_allclose(columns["rate"], expected, atol=0.05)
    assert np.all(np.abs(columns["rate"] - expected) < 5 * columns["error"])


def run(directory, *, column, K=0.01, R_in=2.0, n=2000):
    """Free bubbles on a lattice with dR/dt = K (1/<R> - 1/R): <R>/K dR/dt = 1 - 1/x. Frames every 0.5 of time."""
    directory.mkdir()
    R = np.linspace(0.5, 3.5, n)
    R *= R_in / R.mean()
    x = np.column_stack([np.arange(n) % 20 * 5, np.arange(n) // 20 * 5, np.zeros(n)])
    rows, start, means, energy = [], R.mean(), [], np.random.default_rng(1).random(n)
    for step in range(3):
        rate = K * (1 / R.mean() - 1 / R)
        means.append(R.mean() / start)
        extra = [rate] if column else []
        rows.append((step, np.column_stack([np.arange(1, n + 1), x, R, energy, *extra])))
        R = R + 0.5 * rate
    times = 0.5 * np.arange(3)
    names = ["id", "x", "y", "z", "radius", "energy"] + ["rdot"] * column
    (directory / "foam.lammpstrj").write_text(
        dump_text(rows, names, box=((0, 100), (0, 500), (-0.5, 0.5)), times=times))
    write_series(directory / "series.csv", step=[0, 1, 2], time=times, tau=K * times / start**2, R=means, N=[n] * 3)


@pytest.mark.parametrize("column", [True, False])
def test_command(tmp_path, column, capsys):
    """The law is found in each quartile, K from the table. In a bin of 0.1 the law varies by 0.1/x^2, and the median of
    ten or more evenly spread radii is within a third of that."""
    run(tmp_path / "a", column=column)
    assert lammps_foam("rates", tmp_path / "a", "--N", 5000, 1, "--width", 0.1, "--out", tmp_path / "r") == 0
    assert "rate: <R>/K dR/dt" in capsys.readouterr().out
    table = np.genfromtxt(tmp_path / "r.csv", delimiter=",", names=True)
    large = table[table["R"] > 0.5]
    assert len(large) > 40
    assert np.all(np.abs(large["rate"] - 1 + 1 / large["R"]) < 0.033 / large["R"] ** 2)
    for end in (".pdf", ".png"):
        assert (tmp_path / f"r{end}").stat().st_size > 100


def test_without_a_table(tmp_path, capsys):
    run(tmp_path / "a", column=True)
    (tmp_path / "a" / "series.csv").unlink()
    assert lammps_foam("rates", tmp_path / "a", "--N", 5000, 1, "--out", tmp_path / "r") == 0
    assert "K is not known" in capsys.readouterr().out


@pytest.mark.parametrize(("arguments", "message"), [
    (["--N", 5, 2], "the range needs a frame with rdot, or two frames"),
    (["--width", 0], "--width 0.0 must be above 0"),
])
def test_wrong_arguments(tmp_path, arguments, message):
    run(tmp_path / "a", column=True)
    with pytest.raises(SystemExit, match=message):
        lammps_foam("rates", tmp_path / "a", *arguments, "--out", tmp_path / "r")
