"""The fixtures of all tests of the styles: which LAMMPS runs them. See runner.py."""

import pytest

from foams import Base
from runner import BACKENDS, BITWISE, KOKKOS, PLAIN, Runner


@pytest.fixture(params=PLAIN)
def lmp(request, tmp_path):
    return Runner(request.param, tmp_path)


@pytest.fixture(params=PLAIN)
def bitwise_lmp(request, tmp_path):
    return Runner(request.param, tmp_path, BITWISE.get(request.param))


@pytest.fixture(params=BACKENDS)
def each_lmp(request, tmp_path):
    return Runner(request.param, tmp_path)


@pytest.fixture(params=KOKKOS)
def kk_lmp(request, tmp_path):
    return Runner(request.param, tmp_path)


@pytest.fixture
def base_lmp(tmp_path):
    return Runner("wheel", tmp_path)


@pytest.fixture
def backends(tmp_path):
    runners = []

    def runner(name, args=None):
        runners.append(Runner(name, tmp_path / f"{name}.{len(runners)}", args))
        return runners[-1]

    return runner


@pytest.fixture(scope="session")
def base(tmp_path_factory):
    return Base(tmp_path_factory.mktemp("base"))
