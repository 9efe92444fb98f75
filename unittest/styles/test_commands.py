"""The styles among LAMMPS' other commands: what works does what it says."""

import re

import numpy as np
import pytest

from runner import HEAD, PRECISE, bins_only, data_file, tiled

BASIC = f"""
compute       p all pressure NULL virial
thermo_style  custom step atoms time pe vol c_p c_p[1] c_p[4] f_step[*]
{PRECISE}
"""

GAS = BASIC.replace("f_step", "f_gas[*] f_step")


def packing(dim=2, n=10, seed=5):
    random = np.random.default_rng(seed)
    a = 1.6 if dim == 2 else 1.5
    sites = np.stack(np.meshgrid(*[np.arange(n)] * dim, indexing="ij"), -1).reshape(-1, dim)
    x = (a * (sites + 0.5) + a * random.uniform(-0.5, 0.5, sites.shape)) % (n * a)
    return x, np.clip(random.normal(1.0, 0.21, len(x)), 0.2, None), n * a


def data(dim=2, n=10, seed=5):
    x, R, box = packing(dim, n, seed)
    return {"data": data_file([box] * dim, x, R)}


def foam(body, gas="1e-2 0.1", step="1e-3", pair="", dim=2, output=None, thermo=20,
         neighbor="0.3 bin", dump=""):
    output = output or (GAS if gas else BASIC)
    gas = f"fix gas all foam/coarsen {gas}" if gas else ""
    if dump:
        dump = f"dump d all custom {dump} dump id x y z vx vy vz radius\n" \
               "dump_modify d sort id format float %.17g"
    return HEAD.format(dim=dim) + f"""
read_data     data
neighbor      {neighbor}
pair_style    durian/foam 1.0 {pair}
pair_coeff    * * 1.0
{gas}
fix           step all foam/abm {step}
{output}
thermo        {thermo}
{dump}
{body}
"""


def printed(result, name):
    """Numbers printed on the screen after a name."""
    return [float(word) for word in re.search(rf"^{name} (.*)$", result.screen, re.M)[1].split()]


# ---- energy, pressure, minimize -----------------------------------------------------------------

@pytest.mark.parametrize("dim, ranks", [(2, 1), (2, 2), (3, 2)])
def test_force_is_gradient_of_energy(lmp, dim, ranks):
    """Moving one bubble by e along an axis changes the energy by -F e; central differences are
    wrong by e^2 (1e-10 of forces of order 1) and by rounding 1e-14 / e."""
    e = 1e-5
    steps = "\n".join(
        f"displace_atoms one move {' '.join(str(d * (k == axis)) for k in range(3))}\nrun 0\n"
        f"print '{name}{axis} $(pe:%.17g)'"
        for axis in range(dim) for name, d in (("up", e), ("down", -2 * e), ("back", e)))
    body = "group one id 37\nvariable x equal fx[37]\nvariable y equal fy[37]\n" \
           "variable z equal fz[37]\nrun 0\n" \
           "print 'force $(v_x:%.17g) $(v_y:%.17g) $(v_z:%.17g)'\n" + steps
    n = 10 if dim == 2 else 5
    result = lmp(foam(body, gas="", dim=dim), files=data(dim, n), ranks=ranks)
    force = printed(result, "force")[:dim]
    assert np.abs(force).max() > 0.1
    for axis in range(dim):
        slope = (printed(result, f"up{axis}")[0] - printed(result, f"down{axis}")[0]) / (2 * e)
        assert -slope == pytest.approx(force[axis], abs=1e-8)


@pytest.mark.parametrize("dim, ranks", [(2, 1), (3, 2)])
def test_pressure_is_change_of_energy(lmp, dim, ranks):
    """At fixed radii, p = -dE/dV for an even expansion and p_xy = -(dE/dgamma)/V for a shear, both
    affine; central differences as above."""
    e = 1e-5
    x, R, box = packing(dim, 10 if dim == 2 else 5)
    axes = "xyz"[:dim]

    def scale(s):
        return "change_box all " + " ".join(f"{k} scale {s:.17g}" for k in axes) + " remap\nrun 0\n"

    body = "run 0\nprint 'rest $(pe:%.17g) $(vol:%.17g) $(c_p:%.17g) $(c_p[4]:%.17g)'\n" + \
        scale(1 + e) + "print 'large $(pe:%.17g) $(vol:%.17g)'\n" + \
        scale((1 - e) / (1 + e)) + "print 'small $(pe:%.17g) $(vol:%.17g)'\n" + \
        scale(1 / (1 - e)) + "change_box all triclinic\n" + \
        f"change_box all xy delta {e * box:.17g} remap\nrun 0\nprint 'right $(pe:%.17g)'\n" + \
        f"change_box all xy delta {-2 * e * box:.17g} remap\nrun 0\nprint 'left $(pe:%.17g)'\n"
    result = lmp(foam(body, gas="", dim=dim), ranks=ranks,
                 files={"data": data_file([box] * dim, x, R)})
    energy, volume, p, pxy = printed(result, "rest")
    (E1, V1), (E2, V2) = printed(result, "large"), printed(result, "small")
    assert p == pytest.approx(-(E1 - E2) / (V1 - V2), rel=1e-8)
    (E1,), (E2,) = printed(result, "right"), printed(result, "left")
    assert pxy == pytest.approx(-(E1 - E2) / (2 * e) / volume, abs=1e-8 * p)


def test_minimize(lmp):
    """Goes down to a rest of all forces, leaves radii, and runs go on from there."""
    body = """
minimize      0 1e-9 1000 10000
variable      f atom sqrt(fx^2+fy^2)
compute       f all reduce max v_f
thermo_style  custom step pe c_f
thermo_modify format float %.17g norm no
run           0
write_dump    all custom least id x y radius modify sort id format float %.17g
run           20
"""
    result = lmp(foam(body, dump="100000"), files=data())
    energy = result.thermo[0]["PotEng"]
    assert np.all(np.diff(energy) <= 0) and energy[-1] < 0.5 * energy[0]
    assert result.thermo[1]["c_f"][0] < 1e-6
    assert np.array_equal(result.dump("dump")[0]["radius"], result.dump("least")[0]["radius"])
    # and an integrated foam without gas exchange comes to rest where its energy is as low
    relaxed = lmp(foam("run 4000", gas="", step="1e-6", thermo=4000), files=data())
    assert relaxed.thermo[0]["PotEng"][-1] < energy[0]
    # exchange changes the energy little in 20 steps
    assert result.thermo[2]["PotEng"][-1] == pytest.approx(energy[-1], rel=0.05)


@pytest.mark.parametrize("step", ["1e-4", "1e-4 scheme source"])
def test_minimize_between_runs(lmp, step):
    """The rates before it are forgotten: what follows is what follows from the same state alone."""
    body = """
run           30
minimize      1e-6 1e-6 100 1000
write_data    after nocoeff
run           0
"""
    go_on = "print 'tau $(f_gas[1]:%.17g)'\nrun 1 post no\n"
    together = lmp(foam(body + go_on, step=step, dump="1"), files=data())
    first = together.thermo[0]
    alone = lmp(foam("run 1", step=step + f" dt0 {together.thermo[3]['f_step[2]'][-1]:.17g}",
                     pair="rin 1.0", dump="1"),
                files={"data": together.read("after")})
    a, b = together.dump("dump")[-1], alone.dump("dump")[-1]
    assert len(first["Step"]) > 1
    # data files keep 15 digits, dt is the same; radii differ by <R_in> in the law of exchange
    assert a.array("vx", "vy") == pytest.approx(b.array("vx", "vy"), abs=2e-2 *
                                                np.abs(b["vx"]).max())


def test_pe_per_bubble(lmp):
    body = """
compute       e all pe/atom
compute       sum all reduce sum c_e
compute       b all foam/bubble espring
compute       sumb all reduce sum c_b
thermo_style  custom step pe c_sum c_sumb
thermo_modify format float %.17g norm no
run           40
"""
    for ranks in (1, 2):
        table = lmp(foam(body), files=data(), ranks=ranks).thermo[0]
        assert table["c_sum"] == pytest.approx(table["PotEng"], rel=1e-12)
        assert table["c_sumb"] == pytest.approx(table["PotEng"], rel=1e-12)


def test_group_group(lmp):
    """compute group/group and pair/local call the pair style's single()."""
    body = """
group         low id 1:50
group         high subtract all low
compute       hh all group/group all
compute       d all pair/local eng
compute       e all reduce sum c_d inputs local
thermo_style  custom step pe c_hh c_e
thermo_modify format float %.17g norm no
run           0
"""
    table = lmp(foam(body), files=data()).thermo[0]
    # group/group of all with all counts every pair once
    assert table["c_hh"] == pytest.approx(table["PotEng"], rel=1e-12)
    assert table["c_e"] == pytest.approx(table["PotEng"], rel=1e-12)


# ---- output while bubbles vanish ----------------------------------------------------------------

MANY = dict(gas="0.1 0.1 rmin 0.7", thermo=7)

WATCH = """
variable      R atom radius
compute       least all reduce min v_R
compute       number all reduce sum v_one
fix           ave all ave/time 1 1 1 c_least c_number f_gas[2] file averages
fix           lines all print 3 "$(step) $(c_least) $(atoms) $(f_gas[2])" file lines screen no &
              title "# step least atoms living"
dump          each all custom 1 all id radius vx
dump_modify   each format float %.17g
"""


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("step", ["1e-3", "1e-2 scheme source", "1e-3 variable radius"])
def test_dead_bubbles_are_never_seen(lmp, step, ranks):
    body = "variable one atom 1.0\n" + WATCH + "run 200"
    result = lmp(foam(body, step=step, **MANY), files=data(2, 12), ranks=ranks)
    frames = result.dump("all")
    counts = np.array([len(frame) for frame in frames])
    assert counts[0] - counts[-1] > 40
    assert [frame.step for frame in frames] == list(range(201))
    for frame in frames:
        assert np.all(frame["radius"] > 0)
    averages = np.loadtxt(result.directory / "averages")
    steps = averages[:, 0].astype(int)
    assert np.array_equal(steps, np.arange(201))
    least = np.array([frame["radius"].min() for frame in frames])
    assert averages[:, 1] == pytest.approx(least, rel=1e-5)    # written with 6 digits
    assert np.array_equal(averages[:, 2], counts)
    assert np.array_equal(averages[:, 3], counts)
    lines = result.table("lines")
    assert np.array_equal(lines["atoms"], counts[lines["step"].astype(int)])
    assert np.array_equal(lines["living"], lines["atoms"])
    assert np.all(lines["least"] > 0)
    table = result.thermo[0]
    assert np.array_equal(table["Atoms"], counts[table["Step"].astype(int)])
    assert np.array_equal(table["f_gas[2]"], table["Atoms"])
    assert np.array_equal(table["f_gas[7]"], counts[0] - table["Atoms"])


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("watch", ["thermo", "dump", "ave/time", "print", "restart"])
def test_one_observer(lmp, watch, ranks):
    """The same with one kind of output at a time, so that none hides behind another."""
    every = 5
    body = {"thermo": f"thermo {every}",
            "dump": f"dump e all custom {every} all id radius",
            "ave/time": f"fix ave all ave/time {every} 1 {every} c_least file averages",
            "print": f"fix l all print {every} \"$(step) $(c_least)\" file lines screen no",
            "restart": f"restart {every} state.*"}[watch]
    text = foam("variable R atom radius\ncompute least all reduce min v_R\n"
                "thermo_style custom step atoms f_gas[2] c_least\nthermo_modify norm no\n"
                "thermo 100000\n" + body + "\nrun 150", **MANY)
    result = lmp(text, files=data(2, 12), ranks=ranks)
    table = result.thermo[0]
    assert table["Atoms"][-1] < table["Atoms"][0] - 30
    if watch == "thermo":
        assert np.all(table["c_least"] > 0) and np.array_equal(table["Atoms"], table["f_gas[2]"])
    elif watch == "dump":
        assert all(np.all(frame["radius"] > 0) for frame in result.dump("all"))
    elif watch == "ave/time":
        assert np.all(np.loadtxt(result.directory / "averages")[:, 1] > 0)
    elif watch == "print":
        assert np.all(np.loadtxt(result.directory / "lines")[:, 1] > 0)
    else:
        for n in (50, 100):
            again = lmp(f"read_restart state.{n}\nwrite_dump all custom again id radius",
                        directory=result.directory)
            assert np.all(again.dump("again")[0]["radius"] > 0)


def test_time_limit(lmp):
    """A run that `fix halt` or a time limit ends leaves no dead bubbles behind either."""
    body = "fix h all halt 1 v_late > 0 error continue message no\nrun 500\n" \
           "write_dump all custom left id radius\nprint 'atoms $(atoms) $(f_gas[2])'"
    result = lmp(foam("variable late equal f_gas[7]>20\n" + body, **MANY), files=data(2, 12))
    left = result.dump("left")[0]
    assert np.all(left["radius"] > 0) and len(left) <= 144 - 20
    assert printed(result, "atoms") == [len(left), len(left)]


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("every", [0.5, 3.0, 0.05])
def test_dump_every_time(lmp, every, ranks):
    """The first step at or after each multiple of the time, none skipped; a step that passes
    several multiples is dumped once.  Energies in the dump are those of its step."""
    body = f"""
compute       e all pe/atom
dump          t all custom 1000000 times id radius c_e
dump_modify   t every/time {every} time yes format float %.17g
run           130
run           70
"""
    result = lmp(foam(body, thermo=1), files=data(2, 12), ranks=ranks)
    t, energy = {}, {}
    for table in result.thermo:
        t.update(zip(table["Step"].astype(int), table["Time"]))
        energy.update(zip(table["Step"].astype(int), table["PotEng"]))
    times = np.array([t[n] for n in range(201)])
    passed = np.floor(times / every + 1e-9)
    expected = [0] + list(np.flatnonzero(np.diff(passed) > 0) + 1)
    frames = result.dump("times")
    for frame in frames:
        assert frame.time == pytest.approx(t[frame.step], rel=1e-12)
        assert frame["c_e"].sum() == pytest.approx(energy[frame.step], rel=1e-11)
    assert [frame.step for frame in frames] == expected


def test_dump_every_time_with_first_and_steps(lmp):
    """A dump by steps and one by time beside each other do not disturb each other."""
    body = """
compute       e all pe/atom
dump          s all custom 7 steps id c_e
dump          t all custom 1 times id c_e
dump_modify   t every/time 2.5
thermo        10
run           150
"""
    result = lmp(foam(body), files=data())
    assert [frame.step for frame in result.dump("steps")] == list(range(0, 151, 7))
    assert list(result.thermo[0]["Step"]) == list(range(0, 151, 10))
    assert len(result.dump("times")) == 1 + int(result.thermo[0]["Time"][-1] / 2.5)


# ---- the end of a run ---------------------------------------------------------------------------

END = re.compile(r"coarsening ended at step (\d+), t = \S+: (.*)")


@pytest.mark.parametrize("ranks", [1, 2])
def test_nmin(lmp, ranks):
    body = "run 1000\nprint 'later commands'\nwrite_dump all custom left id radius\nrun 100\n" \
           "print 'and later'"
    result = lmp(foam(body, gas="0.1 0.1 rmin 0.5 nmin 90", thermo=50, dump="1"), files=data(),
                 ranks=ranks)
    ends = END.findall(result.screen)
    assert len(ends) == 2 and "90" in ends[0][1]    # the second run ends where it begins
    table, again = result.thermo
    assert table["Step"][-1] == int(ends[0][0]) and table["Step"][-1] % 50 != 0
    assert table["Atoms"][-1] == table["f_gas[2]"][-1] <= 90
    assert table["f_gas[2]"][-2] > 90
    last = result.dump("dump")[-1]
    assert last.step == table["Step"][-1] and len(last) == table["Atoms"][-1]
    assert len(result.dump("left")[0]) == len(last)
    assert list(again["Step"]) == [table["Step"][-1]]
    # energy and pressure in the last line are of the last state, as the next run sees it
    for name in ("PotEng", "c_p", "c_p[1]", "c_p[4]", "f_gas[3]", "f_gas[5]", "f_gas[6]"):
        assert table[name][-1] == pytest.approx(again[name][0], rel=1e-11), name
    assert "later commands" in result.screen and "and later" in result.screen
    assert ends[0][1] in (result.directory / "log.lammps").read_text()


def test_nmin_lowered(lmp):
    """A run can go on where another has ended."""
    body = "run 1000\nunfix gas\nfix gas all foam/coarsen 0.1 0.1 rmin 0.5 nmin 80\nrun 1000"
    result = lmp(foam(body, gas="0.1 0.1 rmin 0.5 nmin 90"), files=data())
    assert len(END.findall(result.screen)) == 2
    assert result.thermo[1]["Atoms"][-1] <= 80 < result.thermo[1]["Atoms"][-2]


@pytest.mark.parametrize("ranks", [1, 2])
def test_spans_the_box(lmp, ranks):
    body = "run 5000\nprint 'later commands'\nrun 10"
    result = lmp(foam(body, gas="0.1 0.1", thermo=1000), files=data(2, 4), ranks=ranks)
    ends = END.findall(result.screen)
    assert len(ends) == 2 and "spans the box" in ends[0][1]
    table = result.thermo[0]
    side = 4 * 1.6
    rin = packing(2, 4)[1].mean()
    assert 2 * table["f_gas[4]"][-1] * rin >= side
    assert "later commands" in result.screen and len(result.thermo[1]["Step"]) == 1


# ---- cutoffs that grow in mid-run ---------------------------------------------------------------

def few_large(headroom, neighbor, extra="", ranks=1, run="run 300"):
    """Two bubbles that stay where they are, and grow into contact at the expense of others."""
    sites = np.stack(np.meshgrid(*[np.arange(10)] * 2, indexing="ij"), -1).reshape(-1, 2)
    x = np.vstack([[[45, 45], [52, 45]], 3.0 * sites + 1.5])
    R = np.r_[2.5, 2.5, np.full(100, 1.0)]
    return HEAD.format(dim=2) + f"""
read_data     data
neighbor      {neighbor}
pair_style    durian/foam 1.0 headroom {headroom}
pair_coeff    * * 0.0
fix           gas all foam/coarsen 1e-2 1.0
fix           step all foam/abm 1e-4
compute       b all foam/bubble contacts
{extra}
thermo_style  custom step atoms f_gas[4]
{PRECISE}
thermo        1
dump          d all custom 1 dump id x y radius c_b
dump_modify   d sort id format float %.17g
{run}
""", {"data": data_file([60, 60], x, R)}


OTHER_LISTS = """
comm_modify   cutoff 12.0
compute       near all coord/atom cutoff 3.5
compute       sum all reduce sum c_near
compute       g all rdf 10 cutoff 3.5
compute       clusters all cluster/atom 3.5
compute       most all reduce max c_clusters
fix           g all ave/time 1 1 1 c_g[2] mode vector file g
fix           near all ave/time 1 1 1 c_sum c_most file near
"""


@pytest.mark.parametrize("headroom, neighbor, extra, ranks", [
    (1.0, "0.1 bin", "", 1), (1.0, "0.3 multi", "", 2), (1.05, "0.3 nsq", "", 1),
    (1.2, "1.0 bin", "", 4), (10.0, "0.1 bin", "", 1),
    (10.0, "0.3 bin", "neigh_modify delay 10 every 10", 1),
    (1.05, "0.3 bin", "neigh_modify delay 1000 every 10 check no", 1),
    (1.05, "0.3 bin", OTHER_LISTS, 1), (1.0, "0.3 bin", OTHER_LISTS, 2),
])
def test_contact_by_growth(lmp, headroom, neighbor, extra, ranks):
    """No bubble moves, so LAMMPS' own check never asks for a new list: the contact is found at the
    very step at which R_1 + R_2 passes the distance."""
    bins_only(lmp, neighbor)
    text, files = few_large(headroom, neighbor, extra, ranks)
    result = lmp(text, files=files, ranks=ranks)
    frames = result.dump("dump")
    touching = np.array([frame["radius"][:2].sum() > 7.0 for frame in frames])
    assert 0 < touching.sum() < len(frames)
    counted = np.array([frame["c_b"][:2] for frame in frames])
    assert np.array_equal(counted[:, 0], touching) and np.array_equal(counted[:, 1], touching)
    assert frames[-1]["radius"].max() > 2.9 * frames[0]["radius"].mean()    # outgrew the cutoffs


def test_lists_of_others_after_growth(lmp):
    """What other computes count does not depend on when the cutoffs were renewed."""
    results = []
    for headroom in (1.0, 10.0):
        text, files = few_large(headroom, "0.3 bin", OTHER_LISTS)
        results.append(lmp(text, files=files))
    a, b = (np.loadtxt(result.directory / "near") for result in results)
    assert len(a) == 301 and np.array_equal(a, b)
    assert results[0].read("g") == results[1].read("g")


@pytest.mark.parametrize("headroom, ranks", [(1.0, 1), (1.05, 2)])
def test_headroom_does_not_matter(lmp, headroom, ranks):
    """One run in which the largest bubble outgrows the cutoffs again and again, against one with
    cutoffs for all that comes.  Rounding differs and grows: 1e-12 measured after 150 steps."""
    gas = "0.1 0.1 rmin 0.5"
    plain = lmp(foam("run 150", gas=gas, pair="headroom 6", dump="50"), files=data(2, 12))
    other = lmp(foam("run 150", gas=gas, pair=f"headroom {headroom}", dump="50"),
                files=data(2, 12), ranks=ranks)
    largest = plain.thermo[0]["f_gas[4]"]
    assert largest[-1] > 1.2 * largest[0]
    for a, b in zip(plain.dump("dump"), other.dump("dump")):
        assert np.array_equal(a["id"], b["id"])
        d = a.array("x", "y") - b.array("x", "y")
        box = 12 * 1.6
        assert np.abs(d - box * np.round(d / box)).max() < 1e-8
        assert a["radius"] == pytest.approx(b["radius"], rel=1e-8)


# ---- changes between runs -----------------------------------------------------------------------

CHANGES = {
    "delete_atoms": "group some id 1:20\ndelete_atoms group some",
    "delete_atoms compress no": "group some id 1:20\ndelete_atoms group some compress no",
    "create_atoms": "create_atoms 1 random 20 7 NULL\nset group all density 1.0",
    "displace_atoms": "displace_atoms all random 0.2 0.2 0 7",
    "change_box": "change_box all x scale 0.95 y scale 0.95 remap",
    "set diameter": "set atom 1*10 diameter 1.0",
    "pair_coeff": "pair_coeff * * 2.0",
}


@pytest.mark.parametrize("step", ["1e-3", "1e-3 scheme source"])
@pytest.mark.parametrize("change", CHANGES)
def test_changed_between_runs(lmp, change, step):
    """The rates with which a run begins are those of its state, not of the one before a command:
    v = F / mu0, in the first frame of the second run."""
    body = "run 40\n" + CHANGES[change] + "\ndump e all custom 1 second id vx vy fx fy radius\n" \
           "dump_modify e sort id format float %.17g\nrun 1\nrun 20"
    result = lmp(foam(body, step=step), files=data())
    frame = result.dump("second")[0]
    assert np.abs(frame["fx"]).max() > 0.02    # at rest they would agree anyhow
    assert frame.array("vx", "vy") == pytest.approx(frame.array("fx", "fy"), abs=1e-12)
    assert result.thermo[2]["f_gas[2]"][-1] == result.thermo[2]["Atoms"][-1]


def test_gas_of_changed_bubbles(lmp):
    """New radii count: the gas is that of the present bubbles and stays so."""
    body = "run 20\nset atom 1*10 diameter 2.5\nrun 0\nrun 50"
    result = lmp(foam(body, dump="100000"), files=data())
    _, R, box = packing()
    second, third = result.thermo[1], result.thermo[2]
    assert second["f_gas[5]"][0] != pytest.approx(result.thermo[0]["f_gas[5]"][-1], rel=1e-3)
    assert third["f_gas[5]"] == pytest.approx(second["f_gas[5]"][0], rel=1e-12)


def test_write_and_read_data(lmp):
    """What a data file can keep, it keeps: x, R, v, coefficients, to its 15 digits."""
    result = lmp(foam("run 30\nwrite_data state\nwrite_data pairs pair ij\nrun 0", dump="30"),
                 files=data())
    for name in ("state", "pairs"):
        again = lmp(HEAD.format(dim=2) + f"""
pair_style    durian/foam 1.0 rin 1.0
read_data     {name}
fix           step all foam/abm 1e-3
{BASIC}
dump          e all custom 1 again id x y radius vx vy
dump_modify   e sort id format float %.17g
run           0
""", directory=result.directory)
        a, b = result.dump("dump")[-1], again.dump("again")[0]
        assert a["radius"] == pytest.approx(b["radius"], rel=1e-14)
        # energy is sigma0 <R_in> ..., with <R_in> given as 1 here
        rin = packing()[1].mean()
        assert again.thermo[0]["PotEng"][0] * rin == \
            pytest.approx(result.thermo[1]["PotEng"][0], rel=1e-11)


def test_mean_radius_is_kept(lmp):
    """<R_in> is that of the first run, also in later ones and after a restart."""
    body = "run 60\nrun 0\nwrite_restart state"
    result = lmp(foam(body, gas="0.1 0.1 rmin 0.7"), files=data())
    rin = packing()[1].mean()
    again = lmp(f"""
read_restart  state
fix           gas all foam/coarsen 0.1 0.1 rmin 0.7
fix           step all foam/abm 1e-3
{GAS}
dump          e all custom 1 again radius
dump_modify   e format float %.17g
run           0
""", directory=result.directory)
    mean = again.dump("again")[0]["radius"].mean()
    assert mean > 1.02 * rin
    for table in (result.thermo[1], again.thermo[0]):
        assert table["f_gas[3]"][-1] == pytest.approx(mean / rin, rel=1e-12)
    assert again.thermo[0]["PotEng"][0] == pytest.approx(result.thermo[1]["PotEng"][-1], rel=1e-12)
    for k in (1, 7, 8):
        assert again.thermo[0][f"f_gas[{k}]"][0] == result.thermo[1][f"f_gas[{k}]"][-1]


def test_velocity_command(lmp):
    """With static drag velocities are results: those of a command are overwritten."""
    body = "run 20\nvelocity all create 1.0 7\nrun 1\nrun 20"
    result = lmp(foam(body, dump="20"), files=data())
    plain = lmp(foam("run 41", dump="41"), files=data())
    # the command tells the integrator that its history is not that of this state: it starts
    # anew, which costs accuracy of the order of the tolerance
    a, b = result.thermo[2], plain.thermo[0]
    assert a["PotEng"][-1] == pytest.approx(b["PotEng"][-1], rel=1e-2)


# ---- other forces -------------------------------------------------------------------------------

def test_setforce_holds(lmp):
    """Held bubbles stay, others move, from the first step on: the rates it starts from count the
    forces of fixes that come after the integrator."""
    body = "group held id 1:30\nfix hold held setforce 0 0 0\nrun 40"
    result = lmp(foam(body, dump="40"), files=data())
    first, last = result.dump("dump")
    ids = set(last["id"])
    for frame in (first, last):
        assert set(range(1, 31)) <= ids
    held = [np.array([frame.array("x", "y")[frame["id"] == n][0] for n in range(1, 31)])
            for frame in (first, last)]
    assert np.array_equal(*held)
    assert len(first) == len(last) or len(last) < len(first)
    moved = [frame.array("x", "y")[frame["id"] == 60] for frame in (first, last)]
    assert np.abs(moved[0] - moved[1]).max() > 1e-3


def test_addforce_moves_at_constant_speed(lmp):
    """One bubble under a constant force: x = x0 + F t / mu0, exactly, from the first step on."""
    body = "fix push all addforce 0.3 -0.1 0\nrun 50"
    text = foam(body, gas="", dump="50").replace("durian/foam 1.0", "durian/foam 2.0")
    result = lmp(text, files={"data": data_file([100, 100], [[20, 70]], [1.0])})
    t = result.thermo[0]["Time"][-1]
    # image flags are not dumped: go along the path modulo the box
    x = np.array([20 + 0.15 * t, 70 - 0.05 * t]) % 100
    d = result.dump("dump")[-1].array("x", "y")[0] - x
    assert np.abs(d - 100 * np.round(d / 100)).max() < 1e-11 * max(1.0, t)


@pytest.mark.parametrize("wall", [
    "fix other all indent 1.0 sphere 8 8 0 3.0\nfix_modify other energy yes",
    "region box block 0 16 0 16 -1 1\nfix other all wall/region box harmonic 1.0 1.0 1.0\n"
    "fix_modify other energy yes",
])
def test_other_forces(lmp, wall):
    """Their energy goes down together with that of the foam, and they act in every evaluation."""
    result = lmp(foam(wall + "\nvariable e equal pe\nthermo_modify norm no\nrun 100", gas=""),
                 files=data())
    table = result.thermo[0]
    assert np.all(np.diff(table["PotEng"]) < 0)
    plain = lmp(foam("run 100", gas=""), files=data()).thermo[0]
    assert table["PotEng"][0] > plain["PotEng"][0]
    assert result.thermo[0]["f_step[4]"][-1] < 50    # no struggle between two kinds of force


def test_fixes_that_take_bubbles_out(lmp):
    """fix evaporate: counts follow."""
    body = "region all block INF INF INF INF INF INF\n" \
           "fix gone all evaporate 10 3 all 7\nrun 60\nrun 0"
    result = lmp(foam(body), files=data())
    table = result.thermo[1]
    assert table["Atoms"][0] < 90
    assert table["f_gas[2]"][0] == table["Atoms"][0]
    # in mid-run, too
    assert np.array_equal(result.thermo[0]["f_gas[2]"], result.thermo[0]["Atoms"])


def test_fix_that_puts_bubbles_in(lmp):
    """fix deposit: a new bubble takes part, or the run ends with the reason."""
    body = "region all block 1 15 1 15 -0.1 0.1\n" \
           "fix new all deposit 5 1 10 7 region all near 0.1\nrun 60"
    result = lmp(foam(body), files=data(), check=False)
    if result.returncode:
        assert "the step fell to" not in result.errors[0]
        assert "bubble" in result.errors[0]
    else:
        assert result.thermo[-1]["Atoms"][-1] > 100 - result.thermo[-1]["f_gas[7]"][-1]
        assert np.array_equal(result.thermo[-1]["f_gas[2]"], result.thermo[-1]["Atoms"])


# ---- moving boxes -------------------------------------------------------------------------------

SHEAR = """
variable      shift equal 0.02*f_step[1]*ly
variable      rate equal 0.02*ly
fix           shear all deform 1 xy variable v_shift v_rate remap x
thermo_style  custom step time xy f_step[1] v_shift pe c_p c_p[4] f_step[4]
thermo_modify format float %.17g norm no
"""


@pytest.mark.parametrize("ranks", [1, 2])
def test_shear(lmp, ranks):
    """2D simple shear of a triclinic box at a constant rate in time, through flips of the box: the
    stress is that of a foam under shear, positive work, and steady."""
    body = "change_box all triclinic\n" + SHEAR + "run 1500"
    result = lmp(foam(body, gas="", step="1e-3 dtmax 0.1", thermo=50), files=data(), ranks=ranks)
    table = result.thermo[0]
    side = 10 * 1.6
    d = table["Xy"] - table["v_shift"]
    assert np.abs(d - side * np.round(d / side)).max() < 1e-9
    assert np.abs(table["Xy"]).max() <= 0.5 * side * 1.01    # flipped
    assert table["v_shift"][-1] > side                       # more than once around
    steady = table["c_p[4]"][len(table["Step"]) // 3:]
    assert steady.mean() < -0.003    # LAMMPS' pressure: minus the stress


def test_shear_needs_neighbors_across_the_moving_boundary(lmp):
    """The lists hold in a sheared box: contacts found with a small skin are those found with a
    large one (up to the error allowed per step, while the paths are still near each other)."""
    body = "change_box all triclinic\n" + SHEAR + "run 200"
    tables = [lmp(foam(body, gas="", step="1e-3 dtmax 0.02", neighbor=skin, thermo=50),
                  files=data()).thermo[0] for skin in ("0.1 bin", "1.0 bin")]
    assert tables[0]["PotEng"] == pytest.approx(tables[1]["PotEng"], rel=1e-9)
    assert tables[0]["c_p[4]"] == pytest.approx(tables[1]["c_p[4]"], rel=1e-7)


def test_rate_of_deform_by_step(lmp):
    """fix deform ... erate takes the time from the number of steps and the length of the present
    one; with steps of varying length this is no rate.  It has to be said, not done silently."""
    body = "change_box all triclinic\nfix shear all deform 1 xy erate 0.01 remap x\nrun 60"
    result = lmp(foam(body, gas="", output=BASIC.replace("vol", "vol xy")), files=data(),
                 check=False)
    said = [line for line in result.screen.splitlines()
            if ("WARNING" in line or "ERROR" in line) and "deform" in line]
    if not said:
        table = result.thermo[0]
        assert table["Xy"][-1] == pytest.approx(0.01 * 16 * table["Time"][-1], rel=1e-6)


def test_compress(lmp):
    body = "fix press all deform 1 x scale 0.9 y scale 0.9 remap x\nrun 150"
    result = lmp(foam(body), files=data())
    table = result.thermo[0]
    assert table["Volume"][-1] == pytest.approx(0.81 * table["Volume"][0], rel=1e-12)
    gas = table["f_gas[5]"] * table["Volume"]
    # the state is that of the step, the box already that of the next: 1/150 of the change
    assert gas == pytest.approx(gas[0], rel=2 * 0.2 / 150)


# ---- hybrid pair styles, groups, types ----------------------------------------------------------

def test_hybrid_overlay(lmp):
    """Beside another pair style the foam is the same."""
    plain = lmp(foam("run 60"), files=data()).thermo[0]
    text = foam("run 60").replace("pair_style    durian/foam 1.0",
                                  "pair_style hybrid/overlay zero 2.0 durian/foam 1.0")
    text = text.replace("pair_coeff    * * 1.0", "pair_coeff * * durian/foam 1.0\n"
                        "pair_coeff * * zero")
    table = lmp(text, files=data()).thermo[0]
    for name in ("Atoms", "f_step[4]"):
        assert np.array_equal(table[name], plain[name])
    for name in ("PotEng", "f_gas[3]", "Time"):
        assert table[name] == pytest.approx(plain[name], rel=1e-9), name


def test_types(lmp):
    """sigma0 of unlike types: given, or the geometric mean."""
    x, R = [[3, 3], [4.5, 3], [7, 7], [8, 7]], [1.0] * 4
    text = data_file([12, 12], x, R).replace("1 atom types", "2 atom types")
    body = """
set           atom 2 type 2
set           atom 3*4 type 2
pair_coeff    1 1 1.0
pair_coeff    2 2 4.0
run           0
print         'mixed $(pe:%.17g)'
pair_coeff    1 2 3.0
run           0
print         'given $(pe:%.17g)'
write_restart state
"""
    result = lmp(foam(body, gas=""), files={"data": text})

    def energy(sigma, overlap):
        return sigma * overlap**2 / 4

    # energy = sigma overlap^2 / (2 (R_i + R_j))
    assert printed(result, "mixed")[0] in (pytest.approx(energy(2, 0.5) + energy(4, 1)),
                                           pytest.approx(energy(1, 0.5) + energy(4, 1)))
    assert printed(result, "given")[0] == pytest.approx(energy(3, 0.5) + energy(4, 1), rel=1e-14)
    again = lmp(f"read_restart state\nfix step all foam/abm 1e-3\n{BASIC}\nrun 0",
                directory=result.directory)
    assert again.thermo[0]["PotEng"][0] == pytest.approx(energy(3, 0.5) + energy(4, 1), rel=1e-14)


def test_group_output(lmp):
    """A compute of a group counts contacts with all, for its own bubbles only."""
    body = """
group         some id 1:40
compute       all all foam/bubble contacts area
compute       some some foam/bubble contacts area
dump          g all custom 1 groups id c_all[*] c_some[*]
dump_modify   g sort id
run           0
"""
    frame = lmp(foam(body), files=data()).dump("groups")[0]
    inside = frame["id"] <= 40
    for k in (1, 2):
        assert np.array_equal(frame[f"c_some[{k}]"], np.where(inside, frame[f"c_all[{k}]"], 0))


def test_reset_timestep(lmp):
    """LAMMPS' clock can be set; that of the foam goes on."""
    result = lmp(foam("run 20\nreset_timestep 0 time 0\nrun 20"), files=data())
    plain = lmp(foam("run 40"), files=data())
    a, b = result.thermo[1], plain.thermo[0]
    assert a["Step"][-1] == 20
    assert a["f_step[1]"][-1] == pytest.approx(b["f_step[1]"][-1], rel=1e-9)
    assert a["f_gas[1]"][-1] == pytest.approx(b["f_gas[1]"][-1], rel=1e-9)
    assert a["Time"][-1] == pytest.approx(b["Time"][-1] - result.thermo[0]["Time"][-1], rel=1e-9)


def test_order_of_fixes(bitwise_lmp):
    """The integrator may come before the gas exchange."""
    text = foam("run 60")
    swapped = text.replace("fix gas all foam/coarsen 1e-2 0.1\n", "").replace(
        "fix           step all foam/abm 1e-3\n",
        "fix           step all foam/abm 1e-3\nfix gas all foam/coarsen 1e-2 0.1\n")
    assert swapped != text
    a, b = (bitwise_lmp(t, files=data()).thermo[0] for t in (text, swapped))
    for name in a:
        assert np.array_equal(a[name], b[name]), name


def test_time_grows_with_steps(lmp):
    """One timestep is one accepted step; LAMMPS' time, dt and those of the fix agree."""
    table = lmp(foam("run 60", thermo=1, output=GAS.replace("time", "time dt")),
                files=data()).thermo[0]
    assert np.array_equal(table["f_step[3]"], table["Step"])
    assert table["Time"] == pytest.approx(table["f_step[1]"], rel=1e-12)
    assert np.diff(table["Time"]) == pytest.approx(table["f_step[2]"][1:], rel=1e-11)
    assert table["Dt"][1:] == pytest.approx(table["f_step[2]"][1:], rel=1e-12)
    rin = packing()[1].mean()
    assert table["f_gas[1]"] == pytest.approx(1e-2 * table["Time"] / rin**2, rel=1e-11)
    # one evaluation to begin with, then two for each step tried and accepted, one if refused
    assert table["f_step[5]"] == pytest.approx(1 + 2 * table["f_step[3]"] + table["f_step[4]"],
                                               abs=8)


@pytest.mark.parametrize("again", ["pair_style none\n", "pair_style hybrid/overlay "])
def test_means_survive_another_pair_style(lmp, again):
    """A new pair style object in mid-simulation goes on with <R_in> and <A_in> of its start."""
    style = again + ("pair_style durian/foam 1.0\npair_coeff * * 1.0" if "none" in again else
                     "durian/foam 1.0\npair_coeff * * durian/foam 1.0")
    result = lmp(foam(f"run 200\n{style}\nrun 10", gas="0.1 0.1"), files=data())
    before, after = result.thermo
    for column in ("f_gas[1]", "f_gas[3]", "f_gas[4]"):
        assert after[column][0] == pytest.approx(before[column][-1], rel=1e-12), column
    assert before["f_gas[3]"][-1] > 1.01    # the mean radius has changed meanwhile


def test_end_with_tiled_communication(lmp):
    """Ghosts of comm_style tiled reach no further than the box: the run ends before they have to."""
    body = "run 100000\nprint 'gone on'"
    text = tiled(lmp) + foam(body, gas="0.1 0.1", thermo=1000)
    result = lmp(text, files=data(n=6), ranks=2)
    assert "spans the box" in result.screen
    assert "gone on" in result.screen
