"""Forces of bubbles with inertia, as LAMMPS has them: against the model of Heitkam et al. 2017 (doc/collision.rst),
written down here once more, in all the ways in which a scene can be put into LAMMPS.  How bubbles move:
test_bubble_motion.py.  The formulae one by one: physics/test_bubble.cpp."""

import re

import numpy as np
import pytest

from runner import PRECISE, data_file

SIGMA, MU, RHO, G, GAS = 0.03, 1e-3, 1000.0, 9.81, 1.2    # water with soap
MM, UM = 1e-3, 1e-6
R6 = 0.6 * MM

HEAD = """
units        si
atom_style   sphere
atom_modify  map array
comm_modify  vel yes
boundary     {boundary}
{before}
read_data    data
{after}
set          group all density {density}
neighbor     {skin} bin
"""


def wrong(why):
    return pytest.mark.xfail(strict=True, reason=why)


PAIR = f"pair_style bubble/collision {SIGMA} {MU}"
TERMS = ("elastic", "viscous", "lubrication", "tangential", "drag", "buoyancy")
LOOKS = ("delta", "ra", "h0", "contacts", "energy")
OUTPUT = """
compute      c all bubble/collision {terms}
compute      p all pair bubble/collision
dump         d all custom {every} dump id x y z vx vy vz fx fy fz c_c[*]
dump_modify  d sort id format float %.17g time yes
thermo_style custom step time dt c_p c_p[*] {columns}
thermo       {every}
"""


def text(pair="", wall="", rise="", step="fix s all bubble/nve", dt=1e-5, run="run 0", every=1, skin=1e-4, before="",
         after="", boundary="p p p", density=GAS):
    """Input.  wall: arguments of fix wall/bubble, or a list of them; rise: of fix bubble/rise."""
    walls = [wall] if isinstance(wall, str) else wall
    lines = [HEAD.format(before=before, after=after, boundary=boundary, skin=skin, density=density),
             f"{PAIR} {pair}", "pair_coeff * *"]
    columns = []
    for name, arguments in zip("wxy", walls):
        if arguments:
            lines.append(f"fix {name} all wall/bubble {arguments}")
            columns.append(f"f_{name} f_{name}[*]")
    if rise:
        lines.append(f"fix r all bubble/rise {rise}")
        columns.append("f_r[*]")
    lines.append(step)
    if step:
        columns.append("f_s[*]")
    terms = " ".join(f"{term}_{axis}" for term in TERMS for axis in "xyz") + " " + " ".join(LOOKS)
    lines += [f"timestep {dt}", OUTPUT.format(terms=terms, columns=" ".join(columns), every=every), PRECISE, run]
    return "\n".join(lines) + "\n"


BOX = [(-10 * MM, 10 * MM)] * 3


def data(x, R, v=None, box=BOX):
    x = np.atleast_2d(x)
    return {"data": data_file(box, x, np.broadcast_to(R, len(x)), v)}


def term(frame, name):
    """(N, 3) of a vector, (N,) of a number, as the compute has it."""
    if name in LOOKS:
        return frame[f"c_c[{19 + LOOKS.index(name)}]"]
    first = 1 + 3 * TERMS.index(name)
    return frame.array(*[f"c_c[{k}]" for k in range(first, first + 3)])


# ---- the model, once more -----------------------------------------------------------------------

def elastic(Delta, R):
    return SIGMA * R * (18.5 * (Delta / R)**2 + 2.0 * Delta / R)


def series(overlap, Ri, Rj):
    """Force, Delta_i and Delta_j of two in series: eq. 9 for both, by bisection for Delta_i."""
    lo, hi = 0.0, overlap
    for _ in range(100):
        middle = 0.5 * (lo + hi)
        if elastic(middle, Ri) > elastic(overlap - middle, Rj):
            hi = middle
        else:
            lo = middle
    return elastic(lo, Ri), lo, overlap - lo


def film(Delta, R, h0, squared):
    """eqs. 10 and 17: coefficient of the approach speed."""
    Ra = R * (-0.04 + np.sqrt(0.0016 + 9.44 * Delta / R)) / 4.72
    D = 0.34 / np.sqrt(Delta / R + 0.0002)
    return 12 * MU / (2 * np.pi) * (D**2 if squared else D) * (4.0 * np.sqrt(R**3 / h0) + 3.0 * Ra * R / h0)


def wall_forces(R, gap, un, ut, squared=False):
    """Along the normal, and along the wall: bubble at the first evaluation, which sets h0."""
    h0 = max(np.sqrt(3 / 8 * MU * max(-un, 0.0) * R**2 / SIGMA), 10 * UM)
    closed = gap < h0
    Delta = max(h0 - gap, 0.0)
    slide = max(gap, 10 * UM)
    return {
        "h0": h0 if closed else 0.0,
        "elastic": elastic(Delta, R),
        "viscous": -film(Delta, R, h0, squared) * un if closed else 0.0,
        "lubrication": -6 * np.pi * MU * R**2 * un / gap if h0 <= gap < R else 0.0,
        "tangential": 16 / 5 * np.pi * MU * R * ut * np.log(slide / R) if slide < R else 0.0,
    }


def pair_forces(Ri, Rj, gap, un, ut, squared=False):
    star, mean = Ri * Rj / (Ri + Rj), 2 * Ri * Rj / (Ri + Rj)
    h0 = max(np.sqrt(3 / 8 * MU * max(-un, 0.0) * star * max(Ri, Rj) / SIGMA), 10 * UM)
    closed = gap < h0
    overlap = max(h0 - gap, 0.0)
    slide = max(gap, 10 * UM)
    return {
        "h0": h0 if closed else 0.0,
        "elastic": series(overlap, Ri, Rj)[0],
        "viscous": -0.25 * film(0.5 * overlap, mean, h0, squared) * un if closed else 0.0,
        "lubrication": -6 * np.pi * MU * star**2 * un / gap if h0 <= gap < mean else 0.0,
        "tangential": 16 / 5 * np.pi * MU * mean * ut * np.log(slide / mean) if slide < mean else 0.0,
    }


# ---- forces of one state ------------------------------------------------------------------------

GAPS = {"beyond": 1.01, "just within": 0.99, "wide": 0.3, "film": 0.02, "touching": 0.0, "pressed": -0.1, "deep": -0.6}
NORMAL = np.array([2.0, -1.0, 2.0]) / 3.0
ALONG = np.array([1.0, 2.0, 0.0]) / np.sqrt(5.0)


def assert_forces(frame, i, expected, n, along, R):
    """1e-9: digits that gap / R loses in the difference of positions, which the film's log and roots pass on."""
    scale = max(SIGMA * R * 1e-6, *(abs(value) for name, value in expected.items() if name != "h0"))
    for name in ("elastic", "viscous", "lubrication", "tangential"):
        direction = along if name == "tangential" else n
        assert term(frame, name)[i] == pytest.approx(expected[name] * direction, abs=1e-9 * scale), name
    assert term(frame, "h0")[i] == pytest.approx(expected["h0"], rel=1e-9)
    total = sum(term(frame, name)[i] for name in TERMS)
    assert frame.array("fx", "fy", "fz")[i] == pytest.approx(total, rel=1e-12, abs=1e-12 * scale)


@pytest.mark.parametrize("un, squared", [(-0.1, False), (0.05, True)])
@pytest.mark.parametrize("gap", GAPS)
def test_wall(lmp, gap, un, squared):
    x, v = NORMAL * R6 * (1 + GAPS[gap]), un * NORMAL + 0.03 * ALONG
    wall = "plane 0 0 0 {} {} {}".format(*(3 * NORMAL))
    result = lmp(text(wall=wall, pair="viscous derived" if squared else ""), data(x, R6, [v]))
    expected = wall_forces(R6, GAPS[gap] * R6, un, 0.03, squared)
    frame = result.dump("dump")[0]
    assert_forces(frame, 0, expected, NORMAL, ALONG, R6)
    table = result.thermo[0]
    on_wall = [table[f"f_w[{k}]"][0] for k in (1, 2, 3)]
    assert on_wall == pytest.approx(-frame.array("fx", "fy", "fz")[0], rel=1e-12)
    assert table["f_w[4]"][0] == (expected["h0"] > 0)
    powers = [table[f"f_w[{k}]"][0] for k in (5, 6, 7)]
    assert powers == pytest.approx([expected["viscous"] * un, expected["lubrication"] * un,
                                    expected["tangential"] * 0.03], rel=1e-9, abs=1e-30)
    assert max(powers) <= 0.0    # they take energy


@pytest.mark.parametrize("ratio, squared", [(1.0, False), (3.0, True), (100.0, False)])
@pytest.mark.parametrize("gap", GAPS)
def test_pair(lmp, gap, ratio, squared):
    Ri, Rj = R6, R6 / ratio
    mean = 2 * Ri * Rj / (Ri + Rj)
    width = GAPS[gap] * mean
    x = np.array([[0.0, 0.0, 0.0], NORMAL * (Ri + Rj + width)])
    v = np.array([[0.01, 0.0, -0.02], [0.01, 0.0, -0.02]]) + np.array([[0.0], [1.0]]) * (-0.1 * NORMAL + 0.03 * ALONG)
    result = lmp(text(pair="tangential all" + (" viscous derived" if squared else "")), data(x, [Ri, Rj], v))
    expected = pair_forces(Ri, Rj, width, -0.1, 0.03, squared)
    frame = result.dump("dump")[0]
    assert_forces(frame, 1, expected, NORMAL, ALONG, Rj)
    forces = frame.array("fx", "fy", "fz")
    assert np.array_equal(forces[0], -forces[1])
    table = result.thermo[0]
    powers = [-0.1 * expected["viscous"], -0.1 * expected["lubrication"], 0.03 * expected["tangential"]]
    assert [table[f"c_p[{k}]"][0] for k in (1, 2, 3)] == pytest.approx(powers, rel=1e-9, abs=1e-30)
    if expected["h0"] > 0:
        Deltas = series(expected["h0"] - width, Ri, Rj)[1:]
        assert term(frame, "delta") == pytest.approx(np.array(Deltas), rel=1e-8)


def test_stress_of_walls(lmp):
    """Two plates that squeeze a bubble: sum of r f is force times distance of the plates, and shear stress where it
    slides along one of them; off unless asked for."""
    half, speed = R6 - 30 * UM, 0.01
    walls = [f"plane 0 0 {-half} 0 0 1", f"plane 0 0 {half} 0 0 -1 tangential no"]
    volume = np.prod([hi - lo for lo, hi in BOX])
    stress = "compute v all pressure NULL virial\nthermo_style custom step c_v[*] f_w[*] f_x[*]\n" + PRECISE
    asked = "fix_modify w virial yes\nfix_modify x virial yes\n"

    def run(more):
        return lmp(text(wall=walls, run=f"{stress}{more}run 0"), data([0, 0, 0], R6, [[speed, 0, 0]])).thermo[0]

    its = run(asked)
    v = {k: its[f"c_v[{k}]"][0] * volume for k in range(1, 7)}
    assert its["f_x[3]"][0] > 0
    assert v[3] == pytest.approx(2 * half * its["f_x[3]"][0], rel=1e-12, abs=0)
    assert v[5] == pytest.approx(0.5 * half * -its["f_w[1]"][0], rel=1e-12, abs=0)    # symmetric part of r_z f_x
    assert v[5] < 0 and v[1] == v[2] == v[4] == v[6] == 0.0
    assert all(run("")[f"c_v[{k}]"][0] == 0.0 for k in range(1, 7))


# ---- regions, ranges ----------------------------------------------------------------------------

def test_region(lmp):
    """The surface of a region is a wall: a side of a box is a plane, a corner is two of them."""
    x, v = np.array([[0.0, 0.0, 0.5 * MM], [0.0, 0.55 * MM, 0.5 * MM]]), [[0.02, 0, -0.1]] * 2
    box = f"region all block -5e-3 5e-3 {-5 * MM} {1.1 * MM} 0 5e-3 side in"
    for n in 0, 1:
        one = lmp(text(wall="region all", after=box), data(x[n], R6, v[:1]))
        two = lmp(text(wall=["plane 0 0 0 0 0 1", f"plane 0 {1.1 * MM} 0 0 -1 0"]), data(x[n], R6, v[:1]))
        forces = [result.dump("dump")[0].array("fx", "fy", "fz") for result in (one, two)]
        assert np.abs(forces[1]).max() > 1e-6
        assert forces[0] == pytest.approx(forces[1], rel=1e-12, abs=1e-18)
        assert term(one.dump("dump")[0], "contacts")[0] == 1 + n


@pytest.mark.parametrize("model", ["contact", "current", "2e-5"])
@pytest.mark.parametrize("where", ["wall", "pair"])
def test_range_holds_the_film(lmp, where, model):
    """A bubble smaller than its film meets it where the gap is h0, not where its reach happens to end."""
    R, gap = 5 * UM, 9 * UM
    x = [[0, 0, R + gap]] if where == "wall" else [[0, 0, 0], [0, 0, 2 * R + gap]]
    result = lmp(text(pair=f"h0 {model}", wall="plane 0 0 0 0 0 1" if where == "wall" else ""),
                 data(x, R, np.zeros((len(x), 3))))
    frame = result.dump("dump")[0]
    assert np.all(term(frame, "contacts") == 1)
    assert np.all(np.abs(frame["fz"]) > 0)


@pytest.mark.parametrize("reach", [0.1, 0.5])
def test_sliding_is_off_at_its_own_distance(lmp, reach):
    """Eq. 19: at a gap of R; the reach is that of lubrication."""
    result = lmp(text(pair=f"reach {reach}", wall="plane 0 0 0 0 0 1"), data([0, 0, 1.7 * R6], R6, [[0.1, 0, 0]]))
    expected = wall_forces(R6, 0.7 * R6, 0.0, 0.1)["tangential"]
    assert result.dump("dump")[0]["fx"][0] == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("model, reach", [
    ("", 1), ("lubrication no", 1), ("lubrication no h0 1e-5", 0.3 + 1e-5 / R6), ("h0 1e-5", 1), ("reach 0.1", 0.1),
    ("lubrication no h0 1e-5 tangential all", 1), ("lubrication no h0 1e-5 reach 0.1", 0.1),
    ("lubrication no h0 3e-4", 0.3 + 3e-4 / R6), ("lubrication no h0 3e-4 reach 0.1", 3e-4 / R6)])
def test_lists_end_where_nothing_acts(lmp, model, reach):
    """Terms that are off cost no neighbors."""
    result = lmp(text(pair=model), data([[0, 0, 0], [0, 0, 4 * R6]], R6))
    found = re.search("list distance cutoff = (.*)", result.screen)
    assert float(found[1]) == pytest.approx((2 + reach) * R6 + 1e-4, rel=1e-6)    # it has 8 digits


@pytest.mark.parametrize("change", ["displace_atoms all move 0 0 -0.001", "set atom 2 z 0.00115"])
def test_lists_are_new_in_each_run(lmp, change):
    """Also where another run begins at the same step."""
    def energy(before):
        change_of_two = change if change.startswith("set") else f"group two id 2\n{change.replace('all', 'two')}"
        return lmp(text(run=f"{before}\n{change_of_two}\nrun 0"),
                   data([[0, 0, 0], [0, 0, 0.00215]], R6)).thermo[-1]["c_p"][-1]
    assert energy("run 0") == energy("") > 0


@pytest.mark.parametrize("speed", [-0.1, 0.1])
def test_terms_of_two_images_add_up(lmp, speed):
    """In a box two diameters wide a bubble touches another and its image: one gap closes, the other opens."""
    R = MM
    result = lmp(text(pair="hmin 1e-6"),
                 data([[0, 0, 0], [1.995 * MM, 0, 0]], R, [[0, 0, 0], [speed, 0, 0]],
                      box=[(-R, 2.98 * MM), (-6 * MM, 6 * MM), (-6 * MM, 6 * MM)]))
    frame = result.dump("dump")[0]
    total = sum(term(frame, name) for name in TERMS)
    assert np.abs(frame["fx"]).min() > 1e-5
    assert total[:, 0] == pytest.approx(frame["fx"], rel=1e-10)    # sums of forces that are 10 times as large


# ---- bad input ----------------------------------------------------------------------------------

COMMON = {
    **{f"{word} {bad}": (word, allowed, bad) for word, allowed, bads in [
        ("elastic", "none or spring or quadratic", ["hard"]), ("viscous", "none or published or derived", ["yes"]),
        ("integral", "fit or exact", ["table"]), ("film", "no or yes", ["1"]), ("lubrication", "no or yes", ["on"]),
        ("h0", "contact or current or a number > 0", ["0", "-1", "thin", "nan"]),
        ("hmin", "> 0", ["0", "-1", "x", "inf"]), ("reach", ">= 0", ["-1", "far"])] for bad in bads},
    **{word: (word, "needs a value")
       for word in ("elastic", "viscous", "integral", "film", "lubrication", "h0", "hmin", "reach", "tangential")},
    "colour 1": ("colour", "elastic, viscous, integral, h0, hmin, film, lubrication, reach, tangential"),
}
BAD = {
    "Pair style bubble/collision": (f"{PAIR} {{}}", {
        **COMMON, "tangential yes": ("tangential", "none or all", "yes")}),
    "Pair style bubble/collision:": ("pair_style bubble/collision {}", {
        "": ("SIGMA", "> 0", "missing"), "0": ("SIGMA", "> 0", "0"), "-1": ("SIGMA", "> 0", "-1"),
        "x": ("SIGMA", "> 0", "x"), "0.03": ("MU", ">= 0", "missing"), "0.03 -1": ("MU", ">= 0", "-1")}),
    "Fix wall/bubble": ("fix w all wall/bubble {}", {
        "": ("kind of wall", "plane or region"), "side": ("kind of wall", "plane or region", "side"),
        "plane": ("PX", "a number"), "plane 0 0 0 0 0": ("NZ", "a number"),
        "plane 0 0 a 0 0 1": ("PZ", "a number", "a"),
        "plane 0 0 0 0 0 0": ("NX NY NZ", "must not be 0"), "region": ("region", "the ID of a region"),
        "region none": ("no region none",),
        **{f"plane 0 0 0 0 0 1 {words}": said for words, said in COMMON.items()},
        "plane 0 0 0 0 0 1 tangential all": ("tangential", "no or yes", "all")}),
    "Fix bubble/rise": ("fix r all bubble/rise {}", {
        "": ("RHO_F", "> 0"), "0 1 0 0 1": ("RHO_F", "> 0", "0"), "1 0 0 0 1": ("MU", "> 0", "0"),
        "1 1 0 0": ("gz", "a number"), "1 1 0 up 0": ("gy", "a number", "up"),
        "1 1 0 0 1 added -1": ("added", ">= 0", "-1"), "1 1 0 0 1 drag": ("drag", "needs a value"),
        "1 1 0 0 1 drag yes": ("drag", "none or contaminated or clean", "yes"),
        "1 1 0 0 1 implicit 1": ("implicit", "no or yes", "1"), "1 1 0 0 1 flow 1 2 3": ("flow", "v_NAME", "1"),
        "1 1 0 0 1 flow NULL NULL": ("v_uz", "v_NAME"), "1 1 0 0 1 flow v_none 0 0": ("there is none of this name",),
        "1 1 0 0 1 colour": ("colour", "added, drag, implicit, flow")}),
    "Fix bubble/nve": ("fix s all bubble/nve {}", {
        "tol": ("tol", "needs a value"), "tol 0": ("tol", "> 0", "0"), "dtmax -1": ("dtmax", "> 0", "-1"),
        "1e-3": ("1e-3", "tol, dtmax")}),
    "Compute bubble/collision": ("compute x all bubble/collision {}", {
        "": ("quantity", "elastic_x", "delta"), "colour": ("colour", "buoyancy_z", "ra")}),
}


@pytest.mark.parametrize("style, words", [(style, words) for style in BAD for words in BAD[style][1]])
def test_bad_input(base_lmp, style, words):
    """The message names the style, the argument, what is allowed and what was there."""
    command, cases = BAD[style]
    lines = text(run="").splitlines()
    at = next(n for n, line in enumerate(lines) if line.startswith("compute      c"))
    lines = lines[:at] + [command.format(words), "pair_coeff * *", "run 1"]
    result = base_lmp("\n".join(lines) + "\n", data([0, 0, 0], R6), check=False)
    assert result.returncode > 0 and result.errors, result.screen[-1000:]
    for said in (style[1:], *cases[words]):    # LAMMPS' library tells of a missing variable before we do
        assert said in result.errors[-1], result.errors


MISFITS = {
    "no velocities of ghosts": (("comm_modify  vel yes", ""), "comm_modify vel yes"),
    "units lj": (("units        si", "units        lj"), "hmin"),
    "pair_coeff with numbers": (("pair_coeff * *", "pair_coeff * * 1.0"), "pair_coeff * *"),
    "two liquids": (("fix s all", "fix r all bubble/rise 1 1 0 0 1\nfix q all bubble/rise 1 1 0 0 1\nfix s all"),
                    "one liquid"),
    "wall without the pair style": ((f"{PAIR} \npair_coeff * *", "pair_style zero 1e-3\npair_coeff * *\n"
                                     "fix w all wall/bubble plane 0 0 0 0 0 1"), "pair_style bubble/collision"),
    "respa": (("fix s all", "run_style respa 2 2 pair 1\nfix s all"), "run_style verlet"),
}


@pytest.mark.parametrize("name", MISFITS)
def test_misfits(base_lmp, name):
    (old, new), said = MISFITS[name]
    lines = text().replace(old, new)
    if "without the pair" in name:
        lines = lines[:lines.index("compute      c")] + "run 1\n"
    result = base_lmp(lines, data([0, 0, 0], R6), check=False)
    assert result.returncode > 0 and said in result.errors[0], result.errors


def test_films_need_ids(base_lmp):
    """All partners would be one."""
    lines = f"""
        units si\natom_style sphere\natom_modify id no\ncomm_modify vel yes
        region b block -0.01 0.01 -0.01 0.01 -0.01 0.01\ncreate_box 1 b\ncreate_atoms 1 single 0 0 0
        set group all diameter 0.001\n{PAIR}\npair_coeff * *\nrun 0"""
    result = base_lmp(lines, {}, check=False)
    assert result.returncode > 0 and "needs atom IDs: use atom_modify id yes" in result.errors[0], result.errors
