"""fix foam/flow: bubbles in a liquid that flows, in a region, with a box that is sheared, or as a field."""

import re

import numpy as np
import pytest

from foams import SHORT, assert_same_run, case, foam
from runner import HEAD, PRECISE, data_file

RATE = 0.1
DEFORM = """
variable      shift equal {rate}*f_step[7]*ly
variable      speed equal {rate}*ly
fix           deform all deform 1 xy variable v_shift v_speed remap none
"""
SHEAR = DEFORM.format(rate=RATE) + "fix flow all foam/flow shear\n"
STEPS = ["abm", "rkc"]


def run(lmp, x, R, flow, box=(10.0, 10.0), step="abm 1e-8 dtmax 0.1", pair="", what="run 100", every=20,
        tilted=False, thermo="step time pe c_p[*] f_step[*] f_flow[*]", **keywords):
    """2D: one state in each Frame of the first dump."""
    text = HEAD.format(dim=2) + f"""
read_data     data
{"change_box all triclinic" if tilted else ""}
neighbor      0.5 bin
pair_style    durian/foam 1.0 rin 1.0 {pair}
pair_coeff    * * 1.0
fix           step all foam/{step}
compute       p all pressure NULL virial
{flow}
thermo_style  custom {thermo}
{PRECISE}
thermo        {every}
dump          d all custom {every} dump id x y xu yu vx vy fx fy radius
dump_modify   d sort id format float %.17g time yes
{what}
"""
    return lmp(text, files={"data": data_file(box, x, R)}, **keywords)


# ---- region -------------------------------------------------------------------------------------

@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("touch", ["no", "yes"])
def test_region(lmp, step, touch):
    """Velocities are exact: that of the liquid for bubbles inside, and for those that touch, if wanted. One
    region ends where the box does: a bubble that has gone over the boundary is in it again."""
    x, R = np.array([[2.0, 5.0], [4.5, 8.0], [8.0, 2.0]]), np.ones(3)
    flow = f"region r block 0 4 0 10 -1 1\nfix flow all foam/flow region r velocity 0 0.7 0 touch {touch}"
    result = run(lmp, x, R, flow, step=f"{step} 1e-3 dtmax 0.1")
    moves = np.array([True, touch == "yes", False])
    for frame in result.dump("dump"):
        d = np.outer(moves, [0.0, 0.7 * frame.time])
        assert frame.array("xu", "yu") == pytest.approx(x + d, abs=1e-12)
        assert np.array_equal(frame["vy"], 0.7 * moves) and not frame["vx"].any()
    table = result.thermo[0]
    assert frame.time > 8.0    # over the boundary
    assert np.all(table["f_flow[4]"] == moves.sum()) and table["f_flow[2]"] == pytest.approx(0.7)
    assert np.all(table["f_flow[5]"] == 0.0)


def test_group(lmp):
    x, R = [[1.0, 5.0], [3.0, 8.0]], np.full(2, 0.5)
    result = run(lmp, x, R, """
group         one id 1
region        r block 0 4 0 10 -1 1
fix           flow one foam/flow region r velocity 0.0 0.7 0.0""")
    assert np.array_equal(result.dump("dump")[-1]["vy"], [0.7, 0.0])


def test_later_flows_replace(lmp):
    """Where two flows apply the later one does."""
    x, R = [[2.0, 5.0], [8.0, 5.0]], np.ones(2)
    result = run(lmp, x, R, """
region        r block 0 4 0 10 -1 1
region        all block INF INF INF INF INF INF
fix           first all foam/flow region all velocity 0.0 0.3 0.0
fix           flow all foam/flow region r velocity 0.0 0.7 0.0""")
    assert np.array_equal(result.dump("dump")[-1]["vy"], [0.7, 0.3])


@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("ranks", [1, 2])
def test_neighbor_drag_outside(lmp, step, ranks):
    """A bubble in the flow leads the two that touch it in a row outside, one that is alone rests. In the end the
    row moves with the flow at distances where no force acts."""
    x, R = np.array([[3.0, 5.0], [4.9, 5.0], [6.8, 5.0], [8.5, 1.0]]), np.array([1.0, 1.0, 1.0, 0.5])
    result = run(lmp, x, R, "region r block 0 4 0 10 -1 1\nfix flow all foam/flow region r velocity 0.0 0.05 0.0",
                 step=f"{step} 1e-6 dtmax 0.1", pair="drag neighbor", what="run 600", ranks=ranks, every=600)
    frame = result.dump("dump")[-1]
    assert frame["vy"][0] == pytest.approx(0.05, abs=1e-3)
    assert frame["vy"][1:3] == pytest.approx([0.05, 0.05], abs=0.01)
    assert frame["vy"][3] == 0.0


# ---- shear --------------------------------------------------------------------------------------

@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("ranks", [1, 2])
def test_alone_in_a_shear(lmp, step, ranks):
    """x = x0 + rate y t, to rounding, whatever the steps, through flips of the box."""
    x, R = np.array([[5.0, 9.5], [2.0, 2.0], [1.0, 5.0]]), np.full(3, 0.5)
    result = run(lmp, x, R, SHEAR, step=f"{step} 1e-6 dtmax 0.3", tilted=True, ranks=ranks,
                 what="run 60\nrun 60")
    for frame in result.dump("dump"):
        u = RATE * x[:, 1]
        assert frame["xu"] == pytest.approx(x[:, 0] + u * frame.time, abs=1e-11)
        assert np.array_equal(frame["yu"], x[:, 1])
        assert frame["vx"] == pytest.approx(u, abs=1e-13)
    assert frame.time > 30.0


@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("what", ["run 80", "run 2\n" * 40])
def test_over_the_moving_boundary(lmp, step, ranks, what):
    """A force drives bubbles over the boundary that moves, in a run or between two: y = y0 + t / 2 and
    x = x0 + rate (y0 t + t^2 / 4), which steps of order 2 have to rounding. A history with the velocity of another
    image would be an error of 1, and steps refused; only the first, which has none, has an error."""
    x, R = np.array([[5.0, 9.5], [2.0, 2.0], [1.0, 5.0]]), np.full(3, 0.5)
    h = "1e-3 dt0 0.2 dtmax 0.2" + (" spectral 1.0" if step == "rkc" else "")
    flow = SHEAR + "fix pull all addforce 0.0 0.5 0.0"
    result = run(lmp, x, R, flow, step=f"{step} {h}", tilted=True, ranks=ranks, what=what)
    for frame in result.dump("dump"):
        t = frame.time
        assert frame["yu"] == pytest.approx(x[:, 1] + 0.5 * t, abs=1e-11)
        assert frame["xu"] == pytest.approx(x[:, 0] + RATE * (x[:, 1] * t + 0.25 * t**2), abs=1e-10)
    assert t == pytest.approx(16.0) and result.thermo[-1]["f_step[4]"][-1] == 0


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("step", STEPS)
def test_squeezed_without_forces(lmp, dim, step):
    """A box that becomes shorter takes distant bubbles along: x - c shrinks as the side does. Order 2: the error
    of a step is some (rate h)^3 of the place."""
    x, R = np.full((2, dim), 2.0), np.full(2, 0.2)
    x[1] = 7.0
    text = case(dim, step="1e9 dt0 0.05 dtmax 0.05", integrator=step, gas="0 0", every=40, run="run 40", after="""
variable      less equal -0.5*f_step[7]
variable      speed equal -0.5
fix           deform all deform 1 x variable v_less v_speed remap none
fix           flow all foam/flow shear""")
    frame = lmp(text, files={"data": data_file([10] * dim, x, R)}).dump("dump")[-1]
    assert frame["x"] == pytest.approx(5 + (x[:, 0] - 5) * 0.9, abs=40 * 5 * (0.05 * 0.05)**3)
    assert frame["y"] == pytest.approx(x[:, 1], abs=0)


def pair_in_shear(lmp, at, step, what="run 60", every=20, ranks=1):
    """Distance of two bubbles in contact, frame by frame, the first of them at a place."""
    x = np.array([at, np.add(at, [-1.1, 1.5])])
    result = run(lmp, x, np.ones(2), SHEAR, step=step, tilted=True, what=what, every=every, ranks=ranks)
    frames = result.dump("dump")
    return [f.time for f in frames], np.array([np.diff(f.array("xu", "yu"), axis=0)[0] for f in frames])


@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("ranks", [1, 2])
def test_pair_across_the_boundary(lmp, step, ranks):
    """A pair that is cut by a boundary, also by the one that moves, goes as its copy in the middle: to rounding,
    since steps are the same."""
    step = f"{step} 1e9 dt0 0.05 dtmax 0.05" + (" spectral 1.0" if step == "rkc" else "")
    times, d = pair_in_shear(lmp, (5.0, 4.0), step)
    for at in (5.0, 9.2), (0.3, 9.4), (9.9, 3.0), (0.1, 8.9):
        times_too, d_too = pair_in_shear(lmp, at, step, ranks=ranks)
        assert times == times_too and d_too == pytest.approx(d, abs=1e-12)
    assert np.linalg.norm(d[-1]) < 2.0    # still in contact


@pytest.mark.parametrize("step", STEPS)
def test_order_of_a_pair(lmp, step):
    """Half the step, a quarter of the error, across the moving boundary, against Runge-Kutta steps of order 4."""
    def rate(d):
        r = np.linalg.norm(d)
        return 2 * max(1 - r / 2, 0.0) * d / r + np.array([RATE * d[1], 0.0])

    d, n = np.array([-1.1, 1.5]), 3000
    h = 3.0 / n
    for _ in range(n):
        a = rate(d)
        b = rate(d + h / 2 * a)
        c = rate(d + h / 2 * b)
        e = rate(d + h * c)
        d = d + h / 6 * (a + 2 * b + 2 * c + e)
    errors = []
    for n in 15, 30, 60:
        h = 3.0 / n
        keywords = f"{step} 1e9 dt0 {h} dtmax {h}" + (" spectral 1.0 stages 3" if step == "rkc" else "")
        times, found = pair_in_shear(lmp, (5.0, 9.2), keywords, f"run {n}", n)
        assert times[-1] == pytest.approx(3.0)
        errors.append(np.linalg.norm(found[-1] - d))
    ratios = np.divide(errors[:-1], errors[1:])
    assert np.all(ratios > 3.3) and np.all(ratios < 6.0), (errors, ratios)


def tilted(text):
    return text.replace("read_data     data\n", "read_data data\nchange_box all triclinic\n")


def sheared_foam(lmp, integrator, step, ranks=1, n=12, run="run 60", after="", **keywords):
    x, R, v, box = foam(2, n)
    return lmp(tilted(case(2, integrator=integrator, step=step, gas="0 0", run=run, neighbor="0.5 bin",
                           after=SHEAR + after, **keywords)),
               files={"data": data_file([box, box], x, R)}, ranks=ranks)


@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("ranks", [1, 2])
def test_foam_in_a_shear(lmp, step, ranks):
    """Springs sum to zero, and so does v - u; and what the fix says is that of the state."""
    result = sheared_foam(lmp, step, "1e-3", ranks,
                          after=f"thermo_style custom step time f_flow[*] f_step[7]\n{PRECISE}")
    frames, table = result.dump("dump"), result.thermo[0]
    for n, frame in enumerate(frames):
        u = RATE * frame["y"]
        slip = np.column_stack([frame["vx"] - u, frame["vy"]])
        assert np.abs(slip.sum(axis=0)).max() < 1e-11
        if n == 0:
            continue
        assert table["f_flow[1]"][n] == pytest.approx(u.mean(), rel=1e-11)
        assert table["f_flow[4]"][n] == len(frame)
        assert table["f_flow[5]"][n] == pytest.approx((slip**2).sum(), rel=1e-11)
    profile = np.polyfit(frame["y"], frame["vx"], 1)[0]
    assert profile == pytest.approx(RATE, rel=0.3)


@pytest.mark.parametrize("step", STEPS)
def test_order_of_a_foam(lmp, step):
    """The same of a packed foam, in which no contact has formed or opened at the end of the time."""
    x, R, v, box = foam(2, 6)
    found = []
    for n in 20, 40, 80, 640:
        h = 0.4 / n
        keywords = f"{step} 1e9 dt0 {h} dtmax {h}" + (" spectral 4.0 stages 3" if step == "rkc" else "")
        frames = run(lmp, x, R, SHEAR, box=(box, box), step=keywords, tilted=True,
                     what=f"run {n}", every=n).dump("dump")
        found.append(frames[-1].array("xu", "yu"))
    errors = [np.sqrt(((one - found[-1])**2).mean()) for one in found[:-1]]
    ratios = np.divide(errors[:-1], errors[1:])
    assert np.all(ratios > 3.0), (errors, ratios)    # 2 if the box stood still in a step


@pytest.mark.parametrize("pre", ["", "pre no"])
def test_shear_in_two_runs(lmp, pre):
    """History and rates go on from run to run: the same steps, to rounding."""
    more = f"run 30 post no\nrun 30 {pre}"
    if not pre:    # the tilt of a new run begins at what it is
        more = more.replace("post no\n", "\n")
    whole, parts = (sheared_foam(lmp, "abm", "1e-3", run=what) for what in ("run 60", more))
    a, b = (r.dump("dump")[-1] for r in (whole, parts))
    assert b["x"] == pytest.approx(a["x"], abs=1e-9)


def test_restart_of_a_shear(lmp):
    """The command is given again, and the run goes on."""
    whole = sheared_foam(lmp, "abm", "1e-3", run="restart 30 state\nrun 60", every=30)
    again = lmp(f"""
read_restart  state.30
neighbor      0.5 bin
fix           gas all foam/coarsen 0 0
fix           step all foam/abm 1e-3
{SHEAR}
thermo_style  custom step time pe f_step[*] f_flow[*]
{PRECISE}
run           30
""", directory=whole.directory)
    assert again.thermo[0]["PotEng"][-1] == pytest.approx(whole.thermo[0]["PotEng"][-1], rel=1e-9)
    assert again.thermo[0]["Time"][-1] == pytest.approx(whole.thermo[0]["Time"][-1], rel=1e-12)


# ---- field --------------------------------------------------------------------------------------

VORTEX = """
variable      ux atom -0.5*(y-5)
variable      uy atom 0.5*(x-5)
fix           flow all foam/flow field v_ux v_uy {}
"""


@pytest.mark.parametrize("word", ["0", "NULL"])
@pytest.mark.parametrize("step", STEPS)
def test_vortex(lmp, step, word):
    """A bubble goes round in a circle, with an error of order 2 in the step."""
    x, errors = np.array([[8.0, 5.0]]), []
    for n in 80, 160:
        h = 4 * np.pi / n
        keywords = f"{step} 1e9 dt0 {h:.17g} dtmax {h:.17g}" + (" spectral 1.0 stages 3" if step == "rkc" else "")
        frame = run(lmp, x, [0.5], VORTEX.format(word), step=keywords, what=f"run {n}", every=n).dump("dump")[-1]
        assert frame.time == pytest.approx(4 * np.pi)    # a whole turn
        errors.append(np.linalg.norm(frame.array("x", "y")[0] - x[0]))
    assert errors[0] < 3.0 * 2 * np.pi * 4 * (2 * np.pi / 80)**2 and 3.0 < errors[0] / errors[1] < 8.5, errors


def test_field_in_time(lmp):
    """Variables that depend on time see that of the evaluation: the integral of 2 t is t^2 for steps of order 2."""
    flow = "variable ux atom 2*time\nfix flow all foam/flow field v_ux 0 0"
    for frame in run(lmp, [[5.0, 5.0]], [0.5], flow, step="abm 1e9 dt0 0.02 dtmax 0.02").dump("dump"):
        assert frame["xu"][0] - 5.0 == pytest.approx(frame.time**2, abs=1e-12)


# ---- the same everywhere ------------------------------------------------------------------------

FLOWS = {
    "shear": SHEAR,
    "region": "region r block 0 8 3 12 INF INF\nfix flow all foam/flow region r velocity 0.1 0.2 0.0 touch yes",
    "field": "variable ux atom -0.05*(y-5)\nfix flow all foam/flow field v_ux 0 NULL",
}


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("flow", FLOWS)
@pytest.mark.parametrize("step", STEPS)
def test_back_ends(kk_lmp, backends, step, flow, dim):
    """Base and KOKKOS styles, one rank and two, with gas: the same foam."""
    x, R, v, box = foam(dim, 12 if dim == 2 else 5)

    def go(lmp, ranks):
        text = case(dim, integrator=step, gas="0.1 0.3 rmin 0.4", run="run 40" if step == "abm" else "run 12",
                    after=f"{FLOWS[flow]}\nthermo_style custom step atoms time pe f_gas[*] f_step[*] f_flow[*]\n"
                          f"{PRECISE}",
                    every=10)
        return lmp(tilted(text) if flow == "shear" else text, files={"data": data_file([box] * dim, x, R)},
                   ranks=ranks).thermo[0]

    plain, other = go(backends("wheel"), 1), go(kk_lmp, 2)
    assert_same_run(plain, other)
    for k in range(1, 6):
        a, b = plain[f"f_flow[{k}]"], other[f"f_flow[{k}]"]
        assert b == pytest.approx(a, rel=SHORT, abs=SHORT * max(1.0, np.abs(a).max()))
    assert plain["f_flow[4]"][-1] > 0


# ---- drift --------------------------------------------------------------------------------------

@pytest.mark.parametrize("step", STEPS)
def test_drift_is_relative_to_the_flow(lmp, step):
    """A uniform flow is none, and goes on; a force on all bubbles is, and is taken off."""
    x, R, v, box = foam(2, 6)
    flow = """
region        everywhere block INF INF INF INF INF INF
fix           flow all foam/flow region everywhere velocity 0.3 -0.2 0.0
fix           pull all addforce 0.5 0.0 0.0"""
    result = run(lmp, x, R, flow, box=(box, box), step=f"{step} 1e-3 drift remove")
    for frame in result.dump("dump")[1:]:
        assert frame["vx"].mean() == pytest.approx(0.3, abs=1e-12)
        assert frame["vy"].mean() == pytest.approx(-0.2, abs=1e-12)


# ---- errors -------------------------------------------------------------------------------------

REGION = "region r block 0 4 0 10 -1 1\n"
FLOW = "fix flow all foam/flow "


@pytest.mark.parametrize("flow, what", [
    (FLOW, "argument KIND is missing: region or shear or field"),
    (FLOW + "wind", "KIND must be region or shear or field, not wind"),
    (FLOW + "region", "argument REGION is missing: the ID of a region"),
    (FLOW + "region r speed 1 0 0", "velocity must be velocity, not speed"),
    (FLOW + "region r velocity 1 0", "argument VZ is missing: a number"),
    (FLOW + "region r velocity 1 x 0", "VY must be a number, not x"),
    (FLOW + "region r velocity 1 inf 0", "VY must be a number, not inf"),
    (FLOW + "region r velocity 1 0 0.1", "VZ must be 0 in 2D"),
    (FLOW + "region r velocity 1 0 0 touch", "keyword touch needs a value: no or yes"),
    (FLOW + "region r velocity 1 0 0 touch maybe", "touch must be no or yes, not maybe"),
    (FLOW + "region r velocity 1 0 0 reach 2", r"unknown keyword reach \(allowed are touch\)"),
    (FLOW + "region q velocity 1 0 0", "REGION must be the ID of a region, not q"),
    (FLOW + "shear", "shear follows the box of a fix deform, which has to stand before it"),
    (FLOW + "shear\n" + DEFORM.format(rate=1), "which has to stand before it"),
    (FLOW + "shear 1", "unknown keyword 1"),
    (DEFORM.format(rate=1).replace("remap none", "remap x") + FLOW + "shear", "must have remap none, not remap x"),
    (DEFORM.format(rate=1).replace("remap none", "remap v") + FLOW + "shear", "must have remap none, not remap v"),
    (DEFORM.format(rate=1) + "pair_style durian/foam 1.0 drag neighbor\npair_coeff * * 1\n" + FLOW + "shear",
     "shear cannot be used with drag neighbor"),
    (FLOW + "field 0 1 0", "UY must be v_NAME of an atom-style variable, 0 or NULL, not 1"),
    (FLOW + "field 0 0", "argument UZ is missing: v_NAME of an atom-style variable, 0 or NULL"),
    (FLOW + "field v_none 0 0", "v_none must be an atom-style variable: there is none of this name"),
    ("variable e equal 1\n" + FLOW + "field v_e 0 0",
     "v_e must be an atom-style variable: this is one of another style"),
    ("variable u atom 1/(x-x)\n" + FLOW + "field v_u 0 0", "v_u is no finite number|Divide by 0"),
    ("unfix step\nfix step all foam/rkc 1e-3 drift remove\npair_style durian/foam 1.0 drag neighbor\n"
     "pair_coeff * * 1\n" + FLOW + "region r velocity 1 0 0", "drift remove cannot be used with drag neighbor and"),
    ("unfix step\n" + FLOW + "region r velocity 1 0 0\nvariable x index 1", "needs a fix that integrates the foam"),
])
def test_bad_flows(lmp, flow, what):
    body = REGION + flow
    result = run(lmp, [[5.0, 5.0]], [1.0], body, tilted=True, check=False, thermo="step time", what="run 2")
    assert result.returncode and any(re.search(what, line) for line in result.errors), result.errors
