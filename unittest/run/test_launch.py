"""LAMMPS is started, watched and stopped as it should be. A script plays LAMMPS: it does what a test tells it to do."""

import io
import json
import os
import shutil
import signal
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

from lammps_foam.run import launch, words
from thesis import written

PLAY = '''
import os, signal, sys, time
from pathlib import Path
if "-h" in sys.argv:
    print("Large-scale Atomic/Molecular Massively Parallel Simulator - LAMMPS")
    sys.exit()
MAGIC = b"LammpS RestartT\\0"
log = Path(sys.argv[sys.argv.index("-log") + 1]) if "-log" in sys.argv else None
def restart(step):
    Path(f"restart.{step}").write_bytes(MAGIC + b"state" + MAGIC)
def wait_for(name):
    while not Path(name).exists():
        time.sleep(0.01)
if "-restart2info" in sys.argv:
    sys.exit()
'''


@pytest.fixture
def player(tmp_path):
    """player(TEXT) is the command line of a LAMMPS that does TEXT."""
    def make(text):
        script = tmp_path / "lmp.py"
        script.write_text(PLAY + textwrap.dedent(text))
        return f"{sys.executable} {script}"
    return make


@pytest.fixture
def start(tmp_path, player, capsys):
    """start(TEXT): the exit status of lammps-foam run, and what it prints."""
    def run(text, *options, out="out"):
        lmp = player(text)
        given = [str(written(tmp_path / "foam.json")), "--out", str(tmp_path / out), "--lmp", lmp, *options]
        status = words.run(given)
        shown = capsys.readouterr()
        return status, shown.out, shown.err
    return run


COMPLETE = 'Path("complete").write_text("--- complete: step 7")\n'


def test_complete(start, tmp_path):
    status, out, err = start(COMPLETE, "--", "-var", "every", "7")
    assert status == 0 and "complete: step 7" in out and not err
    record = json.loads((tmp_path / "out" / "run.json").read_text())
    assert record["arguments"] == ["-var", "every", "7"] and record["np"] == 1
    assert (tmp_path / "out" / "input.json").read_text() == (tmp_path / "foam.json").read_text()
    assert words.resume([str(tmp_path / "out")]) == 0


def test_nothing_is_overwritten(start, tmp_path):
    start(COMPLETE)
    before = {path: path.read_bytes() for path in (tmp_path / "out").iterdir()}
    status, _, err = start(COMPLETE)
    assert status == 1 and "there is a run already (in.foam): lammps-foam resume" in err
    assert before == {path: path.read_bytes() for path in (tmp_path / "out").iterdir()}


def test_dry_run(start, tmp_path, capsys):
    """It can be looked at, changed, and started by resume."""
    status, out, _ = start('Path("arguments").write_text(" ".join(sys.argv[1:]))\n' + COMPLETE, "--dry-run")
    assert status == 0 and not (tmp_path / "out" / "log.foam").exists() and "in.foam is written" in out
    assert words.resume([str(tmp_path / "out")]) == 0
    assert (tmp_path / "out" / "arguments").read_text() == "-in in.foam -log log.foam -screen none"


def test_error_of_lammps(start):
    status, _, err = start('log.write_text("x\\nERROR: no such pair style (src/force.cpp:1)\\n")\nsys.exit(1)')
    assert status == 1 and "LAMMPS ended with 1: ERROR: no such pair style" in err and "begins again" in err
    assert err.count("\n") == 2


def test_lammps_is_killed(start):
    status, _, err = start("restart(0)\nos.kill(os.getpid(), signal.SIGKILL)", out="other")
    assert status == 1 and "LAMMPS was ended by signal 9 (Killed)" in err and "goes on" in err


def test_too_large_a_file(start):
    """As with a limit on the size of files, or a quota."""
    status, _, err = start("""
        import resource
        signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
        resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
        open("foam.lammpstrj", "wb").write(bytes(2000))
    """)
    assert status == 1 and "File size limit exceeded" in err


def test_disk_full(start, monkeypatch):
    """LAMMPS is stopped while there is room for its state."""
    usage = shutil.disk_usage("/")
    monkeypatch.setattr(launch.shutil, "disk_usage", lambda path: usage._replace(free=5_000_000))
    monkeypatch.setattr(launch, "LOOK", 0.0)
    status, out, err = start('wait_for("stop")\nrestart(50)')
    assert status == 130 and "the disk is nearly full, 5 MB are free" in out
    assert "stopped, since the disk is nearly full" in err


def test_is_not_lammps(tmp_path, capsys):
    given = [str(written(tmp_path / "foam.json")), "--out", str(tmp_path / "out")]
    assert words.run([*given, "--lmp", "false"]) == 1
    assert "is not LAMMPS" in capsys.readouterr().err
    assert words.run([*given, "--lmp", "no-such-program"]) == 1
    assert "there is no such program" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_no_gzip(start, tmp_path):
    status, _, err = start("", "--gzip")
    assert status == 1 and "no dump custom/gz" in err and not (tmp_path / "out").exists()


@pytest.mark.parametrize("options", [["--tol", "0"], ["--tol", "nan"], ["--np", "0"], ["--walls", "xw"],
                                     ["--np", "1.5"], ["--save", "-1"], ["--dimension", "4"],
                                     ["--integrator", "euler"]])
def test_wrong_options(start, options, capsys):
    with pytest.raises(SystemExit) as error:
        start("", *options)
    assert error.value.code == 2
    assert options[0] in capsys.readouterr().err.splitlines()[-1]


def test_damaged_record(start, tmp_path, capsys):
    start("sys.exit(1)")
    (tmp_path / "out" / "run.json").write_text("{")
    assert words.resume([str(tmp_path / "out")]) == 1
    assert "run.json: cannot be used" in capsys.readouterr().err
    assert words.resume([str(tmp_path / "none")]) == 1
    assert "there is no such directory" in capsys.readouterr().err


# ---- signals --------------------------------------------------------------------------------------------------------

def launched(tmp_path, player, text):
    """lammps-foam run, in a process of its own, when its LAMMPS has told that it is there."""
    code = "import sys; from lammps_foam.run import words; sys.exit(words.run(sys.argv[1:]))"
    process = subprocess.Popen([sys.executable, "-c", code, str(written(tmp_path / "foam.json")), "--out",
                                str(tmp_path / "out"), "--lmp", player(text + '\nPath("there").touch()\n' + WAIT)],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    while not (tmp_path / "out" / "there").exists():
        assert process.poll() is None, process.communicate()
    return process


WAIT = """
wait_for("stop")
restart(50)
"""
NEVER = 'wait_for("never")\n'


def test_ctrl_c(tmp_path, player):
    """LAMMPS is asked to save its state."""
    process = launched(tmp_path, player, "restart(0)")
    process.send_signal(signal.SIGINT)
    out, err = process.communicate()
    assert process.returncode == 130 and "saves its state" in out and "interrupted" in err
    assert (tmp_path / "out" / "restart.50").exists() and not (tmp_path / "out" / "stop").exists()


@pytest.mark.parametrize("restarts, signals", [("", [signal.SIGINT]), ("restart(0)", [signal.SIGTERM]),
                                               ("restart(0)", [signal.SIGINT, signal.SIGINT]),
                                               ("restart(0)", [signal.SIGHUP])])
def test_ended_at_once(tmp_path, player, restarts, signals):
    """Before there is a restart file, by Ctrl-C again, or when the batch system says so. LAMMPS does not live on."""
    text = f'{restarts}\nPath("pid").write_text(str(os.getpid()))\nPath("there").touch()\n{NEVER}'
    process = launched(tmp_path, player, text)
    pid = int((tmp_path / "out" / "pid").read_text())
    process.send_signal(signals[0])
    if len(signals) > 1:
        while not (tmp_path / "out" / "stop").exists():    # the first has arrived
            pass
        process.send_signal(signals[1])
    _, err = process.communicate()
    assert process.returncode == 130 and "interrupted" in err
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)


def test_one_run_at_a_time(tmp_path, player):
    """Also when lammps-foam was killed, and LAMMPS lives on."""
    process = launched(tmp_path, player, 'Path("pid").write_text(str(os.getpid()))\nrestart(0)')
    pid = int((tmp_path / "out" / "pid").read_text())
    process.kill()
    process.communicate()
    code = "import sys; from lammps_foam.run import words; sys.exit(words.resume(sys.argv[1:]))"
    again = subprocess.run([sys.executable, "-c", code, str(tmp_path / "out")], capture_output=True, text=True)
    assert again.returncode == 1 and "a run is going on there" in again.stderr
    os.kill(pid, signal.SIGKILL)


# ---- progress -------------------------------------------------------------------------------------------------------

def test_time_to_go():
    """Of bubbles that vanish evenly it is exact; nothing is told before one has vanished."""
    progress = launch.Progress(end=20)
    assert progress.to_go() is None
    for seconds in range(11):
        progress.add(seconds, 100 - 4 * seconds if seconds > 2 else 100)
        if seconds <= 2:
            assert progress.to_go() is None
    assert progress.to_go() == pytest.approx((60 - 20) / 4, rel=1e-12)
    progress.add(12, 19)
    assert progress.to_go() == 0


@pytest.mark.parametrize("seconds, text", [(0, "0:00:00"), (59.6, "0:01:00"), (3661, "1:01:01"), (90000, "25:00:00")])
def test_clock(seconds, text):
    assert launch.clock(seconds) == text


def test_display():
    """One line on a terminal, rarer lines elsewhere."""
    class Terminal(io.StringIO):
        def isatty(self):
            return True

    out = Terminal()
    display = launch.Display(out)
    for text in ("longer", "short"):
        display.show(0.0, text)
    assert out.getvalue() == "\rlonger\rshort "
    out = io.StringIO()
    display = launch.Display(out)
    for second in range(5000):
        display.show(float(second), str(second))
    told = list(map(int, out.getvalue().split()))
    gaps = [after - before for before, after in zip(told, told[1:])]
    assert told[0] == 0 and gaps == sorted(gaps) and gaps[0] == 5 and gaps[-1] == 600


def test_status(tmp_path):
    """Relaxation by the log; then the table, from which a line may be cut."""
    run = launch.Run(tmp_path, ["lmp", "-log", "log.foam"], 10, io.StringIO())
    assert run._status(1.0).endswith("relaxation")
    (tmp_path / "log.foam").write_text("a\nRelax_foam: round 3, energy 7\nb\n")
    assert run._status(1.0).endswith("relaxation: round 3, energy 7")
    (tmp_path / "series.csv").write_text("step,time,tau,N,R\n0,0,0,40,1\n50,3,0.5,30,1.1\n100,4")
    assert "tau 0.5  N 30 -> 10  <R> 1.1" in run._status(2.0)


def test_mpiexec(tmp_path, monkeypatch):
    (tmp_path / "mpiexec").write_text("#!/bin/sh\n")
    (tmp_path / "mpiexec").chmod(0o755)
    assert launch.find_mpiexec(1, []) == []
    assert launch.find_mpiexec(3, [str(tmp_path / "lmp")]) == [str(tmp_path.resolve() / "mpiexec"), "-n", "3"]
    monkeypatch.setattr(launch.sys, "executable", str(tmp_path / "none" / "python"))
    monkeypatch.setenv("PATH", str(Path("/nowhere")))
    with pytest.raises(launch.Unusable, match="no mpiexec"):
        launch.find_mpiexec(2, ["lmp"])
