"""Many inputs in one process of LAMMPS, through LAMMPS' C library: a thousand short ones take seconds,
where starting LAMMPS anew takes a third of a second each.

  process = SharedProcess(lmp, directory)           lmp: a Runner of runner.py
  end = process(text, files={NAME: TEXT or BYTES})
  end.error        what LAMMPS said when it gave up, "" if it did not
  end.crash        what went wrong otherwise: a signal, a hang, a report of a sanitizer; "" if nothing.
                   LAMMPS itself, after some of its own errors, crashes when it is closed, which no
                   program of one input does: that counts only if the error is one of our styles
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
import subprocess
import sys
from pathlib import Path

LIMIT = 300.0            # s, for what hangs; an input here takes some ms
HANG = "no answer"
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
        self.process = subprocess.Popen(    # without buffers, so that select() sees all that is there
            self.command, env=self.environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            stderr=self.stderr, bufsize=0, start_new_session=True)

    def stop(self):
        if self.process:
            self.process.kill()
            self.process.communicate()
            self.stderr.close()
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
        self.process.stdin.write(f"{directory}\n".encode())
        error = self.answer()
        closed = self.answer() if error not in (None, HANG) else error
        self.stderr.seek(0)
        said = self.stderr.read()
        end = End(error or "", screen=(directory / "screen").read_text(errors="replace")
                  if (directory / "screen").exists() else "")
        if closed == HANG:
            end.crash = f"did not end within {LIMIT} s"
        elif closed is None and error and "/FOAM/" not in error:
            pass
        elif "Sanitizer" in said or "runtime error" in said:
            end.crash = said
        elif closed is None:
            end.crash = f"ended the process with status {self.process.wait()}: {said[-3000:]}"
        if end.crash or closed is None:
            self.stop()
        return end

    def answer(self):
        """The next line from the process: None if it has ended, HANG if there is none in time."""
        answered, _, _ = select.select([self.process.stdout], [], [], LIMIT)
        line = self.process.stdout.readline() if answered else json.dumps(HANG)
        return json.loads(line) if line else None


# ---- in the other process -----------------------------------------------------------------------

def serve(library, args):
    """Run LAMMPS in each directory named on stdin; answer with its error, and when it is closed."""
    if "asan" not in os.environ.get("LD_PRELOAD", ""):    # which reserves far more than it uses
        import resource
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)

    def answer(word):
        answers.write(json.dumps(word) + "\n")
        answers.flush()

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
        answer(error)
        lammps.lammps_close(handle)
        answer("closed")


if __name__ == "__main__":
    serve(sys.argv[1], sys.argv[2:])
