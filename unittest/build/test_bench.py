"""The benchmark: a small run of all of it, and the arithmetic behind its figures."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

SOURCE = Path(os.environ["FOAM_SOURCE_DIR"])
sys.path.insert(0, str(SOURCE / "benchmarks"))

import counts      # noqa: E402
import machine     # noqa: E402
import run         # noqa: E402
import traffic     # noqa: E402

LMP = os.environ["FOAM_LMP_SOURCE"]


def kokkos_configuration():
    """The configuration with kk styles that the LAMMPS under test can run here, and how well its
    energies agree with those of the others."""
    back_ends, precision = machine.capabilities(LMP)
    name = "omp1" if "OpenMP" in back_ends else "serial" if back_ends == {"Serial"} else None
    return name, 1.0e-6 if precision == "double" else 1.0e-2


def test_small_run(tmp_path):
    done = subprocess.run(
        [sys.executable, SOURCE / "benchmarks" / "run.py", "--lmp", LMP, "--bubbles", "400,800",
         "--scene", "2d", "--steps", "15", "--repeat", "1", "--threads", "1", "--other",
         "another:2d:400=12.5", "--out", tmp_path / "out"],
        capture_output=True, text=True, timeout=300, cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    report = json.loads((tmp_path / "out" / "bench.json").read_text())

    runs = {(r["configuration"], r["what"], r["nominal"]): r for r in report["runs"]}
    kokkos, tolerance = kokkos_configuration()
    for configuration in filter(None, ("base", kokkos)):
        for bubbles in (400, 800):
            one = runs[configuration, "foam", bubbles]
            assert 0.95 * bubbles < one["bubbles"] <= bubbles
            assert one["evaluations"] >= 30     # two for each step and those of rejected ones
            assert one["ns"] == pytest.approx(
                1e9 * one["loop"] / one["evaluations"] / one["bubbles"])
            assert sum(one["split"].values()) == pytest.approx(one["ns"], rel=0.05)
            assert one["floor ns"] == pytest.approx(one["bytes"] / report["bandwidth"]["1"])
        assert (configuration, "history", 400) in runs
    assert ("base", "hooke", 400) in runs
    assert "12.5" in done.stdout
    assert (tmp_path / "out" / "bench.txt").read_text() in done.stdout + "\n"
    if not kokkos:
        return

    assert runs[kokkos, "foam", 800]["start energy"] == pytest.approx(
        runs["base", "foam", 800]["start energy"], rel=tolerance)
    assert (kokkos, "hooke", 400) not in runs
    foam, = [c for c in report["counts"] if c["what"] == "foam"]
    assert foam["builds in steady"] == 0
    contacts, = [row for row in foam["labels"]
                 if row["what"] == "launch" and row["label"].startswith("foam: contacts")]
    assert contacts["count"] == pytest.approx(1.0)
    assert sum(row["count"] for row in foam["labels"] if row["what"] == "launch") == pytest.approx(
        foam["steady"]["launches"])
    assert "foam: contacts" in done.stdout


def test_no_such_program(tmp_path):
    done = subprocess.run([sys.executable, SOURCE / "benchmarks" / "run.py", "--lmp", "false"],
                          capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode != 0 and "false -h failed" in done.stderr


def test_bytes_of_the_pass_over_contacts():
    # x and R in, 5 sums out, 1 count and 6 indices of neighbours
    assert sum(traffic.bytes_of(traffic.PAIR, 2, 3.0)) == 8 * (4 + 5) + 4 * (1 + 6)
    assert sum(traffic.bytes_of(traffic.PAIR, 3, 3.0, "single")) == 4 * (4 + 5) + 4 * (1 + 6)


def test_rejected_steps_evaluate_once():
    accepted, half = (traffic.per_evaluation("foam", 2, 3.0, rejected) for rejected in (0.0, 0.5))
    predict, pair, correct, rates = (sum(traffic.bytes_of(loop, 2, 3.0))
                                     for loop in traffic.LOOPS["foam"])
    assert accepted == (predict + 2 * pair + correct + rates) / 2
    assert half == (accepted + predict + pair + correct) / 2


@pytest.mark.parametrize("copies, dim, shape", [
    (1, 2, [1, 1, 1]), (10, 2, [5, 2, 1]), (100, 2, [10, 10, 1]),
    (10, 3, [5, 2, 1]), (100, 3, [5, 5, 4]), (1000, 3, [10, 10, 10]),
])
def test_copies_make_a_compact_box(copies, dim, shape):
    assert run.factors(copies, dim) == shape


def test_labels_are_readable():
    reducer = ("CombinedFunctorReducer<LAMMPS_NS::ComputeTempKokkos<Kokkos::OpenMP>, FunctorAnalysis"
               "<FunctorPatternInterface::REDUCE, Kokkos::RangePolicy<Kokkos::OpenMP, LAMMPS_NS::"
               "TagScalar<1> >, X, void>::Reducer, void>/LAMMPS_NS::TagScalar<1>")
    assert counts.short(reducer) == "ComputeTempKokkos/TagScalar<1>"
    assert counts.short("foam: contacts") == "foam: contacts"
