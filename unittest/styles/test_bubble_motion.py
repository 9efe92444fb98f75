"""How bubbles with inertia move: against integrators and laws of conservation that know nothing of LAMMPS."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from test_bubble import GAS, MM, MU, R6, RHO, SIGMA, UM, G, data, elastic, text

LIQUID = f"{RHO} {MU} 0 0 -{G}"    # and upwards for bubbles
STILL = f"{RHO} {MU} 0 0 0 drag none"


def volume(R):
    return 4 / 3 * np.pi * R**3


def mass(R):
    return (GAS + 0.5 * RHO) * volume(R)


def drag(kind, R, u):
    """Force; Re and C_D as the model has them."""
    if u == 0.0:
        return 0.0
    Re = 2 * R * RHO * abs(u) / MU
    if kind == "contaminated":
        C = 24 / Re * (1 + 0.15 * Re**0.687) if Re <= 1000 else 0.44
    else:
        C = 16 / Re * (1 + 1 / (8 / Re + 0.5 * (1 + 3.315 / np.sqrt(Re))))
    return -0.5 * RHO * C * np.pi * R**2 * abs(u) * u


def buoyancy(R):
    return (RHO - GAS) * volume(R) * G


def exact(acceleration, state, end):
    """Place and speed at the time end, to 1e-11."""
    found = solve_ivp(lambda _, y: [y[1], acceleration(*y)], (0, end), state, method="DOP853", rtol=1e-12, atol=1e-16)
    return found.y[:, -1]


def last(result):
    frame = result.dump("dump")[-1]
    return frame.array("x", "y", "z"), frame.array("vx", "vy", "vz")


# ---- a free rise --------------------------------------------------------------------------------

@pytest.mark.parametrize("implicit", ["no", "yes"])
@pytest.mark.parametrize("kind", ["contaminated", "clean"])
def test_rise(lmp, kind, implicit):
    """Of second order: errors fall by 4, within what the next order leaves."""
    R, end = 0.1 * MM, 0.02
    z, u = exact(lambda z, u: (buoyancy(R) + drag(kind, R, u)) / mass(R), [0.0, 0.0], end)
    places, speeds = [], []
    for steps in 40, 80, 160:
        result = lmp(text(rise=f"{LIQUID} drag {kind} implicit {implicit}", dt=end / steps, every=steps,
                          run=f"run {steps}"), data([0, 0, 0], R))
        x, v = last(result)
        places.append(abs(x[0, 2] - z))
        speeds.append(abs(v[0, 2] - u))
    assert places[0] < 0.02 * z
    for errors in places, speeds:
        assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.25)
        assert errors[1] / errors[2] == pytest.approx(4.0, rel=0.15)


@pytest.mark.parametrize("implicit", ["no", "yes"])
@pytest.mark.parametrize("kind", ["contaminated", "clean"])
@pytest.mark.parametrize("R", [10 * UM, R6, 3 * MM])
def test_terminal_velocity(lmp, R, kind, implicit):
    """That of the drag law, whatever the step is, and the powers cancel."""
    speed = brentq(lambda u: buoyancy(R) + drag(kind, R, u), 1e-9, 10.0, xtol=1e-15)
    relax = mass(R) * speed / buoyancy(R)
    result = lmp(text(rise=f"{LIQUID} drag {kind} implicit {implicit}", dt=0.1 * relax, every=400, run="run 400"),
                 data([0, 0, 0], R))
    assert last(result)[1][0] == pytest.approx([0, 0, speed], rel=1e-9)
    table = result.thermo[0]
    assert table["f_r[3]"][-1] == pytest.approx(buoyancy(R) * speed, rel=1e-9)
    assert table["f_r[4]"][-1] == pytest.approx(-buoyancy(R) * speed, rel=1e-9)


def test_flow(lmp):
    """The drag is relative to the liquid: terminal velocity in a liquid that goes along."""
    speed = brentq(lambda u: buoyancy(R6) + drag("contaminated", R6, u), 1e-9, 10.0, xtol=1e-15)
    before = "variable ux atom 0.2\nvariable uz atom -0.05"
    result = lmp(text(rise=f"{LIQUID} flow v_ux NULL v_uz", before=before, dt=1e-3, every=400, run="run 400"),
                 data([0, 0, 0], R6))
    assert last(result)[1][0] == pytest.approx([0.2, 0, speed - 0.05], rel=1e-9)


# ---- one bounce ---------------------------------------------------------------------------------

def tilted(degrees, distance, R=R6):
    """A plane above the origin that is tilted: its arguments, its normal."""
    angle = np.deg2rad(degrees)
    n = np.array([np.sin(angle), 0.0, -np.cos(angle)])
    return "plane {} {} {} {} {} {}".format(*(-distance * n), *n), n


BUDGETS = {
    "published": "",
    "derived": "viscous derived",
    "exact": "viscous derived integral exact",
    "current": "h0 current",
    "given": "h0 2e-5",
    "no film": "film no",
    "spring": "elastic spring viscous none lubrication no",
    "elastic": "viscous none lubrication no",
}


@pytest.mark.parametrize("implicit", ["no", "yes"])
@pytest.mark.parametrize("name", BUDGETS)
def test_budget_of_a_bounce(lmp, name, implicit):
    """Work of buoyancy and drag = kinetic + elastic + what each viscous term has taken. 1e-6: the goal; the step is of
    second order, but for one jump of a force where the film closes."""
    wall, n = tilted(20, 3 * R6)
    result = lmp(text(pair=BUDGETS[name], wall=wall, rise=f"{LIQUID} implicit {implicit}", dt=1e-6, every=500,
                      run="run 60000"), data([0, 0, 0], R6))
    t = result.thermo[0]
    given = t["f_r[1]"] + t["f_r[2]"]
    kept = t["f_r[5]"] + t["f_w"] + t["f_w[8]"] + t["f_w[9]"] + t["f_w[10]"]
    assert t["f_w[4]"].max() == 1
    assert np.abs(given - kept).max() < 1e-6 * t["f_r[1]"][-1]
    assert min(t[f"f_w[{k}]"].min() for k in (8, 9, 10)) >= 0.0
