"""The loop over contacts in blocks of pairs (foam_contact_blocks.h) has the numbers of that over rows, to the last bit,
and so have the integrators' loops in vectors (foam_vectors.h) those of loops one by one. Rows and loops one by one are
taken where the group of the bubbles is not LAMMPS' group all, though all particles are in it."""

import numpy as np
import pytest

from foams import case, foam
from runner import data_file

TYPES = """read_data     data extra/atom/types 1
set           group all type/fraction 2 0.4 77
"""
SCENES = {
    "2D": dict(),
    "3D": dict(dim=3),
    "film only": dict(gas="0.1 0 rmin 0.4"),
    "no gas": dict(gas="0 0"),
    "newton off": dict(before="newton off"),
    "types": dict(types=True, dim=3),
    "power": dict(pair="law power 1.5"),
    "sticky": dict(pair="law sticky 0.1"),
    "surface": dict(pair="law surface 0.6", dim=3),
    "coincident": dict(after="set atom 1*2 x 3.0\nset atom 1*2 y 3.0"),
    "rkc": dict(integrator="rkc"),
}


@pytest.mark.parametrize("name", SCENES)
def test_blocks_are_rows(lmp, name):
    how = {**dict(gas="0.1 0.1 rmin 0.4", run="run 40", every=10), **SCENES[name]}
    dim, types = how.pop("dim", 2), how.pop("types", False)
    text = case(dim, **how)
    if types:
        text = text.replace("read_data     data\n", TYPES).replace(
            "pair_coeff    * * 1.0\n", "pair_coeff    * * 1.0\npair_coeff    1 2 0.3\n")
    x, R, v, box = foam(dim, 14 if dim == 2 else 6)
    files = {"data": data_file([box] * dim, x, R, v)}
    blocks = lmp(text, files=files)
    rows = lmp(text.replace("fix           gas all", "group bubbles union all\nfix           gas bubbles")
               .replace("step all", "step bubbles"), files=files)
    for one, other in zip(blocks.dump("dump"), rows.dump("dump"), strict=True):
        for column in one._columns:
            assert np.array_equal(one[column], other[column]), column
