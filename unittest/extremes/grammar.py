"""What each style takes, as its page of the manual says; test_malformed.py makes bad commands of it.

A style is one entry of STYLES: its arguments in their order, and its keywords, each with the kind of
its value.  A Kind says what a message about a bad value has to say is allowed, and which words are
good and which are bad, by what is bad about them.
"""

import dataclasses

LONG = 10**4    # letters of a long word


@dataclasses.dataclass
class Kind:
    allowed: str     # regular expression
    good: list
    bad: dict


@dataclasses.dataclass
class Style:
    slot: str                  # the line of the script that it is, see SCRIPT
    name: str                  # as a message gives it
    command: str               # all before its arguments
    arguments: dict            # name: kind
    keywords: dict = dataclasses.field(default_factory=dict)
    quantities: tuple = ()     # in the place of keywords: words, as many as you like
    others: str = ""           # what a message on too many arguments says, without keywords

    def good(self):
        """Its arguments, each with the first of its good words."""
        return [kind.good[0] for kind in self.arguments.values()] + list(self.quantities[:1])


# ---- kinds of values ----------------------------------------------------------------------------

BAD = {"empty": '""', "a word": "abc", "long": "x" * LONG, "not ASCII": "µ", "only a sign": "-",
       "variable": "v_mu", "a star": "*", "a comment sign in quotes": "'#'"}
NO_NUMBER = {**BAD, "nan": "nan", "NaN": "NaN", "inf": "inf", "-inf": "-inf", "Infinity": "Infinity",
             "overflow": "1e400", "negative overflow": "-1e400", "unit": "1.5s", "two points": "1.2.3",
             "two signs": "--1", "no digits": "e5", "no exponent": "1e", "comma": "1,5",
             "hexadecimal": "0x10", "Fortran": "1d-3", "long number": "9" * LONG,
             "long number and more": "9" * LONG + "x", "minus of typography": "−1",
             "full width": "１", "spaces": "' '"}


def number(above=None, at_least=None, below=()):
    """A number > above or >= at_least; `below` are more words for numbers that are not."""
    limit = above if above is not None else at_least
    bad = {**NO_NUMBER, "negative": "-1", "a little negative": "-1e-300"}
    good = ["1.0", "1", "+1", "1.", "01.50", "1E+0", "1.0e-0"]
    if above == 0:
        bad |= {"zero": "0", "minus zero": "-0.0", "underflow": "1e-400"}
    elif limit == 0:
        good += ["0", "-0.0", "1e-400", ".5"]
    return Kind(rf"a number {'>' if above is not None else '>='} {limit}\b", good,
                bad | {word: word for word in below})


def any_number(*good):
    bad = {how: word for how, word in NO_NUMBER.items() if how != "minus of typography"}    # LAMMPS takes it for -
    return Kind(r"a number\b", list(good or ["0.1", "-1", "+.5", "0", "-0.0", "1e-400"]), bad)


def above_one():
    return Kind(r"a number > 1\b", ["1.9", "+2", "1.5e0", "1e300"],
                {**NO_NUMBER, "one": "1", "below": "0.99", "zero": "0", "negative": "-2"})


def share():
    """A number between 0 and 1, neither of them."""
    return Kind(r"a number > 0 and < 1\b", ["0.9", ".5", "+8e-1", "0.999"],
                {**NO_NUMBER, "zero": "0", "one": "1", "above": "1.1", "negative": "-0.5",
                 "underflow": "1e-400"})


def integer(least, most=None):
    bad = {**NO_NUMBER, "too small": str(least - 1), "negative": "-1", "fraction": f"{least}.5",
           "a point": f"{least}.0", "exponent": "1e1", "too large for 64 bits": "9223372036854775808",
           "far too large": "99999999999999999999"}
    good = [str(least), str(least + 1), f"+{least}", f"00{least}"]
    if most:
        return Kind(f"an integer from {least} to {most}", [*good, str(most)],
                    bad | {"too large": str(most + 1)})
    return Kind(f"an integer >= {least}", good, bad)


def one_of(*words):
    bad = {**BAD, "a number": "1", "upper case": words[0].upper(), "capital": words[0].capitalize(),
           "cut short": words[0][:-1], "too long": words[0] + "s", "both": "".join(words),
           "with a space": f"'{words[0]} '"}
    return Kind(" or ".join(rf"\b{word}\b" for word in words), list(words), bad)


def either(word, kind):
    """That word, or what the other kind allows."""
    return Kind(rf"\b{word}\b or {kind.allowed}", [word, *kind.good],
                kind.bad | {"upper case": word.upper(), "too long": word + "s"})


def types(most):
    """Numbers of types of bubbles from 1 on, or a range of them."""
    bad = {**NO_NUMBER, "zero": "0", "more than there are": str(most + 1), "negative": "-1",
           "fraction": "1.5", "ends in the wrong order": "2*1", "to zero": "*0", "from zero": "0*",
           "beyond": f"*{most + 1}", "two stars": "**", "three numbers": "1*1*1",
           "range in minus": "1-1", "too large for 64 bits": "9223372036854775808"}
    del bad["a star"]
    return Kind(rf"\b1 to {most}\b", ["*", "1", f"*{most}", "1*", f"1*{most}"], bad)


# ---- the styles ---------------------------------------------------------------------------------

INTEGRATOR = {"dt0": number(above=0), "dtmax": number(above=0), "variable": one_of("volume", "radius"),
              "norm": one_of("max", "rms"), "safety": share(), "growth": above_one(),
              "drift": one_of("keep", "remove")}

LAW = Kind(r"\bspring\b or \bpower\b", ["spring", "power 2.5", "power 1.5"],
           {**one_of("spring", "power").bad, "with a space": "'power '"})

DRAG = Kind(r"\bstatic\b or \bneighbor\b or \bcontact\b", ["static", "neighbor", "neighbor solve", "contact 0.5"],
            one_of("static", "neighbor", "contact").bad)

STYLES = [
    Style("pair", "durian/foam", "pair_style durian/foam", {"mu0": number(above=0)},
          {"law": LAW, "drag": DRAG, "rin": number(above=0),
           "headroom": number(at_least=1, below=["0", "0.999", "1e-5"])}),
    Style("coeff", "durian/foam", "pair_coeff",
          {"type I": types(1), "type J": types(1), "sigma0": number(at_least=0)},
          others="two types and sigma0"),
    Style("gas", "foam/coarsen", "fix gas all foam/coarsen",
          {"K": number(at_least=0), "kappa": number(at_least=0)},
          {"rmin": dataclasses.replace(number(at_least=0), good=["0.1", "+.5", "0", "-0", "1e-400"]),
           "film": one_of("no", "yes"), "liquid": one_of("area", "lsw"), "nmin": integer(0),
           "ain": number(above=0)}),
    Style("step", "foam/abm", "fix step all foam/abm", {"tolerance": number(above=0)},
          {**INTEGRATOR, "scheme": one_of("standard", "source")}),
    Style("step", "foam/rkc", "fix step all foam/rkc", {"tolerance": number(above=0)},
          {**INTEGRATOR, "stages": either("auto", integer(3, 200)),
           "spectral": either("auto", number(above=0))}),
    Style("ages", "foam/contacts", "fix ages all foam/contacts", {}, {"trial": one_of("no", "yes")}),
    Style("flow", "foam/flow", "fix flow all foam/flow",
          {"KIND": dataclasses.replace(one_of("region", "shear", "field"), good=["region"]),
           "REGION": Kind("the ID of a region", ["everywhere"], BAD),
           "velocity": Kind(r"\bvelocity\b", ["velocity"], BAD),
           "VX": any_number(), "VY": any_number(), "VZ": any_number("0", "-0.0")}, {"touch": one_of("no", "yes")}),
    Style("compute", "foam/bubble", "compute b all foam/bubble", {},
          quantities=("contacts", "area", "free", "vfilm", "vliquid", "rdot", "espring", "edurian")),
]

# ---- a script in which each of them is a line ---------------------------------------------------

SCRIPT = {
    "units": "units lj",
    "dimension": "dimension 2",
    "atom": "atom_style sphere 1",
    "modify": "atom_modify map array",
    "read": "read_data data",
    "region": "region everywhere block INF INF INF INF INF INF",
    "pair": "pair_style durian/foam 1.0",
    "coeff": "pair_coeff * * 1.0",
    "gas": "fix gas all foam/coarsen 1e-3 0.1",
    "step": "fix step all foam/abm 1e-3",
    "ages": None,    # in the scripts of its own cases
    "flow": None,
    "compute": "compute b all foam/bubble contacts",
    "dump": "dump d all custom 1 dump id c_b",
    "thermo": "thermo_style custom step time pe f_gas[1] f_gas[3] f_gas[4] f_gas[5] f_gas[8] f_step[6]",
    "run": "run 2",
}


def script(before=None, **lines):
    """SCRIPT with some lines replaced; None takes a line out; `before` lines: {slot: lines}."""
    out = []
    for slot, line in {**SCRIPT, **lines}.items():
        out += [(before or {}).get(slot), line]
    return "\n".join(line for line in out if line is not None) + "\n"


DATA = """bubbles

3 atoms
1 atom types

0 10 xlo xhi
0 10 ylo yhi
-0.5 0.5 zlo zhi

Atoms # sphere

1 1 2 1 3 3 0
2 1 2 1 4.5 3 0
3 1 1.8 1 8 7 0

Velocities

1 0 0 0 0 0 0
2 0 0 0 0 0 0
3 0 0 0 0 0 0
"""
