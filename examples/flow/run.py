#!/usr/bin/env python3
"""Foams that flow along walls and with the liquid: runs in.channel, in.couette and in.vortex, and draws what they do.

    python3 run.py [--lmp LMP] [--out DIR] [--jobs N]

What is there already is not run again, so a run that was stopped goes on; plot.py draws from the files.
"""
import argparse
import concurrent.futures
import os
from pathlib import Path
import shlex
import subprocess
import sys
import time

import plot

HERE = Path(__file__).resolve().parent
COST = {"vortex": 4, "couette": 5, "channel": 15, "contact": 4, "curve": 90}      # seconds or so, for the time to go


def run(lmp, out, script, name, variables):
    part = out / f"{name}.part"                     # an unfinished file is not taken for a finished one
    command = [*shlex.split(lmp), "-in", str(script), "-log", "none", "-screen", "none"]
    for variable, value in [*variables.items(), ("file", part)]:
        command += ["-var", variable, str(value)]
    done = subprocess.run(command, cwd=out, env=dict(os.environ, OMP_NUM_THREADS="1"), check=False,
                          stdin=subprocess.DEVNULL)
    if done.returncode:
        sys.exit(f"LAMMPS failed: {shlex.join(command)}")
    part.rename(out / name)


def all_runs(out):
    """What is not there yet: seconds, script, name of its file, variables."""
    curve = dict(N=1000, phi=0.95, rates="1e-1 3e-2 1e-2 3e-3 1e-3 3e-4 1e-4 3e-5 1e-5")
    runs = [(COST["curve"], HERE.parent / "rheology/in.rheology", plot.CURVE, curve)]
    for name, (script, variables) in plot.CASES.items():
        more = COST["contact"] if "contact" in name else 1
        runs.append((more * COST[script], HERE / f"in.{script}", f"{name}.dump", variables))
    return sorted((one for one in runs if not (out / one[2]).exists()), key=lambda one: -one[0])


def run_all(args, out):
    runs = all_runs(out)
    start, whole, done = time.monotonic(), sum(one[0] for one in runs), 0
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        running = {pool.submit(run, args.lmp, out, *one[1:]): one for one in runs}
        for n, one in enumerate(concurrent.futures.as_completed(running), 1):
            one.result()
            done += running[one][0]
            spent = time.monotonic() - start
            print(f"{n} of {len(runs)} runs, {running[one][2]}, {spent:.0f} s, to go about "
                  f"{spent * (whole / done - 1):.0f} s", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lmp", default="lmp", help="command that starts LAMMPS with the styles (%(default)s)")
    parser.add_argument("--out", type=Path, default=Path("foam-flow"), help="directory for results (%(default)s)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="runs side by side (%(default)s)")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    out = args.out.resolve()
    run_all(args, out)
    plot.make_pictures(out)


if __name__ == "__main__":
    main()
