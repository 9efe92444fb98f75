#!/usr/bin/env python3
"""Run the examples anew and compare their thermo output with the reference logs beside them.

    python3 run_examples.py [--update] [--backend NAME] [EXAMPLE ...]

Every examples/*/in.* is run with the settings of tolerances.yaml in a temporary directory: with the
base styles on each number of ranks given there, and with the KOKKOS styles on one rank for each of
their back ends (or, by --backend, for one of all). Its log is compared with the reference beside
it, log.DATE.NAME.g++.RANKS, column by column; --update writes new references instead. EXAMPLE is a
directory such as `relax`; without any, all are run. Environment variables name the programs, as
ctest sets them; back ends and their variables: ../runner.py.
"""
import argparse
from datetime import date
import os
from pathlib import Path
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time

import numpy as np
import yaml

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from runner import BACKENDS, KOKKOS, no_numbers, not_on_device, read_thermo    # noqa: E402

SOURCE = Path(os.environ.get("FOAM_SOURCE_DIR", HERE.parents[1])).resolve()
LOADED = re.compile(r"^Loaded \d+ plugins from .*\n", re.M)    # where LAMMPS found our plugin


class Wrong(Exception):
    """What a test of one example says when it fails."""


def program(variable):
    path = os.environ.get(variable)
    if not path or not Path(path).exists():
        sys.exit(f"the environment variable {variable} must name a program, not '{path or ''}': "
                 "ctest sets it, see unittest/CMakeLists.txt")
    return path


def run(script, settings, ranks, backend):
    """The log of one run, and its seconds."""
    command = [program(backend.variable), *backend.args, "-in", str(script)]
    if ranks > 1:
        command = [program("FOAM_MPIEXEC"), "-n", str(ranks)] + command
    for name, value in settings.get("variables", {}).items():
        command += ["-var", name, *map(str, value if isinstance(value, list) else [value])]
    start = time.perf_counter()
    with tempfile.TemporaryDirectory() as directory:
        with subprocess.Popen(command, cwd=directory, stdin=subprocess.DEVNULL, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              start_new_session=True) as process:
            try:
                screen, _ = process.communicate(timeout=settings["seconds"])
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)    # the ranks that mpiexec started too
                process.communicate()
                raise Wrong(f"did not end within {settings['seconds']} s") from None
        log = Path(directory, "log.lammps")
        text = log.read_text() if log.exists() else ""
    errors = [line for line in screen.splitlines() if "ERROR" in line]
    if process.returncode or errors or not text:
        raise Wrong(f"LAMMPS ended with code {process.returncode}: "
                    + " / ".join(errors or screen.splitlines()[-3:]))
    wrong = no_numbers(text) or backend.kokkos and not_on_device(text)
    if wrong:
        raise Wrong(wrong)
    return LOADED.sub("", text), time.perf_counter() - start


def compare(new, old, tolerance):
    """The worst deviation in units of what is allowed, and where; raises Wrong where it is > 1."""
    new, old = read_thermo(new), read_thermo(old)
    if not old:
        raise Wrong("the reference log has no thermo output")
    if len(new) != len(old):
        raise Wrong(f"{len(new)} runs with thermo output instead of {len(old)}")
    worst, where, wrong = 0.0, "nothing deviates", []
    for number, (table, old_table) in enumerate(zip(new, old), 1):
        if list(table) != list(old_table):
            raise Wrong(f"run {number}: columns {' '.join(table)} instead of {' '.join(old_table)}")
        lines, old_lines = len(table["Step"]), len(old_table["Step"])
        if lines != old_lines:
            raise Wrong(f"run {number}: {lines} lines of thermo output, not {old_lines}")
        for name, b in old_table.items():
            allowed = tolerance.get(name, tolerance["default"])
            if allowed == "skip" or not lines:
                continue
            a = table[name]
            with np.errstate(divide="ignore", invalid="ignore"):
                ratio = np.abs(a - b) / (allowed["abs"] + allowed["rel"] * np.abs(b))
            ratio[a == b] = 0.0
            ratio[np.isnan(ratio)] = np.inf
            line = int(ratio.argmax())
            text = (f"run {number}, step {old_table['Step'][line]:.0f}: {name} is {a[line]:.8g} "
                    f"instead of {b[line]:.8g}")
            if ratio[line] > worst:
                worst, where = ratio[line], text
            if not ratio[line] <= 1.0:
                wrong.append(text)
    if wrong:
        raise Wrong("; ".join(wrong[:3]) + (f"; {len(wrong) - 3} more" if len(wrong) > 3 else ""))
    return worst, where


def references(script, ranks):
    name = script.name.split(".", 1)[1]
    return sorted(script.parent.glob(f"log.*.{name}.g++.{ranks}"))


def update(script, ranks, log):
    """Write a reference, unless it tells of the machine that it was made on."""
    for text in (str(SOURCE), str(Path.home()), tempfile.gettempdir(), socket.gethostname()):
        if text in log:
            raise Wrong(f"the log holds '{text}', which does not belong into a reference")
    for old in references(script, ranks):
        old.unlink()
    today = date.today()
    name = script.name.split(".", 1)[1]
    path = script.with_name(f"log.{today.day}{today:%b%y}.{name}.g++.{ranks}")
    path.write_text(log)
    return path.name


def test(script, settings, ranks, backend, new_reference):
    log, seconds = run(script, settings, ranks, backend)
    if new_reference:
        return f"{update(script, ranks, log)} written, {seconds:.1f} s"
    found = references(script, ranks)
    if len(found) != 1:
        raise Wrong(f"{len(found)} reference logs instead of one: use --update")
    worst, where = compare(log, found[0].read_text(), settings["tolerance"])
    return f"good, {seconds:.1f} s; worst, {worst:.1g} of what is allowed: {where}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("examples", nargs="*", metavar="EXAMPLE", help="directories in examples/")
    parser.add_argument("--update", action="store_true", help="write new reference logs")
    parser.add_argument("--backend", choices=BACKENDS, help="one of those of the tests of styles")
    args = parser.parse_args()

    config = yaml.safe_load((HERE / "tolerances.yaml").read_text())
    scripts = sorted(path for path in (SOURCE / "examples").glob("*/in.*")
                     if not args.examples or path.parent.name in args.examples)
    missing = set(args.examples) - {path.parent.name for path in scripts}
    if missing or not scripts:
        sys.exit(f"no such example: {' '.join(sorted(missing)) or SOURCE / 'examples'}")
    failures = 0
    for script in scripts:
        name = str(script.relative_to(SOURCE / "examples"))
        settings = {**config, **config["examples"].get(name, {})}
        settings["tolerance"] = {**config["tolerance"],
                                 **config["examples"].get(name, {}).get("tolerance", {})}
        runs = [(args.backend or "wheel", ranks) for ranks in settings["ranks"]]
        if not args.backend and not args.update:
            runs += [(backend, 1) for backend in KOKKOS]
        if not settings.get("kokkos", True):
            runs = [(backend, ranks) for backend, ranks in runs if not BACKENDS[backend].kokkos]
        for backend, ranks in runs:
            try:
                outcome = test(script, settings, ranks, BACKENDS[backend], args.update)
            except Wrong as wrong:
                outcome, failures = f"WRONG: {wrong}", failures + 1
            print(f"{name}, {backend} on {ranks}: {outcome}", flush=True)
    sys.exit(f"{failures} wrong" if failures else 0)


if __name__ == "__main__":
    main()
