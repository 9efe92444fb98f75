"""Contact laws of the pair style: closed forms for pairs, and foams that relax, coarsen and restart."""

import re

import numpy as np
import pytest

from foams import SAME, assert_same_run, assert_same_state, case, foam, state
from runner import HEAD, PRECISE, data_file

LAWS = ["spring", "power 2.5", "power 1.5", "sticky 0.1", "surface 0.6"]
KINDS = [(law, dim) for law in LAWS for dim in (2, 3) if dim == 3 or "surface" not in law]
SPRING_LIKE = [law for law in LAWS if law.split()[0] in ("spring", "power")]


def power(law):
    """The exponent of a law."""
    return float(law.split()[1]) if "power" in law else 2.0


def force_and_energy(law, k, overlap, Ri, Rj):
    """Closed forms; k = sigma0 <R_in>. That of surface is the root of an equation, by bisection."""
    name, *numbers = law.split()
    number = float(numbers[0]) if numbers else 2.0
    Rsum, delta = Ri + Rj, overlap / (Ri + Rj)
    if name == "sticky":
        if delta > -number:
            return k * delta, k * Rsum * (delta**2 / 2 - number**2)
        left = max(0.0, delta + 2 * number)
        return -k * left, -k * Rsum * left**2 / 2
    if delta <= 0:
        return 0.0, 0.0
    if name == "surface":
        def one(x, R):    # force and energy of a bubble deformed by x R
            return number * R * (18.5 * x**2 + 2 * x), number * R**2 * (18.5 / 3 * x**3 + x**2)
        low, high = 0.0, overlap    # how much of the overlap is bubble i's
        for _ in range(200):
            middle = 0.5 * (low + high)
            less = one(middle / Ri, Ri)[0] < one((overlap - middle) / Rj, Rj)[0]
            low, high = (middle, high) if less else (low, middle)
        (F, Ui), (_, Uj) = one(low / Ri, Ri), one((overlap - low) / Rj, Rj)
        return F, Ui + Uj
    return k * delta**(number - 1), k * Rsum * delta**number / number


# ---- pairs --------------------------------------------------------------------------------------

def pair_input(law, dim, sigma0=1.7, what="run 0"):
    return HEAD.format(dim=dim) + f"""
read_data     data
neighbor      0.3 bin
pair_style    durian/foam 1.0 rin 0.8 law {law}
pair_coeff    * * {sigma0}
fix           step all foam/abm 1e-9
compute       b all foam/bubble espring edurian
compute       p all pressure NULL virial
thermo_style  custom step time pe c_p[*] vol
{PRECISE}
dump          d all custom 1 dump id x y z fx fy fz c_b[*]
dump_modify   d sort id format float %.17g time yes
{what}
"""


@pytest.mark.parametrize("law, dim", KINDS)
@pytest.mark.parametrize("r", [2.5, 2.3, 2.1, 1.99, 1.5, 0.3])    # sticky: out of its range, in the shell, ...
def test_pair(lmp, law, dim, r):
    """Force, energy, virial and shares of two bubbles in closed form; sums of a few terms: 1e-13."""
    n = np.array([0.6, 0.8]) if dim == 2 else np.array([0.48, 0.64, 0.6])
    x = np.full((2, dim), 5.0)
    x[1] += r * n
    R, sigma0 = [0.7, 1.3], 1.7
    result = lmp(pair_input(law, dim), files={"data": data_file([10] * dim, x, R)})
    F, U = force_and_energy(law, sigma0 * 0.8, 2.0 - r, *R)
    frame, table = result.dump("dump")[0], result.thermo[0]
    f = frame.array("fx", "fy", "fz")[:, :dim]
    # near contact places of 5 leave 1e-15 of an overlap of 0.01
    near = dict(rel=1e-13 if abs(2.0 - r) > 0.05 else 1e-12, abs=1e-15)
    assert f[0] == pytest.approx(-F * n, **near) and f[1] == pytest.approx(F * n, **near)
    assert table["PotEng"][0] == pytest.approx(U, **near)
    assert frame["c_b[1]"] == pytest.approx([U / 2, U / 2], **near)
    assert frame["c_b[2]"] == pytest.approx([0.5 * sigma0 * max(0.0, 2 - r)**2] * 2, rel=1e-12)    # of the thesis
    for k in range(dim):
        assert table[f"c_p[{k + 1}]"][0] == pytest.approx(F * r * n[k]**2 / table["Volume"][0], rel=1e-12, abs=1e-16)


@pytest.mark.parametrize("law", SPRING_LIKE)
def test_pair_comes_apart(lmp, law):
    """Two bubbles of equal size: d(overlap)/dt = -2 F / mu0 with F = sigma0 <R_in> (overlap / 2)^(ALPHA-1), which
    has a closed solution. The error is that of a tolerance of 1e-9 in each of some 100 to 1000 steps."""
    a, start, t = power(law), 0.4, 1.0
    x = [[5.0, 5.0], [5.0 + 2.0 - start, 5.0]]
    text = pair_input(law, 2, 1.0, f"variable over equal f_step[1]>={t}\n"
                                   "fix end all halt 1 v_over >= 1 error continue\nrun 100000")
    result = lmp(text, files={"data": data_file([10, 10], x, [1.0, 1.0])})
    frame = result.dump("dump")[-1]
    now = frame.time
    delta = start / 2.0    # d delta / dt = -0.8 delta^(a-1)
    if a == 2.0:
        delta *= np.exp(-0.8 * now)
    else:
        delta = max(0.0, delta**(2 - a) - 0.8 * (2 - a) * now)**(1 / (2 - a))
    assert 2.0 - (frame["x"][1] - frame["x"][0]) == pytest.approx(2 * delta, abs=1e-6)


@pytest.mark.parametrize("ranks", [1, 2])
def test_a_pair_drifts_into_the_shell(each_lmp, ranks):
    """Two bubbles come from out of range, pushed by a force smaller than the attraction, and stick together where
    attraction and push are as large as repulsion: k delta = push. Without the push they rest at contact, delta = 0."""
    x, A, k, push = [[9.0, 10.0], [12.0, 10.3]], 0.2, 1.0, 0.05
    text = HEAD.format(dim=2) + f"""
read_data     data
neighbor      0.1 bin
pair_style    durian/foam 1.0 rin 1.0 law sticky {A}
pair_coeff    * * {k}
fix           step all foam/rkc 1e-6
group         left id 1
group         right id 2
variable      p equal {push}
variable      m equal -{push}
fix           p left addforce v_p 0 0
fix           m right addforce v_m 0 0
thermo_style  custom step time pe
{PRECISE}
dump          d all custom 10 dump id x y z fx fy fz
dump_modify   d sort id format float %.17g
run           180
variable      p equal 0
variable      m equal 0
run           100
"""
    result = each_lmp(text, files={"data": data_file([20, 20], x, [1.0, 1.0])}, ranks=ranks)
    frames = {frame.step: frame for frame in result.dump("dump")}
    apart = {step: np.diff(frame.array("x", "y"), axis=0)[0] for step, frame in frames.items()}
    r = {step: np.hypot(*d) for step, d in apart.items()}
    assert r[0] > 2 * (1 + 2 * A)
    assert r[180] == pytest.approx(2 * (1 - push / k * apart[180][0] / r[180]), abs=1e-3)    # it turns slowly
    assert r[280] == pytest.approx(2.0, abs=1e-4)
    seen = [(r[step], frame) for step, frame in frames.items() if 2.0 < r[step] < 2 * (1 + 2 * A)]
    assert len(seen) > 2    # in the shell
    for distance, frame in seen:
        F = force_and_energy(f"sticky {A}", k, 2 - distance, 1.0, 1.0)[0]
        fx = frame["fx"][1] + (push if frame.step <= 180 else 0.0)
        assert fx == pytest.approx(F * apart[frame.step][0] / distance, rel=1e-9)


@pytest.mark.parametrize("dim", [2, 3])
def test_lists_reach_as_far_as_the_shell(lmp, dim):
    """A foam whose bubbles grow, move and vanish: with a thin skin, whose lists are used for many steps, as with a
    thick one. A pair that a list has missed would differ by its force, 1e-1."""
    thin, thick = (run(lmp, "sticky 0.2", dim, gas="0.3 0.3 rmin 0.5", neighbor=f"{skin} bin", integrator="abm",
                       run="run 40") for skin in (0.2, 1.0))
    assert_same_run(thin.thermo[0], thick.thermo[0])
    assert thin.thermo[0]["f_gas[7]"][-1] > 0


# ---- foams --------------------------------------------------------------------------------------

def run(lmp, law, dim=2, ranks=1, **keywords):
    x, R, v, box = foam(dim, 12 if dim == 2 else 5)
    keywords = dict(gas="0.1 0.3 rmin 0.4", run="run 60", pair=f"law {law}") | keywords
    return lmp(case(dim, **keywords), files={"data": data_file([box] * dim, x, R, v)}, ranks=ranks)


def test_power_two_is_the_spring(lmp):
    """One state: up to rounding."""
    a, b = (run(lmp, law, run="run 0") for law in ("spring", "power 2"))
    box = foam(2, 12)[3]
    assert_same_state(state(a.dump("dump")[0], 2), state(b.dump("dump")[0], 2), box, SAME)


@pytest.mark.parametrize("law, dim", [kind for kind in KINDS if kind[0] != "spring"])
@pytest.mark.parametrize("integrator, drag", [("abm", "static"), ("rkc", "static"), ("rkc", "neighbor")])
def test_coarsens(kk_lmp, backends, law, dim, integrator, drag):
    """Base and KOKKOS styles, one rank and two: the same foam; gas stays, bubbles vanish."""
    how = dict(integrator=integrator, pair=f"law {law} drag {drag}", gas="0.3 0.3 rmin 0.5",
               run="run 40" if integrator == "abm" else "run 12")    # of long steps: near foams part sooner
    plain, other = run(backends("wheel"), law, dim, **how), run(kk_lmp, law, dim, ranks=2, **how)
    assert_same_run(plain.thermo[0], other.thermo[0])
    phi = plain.thermo[0]["f_gas[5]"]
    assert phi == pytest.approx(phi[0], rel=1e-12)
    R = plain.thermo[0]["f_gas[3]"]
    assert abs(R[-1] - R[0]) > 1e-5    # gas has been exchanged; with abm bubbles have vanished, too
    assert integrator == "rkc" or plain.thermo[0]["f_gas[7]"][-1] > 0


@pytest.mark.parametrize("law, dim", KINDS)
def test_minimize_and_relax_find_the_same_kind_of_rest(lmp, law, dim):
    """Both end where forces vanish against those of the start, and the energy only falls."""
    for what in ("minimize 0.0 0.0 400 4000", "run 400"):
        result = run(lmp, law, dim, gas="0 0", run=what, integrator="rkc")
        energy, frames = result.thermo[0]["PotEng"], result.dump("dump")
        f = [np.sqrt((frame.array("fx", "fy", "fz")**2).mean()) for frame in (frames[0], frames[-1])]
        assert np.all(np.diff(energy) <= 1e-3 * np.abs(energy[:-1]))    # as much as an overlap of the tolerance has
        assert f[1] < 0.05 * f[0]    # 0.002 to 0.03: a soft foam comes to rest slowly


@pytest.mark.parametrize("law", LAWS[1:])
def test_restart(lmp, law):
    """The law is in the restart file: the run goes on. (That runs go on bit by bit is looked at in
    test_symmetry.py; here energies are summed over lists of another order.)"""
    dim = 3 if "surface" in law else 2
    whole = run(lmp, law, dim, run="restart 30 state\nrun 60", every=30)
    again = lmp(f"""
read_restart  state.30
neighbor      0.3 bin
fix           gas all foam/coarsen 0.1 0.3 rmin 0.4
fix           step all foam/abm 1e-3
thermo_style  custom step atoms time pe f_gas[*]
{PRECISE}
run           30
""", directory=whole.directory)
    for name, column in again.thermo[0].items():
        assert column[-1] == pytest.approx(whole.thermo[0][name][-1], rel=SAME), name


@pytest.mark.parametrize("words, what", [
    ("law", "keyword law needs a value: spring or power or surface or sticky"),
    ("law springs", "law must be spring or power or surface or sticky, not springs"),
    ("law power", "argument ALPHA of law power is missing: a number > 1"),
    ("law power drag static", "ALPHA of law power must be a number > 1, not drag"),
    ("law power 1.0", "must be a number > 1, not 1.0"), ("law spring 2", "unknown keyword 2"),
    ("law sticky", "argument A of law sticky is missing: a number >= 0"),
    ("law sticky -0.1", "A of law sticky must be a number >= 0, not -0.1"),
    ("law surface 0", "SIGMA of law surface must be a number > 0, not 0"),
    ("law surface 1.0", "law surface is one of bubbles in 3D, but dimension is 2")])
def test_bad_laws(lmp, words, what):
    result = lmp(pair_input("spring", 2).replace("law spring", words),
                 files={"data": data_file([10, 10], [[5, 5]], [1.0])}, check=False)
    assert result.returncode and re.search(what, result.errors[0]), result.errors
