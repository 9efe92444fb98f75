"""Drag between bubbles in contact: the velocities are those of a dense solution of the linear system."""

import re

import numpy as np
import pytest

from foams import assert_same_run, case, foam
from runner import HEAD, PRECISE, data_file


def run(lmp, mu_c, dim=2, ranks=1, **keywords):
    x, R, v, box = foam(dim, 12 if dim == 2 else 5)
    keywords = dict(gas="0.1 0.3 rmin 0.4", run="run 40", pair=f"drag contact {mu_c}") | keywords
    return lmp(case(dim, **keywords), files={"data": data_file([box] * dim, x, R, v)}, ranks=ranks)


def matrix(x, R, box, mu0, mu_c):
    """Of all bubbles: mu0 v_i + mu_c sum_j (v_i - v_j), j over the contacts, images too."""
    A = mu0 * np.eye(len(R))
    for i in range(len(R)):
        d = x - x[i]
        d -= box * np.round(d / box)
        r = np.sqrt((d**2).sum(1))
        for j in np.flatnonzero(r < R + R[i]):
            if j != i:
                A[i, i] += mu_c
                A[i, j] -= mu_c
    return A


@pytest.mark.parametrize("mu_c", [0.1, 1.0, 30.0])
@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("integrator", ["abm", "rkc"])
def test_dense_solution(lmp, dim, mu_c, integrator):
    """A state after some steps. The error of velocities is to move bubbles by 2 % of the tolerance of the next
    step: one of length 1 with a tolerance of 1e-11 asks for 2e-13."""
    box = foam(dim, 12 if dim == 2 else 5)[3]
    result = run(lmp, mu_c, dim, integrator=integrator, every=10, gas="0 0", run=f"""run 10
unfix step
fix step all foam/{integrator} 1e-11 dt0 1.0
run 0
write_dump all custom last id x y z vx vy vz fx fy fz radius modify sort id format float %.17g""")
    frame = result.dump("last")[0]
    x, v, f = (frame.array(*[letter + k for k in "xyz"[:dim]]) for letter in ("", "v", "f"))
    A = matrix(x, frame["radius"], box, 1.0, mu_c)
    solution = np.linalg.solve(A, f)
    assert np.abs(v - solution).max() < 1e-10 * np.abs(solution).max()
    # power put in by the forces = power dissipated by both drags
    assert (v * f).sum() == pytest.approx(np.einsum("ik,ij,jk", v, A, v), rel=1e-9)


@pytest.mark.parametrize("ranks", [1, 2])
def test_sheared(each_lmp, ranks):
    """In a box that is sheared the velocity of an image is that of its bubble and of the side between them; what is
    solved is the velocity relative to the flow. And power: what the shear puts in by the stress of contacts, elastic
    and viscous, both drags dissipate, or springs store."""
    x, R, _, box = foam(2, 12)
    rate, mu_c = 0.05, 3.0
    text = case(2, pair=f"drag contact {mu_c}", gas="0 0", step="1e-4", run="", every=10000).replace(
        "read_data     data\n", "read_data data\nchange_box all triclinic\n") + f"""
unfix gas
thermo_style custom step time xy pe
variable shift equal {rate}*f_step[7]*ly
variable speed equal {rate}*ly
fix deform all deform 1 xy variable v_shift v_speed remap none
fix flow all foam/flow shear
run 40
unfix step
fix step all foam/abm 1e-11 dt0 1.0
thermo_style custom step xy f_flow[5]
{PRECISE}
run 0
write_dump all custom last id x y z vx vy vz fx fy fz radius iy modify sort id format float %.17g
"""
    result = each_lmp(text, files={"data": data_file([box] * 2, x, R)}, ranks=ranks)
    frame, tilt = result.dump("last")[0], result.thermo[-1]["Xy"][0]
    x, v, f = (frame.array(*[letter + k for k in "xy"]) for letter in ("", "v", "f"))
    assert abs(tilt) > 0.1
    v[:, 0] -= rate * box * frame["iy"]    # output has them for bubbles as if they had never come back
    n = len(x)
    A, b = np.eye(n), f.copy()
    u = np.column_stack([rate * x[:, 1], np.zeros(n)])
    viscous = stored = dissipated = 0.0
    for i in range(n):
        for j in range(i):
            d = x[j] - x[i]
            rows = round(d[1] / box)
            d -= np.array([tilt, box]) * rows
            d[0] -= box * round(d[0] / box)
            r = np.hypot(*d)
            if r >= frame["radius"][i] + frame["radius"][j]:
                continue
            A[i, i] += mu_c
            A[j, j] += mu_c
            A[i, j] -= mu_c
            A[j, i] -= mu_c
            du = np.array([rate * d[1], 0.0])    # u_j - u_i
            b[i] += mu_c * du
            b[j] -= mu_c * du
            dv = v[j] - v[i] - np.array([rate * box * rows, 0.0])    # of the image and i
            dissipated += mu_c * (dv @ dv)
            viscous += mu_c * dv[0] * d[1]
            overlap = frame["radius"][i] + frame["radius"][j] - r
            stored -= R.mean() * overlap / (overlap + r) * (d @ dv) / r
    w = np.linalg.solve(A, b)
    assert np.abs(v - u - w).max() < 1e-10 * np.abs(w).max()
    background = ((v - u)**2).sum()
    assert result.thermo[-1]["f_flow[5]"][0] == pytest.approx(background, rel=1e-9)
    elastic = sum_of_virial(x, frame["radius"], R.mean(), tilt, box)
    assert rate * (elastic + viscous) == pytest.approx(background + dissipated + stored, rel=1e-8)


def sum_of_virial(x, R, k, tilt, box):
    """-sum over pairs of F_x y, what the shear stress of the springs is without the volume."""
    total = 0.0
    for i in range(len(x)):
        for j in range(i):
            d = x[j] - x[i]
            rows = round(d[1] / box)
            d -= np.array([tilt, box]) * rows
            d[0] -= box * round(d[0] / box)
            r = np.hypot(*d)
            if r < R[i] + R[j]:
                total -= k * (1 - r / (R[i] + R[j])) * d[0] * d[1] / r
    return total


def test_two_bubbles(each_lmp):
    """A pair in closed form: the sum of velocities is 0, the difference that of a drag mu0 + 2 mu_c. So the overlap
    falls like exp(-k t / (mu0 + 2 mu_c)), k = 2 sigma0 <R_in> / (R_i + R_j)."""
    mu_c, start = 3.0, 0.4
    text = HEAD.format(dim=2) + f"""
read_data     data
neighbor      0.3 bin
pair_style    durian/foam 1.0 rin 1.0 drag contact {mu_c}
pair_coeff    * * 1.0
fix           step all foam/abm 1e-9
{PRECISE}
variable      end equal f_step[1]>5
fix           end all halt 1 v_end >= 1 error continue
dump          d all custom 1000 dump id x vx
dump_modify   d sort id format float %.17g time yes
run           100000
write_dump    all custom last id x vx modify sort id format float %.17g time yes
"""
    result = each_lmp(text, files={"data": data_file([10, 10], [[5, 5], [7 - start, 5]], [1, 1])})
    last = result.dump("last")[0]
    overlap = 2 - (last["x"][1] - last["x"][0])
    # the error of a tolerance of 1e-9 in each of some 1000 steps
    assert overlap == pytest.approx(start * np.exp(-last.time / (1 + 2 * mu_c)), abs=1e-6)
    assert last["vx"][1] == pytest.approx(overlap / 2 / (1 + 2 * mu_c), rel=1e-6)
    assert last["vx"].sum() == pytest.approx(0.0, abs=1e-12)


def test_without_coefficient_it_is_static(lmp):
    a, b = run(lmp, 0.0), run(lmp, 0.0, pair="drag static")
    for name in a.thermo[0]:
        assert np.array_equal(a.thermo[0][name], b.thermo[0][name]), name


@pytest.mark.parametrize("dim, integrator", [(2, "abm"), (3, "abm"), (2, "rkc")])
@pytest.mark.parametrize("ranks", [1, 2])
def test_coarsens_alike_everywhere(kk_lmp, backends, dim, integrator, ranks):
    how = dict(integrator=integrator, gas="0.3 0.3 rmin 0.5", run="run 40" if integrator == "abm" else "run 12",
               step="1e-3" if integrator == "abm" else "1e-4")
    plain, other = run(backends("wheel"), 1.0, dim, **how), run(kk_lmp, 1.0, dim, ranks=ranks, **how)
    # solutions end at the same number of iterations or not: to what they are asked for, 2 % of the tolerance of a step,
    # of which energies see the square
    assert_same_run(plain.thermo[0], other.thermo[0], 1e-6)
    phi = plain.thermo[0]["f_gas[5]"]
    assert phi == pytest.approx(phi[0], rel=1e-12)
    assert integrator == "rkc" or plain.thermo[0]["f_gas[7]"][-1] > 0


def test_restart(lmp):
    whole = run(lmp, 2.0, run="restart 20 state\nrun 40", step="1e-6")
    again = lmp(f"""
read_restart  state.20
neighbor      0.3 bin
fix           gas all foam/coarsen 0.1 0.3 rmin 0.4
fix           step all foam/abm 1e-6
thermo_style  custom step atoms time pe f_gas[*]
{PRECISE}
run           20
""", directory=whole.directory)
    for name, column in again.thermo[0].items():
        assert column[-1] == pytest.approx(whole.thermo[0][name][-1], rel=1e-11), name


@pytest.mark.parametrize("words, what", [
    ("drag", "keyword drag needs a value: static or neighbor or contact"),
    ("drag contact", "argument MUC of drag contact is missing: a number >= 0"),
    ("drag contact -1", "MUC of drag contact must be a number >= 0, not -1"),
    ("drag contact nan", "MUC of drag contact must be a number >= 0, not nan")])
def test_bad_input(lmp, words, what):
    x, R, v, box = foam(2, 4)
    result = lmp(case(2, pair=words), files={"data": data_file([box] * 2, x, R, v)}, check=False)
    assert result.returncode and re.search(what, result.errors[0]), result.errors
