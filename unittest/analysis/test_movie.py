"""Movies: pictures of known bubbles pixel by pixel, frames at equal steps of ln(tau), and files that can be read."""

import numpy as np
import pytest

from lammps_foam.analysis import movie
from lammps_foam.command import analyse
from test_contacts import box_of, write_dump

Image = pytest.importorskip("PIL.Image")


def test_a_disc_has_its_area():
    """A disc of radius r covers pi r^2 pixels; those half covered by its edge count for a part: 1 %."""
    picture = movie.drawn(np.array([[50.3, 40.7]]), np.array([20.0]), None, np.array([[1.0, 0, 0]]), 100, 80)
    cover = 1 - picture[:, :, 2]    # white without, no blue within
    assert picture.shape == (80, 100, 3) and cover.sum() == pytest.approx(np.pi * 400, rel=0.01)
    rows, columns = np.indices(cover.shape)
    assert (cover * columns).sum() / cover.sum() == pytest.approx(49.8, abs=0.1)    # pixel n has its middle at n + 1/2
    assert (cover * rows).sum() / cover.sum() == pytest.approx(80 - 40.7 - 0.5, abs=0.1)    # y upwards


def test_near_spheres_hide_far_ones():
    place, radius = np.array([[30.0, 30], [36, 30]]), np.array([10.0, 10])
    colour = np.array([[1.0, 0, 0], [0, 1.0, 0]])
    for depth, seen in (([0.0, 50.0], 1), ([50.0, 0.0], 0)):
        pixel = movie.drawn(place, radius, np.array(depth), colour, 60, 60)[30, 33]
        assert pixel[seen] > 0 and pixel[1 - seen] == 0
    both = movie.drawn(place, radius, np.array([0.0, 0.0]), colour, 60, 60)    # they meet in the middle
    assert both[30, 31, 0] > 0 and both[30, 34, 1] > 0


def test_view_is_a_rotation():
    axes = movie.view(35, 25)
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-14)
    assert np.linalg.det(axes) == pytest.approx(1) and axes[1, 2] > 0    # z points upwards


def test_equal_steps():
    taus = np.array([np.nan, 0, 1, 2, 4, 4.1, 8, 16])
    assert movie.at_equal_steps(taus, 5) == {2: 1, 3: 1, 4: 1, 6: 1, 7: 1}
    assert sum(movie.at_equal_steps(taus, 50).values()) == 50
    with pytest.raises(movie.Unusable, match="two frames or more whose tau is known"):
        movie.at_equal_steps(np.array([0.0, np.nan]), 5)


def run_in(path, dimension, frames=3):
    rng = np.random.default_rng(1)
    box = box_of([10, 8, 8 if dimension == 3 else 1], dimension)
    states = []
    for n in range(frames):
        x = rng.random((40 - 10 * n, 3)) * box.lengths
        if dimension == 2:
            x[:, 2] = 0
        states.append((x, rng.uniform(0.3, 1, len(x)), box))
    write_dump(path / "foam.lammpstrj", states)
    (path / "series.csv").write_text("step,tau\n0,0\n1,1\n2,10\n")


@pytest.mark.parametrize("dimension, more", [(2, []), (3, []), (3, ["--slice", "0.5"]), (2, ["--log", "6"])])
def test_gif(tmp_path, dimension, more):
    run_in(tmp_path, dimension)
    analyse("movie", [str(tmp_path), "--format", "gif", "--pixels", "64", "--out", str(tmp_path / "m"), *more])
    with Image.open(tmp_path / "m.gif") as gif:
        seconds = 0.0
        for n in range(gif.n_frames):
            gif.seek(n)
            seconds += gif.info["duration"] / 1000
        assert gif.size[0] % 2 == gif.size[1] % 2 == 0
    pictures = 6 if more == ["--log", "6"] else 3
    assert seconds == pytest.approx(pictures / 12, abs=0.011 * pictures)    # GIF counts in hundredths of a second
    assert (tmp_path / "m.png").exists() and not list(tmp_path.glob(".m*"))


def test_mp4(tmp_path):
    ffmpeg = pytest.importorskip("imageio_ffmpeg")
    run_in(tmp_path, 2)
    analyse("movie", [str(tmp_path), "--pixels", "64", "--out", str(tmp_path / "m")])
    frames, _ = ffmpeg.count_frames_and_secs(str(tmp_path / "m.mp4"))
    assert frames == 3


@pytest.mark.parametrize("change, words", [
    (["--map", "nothing"], "--map nothing is not known"),
    (["--log", "1"], "--log 1 is not allowed"),
    (["--rate", "0"], "--rate 0.0 is not allowed"),
    (["--colour", "speed"], "lacks the column vx; it has id, x, y, z, radius"),
    (["--N", "500", "400"], "no frame with bubbles in this range"),
])
def test_refusals_leave_nothing(tmp_path, change, words):
    run_in(tmp_path, 2)
    with pytest.raises(SystemExit, match=words):
        analyse("movie", [str(tmp_path), "--format", "gif", "--out", str(tmp_path / "m"), *change])
    assert sorted(p.name for p in tmp_path.iterdir()) == ["foam.lammpstrj", "series.csv"]
