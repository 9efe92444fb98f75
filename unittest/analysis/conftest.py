"""Fixtures of the tests of the analysis. These tests need no LAMMPS."""

import pytest

np = pytest.importorskip("numpy")
pytest.importorskip("scipy")
pytest.importorskip("matplotlib")


@pytest.fixture
def rng():
    return np.random.default_rng(7)
