#!/usr/bin/env python3
"""What other fixes cost a foam: fix viscous in evaluations, fix foam/contacts in time.

    fixes.py --lmp "COMMAND" [--repeat 5] [--out DIR]     some minutes

  viscous    Evaluations of a coarsening foam of 64 bubbles in 2D to tau = 1, over those without fix viscous, for some
             damping coefficients: geometric mean of some starts, and its standard error.  They do not depend on what
             else the machine does.
  contacts   Processor time of a step of fix foam/abm with fix foam/contacts, over that without it, for 20 000 bubbles
             in 2D: the fastest of --repeat of each, in turn.  With the time of a step with it, in ms.

Writes fixes.csv.
"""
from __future__ import annotations

import argparse
import csv
import re
import shlex
import subprocess
import sys
from pathlib import Path

import numpy as np

from machine import Failed, cpu_name
from states import loop_seconds

FOAM = """
newton        {newton}
dimension     2
atom_style    sphere 1
create_foam   {N} {seed} sizes normal 1.0 0.21 rmin 0.01 phi 0.90
pair_style    durian/foam 1.0
pair_coeff    * * 1.0
neighbor      0.5 bin
fix           step all foam/rkc 1.0e-3
thermo        100000000
relax_foam    rounds 20 limit 1.0e-3
reset_timestep 0 time 0.0
fix           gas all foam/coarsen 1.0e-3 0.1
unfix         step
fix           step all {step}
{more}
"""
TO_TAU_1 = """
variable      tau equal f_gas[1]
fix           end all halt 1 v_tau > 1.0 error soft
variable      before equal $(f_step[5])
run           100000000
print         "measured evaluations $(f_step[5]-v_before) tau $(f_gas[1])"
"""
STEPS = """
run           20 post no
run           100
print         "measured steps 100"
"""
STEP = {"foam/rkc": "foam/rkc 1.0e-3", "foam/abm": "foam/abm 1.0e-5 norm rms"}
DAMPING = (0.1, 0.5, 0.8)
STARTS = (1, 2, 3, 4, 5)


class Bench:
    def __init__(self, args: argparse.Namespace) -> None:
        self.lmp, self.args = shlex.split(args.lmp), args

    def run(self, text: str) -> str:
        script = self.args.out / "in.fixes"
        script.write_text(text)
        done = subprocess.run([*self.lmp, "-in", str(script), "-log", "none"], stdin=subprocess.DEVNULL,
                              capture_output=True, text=True)
        if done.returncode or "\nmeasured " not in done.stdout:
            raise Failed(f"LAMMPS did not come to its end:\n{(done.stdout + done.stderr)[-2000:]}")
        return done.stdout

    def evaluations(self, style: str, damping: float, seed: int) -> int:
        more = f"fix other all viscous {damping}\n" if damping else ""
        text = self.run(FOAM.format(newton="on", N=64, seed=seed, step=STEP[style], more=more) + TO_TAU_1)
        found = re.search(r"^measured evaluations (\d+)", text, re.M)
        assert found
        return int(found[1])

    def time_of_step(self, newton: str, with_fix: bool) -> float:
        more = "fix ages all foam/contacts\n" if with_fix else ""
        text = self.run(FOAM.format(newton=newton, N=20000, seed=1, step=STEP["foam/abm"], more=more) + STEPS)
        return loop_seconds(text[text.rindex("Setting up Verlet run"):])[1]


def rows_of(bench: Bench) -> list[dict[str, object]]:
    rows: list[dict[str, object]] = []
    for style in STEP:
        alone = np.array([bench.evaluations(style, 0.0, seed) for seed in STARTS], dtype=float)
        for damping in DAMPING:
            print(f"{style}, viscous {damping}", flush=True)
            ratio = np.log([bench.evaluations(style, damping, seed) for seed in STARTS] / alone)
            rows.append({"fix": f"viscous {damping}", "beside": style, "relative": f"{np.exp(ratio.mean()):.2f}",
                         "error": f"{np.exp(ratio.mean()) * ratio.std(ddof=1) / np.sqrt(len(STARTS)):.2f}",
                         "ms": ""})
    for newton in ("off", "on"):
        times: dict[bool, list[float]] = {False: [], True: []}
        for turn in range(bench.args.repeat):
            print(f"foam/contacts, newton {newton}, turn {turn + 1} of {bench.args.repeat}", flush=True)
            for with_fix, found in times.items():
                found.append(bench.time_of_step(newton, with_fix))
        rows.append({"fix": "foam/contacts", "beside": f"foam/abm, newton {newton}",
                     "relative": f"{min(times[True]) / min(times[False]):.2f}", "error": "",
                     "ms": f"{1e3 * min(times[True]) / 100:.2f}"})
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--lmp", default="lmp", metavar="COMMAND", help="how to start LAMMPS (default %(default)s)")
    parser.add_argument("--repeat", type=int, default=5, help="times that a time is measured (default %(default)s)")
    parser.add_argument("--out", type=Path, default=Path(), metavar="DIR", help="where everything is written")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    try:
        rows = rows_of(Bench(args))
    except Failed as error:
        sys.exit(str(error))
    print(cpu_name())
    with (args.out / "fixes.csv").open("w", newline="") as file:
        for writer in (csv.DictWriter(file, list(rows[0]), lineterminator="\n"),
                       csv.DictWriter(sys.stdout, list(rows[0]), lineterminator="\n", delimiter="\t")):
            writer.writeheader()
            writer.writerows(rows)


if __name__ == "__main__":
    main()
