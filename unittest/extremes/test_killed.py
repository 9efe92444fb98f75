"""A run that is killed goes on from its last restart file as if nothing had happened.

Steps and bytes say where a run is killed, not a time. Through a pipe LAMMPS tells each step that writes
a restart file, in lines longer than the pipe holds: so it waits in that step until the line is read.
The restart file that is to be cut is a pipe, too.
"""

import fcntl
import os
import random
import select
import signal
import subprocess
from pathlib import Path

import numpy as np

from runner import HANG, program
from scenes import FULL, INTEGRATORS, anywhere, cases, last

EVERY, STEPS = 5, 800
KILLS = 20 if FULL else 1
# where lives end, in turn
ENDS = ["while a restart file is written", "while the first one of this life is written",
        "after a restart file, or while it is written"]


def parent(pid):
    """Of a process, 0 if it has gone."""
    try:
        return int((Path("/proc") / str(pid) / "stat").read_text().rsplit(")", 1)[1].split()[1])
    except (FileNotFoundError, ProcessLookupError):
        return 0


def family(pid):
    """A process and all that it has started: the ranks of mpiexec have sessions of their own."""
    children = {}
    for path in Path("/proc").glob("[0-9]*"):
        children.setdefault(parent(path.name), []).append(int(path.name))
    found = [pid]
    for one in found:    # grows on the way
        found += children.get(one, [])
    return found


def kill(pid):
    """SIGKILL to a process and its family; afterwards none of them writes any more."""
    handles = []
    for one in family(pid):
        try:
            handles.append(os.pidfd_open(one))
            signal.pidfd_send_signal(handles[-1], signal.SIGKILL)
        except ProcessLookupError:
            pass
    for handle in handles:    # readable when the process has ended
        ended, _, _ = select.select([handle], [], [], HANG)
        os.close(handle)
        assert ended, "a process lives on after SIGKILL"


class Pipe:
    """A named pipe that LAMMPS writes to as to a file."""

    def __init__(self, path):
        path.unlink(missing_ok=True)
        os.mkfifo(path)
        self.end = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
        fcntl.fcntl(self.end, fcntl.F_SETPIPE_SZ, 1)    # as small as they come
        self.size = fcntl.fcntl(self.end, fcntl.F_GETPIPE_SZ)
        self.poll = select.poll()
        self.poll.register(self.end, select.POLLIN)

    def read(self, most):
        """What comes next, up to so many bytes; nothing when LAMMPS has closed it."""
        assert self.poll.poll(1000.0 * HANG), f"LAMMPS wrote nothing for {HANG} s"
        return os.read(self.end, most)


class Life:
    """LAMMPS from the start of a run to SIGKILL, at the end of the with statement."""

    def __init__(self, lmp, directory, text, ranks):
        self.directory = directory
        self.steps = Pipe(directory / "steps")
        self.pipes = [self.steps]
        # Three times what the pipe holds: with a third of it read, it cannot be written to its end. No
        # other steps, since output takes out removed bubbles, and the whole run has none there
        tell = (f'fix tell all print {EVERY} "at $(step) {3 * self.steps.size * "."}" '
                'file steps screen no')
        (directory / "in.killed").write_text(text.replace("\nfix ", f"\n{tell}\nfix ", 1))
        self.command = [lmp.program, *lmp.backend.args, "-in", "in.killed"]
        if ranks > 1:
            self.command = [program("FOAM_MPIEXEC"), "-n", str(ranks)] + self.command

    def __enter__(self):
        with open(self.directory / "screen", "w") as screen:
            self.process = subprocess.Popen(self.command, cwd=self.directory, stdin=subprocess.DEVNULL,
                                            stdout=screen, stderr=subprocess.STDOUT)
        return self

    def __exit__(self, *_):
        ended = self.process.poll()
        kill(self.process.pid)
        self.process.wait()
        for pipe in self.pipes:    # not before: LAMMPS would notice
            os.close(pipe.end)
        assert ended is None, "LAMMPS had ended by itself"

    def wait_for(self, step):
        """LAMMPS is in this step, and writes a restart file next."""
        seen = b""
        while f"\nat {step} ".encode() not in seen:
            new = self.steps.read(self.steps.size)
            assert new, (self.directory / "screen").read_text()[-3000:]
            seen = seen[-20:] + new

    def release(self):
        """LAMMPS goes on, until it has another step to tell."""
        while not self.steps.read(self.steps.size).endswith(b"\n"):
            pass

    def beginning_of(self, name, most):
        """The first bytes of the file that is written next; LAMMPS finds nobody who takes the others."""
        pipe, content = Pipe(self.directory / name), b""
        self.pipes.append(pipe)
        self.release()
        while len(content) < most:
            new = pipe.read(most - len(content))
            if not new:
                break
            content += new
        return content


def step_of(lmp, scene, directory, name, ranks):
    """The step that a restart file is of; None if LAMMPS refuses it, with an error."""
    check = lmp(scene.begin() + f'read_restart {name} noremap\nprint "step of the file: $(step)"\n',
                check=False, directory=directory, ranks=ranks)
    if check.returncode:
        assert check.errors, check.screen
        return None
    return int(check.screen.split("step of the file: ")[-1].split()[0])


@cases("ranks, integrator", [1, 2], INTEGRATORS)
def test_killed_and_continued(lmp, integrator, ranks):
    """Killed at any step, also while a restart file is written: of two files that are written in
    turn, and a copy of the one that the run began with, one can be read, and the others too or are
    refused. The end is the same bit by bit."""
    # steps that write a restart build lists, so the whole run has to write them, too
    scene = anywhere(2, 60, 0.9, integrator=integrator, K=0.01, run=STEPS, every=50,
                     after=f"restart {EVERY} state.a state.b")
    whole = scene(lmp, ranks=ranks)
    end = last(whole)
    steps = int(end.step)
    assert steps > 40 * EVERY

    draw = random.Random(5)
    for number in range(KILLS):
        directory = lmp.directory / f"killed{number}"
        directory.mkdir()
        for name, text in scene.files().items():
            (directory / name).write_text(text)
        text, begun, refused = scene.input(), 0, 0
        for life in range(3):
            where = ENDS[(life + number) % 3]
            # which restart file of this life; the first life leaves a whole one before it
            first = 1 if life else 2
            turn = draw.randrange(first, (steps - begun) // EVERY // (3 - life))
            if "first" in where:
                turn = first
            file = directory / ("state.a" if turn % 2 else "state.b")
            begun += turn * EVERY
            with Life(lmp, directory, text, ranks) as run:
                run.wait_for(begun)
                if "after" in where:
                    run.release()    # and it is killed at once
                else:
                    files = [*directory.glob("state.*"), *directory.glob("kept*")]
                    longest = max(path.stat().st_size for path in files)
                    content = run.beginning_of(file.name, draw.randrange(longest))
            if "after" not in where:
                file.unlink()
                file.write_bytes(content)

            # A file read must not be written over before the next one is there: a life that ends in
            # its first restart file leaves none but the one that it came from.
            names = ["state.a", "state.b"] + ([f"kept{life - 1}"] if life else [])
            found = {name: step_of(lmp, scene, directory, name, ranks) for name in names}
            refused += list(found.values()).count(None)
            read = {step: name for name, step in found.items() if step is not None}
            assert read, "no restart file can be read"
            # and nothing is lost but what came after the one before
            assert max(read) >= begun - EVERY
            begun = max(read)
            kept = f"kept{life}"
            (directory / kept).write_bytes((directory / read[begun]).read_bytes())
            text = scene.continued(kept, f"{STEPS} upto")
            print(f"kill {number}: {where}, goes on at step {begun}")
        result = lmp(text, directory=directory, ranks=ranks)
        again = result.dump("last2")[0]
        assert again.step == steps
        for name in again._columns:
            assert np.array_equal(again[name], end[name]), name
        print(f"kill {number}: {refused} files refused")


@cases("ranks", [1, 2])
def test_cut_restart_file(lmp, ranks):
    """A restart file that ends too early is refused, wherever it ends."""
    scene = anywhere(2, 60, 0.9, run=50, after="restart 50 state.*")
    result = scene(lmp, ranks=ranks)
    whole = (result.directory / "state.50").read_bytes()
    for end in np.linspace(0, len(whole) - 1, 40 if FULL else 5).astype(int):
        (result.directory / "cut").write_bytes(whole[:end])
        cut = lmp(scene.continued("cut", 10), directory=result.directory, ranks=ranks,
                       check=False)
        assert cut.returncode > 0, f"{end} of {len(whole)} bytes"
        assert cut.errors, cut.screen
