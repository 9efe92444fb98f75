"""Every malformed command ends at once, with an error that names the style, the argument and what
is allowed."""

import signal

import pytest

from runner import HEAD, KOKKOS, data_file, on_device

COMMANDS = {
    "pair_style": "pair_style durian/foam 1.0",
    "pair_coeff": "pair_coeff * * 1.0",
    "gas": "fix gas all foam/coarsen 1e-3 0.1",
    "step": "fix step all foam/abm 1e-3",
    "compute": "compute b all foam/bubble contacts",
}

PAIR, COARSEN, ABM, BUBBLE = "durian/foam", "foam/coarsen", "foam/abm", "foam/bubble"

PAIR_KEYWORDS = ("drag", "rin", "headroom")
COARSEN_KEYWORDS = ("rmin", "liquid", "nmin", "ain")
ABM_KEYWORDS = ("dt0", "dtmax", "variable", "norm", "scheme", "safety", "growth", "drift")
QUANTITIES = ("contacts", "area", "free", "vfilm", "vliquid", "rdot", "espring", "edurian")


def cases():
    """(command, its arguments, what the error has to say beside the name of the style)"""

    def add(which, style, head, rows):
        for arguments, *words in rows:
            yield which, f"{head} {arguments}".strip(), style, tuple(words)

    bad_positive = ("0", "-1", "abc", "nan", "inf", "1.5x")
    bad_not_negative = ("-1", "abc", "nan", "inf")

    yield from add("pair_style", PAIR, "pair_style durian/foam", [
        ("", "mu0"),
        *((bad, "mu0", "> 0", bad) for bad in bad_positive),
        ("1.0 drag", "drag", "needs a value"),
        ("1.0 drag viscous", "drag", "static", "neighbor", "viscous"),
        ("1.0 rin", "rin", "needs a value"),
        *((f"1.0 rin {bad}", "rin", "> 0", bad) for bad in ("0", "-1", "abc", "inf")),
        ("1.0 headroom", "headroom", "needs a value"),
        *((f"1.0 headroom {bad}", "headroom", ">= 1", bad) for bad in ("0.9", "abc", "nan")),
        ("1.0 colour 1", "colour", *PAIR_KEYWORDS),
        ("1.0 colour", "colour", *PAIR_KEYWORDS),
        ("1.0 1.0", "1.0", *PAIR_KEYWORDS),
    ])
    yield from add("pair_coeff", PAIR, "pair_coeff", [
        ("* *", "sigma0"),
        ("* * 1.0 2.0", "sigma0"),
        *((f"* * {bad}", "sigma0", ">= 0", bad) for bad in bad_not_negative),
    ])
    yield from add("gas", COARSEN, "fix gas all foam/coarsen", [
        ("", "argument K", "a number >= 0"),
        ("1e-3", "kappa", "a number >= 0"),
        *((f"{bad} 0.1", "K", ">= 0", bad) for bad in bad_not_negative),
        *((f"1e-3 {bad}", "kappa", ">= 0", bad) for bad in bad_not_negative),
        ("1e-3 0.1 rmin", "rmin", "needs a value"),
        *((f"1e-3 0.1 rmin {bad}", "rmin", ">= 0", bad) for bad in bad_not_negative),
        ("1e-3 0.1 liquid", "liquid", "needs a value"),
        ("1e-3 0.1 liquid water", "liquid", "area", "lsw", "water"),
        ("1e-3 0.1 nmin", "nmin", "needs a value"),
        *((f"1e-3 0.1 nmin {bad}", "nmin", "integer", ">= 0", bad) for bad in ("-1", "1.5", "abc")),
        ("1e-3 0.1 ain", "ain", "needs a value"),
        *((f"1e-3 0.1 ain {bad}", "ain", "> 0", bad) for bad in ("0", "-1", "abc")),
        ("1e-3 0.1 colour 1", "colour", *COARSEN_KEYWORDS),
        ("1e-3 0.1 colour", "colour", *COARSEN_KEYWORDS),
    ])
    yield from add("step", ABM, "fix step all foam/abm", [
        ("", "tolerance"),
        *((bad, "tolerance", "> 0", bad) for bad in bad_positive),
        *((f"1e-3 {keyword}", keyword, "needs a value") for keyword in ABM_KEYWORDS),
        *((f"1e-3 {keyword} {bad}", keyword, "> 0", bad)
          for keyword in ("dt0", "dtmax") for bad in ("0", "-1", "abc")),
        *((f"1e-3 safety {bad}", "safety", "> 0 and < 1", bad) for bad in ("0", "1", "abc")),
        *((f"1e-3 growth {bad}", "growth", "> 1", bad) for bad in ("0", "1", "abc")),
        ("1e-3 variable area", "variable", "volume", "radius", "area"),
        ("1e-3 norm l1", "norm", "max", "rms", "l1"),
        ("1e-3 scheme euler", "scheme", "standard", "source", "euler"),
        ("1e-3 drift yes", "drift", "keep", "remove", "yes"),
        ("1e-3 colour 1", "colour", *ABM_KEYWORDS),
        ("1e-3 colour", "colour", *ABM_KEYWORDS),
    ])
    yield from add("compute", BUBBLE, "compute b all foam/bubble", [
        ("", *QUANTITIES),
        ("colour", "colour", *QUANTITIES),
        ("contacts colour", "colour", *QUANTITIES),
        ("*", "*", *QUANTITIES),
    ])


def fails(lmp, text, ranks=1):
    """LAMMPS ends by itself, soon, with an error: give its line."""
    result = lmp(text, files={"data": data_file([10, 10], [[3, 3], [4.5, 3], [8, 7]], [1, 1, 0.9])},
                 ranks=ranks, check=False)
    assert result.returncode not in (0, 128 + signal.SIGSEGV, 128 + signal.SIGABRT)
    assert result.returncode > 0    # a negative one is a signal
    assert result.errors, result.screen[-1000:]
    return result.errors[0].split(" (src/")[0]


def foam(after="", head=None, **changed):
    return "\n".join([head or HEAD.format(dim=2), "read_data data",
                      *{**COMMANDS, **changed}.values(), after, "run 1"])


CASES = list(cases())


@pytest.mark.parametrize("lmp", ["wheel", KOKKOS[0]], indirect=True)
@pytest.mark.parametrize("which, command, style, words", CASES, ids=[case[1] for case in CASES])
def test_arguments(lmp, which, command, style, words):
    line = fails(lmp, foam(**{which: command})).lower()
    for word in (style,) + words:
        assert word.lower() in line, f"no '{word}' in: {line}"


# what is well formed by itself but goes with something that is missing or in the way

MISFITS = {
    "coarsen in a group":
        (foam(gas="group g id 1\nfix gas g foam/coarsen 1e-3 0.1"), COARSEN, "group g", ABM, "group all"),
    "abm in a group":
        (foam(step="group g id 1\nfix step g foam/abm 1e-3"), ABM, "group g", COARSEN, "group all"),
    "no integrator": (foam(step=""), COARSEN, ABM),
    "another integrator": (foam(step="fix step all nve"), COARSEN, ABM),
    "two integrators": (foam("fix two all nve"), ABM, "only fix that integrates"),
    "two of them": (foam("fix two all foam/abm 1e-3"), ABM, "only fix that integrates"),
    "two exchanges": (foam("fix two all foam/coarsen 1e-3 0.1"), COARSEN, "only one"),
    "abm without its pair style":
        (foam(pair_style="pair_style zero 3.0", pair_coeff="pair_coeff * *", gas="", compute=""),
         ABM, "pair_style durian/foam"),
    "coarsen without its pair style":
        (foam(pair_style="pair_style zero 3.0", pair_coeff="pair_coeff * *", compute=""),
         COARSEN, "pair_style durian/foam"),
    "compute without its pair style":
        (foam(pair_style="pair_style zero 3.0", pair_coeff="pair_coeff * *", gas="", step=""),
         BUBBLE, "pair_style durian/foam"),
    "drift removed from the source's scheme":
        (foam(step="fix step all foam/abm 1e-3 scheme source drift remove"), ABM, "drift", "scheme"),
    "respa": (foam("run_style respa 2 2 pair 1"), ABM, "respa", "verlet"),
    # radii would not reach the other ranks, nor the images of a bubble: wrong without a word
    "radii not communicated":
        (foam(head=HEAD.format(dim=2).replace("sphere 1", "sphere")), "atom_style sphere 1"),
    "radii declared static":
        (foam(head=HEAD.format(dim=2).replace("sphere 1", "sphere 0")), "atom_style sphere 1"),
    "no atom IDs":
        (HEAD.format(dim=2).replace("atom_modify   map array", "atom_modify id no") +
         "region box block 0 10 0 10 -0.5 0.5\ncreate_box 1 box\ncreate_atoms 1 single 5 5 0\n" +
         "\n".join(COMMANDS.values()) + "\nrun 1", PAIR, "atom_modify id yes"),
    "units real":
        (foam(head=HEAD.format(dim=2).replace("lj", "real")), PAIR, "units lj"),
    "atoms without radii":
        (HEAD.format(dim=2).replace("sphere 1", "atomic") +
         "region box block 0 10 0 10 -0.5 0.5\ncreate_box 1 box\ncreate_atoms 1 single 5 5 0\n"
         "mass 1 1.0\n" + "\n".join(COMMANDS.values()) + "\nrun 1", PAIR, "atom_style sphere 1"),
    # the list can never hold for the shortest step
    "no skin": (foam("neighbor 0.0 bin"), ABM, "neighbor", "skin"),
}


def only_if_refused(lmp, name):
    if name.startswith("radii") and on_device(lmp):
        pytest.skip("the KOKKOS styles send radii themselves: see test_kokkos.py")


@pytest.mark.parametrize("name", MISFITS)
def test_misfits(lmp, name):
    only_if_refused(lmp, name)
    text, *words = MISFITS[name]
    line = fails(lmp, text)
    for word in words:
        assert word in line, f"no '{word}' in: {line}"


@pytest.mark.parametrize("name", ["no skin", "radii not communicated"])
def test_all_ranks_end(lmp, name):
    only_if_refused(lmp, name)
    fails(lmp, MISFITS[name][0], ranks=2)
