"""The KOKKOS styles of bubbles with inertia, in all ways in which a scene can be put: against the base styles.

One evaluation agrees to 1e-12: the same formulae, sums over the partners of a bubble in another order.  In a run,
rounding grows as nearby paths part: 1e-9 after some 100 steps (foams.py)."""

import numpy as np
import pytest

from foams import SAME, SHORT
from runner import BACKENDS, KOKKOS, Runner
from test_bubble import MM, RHO, MU, G, data, text

SIDE = 3 * MM
LIQUID = f"{RHO} {MU} 0 0 -{G}"
WALLS = ["plane 0 0 -1.5e-3 0 0 1", "plane 0 0 1.5e-3 0 0 -1"]


def crowd(n=5, spread=0.25, seed=11):
    """n^3 bubbles near the sites of a grid, of radii 0.2 to 0.36 mm, in part closer than the sum of their radii."""
    random = np.random.default_rng(seed)
    a = SIDE / n
    sites = np.stack(np.meshgrid(*[np.arange(n)] * 3, indexing="ij"), -1).reshape(-1, 3)
    x = (sites + 0.5) * a - SIDE / 2 + spread * a * random.uniform(-1, 1, sites.shape)
    x[:, 2] *= 0.9    # free of the walls
    R = random.uniform(0.20, 0.36, len(x)) * MM
    v = 0.05 * random.uniform(-1, 1, x.shape)
    return data(x, R, v, [(-SIDE / 2, SIDE / 2)] * 3)


RUN = dict(wall=WALLS, rise=LIQUID, boundary="p p f", dt=2e-6, run="run 100", every=20, skin=2e-4)
ALL = "tangential all"
EXTRA = "compute e all pe/atom\ncompute s all stress/atom NULL pair\n" \
        "dump extra all custom 20 extra id c_e c_s[*]\ndump_modify extra sort id format float %.17g"
FLOW = "variable ux atom 10*z\nvariable uz atom -0.01"
SCENES = {
    "plain": {},
    "2 ranks": dict(ranks=2),
    "4 ranks, tangential": dict(ranks=4, pair=ALL),
    "chosen steps": dict(step="fix s all bubble/nve tol 1e-3", pair=ALL),
    "chosen steps, 2 ranks": dict(step="fix s all bubble/nve tol 1e-3 dtmax 3e-6", ranks=2),
    "exact integral": dict(pair="integral exact viscous derived"),
    "h0 current": dict(pair="h0 current film no"),
    "h0 given, spring": dict(pair="h0 2e-5 elastic spring reach 0.3", ranks=2),
    "walls of their own": dict(wall=["plane 0 0 -1.5e-3 0 0 1 tangential no elastic spring",
                                     "plane 0 0 1.5e-3 0 0 -1 integral exact viscous derived"]),
    "region": dict(wall="region cage", before="region cage block -1.5e-3 1.5e-3 -1.5e-3 1.5e-3 -1.5e-3 1.5e-3",
                   ranks=2),
    "implicit drag": dict(rise=f"{LIQUID} drag clean implicit yes"),
    "flow": dict(rise=f"{LIQUID} flow v_ux NULL v_uz", before=FLOW, ranks=2),
    "no walls": dict(wall="", boundary="p p p"),
    "no liquid": dict(rise=""),
    "some move": dict(step="group some id 1:60\nfix s some bubble/nve", ranks=2),
    "sorted often": dict(after="atom_modify sort 10 2e-4", ranks=2),
    "two runs": dict(run="run 50\nrun 50"),
    "pre no": dict(run="run 50 post no\nrun 50 pre no", ranks=2),
    "pair style again": dict(run="run 50\npair_style bubble/collision 0.05 1e-3 h0 current\npair_coeff * *\nrun 50"),
    "velocities changed": dict(run="run 50\nvelocity all set 0.1 0 0\nrun 50"),
    "bubbles deleted": dict(run="run 50\ngroup some id 1:20\ndelete_atoms group some compress no\nrun 50", ranks=2),
    "restarts written": dict(run="restart 20 state.*\nrun 100", ranks=2),
    "energies and stresses": dict(run=f"{EXTRA}\nrun 100", ranks=2),
    "means": dict(run="fix m all ave/atom 1 10 20 c_c[1] c_c[21] vz\ndump extra all custom 20 extra id f_m[*]\n"
                      "dump_modify extra sort id format float %.17g\nrun 100", ranks=2),
}


def scene(name):
    options = {**RUN, **SCENES[name]}
    ranks = options.pop("ranks", 1)
    return text(**options), crowd(), ranks


def assert_same(plain, other, limit):
    """Columns of all quantities; parts of 1e-12 of what is typical of a column are rounding, too."""
    assert len(plain.thermo) == len(other.thermo)
    for one, more in zip(plain.thermo, other.thermo):
        assert list(one) == list(more)
        for name in one:
            near(one[name], more[name], limit, name)
    kinds = ["dump"] + (["extra"] if (plain.directory / "extra").exists() else [])
    for kind in kinds:
        frames = list(zip(plain.dump(kind), other.dump(kind)))
        assert frames
        for f, g in frames:
            assert np.array_equal(f["id"], g["id"])
            for name in f._columns:
                near(f[name], g[name], limit, name)


def near(a, b, limit, name):
    a, b = np.asarray(a, float), np.asarray(b, float)
    assert np.abs(a - b).max(initial=0.0) <= limit * np.abs(a).max(initial=1e-30), name


@pytest.fixture(scope="session")
def of_base_styles(tmp_path_factory):
    """function: what the base styles make of a scene, each run once"""
    made, directory = {}, tmp_path_factory.mktemp("bubbles")

    def run(name):
        if name not in made:
            input, files, ranks = scene(name)
            made[name] = Runner("wheel", directory / str(len(made)))(input, files=files, ranks=ranks)
        return made[name]

    return run


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("pair", ["", ALL, "h0 current", "integral exact viscous derived"])
def test_one_evaluation(kk_lmp, tmp_path, pair, ranks):
    """Forces and all that is known of each bubble."""
    input = text(**{**RUN, "pair": pair, "run": "run 0", "every": 1})
    plain = Runner("wheel", tmp_path / "plain")(input, files=crowd())
    frame = plain.dump("dump")[0]
    assert frame["c_c[19]"].max() > 0.0 and frame["c_c[22]"].max() >= 4    # films, several contacts
    assert_same(plain, kk_lmp(input, files=crowd(), ranks=ranks), SAME)


# two threads have all that one has
@pytest.mark.parametrize("kk_lmp", [name for name in KOKKOS if name != "kk1"], indirect=True)
@pytest.mark.parametrize("name", SCENES)
def test_scene(kk_lmp, of_base_styles, name):
    input, files, ranks = scene(name)
    other = kk_lmp(input, files=files, ranks=ranks)
    assert_same(of_base_styles(name), other, SHORT)


# ---- suffixes -----------------------------------------------------------------------------------

KK = "cuda" if "cuda" in BACKENDS else "kk2" if "kk2" in BACKENDS else KOKKOS[0]
NO_SUFFIX = "-k on g 1" if KK == "cuda" else "-k on t 2"


STYLES = {"pair": ["pair_style bubble/collision", "all pair bubble/collision"], "wall": ["all wall/bubble"],
          "rise": ["all bubble/rise"], "nve": ["all bubble/nve"]}


def with_suffix(input, suffix, styles=STYLES):
    for kind in styles:
        for style in STYLES[kind]:
            input = input.replace(style, style + suffix)
    return input.replace("sphere\n", "sphere/kk\n").replace("neighbor ", "run_style verlet/kk\nneighbor ", 1)


@pytest.mark.parametrize("suffix", ["/kk", "/kk/device", "/kk/host"])
def test_styles_by_their_full_names(backends, of_base_styles, suffix):
    input, files, _ = scene("plain")
    other = backends(KK, NO_SUFFIX)(with_suffix(input, suffix), files=files)
    assert_same(of_base_styles("plain"), other, SHORT)
    assert "pair bubble/collision/kk" in other.screen


@pytest.mark.parametrize("kind, named", [
    ("pair", "Fix wall/bubble and pair style bubble/collision"),
    ("wall", "Fix wall/bubble and pair style bubble/collision"),
    ("nve", "Fix bubble/nve and pair style bubble/collision"),
    ("rise", "Fix bubble/nve and fix bubble/rise")])
def test_sides_do_not_mix(backends, kind, named):
    result = backends(KK, NO_SUFFIX)(with_suffix(text(**RUN), "/kk", [kind]), files=crowd(), check=False)
    assert result.returncode
    assert f"{named} must run in the same place: use the suffix kk for all styles of bubbles or for none" \
        in " ".join(result.screen.split())
