"""What must not matter: how many ranks, who adds to whom, how the box is cut, turned or described,
which neighbor list, and where a run is interrupted."""

import numpy as np
import pytest

from runner import BACKENDS, PRECISE, bins_only, data_file, on_device, tiled
from foams import SAME, SHORT, SIZE, assert_same_run, assert_same_state, case, foam, state

VARIANTS = {
    "2 ranks": dict(ranks=2),
    "4 ranks": dict(ranks=4),
    "8 ranks": dict(ranks=8),
    "2 ranks along y": dict(ranks=2, before="processors 1 2 1"),
    "4 ranks along x": dict(ranks=4, before="processors 4 1 1"),
    "newton off": dict(before="newton off"),
    "newton off, 2 ranks": dict(ranks=2, before="newton off"),
    "newton off on, 2 ranks": dict(ranks=2, before="newton off on"),
    "tiled": dict(ranks=4, before="comm_style tiled", run="balance 1.0 rcb"),
    "list nsq": dict(neighbor="0.3 nsq"),
    "list multi": dict(neighbor="0.3 multi"),
    "list of LAMMPS": dict(run="group nobody empty\nneigh_modify exclude group nobody nobody"),
    "list of LAMMPS, 2 ranks": dict(ranks=2, run="group nobody empty\n"
                                                 "neigh_modify exclude group nobody nobody"),
    "headroom 1": dict(pair="headroom 1.0"),
    "headroom 3": dict(pair="headroom 3.0"),
    "map hash": dict(map="map hash"),
    "no map, unsorted": dict(map="sort 0 0.0"),
}

STATES = [(2, "static", name) for name in VARIANTS]
STATES += [(3, "static", name) for name in ("8 ranks", "newton off, 2 ranks", "tiled",
                                            "list multi")]
STATES += [(2, "neighbor", name) for name in ("4 ranks", "newton off", "newton off on, 2 ranks")]
STATES += [(3, "neighbor", name) for name in ("2 ranks", "newton off, 2 ranks")]


def variant_of(name, lmp):
    """Options of case(), where this back end can have them."""
    variant = dict(VARIANTS[name])
    bins_only(lmp, variant.get("neighbor", "bin"))
    if variant.get("before") == "comm_style tiled":
        variant["before"] = tiled(lmp)
    if "newton off on" in name and on_device(lmp):
        pytest.skip("neigh full of the KOKKOS package goes with newton off only")
    return variant


# ---- one state ----------------------------------------------------------------------------------

@pytest.mark.parametrize("dim, drag, name", STATES)
def test_one_state(each_lmp, base, dim, name, drag):
    """Forces, velocities, energies and gas rates of a state, whatever evaluates it."""
    variant = variant_of(name, each_lmp)
    x, R, v, box = foam(dim, SIZE[dim])
    plain = base(dim, SIZE[dim], pair=f"drag {drag}")
    variant["pair"] = variant.get("pair", "") + f" drag {drag}"
    variant["run"] = variant.get("run", "") + "\nrun 0"
    ranks = variant.pop("ranks", 1)
    other = each_lmp(case(dim, **variant), files={"data": data_file([box] * dim, x, R, v)},
                     ranks=ranks)
    a, b = state(plain.dump("dump")[0], dim), state(other.dump("dump")[0], dim)
    assert a["c_b[1]"].mean() > 3    # contacts: a dense foam
    assert_same_state(a, b, box, SAME)
    for column in ["PotEng"] + [f"c_p[{k}]" for k in (1, 2, 4)]:
        A, B = plain.thermo[0][column][0], other.thermo[0][column][0]
        assert abs(A - B) < SAME * max(abs(A), plain.thermo[0]["PotEng"][0] / box**dim)
    assert lmp_vector(plain)[3:] == pytest.approx(lmp_vector(other)[3:], rel=SAME)


def lmp_vector(result, row=0):
    return [result.thermo[0][f"f_gas[{k}]"][row] for k in range(1, 9)]


# ---- a run --------------------------------------------------------------------------------------

RUN = dict(gas="0.1 0.1 rmin 0.4", run="run 120", every=20)
RUN_VARIANTS = ["2 ranks", "4 ranks", "8 ranks", "newton off, 2 ranks", "tiled", "list nsq",
                "headroom 1", "no map, unsorted"]


# the skin of a tiled box does not follow the steps
FIXED = dict(step="1e-3 skin fixed")

# steps of rkc are longer: near foams part after fewer of them
INTEGRATORS = {"abm": {}, "rkc": dict(integrator="rkc", run="run 60", every=10)}
RUNS = [("abm", name) for name in RUN_VARIANTS] + [("rkc", name) for name in ("4 ranks", "tiled")]


@pytest.mark.parametrize("integrator, name", RUNS)
def test_run(each_lmp, base, integrator, name):
    """A coarsening run in which bubbles vanish: the same steps, the same bubbles."""
    changed, run = variant_of(name, each_lmp), {**RUN, **INTEGRATORS[integrator]}
    if name == "tiled":
        run |= FIXED
    plain = base(2, 16, **run)
    assert plain.thermo[0]["Atoms"][-1] < plain.thermo[0]["Atoms"][0] - 10
    variant = {**run, **changed, "run": changed.get("run", "") + "\n" + run["run"]}
    ranks = variant.pop("ranks", 1)
    x, R, v, box = foam(2, 16)
    other = each_lmp(case(2, **variant), files={"data": data_file([box] * 2, x, R, v)}, ranks=ranks)
    assert_same_run(plain.thermo[0], other.thermo[0])
    for count in ("f_step[3]", "f_step[4]", "f_step[5]", "f_step[8]"):    # stages of rkc
        assert count not in plain.thermo[0] or np.array_equal(plain.thermo[0][count],
                                                              other.thermo[0][count]), count
    for a, b in zip(plain.dump("dump"), other.dump("dump")):
        assert np.array_equal(a["id"], b["id"])
        assert_same_state(state(a, 2), state(b, 2), box, SHORT)


def test_balance_while_running(lmp, base):
    """The domains move during the run, and with them what the fixes keep of each bubble."""
    x, R, v, box = foam(2, 16)
    other = lmp(case(2, **{**RUN, **FIXED, "before": tiled(lmp),
                           "after": "fix cut all balance 10 1.0 rcb"}),
                files={"data": data_file([box] * 2, x, R, v)}, ranks=3)
    assert_same_run(base(2, 16, **RUN, **FIXED).thermo[0], other.thermo[0])


@pytest.mark.parametrize("neighbor", ["0.15 bin", "0.6 bin", "1.0 nsq", "0.3 multi"])
def test_skin(lmp, base, neighbor):
    """With steps so short that none has to be given up for leaving the list, the skin is free."""
    bins_only(lmp, neighbor)
    keywords = dict(gas="3e-2 0.1", run="run 150", step="1e-3 dtmax 0.04", every=50)
    plain = base(2, SIZE[2], neighbor="0.3 bin", **keywords)
    x, R, v, box = foam(2, SIZE[2])
    other = lmp(case(2, neighbor=neighbor, **keywords),
                files={"data": data_file([box] * 2, x, R, v)})
    assert other.thermo[0]["f_step[4]"][-1] == 0    # no step was given up
    assert_same_run(plain.thermo[0], other.thermo[0])
    for a, b in zip(plain.dump("dump"), other.dump("dump")):
        assert_same_state(state(a, 2), state(b, 2), box, SHORT)


# ---- the box ------------------------------------------------------------------------------------

def compare_boxes(lmp, base, dim, move, turn=lambda vector: vector, shift=0.0, tilt=None,
                  ranks=1, **integrator):
    """Run the foam and a copy of it that `move` has put elsewhere in its box."""
    keywords = {**dict(run="run 60", every=30), **integrator}
    plain = base(dim, SIZE[dim], **keywords)
    x, R, v, box = foam(dim, SIZE[dim])
    data = data_file([box] * dim, move(x, box) % box, R, turn(v))
    if tilt is not None:
        line = " ".join(f"{k * box:.17g}" for k in tilt)
        data = data.replace("zlo zhi\n", f"zlo zhi\n{line} xy xz yz\n", 1)
    other = lmp(case(dim, before="box tilt large", **keywords), files={"data": data}, ranks=ranks)
    assert len(plain.dump("dump")) == 3
    for a, b in zip(plain.dump("dump"), other.dump("dump")):
        offset = shift(box) if callable(shift) else shift
        assert_same_state(state(a, dim), state(b, dim), box, SHORT, turn, offset)
    assert_same_run(plain.thermo[0], other.thermo[0])


def quarter_turn(vector):
    return np.column_stack([-vector[:, 1], vector[:, 0]])


def permuted(vector):
    return vector[:, [2, 0, 1]]


# the first direction of the power iteration of rkc is another one in a foam that is turned
@pytest.mark.parametrize("integrator", [{}, dict(integrator="rkc", step="1e-3 spectral 5",
                                                 run="run 16", every=8)], ids=["abm", "rkc"])
def test_rotated(lmp, base, integrator):
    compare_boxes(lmp, base, 2, lambda x, box: quarter_turn(x) + [box, 0], quarter_turn,
                  **integrator)


def test_permuted_axes(lmp, base):
    compare_boxes(lmp, base, 3, lambda x, box: permuted(x), permuted)


@pytest.mark.parametrize("dim", [2, 3])
def test_translated(lmp, base, dim):
    part = np.array([0.3, 0.7, 0.1])[:dim]
    compare_boxes(lmp, base, dim, lambda x, box: x + part * box, shift=lambda box: part * box)


@pytest.mark.parametrize("dim", [2, 3])
def test_translated_by_a_box_vector(lmp, base, dim):
    """Bubbles given outside the box are those inside it."""
    x, R, v, box = foam(dim, SIZE[dim])
    images = np.random.default_rng(3).integers(-1, 2, x.shape)
    other = lmp(case(dim, run="run 60", every=30),
                files={"data": data_file([box] * dim, x + images * box, R, v)})
    plain = base(dim, SIZE[dim], run="run 60", every=30)
    for a, b in zip(plain.dump("dump"), other.dump("dump")):
        assert_same_state(state(a, dim), state(b, dim), box, SHORT)


@pytest.mark.parametrize("dim, tilt, ranks", [(2, (0, 0, 0), 1), (2, (1, 0, 0), 1),
                                              (2, (1, 0, 0), 2), (3, (-1, 1, 1), 1)])
def test_triclinic(lmp, base, dim, tilt, ranks):
    """A box tilted by whole sides describes the same periodic foam."""
    compare_boxes(lmp, base, dim, lambda x, box: x, tilt=tilt, ranks=ranks)


# ---- interrupted runs ---------------------------------------------------------------------------

FIRST, SECOND = 100, 60

PUSH = """fix push all addforce 0.01 0 0
fix wall all indent 1.0 sphere 8 8 0 3.0"""

PULL = """variable pull equal 0.05*(time-2)
fix pull all addforce v_pull 0 0"""

INTERRUPTED = {
    "static": dict(),
    "neighbor": dict(pair="drag neighbor"),
    "source": dict(step="1e-3 scheme source"),
    "neighbor source": dict(pair="drag neighbor", step="1e-3 scheme source"),
    "neighbor without drift": dict(pair="drag neighbor", step="1e-3 drift remove"),
    "radius, rms, lsw": dict(gas="3e-2 0.3 liquid lsw rmin 0.3",
                             step="1e-3 variable radius norm rms dtmax 0.5"),
    "sorted often": dict(sort="20 0.0"),
    "never sorted": dict(sort="0 0.0"),
    "other forces": dict(extra=PUSH),    # fixes that come after the integrator
    "forces of time": dict(extra=PULL),
    "rkc, forces of time": dict(integrator="rkc", extra=PULL),
    "3D": dict(dim=3),
    "rkc": dict(integrator="rkc"),
    "rkc, skin that follows": dict(integrator="rkc", step="1e-1", gas="1e-2 0.1 rmin 0.3"),
    "rkc, neighbor, other forces": dict(integrator="rkc", pair="drag neighbor", extra=PUSH),
    "neighbor 3D sorted often": dict(dim=3, pair="drag neighbor", sort="20 0.0"),
}


def continued(pair="", gas="3e-2 0.1", integrator="abm", step="1e-3", sort="1000 0.0", dim=2, extra=""):
    return f"""
atom_modify   sort {sort}
read_restart  state
neighbor      0.3 bin
fix           gas all foam/coarsen {gas}
fix           step all foam/{integrator} {step}
compute       b all foam/bubble contacts area free vfilm vliquid rdot espring edurian
compute       p all pressure NULL virial
thermo_style  custom step atoms time pe c_p[*] f_gas[*] f_step[*]
{PRECISE}
thermo        10
dump          d all custom 10 dump2 id x y z vx vy vz fx fy fz radius c_b[*]
dump_modify   d sort id format float %.17g
{extra}
run           {SECOND}
"""


WAYS = [(name, way, ranks) for name in ("static", "neighbor")
        for way in ("restart", "write_restart") for ranks in (1, 2)]
WAYS += [(name, way, ranks) for name in list(INTERRUPTED)[2:]
         for way, ranks in (("restart", 2), ("write_restart", 1))]


@pytest.mark.parametrize("name, way, ranks", WAYS)
def test_restart_is_bitwise(bitwise_lmp, name, way, ranks):
    """A run from a restart file goes on bit by bit like the run that wrote it."""
    how = dict(INTERRUPTED[name])
    dim = how.get("dim", 2)
    x, R, v, box = foam(dim, 10 if dim == 2 else SIZE[3], seed=11)
    keywords = {k: how[k] for k in ("pair", "integrator", "step") if k in how}
    keywords.update(gas=how.get("gas", "3e-2 0.1"), every=10)
    sort = f"atom_modify sort {how.get('sort', '1000 0.0')}\n" + how.get("extra", "")
    if way == "restart":    # in mid-run
        first = case(dim, after=sort + f"\nrestart {FIRST} state.*",
                     run=f"run {FIRST + SECOND}", **keywords)
        second = continued(**how).replace("read_restart  state", f"read_restart  state.{FIRST}")
    else:                   # between two runs
        first = case(dim, after=sort, run=f"run {FIRST}\nwrite_restart state\nrun {SECOND}",
                     **keywords)
        second = continued(**how)
    a = bitwise_lmp(first, files={"data": data_file([box] * dim, x, R, v)}, ranks=ranks)
    b = bitwise_lmp(second, directory=a.directory, ranks=ranks)

    frames = {frame.step: frame for frame in a.dump("dump")}
    again = b.dump("dump2")
    assert [frame.step for frame in again] == list(range(FIRST, FIRST + SECOND + 1, 10))
    if "neighbor" not in name and dim == 2:
        assert len(again[-1]) < len(again[0]) < len(x)    # bubbles vanish before and after
    for frame in again:
        one = frames[frame.step]
        assert np.array_equal(frame["id"], one["id"])
        if way == "write_restart" and frame.step == FIRST:
            # setting up a run puts bubbles into the box and in order: sums over contacts before
            # and after that differ by rounding
            bitwise = ["radius"]
            d = frame.array("x", "y", "z") - one.array("x", "y", "z")
            assert np.abs(d - box * np.round(d / box)).max() < 1e-15 * box
        else:
            bitwise = ["x", "y", "z", "vx", "vy", "vz", "radius", "fx", "fy", "fz"]
            bitwise += [f"c_b[{k}]" for k in range(1, 9)]
        for column in bitwise:
            assert np.array_equal(frame[column], one[column]), (frame.step, column)

    rows = {}
    for table in a.thermo:
        for row, step in enumerate(table["Step"]):
            rows[step] = {column: table[column][row] for column in table}
    table = b.thermo[0]
    extra = table["f_step[5]"][-1] - rows[FIRST + SECOND]["f_step[5]"]
    assert extra in ((0, 1) if way == "restart" else (0,))    # that before the run is one more
    for row, step in enumerate(table["Step"]):
        for column in table:
            if column == "f_step[5]":
                assert table[column][row] == rows[step][column] + extra
            elif column == "f_step[7]":    # of the run; a sum of steps less one
                assert table[column][row] == pytest.approx(
                    table["Time"][row] - table["Time"][0], abs=SAME * table["Time"][row])
            elif step > FIRST:
                assert table[column][row] == rows[step][column], (step, column)
            else:    # added up anew, in another order
                assert table[column][row] == pytest.approx(rows[step][column], rel=SAME), column


@pytest.mark.parametrize("ranks", [1, 2])
def test_restart_where_the_mean_radius_limits_the_step(bitwise_lmp, ranks):
    """A mean is a sum in some order, which is that of bubbles in the file where one is written."""
    x, R, v, box = foam(2, 20, seed=11)
    keywords = dict(integrator="rkc", step="100 dt0 0.4", gas="0.3 0.1 rmin 0.3", every=1)
    a = bitwise_lmp(case(2, after="restart 4 state.*", run="run 8", **keywords),
                    files={"data": data_file([box] * 2, x, R, v)}, ranks=ranks)
    text = continued(integrator="rkc", step="100 dt0 0.4", gas="0.3 0.1 rmin 0.3")
    text = text.replace("read_restart  state", "read_restart  state.4").replace("thermo        10", "thermo 1")
    b = bitwise_lmp(text.replace(f"run           {SECOND}", "run 4"), directory=a.directory, ranks=ranks)
    h = a.thermo[0]["f_step[2]"]
    assert h[8] > 1.1 * h[5]    # as the mean radius grows
    assert np.array_equal(h[5:], b.thermo[0]["f_step[2]"][1:])
    assert np.array_equal(a.thermo[0]["Atoms"][5:], b.thermo[0]["Atoms"][1:])


@pytest.mark.parametrize("name, ranks", [("static", 1), ("static", 2), ("neighbor", 2),
                                         ("source", 1), ("neighbor without drift", 1),
                                         ("rkc", 1)])
def test_run_in_pieces(bitwise_lmp, name, ranks):
    """Two runs are one run.  Setting up a run puts the bubbles in order; that happens in the one
    run too where it writes a restart file, and then both agree bit by bit."""
    keywords = {k: v for k, v in INTERRUPTED[name].items()}
    keywords.update(gas="3e-2 0.1", every=10)
    x, R, v, box = foam(2, 10, seed=11)
    files = {"data": data_file([box] * 2, x, R, v)}
    restarts = f"restart {FIRST} state.*"
    one, two = (bitwise_lmp(case(2, after=restarts, run=run, **keywords), files=files, ranks=ranks)
                for run in (f"run {FIRST + SECOND}", f"run {FIRST}\nrun {SECOND}"))
    a, b = one.dump("dump"), two.dump("dump")
    assert [frame.step for frame in a] == [frame.step for frame in b]
    assert len(a[-1]) <= len(a[0])
    for f, g in zip(a, b):
        for column in ("id", "x", "y", "vx", "vy", "radius", "fx", "fy"):
            assert np.array_equal(f[column], g[column]), (f.step, column)


@pytest.mark.parametrize("split", ["run 60\nrun 60", "run 60 post no\nrun 60 pre no",
                                   "run 120 every 40 NULL",
                                   "run 120 every 30 'print \"a line\"'",
                                   "run 120 upto"])
def test_run_split(lmp, base, split):
    x, R, v, box = foam(2, 16)
    other = lmp(case(2, **{**RUN, "run": split}), files={"data": data_file([box] * 2, x, R, v)})
    a, b = base(2, 16, **RUN).dump("dump"), other.dump("dump")
    ends = {frame.step: frame for frame in b}
    assert_same_state(state(a[-1], 2), state(ends[120], 2), box, SHORT)
    assert other.thermo[-1]["f_gas[7]"][-1] == base(2, 16, **RUN).thermo[0]["f_gas[7]"][-1]


# ---- back ends ----------------------------------------------------------------------------------

@pytest.mark.parametrize("name", [name for name in BACKENDS if name != "wheel"])
@pytest.mark.parametrize("dim, ranks, integrator", [(2, 1, "abm"), (2, 2, "abm"), (3, 1, "abm"),
                                                    (3, 2, "abm"), (3, 2, "rkc")])
def test_backends_agree(backends, base, dim, ranks, integrator, name):
    """The stable release and the newest one, built by different compilers, base and KOKKOS styles
    give the same foam."""
    x, R, v, box = foam(dim, SIZE[dim])
    steps = 60 if integrator == "abm" else 40
    keywords = dict(gas="3e-2 0.1", integrator=integrator, run=f"run {steps}", every=steps // 2)
    other = backends(name)(case(dim, **keywords),
                           files={"data": data_file([box] * dim, x, R, v)}, ranks=ranks)
    plain = base(dim, SIZE[dim], **keywords)
    frames = list(zip(plain.dump("dump"), other.dump("dump")))
    assert len(frames) == 3
    for n, (f, g) in enumerate(frames):
        assert_same_state(state(f, dim), state(g, dim), box, SHORT if n else SAME)
    assert_same_run(plain.thermo[0], other.thermo[0])
