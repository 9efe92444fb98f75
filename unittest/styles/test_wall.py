"""Walls at faces of the box, fix foam/wall: closed forms for one bubble, foams between walls."""

import re

import numpy as np
import pytest

from foams import SAME, SHORT, assert_same_run, assert_same_state, case, foam, state
from runner import HEAD, PRECISE, data_file

RIN, SIGMA0 = 0.8, 1.7
STIFF = SIGMA0 * RIN
LAWS = {    # words; range in radii; F and U of a bubble with delta = overlap / R, and of its radius
    "spring": (1.0, lambda d, R: STIFF * d, lambda d, R: STIFF * R * d**2 / 2),
    "power 2.5": (1.0, lambda d, R: STIFF * d**1.5, lambda d, R: STIFF * R * d**2.5 / 2.5),
    "surface 0.7": (1.0, lambda d, R: 0.7 * R * (18.5 * d**2 + 2 * d),
                    lambda d, R: 0.7 * R**2 * (18.5 * d**3 / 3 + d**2)),
    "sticky 0.2": (1.4, lambda d, R: STIFF * d if d > -0.2 else -STIFF * (d + 0.4),
                   lambda d, R: STIFF * R * (d**2 / 2 - 0.04) if d > -0.2 else -STIFF * R * (d + 0.4)**2 / 2),
}
FACES = ["xlo", "xhi", "ylo", "yhi", "zlo", "zhi"]


def boundary(*faces, dim=2):
    """The line for a box with walls at these faces and the ones opposite."""
    return "boundary      " + " ".join("f" if any(face[0] == axis for face in faces) else "p" for axis in "xyz")


def one(faces, dim, law="spring", more="", what="run 0", integrator="abm 1e-6", neighbor="0.3"):
    """Input for few bubbles at walls in a box of 10."""
    head = HEAD.format(dim=dim).replace("boundary      p p p", boundary(*faces.split()))
    return head + f"""
read_data     data
neighbor      {neighbor} bin
pair_style    durian/foam 2.0 rin {RIN} law {law}
pair_coeff    * * {SIGMA0}
fix           step all foam/{integrator}
fix           w all foam/wall {faces}
fix_modify    w energy yes virial yes
{more}
compute       p all pressure NULL virial
compute       s all stress/atom NULL virial
compute       b all foam/bubble contacts area free
thermo_style  custom step time pe vol f_w f_w[*] c_p[*]
{PRECISE}
dump          d all custom 1 dump id x y z vx vy vz fx fy fz radius c_s[*] c_b[*]
dump_modify   d sort id format float %.17g time yes
{what}
"""


# ---- one bubble ---------------------------------------------------------------------------------

@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("face", ["xlo", "yhi", "zlo"])
@pytest.mark.parametrize("dim", [2, 3])
def test_closed_form(lmp, law, face, dim):
    """Force, energy, virial, and what the fix tells, of bubbles in a row, at different distances from a wall. Rounding
    of a few operations: 1e-13 of numbers of order 1."""
    if dim == 2 and (law.startswith("surface") or face[0] == "z"):
        pytest.skip("not in 2D")
    k = FACES.index(face) // 2
    s = np.array([0.01, 0.4, 0.999, 1.1, 1.3, 1.5, 1.0])    # in radii
    R = np.array([1.3, 0.9, 1.0, 1.2, 0.7, 1.1, 0.5])
    x = np.full((len(s), dim), 25.0)
    x[:, (k + 1) % dim] = 4.0 + 4.0 * np.arange(len(s))
    x[:, k] = 40 - s * R if face.endswith("hi") else s * R
    result = lmp(one(face, dim, law), files={"data": data_file([40] * dim, x, R)})
    reach, force, energy = LAWS[law]
    F, U = (np.array([f(1 - a, b) if a < reach else 0.0 for a, b in zip(s, R)]) for f in (force, energy))
    push = np.zeros((len(s), 3))
    push[:, k] = -F if face.endswith("hi") else F
    frame, table = result.dump("dump")[0], result.thermo[0]
    near = dict(rel=1e-13, abs=1e-13)
    assert frame.array("fx", "fy", "fz") == pytest.approx(push, **near)
    assert frame.array("vx", "vy", "vz") == pytest.approx(push / 2.0, **near)
    assert [table[f"f_w[{c}]"][0] for c in (1, 2, 3)] == pytest.approx(-push.sum(0), **near)
    assert table["f_w[4]"][0] == (s < 1).sum()
    assert table["f_w"][0] == pytest.approx(U.sum(), **near) and table["PotEng"][0] == pytest.approx(U.sum(), **near)
    for axis in range(dim):
        virial = F * s * R if axis == k else 0.0 * s
        assert table[f"c_p[{axis + 1}]"][0] * table["Volume"][0] == pytest.approx(virial.sum(), rel=1e-12, abs=1e-12)
        assert frame[f"c_s[{axis + 1}]"] == pytest.approx(-virial, **near)


@pytest.mark.parametrize("dim", [2, 3])
def test_edges_and_corners(lmp, dim):
    """Walls add up; a bubble at several counts once."""
    faces = "xlo yhi zhi" if dim == 3 else "xlo yhi"
    x = np.array([0.3, 10 - 0.6, 10 - 0.9])[:dim]
    result = lmp(one(faces, dim), files={"data": data_file([10] * dim, [x], [1.0])})
    F = STIFF * np.array([0.7, -0.4, -0.1])[:dim]
    table = result.thermo[0]
    assert result.dump("dump")[0].array("fx", "fy", "fz")[0, :dim] == pytest.approx(F, rel=1e-13)
    assert table["f_w[4]"][0] == 1
    assert table["f_w"][0] == pytest.approx((F**2).sum() / (2 * STIFF), rel=1e-13)
    for k, s in enumerate([0.3, 0.6, 0.9][:dim]):
        assert table[f"c_p[{k + 1}]"][0] * table["Volume"][0] == pytest.approx(abs(F[k]) * s, rel=1e-13)


@pytest.mark.parametrize("dim", [2, 3])
def test_wider_than_the_box(lmp, dim):
    """A bubble touches both walls: the sum of both."""
    x, R = np.full(dim, 4.0), 7.0
    result = lmp(one("ylo yhi", dim).replace("boundary      p f p", f"boundary      f f {'pf'[dim - 2]}"),
                 files={"data": data_file([10] * dim, [x], [R])})
    F = STIFF * np.array([1 - 4 / R, 1 - 6 / R])
    table = result.thermo[0]
    assert result.dump("dump")[0]["fy"] == pytest.approx([F[0] - F[1]], rel=1e-13)
    assert table["f_w[4]"][0] == 1 and table["f_w[2]"][0] == pytest.approx(F[1] - F[0], rel=1e-13)
    assert table["c_p[2]"][0] * table["Volume"][0] == pytest.approx(4 * F[0] + 6 * F[1], rel=1e-13)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("integrator", ["abm 1e-5", "rkc 1e-5"])
def test_centre_behind_the_wall(lmp, law, integrator):
    """A force beyond that at s = 0 pushes a centre through the wall, to where the law balances it: by the same
    formula. (LAMMPS loses a bubble out of the box at the next list build, so none is due.) The distance comes to rest
    within the tolerance of steps; 400 relaxation times."""
    reach, force, _ = LAWS[law]
    R, s = 1.3, -0.4 * 1.3
    push = force(1.4, R)
    result = lmp(one("ylo", 3, law, f"fix push all addforce 0 {-push} 0\nneigh_modify delay 10000", "run 400",
                     integrator=integrator, neighbor="4.0"),
                 files={"data": data_file([10] * 3, [[5, 0.8, 5]], [R])})
    last = result.dump("dump")[-1]
    assert last["y"] == pytest.approx([s], abs=1e-3)
    assert result.thermo[0]["f_w[2]"][-1] == pytest.approx(-force(1 - last["y"][0] / R, R), rel=1e-13)


def test_only_its_group(lmp):
    """Neither force, nor drag, nor cover for others."""
    x = [[3.0, 0.5], [7.0, 0.5]]
    text = one("ylo", 2, more="fix push all addforce 0.3 0 0").replace(
        "fix           w all foam/wall ylo", "group left id 1\nfix w left foam/wall ylo drag 1 cover yes")
    result = lmp(text, files={"data": data_file([10, 10], x, [1.0, 1.0])})
    frame = result.dump("dump")[0]
    assert frame["fy"] == pytest.approx([STIFF / 2, 0], rel=1e-13)
    assert frame["vx"] == pytest.approx([0, 0.15], rel=1e-13)
    assert frame["c_b[3]"] == pytest.approx([2 * np.pi - np.sqrt(3), 2 * np.pi], rel=1e-13)
    assert result.thermo[0]["f_w[4]"][0] == 1


def test_moves_with_the_box(lmp):
    """fix deform brings the wall along. (It moves the box after the forces of a step: those of the second run are those
    of the box that the dump shows.)"""
    more = "fix squeeze all deform 1 y final 0 9 remap none"
    result = lmp(one("yhi", 2, more=more, what="run 50\nunfix squeeze\nrun 1"),
                 files={"data": data_file([10, 10], [[5.0, 8.7]], [1.0])})
    frame = result.dump("dump")[-1]
    assert frame.box[1][1] == pytest.approx(9)
    s = 9 - frame["y"][0]
    assert 0.1 < s < 0.9 and frame["fy"] == pytest.approx([-STIFF * (1 - s)], rel=1e-12)


# ---- drag ---------------------------------------------------------------------------------------

@pytest.mark.parametrize("drag", [0, 0.25, 1])
@pytest.mark.parametrize("integrator", ["abm 1e-6", "rkc 1e-6"])
def test_drag_along_a_wall(lmp, drag, integrator):
    """fix addforce pushes a bubble along the wall that it touches, and one that touches none. What is normal to the
    wall is free: there the bubble comes to rest where the wall holds it."""
    F = 0.3
    more = f"fix push all addforce {F} -0.5 0\n"
    result = lmp(one(f"ylo drag {drag}", 2, more=more, what="run 30", integrator=integrator),
                 files={"data": data_file([10, 10], [[2.0, 0.9], [2.0, 7.0]], [1.0, 1.0])})
    a, b = result.dump("dump")[0], result.dump("dump")[-1]
    assert b["vx"] == pytest.approx([(1 - drag) * F / 2, F / 2], rel=1e-12, abs=1e-15)
    assert (b["x"] - a["x"])[0] == pytest.approx((1 - drag) * F / 2 * b.time, rel=1e-11, abs=1e-15)
    assert b["vy"][0] == pytest.approx((STIFF * (1 - b["y"][0]) - 0.5) / 2, rel=1e-10, abs=1e-12)


def test_drag_at_an_edge(lmp):
    """Components along both walls are held by both, others by the wall that they go along."""
    x = [[5.0, 0.9, 9.5]]
    walls = "ylo drag 0.25\nfix v all foam/wall zhi drag 0.5"
    text = one("ylo", 3).replace("foam/wall ylo", f"foam/wall {walls}").replace("p f p", "p f f")
    text = text.replace("compute       p", "fix push all addforce 0.3 0.4 0.5\ncompute p")
    frame = lmp(text, files={"data": data_file([10] * 3, x, [1.0])}).dump("dump")[0]
    v = [0.3 * 0.75 * 0.5, (0.4 + STIFF * 0.1) * 0.5, (0.5 - STIFF * 0.5) * 0.75]
    assert frame.array("vx", "vy", "vz")[0] == pytest.approx(np.array(v) / 2.0, rel=1e-13)


def test_no_contact_of_neighbor_drag(lmp):
    """A wall is no bubble in contact: what touches it alone has no neighbours."""
    text = one("ylo", 2).replace("law spring", "drag neighbor")
    frame = lmp(text, files={"data": data_file([10, 10], [[5.0, 0.5]], [1.0])}).dump("dump")[0]
    assert frame["c_b[1]"] == [0] and frame["vy"] == pytest.approx([STIFF / 4], rel=1e-13)


# ---- foams --------------------------------------------------------------------------------------

def run(lmp, dim=2, wall="ylo yhi", ranks=1, after="", seed=7, **keywords):
    x, R, v, box = foam(dim, 12 if dim == 2 else 5, seed)
    keywords = dict(gas="0.1 0.3 rmin 0.4", run="run 60", before=boundary(*wall.split())) | keywords
    wall = f"fix w all foam/wall {wall}\nfix_modify w energy yes virial yes\n{after}\nthermo_style custom step atoms " \
           f"time pe press f_w f_w[*] c_p[*] f_gas[*] f_step[*]\n{PRECISE}"
    return lmp(case(dim, after=wall, **keywords), files={"data": data_file([box] * dim, x, R, v)}, ranks=ranks)


@pytest.mark.parametrize("law", ["spring", "sticky 0.1"])
def test_force_on_a_wall_is_the_pressure(lmp, law):
    """Two walls, two fixes. In any state, virial = sum y f_y + (force on the upper wall) L_y with the lower wall at 0:
    rounding of sums over some 500 contacts. So at rest P_yy = force / length. A minimizer, which compares energies,
    comes as close to rest as the root of their rounding, 1e-8; the overdamped motion then goes on."""
    x, R, v, box = foam(2, 12)
    after = ("fix lo all foam/wall ylo\nfix hi all foam/wall yhi\nfix_modify lo energy yes virial yes\n"
             "fix_modify hi energy yes virial yes\n"
             "variable yf atom y*fy\ncompute yf all reduce sum v_yf\n"
             f"thermo_style custom step f_lo[2] f_hi[2] c_p[2] vol c_yf fmax\n{PRECISE}")
    text = case(2, before=boundary("y"), after=after, pair=f"law {law}", integrator="rkc", gas="0 0",
                run="minimize 0 1e-10 4000 40000\nrun 300", every=1000)
    result = lmp(text, files={"data": data_file([box] * 2, x, R, v)})
    for table in result.thermo:
        assert table["c_p[2]"] * table["Volume"] == pytest.approx(table["c_yf"] + table["f_hi[2]"] * box, rel=1e-11)
    assert table["Fmax"][-1] < 1e-10
    assert table["f_hi[2]"][-1] > 0.01 * box
    assert table["f_hi[2]"][-1] / box == pytest.approx(table["c_p[2]"][-1], rel=1e-8)
    assert -table["f_lo[2]"][-1] == pytest.approx(table["f_hi[2]"][-1], rel=1e-8)


@pytest.mark.parametrize("integrator", ["abm", "rkc"])
def test_a_foam_rises_and_packs(lmp, integrator):
    """Massless bubbles in a dilute box under their buoyancy, B per area (fix addforce): at rest the wall above bears
    that of all of them, and the foam below it is the denser the higher."""
    rng, n, box, B = np.random.default_rng(3), 150, (16.0, 60.0), 0.004
    x = np.column_stack([rng.uniform(0, box[0], n), rng.uniform(2, box[1] - 2, n)])
    R = rng.normal(1.0, 0.15, n).clip(0.6, 1.4)
    text = HEAD.format(dim=2).replace("boundary      p p p", boundary("yhi")) + f"""
read_data     data
neighbor      0.3 bin
pair_style    durian/foam 1.0 rin 1.0
pair_coeff    * * 1.0
fix           step all foam/{integrator} 1e-3
fix           w all foam/wall ylo yhi
variable      lift atom {B}*PI*radius^2
fix           up all addforce 0.0 v_lift 0.0
thermo_style  custom step time f_w[*] fmax
thermo        10
{PRECISE}
variable      t equal f_step[1]
fix           end all halt 10 v_t >= 30000 error continue
run           30000
write_dump    all custom last id x y z radius modify sort id format float %.17g
"""
    result = lmp(text, files={"data": data_file(box, x, R)})
    table, frame = result.thermo[-1], result.dump("last")[0]
    lift = B * np.pi * (R**2).sum()
    assert table["f_w[2]"][-1] == pytest.approx(lift, rel=3e-4)    # rkc 2e-9; abm at its edge of stability 8e-5
    area, y = np.pi * frame["radius"]**2, frame["y"]
    assert y.min() > box[1] / 3    # all have risen

    def gas_between(low, high):
        return area[(y >= low) & (y < high)].sum() / (box[0] * (high - low))

    top = box[1]
    assert gas_between(top - 8, top) > gas_between(top - 24, top - 16) > 0.7    # packed, and pressed together above


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("integrator, drag", [("abm", "static"), ("rkc", "static"), ("abm", "neighbor")])
def test_coarsens(kk_lmp, backends, dim, integrator, drag):
    """Base and KOKKOS styles, one rank and two: the same foam; gas stays, bubbles vanish, none leaves."""
    how = dict(integrator=integrator, pair=f"drag {drag}", gas="0.3 0.3 rmin 0.5", wall="ylo yhi drag 0.3 cover yes",
               run="run 40" if integrator == "abm" else "run 12")    # of long steps: near foams part sooner
    plain, other = run(backends("wheel"), dim, **how), run(kk_lmp, dim, ranks=2, **how)
    assert_same_run(plain.thermo[0], other.thermo[0])
    for a, b in zip(plain.dump("dump"), other.dump("dump")):
        assert_same_state(state(a, dim), state(b, dim), foam(dim, 12 if dim == 2 else 5)[3], SHORT)
    phi = plain.thermo[0]["f_gas[5]"]
    assert phi == pytest.approx(phi[0], rel=1e-12)
    assert integrator == "rkc" or plain.thermo[0]["f_gas[7]"][-1] > 0
    assert np.all(plain.thermo[0]["f_w[4]"] > 5)


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("ranks", [1, 2])
def test_cover(lmp, dim, ranks):
    """The covered disc is off the free area; contacts, films and the sum of the gas know nothing of it."""
    plain, covered = (run(lmp, dim, f"ylo xhi{words}", ranks, gas="0.1 0.3 rmin 0.0", run="run 0")
                      for words in ("", " cover yes"))
    a, b = plain.dump("dump")[0], covered.dump("dump")[0]
    box = foam(dim, 12 if dim == 2 else 5)[3]
    assert b["c_b[2]"] == pytest.approx(a["c_b[2]"], rel=SAME)
    assert b["c_b[4]"] == pytest.approx(a["c_b[4]"], rel=SAME, abs=SAME)
    surface = 2 * np.pi * a["radius"] if dim == 2 else 4 * np.pi * a["radius"]**2
    off = 0
    for s in (a["y"], box - a["x"]):
        h2 = np.clip(a["radius"]**2 - s**2, 0, None)
        off += 2 * np.sqrt(h2) if dim == 2 else np.pi * h2
    assert (off > 0).sum() > 10
    free = np.clip(surface - a["c_b[2]"] - off, 0, None)
    assert b["c_b[3]"] == pytest.approx(free, rel=SAME, abs=SAME)
    assert b["c_b[5]"].sum() == pytest.approx(0, abs=1e-12 * np.abs(b["c_b[5]"]).sum())
    rho = free.sum() / (free / b["radius"]).sum()
    assert covered.thermo[0]["f_gas[6]"][0] == pytest.approx(rho, rel=1e-12)
    mean = surface.mean()
    ain = covered.thermo[0]["f_gas[10]"][0]
    V = 0.3 * 0.1 * ain / mean * free * (1 / rho - 1 / b["radius"])
    assert b["c_b[5]"] == pytest.approx(V, rel=1e-10, abs=1e-12)


def test_cover_shows_without_exchange(lmp):
    """compute foam/bubble: without fix foam/coarsen, too."""
    frame = lmp(one("ylo cover yes", 2), files={"data": data_file([10, 10], [[5.0, 0.6]], [1.0])}).dump("dump")[0]
    assert frame["c_b[2]"] == [0] and frame["c_b[3]"] == pytest.approx([2 * np.pi - 1.6], rel=1e-13)


@pytest.mark.parametrize("dim", [2, 3])
def test_minimize(lmp, dim):
    """With fix_modify energy yes the minimizer sees what the walls do: the energy falls, forces vanish."""
    result = run(lmp, dim, gas="0 0", run="minimize 0.0 0.0 400 4000")
    energy, frames = result.thermo[0]["PotEng"], result.dump("dump")
    f = [np.sqrt((frame.array("fx", "fy", "fz")**2).mean()) for frame in (frames[0], frames[-1])]
    assert np.all(np.diff(energy) <= 0) and f[1] < 0.01 * f[0]
    for frame in frames:
        assert frame["y"].min() > 0 and frame["y"].max() < foam(dim, 12 if dim == 2 else 5)[3]


@pytest.mark.parametrize("integrator", ["abm", "rkc"])
def test_relaxes(lmp, integrator):
    """Overdamped motion: the energy falls to rest."""
    result = run(lmp, gas="0 0", run="run 400", integrator=integrator)
    energy, frames = result.thermo[0]["PotEng"], result.dump("dump")
    f = [np.sqrt((frame.array("fx", "fy", "fz")**2).mean()) for frame in (frames[0], frames[-1])]
    assert np.all(np.diff(energy) <= 1e-3 * energy[:-1]) and f[1] < 0.05 * f[0]


def test_a_wall_is_no_change_for_rkc(lmp):
    """Its forces depend on the state alone: no evaluation to renew the rates of the start, as for other fixes."""
    runs = [run(lmp, gas="0 0", run="run 20", integrator="rkc",
                after=after) for after in ("", "fix none all addforce 0 0 0")]
    counts = [result.thermo[0]["f_step[5]"][-1] for result in runs]
    assert counts[0] < counts[1]


def test_restart(lmp):
    """The wall is given again, and the run goes on. (Energies are summed over lists of another order.)"""
    whole = run(lmp, run="restart 30 state\nrun 60", wall="ylo yhi drag 0.5 cover yes", every=30)
    again = lmp(f"""
read_restart  state.30
neighbor      0.3 bin
fix           gas all foam/coarsen 0.1 0.3 rmin 0.4
fix           step all foam/abm 1e-3
fix           w all foam/wall ylo yhi drag 0.5 cover yes
fix_modify    w energy yes
thermo_style  custom step atoms time pe f_w f_w[*] f_gas[*]
{PRECISE}
run           30
""", directory=whole.directory)
    for name, column in again.thermo[0].items():
        assert column[-1] == pytest.approx(whole.thermo[0][name][-1], rel=SAME, abs=SAME), name


def test_taken_away(lmp):
    """unfix takes it away at once, with what it holds and covers; another one may take its place."""
    files = {"data": data_file([10, 10], [[5.0, 0.5]], [1.0])}
    text = one("ylo drag 1 cover yes", 2, more="fix push all addforce 0.3 0 0",
               what="run 0\nunfix w\nthermo_style custom step pe c_p[*]\nrun 1\nfix w all foam/wall ylo drag 1\n"
                    "fix w all foam/wall ylo drag 0.5\nrun 1")
    frames = lmp(text, files=files).dump("dump")
    assert [frame["fy"][0] != 0 for frame in frames] == [True, False, True]
    assert [frame["vx"][0] for frame in frames] == pytest.approx([0, 0.15, 0.075], rel=1e-13)
    assert [frame["c_b[3]"][0] for frame in frames] == pytest.approx([2 * np.pi - np.sqrt(3), 2 * np.pi, 2 * np.pi],
                                                                      rel=1e-13)


# ---- what is refused ----------------------------------------------------------------------------

REFUSED = {
    "": "argument face is missing: xlo or xhi or ylo",
    "left": "face must be xlo or xhi or ylo or yhi or zlo or zhi, not left",
    "drag 0.5": "face must be .*, not drag",
    "ylo yhj": "face must be .*, not yhj",
    "ylo ylo": "face ylo is given twice",
    "xlo": "face xlo is no place for a wall: its boundary must be f, not p",
    "zlo": "face zlo is none of a box of dimension 2",
    "ylo drag": "keyword drag needs a value: a number >= 0 and <= 1",
    "ylo drag -0.1": "drag must be a number >= 0 and <= 1, not -0.1",
    "ylo drag 1.01": "drag must be a number >= 0 and <= 1, not 1.01",
    "ylo drag nan": "drag must be a number >= 0 and <= 1, not nan",
    "ylo cover": "keyword cover needs a value: no or yes",
    "ylo cover on": "cover must be no or yes, not on",
    "ylo drag 0.5 yhi": "unknown keyword yhi .allowed are drag, cover",
    "ylo\nfix v all foam/wall yhi ylo": "fixes w and v both have face ylo",
}


@pytest.mark.parametrize("words", REFUSED)
def test_refused(lmp, words):
    text = one("ylo", 2).replace("foam/wall ylo", f"foam/wall {words}")
    result = lmp(text, files={"data": data_file([10, 10], [[5, 5]], [1.0])}, check=False)
    assert result.returncode and re.search("Fix foam/wall.*" + REFUSED[words], result.errors[0]), result.errors


@pytest.mark.parametrize("old, new, what", [
    ("boundary      p f p", "boundary      p s p", "face ylo .* boundary must be f, not s"),
    ("boundary      p f p", "boundary      p m p", "face ylo .* boundary must be f, not m"),
    ("neighbor", "change_box all triclinic\nneighbor", "orthogonal box"),
    ("run 0", "run 0\nchange_box all boundary p p p\nrun 0", "face ylo .* boundary must be f, not p"),
    ("run 0", "run 0\nunfix step\npair_style zero 2\npair_coeff * *\nrun 0", "needs one pair_style durian/foam"),
])
def test_boxes_and_pairs_refused(lmp, old, new, what):
    text = one("ylo", 2).replace(old, new)
    if "unfix step" in new:
        text = re.sub("^(compute|dump).*", "", text, flags=re.M).replace("c_p[*]", "")
    result = lmp(text, files={"data": data_file([10, 10], [[5, 5]], [1.0])}, check=False)
    assert result.returncode and re.search("Fix foam/wall.*" + what, result.errors[0]), result.errors
