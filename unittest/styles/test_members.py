"""Particles that are no bubbles share the box: the group of the fixes says who is a bubble.

Beside the foams of foams.py there are particles of radius 0 (type 2) and some with a radius whose pair
coefficients with bubbles are 0 (type 3), at random places and outside the group.  To the bubbles this is the
foam without them: sums of the same numbers, in which neighbors may come in another order (limits: foams.py).
"""

import numpy as np
import pytest

from foams import SHORT, assert_same_run, assert_same_state, case, foam, state
from runner import HEAD, PRECISE, data_file

POINTS, WALL = 50, 10
OTHERS = POINTS + WALL
AMONG = f"""read_data     data extra/atom/types 2
group         bubbles type 1
create_atoms  2 random {POINTS} 11 NULL
create_atoms  3 random {WALL} 12 NULL
set           type 2 diameter 0.0
set           type 3 diameter 2.2
set           type 2 density 1.0
"""
COEFFICIENTS = """pair_coeff    * * 1.0
pair_coeff    1*3 2*3 0.0
"""


def among_others(text):
    for old, new in (("read_data     data\n", AMONG), ("pair_coeff    * * 1.0\n", COEFFICIENTS),
                     ("gas all", "gas bubbles"), ("step all", "step bubbles")):
        assert old in text
        text = text.replace(old, new)
    return text


def side(dim):
    return 16 if dim == 2 else 6


def files(dim, n=None):
    x, R, v, box = foam(dim, n or side(dim))
    return {"data": data_file([box] * dim, x, R, v)}


def only(frame, chosen):
    frame._columns = {name: column[chosen] for name, column in frame._columns.items()}
    return frame


def assert_same_bubbles(plain, mixed, dim, limit=SHORT, others=OTHERS, rounding=0.0):
    n = side(dim)
    total, box = n**dim, foam(dim, n)[3]
    for one, other in zip(plain.thermo, mixed.thermo, strict=True):
        assert np.array_equal(other["Atoms"], other["f_gas[2]"] + others)
        other = dict(other, Atoms=one["Atoms"])
        assert_same_run(one, other, limit)
    first, last = plain.thermo[0]["f_gas[2]"][0], plain.thermo[-1]["f_gas[2]"][-1]
    assert last < first    # bubbles vanish
    start = None
    for f, g in zip(plain.dump("dump"), mixed.dump("dump"), strict=True):
        is_bubble = g["id"] <= total
        rest = {name: column[~is_bubble] for name, column in g._columns.items()}
        only(g, is_bubble)
        assert np.array_equal(f["id"], g["id"])
        assert_same_state(state(f, dim), state(g, dim), box, limit)
        assert len(rest["id"]) == others    # none is missing
        start = start or rest
        for name in ("id", "x", "y", "z", "vx", "vy", "vz", "radius"):
            if name in "xyz":
                assert np.abs(rest[name] - start[name]).max() <= rounding * box, name
            else:
                assert np.array_equal(rest[name], start[name]), name
        for name in rest:
            if name.startswith("c_b"):
                assert not rest[name].any(), name


RUN = dict(gas="0.1 0.1 rmin 0.4", run="run 120", every=20)

SCENES = {
    "abm": dict(),
    "rkc": dict(integrator="rkc", run="run 60"),    # of long steps: near foams part sooner
    "3D": dict(dim=3),
    "rkc 3D": dict(dim=3, integrator="rkc", run="run 60"),
    "source": dict(step="1e-3 scheme source norm max"),
    "neighbor drag": dict(pair="drag neighbor", step="1e-3 drift remove"),
    "rkc, neighbor drag": dict(pair="drag neighbor", integrator="rkc", run="run 60"),
    "film only": dict(gas="0.1 0 rmin 0.4"),
    "lsw": dict(gas="0.1 0.3 liquid lsw rmin 0.4"),
    "sorted often": dict(after="atom_modify sort 5 2.0"),
    "2 ranks": dict(ranks=2, integrator="rkc", run="run 60"),
    "4 ranks": dict(ranks=4, pair="drag neighbor", after="atom_modify sort 10 2.0"),
    "3D on 2 ranks": dict(dim=3, ranks=2),
    # subdomains move, so the others go from rank to rank, too; LAMMPS takes their places to fractions of
    # the box and back, which rounds them each time
    "balanced": dict(ranks=3, after="fix cut all balance 20 1.0 shift xy 10 1.1", rounding=1e-14),
    # another fix keeps numbers on the host: the dead are taken out there
    "state stored": dict(after="fix first all store/state 0 xu yu radius"),
    "newton off": dict(before="newton off"),
    "cutoffs renewed": dict(pair="headroom 1.0", ranks=2),
    "triclinic": dict(neighbor="0.3 bin\nchange_box all triclinic", rounding=1e-14),    # here, too
}


@pytest.mark.parametrize("name", SCENES)
def test_bubbles_do_not_notice(lmp, name):
    how = {**RUN, **SCENES[name]}
    dim, ranks, rounding = how.pop("dim", 2), how.pop("ranks", 1), how.pop("rounding", 0.0)
    text = case(dim, **how)
    plain = lmp(text, files=files(dim), ranks=ranks)
    mixed = lmp(among_others(text), files=files(dim), ranks=ranks)
    assert_same_bubbles(plain, mixed, dim, rounding=rounding)


def test_others_come_and_go(lmp):
    """Between runs; to the bubbles nothing has happened, and the history of their steps goes on."""
    text = case(2, **{**RUN, "run": "run 40\nrun 40\nrun 40"})
    plain = lmp(text, files=files(2))
    mixed = lmp(among_others(text).replace("run 40\nrun 40\nrun 40", """run 40
group others subtract all bubbles
delete_atoms group others
run 40
create_atoms 2 random 30 13 NULL
set type 2 diameter 0
run 40"""), files=files(2))
    for one, other, others in zip(plain.thermo, mixed.thermo, (OTHERS, 0, 30), strict=True):
        assert np.array_equal(other["Atoms"], other["f_gas[2]"] + others)
        for name in ("Time", "f_gas[1]", "f_gas[2]", "f_gas[3]", "f_gas[5]", "f_step[3]", "f_step[4]"):
            assert one[name] == pytest.approx(other[name], rel=SHORT), name


def test_bubbles_come_and_go(lmp):
    """Bubbles that join the group between runs are counted, and those that are deleted."""
    text = among_others(case(2, **{**RUN, "run": """run 20
create_atoms 1 random 40 7 NULL
group bubbles type 1
run 20
group some id 1:60
delete_atoms group some
run 20"""}))
    tables = lmp(text, files=files(2)).thermo
    for table in tables:
        assert np.array_equal(table["Atoms"], table["f_gas[2]"] + OTHERS)
    assert tables[1]["f_gas[2]"][0] == tables[0]["f_gas[2]"][-1] + 40
    assert tables[2]["f_gas[2]"][0] < tables[1]["f_gas[2]"][-1] - 40


# ---- restart ------------------------------------------------------------------------------------

@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("integrator, pair", [("abm", ""), ("rkc", ""), ("abm", "drag neighbor")])
def test_restart_is_bitwise(bitwise_lmp, integrator, pair, ranks):
    keywords = dict(gas="0.1 0.1 rmin 0.4", pair=pair, integrator=integrator, every=10)
    text = among_others(case(2, after="restart 50 state.*", run="run 90", **keywords))
    a = bitwise_lmp(text, files=files(2, 10), ranks=ranks)
    b = bitwise_lmp(f"""
read_restart  state.50
neighbor      0.3 bin
fix           gas bubbles foam/coarsen 0.1 0.1 rmin 0.4
fix           step bubbles foam/{integrator} 1e-3
compute       b all foam/bubble contacts area free vfilm vliquid rdot espring edurian
thermo_style  custom step atoms time pe f_gas[*] f_step[*]
{PRECISE}
thermo        10
dump          d all custom 10 dump2 id x y z vx vy vz fx fy fz radius c_b[*]
dump_modify   d sort id format float %.17g
run           40
""", directory=a.directory, ranks=ranks)
    frames = {frame.step: frame for frame in a.dump("dump")}
    again = b.dump("dump2")
    assert [frame.step for frame in again] == [50, 60, 70, 80, 90]
    assert len(again[-1]) < len(again[0]) < 100 + OTHERS    # bubbles vanish before and after
    for frame in again:
        for column in frame._columns:
            assert np.array_equal(frame[column], frames[frame.step][column]), (frame.step, column)
    rows = {step: row for row, step in enumerate(a.thermo[0]["Step"])}
    for name in ("Atoms", "f_gas[1]", "f_gas[2]", "f_gas[7]", "f_step[1]", "f_step[2]"):
        for row, step in enumerate(b.thermo[0]["Step"]):
            assert b.thermo[0][name][row] == a.thermo[0][name][rows[step]], (step, name)


# ---- particles with a radius --------------------------------------------------------------------

def press(lmp, group, sigma=2.0, pair="drag neighbor", ranks=1):
    """A bubble of radius 1 pressed on a particle (type 2) of radius 0.5, and two others that touch."""
    text = HEAD.format(dim=2) + f"""
read_data     data extra/atom/types 1
set           atom 2 type 2
group         bubbles id 1 3 4
neighbor      0.3 bin
pair_style    durian/foam 1.0 {pair} rin 1.0
pair_coeff    * * 1.0
pair_coeff    1 2 {sigma}
fix           gas {group} foam/coarsen 0.1 0
fix           step {group} foam/abm 1e-6 dt0 1e-3 drift keep
compute       b all foam/bubble contacts area vfilm espring
dump          d all custom 1 dump id x y z vx vy vz fx fy fz radius c_b[*]
dump_modify   d sort id format float %.17g
{PRECISE}
run           1
"""
    x, R = [[3, 3], [4.2, 3], [7, 7], [8.5, 7]], [1.0, 0.5, 1.0, 0.9]
    return lmp(text, files={"data": data_file([12, 12], x, R)}, ranks=ranks).dump("dump")


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("pair", ["drag static", "drag neighbor"])
def test_a_particle_pushes_but_is_no_bubble(lmp, pair, ranks):
    """Its force is that of the pair coefficient; it has no gas, and the bubble does not follow it."""
    first, last = press(lmp, "bubbles", pair=pair, ranks=ranks)
    force = 2.0 * (1.5 - 1.2) / 1.5    # sigma0 <R_in> overlap / (R_i + R_j)
    assert first["fx"][:2] == pytest.approx([-force, force], rel=1e-12)
    assert first["vx"][0] == pytest.approx(-force, rel=1e-12)    # mu0 = 1: nobody to follow
    for name in ("c_b[1]", "c_b[2]", "c_b[3]"):    # contacts, area, gas
        assert not first[name][:2].any()
        assert first[name][2:].all()
    assert first["c_b[4]"][0] == pytest.approx(0.5 * force * 0.3 / 2, rel=1e-12)    # half of the energy
    for name in ("x", "y", "z", "vx", "vy", "vz", "radius"):
        assert last[name][1] == first[name][1]
    assert last["radius"][0] == pytest.approx(1.0, abs=1e-14)
    assert last["x"][0] < first["x"][0]


def test_a_bubble_is_one(lmp):
    """The same particle in the group exchanges gas: what the test above says is no accident."""
    first, last = press(lmp, "all")
    assert first["c_b[1]"][:2] == pytest.approx([1, 1])
    assert first["c_b[3]"][0] > 0 > first["c_b[3]"][1]
    assert last["radius"][0] > 1.0


def test_it_is_said(lmp):
    """Once, and only where particles outside the group have a radius."""
    text = among_others(case(2, run="run 1\nrun 1"))
    said = "10 particles with a radius are not in group bubbles"
    assert lmp(text, files=files(2, 8)).screen.count(said) == 1
    text = text.replace("diameter 2.2", "diameter 0")
    assert "particles with a radius" not in lmp(text, files=files(2, 8)).screen


def test_mean_radius_is_that_of_bubbles(lmp):
    """<R_in> and <A_in> leave out the particles that are none."""
    result = lmp(among_others(case(2)), files=files(2, 8))
    table, R = result.thermo[0], foam(2, 8)[1]
    assert table["f_gas[9]"][0] == pytest.approx(R.mean(), rel=1e-14)
    assert table["f_gas[10]"][0] == pytest.approx(2 * np.pi * R.mean(), rel=1e-14)
    assert table["f_gas[4]"][0] == pytest.approx(R.max() / R.mean(), rel=1e-14)


# ---- refused ------------------------------------------------------------------------------------

def refused(lmp, text, ranks=1):
    result = lmp(text, files=files(2, 8), ranks=ranks, check=False)
    assert result.returncode > 0
    return result.errors[0]


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("gas, step", [("bubbles", "all"), ("all", "bubbles"), ("same", "bubbles")])
@pytest.mark.parametrize("integrator", ["abm", "rkc"])
def test_two_groups(lmp, integrator, gas, step, ranks):
    text = among_others(case(2, integrator=integrator)).replace(
        "group         bubbles type 1", "group bubbles type 1\ngroup same type 1")
    text = text.replace("gas bubbles", f"gas {gas}").replace("step bubbles", f"step {step}")
    error = refused(lmp, text, ranks)
    for words in (f"foam/{integrator} has group {step}", f"foam/coarsen group {gas}"):
        assert words in error, error


@pytest.mark.parametrize("rin", ["", "rin 1.0"])
def test_empty_group(lmp, rin):
    text = among_others(case(2, pair=rin)).replace("bubbles type 1", "bubbles id 100000")
    error = refused(lmp, text)
    assert "foam/abm" in error and "no particle is in group bubbles" in error, error


def test_dynamic_group(lmp):
    """Who is a bubble would change within a run: LAMMPS itself refuses."""
    text = among_others(case(2)).replace(
        "group         bubbles type 1", "group one type 1\ngroup bubbles dynamic one every 1")
    error = refused(lmp, text)
    assert "foam/" in error and "dynamic group" in error, error


def test_bubble_without_radius(lmp):
    """In the group a radius of 0 is a mistake still."""
    text = among_others(case(2)).replace("set           type 2 density", "group bubbles type 2\nset type 2 density")
    error = refused(lmp, text)
    assert "foam/abm" in error and "the radius of bubble" in error, error
