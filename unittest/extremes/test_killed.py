"""A run that is killed goes on from its last restart file as if nothing had happened."""

import os
import random
import re
import signal
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest

from conftest import program
from scenes import FULL, INTEGRATORS, anywhere, cases, last

EVERY, STEPS = 5, 800
KILLS = 20 if FULL else 1


def status(pid):
    """State and parent of a process, or that of none."""
    try:
        words = (Path("/proc") / str(pid) / "stat").read_text().rsplit(")", 1)[1].split()
    except (FileNotFoundError, ProcessLookupError):
        return "X", 0
    return words[0], int(words[1])


def family(pid):
    """A process and all that it has started: the ranks of mpiexec have sessions of their own."""
    children = {}
    for path in Path("/proc").glob("[0-9]*"):
        children.setdefault(status(path.name)[1], []).append(int(path.name))
    found = [pid]
    for one in found:    # grows on the way
        found += children.get(one, [])
    return found


def killed(lmp, directory, text, delay, ranks):
    """Start LAMMPS, end it by SIGKILL after a while; True if it had not ended by itself."""
    (directory / "in.killed").write_text(text)
    command = [lmp.program, *lmp.backend.args, "-in", "in.killed"]
    if ranks > 1:
        command = [program("FOAM_MPIEXEC"), "-n", str(ranks)] + command
    with subprocess.Popen(command, cwd=directory, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL) as process:
        before = files(directory)
        for _ in range(3000):    # a restart file of its own, then some time
            if process.poll() is not None or files(directory) != before:
                break
            time.sleep(0.01)
        time.sleep(delay)
        ended = process.poll() is not None
        if not ended:
            pids = family(process.pid)
            for pid in pids:
                try:
                    os.kill(pid, signal.SIGKILL)
                except ProcessLookupError:
                    pass
            for _ in range(1000):    # before they are, they write on
                if all(status(pid)[0] in "ZX" for pid in pids):
                    break
                time.sleep(0.01)
            else:
                pytest.fail("processes live on after SIGKILL")
    return not ended


def files(directory):
    return {path.name: path.stat().st_mtime_ns for path in directory.glob("state.*")}


@cases("ranks, integrator", [1, 2], INTEGRATORS)
def test_killed_and_continued(lmp, integrator, ranks):
    """Killed at any time, also while a restart file is written: of two files that are written in
    turn, and a copy of the one that the run began with, one can be read, and the others too or are
    refused. The end is the same bit by bit."""
    # steps that write a restart build lists, so the whole run has to write them, too
    scene = anywhere(2, 60, 0.9, integrator=integrator, K=0.01, run=STEPS, every=50,
                     after=f"restart {EVERY} state.a state.b")
    whole = scene(lmp, ranks=ranks)
    end = last(whole)
    steps = int(end.step)
    assert steps > 20 * EVERY
    took = float(re.search(r"Loop time of (\S+)", whole.screen)[1])

    delays, kills = random.Random(5), 0
    for kill in range(KILLS):
        directory = lmp.directory / f"killed{kill}"
        directory.mkdir()
        for name, text in scene.files().items():
            (directory / name).write_text(text)
        text, refused = scene.input(), 0
        for life in range(3):
            kills += killed(lmp, directory, text, delays.uniform(0.0, 0.5 * took), ranks)
            # The newest that can be read. A file read must not be written over before the next one is
            # there: a life that ends in its first restart file leaves none but the one that it came from.
            names = sorted(files(directory), key=files(directory).get, reverse=True)
            names += [f"kept{life - 1}"] if life else []
            for name in names:
                kept = f"kept{life}"
                (directory / kept).write_bytes((directory / name).read_bytes())
                check = lmp(scene.begin() + f"read_restart {kept} noremap\n", check=False,
                                 directory=directory, ranks=ranks, timeout=30)
                if check.returncode == 0:
                    break
                assert check.errors, check.screen
                refused += 1
            assert check.returncode == 0, "no restart file can be read"
            text = scene.continued(kept, f"{STEPS} upto")
        result = lmp(text, directory=directory, ranks=ranks)
        again = result.dump("last2")[0]
        assert again.step == steps
        for name in again._columns:
            assert np.array_equal(again[name], end[name]), name
        print(f"kill {kill}: {refused} files refused")
    # of three lives at least the first, which is not half done, unless the machine has become faster since
    assert kills >= KILLS


@cases("ranks", [1, 2])
def test_cut_restart_file(lmp, ranks):
    """A restart file that ends too early is refused, wherever it ends."""
    scene = anywhere(2, 60, 0.9, run=50, after="restart 50 state.*")
    result = scene(lmp, ranks=ranks)
    whole = (result.directory / "state.50").read_bytes()
    for end in np.linspace(0, len(whole) - 1, 40 if FULL else 5).astype(int):
        (result.directory / "cut").write_bytes(whole[:end])
        cut = lmp(scene.continued("cut", 10), directory=result.directory, ranks=ranks,
                       check=False, timeout=30)
        assert cut.returncode > 0, f"{end} of {len(whole)} bytes"
        assert cut.errors, cut.screen
