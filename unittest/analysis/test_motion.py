"""Motion: bubbles that are followed through periodic faces, and their averages."""

import numpy as np
import pytest

from lammps_foam.analysis import motion
from lammps_foam.analysis.read import Box, Frame, Unusable
from written import dump_text, lammps_foam, write_series

BOX = Box(np.zeros(3), np.array([10.0, 8, 6]), np.zeros(3), np.full(3, True), 3)
TILTED = Box(np.zeros(3), np.array([10.0, 8, 6]), np.array([3.0, -2, 1]), np.full(3, True), 3)


def frame(at, ids=None, box=BOX, **more):
    at = np.asarray(at, dtype=float)
    columns = {"id": np.arange(1.0, len(at) + 1) if ids is None else np.array(ids, dtype=float),
               **dict(zip("xyz", at.T)), "radius": np.ones(len(at)), **more}
    return Frame(0, None, box, columns)


def walk(rng, frames=30, n=200, step=0.5):
    return np.cumsum(np.concatenate([rng.uniform(0, 6, (1, n, 3)), rng.normal(0, step, (frames, n, 3))]), axis=0)


@pytest.mark.parametrize("box", [BOX, TILTED])
def test_walks_through_faces(box, rng):
    """Wrapped positions give the displacements of the unwrapped ones, however many boxes they are (steps < 3)."""
    at = walk(rng)
    found = motion.follow([(frame(box.wrap(x), box=box), float(n)) for n, x in enumerate(at)], unit=2.0)
    np.testing.assert_allclose(found.last, (at[-1] - at[0]) / 2, atol=1e-9)
    np.testing.assert_allclose(found.msd, np.mean(np.sum((at - at[0]) ** 2, axis=2), axis=1) / 4, atol=1e-9)
    path = np.cumsum(np.linalg.norm(np.diff(at, axis=0), axis=2), axis=0).mean(axis=1)
    np.testing.assert_allclose(found.path[1:], path / 2)
    np.testing.assert_allclose(found.drift, np.linalg.norm((at - at[0]).mean(axis=1), axis=1) / 2, atol=1e-9)


def test_bubbles_that_vanish_and_come_in_any_order():
    """The average is over those that are left; the third is gone, and a new one is not followed."""
    found = motion.follow([(frame([[1, 1, 1], [2, 2, 2], [3, 3, 3]], [7, 5, 9]), 0.0),
                           (frame([[2, 2, 4], [1.5, 1, 1], [5, 5, 5]], [5, 7, 11]), 1.0)])
    assert found.bubbles == [3, 2]
    assert found.msd == [0, pytest.approx((2**2 + 0.5**2) / 2)]


def test_unwrapped_columns_and_paths_are_taken():
    """A bubble that goes 25 to the right, in a box of 10, on a way of 30."""
    def at(x, path):
        return frame([[x % 10, 1, 1]], xu=np.array([x]), yu=np.ones(1), zu=np.ones(1), path=np.array([path]))

    found = motion.follow([(at(2.0, 4.0), 0.0), (at(27.0, 34.0), 1.0)])
    assert found.msd[-1] == pytest.approx(625) and found.path[-1] == pytest.approx(30)


def test_all_gone_and_doubled():
    assert motion.follow([(frame([[1, 1, 1]]), 0.0), (frame([[1, 1, 1]], [2]), 1.0)]).tau == [0]
    with pytest.raises(Unusable, match="same id"):
        motion.follow([(frame([[1, 1, 1], [2, 2, 2]], [3, 3]), 0.0)])


@pytest.mark.parametrize("dimension", [2, 3])
def test_non_gaussian(dimension, rng):
    """0 if normal; of variances s^2 = 1 and 9, half of each, <s^4>/<s^2>^2 - 1 = 41/25 - 1.
    The error of alpha_2 is about 5/sqrt(n) = 0.008."""
    d = np.zeros((400_000, 3))
    d[:, :dimension] = rng.normal(0, 1, (len(d), dimension))
    assert motion.non_gaussian(d + [5, 0, 0], dimension) == pytest.approx(0, abs=0.03)
    d[::2] *= 3
    assert motion.non_gaussian(d, dimension) == pytest.approx(41 / 25 - 1, abs=0.03)


def test_components_are_normalised(rng):
    x = motion.components(rng.normal(3, 7, (500, 3)), 2)
    assert len(x) == 1000 and x.mean() == pytest.approx(0, abs=1e-12) and x.std() == pytest.approx(1)


def run(directory, rng, **more):
    """<R_in> = 2; a random walk with 0.25 of variance per component and frame, and three frames in a unit of tau."""
    at = walk(rng, frames=12)
    steps = np.arange(len(at))
    rows = [(10 * n, np.column_stack([np.arange(200), x % 10, np.full(200, 2.0 * 1.1**n)])) for n, x in enumerate(at)]
    directory.mkdir()
    (directory / "foam.lammpstrj").write_text(
        dump_text(rows, ["id", "x", "y", "z", "radius"], box=((0, 10), (0, 10), (0, 10))))
    write_series(directory / "series.csv", step=10 * steps, tau=steps / 3, R=1.1**steps, N=200 - steps, **more)
    return np.mean(np.sum((at - at[0]) ** 2, axis=2), axis=1) / 2**2


def test_command_with_frames(tmp_path, rng):
    expected = run(tmp_path / "a", rng)
    assert lammps_foam("motion", tmp_path / "a", "--out", tmp_path / "m") == 0
    table = np.genfromtxt(tmp_path / "m.csv", delimiter=",", names=True)
    np.testing.assert_allclose(table["msd"], expected, rtol=1e-9)
    np.testing.assert_allclose(table["tau"], np.arange(13) / 3, atol=1e-9)
    for end in ("-displacements.csv", ".pdf", ".png"):
        assert (tmp_path / f"m{end}").stat().st_size > 100


def test_command_over_seeds(tmp_path, rng):
    """A table that has msd is taken as it is; the error is that of the mean of three."""
    factors = np.array([1.0, 1.2, 1.7])
    for number, factor in enumerate(factors):
        run(tmp_path / f"s{number}", rng, msd=factor * np.arange(13) / 3)
    assert lammps_foam("motion", *(tmp_path / f"s{n}" for n in range(3)), "--out", tmp_path / "m") == 0
    table = np.genfromtxt(tmp_path / "m.csv", delimiter=",", names=True)
    np.testing.assert_allclose(table["msd"] / table["tau"], factors.mean(), rtol=1e-6)
    np.testing.assert_allclose(table["msd_error"] / table["tau"], factors.std(ddof=1) / np.sqrt(3), rtol=1e-6)


def test_wrong_arguments(tmp_path, rng):
    run(tmp_path / "a", rng)
    with pytest.raises(SystemExit, match="no two frames in the range"):
        lammps_foam("motion", tmp_path / "a", "--tau", 100, 200, "--out", tmp_path / "m")
    (tmp_path / "a" / "series.csv").unlink()
    with pytest.raises(SystemExit, match=r"frames need a series\.csv"):
        lammps_foam("motion", tmp_path / "a", "--out", tmp_path / "m")
    with pytest.raises(SystemExit, match="there is no file or directory"):
        lammps_foam("motion", tmp_path / "b", "--out", tmp_path / "m")
