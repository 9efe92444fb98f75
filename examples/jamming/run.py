#!/usr/bin/env python3
"""Jamming of packings: runs in.jamming and in.sticky for laws, dimensions and seeds; plot.py draws and fits.

    python3 run.py [--lmp LMP] [--out DIR] [--jobs N]           # ten minutes or so on two cores
    python3 run.py --full                                       # more packings, and larger ones: hours
    python3 run.py --bubbles 1000 --seeds 1 2 3 [--only 2d] [--alphas 2.0] [--short]    # more packings of a size

Each packing has files of its own. What is there already is not run again, so a run that was stopped goes on, and
packings of other sizes and seeds join those that DIR has.
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
PHIS = "0.66 0.68 0.70 0.72 0.74 0.76 0.78 0.80 0.82 0.83 0.84 0.85 0.86 0.88"
SHORT = "3e-5 1e-4"                 # is enough for phi_J
DISTANCES = "3e-5 1e-4 3e-4 1e-3 3e-3 1e-2 3e-2 1e-1"


def packing(system, alpha, bubbles, seed, distances=DISTANCES, start=None):
    """A packing: the name of its files, and variables of in.jamming."""
    dim, ratio = plot.SYSTEMS[system][:2]
    return f"packing-{system}-{alpha:g}-{bubbles}-{seed}", dict(
        N=bubbles, dim=dim, ratio=ratio, alpha=alpha, seed=seed, near=distances.split()[0], distances=distances,
        start=start or (0.86 if dim == 2 else 0.66))


def sticky(depth, bubbles, seed):
    """Packings at many gas fractions, with attraction of that depth: name of the file, and variables of in.sticky."""
    law = f"sticky {depth}" if depth else "spring"
    return f"sticky-{depth:g}-{bubbles}-{seed}", dict(N=bubbles, law=law, phis=PHIS, seed=seed)


def chosen(args):
    """All runs, seed by seed, so that a run that is stopped leaves packings of each kind."""
    if args.bubbles or args.seeds:
        distances = SHORT if args.short else DISTANCES
        return [packing(system, alpha, args.bubbles or 500, seed, distances, args.start)
                for seed in args.seeds or range(1, 7) for system in args.only or ["2d", "3d"] for alpha in args.alphas]
    runs = []
    for seed in range(1, 7 if not args.full else 33):
        runs += [packing(system, alpha, 500, seed) for alpha in (2.5, 2.0) for system in ("3d", "2d")]
        runs += [packing("3d-mixed", 2.0, 500, seed, SHORT)]
        runs += [sticky(depth, 500, seed) for depth in (0.0, 0.001, 0.01)]
    if args.full:
        runs += [packing(system, alpha, 2000, seed) for seed in range(1, 9) for alpha in (2.0, 2.5)
                 for system in ("2d", "3d")]
    return runs


def run(lmp, out, name, variables):
    """One run of in.jamming or in.sticky. An unfinished file is not taken for a finished one."""
    script, part = ("in.sticky", f"{name}.part.csv") if "law" in variables else ("in.jamming", f"{name}.part")
    command = [*shlex.split(lmp), "-in", str(HERE / script), "-log", "none", "-screen", "none"]
    for variable, value in [*variables.items(), ("file", part)]:
        command += ["-var", variable, str(value)]
    done = subprocess.run(command, cwd=out, env=dict(os.environ, OMP_NUM_THREADS="1"), check=False,
                          stdin=subprocess.DEVNULL)
    if done.returncode:
        sys.exit(f"LAMMPS failed: {shlex.join(command)}")
    if script == "in.jamming":
        (out / f"{part}.lammpstrj").rename(out / f"{name}.lammpstrj")
    (out / f"{name}.part.csv").rename(out / f"{name}.csv")


def cost(variables):
    """Of a run, roughly, for the time to go."""
    if "law" in variables:
        return variables["N"]**1.4 * 25
    relaxations = 6 + 4 * len(variables["distances"].split())
    return variables["N"]**1.4 * relaxations * (1 if variables["dim"] == 2 else 2) * (
        1 if variables["alpha"] == 2 else 3)


def run_all(args, out):
    runs = {name: variables for name, variables in chosen(args) if not (out / f"{name}.csv").exists()}
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
    parser.add_argument("--out", type=Path, default=Path("foam-jamming"), help="directory for results (%(default)s)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="runs side by side (%(default)s)")
    parser.add_argument("--full", action="store_true", help="32 packings of 500 bubbles, 8 of 2000")
    parser.add_argument("--bubbles", type=int, help="only packings of this size")
    parser.add_argument("--seeds", type=int, nargs="+", help="only packings of these seeds")
    parser.add_argument("--only", nargs="+", choices=plot.SYSTEMS, help="of these packings, such systems")
    parser.add_argument("--alphas", type=float, nargs="+", default=[2.0, 2.5], help="of these packings, such laws")
    parser.add_argument("--start", type=float, help="of these packings, gas fraction of the start (0.86, 3D 0.66)")
    parser.add_argument("--short", action="store_true", help="of these packings, the jamming point alone")
    parser.add_argument("--plot-only", action="store_true", help="draw from the files that are there")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    out = args.out.resolve()
    if not args.plot_only:
        run_all(args, out)
    plot.make_pictures(out, args.bubbles)


if __name__ == "__main__":
    main()
