"""Many inputs in one process of LAMMPS, through LAMMPS' C library: a thousand short ones take seconds,
where starting LAMMPS anew takes a third of a second each.

  process = SharedProcess(lmp, directory)           lmp: a Runner of conftest.py
  end = process(text, files={NAME: TEXT or BYTES})
  end.error        what LAMMPS said when it gave up, "" if it did not
  end.crash        what went wrong otherwise: a signal, a hang, a report of a sanitizer; "" if nothing
  end.screen       what LAMMPS wrote

Each input has a LAMMPS object of its own.  An input that ends the process, or hangs, ends it for
itself alone: the next one finds a new process.  Which library, and with which environment: the
program itself is asked, once.  Where it has none (a static executable), .available is False.

This file is also the program that runs in that process.
"""

import ctypes
import json
import os
import select
import signal
import subprocess
import sys
from pathlib import Path

HANG = 20.0              # s; an input here takes some ms
MEMORY = 4 << 30         # bytes that LAMMPS may ask for

# what the program sees: its environment, and the files that it has in memory
LOOK = """
shell 'env > environment'
shell 'cat /proc/$PPID/maps > maps'
"""


class End:
    def __init__(self, error="", crash="", screen=""):
        self.error, self.crash, self.screen = error, crash, screen


class SharedProcess:
    def __init__(self, lmp, directory):
        self.directory, self.inputs, self.process = directory, 0, None
        self.directory.mkdir(parents=True, exist_ok=True)
        seen = lmp(LOOK).directory
        maps = [line.split()[-1] for line in (seen / "maps").read_text().splitlines()]
        found = [path for path in maps if "/liblammps" in path]
        self.available = bool(found)
        self.environment = dict(line.split("=", 1) for line in
                                (seen / "environment").read_text().splitlines() if "=" in line)
        self.command = [sys.executable, __file__, *found[:1], *lmp.backend.args]

    def start(self):
        self.stderr = open(self.directory / "stderr", "w+")
        self.process = subprocess.Popen(
            self.command, env=self.environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            stderr=self.stderr, text=True, start_new_session=True)

    def stop(self):
        if self.process:
            os.killpg(self.process.pid, signal.SIGKILL)
            self.process.communicate()
            self.process = None

    def __call__(self, text, files=None):
        if not self.process:
            self.start()
        self.inputs += 1
        directory = self.directory / str(self.inputs)
        directory.mkdir()
        for name, content in {"in": text, **(files or {})}.items():
            write = Path.write_bytes if isinstance(content, bytes) else Path.write_text
            write(directory / name, content)
        self.process.stdin.write(f"{directory}\n")
        self.process.stdin.flush()
        answered, _, _ = select.select([self.process.stdout], [], [], HANG)
        line = self.process.stdout.readline() if answered else ""
        self.stderr.seek(0)
        said = self.stderr.read()
        screen = directory / "screen"
        screen = screen.read_text(errors="replace") if screen.exists() else ""
        if not answered:
            self.stop()
            return End(crash=f"did not end within {HANG} s", screen=screen)
        if not line:
            status = self.process.wait()
            self.process = None
            return End(crash=f"ended the process with status {status}: {said[-3000:]}", screen=screen)
        if "Sanitizer" in said or "runtime error" in said:
            self.stop()
            return End(crash=said, screen=screen)
        return End(error=json.loads(line), screen=screen)


# ---- in the other process -----------------------------------------------------------------------

def serve(library, args):
    """Run LAMMPS in each directory named on stdin; answer with its error."""
    if "Sanitizer" not in os.environ.get("LD_PRELOAD", "") and "asan" not in \
            os.environ.get("LD_PRELOAD", ""):    # those reserve far more than they use
        import resource
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    lammps = ctypes.CDLL(library, ctypes.RTLD_GLOBAL)
    lammps.lammps_open_no_mpi.restype = ctypes.c_void_p
    arguments = ["lmp", "-log", "none", "-nocite", "-screen", "screen", *args]
    argv = (ctypes.c_char_p * len(arguments))(*map(str.encode, arguments))
    message = ctypes.create_string_buffer(1 << 16)
    for line in sys.stdin:
        os.chdir(line.strip())
        handle = ctypes.c_void_p(lammps.lammps_open_no_mpi(len(arguments), argv, None))
        lammps.lammps_file(handle, b"in")
        error = ""
        if lammps.lammps_has_error(handle):
            lammps.lammps_get_last_error_message(handle, message, len(message))
            error = message.value.decode(errors="replace")
        lammps.lammps_close(handle)
        answers.write(json.dumps(error) + "\n")
        answers.flush()


if __name__ == "__main__":
    serve(sys.argv[1], sys.argv[2:])
