#!/usr/bin/env python3
"""What a step of a resolved liquid costs on one core, and which share of it the pressure has.

    liquid.py --lmp "COMMAND" [--sizes 12,16,24,32,48] [--repeat 3] [--steps 10] [--out DIR]     ten minutes
    liquid.py --lmp "COMMAND" --sizes 12 --repeat 1 --no-count                                   seconds
    liquid.py --way "base=lmp" --way "2 ranks=mpiexec -n 2 lmp" ... [--sizes 32]                 on more cores

A periodic cube of n^3 particles, with the velocities of examples/liquid/in.turbulence at Re 1e6.  Nothing but the
solver's tolerance changes, and with it the number of iterations.  Time per particle and step is then a straight line:
its slope is what an iteration costs, and where it begins what all else costs, lists among it.  Measured are

  ns             processor time, by LAMMPS' log; runs in turn, smallest of --repeat
  instructions   the same line of instructions, counted by valgrind, where there is one, at n = 12.  They do not depend
                 on what else the machine does.
  bytes          that an iteration must move, each array read or written once: 12 for each entry of the matrix in
                 both products, and 160 for vectors and lengths of rows.  Over the bandwidth of a triad (triad.cpp) on
                 one core they are the least time of an iteration, if the matrix is larger than the caches.

Writes liquid.csv.  With --way, NAME=COMMAND, only ways.csv: time by the clock of these ways to start LAMMPS, on several
ranks or threads, in turn, smallest of --repeat.
"""
from __future__ import annotations

import argparse
import csv
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np

from machine import Failed, cpu_name, host_bandwidth
from states import loop_seconds

TOLERANCES = "1.0e-2", "1.0e-4", "1.0e-6", "1.0e-8"
USUAL = "1.0e-6"
BEFORE = 3             # steps before those that are measured
COUNTED = 12, 2, 6     # particles along an edge, steps of the two runs that valgrind counts
OF_VECTORS = 160       # bytes: 19 numbers, 2 lengths of a row
SCRIPT = """
units         lj
atom_style    sphere 1
boundary      p p p
comm_modify   vel yes
variable      dr equal 1.0/v_n
lattice       sc $(1/v_dr^3) origin 0.5 0.5 0.5
region        box block 0 1 0 1 0 1 units box
create_box    1 box
create_atoms  1 box
set           group all diameter ${dr} density $(6/PI)
displace_atoms all random $(0.2*v_dr) $(0.2*v_dr) $(0.2*v_dr) 1 units box
variable      x atom 2*PI*x
variable      y atom 2*PI*y
variable      z atom 2*PI*z
variable      a equal 5*PI/6
variable      b equal PI/6
variable      u atom sin(v_x-v_a)*cos(v_y-v_b)*sin(v_z)-cos(v_z-v_a)*sin(v_x-v_b)*sin(v_y)
variable      v atom sin(v_y-v_a)*cos(v_z-v_b)*sin(v_x)-cos(v_x-v_a)*sin(v_y-v_b)*sin(v_z)
variable      w atom sin(v_z-v_a)*cos(v_x-v_b)*sin(v_y)-cos(v_y-v_a)*sin(v_z-v_b)*sin(v_x)
velocity      all set v_u v_v v_w
pair_style    liquid/sph ${dr}
pair_coeff    * *
neighbor      $(0.6*v_dr) bin
fix           flow all liquid/flow 1.0e6 none solver ${tol} 1000
compute       near all coord/atom cutoff $(2.6*v_dr)
compute       entries all reduce ave c_near
thermo        1
thermo_style  custom step f_flow[3]
run           ${before}
thermo_style  custom step f_flow[3]
run           ${steps}
thermo_style  custom step c_entries
run           0
print         "measured particles $(count(all)) entries $(c_entries)"
"""


class Bench:
    def __init__(self, args: argparse.Namespace) -> None:
        self.lmp, self.args = shlex.split(args.lmp), args    # how LAMMPS is started now
        self.script = args.out / "in.liquid"
        self.script.write_text(SCRIPT)

    def run(self, n: int, tol: str, steps: int, before: list[str] | None = None) -> str:
        words = [word for key, value in {"n": n, "tol": tol, "steps": steps, "before": BEFORE}.items()
                 for word in ("-var", key, str(value))]
        command = [*(before or []), *self.lmp, "-in", str(self.script), "-log", "none", *words]
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
        if done.returncode:
            raise Failed(f"{shlex.join(command)}\n{(done.stdout + done.stderr)[-2000:]}")
        return done.stdout + done.stderr

    def measure(self, n: int, tol: str) -> dict[str, float]:
        """Nanoseconds per particle and step, iterations, entries of a row of the matrix."""
        text = self.run(n, tol, self.args.steps)
        found = re.search(r"^measured particles (\d+) entries (\S+)", text, re.M)
        if not found:
            raise Failed(f"LAMMPS did not come to its end:\n{text[-2000:]}")
        loop = text.split("Setting up Verlet run")[2]
        lists = re.search(r"^Neigh +\| *\S+ +\| *(\S+)", loop, re.M)
        wall, cpu = loop_seconds(loop)
        per = 1e9 * cpu / int(found[1]) / self.args.steps
        return {"ns": per, "lists": float(lists[1]) / wall * per if lists else 0.0,
                "iterations": mean_iterations(loop), "entries": float(found[2])}

    def instructions(self) -> tuple[float, float]:
        """Per particle and step: without iterations, and of an iteration; nan without valgrind."""
        if not shutil.which("valgrind"):
            return float("nan"), float("nan")
        n, few, more = COUNTED
        points = []
        for tol in (TOLERANCES[0], TOLERANCES[-1]):
            counts, iterations = [], []
            for steps in (few, more):
                text = self.run(n, tol, steps, ["valgrind", "--tool=cachegrind", "--cache-sim=no",
                                                "--cachegrind-out-file=/dev/null", "--trace-children=yes"])
                counts.append(max(int(one.replace(",", "")) for one in re.findall(r"I +refs: +([\d,]+)", text)))
                iterations.append(steps * mean_iterations(text.split("Setting up Verlet run")[2]))
            points.append(((iterations[1] - iterations[0]) / (more - few),
                           (counts[1] - counts[0]) / (more - few) / n**3))
        (x0, y0), (x1, y1) = points
        slope = (y1 - y0) / (x1 - x0)
        return y0 - slope * x0, slope


def mean_iterations(loop: str) -> float:
    """Of the steps of a run, by its lines of output but the first."""
    lines = re.findall(r"^ +\d+ +(\d+) *$", loop, re.M)
    return float(np.mean([int(one) for one in lines[1:]]))


def rows_of_ways(bench: Bench, ways: dict[str, str], sizes: list[int]) -> list[dict[str, object]]:
    """By the clock; ratios are those of the first way over the others."""
    best: dict[tuple[int, str], float] = {}
    for n in sizes:
        for turn in range(bench.args.repeat):
            for name, command in ways.items():
                bench.lmp = shlex.split(command)
                loop = bench.run(n, USUAL, bench.args.steps).split("Setting up Verlet run")[2]
                per = 1e9 * loop_seconds(loop)[0] / n**3 / bench.args.steps
                best[n, name] = min(per, best.get((n, name), per))
    first = next(iter(ways))
    return [{"n": n, "way": name, "ns by the clock": f"{ns:.0f}",
             f"times as fast as {first}": f"{best[n, first] / ns:.2f}"} for (n, name), ns in best.items()]


def rows_of(bench: Bench, sizes: list[int], bandwidth: float | None) -> list[dict[str, object]]:
    rows: list[dict[str, object]] = []
    for n in sizes:
        best: dict[str, dict[str, float]] = {}
        for turn in range(bench.args.repeat):
            for tol in TOLERANCES:
                now = bench.measure(n, tol)
                if tol not in best or now["ns"] < best[tol]["ns"]:
                    best[tol] = now
        slope, start = np.polyfit([one["iterations"] for one in best.values()], [one["ns"] for one in best.values()], 1)
        usual = best[USUAL]
        moved = 24 * usual["entries"] + OF_VECTORS
        rows.append({"n": n, "particles": n**3, "entries": f"{usual['entries']:.1f}", "ns": f"{usual['ns']:.0f}",
                     "iterations": f"{usual['iterations']:.1f}", "ns of an iteration": f"{slope:.0f}",
                     "ns of all else": f"{start:.0f}", "ns of lists": f"{usual['lists']:.0f}",
                     "share of the solver": f"{slope * usual['iterations'] / usual['ns']:.2f}",
                     "matrix MB": f"{1e-6 * n**3 * 12 * usual['entries']:.0f}",
                     "bytes of an iteration": f"{moved:.0f}", "GB/s": f"{moved / slope:.1f}",
                     "ns by bandwidth": f"{moved / bandwidth:.0f}" if bandwidth else ""})
        print(rows[-1], flush=True)
    return rows


def write(rows: list[dict[str, object]], path: Path) -> None:
    with path.open("w", newline="") as file:
        for writer in (csv.DictWriter(file, list(rows[0]), lineterminator="\n"),
                       csv.DictWriter(sys.stdout, list(rows[0]), lineterminator="\n", delimiter="\t")):
            writer.writeheader()
            writer.writerows(rows)


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--lmp", default="lmp", metavar="COMMAND", help="how to start LAMMPS (default %(default)s)")
    parser.add_argument("--sizes", default="12,16,24,32,48", metavar="N,N", help="particles along an edge")
    parser.add_argument("--repeat", type=int, default=3, help="times that each run is done (default %(default)s)")
    parser.add_argument("--steps", type=int, default=10, help="that are measured (default %(default)s)")
    parser.add_argument("--way", action="append", default=[], metavar="NAME=COMMAND", help="these ways alone, in turn")
    parser.add_argument("--no-count", action="store_true", help="no instructions")
    parser.add_argument("--out", type=Path, default=Path(), metavar="DIR", help="where everything is written")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    bench = Bench(args)
    sizes = [int(n) for n in args.sizes.split(",")]
    if args.way:
        ways = dict(way.partition("=")[::2] for way in args.way)
        if not all(ways.values()) or len(ways) < len(args.way):
            parser.error("each --way has a name of its own and a command: NAME=COMMAND")
        try:
            write(rows_of_ways(bench, ways, sizes), args.out / "ways.csv")
        except Failed as error:
            sys.exit(str(error))
        return
    bandwidth = host_bandwidth(1, args.out)
    try:
        rows = rows_of(bench, sizes, bandwidth)
        rest, iteration = (float("nan"), float("nan")) if args.no_count else bench.instructions()
    except Failed as error:
        sys.exit(str(error))
    print(cpu_name(), f"triad {bandwidth} GB/s" if bandwidth else "", sep="\n")
    print(f"instructions per particle and step, n = {COUNTED[0]}: {iteration:.0f} an iteration, {rest:.0f} all else")
    write(rows, args.out / "liquid.csv")


if __name__ == "__main__":
    main()
