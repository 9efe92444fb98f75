"""What the user of the examples meets: README shows the first one as it is, plots say what a table of
one's own lacks before they draw, exponents come with their range, and in.coarsen makes the sizes and
writes the snapshots that it is asked for."""

import csv
import os
from pathlib import Path
import re
import subprocess
import sys

import numpy as np
import pytest

SOURCE = Path(os.environ["FOAM_SOURCE_DIR"])
EXAMPLES = SOURCE / "examples"
LMP = os.environ["FOAM_LMP_WHEEL"]
sys.path.insert(0, str(EXAMPLES / "coarsen"))

import plot     # noqa: E402


# ------------------------------------------------------------------ the first example

def test_readme_and_manual_show_the_first_example_as_it_is():
    example = (EXAMPLES / "first" / "in.first").read_text()
    assert f"```\n{example}```\n" in (SOURCE / "README.md").read_text()
    assert ".. literalinclude:: ../examples/first/in.first" in (SOURCE / "doc/index.rst").read_text()


def test_first_example_comes_to_its_end(tmp_path):
    done = subprocess.run([LMP, "-in", EXAMPLES / "first" / "in.first"], cwd=tmp_path,
                          capture_output=True, text=True, timeout=300)
    assert done.returncode == 0 and "WARNING" not in done.stdout, done.stdout
    assert "coarsening ended" in done.stdout and " nmin is 100" in done.stdout
    sizes = [len(frame) for frame in plot.read_dump(tmp_path / "foam.lammpstrj")]
    assert sizes == sorted(sizes, reverse=True) and 1000 > sizes[0] > sizes[-1] > 90


def test_first_tank_and_its_picture(tmp_path):
    """Bubbles rise past the water at the speed of one alone, since in these the drag law is the same. The water around
    a bubble is known to some hundredths of that speed."""
    done = subprocess.run([LMP, "-in", EXAMPLES / "first" / "in.stir"], cwd=tmp_path,
                          capture_output=True, text=True, timeout=300)
    assert done.returncode == 0 and "WARNING" not in done.stdout, done.stdout
    drawn = subprocess.run([sys.executable, EXAMPLES / "first" / "plot.py"], cwd=tmp_path,
                           capture_output=True, text=True, timeout=300)
    assert drawn.returncode == 0, drawn.stderr
    rise, alone = map(float, re.findall(r"[\d.]+\d", drawn.stdout))
    assert rise == pytest.approx(alone, rel=0.05)
    assert (tmp_path / "stir.png").stat().st_size > 0


def test_every_example_is_in_the_lists():
    for example in EXAMPLES.glob("*/in.*"):
        name = example.parent.name
        assert f"| `{name}` |" in (EXAMPLES / "README.md").read_text()
        assert f"| [{name}](examples/{name}) |" in (SOURCE / "README.md").read_text()


# ------------------------------------------------------------------ tables and snapshots of one's own

def write_series(directory, names, rows):
    with (directory / "series.csv").open("w", newline="") as file:
        csv.writer(file).writerows([names, *rows])


def write_snapshots(path, numbers, columns="id x y z radius", steps=None):
    with path.open("w") as file:
        for i, number in enumerate(numbers):
            step = i if steps is None else steps[i]
            file.write(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{number}\n"
                       "ITEM: BOX BOUNDS pp pp pp\n0 30\n0 30\n-0.5 0.5\n"
                       f"ITEM: ATOMS {columns}\n")
            for bubble in range(number):
                row = {"id": bubble + 1, "x": bubble % 30, "y": bubble // 30, "z": 0,
                       "radius": 0.5 + bubble / number}
                file.write(" ".join(str(row[name]) for name in columns.split()) + "\n")


def power_law(names, exponent=0.4):
    tau = np.concatenate(([0.0], np.geomspace(0.1, 100, 300)))
    size = (1 + tau)**exponent
    columns = {"step": np.arange(len(tau)), "tau": tau, "N": np.ceil(900 / size**2), "R": size,
               "Rmax": 2 * size, "phi": np.full(len(tau), 0.9), "evaluations": np.arange(len(tau))}
    return np.column_stack([columns[name] for name in names])


def foam(directory, names=plot.NEEDED + plot.WELCOME, columns="id x y z radius"):
    write_series(directory, names, power_law(names))
    write_snapshots(directory / "foam.lammpstrj", [900, 400, 100], columns, steps=[0, 150, 280])
    write_snapshots(directory / "last.lammpstrj", [50], columns, steps=[300])


def plot_command(directory, example="coarsen"):
    return subprocess.run([sys.executable, EXAMPLES / example / "plot.py", directory],
                          capture_output=True, text=True, timeout=300)


def test_pictures_of_a_table_with_all_columns(tmp_path):
    foam(tmp_path)
    done = plot_command(tmp_path)
    assert done.returncode == 0, done.stderr
    assert {path.name for path in tmp_path.glob("*.png")} == {"growth.png", "foam.png"}
    assert "gas fraction     0.900000" in done.stdout and "growth exponent  0.39," in done.stdout


def test_pictures_of_a_table_with_the_needed_columns_alone(tmp_path):
    foam(tmp_path, plot.NEEDED)
    pictures, summary = plot.make_pictures(tmp_path)
    assert len(pictures) == 2 and all(path.exists() for path in pictures)
    assert "growth exponent" in "".join(summary) and "gas fraction" not in "".join(summary)


def tau_is_missing(directory):
    write_series(directory, ("step", "N", "R"), [[0, 900, 1], [1, 800, 1.1]])


def a_line_is_short(directory):
    with (directory / "series.csv").open("a") as file:
        file.write("301,1000\n")


def no_growth(directory):
    write_series(directory, plot.NEEDED, [[0, 0, 900, 1], [1, 0, 900, 1]])


def no_radius(directory):
    write_snapshots(directory / "foam.lammpstrj", [900], "id x y z")


def no_radius_at_values(directory):
    write_snapshots(directory / "N.lammpstrj", [900], "id x y z")


@pytest.mark.parametrize("spoil, said", [
    (tau_is_missing, ["series.csv lacks the columns: tau.", "Needed are step, tau, N, R",
                      "it has step, N, R"]),
    (a_line_is_short, ["series.csv has a line that is no row of 7 numbers"]),
    (no_growth, ["series.csv needs two lines at least"]),
    (lambda directory: (directory / "series.csv").write_text(""), ["it has none"]),
    (lambda directory: (directory / "series.csv").unlink(), ["there is no", "series.csv"]),
    (no_radius, ["foam.lammpstrj lacks the columns: radius."]),
    (no_radius_at_values, ["N.lammpstrj lacks the columns: radius."]),
    (lambda directory: (directory / "last.lammpstrj").unlink(), ["there is no", "last.lammpstrj"]),
    (lambda directory: (directory / "last.lammpstrj").write_text(""), ["no snapshot"]),
])
def test_what_is_missing_is_said_before_anything_is_drawn(tmp_path, spoil, said):
    foam(tmp_path)
    spoil(tmp_path)
    with pytest.raises(plot.Unusable) as wrong:
        plot.make_pictures(tmp_path)
    for words in said:
        assert words in str(wrong.value)
    assert not list(tmp_path.glob("*.png"))


def test_the_command_says_it_too(tmp_path):
    foam(tmp_path)
    tau_is_missing(tmp_path)
    done = plot_command(tmp_path)
    assert done.returncode == 1 and not done.stdout
    assert "lacks the columns: tau" in done.stderr and "Traceback" not in done.stderr


def test_stress_and_strain(tmp_path):
    for name in ("steady.csv", "quasistatic.csv"):
        (tmp_path / name).write_text("strain,stress\n" + "".join(
            f"{0.01 * i},{0.002 + 0.001 * (i < 50)}\n" for i in range(101)))
    done = plot_command(tmp_path, "shear")
    assert done.returncode == 0 and (tmp_path / "shear.png").exists(), done.stderr
    assert "quasi-static   stress 0.002," in done.stdout
    (tmp_path / "shear.png").unlink()
    (tmp_path / "steady.csv").write_text("strain,pressure\n0,1\n")
    done = plot_command(tmp_path, "shear")
    assert "steady.csv lacks the columns: stress" in done.stderr and done.returncode != 0
    assert not (tmp_path / "shear.png").exists()


@pytest.mark.parametrize("text, said", [
    ("strain,stress\n", "0 lines of numbers"), ("strain,stress\n0,1\n", "1 lines of numbers"),
    ("strain,stress\n0,1\n0.1\n", "needs 2 numbers"), ("strain,stress\n0,1\n0.1,much\n", "needs 2 numbers")])
def test_tables_of_stress_that_are_none(tmp_path, text, said):
    for name in ("steady.csv", "quasistatic.csv"):
        (tmp_path / name).write_text(text)
    done = plot_command(tmp_path, "shear")
    assert said in done.stderr and done.returncode != 0 and "Traceback" not in done.stderr


# ------------------------------------------------------------------ exponents

def test_exponent_of_a_power_law():
    tau = np.geomspace(0.01, 100, 1000)
    series = {"tau": tau, "R": 3 * tau**0.5}
    assert plot.exponent(series, 100, 1.0) == pytest.approx(0.5, abs=1e-12)
    where, slopes = plot.local_exponents(series)
    assert slopes == pytest.approx(0.5, abs=1e-12)
    # middles of windows, the first begins a decade before the end and the last ends there
    assert where[[0, -1]] == pytest.approx([10 * 10**(1 / 6), 100 * 10**(-1 / 6)])
    assert "growth exponent  0.50, between 0.50 and 0.50" in plot.growth_lines(series)[0]


def test_range_of_an_exponent_that_depends_on_the_window():
    tau = np.geomspace(0.01, 100, 1000)
    # slope 0.25 up to tau = 31.6, then 0.45: one number would hide it
    series = {"tau": tau, "R": np.where(tau < 10**1.5, tau**0.25, 10**-0.3 * tau**0.45)}
    line = plot.growth_lines(series)[0]
    assert ", between 0.25 and 0.45 " in line
    assert 0.3 < float(line.split()[2].rstrip(",")) < 0.4


def test_no_exponent_without_points():
    series = {"tau": np.array([0.0, 1.0, 50.0]), "R": np.array([1.0, 1.1, 2.0])}
    assert "too few points" in plot.growth_lines(series)[0]


def test_picture_of_a_table_without_any_slope(tmp_path):
    series = {"tau": np.array([30.0, 31.0]), "R": np.array([1.0, 1.1]), "N": np.array([200.0, 190.0])}
    plot.plot_growth(series, tmp_path / "growth.png", 2)
    assert (tmp_path / "growth.png").exists()


# ------------------------------------------------------------------ in.coarsen

def coarsen(directory, **variables):
    variables = {"K": 0.01, "nrelax": 20, "rounds": 2, "limit": 0, "report": 1000, **variables}
    command = [LMP, "-in", EXAMPLES / "coarsen" / "in.coarsen"]
    for name, value in variables.items():
        command += ["-var", name, str(value)]
    return subprocess.run(command, cwd=directory, capture_output=True, text=True, timeout=300)


def frames(path):
    return list(plot.read_dump(path))


def test_snapshots_at_values_of_tau_and_numbers_of_bubbles(tmp_path):
    (tmp_path / "N.lammpstrj").write_text("of an earlier run\n")
    done = coarsen(tmp_path, N=400, end=200, at_tau="1,0.25,1e6", at_N="250,350,10,300")
    assert done.returncode == 0, done.stdout
    series = plot.read_series(tmp_path / "series.csv")
    assert np.all(np.diff(series["tau"]) >= 0)          # tau goes on from run to run

    # at the first step that has reached it; a line of the table is up to two steps away
    at_tau = frames(tmp_path / "tau.lammpstrj")
    assert len(at_tau) == 2
    for frame, wanted in zip(at_tau, (0.25, 1.0)):
        before, after = (np.searchsorted(series["step"], frame.step + shift) for shift in (-2, 0))
        assert series["tau"][before] < wanted <= series["tau"][after]

    at_number = frames(tmp_path / "N.lammpstrj")
    assert len(at_number) == 3
    for frame, wanted in zip(at_number, (350, 300, 250)):
        assert wanted - 5 <= len(frame) <= wanted       # several may vanish in one step
    assert len(frames(tmp_path / "last.lammpstrj")[0]) <= 200
    assert series["N"][-1] == len(frames(tmp_path / "last.lammpstrj")[0])

    pictures, _ = plot.make_pictures(tmp_path)
    assert [path.name for path in pictures] == ["growth.png", "foam.png", "sizes.png"]
    assert all(path.exists() for path in pictures)


def start(directory, **variables):
    """The foam as coarsening begins, of 400 bubbles that coarsen until the first has vanished."""
    done = coarsen(directory, N=400, end=399, **variables)
    assert done.returncode == 0, done.stdout
    return frames(directory / "foam.lammpstrj")[0]


@pytest.mark.parametrize("dim", [2, 3])
def test_bidisperse_sizes_in_a_long_box(tmp_path, dim):
    frame = start(tmp_path, dim=dim, phi=0.7, sizes="bidisperse", ratio=1.5, share=0.25, aspect=2.5)
    box = (frame.hi - frame.lo)[:dim]
    assert box / box[0] == pytest.approx(np.array([1.0, 0.4, 0.4])[:dim], rel=1e-5)
    small = 1 / (1 + 0.25 * 0.5)
    large = frame["radius"] > 1
    assert frame["radius"] == pytest.approx(np.where(large, 1.5 * small, small), rel=1e-5)
    assert abs(large.sum() - 100) < 5 * np.sqrt(400 * 0.25 * 0.75)    # five standard deviations


def test_lognormal_sizes(tmp_path):
    radius = start(tmp_path, sizes="lognormal", std=0.4)["radius"]
    width = np.sqrt(np.log(1 + 0.4**2))
    logs = np.log(radius)
    assert abs(logs.mean() + width**2 / 2) < 5 * width / np.sqrt(400)
    assert abs(logs.std() - width) < 5 * width / np.sqrt(800)
    assert abs(np.mean(((logs - logs.mean()) / logs.std())**3)) < 5 * np.sqrt(6 / 400)   # no skew


def test_unknown_sizes_are_named(tmp_path):
    done = coarsen(tmp_path, sizes="wide")
    assert done.returncode != 0
    assert "sizes = wide must be normal, lognormal or bidisperse" in done.stdout
