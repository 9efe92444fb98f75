"""Random scenes: everything that can be combined is, at random, and nothing may break.

FOAM_EXTREME_CASES=N   so many scenes
FOAM_EXTREME_SEED=S    those of the seeds S, S + 1, ...
A test that fails prints the command that repeats it.
"""

import os

import numpy as np

from runner import on_device
from scenes import FULL, INTEGRATORS, Scene, box_for, cases, last, radii
from test_units import assert_scaled

FIRST = int(os.environ.get("FOAM_EXTREME_SEED", 0))
NUMBER = int(os.environ.get("FOAM_EXTREME_CASES", 200 if FULL else 12))


def random_scene(seed):
    """A scene, and on how many ranks it runs."""
    random = np.random.default_rng(seed)

    def one_of(*values):
        return values[random.integers(len(values))]

    def between(low, high):    # in orders of magnitude
        return float(np.exp(random.uniform(np.log(low), np.log(high))))

    # the foam

    dim = one_of(2, 3)
    n = int(between(1, 300))
    R = radii(random, n, one_of(0.0, 0.01, 0.21, 0.5, 1.0))
    if random.random() < 0.3:    # giants among them
        giants = random.integers(n, size=1 + n // 30)
        R[giants] *= between(1, 1000)
    shape = [between(0.1, 10) for _ in range(dim)] if random.random() < 0.3 else None
    box = np.array(box_for(R, dim, between(0.01, 1.3), shape))
    x = random.random((n, dim)) * box
    if random.random() < 0.2:    # some at the same places
        x = x[random.integers(max(1, n // 2), size=n)]
    tilt = None
    if random.random() < 0.3:
        xy, xz, yz = random.uniform(-1, 1, 3) * one_of(0.5, 0.5, 2.0)
        tilt = (xy * box[0], xz * box[0] * (dim == 3), yz * box[1] * (dim == 3))
    boundary = "p p p"
    if random.random() < 0.2 and not tilt and n > 10:    # the box of one would have no width
        boundary = " ".join(one_of("p", "s", "m") for _ in range(dim)) + " p" * (3 - dim)

    # how it is run

    scheme = one_of("", "", "", "variable radius", "scheme source")
    integrator = one_of(*INTEGRATORS)
    if "abm" not in integrator:
        scheme = scheme.replace("scheme source", "")
    drag = one_of("static", "static", "neighbor")
    if drag == "neighbor" and not scheme and random.random() < 0.5:
        scheme = "drift remove"
    K = one_of(None, 0.0, between(1e-9, 1.0), between(1e-3, 1.0), between(1e-3, 1.0))
    ranks = one_of("1 1 1", "2 1 1", "1 2 1")
    lines = [f"processors {ranks}", one_of("newton on", "newton off"),
             f"atom_modify sort {one_of(0, 10, 1000)} 0.0"]
    if boundary == "p p p" and min(box) > 5 * R.max() + 10 and random.random() < 0.3:
        lines += ["comm_style tiled"]
    run = one_of(60, 60, 600)
    sigma0, mu0 = one_of(1.0, 1.0, 1.0, 0.0, between(1e-6, 1e6)), one_of(1.0, between(1e-6, 1e6))
    relaxes = mu0 / sigma0 if sigma0 else 1.0    # the time in which springs do
    scene = Scene(
        x, R, list(box), tilt=tilt, boundary=boundary, integrator=integrator, step=scheme,
        tol=between(1e-9, 1.0), dt0=relaxes * between(1e-6, 1e6),
        dtmax=one_of(None if sigma0 or K else 1e3, relaxes * between(1e-3, 1e9)), K=K and K / relaxes,
        kappa=one_of(0.0, between(1e-6, 1e3), between(1e-2, 10)),
        gas=f"liquid {one_of('area', 'lsw')} nmin {one_of(0, 1, n // 2)}",
        rmin=one_of(0.0, 0.01, 0.1, 0.1, 0.5), rin=one_of(None, None, between(0.5, 2.0)),
        sigma0=sigma0, mu0=mu0,
        pair=f"drag {drag} headroom {between(1.0, 3.0):.6g}", skin=one_of(0.3, between(0.001, 10.0)),
        neighbor=one_of("bin", "bin", "bin", "nsq", "multi"), before="\n".join(lines),
        gas_limit=np.inf if "radius" in scheme or "source" in scheme else 1e-12,
        run=run, every=run // 3, gas_first=bool(random.integers(2)))
    return scene, 1 + ranks.count("2")


def same_bits(a, b):
    for name in a._columns:
        assert np.array_equal(a[name], b[name]), f"{name}: {np.abs(a[name] - b[name]).max()}"


@cases("seed", range(FIRST, FIRST + NUMBER))
def test_random_scene(lmp, seed):
    """It is sound; a restart from its middle goes on with the same bits; in other units it has the
    same bits, too; and the start is the same on another number of ranks."""
    print(f"again: FOAM_EXTREME_SEED={seed} FOAM_EXTREME_CASES=1 FOAM_EXTREME_BACKENDS={lmp.name} "
          "python -m pytest unittest/extremes/test_random.py")
    scene, ranks = random_scene(seed)
    if lmp.kokkos:
        scene = scene.but(neighbor="bin")    # KOKKOS has no other
    if on_device(lmp):                       # nor these, in the way it runs on a device
        before = scene.before.replace("comm_style tiled", "").replace("newton on", "newton off")
        scene = scene.but(before=before)
    scene = scene.scaled(length=1024.0)    # units are changed on one side, see test_units.py
    half = scene.run // 2
    scene = scene.but(after=f"restart {half} state.*")
    result = scene(lmp, ranks=ranks)

    # scheme source guesses from the rates whether bubbles have been moved between two runs, and
    # centres that nearly coincide have rates that tell little
    crowded = "source" in scene.step and len(np.unique(scene.x, axis=0)) < len(scene.x)
    if result.thermo[0]["Step"][-1] > half and not crowded:
        again = lmp(scene.continued(f"state.{half}", scene.run - half), ranks=ranks,
                         directory=result.directory)
        same_bits(last(result), again.dump("last2")[0])

    # in 3D bubbles that shrink to nothing pass the 1 of either units on their way, where glibc's cube
    # root rounds in another way

    if scene.dim == 2 or scene.rmin > 0.0:
        scale = (2.0**30, 2.0**20, 2.0**-40)
        assert_scaled(result, scene.scaled(*scale)(lmp, ranks=ranks), scene.dim, scale, 0.0)

    other = scene.before.replace("processors", "#")
    start = scene.but(run=0, before=other, after="")(lmp, ranks=3 - ranks)
    a, b = result.dump("dump")[0], start.dump("dump")[0]
    for name in a._columns:
        if name[0] not in "xyz":    # images
            assert np.abs(a[name] - b[name]).max() <= 1e-12 * max(np.abs(a[name]).max(), 1e-300), name
