"""Bubbles with inertia where the model is at its limits.  In all scenes what they have of energy, kinetic with the
added mass and elastic, less the work of buoyancy, never grows by more than the steps explain; runs end; nobody is
behind a wall.

FOAM_EXTREMES=full takes the long forms: 10^6 steps at rest, 5000 bubbles under a lid.  pytest -rP prints the figures of
the table in doc/collision.rst.
"""

import os

import numpy as np
import pytest

from test_bubble import G, MM, MU, R6, RHO, SIGMA, UM, data, elastic, term, text
from test_bubble_motion import MODELS, SOFT, STILL, buoyancy

FULL = os.environ.get("FOAM_EXTREMES") == "full"
LIQUID = f"{RHO} {MU} 0 0 -{G} implicit yes"
FILMS = ("published", "derived")
SIZES = (10 * UM, 0.1 * MM, R6, 3 * MM)
# A step is wrong by tol, that in which a film closes by more; there are few of these, and a halved tol halves all of it
TOLS = (1e-3, 1e-4, 1e-5)
LIMIT = 20    # times tol

CRITICAL = 3 / np.pi * (18.5 / 3 + 1)    # rho u^2 R / sigma whose kinetic energy takes eq. 9 to Delta = R


def film(model, *R):
    """A film that is thicker than the bubble is none."""
    return f"{MODELS[model]} hmin {min(10 * UM, 0.1 * min(R)):g}"


def chosen(tol, dtmax=1e-2):
    return f"fix s all bubble/nve tol {tol} dtmax {dtmax}"


class Run:
    """Of a scene: what it printed, where bubbles were."""

    def __init__(self, lmp, lines, bubbles, wall=True):
        result = lmp(lines, bubbles)
        self.t, self.frames = result.thermo[0], result.dump("dump")
        self.held = self.t["f_r[5]"] + self.t["c_p"] + (self.t["f_w"] if wall else 0.0)
        self.energy = self.held - self.t["f_r[1]"]

    @property
    def growth(self):
        """By how much the energy exceeds what it was before, at the most, over the most that there was to turn over."""
        most = max(self.held.max(), np.abs(self.t["f_r[1]"]).max())
        return float((self.energy - np.minimum.accumulate(self.energy)).max() / most)

    def z(self, k=0):
        return np.array([frame["z"][k] for frame in self.frames])


def assert_sound(runs):
    """One run for each tol."""
    growths = [run.growth for run in runs]
    print("growth", *(f"{growth:.1e}" for growth in growths), "steps", runs[1].t["Step"][-1])
    for run, growth, tol in zip(runs, growths, TOLS):
        assert np.isfinite(run.energy).all() and growth < LIMIT * tol


# ---- one bubble, and a wall ---------------------------------------------------------------------

@pytest.mark.parametrize("model", FILMS)
@pytest.mark.parametrize("R", SIZES)
def test_rises_to_a_lid(lmp, R, model):
    """From rest, a gap of R / 5; the smallest, which creeps, from nearly h0, or from within its film where the steps
    are as short as the film's friction has them. Of 3 mm a centre swings through the lid,
    since eq. 9 is soft, and back."""
    words = film(model, R)
    gap, steps = (0.099 if model == "derived" else 0.101, 3000) if R < 20 * UM else (0.2, 1500)
    bubble = data([0, 0, -(1 + gap) * R], R, box=[(-9 * R, 9 * R)] * 3)
    runs = [Run(lmp, text(pair=words, wall=f"plane 0 0 0 0 0 -1 {words}", rise=LIQUID, dt=1e-6, skin=R, every=5,
                          step=chosen(tol), run=f"run {steps}"), bubble) for tol in TOLS]
    print("highest", *(f"{run.z().max() / R:.3f}" for run in runs))
    assert_sound(runs)
    assert all(run.t["f_w[4]"].max() == 1 and run.z()[-1] < 0.0 for run in runs)
    assert R > 1 * MM or all(run.z().max() < 0.0 for run in runs)


@pytest.mark.parametrize("model", FILMS)
@pytest.mark.parametrize("R", SIZES)
def test_head_on_at_a_wall(lmp, R, model):
    """1 m/s.  At a Weber number above that of eq. 9 a centre comes through for a while, and back."""
    words = film(model, R)
    runs = [Run(lmp, text(pair=words, wall=f"plane 0 0 0 0 0 -1 {words}", rise=STILL, skin=0.3 * R, dt=1e-3 * R,
                          every=5, step=chosen(tol, 5e-3 * R), run="run 1500"),
                data([0, 0, -1.5 * R], R, [[0, 0, 1.0]], box=[(-40 * R, 40 * R)] * 3)) for tol in TOLS]
    assert_sound(runs)
    for run in runs:
        print("deepest", run.z().max() / R)
        assert run.energy[-1] < (1 - 1e-3) * run.energy[0] and run.z()[-1] < -0.5 * R
        if RHO * 1.0**2 * R / SIGMA < CRITICAL:
            assert run.z().max() < 0.0


@pytest.mark.parametrize("R, dt", [(10 * UM, 1e-7), (R6, 1e-5)])
def test_rests(lmp, R, dt):
    """It comes to where eq. 9 carries it, and stays: what is left of the approach falls, in the end to roundings."""
    steps = 10**6 if FULL else 10**4
    words = film("published", R)
    run = Run(lmp, text(pair=words, wall=f"plane 0 0 0 0 0 -1 {words}", rise=LIQUID, skin=R, dt=dt, every=steps // 100,
                        run=f"run {steps}"), data([0, 0, -R], R, box=[(-9 * R, 9 * R)] * 3))
    drift, force = np.ptp(run.z()[50:]) / R, run.t["f_w[3]"][-1] / buoyancy(R)
    print(f"growth {run.growth:.1e} drift {drift:.1e} force {force - 1:.1e}")
    # by rounding: z has 1e-16 R in each step, at random
    assert drift < (1e-12 if FULL else 1e-3)
    assert force == pytest.approx(1.0, abs=1e-9 if FULL else 1e-4)
    assert np.all(run.t["f_w[4]"] == 1) and run.growth < 1e-9
    h0 = term(run.frames[-1], "h0")[0]
    assert elastic(h0 + R + run.z()[-1], R) == pytest.approx(run.t["f_w[3]"][-1], rel=1e-4)    # the film moves no more


# ---- two bubbles --------------------------------------------------------------------------------

@pytest.mark.parametrize("model", FILMS)
@pytest.mark.parametrize("R, other", [(R, R) for R in SIZES[:-1]] + [
    pytest.param(3 * MM, 3 * MM, marks=SOFT), (1 * MM, 10 * UM), (3 * MM, 30 * UM)])
def test_head_on(lmp, R, other, model):
    """1 m/s, equal or 1:100."""
    words = film(model, R, other)
    runs = [Run(lmp, text(pair=words, rise=STILL, skin=0.3 * R, dt=1e-3 * other, every=5, run="run 1500",
                          step=chosen(tol, 5e-3 * other)),
                data([[0, 0, 0], [0, 0, R + 1.5 * other]], [R, other], [[0, 0, 0.5], [0, 0, -0.5]],
                     box=[(-40 * R, 40 * R)] * 3), wall=False) for tol in TOLS]
    assert_sound(runs)
    assert all(np.all(run.z(1) > run.z(0)) and run.energy[-1] < (1 - 1e-6) * run.energy[0] for run in runs)


@pytest.mark.parametrize("model", FILMS)
@pytest.mark.parametrize("radii", [(R6, R6), (R6, R6, R6), (R6, R6 / 100), (10 * UM, 10 * UM)])
def test_coincident_centres(lmp, radii, model):
    """From rest: all that they have is what has been put in by force. The first to part are apart in the end."""
    R, words = np.array(radii), film(model, *radii)
    run = Run(lmp, text(pair=words, rise=STILL, skin=0.3 * R6, dt=1e-8, every=5, run="run 1500",
                        step=chosen(1e-4, 0.01 * R.min())),
              data(np.zeros((len(R), 3)), R, box=[(-20 * R[0], 20 * R[0])] * 3), wall=False)
    x = run.frames[-1]["x"]
    print(f"growth {run.growth:.1e} apart {np.ptp(x) / (R[0] + R[-1]):.3g}")
    assert np.isfinite(run.energy).all() and run.growth < LIMIT * 1e-4
    assert np.ptp(x) > 0.9 * (R[0] + R[-1]) and x[-1] == x.max() and x[0] == x.min()


@pytest.mark.parametrize("model", FILMS)
@pytest.mark.parametrize("gap", [0.5, 0.0, -5.0, -30.0])
@pytest.mark.parametrize("scene", ["wall", "pair", "1:100"])
def test_starts_within_a_film(lmp, scene, gap, model):
    """At rest, a gap below h0, in h0. The energy in a thin film is known only as far as the place is: 2 tol R over the
    deformation, of it."""
    R = np.array([R6] if scene == "wall" else [R6, R6 if scene == "pair" else R6 / 100])
    small = R.min()
    words, h0 = film(model, *R), min(10 * UM, 0.1 * small)
    if scene == "wall":
        wall, bubbles = f"plane 0 0 0 0 0 -1 {words}", data([0, 0, -R6 - gap * h0], R)
    else:
        wall, bubbles = "", data([[0, 0, 0], [0, 0, R.sum() + gap * h0]], R)
    run = Run(lmp, text(pair=words, wall=wall, rise=STILL, skin=0.3 * R6, dt=1e-8, every=5, run="run 1000",
                        step=chosen(1e-4, 0.01 * small)), bubbles, wall=scene == "wall")
    print(f"growth {run.growth:.1e}")
    assert run.held[0] > 0.0 and run.growth < max(LIMIT, 2 * small / ((1 - gap) * h0)) * 1e-4
    if scene == "wall":
        assert run.z()[-1] < -0.5 * R6
    else:
        assert run.z(1)[-1] > run.z(0)[-1]


# ---- many ---------------------------------------------------------------------------------------

@pytest.mark.parametrize("model", FILMS)
def test_crowd_under_a_lid(lmp, model):
    """From random places, the most of them within others, 20 to 400 micrometres: nobody is behind the lid."""
    number, steps = (5000, 5000) if FULL else (300, 1000)
    side, depth = 3 * MM * np.sqrt(number / 300), 3 * MM
    rng = np.random.default_rng(5)
    R = rng.permutation(np.geomspace(0.02, 0.4, number)) * MM
    x = np.column_stack([rng.uniform(0, side, (number, 2)), rng.uniform(-depth, 0, number) - R])
    words = film(model, R.min())
    run = Run(lmp, text(pair=words, wall=f"plane 0 0 0 0 0 -1 {words}", rise=LIQUID, dt=1e-7, every=steps // 20,
                        skin=0.1 * MM, step=chosen(1e-4), run=f"run {steps}", boundary="p p f"),
              data(x, R, box=[(0, side), (0, side), (-4 * depth, MM)]))
    print(f"growth {run.growth:.1e} time {run.t['Time'][-1]:.3g} contacts {run.t['c_p[4]'][-1]:.0f} "
          f"at the lid {run.t['f_w[4]'][-1]:.0f}")
    assert run.growth < LIMIT * 1e-4 and run.energy[-1] < 0.9 * run.energy[0]
    assert all(len(frame) == number and frame["z"].max() < 0.0 for frame in run.frames)
