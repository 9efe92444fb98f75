"""Short runs with the plugin compiled for address and undefined sanitizers; LAMMPS itself is not.
Nothing is optimized, which compiles in a third of the time.

The shortest form of the main job: a random start that relaxes, coarsens, writes a restart and goes on
from it; in 2D and 3D, with base styles and with KOKKOS styles on one and two threads.
"""

import os
import subprocess

import pytest

from ways import KEPT, LAMMPS_BUILD, LAMMPS_SRC, PROJECT, UNOPTIMIZED, cmake, configure

SANITIZERS = "address,undefined"
BACK_ENDS = {"base": [], "kk-1": ["-k", "on", "t", "1", "-sf", "kk"],
             "kk-2": ["-k", "on", "t", "2", "-sf", "kk"]}
FOAMS = {
    "2d": {"N": 225, "end": 160, "K": 1.0e-2},
    "3d": {"dim": 3, "N": 216, "phi": 0.75, "end": 180, "K": 1.0e-2, "drag": "neighbor",
           "norm": "rms", "liquid": "lsw"},
}
SCRIPT = """
include       {example}
compute       b all foam/bubble contacts free rdot
run           5
write_restart state
clear
read_restart  state
fix           step all foam/abm 1.0e-3
fix           gas all foam/coarsen 1.0e-2 0.1 nmin 10
compute       b all foam/bubble contacts free rdot
dump          b all custom 5 bubbles id c_b[*]
run           20
"""


def library(name):
    """Run-time library of a sanitizer, as the compiler would link it."""
    return subprocess.run(["c++", f"-print-file-name=lib{name}.so"], capture_output=True, text=True,
                          check=True).stdout.strip()


@pytest.fixture(scope="session")
def plugin():
    """Directory of the plugin compiled for the sanitizers."""
    if not os.path.isabs(library("asan")) or not os.path.isabs(library("ubsan")):
        pytest.skip("the compiler has no libasan and libubsan")
    build = KEPT / f"{LAMMPS_BUILD.parent.name}-sanitizers"
    configure(PROJECT, build, f"-DFOAM_SANITIZE={SANITIZERS}", *UNOPTIMIZED,
              f"-DLAMMPS_SOURCE_DIR={LAMMPS_SRC}", f"-DLAMMPS_BUILD_DIR={LAMMPS_BUILD}")
    cmake("--build", build, "--target", "foamplugin")
    return build


@pytest.mark.parametrize("foam", FOAMS)
@pytest.mark.parametrize("back_end", BACK_ENDS)
def test_no_report(plugin, tmp_path, back_end, foam):
    (tmp_path / "in.foam").write_text(SCRIPT.format(
        example=PROJECT / "examples" / "coarsen" / "in.coarsen"))
    variables = {"nrelax": 20, "rounds": 2, **FOAMS[foam]}
    done = subprocess.run(
        [LAMMPS_BUILD / "lmp", *BACK_ENDS[back_end], "-in", "in.foam", "-nocite",
         *(word for name, value in variables.items() for word in ("-var", name, str(value)))],
        env={**os.environ, "LAMMPS_PLUGIN_PATH": str(plugin),
             # first of all libraries, since the program itself has none of it
             "LD_PRELOAD": f"{library('asan')} {library('ubsan')}",
             # what LAMMPS and MPI leave behind at the end is theirs
             "ASAN_OPTIONS": "detect_leaks=0", "UBSAN_OPTIONS": "print_stacktrace=1"},
        cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    reports = [line for line in done.stdout.splitlines()
               if "Sanitizer" in line or "runtime error" in line]
    assert not reports, done.stdout
    assert done.returncode == 0, done.stdout
    assert done.stdout.count("Loop time") > 3
