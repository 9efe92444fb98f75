"""What the tests of this directory share: running commands, CMake, and LAMMPS' sources with ours in
them.  The environment says where things are: see unittest/CMakeLists.txt."""

import os
import re
import shutil
import subprocess
from pathlib import Path

PROJECT = Path(os.environ["FOAM_SOURCE_DIR"])
LAMMPS_SRC = Path(os.environ["FOAM_LAMMPS_SOURCE_DIR"])
LAMMPS_BUILD = Path(os.environ["FOAM_LAMMPS_BUILD_DIR"])
# kept from one call of the tests to the next: compiling takes minutes
KEPT = Path(os.environ["FOAM_BINARY_DIR"]) / "unittest" / "build"
FULL_BUILD = os.environ.get("FOAM_TEST_FULL_BUILD")
UNOPTIMIZED = ["-DCMAKE_CXX_FLAGS_RELEASE=-O0 -DNDEBUG"]    # a third of the time, with nvcc too

ALSO_KOKKOS = {
    "pair": ["durian/foam", "bubble/collision", "liquid/sph"],
    "fix": ["foam/coarsen", "foam/abm", "foam/rkc", "foam/contacts", "foam/wall", "foam/flow",
            "bubble/rise", "bubble/nve", "bubble/films", "wall/bubble", "liquid/flow", "bubble/flow"],
    "compute": ["foam/bubble"],
}
BASE_ALONE = {
    "pair": [], "fix": ["bubble/sparger"],
    "compute": ["bubble/collision", "liquid/particle", "bubble/flow"],
}
STYLES = {kind: names + BASE_ALONE[kind] for kind, names in ALSO_KOKKOS.items()}
KOKKOS_STYLES = {kind: [f"{name}/{suffix}" for name in names
                        for suffix in ("kk", "kk/device", "kk/host")]
                 for kind, names in ALSO_KOKKOS.items()}
OURS = sorted(path.stem for path in (PROJECT / "src" / "FOAM").glob("*.cpp")
              if path.stem != "foamplugin")
OUR_KOKKOS = sorted(path.stem for path in (PROJECT / "src" / "KOKKOS_FOAM").glob("*.cpp"))


def run(*command, env=None, cwd=None):
    """Standard output of a command; its whole output in the failure when it fails."""
    done = subprocess.run([str(word) for word in command], env={**os.environ, **(env or {})},
                          cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert done.returncode == 0, f"{command} failed:\n{done.stdout}"
    return done.stdout


def check_styles(tmp_path, *lmp, styles=STYLES, env=None):
    """lmp knows all of these styles; it stops with an error at one that it does not."""
    script = tmp_path / "in.styles"
    script.write_text("".join(f'print "{name} is known: $(is_available({kind},{name}))"\n'
                              for kind, names in styles.items() for name in names))
    out = run(*lmp, "-in", script, "-log", "none", "-nocite", env=env, cwd=tmp_path)
    for names in styles.values():
        for name in names:
            assert f"{name} is known: 1" in out


def cmake(*arguments):
    # ccache, if there is one, also finds what was compiled in another directory; with nvcc it must
    # go by the files that were read, since what it would see preprocessed lacks the host's part
    return run(os.environ["FOAM_CMAKE"], *arguments,
               env={"CCACHE_BASEDIR": str(KEPT.parents[1]), "CCACHE_DEPEND": "1",
                    "CMAKE_BUILD_PARALLEL_LEVEL": str(os.cpu_count())})


def configure(source, build, *options):
    cache = (LAMMPS_BUILD / "CMakeCache.txt").read_text()
    mpicxx = re.search("^MPI_CXX_COMPILER:[A-Z]+=(.*)$", cache, re.M)
    launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
    return cmake("-G", "Ninja", f"-DCMAKE_MAKE_PROGRAM={os.environ['FOAM_GENERATOR_PROGRAM']}",
                 "-S", source, "-B", build, f"-DMPI_CXX_COMPILER={mpicxx.group(1)}", *launcher,
                 *options)


def compile_files(build, paths):
    """Only what these source files are compiled to: ninja builds that when asked for FILE^."""
    cmake("--build", build, "--target", *(f"{path}^" for path in paths))


def lammps_tree(tree, *packages):
    """LAMMPS' sources as links in the directory `tree`, with ours of these packages among them."""
    if not tree.exists():
        tree.mkdir(parents=True)
        for entry in LAMMPS_SRC.parent.iterdir():
            if entry.name != "src":
                (tree / entry.name).symlink_to(entry)
        shutil.copytree(LAMMPS_SRC, tree / "src", copy_function=os.symlink)
    for package in packages:
        run("sh", PROJECT / "src" / package / "Install.sh", "1", tree / "src")


def check_style_headers(build, styles=STYLES, suffix=""):
    """LAMMPS' build has found the files of these styles."""
    for kind, names in styles.items():
        header = (build / "styles" / f"style_{kind}.h").read_text()
        for name in names:
            assert f'"{kind}_{name.replace("/", "_")}{suffix}.h"' in header
