"""Terms of the gas exchange that are left out: the others stay as they are."""

import numpy as np
import pytest

from foams import SAME, case, foam
from runner import data_file

STEP = 1.0e-4
VFILM, VLIQUID, RDOT = "c_b[4]", "c_b[5]", "c_b[6]"


def run(lmp, dim, gas, pair=""):
    """The frames before and after one short step."""
    x, R, v, side = foam(dim, 12 if dim == 2 else 6)
    text = case(dim, gas=gas, pair=pair, step=f"1e-3 dt0 {STEP} dtmax {STEP}", run="run 1", every=1)
    return lmp(text, files={"data": data_file([side] * dim, x, R, v)}).dump("dump")


@pytest.mark.parametrize("pair", ["drag static", "drag neighbor"])
@pytest.mark.parametrize("liquid", ["area", "lsw"])
@pytest.mark.parametrize("dim", [2, 3])
def test_liquid_alone(each_lmp, dim, liquid, pair):
    both, _ = run(each_lmp, dim, f"1e-2 1.0 liquid {liquid}", pair)
    alone, after = run(each_lmp, dim, f"1e-2 1.0 liquid {liquid} film no", pair)
    R = alone["radius"]
    A = 2 * np.pi * R if dim == 2 else 4 * np.pi * R**2
    assert np.all(alone[VFILM] == 0.0) and np.any(both[VFILM] != 0.0)
    assert alone[VLIQUID] == pytest.approx(both[VLIQUID], rel=SAME, abs=SAME)
    assert alone[RDOT] == pytest.approx(alone[VLIQUID] / A, rel=SAME, abs=SAME)
    # the integrator takes the same rates: the step is so short that the rates hardly change in it
    # (springs move bubbles by 1e-5 or so of their distances, which free surfaces show)
    grown = (after["radius"] - R) / STEP
    assert grown == pytest.approx(alone[RDOT], abs=2e-3 * np.max(np.abs(alone[RDOT])))
    assert grown != pytest.approx(both[RDOT], abs=2e-3 * np.max(np.abs(both[RDOT])))


def test_nothing_at_all(each_lmp):
    before, after = run(each_lmp, 2, "1e-2 0.0 film no")
    assert np.array_equal(before["radius"], after["radius"])
    assert np.all(before[RDOT] == 0.0)
