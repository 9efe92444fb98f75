"""A resolved liquid and its bubbles at the extremes: nothing hangs, and no particle and no gas is lost unseen."""

import re

import numpy as np
import pytest

from test_liquid import VORTEX
from test_liquid_bubbles import BREAKING, one, tank

LOOK = """
dump d all custom {every} dump id type x y z vx vy vz
dump_modify d sort id format float %.17g
thermo_style custom step time f_l[2] f_l[5] f_l[7] f_l[8] f_b[*] atoms
thermo_modify norm no format float %.17g
thermo 1
run {steps}
"""
V = 4 / 3 * np.pi * 0.01**3    # of a bubble of tank()


def look(steps, every=None):
    return LOOK.format(steps=steps, every=every or steps)


def finite(frame):
    return np.isfinite(frame.array("x", "y", "z", "vx", "vy", "vz")).all()


def gas(table):
    """What is in bubbles and has burst."""
    return table["f_b[2]"] + table["f_b[6]"]


# ---- few particles ------------------------------------------------------------------------------

@pytest.mark.parametrize("shift", ["yes", "published", "no"])
def test_spray(lmp, shift):
    """A particle alone falls as a stone does. The step takes constant accelerations exactly."""
    two = f"{one(0.13, 0.2, 1.1)}\n{one(0.5, 0.6, 1.3)}".replace("2 single", "1 single")
    text = tank(more=look(20)).replace("create_atoms  1 region full", two)
    result = lmp(text.replace("dtmax", f"shift {shift} dtmax"))
    first, last = result.dump("dump")
    t = result.thermo[0]["Time"][-1]
    assert last["z"] == pytest.approx(first["z"] - t**2 / 2, rel=1e-13)
    assert last["vz"] == pytest.approx([-t, -t], rel=1e-13)
    assert (last["x"] == first["x"]).all() and (last["vx"] == 0).all()


@pytest.mark.parametrize("create", ["", one(0.4, 0.4, 0.5)])
def test_dry_tank(lmp, create):
    """Without a liquid there is nothing to solve; bubbles fall, and lie on the floor."""
    text = tank(create=create, more=look(100)).replace("create_atoms  1 region full\n", "")
    if not create:
        text = re.sub("set  .*", "", text)    # LAMMPS refuses it
    result = lmp(text)
    assert (result.thermo[0]["f_l[5]"] == 0).all()
    if create:
        last = result.dump("dump")[-1]
        assert len(last) == 1 and 0 <= last["z"][0] < 0.5 and finite(last)


@pytest.mark.parametrize("ranks", [1, 2, 4])
def test_one_particle_deep(base_lmp, ranks):
    """A film of one layer has no neighbors on either side, and its matrix of gradients no inverse."""
    text = tank(more=look(50)).replace("0 0.8 0 0.8 0 1 units box", "0 0.8 0 0.8 0 0.1 units box")
    result = base_lmp(text, ranks=ranks)
    last = result.dump("dump")[-1]
    assert len(last) == 64 and finite(last)
    assert last["z"] == pytest.approx(last["z"].mean(), abs=1e-9) and 0 <= last["z"].min()


def test_surface_that_closes_on_itself(lmp):
    """A cavity in a periodic liquid, which flows together in it: no particle is lost, and energy is."""
    text = VORTEX.format(n=12, Re=100, more="dtmax 1e-2").replace(
        "pair_style", "region hole sphere 0.5 0.5 0.25 0.2 units box\ndelete_atoms region hole\npair_style", 1)
    result = lmp(text + """
thermo_style custom step time f_l[5] f_l[7] atoms
thermo_modify norm no
thermo 1
run 200
""")
    table = result.thermo[0]
    assert table["f_l[7]"][0] > 0 and (table["Atoms"] == table["Atoms"][0]).all()
    assert np.isfinite(table["f_l[5]"]).all() and table["f_l[5]"][-1] < table["f_l[5]"][0]


# ---- bubbles at the edge ------------------------------------------------------------------------

WALLS = [("boundary      p p f", "boundary      f f f"),
         ("wall zlo slip", "wall zlo slip wall xlo noslip wall xhi noslip wall ylo slip wall yhi noslip")]


def closed(**words):
    text = tank(**words)
    for old, new in WALLS:
        text = text.replace(old, new)
    return text


@pytest.mark.parametrize("place", [(0.4, 0.4, 0.0), (0.0, 0.0, 0.0), (0.8 - 1e-12, 0.0, 0.5), (1e-12, 0.4, 0.3)])
def test_bubble_on_a_wall(lmp, place):
    """It comes off, or slides along it, and stays in the box."""
    result = lmp(closed(create=one(*place), gas="surface yes", more=look(50, 1)))
    for frame in result.dump("dump"):
        assert finite(frame) and len(frame) == 8 * 8 * 10 + 1
        bubble = frame.array("x", "y", "z")[frame["type"] == 2][0]
        assert (bubble >= 0).all() and (bubble <= [0.8, 0.8, 1.4]).all()
    assert bubble[2] > place[2]    # it rises


@pytest.mark.parametrize("ranks", [1, 2, 4])
def test_sparger_in_a_corner(base_lmp, ranks):
    """Its disc reaches to the walls. All gas that it gives is in bubbles, or has burst."""
    result = base_lmp(closed(gas="surface yes langevin 3", more="""
fix s gas bubble/sparger 0.05 0.05 0.02 0.05 2e-3 radius 0.01 seed 4
""" + look(60).replace("atoms", "f_s[1] f_s[2]")), ranks=ranks)
    table = result.thermo[0]
    assert table["f_s[1]"][-1] > 100
    assert gas(table) == pytest.approx(table["f_s[2]"], rel=1e-12)
    last = result.dump("dump")[-1]
    assert finite(last) and (np.bincount(last["type"].astype(int))[1:] == [640, table["f_b[1]"][-1]]).all()


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("gas, more", [
    ("surface no", "fix s gas bubble/sparger 0.4 0.4 0.2 0.1 1e-2 radius 0.01 seed 4\n"),
    ("surface yes", "create_atoms 2 random 20 5 skin\n")])
def test_gas_that_leaves_is_missed(base_lmp, gas, more, ranks):
    """A bubble that flies out of an open face is lost, as LAMMPS says, while others are born or burst."""
    skin = "region skin block 0 0.8 0 0.8 0.98 1.02 units box\n"
    text = tank(create=skin + one(0.4, 0.4, 1.35) + "\n" + more * (gas == "surface yes"), gas=gas,
                velocity="velocity gas set 0 0 5 units box",
                more=more * (gas == "surface no") + look(40).replace("thermo 1", "thermo 40"))
    result = base_lmp(text, ranks=ranks, check=False)
    assert any(re.search("Lost atoms: original .* current", line) for line in result.errors), result.errors


@pytest.mark.parametrize("place", ["0 0 0 0.05", "0.8 0.8 1.4 0.05"])
def test_sparger_beyond_a_corner(lmp, place):
    result = lmp(closed(more=f"fix s gas bubble/sparger {place} 1e-3 radius 0.01\nrun 2\n"), check=False)
    assert any("reaches out of the box along x" in line for line in result.errors), result.errors


def test_particles_full_of_gas(lmp):
    """alpha has a limit, 2/3: what is beyond is not counted in the volume of the liquid, and said once. The gas is
    all there."""
    create = "region few block 0.3 0.5 0.3 0.5 0.3 0.5 units box\ncreate_atoms 2 random 600 771 few"
    result = lmp(tank(create=create, diameter=0.08, gas="surface yes", more="compute c water liquid/particle c alpha\n"
                      "compute most water reduce max c_c[1]\ncompute least water reduce min c_c[2]\n"
                      + look(30).replace("atoms", "c_most c_least")))
    table = result.thermo[0]
    assert table["c_most"][0] == 0.5 and table["c_least"].min() == pytest.approx(2 / 3, rel=1e-15)
    assert gas(table) == pytest.approx(600 * 4 / 3 * np.pi * 0.04**3, rel=1e-12)
    assert finite(result.dump("dump")[-1])
    assert len(re.findall("particles are full of gas", result.screen)) == 1


# ---- numbers at the extremes --------------------------------------------------------------------

@pytest.mark.parametrize("Re", ["1", "1e-2", "1e7"])
def test_reynolds_numbers(lmp, Re):
    """A vortex slows down, at any viscosity; what is given as the longest step does not matter."""
    table = lmp(VORTEX.format(n=8, Re=Re, more="dtmax 1e9") + """
thermo_style custom step time f_l[2] f_l[5]
thermo_modify norm no format float %.17g
thermo 1
run 50
""").thermo[0]
    h = 1.3 / 8
    assert (table["f_l[2]"] <= 0.2 * float(Re) * h**2 * (1 + 1e-12)).all() and (table["f_l[2]"] > 0).all()
    assert np.isfinite(table["f_l[5]"]).all() and table["f_l[5]"][-1] < table["f_l[5]"][0]


def test_level_of_the_pressure(lmp):
    """Without a surface the mean of the pressure says nothing. It stays 0 where particles are in disorder, too, and
    so does the size of what the solver's tolerance is measured by."""
    result = lmp(VORTEX.format(n=10, Re=1e5, more="dtmax 1e-2").replace(
        "pair_style", "displace_atoms all random 0.03 0.03 0.03 5 units box\npair_style", 1) + """
compute p all liquid/particle p
compute mean all reduce ave c_p
compute square all reduce avesq c_p
thermo_style custom step time c_mean c_square
thermo 1
run 100
""")
    table = result.thermo[0]
    assert np.abs(table["c_mean"]).max() < 1e-12
    assert table["c_square"].max() < 10    # the velocity is 1


@pytest.mark.parametrize("what", ["velocity water set NULL NULL v_none", "fix push water addforce 0 0 v_none"])
def test_not_a_number(lmp, what):
    result = lmp(tank(more=f"variable none atom 1e308*10-1e308*10\n{what}\nrun 5\n"), check=False)
    assert any(re.search("the pressure was not found at step .*: residual -?nan after", line)
               for line in result.errors), result.errors


def test_bubbles_at_one_place(lmp):
    """They do not see each other."""
    create = "\n".join([one(0.41, 0.37, 0.3)] * 3)
    result = lmp(tank(create=create, gas="surface no", more=look(20)))
    last = result.dump("dump")[-1]
    places = last.array("x", "y", "z", "vx", "vy", "vz")[last["type"] == 2]
    assert finite(last) and (places == places[0]).all() and places[0][2] > 0.3


@pytest.mark.parametrize("diameter", [1e-12, 0.2])
def test_smallest_and_largest_bubbles(lmp, diameter):
    """One that goes with the liquid, and one as large as may be."""
    result = lmp(tank(create=one(0.41, 0.37, 0.3), diameter=diameter, gas="surface yes langevin 2 breakup 3",
                      more=look(20)))
    last = result.dump("dump")[-1]
    assert finite(last) and gas(result.thermo[0]) == pytest.approx(4 / 3 * np.pi * (diameter / 2)**3, rel=1e-12)


def test_everything_breaks(lmp):
    """Far too little tension: parts break again, until they are too small, and all gas stays."""
    create = "create_atoms 2 random 5 771 full overlap 0.02 maxtry 1000"
    result = lmp(tank(create=create, diameter=0.1, velocity=BREAKING, We=1e12, dt=0.002, gas="surface no breakup 5",
                      more=look(150)))
    table = result.thermo[0]
    assert table["f_b[4]"][-1] > 10
    assert table["f_b[2]"] == pytest.approx(5 * 4 / 3 * np.pi * 0.05**3, rel=1e-12)
