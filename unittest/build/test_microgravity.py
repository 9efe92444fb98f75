"""Tables of examples/microgravity: crossovers and jamming points that are known, forces and overlaps of two bubbles, a
small run with a packing of its sizes, and no run at all."""

import csv
import os
from pathlib import Path
import subprocess
import sys

import numpy as np
import pytest

MICROGRAVITY = Path(os.environ["FOAM_SOURCE_DIR"]) / "examples" / "microgravity"
LMP = os.environ["FOAM_LMP_WHEEL"]


@pytest.fixture
def modules(monkeypatch):
    """crossover, states and tables. Other examples have modules of the same names: those are not to be met."""
    names = ("run", "crossover", "states", "tables", "packing")
    monkeypatch.syspath_prepend(str(MICROGRAVITY))
    for name in names:
        monkeypatch.delitem(sys.modules, name, raising=False)
    import crossover
    import states
    import tables
    yield crossover, states, tables
    for name in names:
        sys.modules.pop(name, None)


def python(script, *arguments):
    return subprocess.run([sys.executable, MICROGRAVITY / script, *map(str, arguments)], capture_output=True, text=True,
                          timeout=600)


def table(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


# ------------------------------------------------------------------ crossovers

def test_crossing_of_a_straight_line(modules):
    crossover, _, _ = modules
    x = np.linspace(0.15, 0.50, 8)
    y = 0.5 - (x - 0.15) / 0.35 / 6      # 1/2 to 1/3: the middle is at 0.325
    exact = crossover.crossing(x, y, np.zeros(8), crossover.MIDDLE)
    assert exact.found and exact.value == pytest.approx(0.325, abs=1e-12)
    # a seventh of the change between two points: a seventh of their distance over sqrt(12)
    assert exact.error == pytest.approx(0.05 / np.sqrt(12) / 7, rel=1e-9)

    error = 0.002
    noisy = crossover.crossing(x, y, np.full(8, error), crossover.MIDDLE)
    # the level lies in the middle between two points: their mean is uncertain by error / sqrt(2), over the slope.
    # 1000 samples know it to 2 %; samples in which another interval is the first add some: 20 % in all
    assert np.sqrt(noisy.error**2 - exact.error**2) == pytest.approx(error / np.sqrt(2) * 6 * 0.35, rel=0.2)


def test_a_step_is_known_to_the_distance_of_its_points(modules):
    crossover, _, _ = modules
    x, y = np.array([0.2, 0.3, 0.4, 0.5]), np.array([0.1, 0.1, 1.0, 1.0])
    found = crossover.crossing(x, y, np.zeros(4), 0.5)
    assert 0.3 < found.value < 0.4 and found.error == pytest.approx(0.1 / np.sqrt(12))


def test_no_crossing(modules):
    crossover, _, _ = modules
    x = np.array([0.2, 0.3, 0.4])
    assert not crossover.crossing(x, np.full(3, 0.5), np.full(3, 0.01), crossover.MIDDLE).found
    assert not crossover.crossing(x[:1], x[:1], x[:1], 0.2).found
    # crosses by luck alone: about half of the samples do not
    assert not crossover.crossing(x, np.array([0.5, 0.45, 0.416]), np.full(3, 0.001), crossover.MIDDLE).found


def test_peaks(modules):
    crossover, _, _ = modules
    density = np.array([0.0, 1.0, 0.4, 2.0, 0.5])
    assert crossover.peaks(density, np.full(5, 0.1)) == (pytest.approx(0.6 / np.hypot(0.1, 0.1)), 1, 3, 2)
    assert crossover.peaks(np.array([0.0, 1.0, 2.0, 1.0]), np.full(4, 0.1))[0] == 0


def test_numbers_with_errors(modules):
    _, _, tables = modules
    assert [tables.short(*pair) for pair in ((0.3333, 0.0123), (0.5, 0.1), (7.0, 1.6), (1.0, 0.0), (12.0, np.nan))] == [
        "0.333(12)", "0.50(10)", "7.0(1.6)", "1", "12"]
    assert tables.verdict(0.49, 0.01) == "within two standard errors of 1/2"
    assert tables.verdict(0.40, 0.01) == "neither 1/2 nor 1/3"
    assert tables.verdict(0.40, 0.10) == "too uncertain to tell 1/2 from 1/3"


# ------------------------------------------------------------------ runs of several sizes

def foam_of(states, series, fraction, bubbles):
    row = {"bubbles": float(bubbles), "last_N": 100.0, "1/n": 0.4, "1/n_error": 0.01}
    return (series, fraction), states.Foam(series, fraction, [], row)


def test_series_without_large_runs_are_those_of_smaller_ones(modules):
    _, states, tables = modules
    large = dict(foam_of(states, *what, 30000) for what in (("spring", 0.25), ("spring", 0.30), ("area", 0.30)))
    small = dict(foam_of(states, *what, 2000) for what in (("spring", 0.20), ("area", 0.20)))
    foams = tables.with_smaller(large, small)
    assert sorted(foams) == [("area", 0.20), ("spring", 0.25), ("spring", 0.30)]
    assert tables.matrix(foams, ["spring", "area", "films"], [0.20, 0.30], "1/n") == [
        {"liquid fraction": "0.20", "spring": "not run yet", "area (2000)": "0.400(10)", "films": "not run yet"},
        {"liquid fraction": "0.30", "spring": "0.400(10)", "area (2000)": "not run yet", "films": "not run yet"}]
    assert ("area", 0.30) in tables.with_smaller(large, {})
    assert tables.with_smaller({}, small) == small and tables.label(small, "area") == "area"


def test_changes_of_runs_that_are_not_here_stay(modules, tmp_path):
    _, _, tables = modules
    old = {"series": "spring", "change": "a tenth of K", "bubbles": "2000", "liquid fraction": "0.30",
           "rattlers": "-0.1(1)"}
    tables.write([old], tmp_path / "changes.csv")
    new = {**old, "liquid fraction": "0.20", "rattlers": "0"}
    again = {**old, "rattlers": "-0.2(1)"}
    assert tables.keep_others([new], tmp_path / "changes.csv") == [new, old]
    assert tables.keep_others([again], tmp_path / "changes.csv") == [again]
    assert tables.keep_others([], tmp_path / "nothing.csv") == []


def test_small_bubbles_of_theories(modules):
    _, _, tables = modules
    # the table of doc/microgravity.rst: LSW 0.029, Lemlich 0.098
    assert tables.below_half("lsw") == pytest.approx(0.029, abs=0.0005)
    assert tables.below_half("lemlich") == pytest.approx(0.098, abs=0.0005)


# ------------------------------------------------------------------ two bubbles

def pair(states, distance):
    from lammps_foam.analysis.pairs import Pairs
    return Pairs(np.array([0]), np.array([1]), np.array([[distance, 0.0, 0.0]]), np.array([3.0]))


def test_force_of_the_sticky_law(modules):
    _, states, _ = modules
    for depth, A, force in ((0.1, 0.0, 0.1), (-0.1, 0.0, 0.0), (0.1, 0.05, 0.1), (-0.03, 0.05, -0.03),
                            (-0.07, 0.05, -0.03), (-0.11, 0.05, 0.0)):
        found = states.force(pair(states, 3 * (1 - depth)), A)
        assert found == pytest.approx([force], abs=1e-12), (depth, A)


def test_overlap_of_two_bubbles(modules):
    _, states, _ = modules
    # spheres of 2 and 1 at the distance 2.5: by integration of the caps, pi h^2 (3 R - h) / 3
    cut = (2.5**2 + 2**2 - 1) / 5
    caps = sum(np.pi * h**2 * (3 * R - h) / 3 for h, R in ((2 - cut, 2), (1 - (2.5 - cut), 1)))
    assert states.lens_volume(pair(states, 2.5), np.array([2.0, 1.0])) == pytest.approx(caps, rel=1e-12)
    assert states.lens_volume(pair(states, 0.5), np.array([2.0, 1.0])) == pytest.approx(4 / 3 * np.pi, rel=1e-12)
    assert states.lens_volume(pair(states, 3.1), np.array([2.0, 1.0])) == 0.0


def test_a_pair_that_is_pushed_apart_is_not_at_rest(modules):
    _, states, _ = modules
    # net forces f and -f, and each bubble has the one contact f
    assert states.imbalance(pair(states, 2.5), 0.0, 2) == pytest.approx(1.0)
    assert np.isnan(states.imbalance(pair(states, 3.5), 0.0, 2))


# ------------------------------------------------------------------ runs

def test_jamming_where_the_pressure_is_gone(modules, tmp_path):
    import packing
    phi = np.linspace(0.70, 0.63, 15)
    pressure = np.where(phi > 0.652, 0.07 * (phi - 0.652), 0.0)    # a straight line, as law spring has it near jamming
    np.savetxt(tmp_path / "jam.txt", np.column_stack([phi, pressure, np.zeros(15)]), header="three columns")
    assert packing.jamming(tmp_path) == pytest.approx(0.652, abs=1e-9)
    np.savetxt(tmp_path / "jam.txt", np.column_stack([phi, np.zeros(15), np.zeros(15)]))
    assert np.isnan(packing.jamming(tmp_path))


def test_no_run(tmp_path):
    done = python("plot.py", tmp_path, "--full", "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    assert "has no complete run" in done.stdout
    rows = table(tmp_path / "out" / "exponents-adhesion.csv")
    assert len(rows) == 9 and {value for row in rows for value in list(row.values())[1:]} == {"not run yet"}
    assert (tmp_path / "out" / "findings.txt").read_text() == "* not run yet.\n"


def test_wrong_directory(tmp_path):
    done = python("plot.py", tmp_path / "nothing")
    assert done.returncode != 0 and "is no directory; it should be the --out of run.py" in done.stderr
    assert "Traceback" not in done.stderr


def run_of(directory, name, *arguments):
    """A run of in.microgravity in the directory that run.py would give it."""
    place = directory / name
    place.mkdir(parents=True)
    done = subprocess.run([LMP, "-in", MICROGRAVITY / "in.microgravity", "-log", "log.microgravity", *arguments],
                          cwd=place, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stdout + done.stderr
    (place / "complete").write_text("done\n")
    return done.stdout


def test_a_small_run_and_one_that_stops(tmp_path):
    words = ["-var", "N", "300", "-var", "left", "100", "70", "50", "30", "-var", "K", "0.01", "-var", "every", "2"]
    run_of(tmp_path, "spring-0.36-1", *words, "-var", "liquidfraction", "0.36")
    # without exchange through the liquid, and unjammed: the run would never end by its number of bubbles
    said = run_of(tmp_path, "films-0.45-1", *words, "-var", "liquidfraction", "0.45", "-var", "kappa", "0")
    assert "Fix halt condition for fix-id idle met" in said

    (tmp_path / "spring-0.36-1" / "complete").write_text("-var N 300\n")
    done = python("packing.py", tmp_path, "--lmp", LMP)
    assert done.returncode == 0 and done.stdout.split() == [f"spring-0.36-{seed}" for seed in (1, 2, 3)], done.stderr

    done = python("plot.py", tmp_path, "--no-pdf", "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    for name in ("adhesion", "exchange", "sizes", "approach", "slices"):
        assert (tmp_path / "out" / f"microgravity-{name}.png").exists()
    numbers = {row["series"]: row for row in table(tmp_path / "out" / "microgravity.csv")}
    assert 0 < float(numbers["spring"]["1/n"]) and numbers["films"].get("1/n") == ""
    assert float(numbers["spring"]["gas_change"]) < 1.0e-10       # rounding; the table has 12 digits
    # 70 spheres of several sizes pack to a gas fraction of 0.60 to 0.70 (monodisperse: 0.64; doc/model.rst: 0.66, 0.67)
    assert 0.30 < float(numbers["spring"]["rcp"]) < 0.40
    films = {row["liquid fraction"]: row["films"] for row in table(tmp_path / "out" / "exponents-exchange.csv")}
    assert films["0.36"] == "not run yet" and films["0.45"].startswith("stops at ")

    done = python("plot.py", tmp_path / "out", "--small", tmp_path, "--no-pdf")
    assert done.returncode == 0, done.stderr
    again = {row["series"]: row for row in table(tmp_path / "out" / "microgravity.csv")}
    assert again["spring"]["1/n"] == numbers["spring"]["1/n"]
