"""What the benchmark runs on: names, memory bandwidth, LAMMPS runs and what they cost."""

import os
import re
import shlex
import shutil
import subprocess
import tempfile
import threading
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent


def compile_here(sources, target, *words):
    """Compile a file of this folder by the command `words`; False if that is not possible."""
    source = HERE / sources
    if target.exists() and target.stat().st_mtime > source.stat().st_mtime:
        return True
    if not shutil.which(words[0]):
        return False
    done = subprocess.run([*words, str(source), "-o", str(target)], capture_output=True, text=True)
    if done.returncode:
        print(f"{source.name}: not compiled\n{done.stderr}")
    return done.returncode == 0


def cpu_name():
    try:
        name = re.search(r"^model name\s*: (.*\S)", Path("/proc/cpuinfo").read_text(), re.M)[1]
    except (OSError, TypeError):
        name = "unknown processor"
    cores = len(os.sched_getaffinity(0))
    return f"{cores} core{'s' * (cores != 1)} of {name}"


def nvidia_smi(query):
    """First GPU's answer, or None."""
    try:
        done = subprocess.run(["nvidia-smi", f"--query-gpu={query}",
                               "--format=csv,noheader,nounits"],
                              capture_output=True, text=True, timeout=20)
    except (OSError, subprocess.TimeoutExpired):
        return None
    return done.stdout.splitlines()[0].strip() if done.returncode == 0 and done.stdout else None


def host_bandwidth(threads, cache, passes=3):
    """GB/s of a triad with so many threads."""
    program = (cache / "triad").absolute()
    if not compile_here("triad.cpp", program, "c++", "-O3", "-march=native", "-fopenmp"):
        return None
    environment = {**os.environ, "OMP_NUM_THREADS": str(threads), "OMP_PROC_BIND": "spread",
                   "OMP_PLACES": "threads"}
    return max(float(subprocess.run([program], env=environment, capture_output=True, text=True,
                                    check=True).stdout) for _ in range(passes))


def device_bandwidth(cache):
    program = (cache / "triad-cuda").absolute()
    nvcc = shutil.which("nvcc") or "/usr/local/cuda/bin/nvcc"
    if not compile_here("triad.cu", program, nvcc, "-O3", "-arch=native"):
        return None
    done = subprocess.run([program], capture_output=True, text=True)
    if done.returncode:
        print(f"triad.cu: {done.stderr.strip()}")
        return None
    return float(done.stdout)


class DeviceMemory(threading.Thread):
    """Watches the memory of the first GPU: .most is the largest increase in MB."""

    def __init__(self):
        super().__init__(daemon=True)
        self.first = float(nvidia_smi("memory.used") or 0)
        self.most = 0.0
        self.ended = threading.Event()

    def run(self):
        while not self.ended.wait(0.25):
            self.most = max(self.most, float(nvidia_smi("memory.used") or 0) - self.first)

    def end(self):
        self.ended.set()
        self.join()
        return self.most


def capabilities(command):
    """Kokkos back ends and precision of a LAMMPS: ({"OpenMP", "Serial"}, "double")."""
    done = subprocess.run([*shlex.split(command), "-h"], capture_output=True, text=True,
                          stdin=subprocess.DEVNULL)
    if done.returncode:
        raise SystemExit(f"{command} -h failed:\n{done.stdout}{done.stderr}")
    back_ends = re.search(r"^KOKKOS package API: (.*)", done.stdout, re.M)
    precision = re.search(r"^KOKKOS package precision: (\w+)", done.stdout, re.M)
    return (set(back_ends[1].split()) if back_ends else set(),
            precision[1] if precision else "double")


class Failed(Exception):
    """A run of LAMMPS that gave no figures."""


def lammps(command, script, directory, variables, environment=None, timeout=None,
           watch_device=False):
    """Run a script of this folder; returns what LAMMPS printed, peak memory of the process and of
    the device in MB, and the seconds of the whole process."""
    words = [*command, "-in", str(HERE / script), "-log", "none"]
    for name, value in variables.items():
        words += ["-var", name, *map(str, value if isinstance(value, tuple) else (value,))]
    watch = DeviceMemory() if watch_device else None
    if watch:
        watch.start()
    start = time.perf_counter()
    with tempfile.TemporaryFile("w+") as output:
        process = subprocess.Popen(words, cwd=directory, stdin=subprocess.DEVNULL, stdout=output,
                                   stderr=subprocess.STDOUT, text=True,
                                   env={**os.environ, **(environment or {})})
        timer = threading.Timer(timeout or 86400, process.kill)
        timer.start()
        try:
            _, status, usage = os.wait4(process.pid, 0)
        except BaseException:
            process.kill()
            raise
        finally:
            timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        text = output.read()
    seconds = time.perf_counter() - start
    device = watch.end() if watch else 0.0
    if process.returncode:
        error = re.search(r"^(ERROR.*)", text, re.M)
        late = " (out of time)" if seconds >= (timeout or 86400) else ""
        raise Failed(error[1] if error else f"status {process.returncode}{late}: " +
                     " | ".join(text.splitlines()[-3:]))
    return text, usage.ru_maxrss / 1024, device, seconds
