"""The KOKKOS styles of a resolved liquid and of bubbles in it, in all ways in which a scene can be put: against the
base styles.

One evaluation agrees to rounding, the pressure to 1e-11 (test_liquid.py). In a run of ten steps rounding grows by less
than 10^3, as nearby paths part: 1e-9 leaves room, also for the solver, which ends at 1e-12."""

import pytest

import test_liquid as liquid
from foams import SHORT
from runner import BACKENDS, KOKKOS, Runner
from test_bubble_kokkos import near
from test_liquid_bubbles import BREAKING, SPARGER, tank

# ---- one evaluation -----------------------------------------------------------------------------


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("name", ["periodic", "tank"])
def test_one_evaluation(kk_lmp, tmp_path, name, ranks):
    """All that is known of each particle and bubble of the reference states."""
    input, files = liquid.script(name, "off", "run 0"), {"data": liquid.state(name)}
    plain = Runner("wheel", tmp_path / "plain")(input, files=files)
    other = kk_lmp(input, files=files, ranks=ranks)
    assert_same(plain, other, 1e-11)
    assert "pair liquid/sph/kk" in other.screen


# ---- scenes -------------------------------------------------------------------------------------

MANY = "create_atoms 2 random 30 771 full overlap 0.02 maxtry 1000"
# no quantity is 0 but for rounding
SHAKEN = "displace_atoms {} random 0.01 0.01 0.01 77 units box\n"
SWIRL = SHAKEN.format("water") + """variable ux atom sin(7*z)
variable uy atom 0.2*cos(8*x)
variable uz atom 0.3*cos(8*y)
velocity water set v_ux v_uy v_uz"""
CLOSED = [("boundary      p p f", "boundary      f f f"),
          ("wall zlo slip", "wall zlo slip wall xlo noslip wall xhi noslip wall ylo slip wall yhi noslip")]
RUN = dict(create=MANY, velocity=SWIRL, gas="surface yes", ranks=1, change=[], run="run 10")
SCENES = {
    "plain": {},
    "2 ranks": dict(ranks=2),
    "4 ranks": dict(ranks=4, change=[("les none", "les smagorinsky 0.2")]),
    "mixed closure": dict(change=[("les none", "les mixed 0.06")]),
    "walls all around": dict(change=CLOSED, ranks=2),
    "chosen steps": dict(change=[("dtmax 0.02", "")], ranks=2),
    "no shift": dict(change=[("les none", "les none shift no")]),
    "no forces but drag": dict(gas="surface no lift no virtual no substep no", ranks=2),
    "turbulence": dict(gas="surface no langevin 7", change=[("les none", "les mixed 0.06")], ranks=2),
    "breaking": dict(create=MANY.replace(" 30 ", " 10 "), velocity=BREAKING, gas="surface no breakup 5", diameter=0.04,
                     We=1e6, dt=0.002, run="run 60"),
    "bursting": dict(create="region top block 0 0.8 0 0.8 0.95 1.2 units box\n" + MANY.replace("full", "top")),
    "sparger": dict(create="", run=f"{SPARGER}\nrun 10", ranks=2),
    "entrained": dict(velocity=BREAKING, gas="surface yes entrain 9", dt=0.002, ranks=2),
    "other forces": dict(run="fix push water addforce 1e-3 0 0\nrun 10"),
    "start given": dict(change=[("wall zlo slip", "wall zlo slip pressure v_p acceleration v_a v_a v_a"),
                                ("fix           l", "variable p atom 1-z\nvariable a atom 0.1*x\nfix           l")]),
    "sorted often": dict(change=[("fix           l", "atom_modify sort 3 0.2\nfix           l")], ranks=2),
    "ranks in tiles": dict(change=[("comm_modify", "comm_style tiled\ncomm_modify")], ranks=2),
    "no bubbles yet": dict(create=""),
    "two runs": dict(run="run 5\nrun 5"),
    "pre no": dict(run="run 5 post no\nrun 5 pre no", ranks=2),
    "bubbles deleted": dict(run="run 5\ngroup few id 650:660\ndelete_atoms group few compress no\nrun 5"),
    "restarts written": dict(run="restart 4 state.*\nrun 10", ranks=2),
}


def look(gas=True):
    """Output of all that is known, to the last digit."""
    of_gas = f"compute d gas bubble/flow {' '.join(liquid.BUBBLE)}\n" if gas else ""
    return (f"compute c all liquid/particle {' '.join(liquid.PARTICLE)}\n{of_gas}"
            f"dump dump all custom 5 dump id type x y z vx vy vz radius mass c_c[*] {'c_d[*]' if gas else ''}\n"
            "dump_modify dump sort id format float %.17g\nthermo 5\n"
            f"thermo_style custom step time f_l[2] f_l[5] f_l[6] f_l[7] f_l[8] {'f_b[*]' if gas else ''}\n"
            "thermo_modify norm no format float %.17g\n")


def scene(name):
    """Input, and number of ranks."""
    options = {**RUN, **SCENES[name]}
    ranks, change, run = (options.pop(key) for key in ("ranks", "change", "run"))
    text = tank(**options)
    for old, new in [*change, ("wall zlo", "solver 1e-12 2000 wall zlo")]:
        assert old in text
        text = text.replace(old, new, 1)
    return text + look() + run + "\n", ranks


def liquid_alone():
    """Without a second group, all particles are in the liquid."""
    text = liquid.VORTEX.format(n=12, Re=100, more="solver 1e-12 2000 pressure v_p acceleration v_p v_p v_p")
    text = text.replace("pair_style", f"{SHAKEN.format('all')}variable p atom 0\npair_style")
    return text + look(gas=False) + "run 10\n"


def assert_same(plain, other, limit):
    assert len(plain.thermo) == len(other.thermo)
    for one_of_them, more in zip(plain.thermo, other.thermo):
        assert list(one_of_them) == list(more)
        for name in one_of_them:
            near(one_of_them[name], more[name], limit, name)
    frames = list(zip(plain.dump("dump"), other.dump("dump"), strict=True))
    assert frames
    for f, g in frames:
        assert list(f["id"]) == list(g["id"])
        for name in f._columns:
            near(f[name], g[name], limit, name)


def text_of(name):
    """Input, files (none) and number of ranks."""
    text, ranks = (liquid_alone(), 1) if name == "liquid alone" else scene(name)
    return text, {}, ranks


@pytest.fixture(scope="session")
def of_base_styles(tmp_path_factory):
    """function: what the base styles make of a scene, each run once"""
    made, directory = {}, tmp_path_factory.mktemp("liquid")

    def run(name):
        if name not in made:
            lmp = Runner("wheel", directory / name.replace(" ", "-"))
            text, files, ranks = text_of(name)
            made[name] = lmp(text, files=files, ranks=ranks)
        return made[name]

    return run


# two threads have all that one has
@pytest.mark.parametrize("kk_lmp", [name for name in KOKKOS if name != "kk1"], indirect=True)
@pytest.mark.parametrize("name", [*SCENES, "liquid alone"])
def test_scene(kk_lmp, of_base_styles, name):
    text, files, ranks = text_of(name)
    assert_same(of_base_styles(name), kk_lmp(text, files=files, ranks=ranks), SHORT)


def test_scenes_have_what_they_are_named_for(of_base_styles):
    """Bubbles that break, burst, are born."""
    last = {name: of_base_styles(name).thermo[-1] for name in ("breaking", "bursting", "sparger", "entrained")}
    assert last["breaking"]["f_b[4]"][-1] > 2
    assert last["bursting"]["f_b[5]"][-1] > 2
    assert last["sparger"]["f_b[1]"][-1] > 5
    assert last["entrained"]["f_b[3]"][-1] > 5


@pytest.mark.parametrize("reader", ["wheel", "kk2"])
@pytest.mark.parametrize("writer", ["wheel", "kk2"])
def test_restart_files_go_with_all(backends, writer, reader):
    """A run goes on from a file of either styles as one that was not interrupted."""
    text, _ = scene("turbulence")
    whole = backends("wheel")(text)
    first = backends(writer)(text.replace("run 10\n", "run 5\nwrite_restart state\n"))
    head, tail = text.split("create_atoms", 1)[0], text[text.index("pair_style"):]
    head = head[:head.index("lattice")] + "read_restart state\n"
    for line in "atom_style    sphere 1\n", "boundary      p p f\n":
        head = head.replace(line, "")
    second = backends(reader)(head + tail.replace("run 10\n", "run 5\n"), directory=first.directory)
    f, g = whole.dump("dump")[-1], second.dump("dump")[-1]
    assert list(f["id"]) == list(g["id"])
    for name in f._columns:
        if name not in ("x", "y"):    # a box apart, perhaps
            near(f[name], g[name], SHORT, name)


# ---- suffixes -----------------------------------------------------------------------------------

KK = "cuda" if "cuda" in BACKENDS else "kk2" if "kk2" in BACKENDS else KOKKOS[0]
NO_SUFFIX = "-k on g 1" if KK == "cuda" else "-k on t 2"
STYLES = {"pair": "pair_style    liquid/sph", "liquid": "water liquid/flow", "gas": "gas bubble/flow"}


def with_suffix(text, suffix, styles=STYLES):
    for kind in styles:
        assert STYLES[kind] in text
        text = text.replace(STYLES[kind], STYLES[kind] + suffix, 1)
    return text.replace("sphere 1", "sphere/kk 1").replace("neighbor ", "run_style verlet/kk\nneighbor ", 1)


@pytest.mark.parametrize("suffix", ["/kk", "/kk/device", "/kk/host"])
def test_styles_by_their_full_names(backends, of_base_styles, suffix):
    text, _ = scene("plain")
    other = backends(KK, NO_SUFFIX)(with_suffix(text, suffix))
    assert_same(of_base_styles("plain"), other, SHORT)
    assert "pair liquid/sph/kk" in other.screen


@pytest.mark.parametrize("kinds, named", [
    (["pair"], "Fix liquid/flow"), (["liquid", "gas"], "Fix liquid/flow"), (["pair", "liquid"], "Fix bubble/flow")])
def test_sides_do_not_mix(backends, kinds, named):
    result = backends(KK, NO_SUFFIX)(with_suffix(scene("plain")[0], "/kk", kinds), check=False)
    assert result.returncode
    assert f"{named} and pair style liquid/sph must run in the same place: use the suffix kk for all styles of a " \
        "liquid and its bubbles or for none" in " ".join(result.screen.split())
