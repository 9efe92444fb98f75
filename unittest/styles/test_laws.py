"""Contact laws of the pair style: closed forms for pairs, and foams that relax, coarsen and restart."""

import re

import numpy as np
import pytest

from foams import SAME, assert_same_run, assert_same_state, case, foam, state
from runner import HEAD, PRECISE, data_file

LAWS = ["spring", "power 2.5", "power 1.5"]


def power(law):
    """The exponent of a law."""
    return float(law.split()[1]) if " " in law else 2.0


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


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("r", [1.99, 1.5, 0.3])
def test_pair(lmp, law, dim, r):
    """Force, energy, virial and shares of two bubbles in closed form; sums of a few terms: 1e-13."""
    n = np.array([0.6, 0.8]) if dim == 2 else np.array([0.48, 0.64, 0.6])
    x = np.full((2, dim), 5.0)
    x[1] += r * n
    R, sigma0, a = [0.7, 1.3], 1.7, power(law)
    result = lmp(pair_input(law, dim), files={"data": data_file([10] * dim, x, R)})
    delta = (2.0 - r) / 2.0
    F, U = sigma0 * 0.8 * delta**(a - 1), sigma0 * 0.8 * 2.0 * delta**a / a
    frame, table = result.dump("dump")[0], result.thermo[0]
    f = frame.array("fx", "fy", "fz")[:, :dim]
    assert f[0] == pytest.approx(-F * n, rel=1e-13) and f[1] == pytest.approx(F * n, rel=1e-13)
    assert table["PotEng"][0] == pytest.approx(U, rel=1e-13)
    assert frame["c_b[1]"] == pytest.approx([U / 2, U / 2], rel=1e-13)
    assert frame["c_b[2]"] == pytest.approx([0.5 * sigma0 * (2 - r)**2] * 2, rel=1e-12)    # of the thesis, for any law
    for k in range(dim):
        assert table[f"c_p[{k + 1}]"][0] == pytest.approx(F * r * n[k]**2 / table["Volume"][0], rel=1e-12)


@pytest.mark.parametrize("law", LAWS)
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


@pytest.mark.parametrize("law", LAWS[1:])
@pytest.mark.parametrize("dim", [2, 3])
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


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("dim", [2, 3])
def test_minimize_and_relax_find_the_same_kind_of_rest(lmp, law, dim):
    """Both end where forces vanish against those of the start, and the energy only falls."""
    for what in ("minimize 0.0 0.0 400 4000", "run 400"):
        result = run(lmp, law, dim, gas="0 0", run=what, integrator="rkc")
        energy, frames = result.thermo[0]["PotEng"], result.dump("dump")
        f = [np.sqrt((frame.array("fx", "fy", "fz")**2).mean()) for frame in (frames[0], frames[-1])]
        assert np.all(np.diff(energy) <= 1e-3 * energy[:-1])    # as much as an overlap of the tolerance has
        assert f[1] < 0.05 * f[0]    # 0.002 to 0.03: a soft foam comes to rest slowly


@pytest.mark.parametrize("law", LAWS[1:])
def test_restart(lmp, law):
    """The law is in the restart file: the run goes on. (That runs go on bit by bit is looked at in
    test_symmetry.py; here energies are summed over lists of another order.)"""
    whole = run(lmp, law, run="restart 30 state\nrun 60", every=30)
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
    ("law", "keyword law needs a value: spring or power"),
    ("law springs", "law must be spring or power, not springs"),
    ("law power", "argument ALPHA of law power is missing: a number > 1"),
    ("law power drag static", "ALPHA of law power must be a number > 1, not drag"),
    ("law power 1.0", "must be a number > 1, not 1.0"), ("law spring 2", "unknown keyword 2")])
def test_bad_laws(lmp, words, what):
    result = lmp(pair_input("spring", 2).replace("law spring", words),
                 files={"data": data_file([10, 10], [[5, 5]], [1.0])}, check=False)
    assert result.returncode and re.search(what, result.errors[0]), result.errors
