#!/usr/bin/env python3
"""What each term of the model of bubbles with inertia costs, per bubble and step, beside a spring alone.

    terms.py --lmp "COMMAND" [--repeat 7] [--steps 30] [--copies 2] [--out DIR]     a quarter of an hour
    terms.py --lmp "COMMAND" --only 1,2,3                                           some of the models

One packing (in.terms): 2500 bubbles of 0.8 to 1.2 times 0.5 mm at a gas fraction of 0.66, copied --copies times along
each side, at random speeds.  Nothing but the arguments of pair_style bubble/collision changes.  Lists are made once,
before the measurement.  Measured are

  instructions   of the whole step, counted by valgrind, where there is one: two runs of different length of the packing
                 without copies.  They do not depend on what else the machine does.
  ns             processor time of the whole step; models in turn, smallest and median of --repeat

Writes terms.csv.
"""
from __future__ import annotations

import argparse
import csv
import re
import shlex
import shutil
import statistics
import subprocess
import sys
from pathlib import Path

from machine import HERE, Failed, cpu_name
from states import loop_seconds

ALONE = "viscous none lubrication no h0 1.0e-5 film no"
MODELS = {
    "spring alone, reach 1": f"elastic spring {ALONE} reach 1",
    "spring alone": f"elastic spring {ALONE}",
    "spring alone, reach 0.05": f"elastic spring {ALONE} reach 0.05",
    "quadratic alone, reach 1": f"{ALONE} reach 1",
    "all terms": "tangential all",
    "all, without elastic": "tangential all elastic none",
    "all, without viscous": "tangential all viscous none",
    "all, without lubrication": "tangential all lubrication no",
    "all, without tangential": "",
    "all, viscous derived": "tangential all viscous derived",
    "all, integral exact": "tangential all integral exact",
    "all, h0 current": "tangential all h0 current",
    "all, h0 1e-5": "tangential all h0 1.0e-5",
    "all, film no": "tangential all film no",
    "all, without tangential, reach 0.3": "reach 0.3",
}
COUNTED = 10, 30    # steps of the two runs that valgrind counts


class Bench:
    def __init__(self, args: argparse.Namespace) -> None:
        self.lmp = shlex.split(args.lmp)
        self.args, self.packing = args, (args.out / "packing.data").resolve()

    def run(self, settings: dict[str, object], before: list[str] | None = None) -> str:
        words = [word for key, value in settings.items() for word in ("-var", key, str(value))]
        command = [*(before or []), *self.lmp, "-in", str(HERE / "in.terms"), "-log", "none", *words]
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
        if done.returncode:
            raise Failed(f"{shlex.join(command)}\n{(done.stdout + done.stderr)[-2000:]}")
        return done.stdout + done.stderr

    def measure(self, model: str, **settings: object) -> dict[str, object]:
        return {"what": "measure", "file": self.packing, "model": f'{MODELS[model]} hmin 1.0e-5', **settings}

    def pack(self) -> None:
        if not self.packing.exists():
            self.run({"file": self.packing})

    def processor_time(self, model: str) -> tuple[float, dict[str, float]]:
        """Nanoseconds per bubble and step, and what the packing is like."""
        text = self.run(self.measure(model, copies=self.args.copies, steps=self.args.steps))
        found = re.search(r"^measured bubbles (\d+) contacts (\S+)", text, re.M)
        listed = re.search(r"^Ave neighs/atom = (\S+)", text, re.M)
        if not found or not listed:
            raise Failed(f"LAMMPS did not come to its end:\n{text[-2000:]}")
        loop = text[text.rindex("Setting up Verlet run"):]
        seconds = loop_seconds(loop)[1]
        return 1e9 * seconds / int(found[1]) / self.args.steps, {"contacts": float(found[2]),
                                                                "listed": float(listed[1])}

    def instructions(self, model: str) -> float:
        """Per bubble and step; nan without valgrind."""
        if not shutil.which("valgrind"):
            return float("nan")
        counts = []
        for steps in COUNTED:
            text = self.run(self.measure(model, copies=1, warm=1, steps=steps),
                            ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null",
                             "--trace-children=yes"])
            counts.append(max(int(found.replace(",", "")) for found in re.findall(r"I +refs: +([\d,]+)", text)))
            found = re.search(r"^measured bubbles (\d+)", text, re.M)
        if not found:
            raise Failed(f"LAMMPS did not come to its end:\n{text[-2000:]}")
        return (counts[1] - counts[0]) / int(found[1]) / (COUNTED[1] - COUNTED[0])


def rows_of(bench: Bench, models: list[str], repeat: int) -> list[dict[str, object]]:
    about: dict[str, dict[str, float]] = {}
    times: dict[str, list[float]] = {model: [] for model in models}
    counts = {model: bench.instructions(model) for model in models}
    for turn in range(repeat):
        print(f"turn {turn + 1} of {repeat}", flush=True)
        for model in models:
            time, about[model] = bench.processor_time(model)
            times[model].append(time)
    first = models[0]
    return [{"model": model, "arguments": MODELS[model], "listed": f"{about[model]['listed']:.1f}",
             "contacts": f"{about[model]['contacts']:.2f}", "instructions": f"{counts[model]:.0f}",
             "over first": f"{counts[model] / counts[first]:.3f}", "ns": f"{min(times[model]):.0f}",
             "ns median": f"{statistics.median(times[model]):.0f}",
             "ns over first": f"{min(times[model]) / min(times[first]):.3f}"} for model in models]


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--lmp", default="lmp", metavar="COMMAND", help="how to start LAMMPS (default %(default)s)")
    parser.add_argument("--repeat", type=int, default=7, help="times that each model is run (default %(default)s)")
    parser.add_argument("--steps", type=int, default=30, help="of a run (default %(default)s)")
    parser.add_argument("--copies", type=int, default=2, help="of the packing along each side (default %(default)s)")
    parser.add_argument("--only", metavar="N,N", help=f"models, from 1 to {len(MODELS)}, by these numbers; the first "
                        "is what others are compared with")
    parser.add_argument("--out", type=Path, default=Path(), metavar="DIR", help="where everything is written")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    names = list(MODELS)
    models = [names[int(n) - 1] for n in args.only.split(",")] if args.only else names
    bench = Bench(args)
    try:
        bench.pack()
        rows = rows_of(bench, models, args.repeat)
    except Failed as error:
        sys.exit(str(error))
    print(cpu_name())
    with (args.out / "terms.csv").open("w", newline="") as file:
        for writer in (csv.DictWriter(file, list(rows[0]), lineterminator="\n"),
                       csv.DictWriter(sys.stdout, list(rows[0]), lineterminator="\n", delimiter="\t")):
            writer.writeheader()
            writer.writerows(rows)


if __name__ == "__main__":
    main()
