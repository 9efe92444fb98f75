"""Figures of examples/thesis, of runs that were made up: exponents that are known, runs that are missing, minutes."""

import csv
import os
from pathlib import Path
import subprocess
import sys

import numpy as np
import pytest

THESIS = Path(os.environ["FOAM_SOURCE_DIR"]) / "examples" / "thesis"
sys.path.insert(0, str(THESIS))

from common import Place, Result, compare, minutes     # noqa: E402


def run_that_grows(directory, exponent, complete=True, end=100):
    """R = (1 + tau)^exponent, of 2000 bubbles that become 100."""
    directory.mkdir(parents=True)
    tau = np.concatenate(([0.0], np.geomspace(1.0e-3, 1.0e5, 4000)))
    R = (1 + tau)**exponent
    N = np.ceil(2000 / R**2)
    last = np.flatnonzero(N <= end)[0] + 1
    rows = np.column_stack([np.arange(len(tau)), tau, N, R])[:last]
    np.savetxt(directory / "series.csv", rows, fmt="%.12g", delimiter=",", header="step,tau,N,R", comments="")
    (directory / "log.foam").write_text("Loop time of 20 on 1 procs\nTotal wall time: 0:03:00\n")
    if complete:
        (directory / "complete").write_text(f"--- complete: step {last}, tau {tau[last]:g}, 100 bubbles\n")


def plot(*arguments):
    return subprocess.run([sys.executable, THESIS / "plot.py", *map(str, arguments)], capture_output=True, text=True,
                          timeout=300)


def table(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def test_exponents_of_what_is_complete(tmp_path):
    for phi, exponent, complete in ((0.80, 0.35, True), (0.90, 0.45, True), (0.95, 0.45, False)):
        run_that_grows(tmp_path / f"phi{phi:.2f}-1995" / "run", exponent, complete)
    done = plot(tmp_path, "--figure", "exponents", "--no-pdf", "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    assert "exponents: 2 of 5 runs" in done.stdout
    assert (tmp_path / "out" / "thesis-exponents.png").exists()

    found = table(tmp_path / "out" / "exponents.csv")
    assert [row["phi"] for row in found] == ["0.8", "0.9"]
    for row, exponent in zip(found, (0.35, 0.45)):
        # R^n = tau + 1 exactly; the table's lines are 5e-3 apart in ln(tau), which is interpolated
        assert float(row["1/n"]) == pytest.approx(exponent, abs=1.0e-3)
        assert float(row["tau0"]) == pytest.approx(-1.0, abs=0.1)
        assert float(row["beta"]) < exponent    # tau / (tau + 1) of it

    runs = {row["run"]: row for row in table(tmp_path / "out" / "runs.csv")}
    assert runs["phi0.80-1995"]["minutes"] == "3"
    assert runs["phi0.95-1995"]["steps"] == "not yet run" and runs["phi0.95-1995"]["minutes"] == ""
    (line,) = table(tmp_path / "out" / "summary.csv")
    assert line["figure"] == "4.1" and line["minutes"] == "6" and "φ = 0.90: slope 0.4" in line["ours"]


def test_wrong_directory(tmp_path):
    done = plot(tmp_path / "nothing")
    assert done.returncode != 0 and "is no directory; it should be the --out of run.py" in done.stderr
    assert "Traceback" not in done.stderr


def test_some_of_the_runs():
    done = subprocess.run([sys.executable, THESIS / "run.py", "--full", "--only", "phi0.85-1995", "--dry-run"],
                          capture_output=True, text=True, timeout=60)
    assert done.returncode == 0 and done.stdout.startswith("phi0.85-1995 ") and done.stdout.count("\n") == 1
    done = subprocess.run([sys.executable, THESIS / "run.py", "--only", "phi0.87-1995", "--dry-run"],
                          capture_output=True, text=True, timeout=60)
    assert done.returncode != 0 and "no such run: phi0.87-1995" in done.stderr


def causes(directory, figures):
    return subprocess.run([sys.executable, THESIS / "causes.py", "--out", directory, "--no-runs", "--figures", figures,
                           "--no-pdf"], capture_output=True, text=True, timeout=300)


def test_causes_that_are_not_here_stay_in_the_table(tmp_path):
    for case, exponents in (("as-figure-4.1", (0.45, 0.46)), ("kappa-0", (0.40, 0.41)), ("K-1e-4", (0.47,))):
        for seed, exponent in enumerate(exponents, 1):
            run_that_grows(tmp_path / f"phi1.00-{case}-{seed}" / "run", exponent, end=20)
    done = causes(tmp_path, tmp_path / "out")
    assert done.returncode == 0, done.stderr
    before = table(tmp_path / "out" / "causes.csv")
    assert [(row["case"], row["runs"]) for row in before] == [("as figure 4.1", "2"), ("kappa 0", "2"), ("K 1e-4", "1")]
    # R = (1 + tau)^b: the slope is b tau / (1 + tau), and the difference of two slopes a little less than that of the b
    assert [float(row["change"]) for row in before[1:]] == [pytest.approx(-0.05, rel=0.1), pytest.approx(0.02, rel=0.1)]

    for seed in (1, 2):
        (tmp_path / f"phi1.00-kappa-0-{seed}" / "run" / "complete").unlink()
    done = causes(tmp_path, tmp_path / "out")
    assert done.returncode == 0, done.stderr
    assert table(tmp_path / "out" / "causes.csv") == before
    assert {row["case"] for row in table(tmp_path / "out" / "causes-curves.csv")} == {row["case"] for row in before}
    assert (tmp_path / "out" / "thesis-causes.png").exists()


def test_minutes_of_a_run_that_was_interrupted(tmp_path):
    (tmp_path / "log.foam").write_text(
        "   Step   Time   CPU\n  0  0  0\n  50  1  2.5\nLoop time of 2.5 on 1 procs for 50 steps\n"
        "   Step   Time   CPU\n  50  1  0\n  100  2  57.5\n  150  3  4000.0\n")    # held for an hour, then killed
    (tmp_path / "log.foam.1").write_text("Total wall time: 1:02:00\n")
    assert minutes(tmp_path) == pytest.approx(1 + 62)


def test_lines_of_other_figures_stay(tmp_path):
    place = Place(tmp_path, tmp_path)
    compare(place, [Result("4.10", "a", "old", []), Result("4.2 to 4.5", "b", "old", [])], "run.py")
    compare(place, [Result("4.2 to 4.5", "b", "new", []), Result("open questions", "c", "new", [])], "run.py")
    assert [(row["figure"], row["ours"]) for row in table(tmp_path / "summary.csv")] == [
        ("4.2 to 4.5", "new"), ("4.10", "old"), ("open questions", "new")]
