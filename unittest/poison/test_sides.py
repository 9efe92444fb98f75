"""Columns on a host and a device that are different memory, the outdated side full of NaN (see
poisoned_storage.h): the KOKKOS styles do what they do elsewhere, so they read and write on the right
side; and each mistake that can be made with columns is seen."""

import os
import re
from pathlib import Path

import numpy as np
import pytest

import runner as styles
import test_bubble_kokkos as inertia
import test_liquid_kokkos as liquid
from test_kokkos import assert_same, of_base_styles, scene    # noqa: F401 (a fixture)

styles.BACKENDS["poisoned"] = styles.Backend("FOAM_LMP_POISONED",
                                             f"-k on t 2 -sf kk -pk kokkos {styles.ON_DEVICE}")
styles.BACKENDS["poisoned host"] = styles.Backend("FOAM_LMP_POISONED", "-k on t 1 -sf kk")


def run(runner, name, then="", **more):
    family, _, its = name.rpartition(": ")
    if family == "liquid":
        text, data, ranks = liquid.text_of(its)
    else:
        text, data, ranks = (inertia.scene(its) if family == "inertia" else scene(name))[:3]
    return runner(text + then, files=data, ranks=ranks, **more)


# what asks for the sides in different orders: ways through the host, lists, removal, history, output
NAMES = ["plain", "3D", "drag between bubbles", "drag between bubbles 3D on 2 ranks",
         "neighbor drag", "neighbor drag 3D on 2 ranks", "drift removed", "source",
         "source, neighbor drag", "rkc", "rkc 3D, neighbor drag, 2 ranks", "film only", "4 ranks",
         "sorted often on 2 ranks", "cutoffs renewed on 4 ranks", "sheared, rkc, 2 ranks",
         "flow with the box, 2 ranks", "flow in a region", "other forces",
         "viscous", "two runs", "pre no", "restarts written", "integrator again", "exchange again",
         "drag changed", "minimized", "bubbles added", "bubbles deleted", "radii changed",
         "state stored, 2 ranks", "contact ages", "contact ages, 2 ranks", "paths",
         "paths, rkc 3D, 2 ranks", "foam walls",
         "foam walls, rkc 3D, 2 ranks", "foam walls for some", "among others",
         "among others, rkc, neighbor drag, 2 ranks"]


# of bubbles with inertia
INERTIA = ["inertia: " + name for name in (
    "exact integral", "region", "flow", "implicit drag", "some move", "sorted often", "energies and stresses",
    "chosen steps, 2 ranks", "pair style again", "bubbles deleted", "restarts written")]
# of a liquid
LIQUID = ["liquid: " + name for name in (
    "liquid alone", "plain", "2 ranks", "turbulence", "breaking", "bursting", "sparger", "entrained", "start given",
    "sorted often", "ranks in tiles", "two runs", "bubbles deleted", "restarts written")]
WAYS = pytest.mark.parametrize("way", ["poisoned", "poisoned host"])


@WAYS
@pytest.mark.parametrize("name", NAMES)
def test_same_as_elsewhere(tmp_path, of_base_styles, name, way):
    assert_same(of_base_styles(name), run(styles.Runner(way, tmp_path), name), scene(name)[3])


@pytest.fixture(scope="session")
def inertia_of_base_styles(tmp_path_factory):
    """function: what the base styles make of a scene"""
    return lambda name: run(styles.Runner("wheel", tmp_path_factory.mktemp("inertia")), name)


@WAYS
@pytest.mark.parametrize("name", INERTIA)
def test_same_as_elsewhere_with_inertia(tmp_path, inertia_of_base_styles, name, way):
    inertia.assert_same(inertia_of_base_styles(name), run(styles.Runner(way, tmp_path), name), inertia.SHORT)


@pytest.fixture(scope="session")
def liquid_of_base_styles(tmp_path_factory):
    """function: what the base styles make of a scene"""
    return lambda name: run(styles.Runner("wheel", tmp_path_factory.mktemp("liquid")), name)


@WAYS
@pytest.mark.parametrize("name", LIQUID)
def test_same_as_elsewhere_with_a_liquid(tmp_path, liquid_of_base_styles, name, way):
    liquid.assert_same(liquid_of_base_styles(name), run(styles.Runner(way, tmp_path), name), liquid.SHORT)


# ---- mistakes -----------------------------------------------------------------------------------

# all columns of the styles, and a scene that uses them: neighbor drag has lags, the scheme source work
COLUMNS = {
    "contacts": "neighbor drag", "sums of velocities": "neighbor drag", "contact areas": "plain",
    "film exchange": "plain", "energies": "plain", "gas and rates": "plain",
    "lagged velocities": "neighbor drag", "starts": "plain", "velocities of the start": "neighbor drag",
    "listed places": "plain", "work of the scheme": "source",
    "velocities of the liquid": "flow with the box, 2 ranks",
    "velocities of a flow": "flow with the box, 2 ranks",
    "given velocities": "drag between bubbles", "residuals of the drag": "drag between bubbles",
    "velocities with drag between bubbles": "drag between bubbles",
    "contact records": "contact ages", "contact records on trial": "contact ages",
    "ages of contacts": "contact ages", "stress at walls": "foam walls", "lengths of paths": "paths",
    "steps of bubbles": "inertia: region", "liquid around bubbles": "inertia: flow",
    "forces of the liquid": "inertia: region", "terms of collisions": "inertia: region",
    "stress of collisions": "inertia: energies and stresses",
    "state of the liquid": "liquid: plain", "columns of the liquid": "liquid: plain",
    "vectors of the solver": "liquid: liquid alone", "state of bubbles in a liquid": "liquid: plain",
    "columns of bubbles in a liquid": "liquid: plain", "bubbles before the step": "liquid: plain",
    "dissipation at the surface": "liquid: entrained",
}
ELSEWHERE = {"residuals of places"}    # in use in single precision alone


def test_all_columns_are_here():
    """Those that the sources declare."""
    declared = set()
    for path in (Path(os.environ["FOAM_SOURCE_DIR"]) / "src").rglob("*.h"):
        declared |= set(re.findall(r'FoamColumns \w+\{all_columns, "([^"]*)"', path.read_text()))
    assert declared == COLUMNS.keys() | ELSEWHERE


@pytest.mark.parametrize("columns", COLUMNS)
def test_columns_that_are_forgotten_are_seen(tmp_path, monkeypatch, columns):
    """Kept on the host alone, they are asked for on the device: an error that names them."""
    monkeypatch.setenv("FOAM_POISON_FORGET", columns)
    result = run(styles.Runner("poisoned", tmp_path), COLUMNS[columns], check=False)
    assert result.returncode
    assert f"{columns} are columns that are kept on the host alone" in result.screen


@pytest.mark.parametrize("columns", ["gas and rates", "lagged velocities"])
def test_sides_that_are_not_brought_up_to_date_are_seen(tmp_path, monkeypatch, columns):
    """Those that the host reads or writes in the set-up of a run: without the copy it is another run, or
    none, since NaN is read on one of the sides."""
    def two_runs(way):
        return run(styles.Runner("poisoned", tmp_path / way), COLUMNS[columns], "run 20\n", check=False)

    right = two_runs("right")
    monkeypatch.setenv("FOAM_POISON_LEAVE", columns)
    wrong = two_runs("wrong")
    assert right.returncode == 0
    assert wrong.returncode or any(
        not np.array_equal(one[name], other[name])
        for one, other in zip(right.thermo, wrong.thermo) for name in one)
