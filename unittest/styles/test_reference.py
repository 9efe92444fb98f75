"""Rates, energies, pressure and paths against the numbers in ../reference (see its README.md)."""

from pathlib import Path

import numpy as np
import pytest

from runner import HEAD, PRECISE, data_file

REFERENCE = Path(__file__).parents[1] / "reference"
NAMES = ["pair2d", "liquid2d", "foam2d", "foam3d"]
K, KAPPA = 0.01, 0.1

# Sums of a few terms in double precision, of coordinates up to 24 radii: some 1e-15 of the largest
# value.  A contact area near touching magnifies that, since it is a square root of the overlap:
# 1e-15 of a radius in an overlap of 1e-6 moves it by 1e-12.  The columns as a whole have a natural
# scale, their largest value; single values may be differences of larger ones.
TOLERANCE = 1e-12


class State:
    def __init__(self, name):
        self.name = name
        with open(REFERENCE / f"{name}.state.csv", encoding="ascii") as file:
            self.box = [float(word) for word in file.readline().split()[2:]]
            names = file.readline().strip().split(",")
            table = np.loadtxt(file, delimiter=",", ndmin=2)
        self.dim = len(self.box)
        self.axes = "xyz"[:self.dim]
        self.x, self.R = table[:, 1:1 + self.dim], table[:, names.index("R")]

        self.rates = self.columns(f"{name}.rates.csv")
        self.F = self.vector("F")
        self.u = self.vector("u")
        self.path = self.columns(f"{name}.path.csv")
        self.times = np.unique(self.path["t"])
        with open(REFERENCE / f"{name}.totals.csv", encoding="ascii") as file:
            self.totals = {key: float(value) for key, value in
                           (line.strip().split(",") for line in list(file)[1:])}

    @staticmethod
    def columns(name):
        with open(REFERENCE / name, encoding="ascii") as file:
            names = file.readline().strip().split(",")
            return dict(zip(names, np.loadtxt(file, delimiter=",", ndmin=2).T))

    def vector(self, letter):
        return np.column_stack([self.rates[letter + axis] for axis in self.axes])

    def data(self, v=None):
        return {"data": data_file(self.box, self.x, self.R, v)}

    def path_at(self, t):
        """Centres and radii at time t of the path, one row for each bubble."""
        now = self.path["t"] == t
        return np.column_stack([self.path[axis][now] for axis in self.axes + "R"])


@pytest.fixture(params=NAMES)
def state(request):
    return State(request.param)


def foam(dim, pair="", gas="", step="1e-5"):
    """Input up to the run: pair, gas and step are what follows the styles' first arguments."""
    return HEAD.format(dim=dim) + f"""
read_data     data
pair_style    durian/foam 1.0 {pair}
pair_coeff    * * 1.0
neighbor      0.5 bin
fix           gas all foam/coarsen {K} {KAPPA} rmin 0 {gas}
fix           step all foam/abm {step}
compute       b all foam/bubble contacts area free vfilm vliquid rdot espring edurian
compute       p all pressure NULL virial
""" + PRECISE


QUANTITIES = ["contacts", "area", "free", "vfilm", "vliquid", "rdot", "espring", "edurian"]
DUMP = """
dump          d all custom {every} dump id xu yu zu radius fx fy fz vx vy vz c_b[*]
dump_modify   d sort id time yes format float %.17g
"""


def evaluate(lmp, state, pair="", gas="", v=None):
    """State 0 of a run: the dumped frame, with the compute's columns by name, and thermo output."""
    components = " ".join(f"c_p[{k}]" for k in range(1, 7))
    result = lmp(foam(state.dim, pair, gas) + f"""
thermo_style  custom step pe c_p {components} f_gas[1] f_gas[2] f_gas[3] f_gas[5] f_gas[6]
{PRECISE}{DUMP.format(every=1)}
run           0
""", files=state.data(v))
    frame = result.dump("dump")[0]
    columns = {name: frame[f"c_b[{k}]"] for k, name in enumerate(QUANTITIES, 1)}
    columns["F"] = frame.array(*["f" + axis for axis in state.axes])
    columns["v"] = frame.array(*["v" + axis for axis in state.axes])
    return columns, {name: column[0] for name, column in result.thermo[0].items()}


def close(value, expected, scale=None):
    """Equal to TOLERANCE of the natural scale."""
    if scale is None:
        scale = np.max(np.abs(expected))
    error = np.max(np.abs(value - expected))
    assert error <= TOLERANCE * scale, f"off by {error / scale:.2g} of the scale"


# ---- rates --------------------------------------------------------------------------------------

@pytest.mark.parametrize("drag", ["static", "neighbor"])
@pytest.mark.parametrize("law", ["area", "lsw"])
def test_rates(each_lmp, state, law, drag):
    rates = state.rates
    # the velocities of the reference's neighbor drag are those of static drag, F / mu0
    got, _ = evaluate(each_lmp, state, f"drag {drag}", f"liquid {law}", v=state.F)

    close(got["F"], state.F)
    close(got["v"], state.F if drag == "static" else state.F + state.u,
          scale=np.max(np.abs(state.F)))    # the sum may cancel
    assert np.array_equal(got["contacts"], rates["contacts"])
    close(got["area"], rates["contact_area"])
    close(got["free"], rates["free_area"])
    open_ = rates["free_area"] > 0
    close((got["area"] + got["free"])[open_], rates["surface"][open_])
    close(got["vfilm"], rates["Vdot_film"])
    liquid = rates["Vdot_liquid" if law == "area" else "Vdot_lsw"]
    close(got["vliquid"], liquid)
    close(got["rdot"], (rates["Vdot_film"] + liquid) / rates["surface"])
    close(got["espring"], rates["spring_energy"])
    close(got["edurian"], rates["source_energy"])


@pytest.mark.parametrize("law", ["area", "lsw"])
def test_totals(each_lmp, state, law):
    totals = state.totals
    got, thermo = evaluate(each_lmp, state, gas=f"liquid {law}")

    close(np.mean(state.R), totals["mean_R_in"])
    assert thermo["f_gas[1]"] == 0.0
    assert thermo["f_gas[2]"] == len(state.R)
    close(thermo["f_gas[3]"], 1.0)    # <R> / <R_in>
    close(thermo["f_gas[5]"], totals["phi"])
    close(thermo["f_gas[6]"], totals["rho" if law == "area" else "rho_lsw"])
    close(thermo["PotEng"], totals["spring_energy"])
    close(np.sum(got["espring"]), totals["spring_energy"])
    close(np.sum(got["edurian"]), totals["source_energy"])
    # zero but for rounding
    close(np.sum(got["vfilm"]), totals["sum_Vdot_film"], scale=np.sum(np.abs(got["vfilm"])))
    close(np.sum(got["vliquid"]), totals["sum_Vdot_liquid"], scale=np.sum(np.abs(got["vliquid"])))


def test_means_of_the_start_are_those_of_the_totals(lmp, state):
    """<R_in> by tau = K t / <R_in>^2 after a step of known length; <A_in> by giving it."""
    got, _ = evaluate(lmp, state)
    given, _ = evaluate(lmp, state, gas=f"ain {state.totals['mean_A_in']:.17g}")
    close(given["vliquid"], got["vliquid"])

    result = lmp(foam(state.dim, step="1e3 dt0 0.01 dtmax 0.01") + f"""
thermo_style  custom step time f_gas[1]
{PRECISE}
run           1
""", files=state.data())
    close(result.thermo[0]["f_gas[1]"][-1], K * 0.01 / state.totals["mean_R_in"]**2)


def test_given_means_scale_the_rates(lmp, state):
    """Forces are proportional to <R_in>, exchange to <A_in> (area) or <R_in> (lsw)."""
    rates, totals = state.rates, state.totals
    double = f"rin {2 * totals['mean_R_in']:.17g}"
    got, thermo = evaluate(lmp, state, pair=double, gas=f"ain {3 * totals['mean_A_in']:.17g}")
    close(got["F"], 2 * state.F)
    close(thermo["PotEng"], 2 * totals["spring_energy"])
    close(thermo["f_gas[3]"], 0.5)
    close(got["vfilm"], rates["Vdot_film"])
    close(got["vliquid"], 3 * rates["Vdot_liquid"])
    got, _ = evaluate(lmp, state, pair=double, gas="liquid lsw")
    close(got["vliquid"], 2 * rates["Vdot_lsw"])


def test_pressure(each_lmp, state):
    """p = sum over pairs of r_ij . F_ij / (d V), and its components; pairs by brute force."""
    _, thermo = evaluate(each_lmp, state)
    box, R = np.array(state.box), state.R
    virial, F = np.zeros((3, 3)), np.zeros_like(state.x)
    for i in range(len(R)):
        for j in range(i):
            del_ = state.x[i] - state.x[j]
            del_ -= box * np.round(del_ / box)
            r, Rsum = np.linalg.norm(del_), R[i] + R[j]
            if r >= Rsum:
                continue
            Fij = state.totals["mean_R_in"] * (Rsum - r) / Rsum * del_ / r
            F[i] += Fij
            F[j] -= Fij
            virial[:state.dim, :state.dim] += np.outer(del_, Fij)
    close(F, state.F)    # so these are the pairs of the reference

    volume = np.prod(box)
    p = virial / volume
    close(thermo["c_p"], np.trace(p) / state.dim)
    for k, (a, b) in enumerate([(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)], 1):
        close(thermo[f"c_p[{k}]"], p[a, b], scale=np.max(np.abs(p)))


# ---- paths --------------------------------------------------------------------------------------

def values(frame, axes):
    return np.column_stack([frame[axis + "u"] for axis in axes] + [frame["radius"]])


def slopes(frame, axes):
    rdot = frame[f"c_b[{QUANTITIES.index('rdot') + 1}]"]
    return np.column_stack([frame["v" + axis] for axis in axes] + [rdot])


def fixed_step_error(lmp, state, n):
    """Largest error at the times of the path, with n steps of equal length from one to the next."""
    h = state.times[0] / n
    frames = lmp(foam(state.dim, step=f"1e9 dt0 {h:.17g} dtmax {h:.17g}")
                 + DUMP.format(every=n) + f"run {n * len(state.times)}\n",
                 files=state.data()).dump("dump")[1:]
    for frame, t in zip(frames, state.times):
        assert frame.time == pytest.approx(t, rel=1e-9)    # no step was rejected
    return max(np.max(np.abs(values(frame, state.axes) - state.path_at(t)))
               for frame, t in zip(frames, state.times))


def tolerance_error(lmp, state, tolerance):
    """The same with steps chosen by the tolerance; cubic interpolation to the times of the path.

    The interpolation's error, of order h^4, is far below that of the steps.
    """
    frames = lmp(foam(state.dim, step=f"{tolerance:g} norm max dt0 1e-4") + DUMP.format(every=1) + f"""
variable      past equal time>{state.times[-1]}
fix           end all halt 1 v_past > 0 error soft message no
thermo        100000
run           100000
""", files=state.data()).dump("dump")
    t_of = np.array([frame.time for frame in frames])
    worst = 0.0
    for t in state.times:
        k = np.searchsorted(t_of, t) - 1
        a, b = frames[k], frames[k + 1]
        h = b.time - a.time
        s = (t - a.time) / h
        y = ((1 + 2 * s) * (1 - s)**2 * values(a, state.axes)
             + s * (1 - s)**2 * h * slopes(a, state.axes)
             + s**2 * (3 - 2 * s) * values(b, state.axes)
             + s**2 * (s - 1) * h * slopes(b, state.axes))
        worst = max(worst, np.max(np.abs(y - state.path_at(t))))
    return worst


# Where contacts open or close the rates have kinks, and a step across one has an error of its own,
# by chance large or small: two bubbles that stay in contact show the order, the others scatter.
SCATTER = {"pair2d": 0.05, "liquid2d": 0.2, "foam2d": 0.2, "foam3d": 0.2}


def test_path_at_order_two(lmp, state):
    coarse, fine = fixed_step_error(lmp, state, 40), fixed_step_error(lmp, state, 160)
    assert np.log(coarse / fine) / np.log(4) == pytest.approx(2, abs=SCATTER[state.name])


def test_path_at_the_order_of_the_tolerance(lmp, state):
    """The error of a step, h^3, is the tolerance; that of the path, h^2, its power 2/3."""
    coarse, fine = tolerance_error(lmp, state, 1e-4), tolerance_error(lmp, state, 1e-7)
    assert np.log10(coarse / fine) / 3 == pytest.approx(2 / 3, abs=SCATTER[state.name] / 2)
    # of order 1 is the factor, by 5 to 20 time constants of the springs: 0.1 to 0.2 measured
    assert fine < 0.4 * 1e-7**(2 / 3)


# steps that are fine enough for the path's own accuracy; for liquid2d, 1e-8, both errors add up
FINE = {"pair2d": (30000, 1e-11), "liquid2d": (10000, 2e-8),
        "foam2d": (1280, 1e-7), "foam3d": (2560, 1e-7)}


def test_path_to_its_accuracy(lmp, state):
    n, accuracy = FINE[state.name]
    assert fixed_step_error(lmp, state, n) < accuracy
