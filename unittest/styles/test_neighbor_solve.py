"""Drag by the mean velocity of the neighbors without a lag: velocities are those of a dense solution, cluster by cluster."""

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
                                                     (2, "abm", 1.25), (3, "abm", 1.15)])
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
    clusters = len(set(clusters_of(touch)[touch.any(1)]))
    assert clusters > 5 if spread > 1.0 else clusters == 1
    assert np.abs(v - exact).max() < 1e-9 * np.abs(exact).max()
