"""Tables and frames of a run together; tables that are written; the words of the command."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from lammps_foam import command
from lammps_foam.analysis import runs, table
from lammps_foam.analysis.read import Unusable
from written import dump_text, lammps_foam, write_series

ROWS = np.array([[1, 1, 1, 0, 2.0], [2, 5, 5, 0, 0.0], [3, 8, 8, 0, 4.0]])


def write(path, rows=ROWS):
    (path / "foam.lammpstrj").write_text(dump_text([(0, rows), (10, rows)], ["id", "x", "y", "z", "radius"]))


def test_clock(tmp_path):
    """tau and <R_in> of a frame between lines; K although the time of the run begins at 7."""
    write(tmp_path)
    write_series(tmp_path / "series.csv", step=[0, 5, 15], time=[7, 8, 10], tau=[0, 0.1, 0.3],
                 R=[1, 1.25, 1.75], N=[2] * 3)
    clock = runs.Clock(tmp_path)
    _, (frame, tau) = runs.chosen_frames(tmp_path, runs.Range(None, None))
    assert tau == pytest.approx(0.2)
    assert clock.start_radius(frame) == pytest.approx(3 / 1.5)
    assert clock.exchange(frame) == pytest.approx(0.1 * 2**2)


def test_the_dead_do_not_count(tmp_path):
    write(tmp_path)
    frames = [frame for frame, tau in runs.chosen_frames(tmp_path, runs.Range(None, [2, 2])) if np.isnan(tau)]
    assert [frame["id"].tolist() for frame in frames] == [[1, 3]] * 2


@pytest.mark.parametrize("radius", [np.nan, -1, np.inf])
def test_impossible_radii(tmp_path, radius):
    rows = ROWS.copy()
    rows[1, 4] = radius
    write(tmp_path, rows)
    with pytest.raises(SystemExit, match="step 0: the bubble id 2 has a position or a radius that is not finite"):
        lammps_foam("sizes", tmp_path, "--N", 1, 5, "--out", tmp_path / "s")


def test_range():
    which = runs.Range([5, 2], None)
    assert which.has(3, 0) and not which.has(6, 0) and not which.has(float("nan"), 0) and bool(which)
    assert runs.Range(None, None).has(float("nan"), 3) and not runs.Range(None, None)
    with pytest.raises(Unusable, match="exclude each other"):
        runs.Range([1, 2], [1, 2])


def test_table(tmp_path, capsys):
    path = table.write({"a": [1, np.nan, 1 / 3], "b": ["x", "y,z", ""]}, tmp_path / "sub" / "t.csv")
    assert path.read_text() == 'a,b\n1,x\n,"y,z"\n0.3333333333,\n'
    assert [p.name for p in path.parent.iterdir()] == ["t.csv"]
    table.show({"n": range(1000)}, most=5)
    assert capsys.readouterr().out.split() == ["n", "0", "250", "500", "749", "999"]


@pytest.mark.parametrize(("value", "error", "text"), [
    (0.33333, 0.0123, "0.333 +- 0.012"), (0.33333, 0.00095, "0.33333 +- 0.00095"), (12.34, 5.6, "12.3 +- 5.6"),
    (1234.5, 56, "1234 +- 56"), (1, 0, "1 (no error known)"), (1, float("nan"), "1 (no error known)")])
def test_value_with_error(value, error, text):
    assert table.with_error(value, error) == text


@pytest.mark.parametrize("word", ["growth", "sizes", "avalanches", "motion", "rates"])
def test_help_has_an_example(word, capsys):
    with pytest.raises(SystemExit) as end:
        command.WORDS[word](["-h"])
    assert end.value.code == 0 and f"\n  lammps-foam {word} " in capsys.readouterr().out


def test_words_start_quickly():
    """What lammps-foam lmp imports before LAMMPS: neither numpy nor what needs it."""
    code = "import sys; from lammps_foam.command import main; sys.argv = ['lammps-foam', 'help']; main(); " \
           "sys.exit(any(name in sys.modules for name in ('numpy', 'matplotlib', 'scipy', 'argparse')))"
    python = Path(command.__file__).parents[1]
    done = subprocess.run([sys.executable, "-c", code], env={"PYTHONPATH": str(python)}, capture_output=True, text=True,
                          check=False)
    assert done.returncode == 0, done.stderr
    assert all(f"\n    {word} " in done.stdout for word in command.ANALYSIS)


@pytest.mark.parametrize("given, base", [("growth", "growth"), ("a/b.png", "a/b"), ("x.gif", "x"),
                                         ("phi0.85", "phi0.85"), ("run.2.csv", "run.2")])
def test_out_is_a_base(given, base):
    assert runs.without_end(given) == base
