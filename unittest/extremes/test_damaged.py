"""Damaged input: data files, restart files, and scripts in which anything may be wrong.

FOAM_EXTREME_CASES is the number of random cases, FOAM_EXTREME_SEED the first of their seeds: a case
that fails is printed with its seed and all that is needed to repeat it.
"""

import math
import os
import random
import re
import struct

import pytest

from grammar import DATA, SCRIPT, STYLES, script
from refusals import lammps, named, refused, runs, whole    # noqa: F401 (a fixture)
from test_malformed import good_scripts

CASES = int(os.environ.get("FOAM_EXTREME_CASES", 500))
SEED = int(os.environ.get("FOAM_EXTREME_SEED", 1))


# ---- data files ---------------------------------------------------------------------------------

BUBBLE = "3 1 1.8 1 8 7 0"    # the last one of DATA

def bad_data():
    """What is there instead of what in DATA; pattern of the message, most of which are LAMMPS' own."""
    for d in "0", "-1.8":
        yield BUBBLE, f"3 1 {d} 1 8 7 0", "Fix foam/abm: the radius of bubble 3 is zero, negative"
    yield BUBBLE, "3 1 1e300 1 8 7 0", "durian/foam: the largest bubble.*below"
    for d in "nan", "inf", "1e400", "1.8x":
        yield BUBBLE, f"3 1 {d} 1 8 7 0", "Expected floating point parameter|Floating point number"
    for density in "0", "-1":
        yield BUBBLE, f"3 1 1.8 {density} 8 7 0", "Invalid density"
    for x in "nan", "inf", "1e400", "µ":
        yield BUBBLE, f"3 1 1.8 1 {x} 7 0", "Expected floating point parameter|Floating point number"
    yield BUBBLE, "3 1 1.8 1 8 7 3", "z coord"
    yield BUBBLE, "2 1 1.8 1 8 7 0", "Duplicate atom IDs"
    for ID in "0", "-1", "1.5", "a", "3000000000":
        yield BUBBLE, f"{ID} 1 1.8 1 8 7 0", "atom ID|Expected integer|Integer"
    for kind in "0", "2", "-1", "a", "1.5":
        yield BUBBLE, f"3 {kind} 1.8 1 8 7 0", "atom type|Invalid line"
    yield BUBBLE, "3 1 1.8 1 8 7", "Incorrect format"
    yield BUBBLE, f"{BUBBLE} 1", "Incorrect format"
    yield BUBBLE, f"{BUBBLE} 0 0 0", "Incorrect format"    # image flags of one bubble only
    yield BUBBLE, "", "Incorrect format|Unexpected end|Invalid|Did not assign"
    yield BUBBLE, f"{BUBBLE}\n4 1 1 1 5 5 0", "Unknown identifier"

    for n in "2", "4", "0", "-3", "3.5", "three", "1e1", "99999999999999999999", "3000000000":
        yield "3 atoms", f"{n} atoms", "Unknown identifier|assign all atoms|Unexpected end|Integer|too big"
    for n in "0", "-1", "one":
        yield "1 atom types", f"{n} atom types", "atom type|Unknown identifier"
    for box in "10 0", "0 0", "0 nan", "0", "0 1 2":
        yield "0 10 xlo", f"{box} xlo", "Box bounds|Unknown identifier"
    yield "0 10 xlo", "-1e300 1e300 xlo", "Domain too large"

    yield "Atoms # sphere", "Bubbles", "Unknown identifier"
    yield "Atoms # sphere", "", "Unknown identifier"
    yield "Velocities", "Bonds", "Invalid data file section: Bonds"
    yield "3 0 0 0 0 0 0", "7 0 0 0 0 0 0", "Invalid atom ID 7 in Velocities"
    yield "3 0 0 0 0 0 0\n", "", "Unexpected end"
    yield "Velocities", "Pair Coeffs # durian/foam\n\n1 1.0\n\nVelocities", "pair_style before Pair Coeffs"


BAD_COEFFICIENTS = [("1", "sigma0", "a number >= 0"), ("1 -1", "sigma0", "a number >= 0"),
                    ("1 nan", "sigma0", "a number >= 0"), ("1 1 1", "two types and sigma0"),
                    ("2 1", "type", "1 to 1")]


@named((f"{new[:30]} for {old[:12]}", old, new, pattern) for old, new, pattern in bad_data())
def test_bad_data(lammps, case):
    old, new, pattern = case
    assert old in DATA
    refused(lammps, script(), {"data": DATA.replace(old, new, 1)}, [pattern])


@named((line, line, patterns) for line, *patterns in BAD_COEFFICIENTS)
def test_bad_coefficients_in_data(lammps, case):
    line, patterns = case
    text = script(before={"read": SCRIPT["pair"]}, pair=None, coeff=None)
    data = f"{DATA}\nPair Coeffs # durian/foam\n\n{line}\n"
    refused(lammps, text, {"data": data}, ["durian/foam", *patterns])


def test_data_cut_short(lammps):
    """At any byte, LAMMPS' own error; but velocities, up to the name of their section, are optional."""
    optional = range(DATA.index(BUBBLE) + len(BUBBLE), DATA.index("1 0 0 0 0 0 0"))
    for end in range(len(DATA.rstrip())):
        if end not in optional:
            refused(lammps, script(), {"data": DATA[:end]}, [])


def test_no_bubbles(lammps):
    data = re.sub(r"Atoms(.|\n)*", "", DATA.replace("3 atoms", "0 atoms"))
    refused(lammps, script(), {"data": data}, ["durian/foam", "no bubble", "radius > 0", "rin"])


GOOD_DATA = {
    "outside of the periodic box": DATA.replace(BUBBLE, "3 1 1.8 1 1008 -7 0"),
    "another ID": DATA.replace(BUBBLE, "5 1 1.8 1 8 7 0").replace("\n3 0 0", "\n5 0 0"),
    "no hint": DATA.replace("# sphere", ""),
    "hint at another style": DATA.replace("# sphere", "# atomic"),
    "image flags": DATA.replace("3 3 0\n", "3 3 0 0 0 0\n").replace("4.5 3 0\n", "4.5 3 0 1 -1 0\n")
                       .replace("8 7 0\n", "8 7 0 0 0 0\n"),
    "lines end as on Windows": DATA.replace("\n", "\r\n"),
    "no end of the last line": DATA.rstrip(),
    "tabs": DATA.replace(" ", "\t"),
    "a title": DATA.replace("bubbles", "Blåsen µ"),
    "tilted": DATA.replace("zlo zhi", "zlo zhi\n1 0 0 xy xz yz"),
}


@named(GOOD_DATA.items())
def test_good_data(lammps, case):
    data, = case
    runs(lammps, script(), {"data": data})


# ---- restart files ------------------------------------------------------------------------------

def go_on(lines):
    """A run from a restart file with these lines."""
    return "\n".join(["read_restart state", *filter(None, lines.values()), "run 2"]) + "\n"


AGAIN = {slot: SCRIPT[slot] for slot in ("gas", "step", "compute", "dump", "thermo")}


@pytest.fixture(scope="module")
def state(lammps):
    """A restart file."""
    runs(lammps, script(run="run 3\nwrite_restart state"), {"data": DATA})
    return (lammps.directory / str(lammps.inputs) / "state").read_bytes()


def test_restart_cut_short(lammps, state):
    for end in [*range(0, 30), *range(30, len(state), 40), len(state) - 1]:
        refused(lammps, go_on(AGAIN), {"state": state[:end]}, ["[Rr]estart file|end of file"])


@pytest.mark.parametrize("headroom", [0.5, -1.0, math.nan, math.inf])
def test_restart_with_wrong_numbers(lammps, state, headroom):
    """Those that the pair style wrote: 1.2 is its headroom."""
    known, wrong = struct.pack("d", 1.2), struct.pack("d", headroom)
    assert state.count(known) == 1
    refused(lammps, go_on(AGAIN), {"state": state.replace(known, wrong)},
            ["durian/foam", "headroom", ">= 1", "damaged"])


NEW_PAIR = "pair_style durian/foam 3 drag neighbor\npair_coeff * * 2"

@named([
    ("no gas", {"gas": None, "thermo": None}),
    ("another variable", {"step": "fix step all foam/abm 1e-3 variable radius scheme source"}),
    ("another integrator", {"step": "fix step all foam/rkc 1e-3"}),
    ("names exchanged", {"gas": "fix step all foam/coarsen 1 1", "step": "fix gas all foam/abm 1e-3",
                         "thermo": None}),
    ("other gas", {"gas": "fix gas all foam/coarsen 1 1 liquid lsw rmin 0.5 ain 3"}),
    ("pair style again", {"gas": f"{NEW_PAIR}\n{SCRIPT['gas']}"}),
    ("a new pair style", {"gas": f"pair_style none\n{NEW_PAIR}\n{SCRIPT['gas']}"}),
])
def test_restart_with_other_styles(lammps, state, case):
    """What is in the file is theirs, and sound, or there is nothing in it for them."""
    lines, = case
    runs(lammps, go_on({**AGAIN, **lines}), {"state": state})


def test_restart_without_pair_style(lammps, state):
    lines = {**AGAIN, "gas": f"pair_style zero 2\npair_coeff * *\n{SCRIPT['gas']}"}
    refused(lammps, go_on(lines), {"state": state}, ["foam/", "needs one pair_style durian/foam"])


# ---- random damage ------------------------------------------------------------------------------

def all_keywords(style):
    words = [word for keyword, kind in style.keywords.items() for word in (keyword, kind.good[0])]
    return " ".join([style.command, *style.good(), *words, *style.quantities[1:]])


WHOLE = [script(), script(run="minimize 0 0 10 10\nrun 2"), script(run="run 2\nwrite_restart state\nrun 2"),
         *(script(dump=None, **{style.slot: all_keywords(style)}) for style in STYLES),
         *(text for _, text in good_scripts())]
KEYWORDS = [word for style in STYLES for word in (*style.keywords, *style.quantities)]
WORDS = ["0", "-1", "1", "2", "1e-300", "1e300", "1e30", "1e-30", "1e400", "nan", "inf", "abc", "''",
         "1.5", "*", "all", "v_x", "µ", "&", "#", "${x}", "9223372036854775807", "2147483648", *KEYWORDS]
# LAMMPS takes coordinates back into the box by one box at a time: large ones would take for ever.
# LAMMPS 22 Jul 2025 crashes on a bad word of thermo_style after one like f_gas[*].
DATA_WORDS = ["0", "-1", "1", "2", "1e-300", "1e400", "nan", "abc", "''", "1.5", "µ", "#"]
LETTERS = "0123456789.-+ #&$/x\n'"


def damaged(source, text, words):
    """One word or letter of the text deleted, repeated, exchanged, replaced or put in; not in a run."""
    lines = text.split("\n")
    n = source.choice([n for n, line in enumerate(lines) if line.strip() and "run" not in line] or [0])
    parts = lines[n].split()
    m = source.randrange(len(parts)) if parts else 0
    k = source.randrange(len(lines[n]) + 1)
    kind = source.randrange(9)
    if kind == 0 and parts:
        del parts[m]
    elif kind == 1 and parts:
        parts.insert(m, parts[m])
    elif kind == 2 and parts:
        other = source.randrange(len(parts))
        parts[m], parts[other] = parts[other], parts[m]
    elif kind in (3, 4) and parts:
        parts[m] = source.choice(words)
    elif kind == 5:
        parts.insert(m, source.choice(words))
    elif kind == 6:
        parts = [lines[n][:k] + source.choice(LETTERS) + lines[n][k + source.randrange(2):]]
    elif kind == 7:    # lines
        other = source.randrange(len(lines))
        lines[n], lines[other] = lines[other], lines[n]
        return "\n".join(lines)
    else:
        return "\n".join(lines[:n] + source.choice([[], 2 * [lines[n]]]) + lines[n + 1:])
    lines[n] = " ".join(parts)
    return "\n".join(lines)


@pytest.mark.parametrize("first", range(SEED, SEED + CASES, 100))
def test_random_damage(lammps, first):
    """LAMMPS runs, or says why not; where one of our styles does, it says who it is."""
    failed = []
    for seed in range(first, min(first + 100, SEED + CASES)):
        source = random.Random(seed)
        text, data = source.choice(WHOLE), DATA
        for _ in range(source.choice([1, 1, 1, 2, 2, 3, 5])):
            if source.random() < 0.8:
                text = damaged(source, text, WORDS)
            else:
                data = damaged(source, data, DATA_WORDS)
        end = lammps(text, {"data": data})
        said = end.error.split("\nLast input line")[0]
        anonymous = "/FOAM/" in said and not re.search(r"(Pair style|Fix|Compute) \w+/", said)
        if end.crash or anonymous or not end.error and re.search(r"\bnan\b", end.screen):
            failed.append(f"seed {seed}: {end.crash or end.error or 'nan'}\n{whole(text, {'data': data})}")
    if failed:
        pytest.fail("\n".join(failed), pytrace=False)
