#!/usr/bin/env python3
"""Rheology of 2D foams around jamming: runs in.rheology over gas fractions, rates and seeds; plot.py draws and fits.

    python3 run.py [--lmp LMP] [--out DIR] [--jobs N]               # 1000 bubbles, ten minutes or so on two cores
    python3 run.py --slow                                           # near jamming also 1e-6, and three seeds: an hour
    python3 run.py --full                                           # and 10^4 bubbles: hours
    python3 run.py --bubbles 10000 --phis 0.84 0.85 --rates 1e-4 1e-5 [--drag static] [--seeds 1 2]    # more points

Each flow curve goes into a file of its own. What is there already is not run again, so a run that was stopped goes on,
and points of other sizes, rates and seeds join those that DIR has.
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
CONTACT = "contact 1.0"
DECADES = [0.1, 1e-2, 1e-3, 1e-4, 1e-5]
HALVES = [0.1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5]
SLOW = [1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6]
WIDE = [0.80, 0.82, 0.86, 0.90, 0.95, 1.00]
NEAR = [0.835, 0.838, 0.840, 0.842, 0.843, 0.844, 0.846, 0.850, 0.855]


def curve(bubbles, phi, drag, rates, strain, seed):
    """A flow curve: the name of its file, and variables of in.rheology."""
    name = f"curve-{bubbles}-{phi:.4f}-{drag.split()[0]}-{rates[0]:g}-{rates[-1]:g}-{seed}.csv"
    return name, dict(N=bubbles, phi=phi, drag=drag, rates=" ".join(f"{r:g}" for r in rates), strain=strain, seed=seed)


def startup(bubbles, phi, drag, rate, seed):
    """Start-up of shear from rest: relaxed for longer, and a line for each step."""
    name = f"startup-{bubbles}-{phi:.4f}-{drag.split()[0]}-{rate:g}-{seed}.csv"
    return name, dict(N=bubbles, phi=phi, drag=drag, rates=f"{rate:g}", strain=3.0, seed=seed, nrelax=1000, every=1)


def chosen(args):
    """All runs, the long ones first, so that no core waits for the last."""
    n = args.bubbles or 1000
    if args.phis or args.rates:
        rates = sorted(args.rates or HALVES, reverse=True)
        return [curve(n, phi, args.drag, rates, args.strain, seed) for seed in args.seeds for phi in args.phis or NEAR]
    runs = []
    if args.full:
        runs += [curve(10000, phi, "static", HALVES[2:], args.strain, 2007) for phi in [*NEAR, *WIDE]]
    if args.slow or args.full:
        runs += [curve(n, phi, "static", SLOW, 6.0, seed) for seed in (2007, 2008, 2009) for phi in NEAR]
    runs += [curve(n, phi, CONTACT, DECADES, args.strain, 2007) for phi in [0.80, 0.84, 0.85, *WIDE[3:]]]
    runs += [curve(n, phi, "static", HALVES, args.strain, 2007) for phi in [*reversed(WIDE), *NEAR]]
    runs += [startup(n, 0.90, drag, rate, seed) for drag in (CONTACT, "static") for rate in (1e-4, 1e-3, 1e-2, 1e-1)
             for seed in range(1, 9)]
    return runs


def run(lmp, out, name, variables):
    """One run of in.rheology."""
    part = out / f"{name}.part"                     # an unfinished file is not taken for a finished one
    command = [*shlex.split(lmp), "-in", str(HERE / "in.rheology"), "-log", "none", "-screen", "none"]
    for variable, value in [*variables.items(), ("file", part)]:
        command += ["-var", variable, str(value)]
    done = subprocess.run(command, cwd=out, env=dict(os.environ, OMP_NUM_THREADS="1"), check=False,
                          stdin=subprocess.DEVNULL)
    if done.returncode:
        sys.exit(f"LAMMPS failed: {shlex.join(command)}")
    part.rename(out / name)


def cost(variables):
    """Of a run, roughly, for the time to go: as measured with 1000 bubbles, where slow flows need long steps."""
    rates = [float(rate) for rate in variables["rates"].split()]
    fast, slow = (1, 1) if variables["drag"] == "static" else (8, 2)
    return variables["N"]**1.5 * variables["strain"] * sum(fast + slow * (4e-4 / rate)**0.72 for rate in rates)


def run_all(args, out):
    runs = {name: dict(variables, tol=args.tol) for name, variables in chosen(args) if not (out / name).exists()}
    start, whole, done = time.monotonic(), sum(map(cost, runs.values())), 0.0
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        running = {pool.submit(run, args.lmp, out, *one): one for one in runs.items()}
        for n, one in enumerate(concurrent.futures.as_completed(running), 1):
            one.result()
            done += cost(running[one][1])
            spent = time.monotonic() - start
            print(f"{n} of {len(runs)} runs, {spent:.0f} s, to go about {spent * (whole / done - 1):.0f} s", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lmp", default="lmp", help="command that starts LAMMPS with the styles (%(default)s)")
    parser.add_argument("--out", type=Path, default=Path("foam-rheology"), help="directory for results (%(default)s)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="runs side by side (%(default)s)")
    parser.add_argument("--bubbles", type=int, help="number of bubbles (1000)")
    parser.add_argument("--slow", action="store_true", help="near jamming to the rate 1e-6, three seeds")
    parser.add_argument("--full", action="store_true", help="that, and 10^4 bubbles")
    parser.add_argument("--strain", type=float, default=4.0, help="strain at each rate; the first 1 is not counted")
    parser.add_argument("--phis", type=float, nargs="+", help="only flow curves of these gas fractions")
    parser.add_argument("--rates", type=float, nargs="+", help="only flow curves of these rates")
    parser.add_argument("--drag", default="static", help='of these flow curves (%(default)s, or "contact 1.0")')
    parser.add_argument("--seeds", type=int, nargs="+", default=[2007], help="of these flow curves")
    parser.add_argument("--tol", default="1.0e-3", help="error per step, in a DIR of its own (%(default)s)")
    parser.add_argument("--plot-only", action="store_true", help="draw from the files that are there")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    out = args.out.resolve()
    if not args.plot_only:
        run_all(args, out)
    plot.make_pictures(out, args.bubbles)


if __name__ == "__main__":
    main()
