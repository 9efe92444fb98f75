#!/usr/bin/env python3
"""What an exponent of figure 4.1 depends on: seed, size, tolerance, integrator, or a term of the model.

    python3 causes.py --out DIR                    foams of 10 000 bubbles: half an hour on one core
    python3 causes.py --out DIR --full RUNS        compares them with the runs of run.py --full in RUNS, too

Each case changes one thing of the first one and is done with several seeds: its change is the mean over seeds of the
difference to the first case with the same seed, that is, the same start. All exponents of a gas fraction are taken in
the same range of tau. A run that is complete is not done again.
"""
import argparse
from dataclasses import replace
import json
from pathlib import Path
import subprocess
import sys

import numpy as np

from common import with_error
from lammps_foam.analysis import growth, runs, table
from run import Run

BUBBLES, END = 10000, 100
FROM, TO = 5.0, 40.0    # so many times fewer bubbles are left where the range of tau begins, and where it ends
CASES = {
    "as figure 4.1": {},
    "rkc 1e-4": {"tol": 1.0e-4},
    "abm 1e-5": {"integrator": "abm"},    # that of the thesis: largest error of all bubbles
    "kappa 0": {"kappa": 0.0},
}
WANTED = {    # of which as many as there are seeds, or the first few
    1.00: {"as figure 4.1": 4, "kappa 0": 4, "rkc 1e-4": 3, "abm 1e-5": 2},
    0.80: {"as figure 4.1": 4, "rkc 1e-4": 3, "abm 1e-5": 2},
    0.85: {"as figure 4.1": 4},
}


def do(directory, phi, seed, *, tol=None, integrator="rkc", kappa=0.1):
    """A run, unless it is complete."""
    if (directory / "run" / "complete").exists():
        return
    directory.mkdir(parents=True, exist_ok=True)
    run = replace(Run(directory.name, phi, BUBBLES, END, seed), kappa=kappa)
    (directory / "foam.json").write_text(json.dumps(run.input(), indent=2) + "\n")
    command = [sys.executable, "-c", "from lammps_foam.command import main; main()", "run", directory / "foam.json",
               "--out", directory / "run", "--integrator", integrator, *(["--tol", tol] if tol else [])]
    subprocess.run([str(word) for word in command], check=True, stdout=subprocess.DEVNULL)


def series_of(directories):
    return runs.read_runs([one / "run" for one in directories], ["R", "N"])


def row(phi, case, bubbles, series, first, limits):
    """Exponents of a case in a range of tau, and their change against the first case."""
    fit = growth.fit(series, *limits)
    n = fit.origin[0]
    change = np.array([slope(one, limits) - slope(other, limits) for one, other in zip(series, first)])
    paired = bubbles == BUBBLES and series is not first
    return {"phi": phi, "case": case, "bubbles": bubbles, "runs": len(series), "tau_from": limits[0],
            "tau_to": limits[1], "beta": fit.beta, "beta_error": fit.beta_error,
            "1/n": 1 / n, "1/n_error": fit.origin_error[0] / n**2,
            "change": change.mean() if paired else np.nan,
            "change_error": change.std(ddof=1) / np.sqrt(len(change)) if paired and len(change) > 1 else np.nan}


def slope(one, limits):
    ln_tau, ln_R = growth.resample(one["tau"], one["R"], *limits)
    return float(growth.slopes(ln_tau, ln_R[None])[0, 0])


def range_of_tau(series):
    return (max(runs.tau_of_N(one, one["N"][0] / FROM) for one in series),
            min(runs.tau_of_N(one, one["N"][0] / TO) for one in series))


def case_rows(phi, args):
    rows, first, limits = [], [], (0.0, 0.0)
    for case, seeds in WANTED[phi].items():
        directories = [args.out / f"phi{phi:.2f}-{case.replace(' ', '-')}-{seed}" for seed in args.seeds[:seeds]]
        for directory, seed in zip(directories, args.seeds):
            print(directory.name, flush=True)
            do(directory, phi, seed, **CASES[case])
        series = series_of(directories)
        if not first:
            first, limits = series, range_of_tau(series)
        rows.append(row(phi, case, BUBBLES, series, first, limits))
    large = sorted(args.full.glob(f"phi{phi:.2f}-*/run/complete")) if args.full else []
    if large:
        rows.append(row(phi, "larger", 100000, series_of([path.parent.parent for path in large]), first, limits))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", default="causes", type=Path, metavar="DIR", help="where runs and causes.csv go")
    parser.add_argument("--full", type=Path, metavar="RUNS", help="runs of run.py --full, to compare with")
    parser.add_argument("--seeds", nargs="+", type=int, default=[1, 2, 3, 4])
    args = parser.parse_args()
    rows = []
    for phi in WANTED:
        rows += case_rows(phi, args)
        write(rows, args.out)


def write(rows, out):
    """causes.csv with all digits, causes-table.csv as it is shown."""
    table.write({key: [one[key] for one in rows] for key in rows[0]}, out / "causes.csv")
    lines = [{":math:`\\varphi`": f"{one['phi']:.2f}", "case": one["case"], "bubbles": f"{one['bubbles']}",
              "runs": f"{one['runs']}", "range of :math:`\\tau`": f"{one['tau_from']:.0f} to {one['tau_to']:.0f}",
              "slope": with_error(one["beta"], one["beta_error"]),
              "change of the slope": "" if np.isnan(one["change"]) else with_error(one["change"], one["change_error"])}
             for one in rows]
    table.write({key: [one[key] for one in lines] for key in lines[0]}, out / "causes-table.csv")


if __name__ == "__main__":
    main()
