"""How bubbles with inertia move: against integrators and laws of conservation that know nothing of LAMMPS."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicHermiteSpline
from scipy.optimize import brentq

from test_bubble import GAS, MM, MU, R6, RHO, SIGMA, UM, G, data, elastic, term, text, wrong

LIQUID = f"{RHO} {MU} 0 0 -{G}"    # and upwards for bubbles
STILL = f"{RHO} {MU} 0 0 0 drag none"


SOFT = wrong("eq. 9 at Delta = R has 7.2 sigma R^2, less than the kinetic energy: the centres pass each other")
JUMP = wrong("a step in which a film closes is not done again: its error is 100 tol, paths do not follow tol")
MOVING = wrong("h0 current, film yes: as h0 follows the speed it works on the surfaces; no term tells of that")


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
    R, end = 0.1 * MM, 2e-3    # twice the time in which the speed settles
    z, u = exact(lambda z, u: (buoyancy(R) + drag(kind, R, u)) / mass(R), [0.0, 0.0], end)
    places, speeds = [], []
    for steps in 80, 160, 320:
        result = lmp(text(rise=f"{LIQUID} drag {kind} implicit {implicit}", dt=end / steps, every=steps,
                          run=f"run {steps}"), data([0, 0, 0], R))
        x, v = last(result)
        places.append(abs(x[0, 2] - z))
        speeds.append(abs(v[0, 2] - u))
    assert places[0] < 1e-3 * z
    for errors in places, speeds:
        assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.25)
        assert errors[1] / errors[2] == pytest.approx(4.0, rel=0.15)


@pytest.mark.parametrize("implicit", ["no", "yes"])
@pytest.mark.parametrize("kind", ["contaminated", "clean"])
@pytest.mark.parametrize("R", [10 * UM, R6, 3 * MM])
def test_terminal_velocity(lmp, R, kind, implicit):
    """That of the drag law, whatever the step is, and the powers cancel."""
    speed = brentq(lambda u: buoyancy(R) + drag(kind, R, u), 1e-9, 100.0, xtol=1e-15)
    relax = mass(R) * speed / buoyancy(R)
    far = dict(before="atom_modify sort 0 0.0", after="neigh_modify binsize 0.5")    # it may rise by 0.5 m in a step
    result = lmp(text(rise=f"{LIQUID} drag {kind} implicit {implicit}", dt=0.1 * relax, every=400, run="run 400",
                      **far), data([0, 0, 0], R, box=[(-1, 1)] * 3))
    assert last(result)[1][0] == pytest.approx([0, 0, speed], rel=1e-9)
    table = result.thermo[0]
    assert table["f_r[3]"][-1] == pytest.approx(buoyancy(R) * speed, rel=1e-9)
    assert table["f_r[4]"][-1] == pytest.approx(-buoyancy(R) * speed, rel=1e-9)


def test_flow(lmp):
    """The drag is relative to the liquid: terminal velocity in a liquid that goes along."""
    speed = brentq(lambda u: buoyancy(R6) + drag("contaminated", R6, u), 1e-9, 100.0, xtol=1e-15)
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


BUDGETS = {    # and the step that they need: the film's friction begins with a jump
    "published": ("", 1e-6),
    "derived": ("viscous derived", 5e-8),
    "exact": ("viscous derived integral exact", 5e-8),
    "given": ("h0 2e-5", 1e-6),
    "no film": ("film no", 1e-6),
    "current": ("h0 current", 1e-6),
    "current, no film": ("h0 current film no", 1e-6),
    "spring": ("elastic spring viscous none lubrication no", 1e-6),
    "elastic": ("viscous none lubrication no", 1e-6),
}


def bounce(lmp, pair="", more="", end=8e-3, steps=8000, records=400, degrees=20, R=R6, speed=0.13, step="", wall=""):
    """Against a tilted wall, from a gap of 0.6 R."""
    plane, n = tilted(degrees, 1.6 * R)
    return lmp(text(pair=pair, wall=f"{plane} {wall}", rise=f"{LIQUID} {more}", dt=end / steps,
                    every=max(1, steps // records), run=f"run {steps}", step=f"fix s all bubble/nve {step}"),
               data([0, 0, 0], R, [[0, 0, speed]]))


def budget(table):
    """What is missing of the energy, at each time."""
    given = table["f_r[1]"] + table["f_r[2]"] + table["f_r[5]"][0]
    return given - (table["f_r[5]"] + table["f_w"] + table["f_w[8]"] + table["f_w[9]"] + table["f_w[10]"])


@pytest.mark.parametrize("implicit", ["no", "yes"])
@pytest.mark.parametrize("name", [pytest.param(name, marks=MOVING if name == "current" else ()) for name in BUDGETS])
def test_budget_of_a_bounce(lmp, name, implicit):
    """Work of buoyancy and drag = kinetic + elastic + what each viscous term has taken, to 1e-6 of what was there."""
    pair, dt = BUDGETS[name]
    t = bounce(lmp, pair, f"implicit {implicit}", steps=round(8e-3 / dt)).thermo[0]
    assert t["f_w[4]"].max() == 1
    assert np.abs(budget(t)).max() < 1e-6 * (t["f_r[5]"][0] + t["f_r[1]"][-1])
    assert min(t[f"f_w[{k}]"].min() for k in (8, 9, 10)) >= 0.0


def test_order_of_a_bounce(lmp):
    """Of second order where the force has no jump."""
    pair = "h0 1e-5 viscous none lubrication no tangential none"
    places = [last(bounce(lmp, pair, steps=steps, wall="tangential no"))[0] for steps in (400, 800, 1600, 12800)]
    errors = [np.linalg.norm(place - places[-1]) for place in places[:-1]]
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.25)
    assert errors[1] / errors[2] == pytest.approx(4.0, rel=0.2)


def test_convergence_with_films(lmp):
    """The film's friction begins with a jump, at a moment within a step: the first order at least."""
    for pair in "h0 1e-5 lubrication no", "":
        places = [last(bounce(lmp, pair, steps=steps))[0] for steps in (1000, 4000, 16000, 128000)]
        errors = [np.linalg.norm(place - places[-1]) for place in places[:-1]]
        assert errors[2] < errors[0] / 8    # of 16; where in a step it comes is a matter of chance


@pytest.mark.parametrize("ahead", [0.0, 0.1])
def test_elastic_bounce(lmp, ahead):
    """Without liquid, head-on: the path is that of the force alone, in all digits that the integrator has."""
    h0, gap = 1e-5, 0.2 * R6
    end, steps = 8e-3, 8000
    result = lmp(text(pair=f"viscous none lubrication no h0 {h0}", wall="plane 0 0 0 0 0 1 tangential no", rise=STILL,
                      dt=end / steps, every=steps, run=f"run {steps}"),
                 data([0, 0, R6 + gap], R6, [[ahead, 0, -0.13]]))
    z, u = exact(lambda z, u: elastic(max(R6 + h0 - z, 0.0), R6) / mass(R6), [R6 + gap, -0.13], end)
    x, v = last(result)
    assert x[0] == pytest.approx([ahead * end, 0, z], rel=1e-5, abs=1e-15)
    assert v[0] == pytest.approx([ahead, 0, u], rel=1e-5, abs=1e-15)
    assert u == pytest.approx(0.13, rel=1e-6)


# ---- two bubbles --------------------------------------------------------------------------------

PAIRS = {"equal": (R6, R6), "unequal": (R6, 0.2 * MM), "1:100": (R6, 0.006 * MM)}
MODELS = {"published": "", "derived": "viscous derived integral exact", "tangential": "tangential all",
          "current": "h0 current", "spring": "elastic spring", "all": "tangential all h0 current viscous derived"}


def oblique(Ri, Rj, speed=0.1):
    """Two bubbles that meet, not head-on: places and velocities, in a frame that moves."""
    n, along = np.array([2.0, -1.0, 2.0]) / 3.0, np.array([1.0, 2.0, 0.0]) / np.sqrt(5.0)
    reach = 2 * Ri * Rj / (Ri + Rj)
    x = np.array([-0.5 * n, 0.5 * n]) * (Ri + Rj + 0.06 * reach)
    v = np.array([n, -n]) * 0.5 * speed + np.array([along, -along]) * 0.15 * speed + [0.02, -0.01, 0.03]
    return x, v


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("sizes", PAIRS)
def test_momentum_of_a_pair(lmp, sizes, model):
    """Forces are opposite in all digits: what momentum loses are the roundings of the velocities."""
    R = np.array(PAIRS[sizes])
    x, v = oblique(*R)
    steps = 4000
    dt = 5e-3 * R.min() / R6 / steps
    result = lmp(text(pair=MODELS[model], rise=STILL, dt=dt, every=20, run=f"run {steps}"), data(x, R, v))
    assert result.thermo[0]["c_p[4]"].max() == 1
    m = mass(R)[:, None]
    frames = result.dump("dump")
    assert np.linalg.norm(frames[-1].array("vx", "vy", "vz") - v, axis=1).max() > 0.05    # they have met
    for frame in frames:
        f = frame.array("fx", "fy", "fz")
        assert np.array_equal(f[0], -f[1])
        # each step rounds each velocity once or twice: 2000 steps, at random
        assert np.abs((m * (frame.array("vx", "vy", "vz") - v)).sum(axis=0)).max() < 1e-13 * np.abs(m * v).sum()


@pytest.mark.parametrize("sizes, model", [("equal", "published"), ("equal", "spring"), ("unequal", "tangential"),
                                          ("unequal", "derived"), ("1:100", "published")])
def test_budget_of_a_pair(lmp, sizes, model):
    """Kinetic and elastic energy, and the work of each term by the trapezoidal rule, in the frame of rest. The
    step is longer than for one bounce at the wall, and that of the first order in the jump of derived is seen."""
    R = np.array(PAIRS[sizes])
    x, v = oblique(*R)
    v -= (mass(R)[:, None] * v).sum(axis=0) / mass(R).sum()
    steps, limit = (20000, 6e-5) if "derived" in MODELS[model] else (10000, 1e-5)
    dt = 5e-3 * R.min() / R6 / steps
    t = lmp(text(pair=MODELS[model], rise=STILL, dt=dt, run=f"run {steps}"), data(x, R, v)).thermo[0]
    assert t["c_p[4]"].max() == 1
    energy = t["f_r[5]"] + t["c_p"]
    for k in (1, 2, 3):
        power = t[f"c_p[{k}]"]
        assert power.max() <= 0.0
        energy[1:] -= np.cumsum(0.5 * (power[1:] + power[:-1])) * dt
    assert np.abs(energy / energy[0] - 1).max() < limit


def test_exchange(lmp):
    """Of the bubbles' numbers."""
    R = np.array([R6, 0.2 * MM])
    x, v = oblique(*R)
    ends = [last(lmp(text(pair="tangential all", rise=LIQUID, dt=1e-6, every=3000, run="run 3000"),
                     data(x[order], R[order], v[order]))) for order in (np.array([0, 1]), np.array([1, 0]))]
    assert ends[0][0] == pytest.approx(ends[1][0][::-1], rel=1e-13)
    assert ends[0][1] == pytest.approx(ends[1][1][::-1], rel=1e-12)


def test_rotation(lmp):
    """Of the whole scene: wall, gravity, two bubbles."""
    a, b, c = 0.4, -1.1, 2.0
    turn = (np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])
            @ np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])
            @ np.array([[1, 0, 0], [0, np.cos(c), -np.sin(c)], [0, np.sin(c), np.cos(c)]]))
    R = np.array([R6, 0.4 * MM])
    x, v = oblique(*R)
    normal, g = np.array([0.3, 0.2, -1.0]), np.array([0.0, 0.0, -G])
    ends = []
    for Q in np.eye(3), turn:
        def words(*vectors):
            return " ".join(f"{value:.17g}" for vector in vectors for value in Q @ vector)

        result = lmp(text(pair="tangential all", wall=f"plane {words(-1.5 * MM * normal, normal)}",
                          rise=f"{RHO} {MU} {words(g)}", dt=2e-6, every=10000, run="run 10000"),
                     data(x @ Q.T, R, v @ Q.T))
        assert result.thermo[0]["f_w[4]"][-1] >= 1
        ends.append(last(result))
    # roundings, of positions that are 1000 times larger than what a film lets pass
    assert ends[1][0] == pytest.approx(ends[0][0] @ turn.T, rel=1e-9, abs=1e-12)
    assert ends[1][1] == pytest.approx(ends[0][1] @ turn.T, rel=1e-6, abs=1e-9)


@pytest.mark.parametrize("film", ["no", "yes"])
def test_wall_is_a_mirror(lmp, film):
    """Two equal bubbles head-on: each moves as at a wall half-way, as far as the elastic force goes. A film counts once
    for both bubbles of a pair."""
    gap, h0 = 0.2 * R6, 20 * UM
    common = f"viscous none lubrication no film {film}"
    scene = dict(rise=STILL, dt=1e-6, every=500, run="run 8000")
    pair = lmp(text(pair=f"{common} h0 {h0}", **scene),
               data([[0, 0, R6 + gap], [0, 0, -R6 - gap]], R6, [[0, 0, -0.13], [0, 0, 0.13]])).dump("dump")
    wall = lmp(text(pair=f"{common} h0 {0.5 * h0 if film == 'yes' else h0}", wall="plane 0 0 0 0 0 1", **scene),
               data([0, 0, R6 + gap], R6, [[0, 0, -0.13]])).dump("dump")
    for one, two in zip(wall, pair):
        assert two["z"] == pytest.approx([one["z"][0], -one["z"][0]], rel=1e-9)
        assert two["vz"] == pytest.approx([one["vz"][0], -one["vz"][0]], rel=1e-7, abs=1e-12)


# ---- steps chosen by their error ----------------------------------------------------------------

def at(frames, times):
    """Places at these times: cubics through places and velocities."""
    t = np.array([frame.time for frame in frames])
    x = np.array([frame.array("x", "y", "z")[0] for frame in frames])
    v = np.array([frame.array("vx", "vy", "vz")[0] for frame in frames])
    return CubicHermiteSpline(t, x, v)(times)


@pytest.mark.parametrize("more", ["implicit no", "implicit yes"])
@pytest.mark.parametrize("pair", [pytest.param("", marks=JUMP), pytest.param("viscous derived", marks=JUMP),
                                  pytest.param("viscous none", marks=JUMP),
                                  "elastic spring viscous none lubrication no"])
def test_error_falls_with_tol(lmp, pair, more):
    """A step's error goes with its third power, a path's with the second: 10^(-2/3) for each decade of tol."""
    times = np.linspace(0, 7e-3, 50)
    reference = at(bounce(lmp, pair, more, steps=80000, records=8000).dump("dump"), times)
    errors = []
    for tol in 1e-3, 1e-5, 1e-7:
        plane, n = tilted(20, 1.6 * R6)
        lines = text(pair=pair, wall=plane, rise=f"{LIQUID} {more}", dt=1e-5,
                     step=f"fix s all bubble/nve tol {tol} dtmax 1e-3",
                     run="fix h all halt 1 v_now > 7.5e-3 error soft message no\nrun 100000",
                     before="variable now equal time")
        result = lmp(lines, data([0, 0, 0], R6, [[0, 0, 0.13]]))
        errors.append(np.abs(at(result.dump("dump"), times) - reference).max() / R6)
    assert errors[1] < errors[0] / 5 and errors[2] < errors[1] / 5 and errors[2] < 1e-4


@pytest.mark.parametrize("every", [1e-6, 3e-4])
def test_snapshots_by_time(lmp, every):
    """Each time has its snapshot, at the first step that has reached it, also where a step passes hundreds of them."""
    plane, n = tilted(20, 1.6 * R6)
    result = lmp(text(pair="elastic spring viscous none lubrication no", wall=plane, rise=LIQUID, dt=1e-5,
                      step="fix s all bubble/nve tol 1e-3 dtmax 1e-3", run="run 60",
                      before=f"dump t all custom 1 times id x\ndump_modify t every/time {every} time yes"),
                 data([0, 0, 0], R6, [[0, 0, 0.13]]))
    times = np.array([frame.time for frame in result.dump("dump")])
    assert len(times) == 61 and np.diff(times).max() > 100e-6
    due = [0.0, *times[1:][np.diff(np.floor(times / every + 1e-9)) > 0]]
    assert len(due) > 5
    assert [frame.time for frame in result.dump("times")] == pytest.approx(due, rel=1e-5)    # as printed


# ---- extremes -----------------------------------------------------------------------------------

def energy_of(t, wall):
    """Of a scene without gravity and drag: what moves and what is deformed."""
    return t["f_r[5]"] + t["c_p"] + (t["f_w"] if wall else 0.0)


@pytest.mark.parametrize("model", ["published", "derived"])
@pytest.mark.parametrize("R, scene", [
    (10 * UM, "wall"), (10 * UM, "pair"), (0.1 * MM, "wall"), (0.1 * MM, "pair"), (0.1 * MM, "1:100"), (3 * MM, "wall"),
    (3 * MM, "1:100"), pytest.param(3 * MM, "pair", marks=SOFT)])
def test_head_on(lmp, R, scene, model):
    """At 1 m/s: nobody passes, nobody comes out with more energy than was there. 1e-3: steps of tol 1e-5. At the wall,
    a centre may come through for a moment: eq. 9 is soft, and goes on behind it."""
    smallest = R / 100 if scene == "1:100" else R
    start, box = 0.5 * smallest, [(-60 * R, 60 * R)] * 3
    if scene == "wall":
        bubbles = data([0, 0, R + start], R, [[0, 0, -1.0]], box=box)
    else:
        bubbles = data([[0, 0, 0], [0, 0, R + smallest + start]], [R, smallest], [[0, 0, 0.5], [0, 0, -0.5]], box=box)
    film = f"hmin {min(10 * UM, 0.1 * smallest)}"    # a film that is thicker than the bubble is none
    lines = text(pair=f"{MODELS[model]} {film}", wall="plane 0 0 0 0 0 1" if scene == "wall" else "", rise=STILL,
                 skin=0.3 * R, dt=1e-3 * smallest, every=10, run="run 3000",
                 step=f"fix s all bubble/nve tol 1e-5 dtmax {5e-3 * smallest}")    # not round the box
    result = lmp(lines, bubbles)
    t, frames = result.thermo[0], result.dump("dump")
    energy = energy_of(t, scene == "wall")
    assert energy.max() <= (1 + 1e-3) * energy[0]
    assert energy[-1] < (1 - 1e-6) * energy[0]    # they have met
    if scene == "wall":
        assert frames[-1]["z"][0] > 0.5 * R
    else:
        assert all(frame["z"][1] > frame["z"][0] for frame in frames)


@pytest.mark.parametrize("R", [0.05 * MM, R6, 3 * MM])
def test_rests_under_a_lid(lmp, R):
    """It comes to rest where the force of eq. 9 is that of buoyancy, and stays. 1e-2: what tol lets pass, in R."""
    lines = text(pair="", wall=f"plane 0 0 {1.01 * R} 0 0 -1", rise=LIQUID, dt=1e-6, every=1000, skin=R,
                 step="fix s all bubble/nve tol 1e-4", run="run 50000")
    result = lmp(lines, data([0, 0, 0], R, box=[(-10 * R, 10 * R)] * 3))
    t = result.thermo[0]
    assert t["f_w[3]"][-5:] == pytest.approx(buoyancy(R), rel=1e-2)
    assert t["f_r[5]"][-1] < 1e-8 * buoyancy(R) * R
    z, h0 = result.dump("dump")[-1]["z"][0], term(result.dump("dump")[-1], "h0")[0]
    assert elastic(h0 - (1.01 * R - z - R), R) == pytest.approx(buoyancy(R), rel=1e-2)


@pytest.mark.parametrize("R, v, h0", [((2e-3, 2e-4), (1.0, 0.0), 1e-5), ((6e-5, 6e-5), (0.03, -0.03), 2e-5),
                                      ((1e-3, 2e-5), (1.0, 0.0), 1e-6)], ids=["unlike", "thick film", "1:50"])
def test_chosen_steps_see_films(lmp, R, v, h0):
    """No gap closes by more than a fifth in a step, so a film is first met at more than 0.8 h0, whatever the sizes."""
    distance = sum(R) + 3 * max(R)
    result = lmp(text(pair=f"lubrication no h0 {h0}", step="fix s all bubble/nve tol 1e-3", dt=1e-4, run="run 600"),
                 data([[0, 0, 0], [distance, 0, 0]], R, [[v[0], 0, 0], [v[1], 0, 0]]))
    gaps = [frame["x"][1] - frame["x"][0] - sum(R) for frame in result.dump("dump")]
    met = next(gap for gap in gaps if gap < h0)
    assert met > 0.8 * h0 * (1 - 1e-9)    # rounding: nothing has pushed before


def test_free_flight(lmp):
    """Nothing pushes: the error of a step is 0."""
    x, v = last(lmp(text(rise=STILL, step="fix s all bubble/nve tol 1e-5", every=100, run="run 500"),
                    data([0, 0, 0], R6, [[0.1, 0, 0]])))
    assert v[0] == pytest.approx([0.1, 0, 0])


def test_coincident_centres(lmp):
    """There is no direction to push: nothing is no number, and the others go on."""
    x = [[0, 0, 0], [0, 0, 0], [0, 0, 1.0 * MM]]
    result = lmp(text(rise=LIQUID, dt=1e-6, every=100, run="run 1000"), data(x, [R6, R6, R6]))
    frames = result.dump("dump")
    assert all(np.isfinite(frame.array("x", "y", "z", "fx", "fy", "fz")).all() for frame in frames)
    assert frames[0]["fz"][2] > buoyancy(R6)


@pytest.mark.parametrize("gap", [0.5, 0.0, -5.0, -30.0])
def test_starts_within_a_film(lmp, gap):
    """At rest with a gap below h0, in 10 micrometres: the energy of the film is all there is to come."""
    h0 = 10 * UM
    result = lmp(text(wall="plane 0 0 0 0 0 1", rise=STILL, dt=1e-6, every=10, run="run 5000"),
                 data([0, 0, R6 + gap * h0], R6))
    t = result.thermo[0]
    energy = t["f_r[5]"] + t["f_w"]
    assert energy[0] == pytest.approx(SIGMA * R6**2 * (18.5 / 3 * (h0 * (1 - gap) / R6)**3 + (h0 * (1 - gap) / R6)**2),
                                      rel=1e-9)
    assert np.all(np.diff(energy) <= 1e-6 * energy[0])
    assert t["f_w[4]"][0] == 1


@pytest.mark.parametrize("ranks", [1, 2])
def test_crowd_under_a_lid(lmp, ranks):
    """Overlapping at the start, 10 to 400 micrometres: none passes the lid, none gains energy without end."""
    rng = np.random.default_rng(3)
    x = rng.uniform(-1.5, 1.5, (100, 3)) * MM - [0, 0, 0.5 * MM]
    R = np.geomspace(0.01, 0.4, 100) * MM
    lines = text(wall=f"plane 0 0 {1.5 * MM} 0 0 -1", rise=LIQUID, dt=1e-7, every=100, run="run 5000",
                 step="fix s all bubble/nve tol 1e-4")
    result = lmp(lines, data(x, R, box=[(-2 * MM, 2 * MM)] * 3), ranks=ranks)
    for frame in result.dump("dump"):
        assert frame["z"].max() < 1.5 * MM
        assert np.abs(frame.array("vx", "vy", "vz")).max() < 10.0


# ---- one run, cut into two; some ranks ----------------------------------------------------------

CUTS = {
    "fixed": {},
    "implicit": dict(more="implicit yes"),
    "current": dict(pair="h0 current"),
    "tol": dict(step="tol 1e-4"),
    "exact": dict(step="tol 1e-4 dtmax 1e-4", more="implicit yes",
                  pair="viscous derived integral exact"),
}
# bubbles are sorted and lists made at this step, as at a start
REBUILD = "atom_modify sort 20 0.0\nrestart 100 state.*"
STATE = ("x", "y", "z", "vx", "vy", "vz", "fx", "fy", "fz", "c_c[23]", "c_c[22]")    # and energy, contacts


def crowd(number, seed=1, box=4 * MM):
    """Bubbles of 0.1 to 0.4 mm that rise under a lid, some of which overlap."""
    rng = np.random.default_rng(seed)
    x = rng.uniform(-0.45 * box, 0.45 * box, (number, 3))
    R = rng.uniform(0.1, 0.4, number) * MM
    return data(x, R, rng.uniform(-0.1, 0.1, (number, 3)), box=[(-0.5 * box, 0.5 * box)] * 3)


def crowded(run, pair="", more="", step="", **options):
    return text(pair=f"tangential all {pair}", wall=f"plane 0 0 {1.5 * MM} 0 0 -1", rise=f"{LIQUID} {more}", dt=2e-6,
                step=f"fix s all bubble/nve {step}", run=run, **options)


def rows(result):
    return {frame.step: frame for dump in result.directory.glob("dump*") for frame in result.dump(dump.name)}


def assert_same_sums(rest, whole, limit):
    for column in set(rest) - {"Time"}:
        first = column == "f_s[1]"    # no step yet
        ours = whole[column][100 + first:]
        assert np.abs(rest[column][first:] - ours).max() <= limit * np.abs(ours).max(), column


def assert_goes_on(whole, rest):
    """Bit by bit: bubbles, and the sums of one rank."""
    ours, theirs = rows(whole), rows(rest)
    assert max(theirs) == max(ours) and len(theirs) > 50
    for step, frame in theirs.items():
        assert frame.time == pytest.approx(ours[step].time, rel=1e-13)    # LAMMPS adds it up anew
        for column in STATE:
            assert np.array_equal(frame[column], ours[step][column]), (step, column)
    assert max(frame["c_c[22]"].max() for frame in theirs.values()) >= 1    # films in mid-contact


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("name", CUTS)
def test_restart(bitwise_lmp, name, ranks):
    whole = bitwise_lmp(crowded("run 200", after=REBUILD, **CUTS[name]), crowd(30), ranks=ranks)
    again = crowded("run 100", after=REBUILD, **CUTS[name]).replace(f"set          group all density {GAS}", "")
    again = bitwise_lmp(again.replace("read_data    data", f"read_restart {whole.directory}/state.100"), ranks=ranks)
    assert_goes_on(whole, again)
    assert_same_sums(again.thermo[0], whole.thermo[0], 1e-12 if ranks > 1 else 0)    # what all ranks have lost so far


@pytest.mark.parametrize("name", CUTS)
def test_two_runs(bitwise_lmp, name):
    whole = bitwise_lmp(crowded("run 200", after=REBUILD, **CUTS[name]), crowd(30))
    cut = bitwise_lmp(crowded("run 100\nrun 100", after=REBUILD, **CUTS[name]), crowd(30))
    assert_goes_on(whole, cut)
    assert_same_sums(cut.thermo[1], whole.thermo[0], 0)


@pytest.mark.parametrize("ranks, newton", [(1, "off"), (2, "on"), (4, "off")])
@pytest.mark.parametrize("name", ["fixed", "current", "exact"])
def test_ranks(lmp, name, ranks, newton):
    """The same as on one rank, but for roundings: of the forces' sums, through images of the box."""
    before = "" if lmp.kokkos else f"newton {newton}"
    one = lmp(crowded("run 100", **CUTS[name]), crowd(30)).dump("dump")[-1]
    result = lmp(crowded("run 100", before=before, **CUTS[name]), crowd(30), ranks=ranks)
    frame = result.dump("dump")[-1]
    assert frame.time == pytest.approx(one.time, rel=1e-9)
    for column in "x", "y", "z":
        assert frame[column] == pytest.approx(one[column], abs=1e-9 * MM)
    for column in "vx", "vy", "vz":
        assert frame[column] == pytest.approx(one[column], abs=1e-9)
