"""Malformed commands: LAMMPS ends with an error of its own, soon, that names style, argument and what
is allowed.  It never crashes or hangs; what is odd but allowed runs.

The bad commands are made of the table of styles in grammar.py.  Nearly all run in one process of
LAMMPS; a few in a program of their own, for the exit code.
"""

import re

import pytest

from grammar import DATA, LONG, SCRIPT, STYLES, script
from refusals import lammps, named, refused, runs    # noqa: F401 (a fixture)

# ---- arguments and keywords ---------------------------------------------------------------------

def shown(word):
    """Pattern of how a message shows a bad word."""
    word = word.strip("'\"")
    return re.escape(word) if 0 < len(word) < 40 and word.isascii() else ""


def bad_arguments():
    """What is bad; the line of the script; the command; patterns that the message must have."""
    for style in STYLES:

        def case(what, words, *patterns):
            return f"{style.name}: {what}", style.slot, " ".join([style.command, *words]), \
                [style.name, *filter(None, patterns)]

        good = style.good()
        for p, (argument, kind) in enumerate(style.arguments.items()):
            patterns = rf"\b{argument}\b", kind.allowed
            for what, word in kind.bad.items():
                yield case(f"{argument}: {what}", good[:p] + [word] + good[p + 1:], *patterns,
                           shown(word))
            if not argument.startswith("type"):    # without both, LAMMPS itself refuses
                yield case(f"{argument}: missing", good[:p], *patterns)
                yield case(f"{argument}: empty variable", good[:p] + ["${empty}"], *patterns)
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
                yield case(f"unknown: {what} {''.join(after)}", good + [word] + after,
                           "unknown", allowed, shown(word))

        for keyword, kind in style.keywords.items():
            patterns = rf"\b{keyword}\b", kind.allowed
            for what, word in kind.bad.items():
                yield case(f"{keyword}: {what}", good + [keyword, word], *patterns, shown(word))
            yield case(f"{keyword}: missing", good + [keyword], *patterns)
            yield case(f"{keyword}: empty variable", good + [keyword, "${empty}"], *patterns)
            yield case(f"{keyword}: forgotten before another", good + [keyword, first, "1.0"],
                       *patterns, first)
            yield case(f"{keyword}: bad, then good", good + [keyword, "abc", keyword, kind.good[0]],
                       *patterns, "abc")
            yield case(f"{keyword}: two values", good + [keyword, kind.good[0], "1.0"],
                       "unknown", allowed, r"1\.0")
            if good:
                yield case(f"{keyword}: before the arguments", [keyword, kind.good[0], *good])


@named(bad_arguments())
def test_bad_arguments(lammps, case):
    slot, command, patterns = case
    text = script(**{slot: f"variable empty string ''\n{command}"})
    refused(lammps, text, {"data": DATA}, patterns)


def good_arguments():
    for style in STYLES:
        good = style.good()

        def case(what, words):
            return f"{style.name}: {what}", style.slot, " ".join([style.command, *words])

        for p, (argument, kind) in enumerate(style.arguments.items()):
            for word in kind.good:
                yield case(f"{argument} {word}", good[:p] + [word] + good[p + 1:])
        for keyword, kind in style.keywords.items():
            for word in kind.good:
                yield case(f"{keyword} {word}", good + [keyword, word])
            # as with LAMMPS' own keywords
            yield case(f"{keyword}: the last counts", good + 2 * [keyword, kind.good[0]])
        yield case("all", good + [word for keyword, kind in style.keywords.items()
                                  for word in (keyword, kind.good[0])] + list(style.quantities[1:]))
        if style.quantities:
            yield case("repeated", 2 * good)
        yield case("from a variable", ["${good}"])
        yield case("on two lines", ["&\n", *good])


@named(good_arguments())
def test_good_arguments(lammps, case):
    slot, command = case
    good = " ".join(next(style for style in STYLES if style.slot == slot).good())
    lines = {slot: f"variable good string '{good}'\n{command}"}
    if slot == "compute" and len(command.split()) > 5 and "&" not in command:
        lines["dump"] = "dump d all custom 1 dump id c_b[*]"
    runs(lammps, script(**lines), {"data": DATA})


# ---- the other words of a command ---------------------------------------------------------------

def bad_words():
    """As above; here LAMMPS itself refuses, in its own words."""
    for style in STYLES:
        if style.slot == "coeff":
            continue
        words = style.command.split()
        arguments = " ".join(style.good())
        kind = words[0].removesuffix("_style")

        def case(what, line, *patterns):
            return f"{style.name}: {what}", style.slot, line, patterns

        for wrong in (style.name.upper(), style.name[:-1], style.name + "s", style.name + "/kkk",
                      style.name.replace("/", ""), "µ"):
            line = f"{' '.join(words[:-1])} {wrong} {arguments}"
            yield case(f"is {wrong}", line, f"Unrecognized {kind} style", shown(wrong))
        for what, value, pattern in [
                ("unknown variable", "${nosuch}", "illegal variable nosuch"),
                ("bad formula", "$(1/0)", "Divide by 0 in variable"),
                ("open brace", "${x", "Invalid variable name"),
                ("open quotes", "'1.0", "Unmatched single quote")]:
            yield case(what, f"{style.command} {value}", pattern)
        if style.slot == "pair":
            yield case("no name", "pair_style", "pair_style .*missing")
            continue
        command, ID, group, name = words
        for what, line in ("nothing", ""), ("ID alone", ID), ("ID and group alone", f"{ID} {group}"):
            yield case(what, f"{command} {line}", f"{command} .*missing argument")
        yield case("no ID", f"{command} {group} {name} 1.0 {arguments}", "Could not find|Unrecognized",
                   command)
        yield case("wrong ID", f"{command} a!b {group} {name} {arguments}", f"(?i){command} ID .*must")
        yield case("no such group", f"{command} {ID} nobody {name} {arguments}", "(?i)group ID", "nobody")
        yield case("upper case", f"{command.upper()} {ID} {group} {name} {arguments}",
                   f"Unknown command: {command.upper()}")


@named(bad_words())
def test_bad_words(lammps, case):
    slot, line, patterns = case
    refused(lammps, script(**{slot: line}), {"data": DATA}, patterns)


# ---- commands that do not go together -----------------------------------------------------------

def moved(slot, *slots, **lines):
    """SCRIPT with the lines of some slots before that of another."""
    return script(before={slot: "\n".join(SCRIPT[s] for s in slots)}, **{s: None for s in slots}, **lines)


def with_line(line, **lines):
    """SCRIPT with another line before its run."""
    return script(before={"run": line}, **lines)


def after_run(*lines, **others):
    return script(run="\n".join(["run 1", *lines]), **others)


BOND = """region r block 0 9 0 9 -0.5 0.5
create_box 1 r bond/types 1 extra/bond/per/atom 1
create_atoms 1 single 5 5 0
set atom 1 diameter 1
bond_style zero
bond_coeff 1 1"""
LOOK = "write_dump all custom look id c_b"


def bad_scripts():
    """What is wrong; the script; patterns of the message.  More of them are MISFITS in ../styles."""
    for slot, style in ("gas", "foam/coarsen"), ("step", "foam/abm"):
        yield f"{slot} before the box", moved("read", slot), f"Fix {style} .*before simulation box"
    yield "coefficients before the box", moved("read", "pair", "coeff"), "Pair_coeff .*before simulation box"
    yield "coefficients before pair_style", moved("pair", "coeff"), "Pair_coeff .*without a pair style"
    yield "no coefficients", script(coeff=None), "pair coeffs are not set"
    yield "a name for two computes", script(before={"compute": SCRIPT["compute"]}), "compute ID 'b'"
    yield "a name for two fixes", script(before={"step": "fix step all nve"}), "fix.*style"

    twice = "pair_coeff * * durian/foam 1 1\npair_coeff * * durian/foam 2 1"
    yield "two pair styles", \
        script(pair="pair_style hybrid/overlay durian/foam 1 durian/foam 2", coeff=twice), \
        "foam/", "needs one pair_style durian/foam"
    yield "hybrid without sigma0", \
        script(pair="pair_style hybrid durian/foam 1 zero 2", coeff="pair_coeff * * durian/foam"), \
        "durian/foam", "sigma0", "a number >= 0"
    yield "bonds", script(atom="atom_style hybrid sphere 1 bond", read=BOND), \
        "Fix foam/abm .*bonds.* not allowed|MOLECULE package which is not enabled"
    yield "random forces", with_line("fix l all langevin 1 1 1 3"), "Fix foam/abm", "fix langevin"
    yield ("another timestep", with_line("fix l all dt/reset 1 1e-3 1e-1 0.1 units box"),
           "Fix foam/abm", "fix dt/reset")
    yield "radii of another fix", with_line("variable a equal 2\nfix a all adapt 1 atom diameter v_a"), \
        "Fix foam/abm", "fix adapt", "radii"
    for units in "real", "metal", "electron":
        yield f"units {units}", script(units=f"units {units}"), \
            "durian/foam", "units lj, si, cgs, micro or nano"

    for dt in "0", "-1", "1e-300":
        yield f"timestep {dt}", with_line(f"timestep {dt}"), "Fix foam/abm", "step", "dt0", "timestep"
    for keyword in "dt0", "dtmax":
        yield f"{keyword} 1e-300", script(step=f"{SCRIPT['step']} {keyword} 1e-300"), \
            "Fix foam/abm", "step", keyword
    for d in "1e5", "1e300":
        yield f"diameter {d}", with_line(f"set atom 1 diameter {d}"), "durian/foam", "radius", "below"

    yield "beyond the last value", script(thermo="thermo_style custom step f_gas[11]"), "fix gas"
    yield "a column of a vector", script(dump="dump d all custom 1 dump id c_b[2]"), "compute b"
    yield "fix_modify", with_line("fix_modify gas colour yes"), "foam/coarsen: fix_modify", "unknown keyword colour"
    yield "integrator taken away", after_run("unfix step", "run 1", thermo=None), \
        "Fix foam/coarsen needs", "foam/abm"
    yield "pair style taken away", after_run("pair_style none", "run 1", compute=None, dump=None), \
        "Fix foam/", "needs one pair_style durian/foam"
    for what, *lines in [("no pair style", "pair_style none"),
                         ("a new pair style", "pair_style none", SCRIPT["pair"], SCRIPT["coeff"]),
                         ("fewer bubbles", "group one id 1", "delete_atoms group one"),
                         ("more bubbles", "create_atoms 1 single 5 5 0")]:
        yield f"a look at {what}", after_run(*lines, LOOK, dump=None), \
            "Compute foam/bubble", "pair_style durian/foam|run 0"


@named(bad_scripts())
def test_bad_scripts(lammps, case):
    text, *patterns = case
    refused(lammps, text, {"data": DATA}, patterns)


def good_scripts():
    yield "fixes before the pair style", moved("pair", "step", "gas")
    yield "compute before the box", moved("read", "compute")
    yield "pair style before the box", moved("read", "pair")
    for slot in "pair", "coeff", "gas", "step":
        yield f"{slot} twice", script(before={slot: SCRIPT[slot]})
        yield f"{slot} again between runs", after_run(SCRIPT[slot], "run 2")
    yield "a flat foam in 3D", script(dimension="dimension 3")
    yield "exchange taken away", after_run("unfix gas", LOOK, "run 1", thermo=None, dump=None)
    yield "no bubble left", after_run("delete_atoms group all", "run 1", "print '$(f_gas[3]) $(f_gas[5])'")
    values = "print '$(f_gas[1]) $(f_gas[3]) $(f_gas[4])'"
    yield "values before the first run", script(run=values)
    yield "values without a pair style", script(run=values, pair=None, coeff=None)
    for boundary in "f f p", "s s p", "m m p":
        box = {"read": f"boundary {boundary}"}
        yield f"boundary {boundary}", script(before=box)
        yield f"headroom, boundary {boundary}", script(before=box, pair=f"{SCRIPT['pair']} headroom 1e300")
    yield "headroom", script(pair=f"{SCRIPT['pair']} headroom 1e300")
    yield "a long first step", with_line("timestep 1e300")
    yield "pair_modify", with_line("pair_modify shift yes mix arithmetic table 12")
    yield "no run", script(run=None)
    yield "lines end as on Windows", script().replace("\n", "\r\n")
    yield "minus of typography", script(step="fix step all foam/abm 1e−3")


@named(good_scripts())
def test_good_scripts(lammps, case):
    text, = case
    runs(lammps, text, {"data": DATA})


# ---- a program of its own -----------------------------------------------------------------------

@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("command", [
    "pair_coeff - * 1.0", "pair_coeff 99999999999999999999 * 1.0", "pair_style durian/foam 1.0 drag",
    "fix gas all foam/coarsen 1e-3 1e400", "fix s all foam/abm 1e-3 colour", "fix s all foam/rkc ''",
    "compute c all foam/bubble colour"])
def test_exit_code(base_lmp, command, ranks):
    """The program ends with an exit code, not with a signal, on all ranks."""
    result = base_lmp(with_line(command), files={"data": DATA}, ranks=ranks, check=False)
    assert 0 < result.returncode < 128
    assert re.search("ERROR.*foam", result.errors[0])
