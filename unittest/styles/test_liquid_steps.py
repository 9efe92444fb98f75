"""Steps of a resolved liquid: how a run goes on from a restart file, what is done where the pressure is not found, and
how steps are chosen at the extremes."""

import re

import numpy as np
import pytest

from test_liquid import TANK, VORTEX
from test_liquid_bubbles import BREAKING, one, tank

# ---- restart ------------------------------------------------------------------------------------

MANY = "create_atoms 2 random 30 771 full overlap 0.02 maxtry 1000"
DRIFT = """displace_atoms all random 0.01 0.01 0.01 77 units box
variable ux atom 1+sin(7*z)
variable uy atom 0.2*cos(8*x)-0.5
variable uz atom 0.3*cos(8*y)
velocity water set v_ux v_uy v_uz"""    # through the sides of a periodic box
SCENES = {
    "liquid": dict(),
    "steps alike": dict(velocity="", dt=0.002),
    "bubbles": dict(create=MANY, gas="surface yes langevin 7"),
    "born": dict(create=MANY, gas="surface yes langevin 7",
                 more="fix s gas bubble/sparger 0.4 0.4 0.25 0.1 1e-3 normal 0.012 0.004 0.006 seed 3\n"),
    "broken": dict(create=MANY.replace(" 30 ", " 10 "), diameter=0.04, velocity=BREAKING, We=1e6, dt=0.002,
                   gas="surface no breakup 5"),
    "entrained": dict(velocity=BREAKING, dt=0.002, gas="surface yes entrain 9"),
}
COLUMNS = ("id", "type", "x", "y", "z", "vx", "vy", "vz", "radius", "c_c[1]", "c_c[2]", "c_c[3]", "c_c[4]")
LOOK = """
compute c all liquid/particle p k c surface
dump d all custom 1 dump.* id type x y z vx vy vz radius c_c[*]
dump_modify d sort id format float %.17g
thermo_style custom step time f_l[2] f_b[*]
thermo_modify norm no format float %.17g
thermo 1
"""


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("name", SCENES)
def test_restart(bitwise_lmp, name, ranks):
    """A restarted run goes on bit by bit: particles, bubbles, those that are born and break, and the steps. What is
    counted is a sum over ranks; time is added up anew."""
    n = 30 if name == "broken" else 10    # until then some have
    look = f"{LOOK}restart {n} state.*\nrun {{}}\n"
    text = tank(**{"velocity": DRIFT, **SCENES[name]})
    whole = bitwise_lmp(text + look.format(3 * n), ranks=ranks)
    head, tail = text[:text.index("lattice")], text[text.index("pair_style"):]
    again = bitwise_lmp(f"{head}read_restart {whole.directory}/state.{2 * n}\n{tail}{look.format(n)}", ranks=ranks)
    for step in range(2 * n + 1, 3 * n + 1):
        ours, theirs = (result.dump(f"dump.{step}")[0] for result in (whole, again))
        for column in COLUMNS:
            assert np.array_equal(ours[column], theirs[column]), (step, column)
    for column, theirs in again.thermo[0].items():
        ours, theirs = whole.thermo[0][column][2 * n + 1:], theirs[1:]
        assert theirs == pytest.approx(ours, rel=1e-13, abs=1e-300), column
    last = {key: value[-1] for key, value in again.thermo[0].items()}
    if name == "broken":
        assert last["f_b[4]"] > 0
    if name in ("born", "entrained"):
        assert last["f_b[1]"] > 35


# ---- what is done again -------------------------------------------------------------------------

COUNT = """
thermo_style custom step time f_l[2] f_l[3] f_l[9]
thermo_modify norm no format float %.17g
thermo 1
"""


SLIDING = """
units         lj
atom_style    sphere 1
boundary      p p p
comm_modify   vel yes
lattice       sc 1000 origin 0.5 0.5 0.5
region        box block 0 1 0 1 0 1 units box
create_box    1 box
create_atoms  1 box
set           group all diameter 0.1 density $(6/PI)
displace_atoms all random 0.02 0.02 0.02 77 units box
variable      ux atom 8*(z>0.5)-4
velocity      all set v_ux 0.0 0.0
pair_style    liquid/sph 0.1
pair_coeff    * *
neighbor      $({skin}*0.1) bin
fix           l all liquid/flow 1e6 none les none solver 1.0e-10 {most} courant 0.9
""" + COUNT


def calm(dt=1.0, most=1000):
    """A scene that is pushed the harder the longer, so that the solver has more to do in a later step than before."""
    text = tank(create=MANY, gas="surface yes langevin 7 breakup 5", dt=dt,
                velocity="variable ux atom 0.05*sin(7*z)\nvelocity water set v_ux 0 0")
    text = text.replace("dtmax", f"pressure v_p solver 1.0e-6 {most} dtmax")
    return text.replace("pair_style", "variable p atom 0.95-z\npair_style", 1) + """
variable fx atom 0.01*v_dr^3*step^2*sin(0.1*id)
fix push water addforce v_fx 0 0
"""


def test_a_repeated_step_is_a_shorter_one(bitwise_lmp):
    """Where the pressure is not found a step is done again with half of its length, from where it began: places,
    velocities, and what bubbles keep. Another run that takes this length at once, from a restart file, agrees, up to
    where the solver ends: 1e-6 of the pressure. Later steps are 1.2 times the one before, until one is as long as
    the flow allows."""
    look = """
dump d all custom 1 dump.* id x y z vx vy vz
dump_modify d sort id format float %.17g
""" + COUNT
    free = bitwise_lmp(calm() + look + "run 14\n").thermo[0]
    needed = free["f_l[3]"]
    n = next(n for n in range(2, 15) if needed[n] > needed[:n].max())
    cut = bitwise_lmp(calm(most=int(needed[n]) - 1) + look + f"restart {n - 1} state.*\nrun {n}\n")
    table = cut.thermo[0]
    repeated, taken = table["f_l[9]"][n], table["Time"][n] - table["Time"][n - 1]
    assert repeated > 0 and table["f_l[9]"][n - 1] == 0
    assert taken == pytest.approx(table["f_l[2]"][n - 1] / 2**repeated, rel=1e-12)
    assert table["f_l[2]"][n] == pytest.approx(1.2 * taken, rel=1e-12)

    text = calm(dt=taken)
    head, tail = text[:text.index("lattice")], text[text.index("variable p atom"):]
    tail = tail.replace("pressure v_p", "")
    short = bitwise_lmp(f"{head}read_restart {cut.directory}/state.{n - 1}\n{tail}{look}run 1\n")
    assert short.thermo[0]["f_l[9]"][1] == 0
    for column in ("x", "y", "z", "vx", "vy", "vz"):
        ours, theirs = (result.dump(f"dump.{n}")[0][column] for result in (cut, short))
        assert ours == pytest.approx(theirs, rel=0, abs=1e-9), column


@pytest.mark.parametrize("skin, warnings", [(0.6, 1), (2.4, 0)])
def test_way_back_of_a_repeated_step(lmp, skin, warnings):
    """Lists are those of where the longer step would have led. Halves of the cube that pass each other go there by
    0.9 h each; half of it they come back, 1.2 spacings for a pair."""
    needed = lmp(SLIDING.format(skin=skin, most=1000) + "run 2\n").thermo[0]["f_l[3]"]
    assert needed[2] > needed[:2].max()
    result = lmp(SLIDING.format(skin=skin, most=int(needed[2]) - 1) + "run 2\n")
    assert result.thermo[0]["f_l[9]"][-1] > 0
    assert len(re.findall("may miss each other, the skin is", result.screen)) == warnings


def test_a_pressure_that_is_never_found(lmp):
    result = lmp(tank(velocity=DRIFT).replace("dtmax", "solver 1.0e-14 1 dtmax") + "run 2\n", check=False)
    assert any(re.search("pressure was not found at step 0 with a timestep of .*: residual .* after 1 iterations, "
                         "wanted 1e-14 in at most 1", line) for line in result.errors), result.errors


# ---- steps at the extremes ----------------------------------------------------------------------

def test_incompressible_without_a_surface(lmp):
    """The pressure has no level then; velocities are those of a liquid that is nearly so."""
    speeds = []
    for Ma in "0.0", "0.01":
        frame = lmp(VORTEX.format(n=8, Re=100, more=f"ma {Ma} dtmax 1e-2") + """
dump d all custom 20 dump id vx vy vz
dump_modify d sort id format float %.17g
run 20
""").dump("dump")[-1]
        speeds.append(frame.array("vx", "vy", "vz"))
    assert speeds[0] == pytest.approx(speeds[1], rel=0, abs=1e-4 * np.abs(speeds[1]).max())


LIMITS = """
compute fast water reduce maxabs vx vy vz
thermo_style custom step dt time f_l[2] c_fast[*] atoms
thermo_modify norm no format float %.17g
thermo 1
"""
H = 1.3 / 10    # of tank()


def test_another_run_may_need_shorter_steps(lmp):
    """What a run has left is not the step of the next one, if velocities have been set in between."""
    result = lmp(tank(dt=1.0, more=LIMITS + "run 2\nvelocity water set 3 0 0 units box\nrun 2\n"))
    first, second = result.thermo
    assert first["f_l[2]"][-1] > 0.05
    assert second["f_l[2]"][0] == pytest.approx(0.2 * H / 3, rel=1e-12)


@pytest.mark.parametrize("what", ["x", "c_p"])
@pytest.mark.parametrize("every", [0.002, 0.02, 0.1])
def test_snapshots_by_time(lmp, every, what):
    """Each time has its snapshot, at the first step that has reached it, also where steps pass several of them: the
    first are ten times as long as the shortest of these times."""
    result = lmp(tank(dt=1.0, velocity=DRIFT, more=f"""{LIMITS}
compute p all liquid/particle p
fix push water addforce 0 0 -0.05
dump d all custom 1 dump id {what}
dump_modify d every/time {every} time yes
run 30
"""))
    times = result.thermo[0]["Time"]
    assert np.diff(times).max() > 1.5 * np.diff(times).min()
    passed = np.floor(times / every + 1e-9)
    due = [0.0, *times[1:][np.diff(passed) > 0]]
    assert len(due) > 2
    assert [frame.time for frame in result.dump("dump")] == pytest.approx(due, rel=1e-5)    # as printed


def test_a_run_without_set_up_has_the_step_that_is_due(lmp):
    """run N pre no begins with the timestep of the user, who may not think of it."""
    result = lmp(tank(velocity=DRIFT, dt=1.0, more=LIMITS + "timestep 5.0\nrun 3\nrun 3 pre no\n"))
    first, second = result.thermo
    due = first["f_l[2]"][-1]
    assert second["Time"][1] - second["Time"][0] == pytest.approx(due, rel=1e-12)


@pytest.mark.parametrize("courant", [None, 0.5])
def test_forces_shorten_steps(lmp, courant):
    """As gravity does: nothing goes further than 0.2 h from rest, or than it may by *courant*."""
    text = tank(dt=100.0, more=LIMITS + f"fix push water addforce {40 * 0.1**3} 0 0\nrun 3\n")
    keyword = f" courant {courant}" if courant else ""
    table = lmp(text.replace("liquid/flow 1000 1.0", f"liquid/flow 1000 none{keyword}")).thermo[0]
    assert table["Time"][1] == pytest.approx((courant or 0.2) * np.sqrt(H / 40), rel=1e-12)


def test_courant_leaves_the_limit_of_viscosity(lmp):
    """At 0.4 in the place of 0.2 there a flow at Re = 1 grows without end."""
    table = lmp(VORTEX.format(n=8, Re=1, more="courant 0.9") + "run 40\n").thermo[0]
    assert table["f_l[2]"] == pytest.approx(np.full(41, 0.2 * (1.3 / 8)**2), rel=1e-12)


def test_fast_bubbles_shorten_steps(lmp):
    """None goes further than h/2 in a step, the first included."""
    h = 1.3 / 10
    table = lmp(tank(create=one(0.41, 0.37, 0.5), velocity="velocity gas set 0 0 2 units box", dt=1.0,
                     gas="surface no drag no", more="""
compute speed gas reduce max vz
thermo_style custom step f_l[2] c_speed
thermo_modify norm no format float %.17g
thermo 1
run 3
""")).thermo[0]
    assert (table["f_l[2]"] <= 0.5 * h / table["c_speed"] * (1 + 1e-12)).all()


def test_forces_on_bubbles(lmp):
    """Those of other fixes and pair styles act on bubbles: twice the buoyancy is another terminal velocity. In the
    units of the liquid buoyancy is V (1 - 1/beta)."""
    a, Re, beta = 0.01, 1000, 800.0
    volume = 4 / 3 * np.pi * a**3
    frame = lmp(tank(create=one(0.41, 0.37, 0.3), gas="surface no lift no", more=f"""
fix push gas addforce 0 0 {volume * (1 - 1 / beta)}
compute d gas bubble/flow ulx uly ulz
dump d gas custom 30 dump id vx vy vz c_d[*]
dump_modify d format float %.17g
run 30
""")).dump("dump")[-1]
    relative = frame["vz"][0] - frame["c_d[3]"][0]
    Re_b = 2 * a * relative * Re
    drag = 0.5 * 24 / Re_b * (1 + 0.15 * Re_b**0.687) * np.pi * a**2 * relative**2
    assert drag == pytest.approx(2 * volume * (1 - 1 / beta), rel=0.01)


@pytest.mark.parametrize("viscosity, factor", [("none", 0.0), ("published", 1.0), ("sato", None)])
def test_viscosity_by_bubbles(lmp, viscosity, factor):
    """What a bubble adds to the viscosity of the liquid, and that the sum over particles gives it back: that of Sato
    has the volume of the bubble, and Re."""
    a, Re, speed = 0.01, 1000, 0.3
    frame = lmp(tank(create=one(0.41, 0.37, 0.3), velocity=f"velocity gas set 0 0 {speed} units box",
                     gas=f"surface no viscosity {viscosity}", more="""
compute c water liquid/particle alpha nub
compute d gas bubble/flow nub
dump d all custom 1 dump id type c_c[*] c_d
dump_modify d sort id format float %.17g
run 0
""")).dump("dump")[0]
    expected = 0.6 * 2 * a * speed * (Re * 4 / 3 * np.pi * a**3 if factor is None else factor)
    assert frame["c_d"][frame["type"] == 2] == pytest.approx(expected, rel=1e-14)
    wet = frame["type"] == 1
    spread = 0.1**3 / frame["c_c[1]"][wet] * frame["c_c[2]"][wet]
    assert spread.sum() == pytest.approx(expected, rel=1e-13)


def test_bubbles_last_as_given(lmp):
    """At the surface, where all else is the same: longer by the difference."""
    ends = []
    for T in 0.1, 0.6:
        table = lmp(tank(create=one(0.41, 0.37, 0.85), gas=f"surface yes persist {T}",
                         more="thermo_style custom step time f_b[1]\nthermo 1\nrun 700\n")).thermo[0]
        ends.append(table["Time"][table["f_b[1]"] == 0][0])
    assert ends[1] - ends[0] == pytest.approx(0.5, abs=0.021)    # a step


def test_bubbles_of_a_sparger_collide(lmp):
    """A pair style between bubbles acts on those that are born, if its cutoffs know how large they may be: two come no
    closer than they do elsewhere."""
    text = tank(gas="surface no", dt=1e-4, more="""
fix s gas bubble/sparger 0.4 0.4 0.3 0.0 1e-2 radius 0.01 seed 3
compute e gas pair bubble/collision epair
thermo_style custom step f_b[1] c_e
thermo_modify norm no
thermo 20
run 40
""")
    old = "pair_style    liquid/sph ${dr}\npair_coeff    * *"
    for rmax, works in ("", False), ("rmax 0.01", True):
        both = ("pair_style hybrid/overlay liquid/sph ${dr} bubble/collision 1e-4 1e-3 h0 1e-4 hmin 1e-4 " + rmax +
                "\npair_coeff * * liquid/sph\npair_coeff 2 2 bubble/collision")
        assert old in text
        result = lmp(text.replace(old, both), check=works)
        if works:
            assert result.thermo[0]["f_b[1]"][-1] >= 9 and result.thermo[0]["c_e"][-1] > 0
        else:
            assert any(re.search("bubble .* has radius 0.01: .* or rmax: 0", line) for line in result.errors)


@pytest.mark.parametrize("change, error", [
    ("set group water density 1.0", "particle 1 has mass .* it must be that of the spacing, DR.3 = 0.001"),
    ("group gas type 1", "particle 1 is in the group of fix bubble/flow, too"),
])
def test_particles_that_are_none(lmp, change, error):
    result = lmp(tank() + f"{change}\nrun 1\n", check=False)
    assert any(re.search(error, line) for line in result.errors), result.errors


def test_time_that_stands_still(lmp):
    text = TANK.format(wall="slip", more="dtmax 1e-18") + "timestep 1.0\nvelocity all set 0 0 0\n"
    result = lmp(text + "run 1\nundump d\nreset_timestep 0 time 1000\nrun 3\n", check=False)
    assert any(re.search("Fix liquid/flow: the timestep at step .* is 1e-18: time 1000 does not go on", line)
               for line in result.errors), result.errors
