#!/usr/bin/env python3
"""Time per bubble and force evaluation on one core, beside LAMMPS' own gran/hooke.

    run.py [--lmp "COMMAND"] [--dim 2] [--bubbles 10000] [--phi 0.9] [--steps 200] [--repeat 5]

A packing is prepared once (in.packing); in.speed then runs on it
  foam    springs, gas through films and liquid, adaptive integration: what a coarsening run does
  relax   springs and integration alone
  hooke   LAMMPS' gran/hooke on the same packing, nothing moves
in turn, `repeat` times.  The table gives the fastest of each in nanoseconds per bubble and force
evaluation: of the whole run, and of the pair style alone as LAMMPS' own timers see it.
"""

import argparse
import re
import shlex
import subprocess
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent


def lammps(lmp, script, directory, **variables):
    """Run a script of this folder in `directory` and return what LAMMPS printed."""
    command = shlex.split(lmp) + ["-in", str(HERE / script), "-log", "none"]
    for name, value in variables.items():
        command += ["-var", name, str(value)]
    done = subprocess.run(command, cwd=directory, text=True, capture_output=True)
    if done.returncode:
        raise SystemExit(done.stdout + done.stderr)
    return done.stdout


def nanoseconds(output):
    """Whole run and pair style, per bubble and evaluation, of the last run in `output`."""
    evaluations, bubbles = map(int, re.findall(r"^evaluations (\d+) bubbles (\d+)", output, re.M)[-1])
    loop = float(re.findall(r"^Loop time of (\S+)", output, re.M)[-1])
    pair = float(re.findall(r"^Pair +\| (\S+)", output, re.M)[-1])
    return [1e9 * seconds / (evaluations * bubbles) for seconds in (loop, pair)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--lmp", default="lmp")
    parser.add_argument("--dim", type=int, choices=(2, 3), default=2)
    parser.add_argument("--bubbles", type=int, default=10000)
    parser.add_argument("--phi", type=float, default=0.9)
    parser.add_argument("--steps", type=int, default=200)
    parser.add_argument("--repeat", type=int, default=5)
    args = parser.parse_args()

    with tempfile.TemporaryDirectory() as directory:
        lammps(args.lmp, "in.packing", directory, dim=args.dim, N=args.bubbles, phi=args.phi)
        times = {"foam": [], "relax": [], "hooke": []}
        for _ in range(args.repeat):
            for what in times:
                output = lammps(args.lmp, "in.speed", directory, what=what, dim=args.dim,
                                steps=args.steps)
                times[what].append(nanoseconds(output))

    print(f"{args.dim}D, {args.bubbles} bubbles, gas fraction {args.phi}, one core, "
          f"fastest of {args.repeat}")
    print("ns per bubble and evaluation    whole run    pair style")
    for what, results in times.items():
        whole, pair = (min(column) for column in zip(*results))
        print(f"{what:30s} {whole:10.1f} {pair:13.1f}")


if __name__ == "__main__":
    main()
