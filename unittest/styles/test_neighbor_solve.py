"""Drag by the mean velocity of the neighbors without a lag: velocities of a dense solution, cluster by cluster."""

import numpy as np
import pytest

from foams import assert_same_run, case, foam
from runner import HEAD, PRECISE, data_file

LAST = """unfix step
fix step all foam/{integrator} 1e-11 dt0 1.0 drift keep
run 0
write_dump all custom last id x y z vx vy vz fx fy fz radius modify sort id format float %.17g"""


def contacts_of(x, R, box):
    d = x[:, None] - x[None, :]
    d -= box * np.round(d / box)
    touch = np.sqrt((d**2).sum(2)) < R[:, None] + R[None, :]
    np.fill_diagonal(touch, False)
    return touch


def clusters_of(touch):
    label = np.arange(len(touch))
    for _ in label:    # the smallest label spreads
        label = np.minimum(label, np.where(touch, label[None, :], len(label)).min(1))
    return label


def solution(touch, g, u=None, known=None):
    """z_i v_i - sum_j v_j = z_i (g_i - c) with sum z_i v_i = 0 in each cluster; v = g + u where it is known."""
    n = len(touch)
    known = np.zeros(n, bool) if known is None else known
    z = touch.sum(1)
    v = g.copy()
    if u is not None:
        v[known] += u[known]
    label = clusters_of(touch)
    laplacian = np.diag(z) - touch
    for name in set(label):
        free = np.flatnonzero((label == name) & ~known)
        if len(free) == 0 or z[free[0]] == 0:
            continue
        held = np.flatnonzero(known & touch[free].any(0))
        if len(held):    # by bubbles whose velocity is known
            # a cluster without them may be held in parts: the labels take known bubbles as bridges
            b = z[free, None] * g[free] - laplacian[np.ix_(free, held)] @ v[held]
            v[free] = np.linalg.lstsq(laplacian[np.ix_(free, free)], b, rcond=None)[0]
        else:
            c = (z[free, None] * g[free]).sum(0) / z[free].sum()
            A = np.vstack([laplacian[np.ix_(free, free)], z[free]])
            b = np.vstack([z[free, None] * (g[free] - c), np.zeros((1, g.shape[1]))])
            v[free] = np.linalg.lstsq(A, b, rcond=None)[0]
    return v


def run(lmp, dim=2, ranks=1, spread=1.0, **keywords):
    x, R, v, box = foam(dim, 12 if dim == 2 else 5)
    keywords = dict(gas="0.1 0.3 rmin 0.4", run="run 40", pair="drag neighbor solve") | keywords
    return lmp(case(dim, **keywords), files={"data": data_file([box * spread] * dim, x * spread, R, v)}, ranks=ranks)


def last_of(result, dim):
    frame = result.dump("last")[0]
    return [frame.array(*[letter + k for k in "xyz"[:dim]]) for letter in ("", "v", "f")] + [frame["radius"]]


@pytest.mark.parametrize("dim, integrator, spread", [(2, "abm", 1.0), (2, "rkc", 1.0), (3, "abm", 1.0), (3, "rkc", 1.0),
                                                     (2, "abm", 1.3), (3, "abm", 1.5)])
@pytest.mark.parametrize("ranks", [1, 2])
def test_dense_solution(each_lmp, dim, integrator, spread, ranks):
    """A packing, and one pulled apart until it is clusters, pairs and single bubbles. Residuals are some 2e-13 of what
    velocities are; the smallest eigenvalue of a packing of 12 bubbles across is some 0.02."""
    box = foam(dim, 12 if dim == 2 else 5)[3] * spread
    result = run(each_lmp, dim, ranks, spread, integrator=integrator, every=10, gas="0 0",
                 run="run 5\n" + LAST.format(integrator=integrator))
    x, v, f, R = last_of(result, dim)
    touch = contacts_of(x, R, box)
    exact = solution(touch, f)
    sizes = np.unique(clusters_of(touch), return_counts=True)[1]
    print("clusters of", np.sort(sizes))
    assert sizes.max() < 0.5 * len(x) and (sizes > 1).sum() > 3 if spread > 1.0 else sizes.max() > 0.9 * len(x)
    assert np.abs(v - exact).max() < 1e-9 * np.abs(exact).max()


@pytest.mark.parametrize("dim", [2, 3])
def test_dense_solution_in_a_flow(lmp, dim):
    """Bubbles in the lower part of the box are in a flow, and hold the others; mu0 is 2."""
    x, R, v, box = foam(dim, 12 if dim == 2 else 5)
    u = np.array([0.3, -0.2, 0.1][:dim])
    text = case(dim, gas="0 0", pair="drag neighbor solve", run=f"""
region low block INF INF INF {0.4 * box} INF INF
fix flow all foam/flow region low velocity 0.3 -0.2 {0.1 if dim == 3 else 0}
run 5
""" + LAST.format(integrator="abm")).replace("durian/foam 1.0", "durian/foam 2.0")
    result = lmp(text, files={"data": data_file([box] * dim, x, R, v)})
    x, v, f, R = last_of(result, dim)
    known = x[:, 1] % box < 0.4 * box
    exact = solution(contacts_of(x, R, box), f / 2.0, np.tile(u, (len(x), 1)), known)
    assert 0.2 < known.mean() < 0.6
    assert np.abs(v - exact).max() < 1e-9 * np.abs(exact).max()


@pytest.mark.parametrize("integrator", ["abm", "rkc"])
def test_error_that_is_allowed(lmp, integrator):
    """Velocities are wrong by what moves bubbles by 2 % of the tolerance of a step, slow modes too. The least
    eigenvalue of 600 bubbles is some 0.01, so that a residual of that size would not do."""
    x, R, _, box = foam(2, 25)
    tol, h = 1e-3, 0.25
    result = lmp(case(2, pair="drag neighbor solve", gas="0 0", integrator=integrator, run=f"""run 5
unfix step
fix step all foam/{integrator} {tol} dt0 {h} drift keep
run 0
write_dump all custom last id x y z vx vy vz fx fy fz radius modify sort id format float %.17g"""),
                 files={"data": data_file([box] * 2, x, R)})
    x, v, f, R = last_of(result, 2)
    exact = solution(contacts_of(x, R, box), f)
    assert np.sqrt((exact**2).mean()) > 1e-2
    assert np.sqrt(((v - exact)**2).mean()) < 0.02 * tol / h


def pair_of(styles, last, R=(1.0, 0.8, 1.0)):
    """Bubbles in a row, the first two and the last two in contact."""
    x = np.array([[5.0, 5.0], [6.6, 5.0], [8.2, 5.0]])
    text = HEAD.format(dim=2) + f"""
read_data     data
neighbor      0.3 bin
pair_style    durian/foam 1.0 rin 1.0 drag neighbor solve
pair_coeff    * * 1.0
{styles}
fix           step all foam/abm 1e-10
{PRECISE}
run           0
write_dump    all custom last id x y vx vy fx fy radius modify sort id format float %.17g
"""
    return text, {"data": data_file([20, 20], x[:last], R[:last])}


def test_row_of_three(each_lmp):
    """In closed form: z = 1, 2, 1; forces (-a, a - b, b), so c = (a - b) / 4. With
    d1 = v2 - v1 and d2 = v3 - v2 the first
    and the last equation say that -d1 = -a - c, d2 = b - c."""
    text, files = pair_of("", 3, (1.0, 0.8, 1.1))
    frame = each_lmp(text, files=files).dump("last")[0]
    f, v = frame["fx"], frame["vx"]
    a, b = -f[0], f[2]
    assert a > 0 and b > a
    c = (f * [1, 2, 1]).sum() / 4
    assert v[1] - v[0] == pytest.approx(a + c, rel=1e-9)
    assert v[2] - v[1] == pytest.approx(b - c, rel=1e-9)
    # and the mean velocity is taken off, the default in a periodic box
    assert v.sum() == pytest.approx(0.0, abs=1e-12)


def test_in_a_flow(each_lmp):
    """A bubble in a flow moves with it and by its own force; what hangs on it follows without the flow:
    v_1 = u + F_1, v_2 = v_1 + F_2 for a pair, alone with each other."""
    text, files = pair_of("""
region left block 0 5.5 INF INF INF INF
fix flow all foam/flow region left velocity 0.3 -0.2 0.0""", 2)
    frame = each_lmp(text, files=files).dump("last")[0]
    F = frame["fx"]
    assert F[0] == -F[1] and F[1] > 0.05
    assert frame["vx"] == pytest.approx([0.3 + F[0], 0.3], rel=1e-9)
    assert frame["vy"] == pytest.approx([-0.2, -0.2], rel=1e-9)


@pytest.mark.parametrize("dim, integrator", [(2, "abm"), (3, "abm"), (2, "rkc")])
@pytest.mark.parametrize("ranks", [1, 2])
def test_coarsens_alike_everywhere(kk_lmp, backends, dim, integrator, ranks):
    how = dict(integrator=integrator, gas="0.3 0.3 rmin 0.5", run="run 30" if integrator == "abm" else "run 8",
               step="1e-3" if integrator == "abm" else "1e-4")
    plain, other = run(backends("wheel"), dim, **how), run(kk_lmp, dim, ranks=ranks, **how)
    # solutions differ by 2 % of the tolerance of a step, of which energies see the square where forces balance
    assert_same_run(plain.thermo[0], other.thermo[0], 1e-5)
    phi = plain.thermo[0]["f_gas[5]"]
    assert phi == pytest.approx(phi[0], rel=1e-12)


def test_restart(lmp):
    whole = run(lmp, run="restart 20 state\nrun 40", step="1e-5")
    again = lmp(f"""
read_restart  state.20
neighbor      0.3 bin
fix           gas all foam/coarsen 0.1 0.3 rmin 0.4
fix           step all foam/abm 1e-5
thermo_style  custom step atoms time pe f_gas[*]
{PRECISE}
run           20
""", directory=whole.directory)
    for name, column in again.thermo[0].items():
        assert column[-1] == pytest.approx(whole.thermo[0][name][-1], rel=1e-11), name


def test_shear_flow_is_refused(lmp):
    x, R, v, box = foam(2, 4)
    text = case(2, pair="drag neighbor solve", gas="0 0").replace(
        "read_data     data\n", "read_data data\nchange_box all triclinic\n").replace(
            "run 0", "fix d all deform 1 xy erate 0.01 remap none\nfix f all foam/flow shear\nrun 0")
    result = lmp(text, files={"data": data_file([box] * 2, x, R, v)}, check=False)
    assert result.returncode and "cannot be used with drag neighbor" in result.errors[0], result.errors


def test_with_scheme_source(lmp):
    """It knows no drift remove, the default otherwise."""
    x, R, v, box = foam(2, 6)
    result = lmp(case(2, pair="drag neighbor solve", step="1e-3 scheme source", run="run 5"),
                 files={"data": data_file([box] * 2, x, R, v)})
    assert result.thermo[0]["Step"][-1] == 5


def test_forces_of_other_fixes_are_warned_of(lmp):
    x, R, v, box = foam(2, 6)
    for pair, told in ("drag neighbor solve", 1), ("drag static", 0):
        result = lmp(case(2, pair=pair, after="fix up all addforce 0 0.1 0"),
                     files={"data": data_file([box] * 2, x, R, v)})
        assert result.screen.count("do not move a cluster of bubbles") == told


def test_change_of_drag_needs_a_set_up(lmp):
    x, R, v, box = foam(2, 6)
    result = lmp(case(2, gas="0 0", run="""run 5
pair_style durian/foam 1.0 drag neighbor solve
pair_coeff * * 1.0
run 5 pre no"""), files={"data": data_file([box] * 2, x, R, v)}, check=False)
    assert result.returncode and "the drag has changed" in result.errors[0], result.errors
