"""Ages of contacts, fix foam/contacts, against a count from dumps of every step: through rejected steps,
removal, migration, sorting, restart.

The count knows places, radii, IDs and times of accepted states alone.  It adds the same steps as the fix,
as differences of times: each is rounded to 1e-16 of the time, and some hundred are added, so 1e-12 of the time
leaves room.
"""

import re

import numpy as np
import pytest

from foams import foam
from test_members import AMONG, COEFFICIENTS
from runner import HEAD, PRECISE, data_file, tiled

LIMIT = 1e-12
AGES = "fix ages all foam/contacts"
OUTPUT = f"""
thermo_style  custom step atoms time f_ages[*] f_step[4] f_gas[7]
{PRECISE}
thermo        1
dump          d all custom 1 dump id x y z radius f_ages[*]
dump_modify   d sort id format float %.17g time yes
"""
SIDE = {2: 12, 3: 5}


def text(dim=2, before="", skin=0.3, gas="0.1 0.1 rmin 0.4", step="abm 1e-3", pair="", ages=AGES, after="",
         run="run 120", read="read_data data"):
    return HEAD.format(dim=dim) + f"""
{before}
{read}
neighbor      {skin} bin
pair_style    durian/foam 1.0 {pair}
pair_coeff    * * 1.0
fix           gas all foam/coarsen {gas}
{ages}
fix           step all foam/{step}
{OUTPUT}
{after}
{run}
"""


def files(dim=2, n=None):
    x, R, v, box = foam(dim, n or SIDE[dim])
    return {"data": data_file([box] * dim, x, R, v)}


# ---- the count ----------------------------------------------------------------------------------

class Count:
    """Contacts and their ages, from one frame to the next."""

    def __init__(self):
        self.ages, self.time, self.formed, self.lost = None, None, 0, 0

    def take(self, frame, dim):
        x, R, ids = frame.array("x", "y", "z")[:, :dim], frame["radius"], frame["id"].astype(int)
        d = x[:, None] - x[None]
        box = np.array([hi - lo for lo, hi in frame.box])[:dim]
        d -= box * np.round(d / box)
        touch = np.triu((d**2).sum(2) < (R[:, None] + R[None])**2, 1)
        pairs = {(ids[i], ids[j]) for i, j in zip(*np.nonzero(touch))}
        if self.ages is None:
            self.ages = dict.fromkeys(pairs, 0.0)
        else:
            step = frame.time - self.time
            self.formed += len(pairs - self.ages.keys())
            self.lost += len(self.ages.keys() - pairs)
            self.ages = {pair: self.ages[pair] + step if pair in self.ages else 0.0 for pair in pairs}
        self.time = frame.time

    def of_bubbles(self, ids):
        """Number, age of the oldest and mean age, as the fix gives them."""
        own = {int(i): [] for i in ids}
        for (i, j), age in self.ages.items():
            own[i].append(age)
            own[j].append(age)
        return np.array([[len(a), max(a, default=0.0), np.mean(a) if a else 0.0]
                         for a in (own[int(i)] for i in ids)])

    def of_all(self):
        ages = list(self.ages.values())
        return [len(ages), self.formed, self.lost, np.mean(ages) if ages else 0.0, max(ages, default=0.0)]


def assert_counted(table, frames, dim=2, count=None):
    """Each frame, and each line of thermo output."""
    count = count or Count()
    rows = {int(step): [table[f"f_ages[{k}]"][n] for k in range(1, 6)] for n, step in enumerate(table["Step"])}
    assert len(frames) > 20
    for frame in frames:
        count.take(frame, dim)
        limit = LIMIT * max(frame.time, 1.0)    # a minimization puts LAMMPS' time back
        given, own = frame.array(*[f"f_ages[{k}]" for k in (1, 2, 3)]), count.of_bubbles(frame["id"])
        assert np.array_equal(given[:, 0], own[:, 0]), frame.step
        assert np.abs(given - own).max() <= limit, frame.step
        given, own = np.array(rows[frame.step]), np.array(count.of_all())
        assert np.array_equal(given[:3], own[:3]), frame.step
        assert np.abs(given - own).max() <= limit, frame.step
    return count


# ---- scenes -------------------------------------------------------------------------------------

REJECTED = dict(skin=0.1, step="abm 1e-3 growth 1000 safety 0.999")
SCENES = {
    "plain": {},
    "3D": dict(dim=3),
    "rejected": dict(REJECTED),
    "rejected, trials": dict(REJECTED, ages=AGES + " trial yes"),
    "rejected, rkc": dict(skin=0.1, step="rkc 1e-2 growth 1000 safety 0.999", run="run 60"),
    "rejected, rkc, trials, 2 ranks": dict(skin=0.1, step="rkc 1e-2 growth 1000 safety 0.999", ranks=2, run="run 60",
                                           ages=AGES + " trial yes"),
    "rejected, trials, 3D, 4 ranks": dict(REJECTED, dim=3, ages=AGES + " trial yes", ranks=4),
    "source, trials": dict(REJECTED, step="abm 1e-3 scheme source growth 1000 safety 0.999", pair="drag neighbor",
                           ages=AGES + " trial yes"),
    "2 ranks": dict(ranks=2),
    "4 ranks": dict(ranks=4),
    "3D, 4 ranks": dict(dim=3, ranks=4),
    "sorted": dict(after="atom_modify sort 10 0.0"),
    "sorted, 2 ranks": dict(after="atom_modify sort 10 2.0", ranks=2),
    "cutoffs renewed, 2 ranks": dict(pair="headroom 1.0", ranks=2),
    "tiled, 3 ranks": dict(before="comm_style tiled", run="balance 1.0 rcb\nrun 120", ranks=3),
    "balanced, 3 ranks": dict(after="fix cut all balance 20 1.0 shift xy 10 1.1", ranks=3),
    "flow, 4 ranks": dict(after="fix flow all addforce 0.4 0.2 0", ranks=4),    # across the borders
    "newton off": dict(before="newton off", ranks=2),
    "host fix, 2 ranks": dict(after="fix first all store/state 0 xu", ranks=2),
    "among others, 2 ranks": dict(ranks=2),    # particles that are no bubbles
    "after the integrator": dict(ages="", after=AGES),
}


def run(lmp, name, **more):
    options = {**SCENES[name], **more}
    ranks, dim = options.pop("ranks", 1), options.get("dim", 2)
    lines = text(**options)
    if lmp.kokkos:
        lines = lines.replace("newton off", "")
    if name == "after the integrator":    # output refers to it
        lines = lines.replace(AGES + "\n", "").replace(OUTPUT, AGES + OUTPUT)
    if "among others" in name:
        lines = re.sub("(gas|ages|step|dump +d) all", r"\1 bubbles", lines)
        lines = lines.replace("read_data data\n", AMONG).replace("pair_coeff    * * 1.0\n", COEFFICIENTS)
    return lmp(tiled(lmp, lines), files=files(dim), ranks=ranks,
               check="host fix" not in name)


@pytest.mark.parametrize("name", SCENES)
def test_ages(lmp, name):
    """Those of the count; enough happens on the way that a wrong one would be seen."""
    result = run(lmp, name)
    assert result.returncode == 0
    count = assert_counted(result.thermo[-1], result.dump("dump"), SCENES[name].get("dim", 2))
    last = result.thermo[-1]
    assert count.formed > 20 and count.lost > 20
    assert len(set(count.ages.values())) > 10
    if not any(word in name for word in ("flow", "rkc", "source")):    # these are shorter
        assert last["f_gas[7]"][-1] > 5    # removed
    if "rejected" in name:
        assert last["f_step[4]"][-1] > 20


def test_trials_change_nothing(bitwise_lmp):
    """Nor is a trial a matter of rounding: what is written is the same, bit by bit."""
    assert run(bitwise_lmp, "rejected").read("dump") == run(bitwise_lmp, "rejected, trials").read("dump")


def test_many_contacts(lmp):
    """A bubble with more contacts than there is room for at first, on one of the ranks only."""
    x, R, _, box = foam(2, 12)
    far = np.hypot(*(x - box / 4).T) > 4.0
    x, R = np.vstack([x[far], [[box / 4, box / 4]]]), np.append(R[far], 3.9)
    for ranks in 1, 4:
        result = lmp(text(run="run 60"), files={"data": data_file([box] * 2, x, R)}, ranks=ranks)
        assert_counted(result.thermo[0], result.dump("dump"))
        assert max(frame["f_ages[1]"].max() for frame in result.dump("dump")) > 12


@pytest.mark.parametrize("ranks", [1, 2])
def test_through_two_images(lmp, ranks):
    """Bubbles that touch on both sides, and one that touches itself: pairs of bubbles, each once."""
    x, R = [[1, 5], [6, 5], [3.5, 9.9]], [3.0, 2.2, 5.5]
    lines = text(run="run 25", step="abm 1e-3 dtmax 1e-4")
    lines = re.sub("fix +gas .*", "", lines).replace("f_gas[7]", "")    # which ends a foam of such bubbles
    result = lmp(lines, files={"data": data_file([10, 10], x, R)}, ranks=ranks)
    count = assert_counted(result.thermo[0], result.dump("dump"))
    assert count.of_all()[:3] == [3, 0, 0] and count.of_all()[3] == pytest.approx(25e-4, rel=1e-12)


# ---- runs after one another ---------------------------------------------------------------------

@pytest.mark.parametrize("ranks", [1, 2, 4])
@pytest.mark.parametrize("dim", [2, 3])
def test_restart(bitwise_lmp, dim, ranks):
    """A restarted run goes on bit by bit, with the fix' own numbers."""
    lines = text(dim=dim, after="atom_modify sort 20 0.0\nrestart 40 state.*", run="run 90")
    whole = bitwise_lmp(lines, files=files(dim), ranks=ranks)
    again = bitwise_lmp(text(dim=dim, read="read_restart state.40", after="atom_modify sort 20 0.0\nrestart 40 again.*",
                     run="run 50").replace("dump id", "rest id"), ranks=ranks, directory=whole.directory)
    ours = {frame.step: frame for frame in whole.dump("dump")}
    rest = again.dump("rest")
    assert [frame.step for frame in rest] == list(range(40, 91))
    for frame in rest:
        for column in ("id", "x", "y", "radius", "f_ages[1]", "f_ages[2]", "f_ages[3]"):
            assert np.array_equal(frame[column], ours[frame.step][column]), (frame.step, column)
    for k in range(1, 6):
        name = f"f_ages[{k}]"
        # sums over all bubbles, of which ranks may own others
        assert again.thermo[0][name] == pytest.approx(whole.thermo[0][name][40:], rel=1e-13)


def test_restart_on_other_ranks(lmp):
    whole = lmp(text(after="restart 40 state.*", run="run 60"), files=files(), ranks=2)
    count = Count()
    for frame in whole.dump("dump")[:41]:
        count.take(frame, 2)
    again = lmp(text(read="read_restart state.40", run="run 40"), ranks=3, directory=whole.directory)
    table, frames = again.thermo[0], again.dump("dump")
    assert_counted(table, frames, count=count)


BETWEEN = {
    "nothing": "",
    "another pair style": "pair_style durian/foam 1.0 drag neighbor\npair_coeff * * 1.0",
    "another integrator": "unfix step\nfix step all foam/rkc 1e-2",
    "bubbles deleted": "group some id 1:40\ndelete_atoms group some compress no",
    "bubbles added": "create_atoms 1 random 30 7 NULL\nset group all density 1",
    "bubbles moved": "group some id 1:40\ndisplace_atoms some move 0.3 0.2 0",
    "radii changed": "set atom 1*40 diameter 1.5",
    "balanced": "balance 1.0 shift xy 10 1.05",
    "minimized": "minimize 0 1e-3 20 100\nreset_timestep 60",
}


def of_two_runs(lmp, between, ranks=1):
    """Each with a dump of its own: LAMMPS writes a step once, here before and after the commands."""
    second = re.search("dump  .*", OUTPUT)[0].replace(" d ", " e ").replace("dump id", "rest id")
    lines = f"run 60\nundump d\n{between}\n{second}\ndump_modify e sort id format float %.17g time yes\nrun 60"
    return lmp(text(run=lines), files=files(), ranks=ranks)


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("name", BETWEEN)
def test_two_runs(lmp, name, ranks):
    """Contacts that commands open are forgotten, those that they close are new, others go on."""
    result = of_two_runs(lmp, BETWEEN[name], ranks)
    count = assert_counted(result.thermo[0], result.dump("dump"))
    rest = result.dump("rest")
    count.time = rest[0].time    # commands take none, whatever LAMMPS' own clock says
    assert_counted(result.thermo[-1], rest, count=count)
    assert max(count.ages.values()) > 1.001 * (rest[-1].time - rest[0].time)    # of the first run


def test_other_ids(lmp):
    """Contacts are known by the IDs of bubbles: new ones are a new beginning, with a warning."""
    result = of_two_runs(lmp, "group some id 1:20\ndelete_atoms group some compress no\nreset_atoms id")
    assert "WARNING: Fix foam/contacts: the IDs of bubbles have changed" in result.screen
    assert_counted(result.thermo[-1], result.dump("rest"))


def test_fix_again(lmp):
    result = of_two_runs(lmp, f"unfix ages\n{AGES}")
    assert_counted(result.thermo[-1], result.dump("rest"))


def test_output_between_runs(lmp):
    """After commands that take bubbles out, each still has its own numbers."""
    result = lmp(text(run="run 60\ngroup some id 1:50\ndelete_atoms group some compress no\n"
                          "write_dump all custom after id f_ages[*] modify sort id format float %.17g"),
                 files=files())
    last, after = result.dump("dump")[-1], result.dump("after")[0]
    kept = np.isin(last["id"], after["id"])
    assert 0 < kept.sum() < len(last)
    for column in ("f_ages[1]", "f_ages[2]", "f_ages[3]"):
        assert np.array_equal(last[column][kept], after[column])


# ---- errors -------------------------------------------------------------------------------------

HYBRID = "pair_style hybrid/overlay zero 2.0 durian/foam 1.0\npair_coeff * * durian/foam 1.0\npair_coeff * * zero"
BAD = {
    "another group": (lambda lines: lines.replace(AGES, "group g id 1:9\nfix ages g foam/contacts"),
                      "group g and fix foam/abm group all"),
    "no integrator": (lambda lines: re.sub("fix +step.*|f_step.4.", "", re.sub("fix +gas.*|f_gas.7.", "", lines)),
                      "needs a fix that integrates the foam"),
    "hybrid, newton on": (lambda lines: "newton on\n" + re.sub("pair_style.*\n.*", HYBRID, lines), "needs newton off"),
}


@pytest.mark.parametrize("name", BAD)
def test_refused(base_lmp, name):
    change, words = BAD[name]
    result = base_lmp(change(text()), files=files(), check=False)
    assert result.returncode and "Fix foam/contacts" in result.errors[0] and words in result.errors[0]
