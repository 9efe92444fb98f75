"""create_foam and relax_foam: a foam made directly, and brought to rest at a gas fraction or a pressure."""

import re

import numpy as np
import pytest

from runner import PRECISE

CREATE = """
dimension     {dim}
boundary      {boundary}
atom_style    sphere 1
create_foam   {what}
"""
LOOK = """
write_dump    all custom start id x y z radius mass vx vy vz modify sort id format float %.17g
"""
MECHANICS = """
pair_style    durian/foam 1.0
pair_coeff    * * 1.0
neighbor      0.5 bin
compute       p all pressure NULL virial
thermo        50
thermo_style  custom step time pe c_p vol
""" + PRECISE
RKC = "fix step all foam/rkc 1e-3\n"


def create(lmp, what, dim=2, boundary="p p p", then=LOOK, **keywords):
    return lmp(CREATE.format(dim=dim, boundary=boundary, what=what) + then, **keywords)


def sides(frame, dim):
    return np.array([hi - lo for lo, hi in frame.box])[:dim]


def content(frame, dim):
    return {2: np.pi, 3: 4.0 / 3.0 * np.pi}[dim] * (frame["radius"] ** dim).sum()


# ---- create_foam --------------------------------------------------------------------------------

@pytest.mark.parametrize("dim, n", [(2, 1000), (3, 1001)])
def test_grid_of_the_source(lmp, dim, n):
    """N bubbles near the sites of a grid, as many as a cube has at a spacing of 2 <R>, none further away than half a
    site; IDs are those of the sites."""
    frame = create(lmp, f"{n} 1 sizes normal 3.0 0.63", dim=dim).dump("start")[0]
    assert len(frame) == n and np.array_equal(frame["id"], np.arange(1, n + 1))
    across = np.ceil(n ** (1 / dim))
    sites = np.array([across, across, np.ceil(n / across**2)] if dim == 3 else [across, np.ceil(n / across)])
    assert sides(frame, dim) == pytest.approx(6.0 * np.prod(sites) ** (1 / dim))
    index = np.arange(n) * int(np.prod(sites)) // n    # sites that stay empty are spread evenly
    columns = [index % sites[0], index // sites[0] % sites[1], index // (sites[0] * sites[1])][:dim]
    off = frame.array("x", "y", "z")[:, :dim] / (sides(frame, dim) / sites) - np.column_stack(columns) - 0.5
    off -= np.rint(off / sites) * sites
    far = np.linalg.norm(off, axis=1)    # in sites
    assert far.max() <= 0.5 + 1e-12
    # uniform lengths of up to half a site: mean 1/4, five standard errors
    assert far.mean() == pytest.approx(0.25, abs=5 * 0.5 / np.sqrt(12 * n))
    R = frame["radius"]
    assert R.min() >= 0.3 and R.mean() == pytest.approx(3.0, abs=5 * 0.63 / np.sqrt(n))
    assert R.std() == pytest.approx(0.63, abs=5 * 0.63 / np.sqrt(2 * n))
    assert frame["mass"] == pytest.approx(4 / 3 * np.pi * R**3)
    assert not frame["vx"].any()


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("start", ["grid", "random"])
def test_the_same_on_all_ranks(backends, dim, start):
    what = f"777 5 start {start} sizes lognormal 1.0 0.5 phi 0.8 box {'3 1 2' if dim == 3 else '3 1'}"
    texts = [create(backends(name), what, dim=dim, ranks=ranks).read("start")
             for name, ranks in [("wheel", 1), ("wheel", 2), ("wheel", 4), ("kk1", 1), ("kk1", 2)]]
    for text in texts[1:]:
        assert text == texts[0]


def test_seeds_differ(lmp):
    one, other = (create(lmp, f"100 {seed}").dump("start")[0] for seed in (1, 2))
    assert not np.any(one["radius"] == other["radius"]) and not np.any(one["x"] == other["x"])


@pytest.mark.parametrize("dim, box", [(2, "1 1"), (2, "5 1"), (3, "1 1 1"), (3, "1 2 4")])
@pytest.mark.parametrize("phi", [0.3, 1.3])
def test_gas_fraction_and_shape(lmp, dim, box, phi):
    frame = create(lmp, f"2000 1 phi {phi} box {box}", dim=dim).dump("start")[0]
    assert content(frame, dim) / np.prod(sides(frame, dim)) == pytest.approx(phi, rel=1e-13)
    shape = np.array(box.split(), float)
    assert sides(frame, dim) / shape == pytest.approx(np.full(dim, sides(frame, dim)[0] / shape[0]), rel=1e-13)


def test_random_start_is_uniform(lmp):
    frame = create(lmp, "20000 3 start random box 2 1").dump("start")[0]
    counts, *_ = np.histogram2d(frame["x"], frame["y"], bins=(8, 4), range=frame.box[:2])
    # 31 degrees of freedom: chi^2 beyond 70 in one seed of ten thousand
    assert ((counts - 625.0) ** 2 / 625.0).sum() < 70.0


@pytest.mark.parametrize("start", ["grid", "random"])
def test_between_walls_all_are_inside(lmp, start):
    frame = create(lmp, f"5000 1 start {start}", boundary="f f p").dump("start")[0]
    assert len(frame) == 5000
    for k, axis in enumerate("xy"):
        assert frame.box[k][0] <= frame[axis].min() and frame[axis].max() <= frame.box[k][1]


def test_sizes_of_a_file(lmp):
    files = {"radii": "# measured\n1.5 2.5   # two\n\n0.05\n"}    # they are not lifted to rmin
    each_once = create(lmp, "3 1 sizes file radii", files=files).dump("start")[0]
    assert np.array_equal(each_once["radius"], [1.5, 2.5, 0.05]) and sides(each_once, 2) == pytest.approx([5.4, 5.4])
    drawn = create(lmp, "900 1 sizes file radii", files=files).dump("start")[0]
    values, times = np.unique(drawn["radius"], return_counts=True)
    assert np.array_equal(values, [0.05, 1.5, 2.5])
    assert np.all(np.abs(times - 300) < 5 * np.sqrt(900 * 2 / 9))    # five standard deviations


@pytest.mark.parametrize("n", [1, 2])
def test_hardly_a_foam(lmp, n):
    assert len(create(lmp, f"{n} 1").dump("start")[0]) == n


@pytest.mark.parametrize("what, complaint", [
    ("", "argument N is missing: an integer >= 0"),
    ("0 1", "N must be an integer from 1 to"),
    ("10 -1", "seed must be an integer >= 0, not -1"),
    ("10 1 start corner", "start must be grid or random, not corner"),
    ("10 1 sizes normal 1.0", "argument sizes normal std is missing: a number >= 0"),
    ("10 1 sizes normal -1.0 0.2", "sizes normal mean must be a number > 0, not -1.0"),
    ("10 1 sizes bidisperse 1 1.4 1.5", "sizes bidisperse share must be a number >= 0 and <= 1, not 1.5"),
    ("10 1 sizes file nowhere", "the file nowhere cannot be read"),
    ("10 1 sizes file words", "the file words has many in line 2, where a radius > 0 is wanted"),
    ("10 1 sizes file nothing", "the file nothing has no radius in it"),
    ("10 1 phi nan", "phi must be a number > 0 and < 2, not nan"),
    ("10 1 phi 90", "phi must be a number > 0 and < 2, not 90"),
    ("10 1 rmin 2", "rmin must be a number > 0 and < 1, not 2"),
    ("10 1 types 0", "types must be an integer from 1 to"),
    ("10 1 box 1e12 1", "long in y, less than a bubble"),
    ("10 1 box 1", "argument box y is missing: a number > 0"),
    ("10 1 colour red", "unknown keyword colour (allowed are start, box, sizes, rmin, types, phi)"),
])
def test_bad_input(lmp, what, complaint):
    result = create(lmp, what, files={"words": "1.0\n2.0 many\n", "nothing": "# none\n"}, check=False)
    assert result.returncode != 0
    assert any("Create_foam" in line and complaint in line for line in result.errors), result.errors


def test_tells_the_mean_as_it_is_and_what_was_lifted(lmp):
    result = create(lmp, "1000 1 sizes normal 1.0 0.8")
    R = result.dump("start")[0]["radius"]
    told = re.search(r"mean radius (\S+) \((\d+) are lifted to the smallest, 0.1\)", result.screen)
    assert float(told[1]) == pytest.approx(R.mean(), rel=1e-7) and int(told[2]) == (R == 0.1).sum() > 0


def test_room_for_other_types(lmp):
    create(lmp, "10 1 types 2", then="set atom 3 type 2")


def test_shrink_wrapped_boundaries_are_refused(lmp):
    for then, boundary in (("", "s p p"), ("", "p m p")):
        result = create(lmp, "10 1", boundary=boundary, then=then, check=False)
        assert "boundaries must be p or f" in result.errors[0]


def test_only_once_and_with_radii(lmp):
    twice = create(lmp, "10 1", then="create_foam 10 1", check=False)
    assert "must come before any other box" in twice.errors[0]
    points = lmp("atom_style atomic\ncreate_foam 10 1", check=False)
    assert "Create_foam needs atom_style sphere 1" in points.errors[0]


# ---- relax_foam ---------------------------------------------------------------------------------

def relax(lmp, what, create_what="500 1", method=RKC, dim=2, **keywords):
    then = MECHANICS + method + f"relax_foam {what}\nrun 0" + LOOK
    return create(lmp, create_what, dim=dim, then=then, **keywords)


@pytest.mark.parametrize("dim, phi", [(2, 0.95), (2, 0.5), (3, 0.75)])
def test_relaxes_at_a_gas_fraction(lmp, dim, phi):
    result = relax(lmp, f"phi {phi}", create_what="500 1 box 2 1 1" if dim == 3 else "500 1 box 2 1", dim=dim)
    frame = result.dump("start")[0]
    assert content(frame, dim) / np.prod(sides(frame, dim)) == pytest.approx(phi, rel=1e-13)
    assert sides(frame, dim) == pytest.approx(sides(frame, dim)[1] * np.array([2, 1, 1])[:dim], rel=1e-12)
    last = result.thermo[-1]["PotEng"][-1]
    start = result.thermo[0]["PotEng"][0]
    if dim == 2 and phi < 0.8:    # loose bubbles: no energy is left but what the limit leaves
        assert last < 1e-6 * start


def test_rests_as_told(lmp):
    """The last line of each round has the change of energy that the tables of the runs have, and ends below limit."""
    result = relax(lmp, "phi 0.9 steps 30 limit 2e-4")
    told = [float(x) for x in re.findall(r"round \d+, energy \S+, of it (\S+) in", result.screen)]
    assert told[-1] < 2e-4 and all(x >= 2e-4 for x in told[:-1])
    table = result.thermo[-2]    # before the run of 0 steps
    e, t = table["PotEng"], table["Time"]
    change = 2 * abs(e[-1] - e[0]) / ((e[-1] + e[0]) * (t[-1] - t[0]))
    assert change == pytest.approx(told[-1], rel=1e-2)    # three digits are told
    assert table["Step"][-1] - table["Step"][0] == 30


def test_says_that_there_is_no_rest(lmp):
    result = relax(lmp, "phi 0.9 rounds 2 steps 5 limit 1e-12")
    assert "the energy does not rest after 2 rounds of 5 steps" in result.screen


@pytest.mark.parametrize("dim, pressure", [(2, 0.01), (2, 0.1), (3, 0.01)])
def test_reaches_a_pressure(lmp, dim, pressure):
    result = relax(lmp, f"pressure {pressure} within 1e-2", dim=dim, create_what="300 1")
    assert result.thermo[-1]["c_p"][-1] == pytest.approx(pressure, rel=1e-2)


@pytest.mark.parametrize("step", ["rkc 1e-3", "abm 1e-3"])
def test_pressure_is_that_at_rest(lmp, step):
    """It stays as the foam relaxes on for as long as it has until then: within twice what is allowed."""
    then = MECHANICS + f"fix step all foam/{step}\nrelax_foam pressure 0.005 within 1e-2\nrun 0\nrelax_foam\nrun 0"
    result = create(lmp, "300 1", then=then)
    assert result.thermo[-1]["c_p"][-1] == pytest.approx(0.005, rel=2e-2)


def test_limit_follows_the_units(lmp):
    """Ten times the drag, a tenth of the springs: the default limit is a hundredth, and the foam rests after as many
    rounds at the same energy, but for what rounding errors have grown to."""
    def told(mu0, sigma0):
        text = MECHANICS.replace("durian/foam 1.0", f"durian/foam {mu0}").replace("* * 1.0", f"* * {sigma0}")
        result = create(lmp, "200 1 phi 0.9", then=text + f"timestep {0.01 * mu0 / sigma0}\n" + RKC + "relax_foam")
        rounds = re.findall(r"round (\d+), energy (\S+), of it \S+ in a unit of time, limit (\S+)", result.screen)
        return len(rounds), float(rounds[-1][1]) / sigma0, float(rounds[-1][2])
    plain, slow = told(1.0, 1.0), told(10.0, 0.1)
    assert slow[0] == plain[0] and slow[1] == pytest.approx(plain[1], rel=2e-2) and slow[2] == plain[2] / 100


def test_pressure_from_above_and_below_is_near(lmp):
    """A packing remembers how it was made, but not by much: gas fractions at one pressure within 2 %."""
    found = [content(frame, 2) / np.prod(sides(frame, 2))
             for phi in (0.7, 1.1)
             for frame in relax(lmp, f"phi {phi} pressure 0.03 within 1e-2", create_what="300 1").dump("start")]
    assert found[0] == pytest.approx(found[1], rel=0.02) and found[0] != found[1]


def test_minimizes(lmp):
    """Forces end below ftol, which runs of the same foam do not ask for; no integrator is needed."""
    result = relax(lmp, "phi 0.95 method minimize 0 1e-8 100000 1000000", method="min_style cg\n")
    force = re.findall(r"Force two-norm initial, final = \S+ (\S+)", result.screen)
    assert float(force[-1]) < 1e-8
    frame = result.dump("start")[0]
    assert content(frame, 2) / np.prod(sides(frame, 2)) == pytest.approx(0.95, rel=1e-13)


def test_ranks(lmp):
    """Up to the order of sums the same foam: rounding errors of 1e-15 grow by rearrangements, and 40 steps leave them
    far below 1e-6 of a radius."""
    one, three = (relax(lmp, "phi 0.9 rounds 1 steps 10 limit 1e3", ranks=ranks).dump("start")[0] for ranks in (1, 3))
    d = one.array("x", "y") - three.array("x", "y")
    d -= np.rint(d / sides(one, 2)) * sides(one, 2)
    assert np.abs(d).max() < 1e-6 and sides(one, 2) == pytest.approx(sides(three, 2), rel=1e-13)


def test_between_walls(lmp):
    wall = RKC + "fix walls all foam/wall xlo xhi ylo yhi\n"
    result = relax(lmp, "phi 0.9", method=wall, boundary="f f p", check=False)
    assert "fix_modify walls energy yes virial yes" in result.errors[0]
    wall += "fix_modify walls energy yes virial yes\n"
    result = relax(lmp, "phi 0.9", method=wall, boundary="f f p")
    frame = result.dump("start")[0]
    assert len(frame) == 500
    assert content(frame, 2) / np.prod(sides(frame, 2)) == pytest.approx(0.9, rel=1e-13)


@pytest.mark.parametrize("what, method, complaint", [
    ("phi 0", RKC, "phi must be a number > 0 and < 2, not 0"),
    ("pressure -1", RKC, "pressure must be a number > 0, not -1"),
    ("steps 0", RKC, "steps must be an integer from 1 to"),
    ("method annealing", RKC, "method must be run or minimize, not annealing"),
    ("method minimize 0", RKC, "argument method minimize ftol is missing"),
    ("phi 0.9", "", "Relax_foam with method run needs fix foam/rkc or foam/abm"),
    ("phi 0.9", RKC + "fix gas all foam/coarsen 1e-3 0.1\n", "Relax_foam keeps the radii"),
    ("phi 0.9", RKC + "change_box all triclinic\n", "Relax_foam scales orthogonal boxes only"),
    ("hurry yes", RKC, "unknown keyword hurry"),
    ("pressure 1.0 rounds 1", RKC, "Relax_foam: no pressure of 1 within 0.01 of it after 1 changes of the box"),
    ("pressure 0.01 method minimize 0 1e-8 3 10", "", "minimize ended with forces of"),
    ("phi 0.9", RKC + "timer timeout 0:00:00\n", "stopped by timer timeout before the foam was at rest"),
])
def test_bad_relaxation(lmp, what, method, complaint):
    result = relax(lmp, what, method=method, check=False)
    assert result.returncode != 0 and any(complaint in line for line in result.errors), result.errors


def test_needs_bubbles_and_forces(lmp):
    assert "there is no bubble yet" in lmp("atom_style sphere 1\nrelax_foam", check=False).errors[0]
    assert "needs one pair_style durian/foam" in create(lmp, "10 1", then="relax_foam", check=False).errors[0]


# ---- path ---------------------------------------------------------------------------------------

PATH = CREATE.format(dim=2, boundary="p p p", what="200 1 phi 0.9") + MECHANICS + """
fix           step all foam/{step} path yes
{more}
dump          d all custom 1 dump id xu yu f_step
dump_modify   d sort id format float %.17g
"""


@pytest.mark.parametrize("step", ["abm 1e-4", "rkc 1e-3", "abm 1e-4 scheme source"])
@pytest.mark.parametrize("ranks", [1, 2])
def test_path_is_the_sum_of_steps(lmp, step, ranks):
    """From a start that is not relaxed bubbles move far, also over the boundary and to other ranks."""
    frames = lmp(PATH.format(step=step, more="") + "run 200", ranks=ranks).dump("dump")
    way = np.zeros(200)
    for before, after in zip(frames, frames[1:]):
        way += np.linalg.norm(after.array("xu", "yu") - before.array("xu", "yu"), axis=1)
        assert after["f_step"] == pytest.approx(way, rel=1e-11, abs=1e-13)    # places have 16 digits
    assert way.max() > 1.0


def test_path_of_those_that_are_left(lmp):
    """Removal and migration keep each path with its bubble."""
    more = "fix gas all foam/coarsen 0.05 0.1 nmin 100"
    frames = lmp(PATH.format(step="rkc 1e-3", more=more) + "run 5000").dump("dump")
    assert 90 < len(frames[-1]) <= 100    # several may go in one step
    way, last = dict.fromkeys(frames[0]["id"], 0.0), {}
    for frame in frames:
        for number, x, y in zip(frame["id"], frame["xu"], frame["yu"]):
            if number in last:
                way[number] += np.hypot(x - last[number][0], y - last[number][1])
            last[number] = (x, y)
    assert frames[-1]["f_step"] == pytest.approx([way[i] for i in frames[-1]["id"]], rel=1e-10)


def test_path_goes_on_after_a_restart(bitwise_lmp):
    whole = bitwise_lmp(PATH.format(step="rkc 1e-3", more="restart 50 half") + "run 100")
    again = bitwise_lmp(f"read_restart half.50\n{MECHANICS}fix step all foam/rkc 1e-3 path yes\n"
                        "dump d all custom 1 again id xu yu f_step\ndump_modify d sort id format float %.17g\n"
                        "run 50", directory=whole.directory)
    assert np.array_equal(again.dump("again")[-1]["f_step"], whole.dump("dump")[-1]["f_step"])


def test_no_path_unless_asked_for(lmp):
    result = lmp(PATH.format(step="rkc 1e-3", more="").replace("path yes", "path no") + "run 1", check=False)
    assert result.returncode != 0 and "step" in result.errors[0] and "per-atom" in result.errors[0], result.errors
