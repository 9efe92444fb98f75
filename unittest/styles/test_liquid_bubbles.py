"""Bubbles in a resolved liquid: how they rise, are born, break, and burst at the surface; on any number of ranks."""

import re

import numpy as np
import pytest

BETA = 800.0

TANK = """
units         lj
atom_style    sphere 1
boundary      p p f
comm_modify   vel yes
variable      dr equal 1.0/{n}
lattice       sc $(1/v_dr^3) origin 0.5 0.5 0.5
region        box block 0 {width} 0 {width} 0 1.4 units box
region        full block 0 {width} 0 {width} 0 1 units box
create_box    2 box
create_atoms  1 region full
{create}
group         water type 1
group         gas type 2
set           group water diameter ${{dr}} density $(6/PI)
set           group gas diameter {diameter} density $(1/{BETA})
{velocity}
pair_style    liquid/sph ${{dr}}
pair_coeff    * *
neighbor      $(0.6*v_dr) bin
neigh_modify  one 10000 page 200000
fix           l water liquid/flow {Re} 1.0 les none wall zlo slip dtmax {dt}
fix           b gas bubble/flow {We} {BETA} {gas}
"""


def tank(n=10, width=0.8, create="", diameter=0.02, velocity="", Re=1000, dt=0.02, We=1e4, gas="surface no", more=""):
    return TANK.format(n=n, width=width, create=create, diameter=diameter, velocity=velocity, Re=Re, dt=dt, We=We,
                       gas=gas, BETA=BETA) + more


def one(x, y, z):
    return f"create_atoms 2 single {x} {y} {z} units box"


PRECISE = "thermo_modify norm no format float %.17g\n"


@pytest.mark.parametrize("substep", ["yes", "no"])
def test_terminal_velocity(base_lmp, substep):
    """Drag balances buoyancy at the speed that the law says, relative to the liquid where the bubble is. It gets
    there at the rate of the drag, so after 40 of these times to e^-40; what is left is how the flow that it leads along
    changes in a step."""
    a, Re = 0.01, 1000
    frame = base_lmp(tank(create=one(0.41, 0.37, 0.3), gas=f"surface no lift no substep {substep}", more="""
compute d gas bubble/flow ulx uly ulz fdz fgz
dump d gas custom 30 dump id vx vy vz c_d[*]
dump_modify d format float %.17g
run 30
"""), files={}).dump("dump")[-1]
    relative = frame["vz"][0] - frame["c_d[3]"][0]
    Re_b = 2 * a * relative * Re
    coefficient = 24 / Re_b * (1 + 0.15 * Re_b**0.687)
    drag = 0.5 * coefficient * BETA * np.pi * a**2 * relative**2
    buoyancy = (BETA - 1) * 4 / 3 * np.pi * a**3
    assert drag == pytest.approx(buoyancy, rel=0.01)
    assert frame["c_d[5]"][0] == pytest.approx(buoyancy, rel=1e-12)


SPARGER = "fix s gas bubble/sparger 0.4 0.4 0.25 0.1 1e-3 normal 0.012 0.004 0.006 seed 3\n"


@pytest.mark.parametrize("gas", ["surface no", "surface yes langevin 7"])
def test_births_do_not_depend_on_ranks(base_lmp, gas):
    """IDs, sizes and places of all bubbles. Sums over neighbors come in another order: rounding, which grows in ten
    steps by less than 10^3."""
    frames = {}
    for ranks in 1, 2, 4:
        result = base_lmp(tank(gas=gas, more=SPARGER + """
dump d gas custom 10 dump id x y z vx vy vz radius
dump_modify d sort id format float %.17g
thermo_style custom step f_b[1] f_b[2] f_s[1] f_s[2]
run 10
"""), ranks=ranks)
        frames[ranks] = result.dump("dump")[-1]
        table = result.thermo[0]
    assert len(frames[1]) > 10
    assert table["f_s[1]"][-1] == len(frames[1]) == table["f_b[1]"][-1]
    volume = np.sum(4 / 3 * np.pi * frames[1]["radius"]**3)
    assert table["f_s[2]"][-1] == pytest.approx(volume, rel=1e-5)    # as printed
    for ranks in 2, 4:
        assert (frames[ranks]["id"] == frames[1]["id"]).all()
        assert frames[ranks]["radius"] == pytest.approx(frames[1]["radius"], rel=1e-15)
        for name in ("x", "y", "z", "vx", "vy", "vz"):
            assert frames[ranks][name] == pytest.approx(frames[1][name], rel=0, abs=1e-11), name


def test_gas_of_a_sparger(base_lmp):
    """All gas that has flowed in by the last birth is in bubbles: what is owed is less than one of them."""
    result = base_lmp(tank(more="fix s gas bubble/sparger 0.4 0.4 0.25 0.1 1e-4 radius 0.01\n"
                           "thermo_style custom step time f_s[1] f_s[2]\n" + PRECISE + "thermo 1\nrun 8\n"))
    table, V = result.thermo[0], 4 / 3 * np.pi * 0.01**3
    # bubbles of the last step are born in the next
    assert table["f_s[2]"][1:] == pytest.approx(V * np.floor(1e-4 * table["Time"][:-1] / V + 1e-9), rel=1e-12)


BREAKING = "variable ux atom 20*z\nvelocity water set v_ux 0 0"


@pytest.mark.parametrize("ranks", [1, 2, 4])
def test_breaking_keeps_gas(base_lmp, ranks):
    """In a strong shear bubbles break, again and again; the gas stays, and so does their mass."""
    create = "create_atoms 2 random 20 771 full overlap 0.02 maxtry 1000"
    result = base_lmp(tank(create=create, diameter=0.04, velocity=BREAKING, We=1e6, dt=0.002,
                           gas="surface no breakup 5", more="""
variable m atom mass
compute m gas reduce sum v_m
thermo_style custom step f_b[1] f_b[2] f_b[4] c_m
""" + PRECISE + """thermo 80
run 80
dump d gas custom 1 dump id radius
dump_modify d sort id format float %.17g
run 0
"""), ranks=ranks)
    table = result.thermo[0]
    assert table["f_b[1]"][0] == 20 and table["f_b[4]"][-1] > 5
    assert table["f_b[1]"][-1] == 20 + table["f_b[4]"][-1]
    assert table["f_b[2]"][-1] == pytest.approx(20 * 4 / 3 * np.pi * 0.02**3, rel=1e-13)
    assert table["c_m"][-1] == pytest.approx(table["c_m"][0], rel=1e-13)
    assert len(np.unique(result.dump("dump")[0]["id"])) == table["f_b[1]"][-1]


def test_bursting_at_the_surface(base_lmp):
    """A bubble comes to the surface, is slowed down, and bursts there: its gas is gone, and counted. Without the
    rules of the surface it flies away."""
    result = base_lmp(tank(create=one(0.41, 0.37, 0.85), gas="surface yes", more="""
compute top gas reduce max z
thermo_style custom step time f_b[1] f_b[5] f_b[6] c_top
thermo 1
run 700
"""))
    table = result.thermo[0]
    assert table["f_b[1]"][0] == 1 and table["f_b[1]"][-1] == 0 and table["f_b[5]"][-1] == 1
    assert table["f_b[6]"][-1] == pytest.approx(4 / 3 * np.pi * 0.01**3, rel=1e-5)    # as printed
    assert 0.85 < table["c_top"][table["f_b[1]"] == 1].max() < 1.1


COLUMN = """
units         lj
atom_style    sphere 1
boundary      p p f
comm_modify   vel yes
variable      dr equal 1.0/12
lattice       sc $(1/v_dr^3) origin 0.5 0.5 0.5
region        box block 0 1 0 $(6*v_dr) 0 4.2 units box
region        full block 0 1 0 $(6*v_dr) 0 4 units box
create_box    2 box
create_atoms  1 region full
lattice       sc $(8/v_dr^3) origin 0.5 0.5 0.5
region        half block 0 0.5 0 $(6*v_dr) 0 4 units box
create_atoms  2 region half
group         water type 1
group         gas type 2
variable      a equal (0.05*v_dr^3/8*3/4/PI)^(1/3)
set           group water diameter ${{dr}} density $(6/PI)
set           group gas diameter $(2*v_a) density $(1/{BETA})
variable      ut equal sqrt(8/3*v_a/0.44*(1-1/{BETA}))
velocity      gas set 0 0 ${{ut}} units box
pair_style    liquid/sph ${{dr}}
pair_coeff    * *
neighbor      $(0.6*v_dr) bin
neigh_modify  one 10000 page 200000
fix           l water liquid/flow 1e9 1.0 les none ma 0 wall zlo slip dtmax 1e-3 momentum {momentum}
fix           b gas bubble/flow 1e9 {BETA} lift no virtual no surface no
compute       c water liquid/particle alpha mz ustarz pz
dump          d water custom 1 dump id x z vz c_c[*]
dump_modify   d sort id format float %.17g
run           0
"""


@pytest.mark.parametrize("momentum, times", [("standard", 1.0), ("published", 2.0)])
def test_buoyancy_counts_once(base_lmp, momentum, times):
    """Half of a tall column has bubbles at their terminal speed: their drag is the buoyancy M = c (1 - 1/beta). From
    rest the halves go apart with M / alpha. The published form has the pressure of alpha p, level across the halves,
    and counts the buoyancy twice. The column is four times as tall as it is wide, so that its ends matter at mid-height
    by e^(-2 pi); and c varies over 2 h at the edges of the halves, a third of which are left out."""
    frame = base_lmp(COLUMN.format(BETA=BETA, momentum=momentum)).dump("dump")[0]
    alpha, M, star, gradient = (frame[f"c_c[{k}]"] for k in (1, 2, 3, 4))
    inertia = alpha if momentum == "published" else 1.0
    a = star / 1e-3 - gradient / inertia - 1.0
    middle, x = abs(frame["z"] - 2) < 0.3, frame["x"]
    bubbly, clear = middle & (abs(x - 0.25) < 0.1), middle & (abs(x - 0.75) < 0.1)
    # particles are on a lattice whose cells have not grown by the gas, so that V_lb is 1/alpha; and sums on a lattice
    assert M[bubbly].mean() == pytest.approx(0.05 / 1.05 * (1 - 1 / BETA), rel=0.01)
    apart = a[bubbly].mean() - a[clear].mean()
    assert apart == pytest.approx(times * (M[bubbly] / alpha[bubbly]).mean(), rel=0.1)


# ---- what is refused ----------------------------------------------------------------------------

@pytest.mark.parametrize("change, error", [
    (dict(diameter=0.3, create=one(0.4, 0.4, 0.5)), "bubble .* has radius 0.15: .* at most the spacing"),
    (dict(more="fix s gas bubble/sparger 0.4 0.4 0.3 0.1 1e-3 radius 0.2\n"), "larger than the spacing"),
    (dict(more="fix s gas bubble/sparger 0.4 0.4 1.6 0.1 1e-3 radius 0.01\n"), "reaches out of the box along z"),
    (dict(more="fix s gas bubble/sparger 0.4 0.4 0.3 0.1 1e-3 normal 0.01 0.1 0.02\n"), "MIN of normal must be below"),
    (dict(gas="surface maybe"), "surface must be no or yes, not maybe"),
    (dict(gas="breakup -1"), "breakup must be an integer >= 0"),
    (dict(We=-1), "WE must be a number > 0"),
    (dict(more="unfix l\n"), "needs fix liquid/flow"),
    (dict(more="fix b2 water bubble/flow 1 2\n"), "there can be one only"),
    (dict(width=0.4), "the box is 0.4 wide along x: it must be"),
    (dict(more="fix g all gravity 1 vector 0 0 -1\n"), "walls do not hold what fix g pulls: gravity is FR"),
    (dict(more="fix d all deform 1 x scale 1.1\n"), "fix d changes the box"),
    (dict(more="pair_style hybrid liquid/sph 0.1 zero 0.3\npair_coeff 1 1 liquid/sph\npair_coeff * 2 zero\n",
          create=one(0.4, 0.4, 0.5)), "liquid of type 1 does not see type 2: pair_coeff 1 2 is missing"),
])
def test_bad_input(lmp, change, error):
    change = {"more": "", **change}
    result = lmp(tank(**{**change, "more": change["more"] + "run 2\n"}), check=False)
    assert result.returncode != 0 and any(re.search(error, line) for line in result.errors), result.errors


@pytest.mark.parametrize("change, warning", [
    ("neigh_modify exclude group water gas", "do not see those that neigh_modify excludes"),
    ("neigh_modify every 20 check no", "lists may be too old")])
def test_what_is_doubtful_is_said(lmp, change, warning):
    result = lmp(tank(create=one(0.4, 0.4, 0.5), more=f"{change}\nrun 0\n"))
    assert re.search(warning, result.screen), result.screen


def test_radii_of_a_sparger_stay_below_the_spacing(lmp):
    """Larger ones are drawn again, so that the next run need not refuse them."""
    result = lmp(tank(more="""
fix s gas bubble/sparger 0.4 0.4 0.3 0.1 0.5 normal 0.08 0.05 0.01
variable a atom radius
compute most gas reduce max v_a
thermo_style custom step f_b[1] c_most
thermo_modify norm no
thermo 20
run 20
run 1
"""))
    table = result.thermo[0]
    assert table["f_b[1]"][-1] > 30 and 0.09 < table["c_most"][-1] <= 0.1


def test_liquid_of_a_type_that_was_not_there(lmp):
    """Particles that are put into the box during a run see each other, whatever their type."""
    heights = []
    for kind in 1, 3:
        text = tank(more=f"""
region drops block 0.1 0.7 0.1 0.7 1.15 1.35 units box
fix rain water deposit 40 {kind} 1 771 region drops near 0.09 units box
dump d water custom 80 dump id z
dump_modify d sort id
run 80
""").replace("create_box    2", "create_box    3")
        heights.append(lmp(text).dump("dump")[-1]["z"])
    assert len(heights[0]) == 640 + 40
    assert heights[1] == pytest.approx(heights[0], abs=1e-5)


def test_births_beyond_an_open_face(base_lmp):
    """A liquid flows out of an open face. Of the bubbles that its surface entrains there, and of those that break, some
    begin beyond it: they are lost as other atoms are there, which LAMMPS was told to ignore. (With KOKKOS and one rank
    LAMMPS loses none: its exchange between ranks is then left out.)"""
    text = tank(create=one(0.31, 0.29, 0.22), Re=1e4, We=1.4e4, dt=1.0, gas="entrain 2 breakup 4", more="""
thermo_style custom step time f_b[1] f_b[3] f_b[6] atoms
thermo_modify norm no lost ignore
thermo 10
run 150
""").replace("boundary      p p f", "boundary      f p f").replace("wall zlo slip", "wall zlo noslip wall xlo slip")
    table = base_lmp(text.replace("les none", "")).thermo[0]
    assert table["f_b[3]"][-1] > 100
    assert (table["Atoms"] >= table["f_b[1]"]).all() and table["Atoms"][-1] < 200


def test_parts_stay_between_walls(lmp):
    """Bubbles that break beside a wall of the box: their parts are put to where their images are."""
    result = lmp(tank(create=one(0.41, 0.37, 0.02) + "\n" + one(0.2, 0.3, 0.03), diameter=0.08, velocity=BREAKING,
                      We=1e6, dt=0.002, gas="surface no breakup 5", more="""
thermo_style custom step f_b[1] f_b[2] f_b[4]
thermo_modify norm no format float %.17g
thermo 100
run 100
"""))
    table = result.thermo[0]
    assert table["f_b[4]"][-1] > 0
    assert table["f_b[2]"][-1] == pytest.approx(table["f_b[2]"][0], rel=1e-13)
