#!/usr/bin/env python3
"""What an exponent of figure 4.1 depends on: seed, size, tolerance, integrator, or a term of the model.

    python3 causes.py --out DIR                    foams of 10 000 bubbles: half an hour on one core
    python3 causes.py --out DIR --full RUNS        compares them with the runs of run.py --full in RUNS, too
    python3 causes.py --out DIR --full RUNS --figures FOLDER --no-pdf
    python3 causes.py --out DIR --no-runs          of the runs that are complete

Each case changes one thing of the first one and is done with several seeds: its change is the mean over seeds of the
difference to the first case with the same seed, that is, the same start. All exponents of a gas fraction are taken in
the same range of tau; the figure has them in half a decade. A run that is complete is not done again. Tables keep what
stands there of cases that are not here, and the figure is drawn of the tables.
"""
import argparse
from dataclasses import replace
import json
from pathlib import Path
import subprocess
import sys

import numpy as np

from common import LAST, Place, with_error
from lammps_foam.analysis import figure, growth, runs, table
from run import Run

BUBBLES, END = 10000, 100
FROM, TO = 5.0, 40.0    # so many times fewer bubbles are left where the range of tau begins, and where it ends
SHOWN_FROM = 5.0        # tau; before, the foam forgets its start
FEWER = 0.85            # gas fraction of run.py --figure fewer
CASES = {
    "as figure 4.1": {},
    "rkc 1e-4": {"tol": 1.0e-4},
    "abm 1e-5": {"integrator": "abm"},    # that of the thesis: largest error of all bubbles
    "kappa 0": {"kappa": 0.0},
    "K 1e-4": {"K": 1.0e-4, "tol": 3.0e-4},    # slower exchange wants a smaller tolerance
}
WANTED = {    # of which as many as there are seeds, or the first few
    0.85: {"as figure 4.1": 4},
    0.80: {"as figure 4.1": 4, "rkc 1e-4": 2},
    1.00: {"as figure 4.1": 4, "kappa 0": 4, "rkc 1e-4": 3, "abm 1e-5": 2, "K 1e-4": 3},
}


def do(directory, phi, seed, *, tol=None, integrator="rkc", kappa=0.1, K=1.0e-3):
    """A run, unless it is complete."""
    if (directory / "run" / "complete").exists():
        return
    directory.mkdir(parents=True, exist_ok=True)
    data = replace(Run(directory.name, phi, BUBBLES, END, seed), kappa=kappa).input()
    data["constants"]["K"]["value"] = K
    (directory / "foam.json").write_text(json.dumps(data, indent=2) + "\n")
    command = [sys.executable, "-c", "from lammps_foam.command import main; main()", "run", directory / "foam.json",
               "--out", directory / "run", "--integrator", integrator, *(["--tol", tol] if tol else [])]
    subprocess.run([str(word) for word in command], check=True, stdout=subprocess.DEVNULL)


def series_of(directories):
    return runs.read_runs([one / "run" for one in directories], ["R", "N"])


def row(phi, case, bubbles, series, first, limits):
    """Exponents of a case in a range of tau, and their change against the first case."""
    fit = growth.fit(series, *limits)
    n = fit.origin[0]
    paired = bubbles == BUBBLES and series is not first
    change, error = change_of(series, first, limits) if paired else (np.nan, np.nan)
    return {"phi": phi, "case": case, "bubbles": bubbles, "runs": len(series), "tau_from": limits[0],
            "tau_to": limits[1], "beta": fit.beta, "beta_error": fit.beta_error,
            "1/n": 1 / n, "1/n_error": fit.origin_error[0] / n**2,
            "change": change, "change_error": error}


def change_of(series, first, limits):
    """Mean difference of slopes from runs with the same start, and its error.

    Runs with the same start part after a while. The scatter of few differences may be small by chance, so the error is
    at least that of runs that have nothing in common, by the scatter of the first case.
    """
    alone = np.array([slope(other, limits) for other in first])
    count = len(series)
    changes = np.array([slope(one, limits) for one in series]) - alone[:count]
    return changes.mean(), max(alone.std(ddof=1) * np.sqrt(2 / count),
                               changes.std(ddof=1) / np.sqrt(count) if count > 1 else 0.0)


def slope(one, limits):
    ln_tau, ln_R = growth.resample(one["tau"], one["R"], *limits)
    return float(growth.slopes(ln_tau, ln_R[None])[0, 0])


def range_of_tau(series):
    return (max(runs.tau_of_N(one, one["N"][0] / FROM) for one in series),
            min(runs.tau_of_N(one, one["N"][0] / TO) for one in series))


def cases_of(phi, args):
    """{(case, bubbles): series of its runs}, the runs of run.py --full included. Does what is missing."""
    found = {}
    for case, seeds in WANTED[phi].items():
        directories = [args.out / f"phi{phi:.2f}-{case.replace(' ', '-')}-{seed}" for seed in args.seeds[:seeds]]
        for directory, seed in zip(directories, args.seeds if not args.no_runs else []):
            print(directory.name, flush=True)
            do(directory, phi, seed, **CASES[case])
        complete = [directory for directory in directories if (directory / "run" / "complete").exists()]
        if complete:
            found[case, BUBBLES] = series_of(complete)
    for pattern, bubbles in ((f"phi{phi:.2f}-*", 100000), (f"large{phi:.2f}?-????", 1000000)):
        large = sorted(args.full.glob(f"{pattern}/run/complete")) if args.full else []
        if not large and bubbles == 100000 and phi == FEWER and args.full:    # the same foam, with snapshots
            large = sorted(args.full.glob("fewer100000-*/run/complete"))
        large = [path.parent.parent for path in large]
        if large:    # of several gas fractions of 10^6 bubbles the nearest
            case = "larger" if bubbles < 1e6 else f"larger {large[0].name[5:10]}"
            found[case, bubbles] = series_of(large if bubbles < 1e6 else large[:1])
    return found


def rows_of(phi, found):
    first = next(iter(found.values()))
    limits = range_of_tau(first)
    return [row(phi, case, bubbles, series, first, limits) for (case, bubbles), series in found.items()]


def curves_of(phi, found):
    """Exponents in half a decade of tau, of each case."""
    rows = []
    for (case, bubbles), series in found.items():
        end = min(runs.tau_of_N(one, LAST * one["N"][-1]) for one in series)
        local = growth.local_exponents(series, growth.windows_of(series, 0.5, SHOWN_FROM, end, False))
        rows += [{"phi": phi, "case": case, "bubbles": bubbles, "tau": tau, "beta": beta, "error": error}
                 for tau, beta, error in zip(local["tau"], local["beta"], local["error"])]
    return rows


def key_of(row):
    return f"{float(row['phi']):.2f}", row["case"], int(float(row["bubbles"]))


def merge(place, rows, name):
    """As place.write(), with the rows of other cases that stand in the table that is there."""
    here, order = {key_of(row) for row in rows}, list(CASES)
    kept = [row for row in place.read(name) if key_of(row) not in here and list(row) == list(rows[0])]

    def place_of(row):
        phi, case, bubbles = key_of(row)
        return phi, bubbles, order.index(case) if case in order else len(order), case

    merged = sorted([*kept, *rows], key=place_of)    # stable
    place.write(merged, name)
    return merged


def write(place, rows):
    """causes.csv with all digits, causes-table.csv as it is shown."""
    numbers = [{key: value if key == "case" else float(value or "nan") for key, value in row.items()}
               for row in merge(place, rows, "causes")]
    place.write([{":math:`\\varphi`": f"{one['phi']:.2f}", "case": one["case"], "bubbles": f"{one['bubbles']:.0f}",
                  "runs": f"{one['runs']:.0f}",
                  "range of :math:`\\tau`": f"{one['tau_from']:.0f} to {one['tau_to']:.0f}",
                  "slope": with_error(one["beta"], one["beta_error"]),
                  "change of the slope": "" if np.isnan(one["change"]) else
                  with_error(one["change"], one["change_error"])} for one in numbers], "causes-table")


def draw(place, curves):
    """Exponents in half a decade of tau, a panel for each gas fraction."""
    phis = sorted({float(row["phi"]) for row in curves})
    fig, axes = figure.panels(1, len(phis), width=2.7, height=2.5)
    for ax, phi in zip(axes, phis):
        mine = [row for row in curves if float(row["phi"]) == phi]
        for number, key in enumerate(dict.fromkeys(map(key_of, mine))):
            tau, beta, error = np.array([[float(row[name]) for name in ("tau", "beta", "error")]
                                         for row in mine if key_of(row) == key]).T
            ax.errorbar(tau, beta, error, fmt="os^Dv<"[number % 6] + "-", lw=0.8, ms=2.5, color=f"C{number % 7}",
                        label=f"{key[1]}, {key[2]} bubbles")
        for value in (1 / 3, 1 / 2):
            ax.axhline(value, color="0.7", lw=0.8, zorder=0)
        ax.set(xscale="log", xlabel=figure.TAU, title=rf"$\varphi$ = {phi:.2f}", ylim=(0.1, 0.55))
        figure.plain_ticks(ax, "x")
        ax.legend(fontsize=5.5, loc="lower right")
    axes[0].set(ylabel="exponent in half a decade")
    place.save(fig, "thesis-causes", dpi=160)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", default="causes", type=Path, metavar="DIR", help="where the runs go")
    parser.add_argument("--full", type=Path, metavar="RUNS", help="runs of run.py --full, to compare with")
    parser.add_argument("--figures", type=Path, metavar="FOLDER", help="where figure and tables go (default: --out)")
    parser.add_argument("--no-runs", action="store_true", help="figure and tables of the runs that are complete")
    parser.add_argument("--no-pdf", action="store_true", help="PNG alone")
    parser.add_argument("--seeds", nargs="+", type=int, default=[1, 2, 3, 4])
    args = parser.parse_args()
    place = Place(args.out, args.figures or args.out, not args.no_pdf)
    place.out.mkdir(parents=True, exist_ok=True)
    everything = {phi: cases_of(phi, args) for phi in WANTED}
    everything = {phi: found for phi, found in sorted(everything.items()) if ("as figure 4.1", BUBBLES) in found}
    if not everything:
        sys.exit(f"{args.out} has no complete run of causes.py as figure 4.1")
    rows = [one for phi, found in everything.items() for one in rows_of(phi, found)]
    table.show({key: np.array([one[key] for one in rows]) for key in rows[0]})
    write(place, rows)
    draw(place, merge(place, [one for phi, found in everything.items() for one in curves_of(phi, found)],
                      "causes-curves"))


if __name__ == "__main__":
    main()
