"""fix foam/rkc: the spectral radius that it estimates, the stages that it makes of it, what they cost."""

import re

import numpy as np
import pytest

from runner import HEAD, PRECISE, data_file
from foams import SAME, foam
from test_analytic import film_rate

MARGIN = 1.1    # of the estimate: see fix_foam_rkc.h


def stable(stages):
    """Longest step times spectral radius."""
    return 2 / 3 * (1 - 2 / 15) * (stages**2 - 1)    # epsilon 1


def run(lmp, dim, x, R, box, step, body="run 1", gas="", sigma0=1.0, pair="", every=1, ranks=1,
        before=""):
    """Tables of thermo output with the vector of the fix, and frames."""
    result = lmp(HEAD.format(dim=dim) + f"""
read_data     data
{before}
pair_style    durian/foam 1.0 {pair}
pair_coeff    * * {sigma0}
{f"fix gas all foam/coarsen {gas}" if gas else ""}
fix           step all foam/rkc {step}
thermo_style  custom step atoms time pe f_step[*] {"f_gas[*]" if gas else ""}
thermo        {every}
{PRECISE}
dump          d all custom {every} dump id xu yu zu radius vx vy vz
dump_modify   d sort id format float %.17g
{body}
""", files={"data": data_file(box, x, R)}, ranks=ranks)
    return result.thermo, result.dump("dump")


def pair_of(dim, r):
    x = np.full((2, dim), 5.0)
    x[1, 0] += r
    return x, np.array([1.2, 0.8]), [12.0] * dim


# ---- spectral radius ----------------------------------------------------------------------------

def hessian(x, R, box, stiffness):
    """Second derivatives of U = stiffness sum overlap^2 / (2 (R_i + R_j)) by the coordinates."""
    n, dim = x.shape
    H = np.zeros((n, dim, n, dim))
    for i in range(n):
        d = x[i] - x[:i]
        d -= box * np.round(d / box)
        r = np.linalg.norm(d, axis=1)
        for j in np.flatnonzero(r < R[i] + R[:i]):
            along = np.outer(d[j], d[j]) / r[j]**2
            S = R[i] + R[j]
            block = stiffness / S * (along - (S - r[j]) / r[j] * (np.eye(dim) - along))
            H[i, :, i] += block
            H[j, :, j] += block
            H[i, :, j] -= block
            H[j, :, i] -= block
    return H.reshape(n * dim, n * dim)


def rates_of(x, R, box):
    """Velocities by springs of stiffness 1."""
    d = x[:, None] - x
    d -= box * np.round(d / box)
    r = np.linalg.norm(d, axis=-1)
    np.fill_diagonal(r, np.inf)
    S = R[:, None] + R
    return np.sum((np.maximum(S - r, 0) / S / r)[..., None] * d, axis=1)


@pytest.mark.parametrize("dim", [2, 3])
def test_spectral_radius_is_the_largest_eigenvalue(lmp, dim):
    """Springs only: the Jacobian is - Hessian / mu0.  In a foam held by tiny steps each estimate goes on
    with the direction of the last one.  Each ends at a change of 2 %, which near eigenvalues make small:
    the first is 10 to 18 % too small (measured), the last, after 25, 4 to 5 %, which is less than the
    margin of the fix; none is too large.  They need not rise: of the ratio of sizes and that of the
    largest components the larger is taken, and only the former never falls."""
    x, R, _, box = foam(dim, 6 if dim == 2 else 4)
    for _ in range(200):    # near rest, where no mode grows
        x = (x + 0.2 * rates_of(x, R, box)) % box
    sigma0, rin = 2.0, 0.9
    exact = np.abs(np.linalg.eigvalsh(hessian(x, R, box, sigma0 * rin))).max()
    tables, _ = run(lmp, dim, x, R, [box] * dim, "1e-3 dtmax 1e-9", "run 500", sigma0=sigma0,
                    pair=f"rin {rin}")
    estimate = tables[0]["f_step[9]"][1:]
    # finite differences over 1e-6 of a radius, in which a contact may open or close
    assert np.max(estimate) < exact * (1 + 1e-4)
    assert estimate[0] > 0.8 * exact
    assert MARGIN * estimate[-1] > exact
    assert np.all(np.diff(estimate) > -0.02 * exact)    # 2 % is what an estimate may still change by
    assert np.all(tables[0]["f_step[8]"][1:] == 3)


@pytest.mark.parametrize("ranks", [1, 2])
def test_spectral_radius_of_two_bubbles(lmp, ranks):
    """The overlap decays at the rate 2 sigma0 <R_in> / (mu0 (R_i + R_j))."""
    x, R, box = pair_of(2, 1.9)
    tables, _ = run(lmp, 2, x, R, box, "1e-3 dt0 1e-3", sigma0=3.0, ranks=ranks)
    # of finite differences over 1e-6: second derivatives, and rounding
    assert tables[0]["f_step[9]"][-1] == pytest.approx(2 * 3.0 * R.mean() / R.sum(), rel=1e-5)


@pytest.mark.parametrize("dim", [2, 3])
def test_spectral_radius_of_gas_exchange(lmp, dim):
    """Without springs: d(q1') / dq1 - d(q1') / dq2, q2' = - q1'."""
    r, K = 1.7, 0.5
    x, R, box = pair_of(dim, r)
    q, e = R**dim, 1e-5

    def rate(shift):
        return film_rate(dim, q + shift, r, K)

    exact = abs(rate(np.array([e, -e])) - rate(np.array([-e, e]))) / (2 * e)
    tables, _ = run(lmp, dim, x, R, box, "1e-3 dt0 1e-4", gas=f"{K} 0 rmin 0", sigma0=0.0)
    assert tables[0]["f_step[9]"][-1] == pytest.approx(exact, rel=1e-4)


def test_spectral_radius_of_another_foam(lmp):
    """Springs ten times as stiff from one run to the next: known from the first step on."""
    x, R, _, box = foam(2, 6)
    tables, _ = run(lmp, 2, x, R, [box] * 2, "1e-3", "run 100\npair_coeff * * 10.0\nrun 1")
    before, after = tables[0]["f_step[9]"][-1], tables[1]["f_step[9]"][-1]
    # not to the last digit, since estimates end at a change of 2 %
    assert after == pytest.approx(10 * before, rel=0.2)


def test_estimate_falls_slowly(lmp):
    """An iteration that misses what the last one had found would make steps unstable: among 10^6 bubbles that
    cost 7 rejected steps and 20 short ones.  Without the limit it falls to 0.58 of the last one here."""
    x, R, _, box = foam(2, 16)
    tables, _ = run(lmp, 2, x, R, [box] * 2, "1e-4", "run 600", gas="1e-3 0.1")
    radius = tables[0]["f_step[9]"][42:]    # before, the foam counts as new
    ratio = radius[1:] / radius[:-1]
    assert np.all((ratio > 0.9 * (1 - SAME)) | (ratio < 0.5))
    assert ratio.min() < 1 < ratio.max()


def test_nothing_moves(lmp):
    """One bubble, and bubbles without contacts: radius 0, the fewest stages, the longest steps."""
    for x in ([[5.0, 5.0]], [[3.0, 5.0], [8.0, 5.0]]):
        for gas in ("", "0.1 0"):
            tables, frames = run(lmp, 2, np.array(x), np.ones(len(x)), [12.0] * 2,
                                 "1e-3 dt0 0.1 dtmax 5", "run 60", gas=gas, every=60)
            last = {name: column[-1] for name, column in tables[0].items()}
            assert last["f_step[9]"] == 0
            assert last["f_step[8]"] == 3
            assert last["f_step[2]"] == 5
            assert last["f_step[4]"] == 0
            assert np.array_equal(frames[-1].array("xu", "yu"), x)


# ---- stages -------------------------------------------------------------------------------------

def test_stages_are_the_fewest_that_are_stable(lmp):
    """Of each step that is accepted, by the spectral radius that the fix shows and its margin."""
    x, R, _, box = foam(2, 6)
    for step, margin in ("1e-3", MARGIN), ("1e-3 spectral 50", 1.0):
        tables, _ = run(lmp, 2, x, R, [box] * 2, step, "run 60")
        h, stages, radius = (tables[0][f"f_step[{k}]"][1:] for k in (2, 8, 9))
        assert np.all(radius == 50) or step == "1e-3"
        z = h * radius * margin
        assert np.all(z <= stable(stages) * (1 + SAME))
        more = stages > 3
        assert np.all(z[more] > stable(stages[more] - 1) * (1 - SAME))
    assert np.max(stages) > 5    # with the radius given, which is far too large


@pytest.mark.parametrize("safety, growth", [(0.9, 1.9), (0.5, 1.2), (0.99, 5.0)])
@pytest.mark.parametrize("norm", ["max", "rms"])
def test_step_control(lmp, safety, growth, norm):
    """The next step is that which the error of this one allows, as the manual says."""
    x, R, _, box = foam(2, 6)
    tables, _ = run(lmp, 2, x, R, [box] * 2,
                    f"1e-3 dt0 1e-4 norm {norm} safety {safety} growth {growth}", "run 60",
                    gas="1e-2 0.1")
    h, refused, error = (tables[0][f"f_step[{k}]"][1:] for k in (2, 4, 6))
    allowed = h[:-1] * np.clip(safety * np.cbrt(1e-3 / error[:-1]), 0.2, growth)
    at_once = refused[1:] == refused[:-1]    # after a rejection the step is another one
    at_once[1:] &= at_once[:-1].copy()       # and the next does not grow
    assert h[1:][at_once] == pytest.approx(allowed[at_once], rel=SAME)
    assert at_once.sum() > 20    # most of the others are refused steps
    assert np.any(allowed == h[:-1] * growth) and np.any(allowed < h[:-1] * growth)


def test_evaluations_are_the_stages(lmp):
    """A step costs as many evaluations as it has stages, with the radius given."""
    x, R, _, box = foam(2, 6)
    tables, _ = run(lmp, 2, x, R, [box] * 2, "1 spectral 20 dtmax 0.5 growth 1.9", "run 40", gas="1e-3 0.1")
    evaluations, refused, stages = (tables[0][f"f_step[{k}]"] for k in (5, 4, 8))
    assert refused[-1] == 0
    assert np.array_equal(evaluations[1:], 1 + np.cumsum(stages[1:]))    # one before the run


@pytest.mark.parametrize("number", [3, 7])
def test_given_stages_limit_the_step(lmp, number):
    """stages N: of two bubbles that come to rest, steps grow to the stability limit and no further."""
    x, R, box = pair_of(2, 1.7)
    rate = 2 * R.mean() / R.sum()
    tables, frames = run(lmp, 2, x, R, box, f"1e-3 dt0 1e-3 stages {number} spectral {rate:.17g}",
                         "run 120")
    h, stages = tables[0]["f_step[2]"][1:], tables[0]["f_step[8]"][1:]
    assert np.all(stages == number)
    assert h[-1] == pytest.approx(stable(number) / rate, rel=SAME)
    assert np.max(h) <= h[-1] * (1 + SAME)
    # |P| < 0.78 at that step: at rest by then
    assert np.ptp(frames[-1]["xu"]) == pytest.approx(R.sum(), abs=1e-6)


def test_long_steps_are_stable(lmp):
    """Steps of 1000 relaxation times in 80 stages: the foam rests, and stays at rest."""
    x, R, _, box = foam(2, 6)
    tables, frames = run(lmp, 2, x, R, [box] * 2, "1e-4", "run 400", every=20)
    h, stages, energy = (tables[0][name] for name in ("f_step[2]", "f_step[8]", "PotEng"))
    assert h[-1] == pytest.approx(1000.0)
    assert stages[-1] > 50
    assert np.abs(energy[-1] / energy[-2] - 1) < 1e-9
    v = frames[-1].array("vx", "vy")
    assert np.abs(v).max() < 1e-6


def test_bubbles_that_nearly_coincide(lmp):
    """Their distance r makes the spectral radius overlap / (2 R r) for an instant, with an eigenvalue
    that needs no stages.  It must not go on to cost any: 230 evaluations in 60 steps are measured, 90 of
    them by estimates and refused steps; 980 if the first estimate held for 25 steps."""
    x, R, _, box = foam(2, 8)
    x[1] = x[0] + [1e-3, 0]
    tables, _ = run(lmp, 2, x, R, [box] * 2, "1e-3", "run 60", gas="1e-2 0.1")
    assert tables[0]["f_step[9]"][1] > 500
    assert tables[0]["f_step[9]"][-1] < 10
    assert tables[0]["f_step[5]"][-1] < 400


OTHERS = ["viscous 0.1", "addforce v_step 0 0", "addforce v_time 0 0"]


def with_other(lmp, fix, body="run 60"):
    x, R, _, box = foam(2, 8)
    tables, _ = run(lmp, 2, x, R, [box] * 2, "1e-3",
                    "variable step equal 0.01*step\nvariable time equal 0.1*time\n"
                    + (f"fix other all {fix}\n" if fix else "") + body)
    return tables[0]


@pytest.mark.parametrize("fix", OTHERS)
def test_forces_that_are_not_of_places_alone(lmp, fix):
    """Velocities and steps go on between the rates at the start and those a step aside: their difference is
    no stiffness.  Springs alone have a radius of 2 to 4 here, the differences made it 10^4."""
    radius = with_other(lmp, fix)["f_step[9]"]
    assert np.all(radius[20:] < 5)
    assert radius[-1] > 1


@pytest.mark.parametrize("fix", OTHERS)
def test_what_forces_of_time_and_velocity_cost(lmp, fix):
    """Stages see the forces of their time, and where these change otherwise from step to step, with velocities
    and step numbers, those at the start of a step are evaluated anew: else the differences pass for errors
    and for stiffness, and until t = 10 the foam takes 10 to 45 times the 148 evaluations that it takes
    without other forces.  Now it is up to 1.6 times."""
    body = """variable over equal f_step[1]>=10
fix           halt all halt 1 v_over != 0 error continue message no
run           10000"""
    alone, both = with_other(lmp, "", body), with_other(lmp, fix, body)
    assert both["f_step[5]"][-1] <= 2 * alone["f_step[5]"][-1]


@pytest.mark.parametrize("ranks", [1, 2])
def test_steps_start_where_the_box_has_moved_to(lmp, ranks):
    """A sheared box takes the bubbles along between the steps; in a step it stands still, and the overlap o
    of two bubbles decays like exp(-h).  Rates from before the box moved would know nothing of what the move
    added to o: 0.01 too much of it in the end."""
    h, shear, steps = 0.1, 0.1, 40
    d = np.array([-1.1, 1.6])
    x, R, box = np.array([[6.6, 5.2], [6.6, 5.2] + d]), np.ones(2), [12.0, 12.0]
    tables, frames = run(lmp, 2, x, R, box, f"1e9 dt0 {h} dtmax {h} spectral 1.0", f"""
variable      shift equal {shear}*f_step[1]*ly
variable      rate equal {shear}*ly
fix           shear all deform 1 xy variable v_shift v_rate remap x
run           {steps}""", ranks=ranks, before="change_box all triclinic")
    for frame in frames[1:]:
        r = np.linalg.norm(d)
        d *= 1 + max(2 - r, 0) * (1 - np.exp(-h)) / r
        d[0] += shear * h * d[1]
        # order 2: each step misses up to o h^3 / 6, which decays at the rate 1 again; o < 0.1
        now = np.diff(frame.array("xu", "yu"), axis=0)[0]
        assert np.abs(now - d).max() < 0.1 * h**2 / 6
    assert 0.05 < 2 - np.linalg.norm(d) < 0.1    # still in contact


# ---- the first steps, the last of a bubble, the skin ------------------------------------------------

def test_first_steps_are_as_long_as_the_error_allows(lmp):
    """From dt0, which is a guess; with growth given, no step is longer than it says."""
    x, R, _, box = foam(2, 6)
    tables, _ = run(lmp, 2, x, R, [box] * 2, "1e-3 dt0 1e-4", "run 8", gas="1e-2 0.1")
    h, error = tables[0]["f_step[2]"][1:], tables[0]["f_step[6]"][1:]
    assert h[1] == pytest.approx(h[0] * min(0.9 * np.cbrt(1e-3 / error[0]), 1000), rel=SAME)
    assert h[1] > 20 * h[0]
    assert np.all(h[5:] <= 1.9 * h[4:-1] * (1 + SAME))
    tables, _ = run(lmp, 2, x, R, [box] * 2, "1e-3 dt0 1e-4 growth 1.9", "run 8", gas="1e-2 0.1")
    h = tables[0]["f_step[2]"][1:]
    assert np.all(h[1:] <= 1.9 * h[:-1] * (1 + SAME))


@pytest.mark.parametrize("part", np.arange(0.05, 1, 0.1))
def test_a_bubble_used_up_within_a_step_is_gone_at_its_end(lmp, part):
    """With rmin 0. A small bubble gives its gas to a large one through the liquid, q' = -2 kappa K (R / rho - 1) about
    -2 kappa K: it is used up after a `part` of the second step. Its rate is 0 from there on, so that its q at the end
    is of either sign; had that counted, it would have lasted for another step."""
    K, r, h = 1e-2, 0.3, 4.0
    R = (np.arange(1000) + 0.5) / 1000 * r
    large = np.sqrt(2.0**2 + r**2 - R**2)
    rho, change = (R + large) / 2, (r + 2.0) / (R + large)    # of <A>
    life = np.mean(R / (K * change * (1 - R / rho))) * r
    step = (life - part * h) / 40
    x, R, box = np.array([[5.0, 5.0], [10.0, 5.0]]), np.array([r, 2.0]), [15.0, 15.0]
    tables, _ = run(lmp, 2, x, R, box, f"1e9 dt0 {step} dtmax {step} spectral 1", f"""run 40
unfix step
fix step all foam/rkc 1e9 dt0 {h} dtmax {h} spectral 1
run 1""", gas=f"{K} 1.0 rmin 0", pair="rin 1.0")
    assert tables[0]["Atoms"][-1] == 2
    assert tables[1]["Atoms"][-1] == 1


FOLLOWS = "1.0 dt0 1.0 dtmax 2.0"


@pytest.mark.parametrize("ranks", [1, 2])
def test_skin_follows_the_steps(lmp, ranks):
    """Steps that go further than half the skin widen it, and hardly any is given up (one in which a
    bubble goes further than a mean radius); with a fixed skin many are. After the run LAMMPS has the skin of the
    neighbor command again, and the next run begins with the wide one."""
    x, R, _, box = foam(2, 10)
    refused, told = [], []
    for skin in "auto", "fixed":
        text = HEAD.format(dim=2) + f"""
read_data     data
neighbor      0.05 bin
pair_style    durian/foam 1.0
pair_coeff    * * 1.0
fix           gas all foam/coarsen 1e-2 0.1
fix           step all foam/rkc {FOLLOWS} skin {skin}
thermo_style  custom step f_step[4]
thermo        20
run           40
run           40
"""
        result = lmp(text, files={"data": data_file([box] * 2, x, R)}, ranks=ranks)
        refused.append([table["f_step[4]"][-1] for table in result.thermo])
        told.append(re.findall(r"widened the skin of neighbor lists from (\S+) to (\S+)", result.screen))
    assert refused[0][-1] <= 1 and refused[1][-1] > 20
    assert told[0][0][0] == "0.05"
    for (_, last), (first, _) in zip(told[0], told[0][1:]):
        assert first == last
    assert 0.05 < float(told[0][-1][1]) < 1.5    # up to a mean radius, which grows
    assert not told[1]


def test_skin_is_given_back(lmp):
    """To LAMMPS after a run and after commands that initialise without one, and to the next fix only if it asks."""
    x, R, _, box = foam(2, 10)
    result = lmp(HEAD.format(dim=2) + f"""
read_data     data
neighbor      0.05 bin
pair_style    durian/foam 1.0
pair_coeff    * * 1.0
fix           gas all foam/coarsen 1e-2 0.1
fix           step all foam/rkc {FOLLOWS}
thermo_style  custom step f_step[4]
run           40
run           10 pre no
write_data    wide.data
unfix         step
fix           step all foam/rkc {FOLLOWS} skin fixed
thermo_style  custom step f_step[4]
run           40
""", files={"data": data_file([box] * 2, x, R)})
    assert result.thermo[0]["f_step[4]"][-1] <= 1
    assert result.thermo[-1]["f_step[4]"][-1] > 10
    assert "half the skin of 0.05:" in result.screen


def test_skin_of_a_box_that_moves(lmp):
    """With fix foam/flow shear a list is good for less, the further the box has gone at the end of a step: a step that
    goes beyond a new list is tried with a wider skin or is shortened, but is not tried for ever."""
    x, R, _, box = foam(2, 8)
    result = lmp(HEAD.format(dim=2) + """
read_data     data
change_box    all triclinic
neighbor      0.5 bin
pair_style    durian/foam 1.0
pair_coeff    * * 1.0
timestep      0.01
fix           step all foam/rkc 1e-2 dtmax 1.0
variable      shift equal 0.1*f_step[7]*ly
variable      speed equal 0.1*ly
fix           shear all deform 1 xy variable v_shift v_speed remap none
fix           flow all foam/flow shear
thermo_style  custom step time f_step[2]
thermo        50
run           100
""", files={"data": data_file([box] * 2, x, R)})
    assert result.thermo[0]["Step"][-1] == 100
    assert result.thermo[0]["f_step[2]"][-1] > 0.1


@pytest.mark.parametrize("variable", ["volume", "radius"])
def test_gas_of_bubbles_used_up(lmp, variable):
    """With rmin 0 in long steps: the survivors take what is there, whatever the rates since a bubble was used up.
    radius conserves gas within the error of its steps only."""
    x, R, _, box = foam(2, 12)
    tables, _ = run(lmp, 2, x, R, [box] * 2, f"1e-2 variable {variable}", "run 200", gas="1e-2 0.1 rmin 0",
                    every=10)
    gas = tables[0]["f_gas[5]"]
    assert tables[0]["f_gas[2]"][-1] < len(R) / 2
    assert np.abs(gas / gas[0] - 1).max() < (1e-13 if variable == "volume" else 1e-2)


# ---- integrators in turn ------------------------------------------------------------------------

def test_integrators_in_turn(lmp):
    """abm, rkc, abm, each from where the last one ended: the overlap of two bubbles decays as it should."""
    x, R, box = pair_of(2, 1.3)
    body = "\n".join(f"unfix step\nfix step all foam/{style} 1e9 dt0 1e-3 dtmax 1e-3\nrun 500"
                     for style in ("abm", "rkc", "abm"))
    tables, frames = run(lmp, 2, x, R, box, "1e-3", body.replace("run 500", "run 500 post no"),
                         every=500)
    overlap = 0.7 * np.exp(-1.5)    # rate 1
    assert 2 - np.ptp(frames[-1]["xu"]) == pytest.approx(overlap, abs=1e-6)
