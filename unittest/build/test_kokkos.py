"""The KOKKOS styles, compiled in the ways in which the LAMMPS of the other tests does not have them:
inside LAMMPS' own sources, in mixed and single precision, and for NVIDIA's GPUs.

LAMMPS is configured for it but not built, so that this takes a minute or two and no GPU, only nvcc, and
nothing is optimized. With FOAM_TEST_FULL_BUILD set, LAMMPS for the host is compiled whole and run.
"""

import re
import shutil

import pytest

from ways import (ALSO_KOKKOS, FULL_BUILD, KEPT, KOKKOS_STYLES, LAMMPS_BUILD, LAMMPS_SRC, OUR_KOKKOS, PROJECT,
                  UNOPTIMIZED, check_style_headers, check_styles, cmake, compile_files, configure, lammps_tree)

COMPILER = LAMMPS_SRC.parent / "lib" / "kokkos" / "bin" / "nvcc_wrapper"
CUDA = [f"-DCMAKE_CXX_COMPILER={COMPILER}", "-DKokkos_ENABLE_CUDA=on", "-DKokkos_ARCH_HOPPER90=on"]
FLAGS = ["-DCMAKE_BUILD_TYPE=Release", *([] if FULL_BUILD else UNOPTIMIZED)]
needs_nvcc = pytest.mark.skipif(not shutil.which("nvcc"), reason="no nvcc, NVIDIA's compiler")


def configured(name, *options):
    """LAMMPS' sources with ours in them and a build configured with these options."""
    # another LAMMPS, another directory
    where = KEPT / f"{LAMMPS_BUILD.parent.name}-{name}"
    tree, build = where / "lammps", where / "build"
    for family in "*foam*", "*bubble*", "*liquid*":    # our files of old
        for installed in (tree / "src").rglob(family):
            if not any(PROJECT.glob(f"src/*/{installed.name}")):
                installed.unlink()
    lammps_tree(tree, "FOAM", "KOKKOS_FOAM")
    configure(tree / "cmake", build, *FLAGS, "-DCMAKE_CXX_STANDARD=20", "-DBUILD_SHARED_LIBS=on",
              "-DBUILD_MPI=on", "-DBUILD_OMP=on", "-DBUILD_TOOLS=off", "-DFFT=KISS", "-DPKG_KOKKOS=on",
              "-DPKG_PLUGIN=on", "-DKokkos_ENABLE_SERIAL=on", "-DKokkos_ENABLE_OPENMP=on", *options)
    check_style_headers(build)
    check_style_headers(build, ALSO_KOKKOS, "_kokkos")
    return tree, build


def compile_ours(tree, build):
    compile_files(build, [tree / "src" / "KOKKOS" / f"{name}.cpp" for name in OUR_KOKKOS])
    assert {f"{name}.cpp.o" for name in OUR_KOKKOS} <= {p.name for p in build.rglob("*_kokkos.cpp.o")}


@pytest.mark.parametrize("precision", ["mixed", "single"])
def test_in_lammps_tree(tmp_path, precision):
    """Both Install.sh, then LAMMPS' CMake. Double precision is what the plugin is compiled in."""
    tree, build = configured(precision, f"-DKOKKOS_PREC={precision}")
    compile_ours(tree, build)
    if FULL_BUILD:
        cmake("--build", build)
        check_styles(tmp_path, build / "lmp", "-k", "on", styles=KOKKOS_STYLES)


@needs_nvcc
def test_for_cuda(tmp_path):
    """What only the device's compiler objects to must not wait for a GPU to be found."""
    tree, build = configured("cuda", *CUDA)
    compile_ours(tree, build)


@needs_nvcc
def test_plugin_for_cuda(tmp_path):
    """The plugin for such a LAMMPS: CMake refuses another compiler than LAMMPS', and names that."""
    _, build = configured("cuda", *CUDA)
    against = [f"-DLAMMPS_SOURCE_DIR={LAMMPS_SRC}", f"-DLAMMPS_BUILD_DIR={build}"]
    with pytest.raises(AssertionError) as refusal:
        configure(PROJECT, tmp_path / "wrong", *against)
    assert f"-DCMAKE_CXX_COMPILER={COMPILER}" in re.sub(r"\s+", " ", str(refusal.value))
    plugin = KEPT / f"{LAMMPS_BUILD.parent.name}-cuda-plugin"
    configure(PROJECT, plugin, *against, *FLAGS, CUDA[0])
    compile_files(plugin, [PROJECT / "src" / "FOAM" / "foamplugin.cpp"])
