"""lammps-foam run and resume with LAMMPS: what a run writes, and that a killed run goes on as if nothing had happened.

Runs are killed at a step that is seen in their tables, never after a time.
"""

import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from lammps_foam.run import restart, tables
from runner import program
from thesis import FLAT, NESTED, written

SAVE = 400    # steps between restart files


def command(word, *arguments):
    code = "import sys; from lammps_foam.command import main; sys.argv[0] = 'lammps-foam'; main()"
    return [sys.executable, "-c", code, word, *map(str, arguments)]


def lammps_foam(word, *arguments, status=0):
    """Its standard output and errors."""
    done = subprocess.run(command(word, *arguments), stdin=subprocess.DEVNULL, capture_output=True, text=True)
    assert done.returncode == status, done.stdout + done.stderr
    return done.stdout + done.stderr


def arguments(directory, changes=None, data=NESTED):
    """Of a small foam whose restart files come after so many steps: so two runs agree to the last bit."""
    source = written(directory.with_suffix(".json"), data, changes)
    return [source, "--out", directory, "--lmp", program("FOAM_LMP_WHEEL"), "--save-steps", SAVE]


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A run that was never killed."""
    directory = tmp_path_factory.mktemp("whole") / "foam"
    lammps_foam("run", *arguments(directory))
    return directory


def column(directory, name, table="series.csv"):
    names = (directory / table).read_text().splitlines()[0].split(",")
    return np.loadtxt(directory / table, delimiter=",", skiprows=1, usecols=names.index(name), ndmin=1)


def test_time_series(whole):
    """A line at the start, at each multiple of `every` and at the end; and they say the same as each other."""
    steps = column(whole, "step")
    assert np.all(np.diff(steps)[:-1] == 50) and 0 < steps[-1] - steps[-2] <= 50 and steps[0] == 0
    assert column(whole, "N")[0] == 100 and column(whole, "N")[-1] == 60
    assert np.all(np.abs(column(whole, "phi") - 0.9) < 1e-10)    # 12 digits, and rounding of sums
    # tau = K t / mean^2, of ten digits
    assert np.allclose(column(whole, "tau"), 0.01 * column(whole, "time"), rtol=1e-9, atol=0)
    path, msd = column(whole, "path"), column(whole, "msd")
    assert path[0] == msd[0] == 0
    assert np.all(np.diff(path)[column(whole, "N")[1:] == column(whole, "N")[:-1]] > 0)


def test_results_and_snapshots(whole):
    """The thesis' tables agree with the run's."""
    tau = column(whole, "tau")
    found = column(whole, "tau", "results.csv")
    assert np.array_equal(found, [tau[tau >= n][0] for n in range(1, int(tau[-1]) + 1)])
    # twice per unit of tau, the start, and the end
    count = int(2 * tau[-1]) + 2
    names = [f"bubbles.csv.{n}" for n in range(count)]
    assert sorted(path.name for path in whole.glob("bubbles.csv.*")) == sorted(names)
    last = np.loadtxt(whole / names[-1], delimiter=",", skiprows=1)
    assert len(last) == 60
    # sums over bubbles are those of the series; 9 digits each
    x, y, _, r, *_, path, distance, energy, _, _ = last.T
    assert energy.sum() == pytest.approx(column(whole, "energy")[-1], rel=1e-7)
    assert path.mean() == pytest.approx(column(whole, "path")[-1], rel=1e-7)
    assert np.mean(distance**2) == pytest.approx(column(whole, "msd")[-1], rel=1e-7)
    assert r.max() == pytest.approx(column(whole, "Rmax")[-1], rel=1e-7)
    assert np.all(path >= distance * (1 - 1e-7))    # no way is shorter than the straight one
    frame = list(tables.frames(whole / "last.lammpstrj"))[-1]
    side = frame.bounds[0][1] - frame.bounds[0][0]
    assert np.all((x >= 0) & (x <= side) & (y >= 0) & (y <= side))


def test_displacements_add_up(whole):
    """From the first snapshot to the second a bubble's displacement is its distance."""
    second = np.loadtxt(whole / "bubbles.csv.1", delimiter=",", skiprows=1)
    assert np.allclose(second[:, 11], second[:, 9], rtol=1e-6, atol=1e-7)    # differences of 9 digits
    assert second[:, 11].max() > 0.01


def springs(x, R, side):
    """Energy of each bubble's half of its springs, of all pairs, with the nearest image; sigma0 = <R_in> = 1."""
    d = x[:, None] - x[None]
    d -= side * np.round(d / side)
    both = R[:, None] + R[None]
    overlap = np.clip(both - np.linalg.norm(d, axis=2), 0.0, None)
    np.fill_diagonal(overlap, 0.0)
    return (0.25 * overlap**2 / both).sum(1)


def test_all_columns_are_of_their_frame(tmp_path):
    """Also where frames follow each other closely: distance and energy by the places of the same frame."""
    directory = tmp_path / "foam"
    lammps_foam("run", *arguments(directory, {"snapShot.frequency": 100, "bubbles.numEnd": 90}))
    start = None
    count = 0
    for frame in tables.frames(directory / "foam.lammpstrj"):
        data = dict(zip(frame.names, np.array([row.split() for row in frame.rows], float).T))
        side = np.array([hi - lo for lo, hi, *_ in frame.bounds[:2]])
        x = np.column_stack([data["x"], data["y"]])
        unwrapped = x + side * np.column_stack([data["ix"], data["iy"]])
        start = dict(zip(data["id"], unwrapped)) if start is None else start
        moved = np.linalg.norm(unwrapped - np.array([start[i] for i in data["id"]]), axis=1)
        assert np.allclose(data["distance"], moved, rtol=1e-6, atol=1e-7)    # differences of 9 digits of some 10
        assert np.allclose(data["energy"], springs(x, data["radius"], side), rtol=1e-6, atol=1e-8)
        count += 1
    assert count > 50


def test_few_restart_files_stay(whole):
    assert len(restart.files(whole)) == 2


# ---- killed, and resumed --------------------------------------------------------------------------------------------

def family(pid):
    """A process and all that it has started."""
    found = [pid]
    for one in found:    # grows on the way
        for task in Path(f"/proc/{one}/task").glob("*/children"):
            try:
                found += map(int, task.read_text().split())
            except FileNotFoundError:
                pass
    return found


def kill(process):
    """SIGKILL to lammps-foam and LAMMPS."""
    for pid in reversed(family(process.pid)):
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
    process.wait()


def killed(directory, word, given, seen):
    """Start, and kill once seen() is true."""
    with open(directory.with_suffix(".screen"), "w") as screen:
        process = subprocess.Popen(command(word, *given), stdin=subprocess.DEVNULL, stdout=screen, stderr=screen)
        while not seen():
            assert process.poll() is None, directory.with_suffix(".screen").read_text()
        kill(process)


def reached(directory, step):
    """A test for it, by the last line of series.csv."""
    def seen():
        last = tables.last_line(directory / "series.csv")
        return last is not None and last[0].isdigit() and int(last.split(",")[0]) >= step
    return seen


def free(directory):
    """The lock is held until the last process has gone."""
    import fcntl
    with open(directory / "run.lock", "w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)


SAME = ["series.csv", "foam.lammpstrj", "last.lammpstrj", "results.csv", "complete"]


def assert_same(directory, other, names=SAME):
    for name in names:
        assert (directory / name).read_bytes() == (other / name).read_bytes(), name


def test_killed_and_resumed(whole, tmp_path):
    """Killed twice, the second time after resume; the end and all tables are the same, bit by bit."""
    directory = tmp_path / "foam"
    killed(directory, "run", arguments(directory), reached(directory, 2 * SAVE + 100))
    free(directory)
    killed(directory, "resume", [directory], reached(directory, 4 * SAVE + 100))
    free(directory)
    told = lammps_foam("resume", directory)
    assert "goes on from step" in told
    assert_same(directory, whole)
    snapshots = [path.name for path in whole.glob("bubbles.csv.*")]
    assert_same(directory, whole, snapshots)


def test_killed_before_the_first_restart_file_of_the_run(whole, tmp_path):
    """It goes on from the relaxed foam."""
    directory = tmp_path / "foam"
    killed(directory, "run", arguments(directory), reached(directory, 50))
    free(directory)
    for step, path in restart.files(directory):
        if step > 0:
            path.unlink()
    lammps_foam("resume", directory)
    assert_same(directory, whole)


def test_killed_in_the_relaxation(tmp_path):
    """It begins again, and nothing is lost."""
    changes = {"stabilization.maxDeltaEnergy": 1e-20}
    options = ["--", "-var", "rounds", "20"]
    other = tmp_path / "other"
    lammps_foam("run", *arguments(other, changes), *options)
    directory = tmp_path / "foam"

    def seen():
        log = directory / "log.foam"
        return log.exists() and "round 3," in log.read_text()

    killed(directory, "run", [*arguments(directory, changes), *options], seen)
    free(directory)
    if not restart.files(directory):    # it may have come further before it was killed
        assert "it begins again" in lammps_foam("resume", directory)
    else:
        lammps_foam("resume", directory)
    assert_same(directory, other)


def test_the_newest_restart_file_is_cut(whole, tmp_path):
    """The one before is taken; and the same if LAMMPS alone sees that something is wrong."""
    directory = tmp_path / "foam"
    killed(directory, "run", arguments(directory), reached(directory, 3 * SAVE + 60))
    free(directory)
    (_, newest), (step, _), *_ = restart.files(directory)
    raw = newest.read_bytes()
    newest.write_bytes(raw[:len(raw) // 2])
    plan = restart.plan(directory)
    assert f"goes on from step {step}" in plan.told
    newest.write_bytes(raw[:len(raw) // 2] + restart.MAGIC)    # with an end, but what is before it lacks
    told = lammps_foam("resume", directory)
    assert f"{newest} is refused by LAMMPS" in told and f"goes on from step {step}" in told
    assert_same(directory, whole)


def test_interrupted(tmp_path):
    """Ctrl-C keeps all that has been computed, and the table has neither gap nor double line afterwards."""
    directory = tmp_path / "foam"
    process = subprocess.Popen(command("run", *arguments(directory)), stdin=subprocess.DEVNULL, text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    while not reached(directory, SAVE)():
        assert process.poll() is None
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate()
    assert process.returncode == 130, out
    last = int(column(directory, "step")[-1])
    assert restart.files(directory)[0][0] == last
    assert f"goes on from step {last}" in lammps_foam("resume", directory)
    steps = column(directory, "step")
    assert np.all(np.diff(steps)[:-1] == 50) and column(directory, "N")[-1] == 60


def test_complete(whole):
    """Said, and nothing is touched."""
    before = {path.name: path.read_bytes() for path in whole.iterdir()}
    assert "nothing is left to do" in lammps_foam("resume", whole)
    assert "there is a run already" in lammps_foam("run", *arguments(whole), status=1)
    assert {path.name: path.read_bytes() for path in whole.iterdir()} == before


# ---- what an input may say ------------------------------------------------------------------------------------------

TINY = {"bubbles.numStart": 64, "bubbles.numEnd": 60}


@pytest.mark.parametrize("changes, options", [
    ({"box.wall.x": 1, "box.wall.y": 1}, ["--gzip"]),
    ({"box.dimensionality": 3, "box.wall.z": 1, "box.relativeDimensions.z": 2.0, "constants.phi.value": 0.7}, []),
    ({"flow.impose": 1, "flow.velocity.x": 1e-3, "bubbles.numEnd": 63}, ["--integrator", "rkc"]),
    ({"bubbles.radius.mean": 2.5, "bubbles.radius.std": 0.0, "constants.kappa.value": 0.0, "bubbles.numEnd": 63,
      "constants.sigma.value": 2.0, "constants.mu.value": 0.5, "constants.phi.value": 1.1}, ["--integrator", "rkc"]),
])
def test_other_inputs(tmp_path, changes, options):
    """LAMMPS takes them; the box has the proportions and the gas fraction of the input."""
    directory = tmp_path / "foam"
    changes = {**TINY, **changes}
    if changes.get("bubbles.radius.std") == 0.0:    # all are alike, and none vanishes soon: so another end
        changes["bubbles.radius.std"] = 0.02
        changes["constants.K.value"] = 1.0
    lammps_foam("run", *arguments(directory, changes), *options)
    assert column(directory, "N")[-1] <= changes["bubbles.numEnd"]
    frame = list(tables.frames(directory / "last.lammpstrj"))[-1]
    dim = changes.get("box.dimensionality", 2)
    sides = np.array([hi - lo for lo, hi, *_ in frame.bounds])[:dim]
    assert np.allclose(sides / sides[0], [1.0, 1.0, changes.get("box.relativeDimensions.z", 1.0)][:dim], rtol=1e-12)
    assert np.allclose(column(directory, "phi"), changes.get("constants.phi.value", 0.9), rtol=1e-10)
    if options == ["--gzip"]:
        assert len(list(tables.frames(directory / "foam.lammpstrj.gz"))) >= 1


def test_ranks(tmp_path):
    """Several ranks agree on when to write restart files, and a killed run goes on with as many, bit by bit."""
    options = ["--np", 2, "--save-steps", 100]
    changes = {"bubbles.numEnd": 97}
    other = tmp_path / "other"
    lammps_foam("run", *arguments(other, changes), *options)
    directory = tmp_path / "foam"
    killed(directory, "run", [*arguments(directory, changes), *options], reached(directory, 250))
    free(directory)
    lammps_foam("resume", directory, "--np", 2)
    assert_same(directory, other)
    timed = tmp_path / "timed"
    source, *given = arguments(timed, changes)[:-2]
    lammps_foam("run", source, *given, "--np", 2, "--save", 1e-3)
    assert len(restart.files(timed)) == 2 and column(timed, "N")[-1] == 97


def test_gzip_is_resumed(tmp_path):
    """A packed dump that was cut in the middle goes on, and holds the frames of one that was not."""
    other = tmp_path / "other"
    lammps_foam("run", *arguments(other, {"snapShot.frequency": 50}), "--gzip")
    directory = tmp_path / "foam"
    killed(directory, "run", [*arguments(directory, {"snapShot.frequency": 50}), "--gzip"], reached(directory, 900))
    free(directory)
    lammps_foam("resume", directory)
    assert_same(directory, other, ["series.csv", "last.lammpstrj"])
    found, wanted = (list(tables.frames(one / "foam.lammpstrj.gz")) for one in (directory, other))
    assert found == wanted


def test_flat_form(whole, tmp_path):
    """It means the same foam: with the first step of the other form it is the same run."""
    directory = tmp_path / "foam"
    lammps_foam("run", *arguments(directory, {"timeStepIn": 1e-4}, FLAT))
    assert_same(directory, whole, ["series.csv", "last.lammpstrj"])


def test_dry_run(tmp_path):
    """The input runs by hand, too."""
    directory = tmp_path / "foam"
    lammps_foam("run", *arguments(directory, TINY), "--dry-run")
    done = subprocess.run([program("FOAM_LMP_WHEEL"), "-in", "in.foam"], cwd=directory, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout[-2000:]
    assert "nothing is left to do" in lammps_foam("resume", directory)
