"""CMakePresets.json: each preset configures against the LAMMPS from source that is under test."""

import json
import sys

import pytest

from ways import LAMMPS_BUILD, LAMMPS_SRC, PROJECT, cmake, configure

PRESETS = json.loads((PROJECT / "CMakePresets.json").read_text())
# by name, what the cache must say then
WANTED = {
    "installed": {},
    "source": {"CMAKE_BUILD_TYPE": "Release", "FOAM_TESTS": "OFF"},
    "source-tests": {"CMAKE_BUILD_TYPE": "Release", "FOAM_TESTS": "on"},
    "debug": {"CMAKE_BUILD_TYPE": "Debug", "FOAM_SANITIZE": ""},
    "sanitize": {"CMAKE_BUILD_TYPE": "Debug", "FOAM_SANITIZE": "address,undefined"},
}


@pytest.mark.parametrize("name", WANTED)
def test_configures(tmp_path, monkeypatch, name):
    build, prefix = tmp_path / "build", tmp_path / "prefix"
    monkeypatch.chdir(PROJECT)    # CMake looks for presets there
    if name == "installed":
        cmake("--install", LAMMPS_BUILD, "--prefix", prefix)
        monkeypatch.setenv("LAMMPS_PREFIX", str(prefix))
    else:
        monkeypatch.setenv("LAMMPS_SOURCE_DIR", str(LAMMPS_SRC))
        monkeypatch.setenv("LAMMPS_BUILD_DIR", str(LAMMPS_BUILD))
    out = configure(PROJECT, build, "--preset", name, f"-DPython3_EXECUTABLE={sys.executable}")
    assert "Building against LAMMPS" in out
    assert ("With KOKKOS styles" in out) == (name != "installed")
    entries = (line.partition("=") for line in (build / "CMakeCache.txt").read_text().splitlines())
    cache = {entry.partition(":")[0]: value for entry, _, value in entries}
    assert {key: cache[key] for key in WANTED[name]} == WANTED[name]


def test_each_can_be_built():
    """A preset to build for each to configure, and one to test for that with tests."""
    shown = [preset["name"] for preset in PRESETS["configurePresets"] if not preset.get("hidden")]
    assert shown == list(WANTED)
    assert [preset["configurePreset"] for preset in PRESETS["buildPresets"]] == shown
    assert [preset["configurePreset"] for preset in PRESETS["testPresets"]] == ["source-tests"]
