"""Reading: what LAMMPS writes, whole, cut, packed and wrong."""

import gzip
import itertools

import numpy as np
import pytest

from lammps_foam.analysis.read import Box, Unusable, read_frames, read_series
from written import dump_text, write_series

COLUMNS = ["id", "x", "y", "z", "radius"]
ROWS = np.array([[1, 1.5, 2.5, 0, 0.5], [2, 9.9, 0.1, 0, 1.25]])


def box(lengths=(10.0, 8.0, 6.0), tilt=(0.0, 0.0, 0.0), periodic=(True, True, True), dimension=3, lo=(0.0, 0.0, 0.0)):
    lo = np.array(lo)
    return Box(lo, lo + lengths, np.array(tilt), np.array(periodic), dimension)


# ---------------------------------------------------------------- series

def test_comma_separated(tmp_path):
    write_series(tmp_path / "series.csv", step=[0, 2, 4], tau=[0, 0.5, 1], R=[1, 1.25, np.nan])
    for path in (tmp_path, tmp_path / "series.csv"):
        series = read_series(path)
        assert list(series) == ["step", "tau", "R"]
        np.testing.assert_array_equal(series["tau"], [0, 0.5, 1])
        np.testing.assert_array_equal(series["R"], [1, 1.25, np.nan])


@pytest.mark.parametrize("end", ["4,1", "4,1,3", "4,"])
def test_cut_line_is_left_out(tmp_path, end):
    """Even if it has all columns: its last number may go on."""
    (tmp_path / "s.csv").write_text("step,tau,R\n0,0,1\n2,0.5,1.25\n" + end)
    np.testing.assert_array_equal(read_series(tmp_path / "s.csv")["step"], [0, 2])


def test_packed_and_cut(tmp_path):
    text = "step,tau\n" + "".join(f"{n},{n / 7}\n" for n in range(5000))
    packed = gzip.compress(text.encode())
    (tmp_path / "series.csv.gz").write_bytes(packed)
    assert len(read_series(tmp_path)["step"]) == 5000
    (tmp_path / "series.csv.gz").write_bytes(packed[:len(packed) // 2])
    step = read_series(tmp_path)["step"]
    assert 1000 < len(step) < 5000
    np.testing.assert_array_equal(step, np.arange(len(step)))


def test_lines_after_restart_count(tmp_path):
    write_series(tmp_path / "series.csv", step=[0, 2, 4, 6, 4, 6, 6, 8], R=[1, 2, 3, 4, 5, 6, 7, 8])
    series = read_series(tmp_path)
    np.testing.assert_array_equal(series["step"], [0, 2, 4, 6, 8])
    np.testing.assert_array_equal(series["R"], [1, 2, 5, 7, 8])


def test_ave_time(tmp_path):
    (tmp_path / "ave").write_text("# Time-averaged data for fix e\n# TimeStep v_tau c_e\n0 0 1.5\n10 0.1 1.25\n")
    series = read_series(tmp_path / "ave")
    np.testing.assert_array_equal(series["step"], [0, 10])
    np.testing.assert_array_equal(series["c_e"], [1.5, 1.25])


def test_log(tmp_path):
    """The last table, and the one before it that leads up to it; not that of another run."""
    (tmp_path / "log").write_text(
        "LAMMPS\nPer MPI rank\n   Step  Time\n 0 0\n 5 1\nLoop time of 1 s\n"
        "   Step   tau   PotEng \n 0 0 3\nWARNING: bubbles\n 10 0.5 2\nLoop time of 2 s\nrun 10\n"
        "   Step   tau   PotEng \n 10 0.5 2\n 20 1 1\n 3")
    series = read_series(tmp_path / "log")
    np.testing.assert_array_equal(series["step"], [0, 10, 20])
    np.testing.assert_array_equal(series["energy"], [3, 2, 1])


@pytest.mark.parametrize(("text", "message"), [
    ("step,tau\n0,1\n1,x\n2,3\n", r"line 3: 'x' is no number"),
    ("step,tau\n\n0,1\n1,x\n2,3\n", r"line 4: 'x' is no number"),
    ("step,tau\n0,1\n1\n", r"line 3 has 1 values, not 2"),
    ("step,tau\n0,1\n1,2,3\n", r"line 3 has 3 values, not 2"),
    ("step,tau\n", "no line of numbers yet"),
    ("", "no table"),
    ("0,1\n1,2\n", "first line must be names"),
    ("hello world\n", "no table"),
    ("# TimeStep v_a\n0 1 2\n", "line 2 has 3 values, not 2"),
])
def test_unusable_series(tmp_path, text, message):
    (tmp_path / "s.csv").write_text(text)
    with pytest.raises(Unusable, match=message) as wrong:
        read_series(tmp_path / "s.csv")
    assert "s.csv" in str(wrong.value) and "\n" not in str(wrong.value)


def test_missing_files(tmp_path):
    with pytest.raises(Unusable, match=r"has none of the files series\.csv"):
        read_series(tmp_path)
    with pytest.raises(Unusable, match="there is no file"):
        read_series(tmp_path / "none")


# ---------------------------------------------------------------- frames

def test_frame(tmp_path):
    (tmp_path / "foam.lammpstrj").write_text(dump_text([(0, ROWS), (7, ROWS[:1])], COLUMNS, times=[0, 0.25]))
    first, second = read_frames(tmp_path)
    assert (first.step, first.time, len(first)) == (0, 0, 2)
    assert (second.step, second.time, len(second)) == (7, 0.25, 1)
    np.testing.assert_array_equal(first.positions, ROWS[:, 1:4])
    np.testing.assert_array_equal(first.radius, ROWS[:, 4])
    assert first.box.dimension == second.box.dimension == 2
    assert first.box.volume == 100 and first.box.periodic.all()


def test_no_time_and_an_empty_frame(tmp_path):
    (tmp_path / "d").write_text(dump_text([(0, ROWS), (1, ROWS[:0])], COLUMNS))
    first, second = read_frames(tmp_path / "d")
    assert first.time is None and len(second) == 0 and second.positions.shape == (0, 3)


def test_cut_anywhere(tmp_path):
    """Whatever is left of the second frame, the first is read and nothing else."""
    one, both = (dump_text([(0, ROWS), (7, ROWS)][:n], COLUMNS, times=[0, 1]) for n in (1, 2))
    for length in range(len(one), len(both)):
        (tmp_path / "d").write_text(both[:length])
        assert [frame.step for frame in read_frames(tmp_path / "d")] == [0], length


def test_packed_frames_cut(tmp_path, rng):
    rows = np.column_stack([np.arange(500), rng.random((500, 4))])
    packed = gzip.compress(dump_text([(n, rows) for n in range(10)], COLUMNS).encode())
    (tmp_path / "foam.lammpstrj.gz").write_bytes(packed)
    assert [frame.step for frame in read_frames(tmp_path)] == list(range(10))
    (tmp_path / "foam.lammpstrj.gz").write_bytes(packed[:-len(packed) // 3])
    frames = list(read_frames(tmp_path))
    assert [frame.step for frame in frames] == list(range(len(frames))) and 3 <= len(frames) <= 6
    np.testing.assert_array_equal(frames[-1].radius, rows[:, 4])


def test_text_columns_are_left_out(tmp_path):
    text = dump_text([(0, ROWS)], COLUMNS).replace("id x", "id element x").replace("\n1 ", "\n1 Ar ")
    (tmp_path / "d").write_text(text.replace("\n2 9", "\n2 Kr 9"))
    (frame,) = read_frames(tmp_path / "d")
    assert list(frame.columns) == COLUMNS
    np.testing.assert_array_equal(frame.radius, ROWS[:, 4])


def test_scaled_and_unwrapped_positions(tmp_path):
    (tmp_path / "s").write_text(dump_text([(0, [[1, 0.25, 0.5, 0.5], [2, 0.75, -0.1, 0.25]])], ["id", "xs", "ys", "zs"],
                                          box=((0, 10), (2, 4), (0, 8))))
    (frame,) = read_frames(tmp_path / "s")
    np.testing.assert_allclose(frame.positions, [[2.5, 3, 4], [7.5, 3.8, 2]], atol=1e-12)
    (tmp_path / "u").write_text(dump_text([(0, [[1, 12.5, -3, 0]])], ["id", "xu", "yu", "zu"]))
    (frame,) = read_frames(tmp_path / "u")
    np.testing.assert_allclose(frame.positions, [[2.5, 7, 0]], atol=1e-12)


def test_tilted_box_from_bounds(tmp_path):
    """LAMMPS writes the bounding box; lo, hi are those of the box itself. A box of 10 x 8 x 6 with all three tilts."""
    xy, xz, yz = 3.0, -4.0, -2.0
    bounds = ((0 + min(0, xy, xz, xy + xz), 10 + max(0, xy, xz, xy + xz)), (min(0, yz), 8 + max(0, yz)), (0, 6))
    rows = [[1, 0, 0, 0, 1], [2, 1, 1, 1, 1]]
    (tmp_path / "d").write_text(dump_text([(0, rows)], COLUMNS, box=bounds, tilt=(xy, xz, yz), boundary="pp ff ss"))
    (frame,) = read_frames(tmp_path / "d")
    np.testing.assert_allclose(frame.box.lo, 0, atol=1e-15)
    np.testing.assert_allclose(frame.box.lengths, [10, 8, 6], atol=1e-15)
    np.testing.assert_array_equal(frame.box.tilt, [xy, xz, yz])
    np.testing.assert_array_equal(frame.box.periodic, [True, False, False])
    assert frame.box.dimension == 3 and frame.box.volume == pytest.approx(480)


@pytest.mark.parametrize(("change", "message"), [
    (("ITEM: TIMESTEP", "ITEM: STEP"), "line 1 is 'ITEM: STEP'"),
    (("9.9", "9.9.9"), r"line 11: '9\.9\.9' is no number"),
    (("9.9 ", ""), "line 11 has 4 values, not 5"),
    (("BOUNDS pp pp pp", "BOUNDS abc origin pp pp pp"), "general triclinic"),
    (("BOUNDS pp pp pp", "BOUNDS xy xz yz pp pp pp"), "box bounds"),
    (("ITEM: NUMBER OF ATOMS\n2\n", ""), "no 'ITEM: NUMBER OF ATOMS'"),
])
def test_unusable_frames(tmp_path, change, message):
    (tmp_path / "d").write_text(dump_text([(0, ROWS)], COLUMNS).replace(*change))
    with pytest.raises(Unusable, match=message):
        list(read_frames(tmp_path / "d"))


def test_missing_column(tmp_path):
    (tmp_path / "d").write_text(dump_text([(3, ROWS)], ["id", "x", "y", "z", "size"]))
    (frame,) = read_frames(tmp_path / "d")
    with pytest.raises(Unusable, match="step 3, lacks the column radius; it has id, x, y, z, size"):
        _ = frame.radius


def test_one_bubble(tmp_path):
    """Its z says nothing; the box does."""
    for depth, dimension in ((1, 2), (10, 3)):
        (tmp_path / "d").write_text(dump_text([(0, ROWS[:1])], COLUMNS, box=((0, 10), (0, 10), (0, depth))))
        (frame,) = read_frames(tmp_path / "d")
        assert frame.box.dimension == dimension


# ---------------------------------------------------------------- boxes

TILTS = [(0.0, 0.0, 0.0), (4.9, 0.0, 0.0), (4.9, -4.9, 3.9), (-17.0, 12.0, 9.0)]


@pytest.mark.parametrize(("tilt", "periodic"), [
    *((tilt, (True, True, True)) for tilt in TILTS), (TILTS[0], (True, False, True)), (TILTS[1], (True, True, False))])
@pytest.mark.parametrize("dimension", [2, 3])
def test_minimum_image_is_the_shortest(tilt, periodic, dimension, rng):
    """Against all images within 4 edges, and 16 along x, where rows are displaced by up to 12/10 + 2 17/10 edges."""
    b = box(tilt=tilt, periodic=periodic, dimension=dimension)
    d = rng.uniform(-10, 10, (200, 3)) * [1, 1, dimension == 3]
    most = [16, 4, 4]
    ways = [range(-most[n], most[n] + 1) if periodic[n] and n < dimension else (0,) for n in range(3)]
    shortest = np.min([np.linalg.norm(d + np.array(n) @ b.edges, axis=1) for n in itertools.product(*ways)], axis=0)
    image = b.minimum_image(d)
    np.testing.assert_allclose(np.linalg.norm(image, axis=1), shortest, atol=1e-12)
    whole = (image - d) @ np.linalg.inv(b.edges)
    np.testing.assert_allclose(whole, np.round(whole), atol=1e-12)


@pytest.mark.parametrize("tilt", TILTS)
def test_wrap(tilt, rng):
    b = box(tilt=tilt, lo=(-3.0, 2.0, 1.0))
    x = rng.uniform(-40, 40, (300, 3))
    inside = b.wrap(x)
    part = (inside - b.lo) @ np.linalg.inv(b.edges)
    assert np.all(part > -1e-12) and np.all(part < 1 + 1e-12)
    whole = (inside - x) @ np.linalg.inv(b.edges)
    np.testing.assert_allclose(whole, np.round(whole), atol=1e-12)


def test_walls_do_not_wrap():
    b = box(periodic=(True, False, False))
    np.testing.assert_allclose(b.wrap(np.array([[11.0, 9.0, -1.0]])), [[1.0, 9.0, -1.0]])
