"""Run LAMMPS in a directory: progress, Ctrl-C, a full disk, and what came of it."""

from __future__ import annotations

import fcntl
import os
import shlex
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType
from typing import IO, Any

from . import restart, tables
from .thesis_input import Unusable

POLL = 0.2        # s between looks at the process
LOOK = 1.0        # s between looks at the files
SPARE = 20_000_000    # bytes that stay free beside the next files


def find_lammps(lmp: str | None) -> list[str]:
    """The command that is LAMMPS: the one given, or the lammps-foam lmp of this environment."""
    if lmp is not None:
        words = shlex.split(lmp)
        if not words or shutil.which(words[0]) is None:
            raise Unusable(f"--lmp {lmp}: there is no such program")
        return [str(Path(shutil.which(words[0]) or words[0]).absolute()), *words[1:]]
    return [sys.executable, "-c", "import sys; from lammps_foam.command import lmp; lmp(sys.argv[1:])"]


def find_mpiexec(ranks: int, lammps: Sequence[str]) -> list[str]:
    """The command that starts so many ranks: that beside LAMMPS or Python, or the first on PATH."""
    if ranks == 1:
        return []
    beside = [Path(word).with_name("mpiexec") for word in (*lammps, sys.executable) if os.path.isabs(word)]
    # without links: an mpiexec of MPICH looks for its helpers where it is called
    found = next((str(path.resolve()) for path in beside if os.access(path, os.X_OK)), None) or shutil.which("mpiexec")
    if found is None:
        raise Unusable(f"--np {ranks}: there is no mpiexec beside {lammps[0]} or on PATH; give it by --lmp "
                       f"'mpiexec -n {ranks} lmp'")
    return [found, "-n", str(ranks)]


def styles(lammps: Sequence[str]) -> str:
    """What LAMMPS says that it has."""
    try:
        done = subprocess.run([*lammps, "-h"], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=300)
    except OSError as error:
        raise Unusable(f"{lammps[0]}: cannot be run: {error.strerror}") from None
    if done.returncode or "LAMMPS" not in done.stdout and "Massively Parallel Simulator" not in done.stdout:
        told = (done.stderr.strip() or done.stdout.strip() or f"it ended with {done.returncode}").splitlines()[-1]
        raise Unusable(f"{' '.join(lammps[:1])}: is not LAMMPS, or does not run: {told}")
    return done.stdout


def readable(lammps: Sequence[str], path: Path) -> str | None:
    """What LAMMPS says against a restart file; None if nothing."""
    done = subprocess.run([*lammps, "-restart2info", path.name, "-log", "none"], cwd=path.parent,
                          stdin=subprocess.DEVNULL, capture_output=True, text=True)
    errors = [line for line in (done.stdout + done.stderr).splitlines() if "ERROR" in line]
    if done.returncode == 0 and not errors:
        return None
    return f"is refused by LAMMPS: {errors[0] if errors else f'it ended with {done.returncode}'}"


class Lock:
    """One run at a time in a directory. LAMMPS inherits it: so it holds for as long as LAMMPS lives."""

    def __init__(self, directory: Path) -> None:
        self.file: IO[str] = open(directory / "run.lock", "w")
        try:
            fcntl.flock(self.file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise Unusable(f"{directory}: a run is going on there") from None

    def __enter__(self) -> Lock:
        return self

    def __exit__(self, *_: object) -> None:
        self.file.close()


def say(text: str, out: IO[str] | None = None) -> None:
    """Print a line; if nobody reads any more (`| head`), the run goes on."""
    try:
        print(text, file=out or sys.stdout, flush=True)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), (out or sys.stdout).fileno())


# ---- progress -------------------------------------------------------------------------------------------------------

def clock(seconds: float) -> str:
    minutes, s = divmod(int(seconds + 0.5), 60)
    hours, m = divmod(minutes, 60)
    return f"{hours}:{m:02d}:{s:02d}"


@dataclass
class Progress:
    """Numbers of bubbles at times, for an estimate of the time to go."""
    end: float
    seen: list[tuple[float, float]] = field(default_factory=list)

    def add(self, seconds: float, bubbles: float) -> None:
        self.seen.append((seconds, bubbles))

    def to_go(self) -> float | None:
        """Seconds, if bubbles vanish as fast as in the second half of the time so far; None if none has."""
        if not self.seen:
            return None
        now, bubbles = self.seen[-1]
        at, before = next(one for one in self.seen if one[0] >= 0.5 * (now + self.seen[0][0]))
        if before <= bubbles:
            at, before = self.seen[0]
        if before <= bubbles:
            return None
        return max(0.0, (bubbles - self.end) * (now - at) / (before - bubbles))


class Display:
    """One line that changes on a terminal; elsewhere lines that get rarer."""

    def __init__(self, out: IO[str]) -> None:
        self.out, self.terminal = out, out.isatty()
        self.next, self.shown = 0.0, ""

    def show(self, seconds: float, text: str) -> None:
        if text == self.shown:
            return
        if self.terminal:
            print(f"\r{text:<{len(self.shown)}}", end="", file=self.out, flush=True)
        elif seconds >= self.next:
            say(text, self.out)
            self.next = seconds + min(600.0, max(5.0, 0.25 * seconds))
        else:
            return
        self.shown = text

    def tell(self, text: str) -> None:
        if self.terminal and self.shown:
            print(file=self.out)
        self.shown = ""
        say(text, self.out)


# ---- one run --------------------------------------------------------------------------------------------------------

@dataclass
class Ended:
    """How LAMMPS ended: complete, or why not."""
    complete: bool
    interrupted: bool
    message: str
    full: bool = False    # the disk


class Run:
    """LAMMPS in a directory, from its start to its end."""

    def __init__(self, directory: Path, command: list[str], end: int, out: IO[str]) -> None:
        self.directory, self.command = directory, command
        self.progress, self.display = Progress(end), Display(out)
        self.process: subprocess.Popen[bytes] | None = None
        self.asked = 0                    # how often Ctrl-C has been pressed
        self.full = False                 # the disk
        self.before = tables.size(directory / "series.csv")    # what an earlier run has written

    def __call__(self, lock: Lock) -> Ended:
        stop = self.directory / "stop"
        stop.unlink(missing_ok=True)
        kept = {number: signal.signal(number, self._signal)
                for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)}
        try:
            with open(self.directory / "errors", "wb") as errors:
                self.process = subprocess.Popen(self.command, cwd=self.directory, stdin=subprocess.DEVNULL,
                                                stdout=errors, stderr=errors, start_new_session=True,
                                                pass_fds=[lock.file.fileno()])
                self._watch()
        except OSError as error:
            raise Unusable(f"{self.command[0]}: cannot be run: {error.strerror}") from None
        finally:
            for number, handler in kept.items():
                signal.signal(number, handler)
            stop.unlink(missing_ok=True)
            restart.prune(self.directory)
        return self._ended()

    # Ctrl-C in a terminal would reach LAMMPS, too, and end it at once: so LAMMPS has a session of its own, and gets it
    # from here. The first asks LAMMPS to save its state and to end, if it is so far, later ones end it at once.
    def _signal(self, number: int, _: FrameType | None) -> None:
        self.asked += 1
        if self.process is None:
            raise KeyboardInterrupt
        if number == signal.SIGINT and self.asked == 1 and restart.files(self.directory):
            (self.directory / "stop").touch()
            self.display.tell("LAMMPS saves its state and ends; Ctrl-C again ends it at once")
        else:
            self._kill(signal.SIGINT if number == signal.SIGINT and self.asked < 3 else signal.SIGTERM)

    def _kill(self, number: int) -> None:
        assert self.process is not None
        try:
            os.killpg(self.process.pid, number)
        except ProcessLookupError:
            pass

    def _watch(self) -> None:
        assert self.process is not None
        begun = time.monotonic()
        looked = begun
        while self.process.poll() is None:
            time.sleep(POLL)
            now = time.monotonic()
            if now - looked >= LOOK:
                looked = now
                self.display.show(now - begun, self._status(now - begun))
                restart.prune(self.directory)
                self._look_at_disk()

    def _status(self, seconds: float) -> str:
        series = self.directory / "series.csv"
        row = {}
        if tables.size(series) > self.before or self.before:
            names = _first_line(series).split(",")
            row = tables.values(names, tables.last_line(series) or "")
        if not row:
            return f"{clock(seconds)}  {self._relaxation()}"
        self.progress.add(seconds, row["N"])
        to_go = self.progress.to_go()
        text = f"{clock(seconds)}  tau {row['tau']:.4g}  N {row['N']:.0f} -> {self.progress.end:.0f}"
        return f"{text}  <R> {row['R']:.4g}" + (f"  to go {clock(to_go)}" if to_go is not None else "")

    def _relaxation(self) -> str:
        told = [line for line in _tail(self.directory / self.log).splitlines() if line.startswith("Relax_foam: round")]
        return "relaxation" + (told[-1][len("Relax_foam"):] if told else "")

    @property
    def log(self) -> str:
        return self.command[self.command.index("-log") + 1]

    def _look_at_disk(self) -> None:
        """Stop while there is still room for a restart file."""
        free = shutil.disk_usage(self.directory).free
        newest = max([tables.size(path) for _, path in restart.files(self.directory)], default=0)
        if not self.full and free < SPARE + 3 * newest:
            self.full = True
            self.display.tell(f"{self.directory}: the disk is nearly full, {free / 1e6:.0f} MB are free; LAMMPS saves "
                              "its state and ends")
            (self.directory / "stop").touch()

    def _ended(self) -> Ended:
        assert self.process is not None
        if self.display.terminal and self.display.shown:
            print(file=self.display.out)
        code = self.process.returncode
        finished = self.directory / "complete"
        if finished.exists() and tables.size(finished) > 0:
            return Ended(True, False, finished.read_text().strip().lstrip("- "))
        errors = [line for line in (_tail(self.directory / self.log) + _tail(self.directory / "errors")).splitlines()
                  if line.startswith("ERROR") or "Error:" in line]
        if self.asked or code == 0:
            if self.full:
                return Ended(False, True, "stopped, since the disk is nearly full: make room", True)
            return Ended(False, True, "interrupted")
        if code < 0:
            why = f"LAMMPS was ended by signal {-code} ({signal.strsignal(-code)})"
        else:
            why = f"LAMMPS ended with {code}"
        return Ended(False, False, f"{why}{': ' + errors[0] if errors else ''}; see {self.directory / self.log} and "
                                   f"{self.directory / 'errors'}")


def _first_line(path: Path) -> str:
    try:
        with open(path, encoding="ascii", errors="replace") as file:
            return file.readline().rstrip("\n")
    except OSError:
        return ""


def _tail(path: Path, most: int = 20_000) -> str:
    try:
        with open(path, "rb") as file:
            file.seek(max(0, tables.size(path) - most))
            return file.read().decode("utf-8", "replace")
    except OSError:
        return ""


def arguments(lammps: list[str], ranks: int, name: str, log: str, extra: Sequence[str]) -> list[str]:
    return [*find_mpiexec(ranks, lammps), *lammps, "-in", name, "-log", log, "-screen", "none", *extra]


def new_log(directory: Path) -> str:
    """log.foam, log.foam.1, ...: the first that is not there."""
    number, name = 0, "log.foam"
    while (directory / name).exists():
        number += 1
        name = f"log.foam.{number}"
    return name


def settings(data: dict[str, Any]) -> tuple[list[str], int, list[str]]:
    """LAMMPS, ranks and further arguments of a run, as run.json has them."""
    return list(data["lmp"]), int(data["np"]), list(data["arguments"])
