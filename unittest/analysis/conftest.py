"""Fixtures of the tests of the analysis. These tests need no LAMMPS."""

import pytest

for module in ("numpy", "scipy", "matplotlib"):
    pytest.importorskip(module)

import numpy as np


@pytest.fixture
def rng():
    return np.random.default_rng(7)
