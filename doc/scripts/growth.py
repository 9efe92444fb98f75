#!/usr/bin/env python3
"""Growth of a 2D foam to tau = 40: what a tolerance changes, and what the start does.

    python3 doc/scripts/growth.py --lmp "./foam lmp" --out doc/figures/growth-tolerance.png

Runs in.growth with each tolerance from each of some starts (seeds), which takes half an hour of one core.
Tables of the runs are kept in DIR (--dir), so that a second call draws only, or adds seeds.
"""
import argparse
from pathlib import Path
import shlex
import subprocess

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

RUNS = (("rkc", "1e-2"), ("rkc", "1e-3"), ("rkc", "1e-4"), ("abm", "1e-5"))
REFERENCE = RUNS[-1]
TAUS = (1.0, 3.0, 7.0, 10.0, 20.0, 40.0)
WINDOW = (10.0, 40.0)        # of the exponent
COLOURS = dict(zip(RUNS, ("#7f8c2a", "#1f5a96", "#c8702a", "#8c1c4c")))
STYLE = {
    "font.size": 12, "axes.labelsize": 14, "axes.titlesize": 13, "axes.spines.top": False,
    "axes.spines.right": False, "legend.frameon": False, "mathtext.fontset": "cm",
    "savefig.dpi": 160, "lines.linewidth": 1.8,
}


def measure(lmp, folder, seed, run, more):
    """Run in.growth unless its table is there; columns of the table by name."""
    script = Path(__file__).resolve().with_name("in.growth")
    table = folder / f"{run[0]}-{run[1]}-{seed}.csv"
    if not table.exists():
        part = table.with_suffix(".part")
        subprocess.run([*shlex.split(lmp), "-in", str(script), "-log", "none", "-screen", "none",
                        "-var", "start", str(folder / f"start-{seed}.data"), "-var", "file", str(part),
                        "-var", "fix", run[0], "-var", "tol", run[1], "-var", "seed", str(seed),
                        *more], check=True)
        part.rename(table)
    return np.genfromtxt(table, delimiter=",", names=True)


def read_off(t):
    """N, <R> and relative width of R at TAUS; the exponent in WINDOW; evaluations at the end."""
    width = np.sqrt(np.maximum(t["R2"] / t["R"]**2 - 1, 0))
    at = {name: np.interp(TAUS, t["tau"], y)
          for name, y in (("N", t["N"]), ("R", t["R"]), ("width", width))}
    # lines in equal distances of ln tau, so that the exponent does not weigh the steps
    x = np.linspace(*np.log(WINDOW), 50)
    at["exponent"] = np.polyfit(x, np.interp(x, np.log(t["tau"][1:]), np.log(t["R"][1:])), 1)[0]
    at["evaluations"] = t["evaluations"][-1]
    return at


def report(results, seeds):
    """What the tables of the manual say: means, spread of seeds, deviations from REFERENCE."""
    last = len(TAUS) - 1
    for run in RUNS:
        print(f"{run[0]} {run[1]}: {np.mean([results[s, run]['evaluations'] for s in seeds]):.0f} "
              "evaluations")
        for i, tau in enumerate(TAUS):
            line = f"  tau {tau:4.0f}"
            for name in ("N", "R", "width"):
                y = np.array([results[s, run][name][i] for s in seeds])
                off = y / [results[s, REFERENCE][name][i] for s in seeds] - 1
                line += (f"   {name} {y.mean():.5g}, seeds {100 * y.std(ddof=1) / y.mean():.2f} %, "
                         f"off {100 * off.mean():+.3f} +- {100 * off.std(ddof=1):.3f} %")
            print(line)
        y = np.array([results[s, run]["exponent"] for s in seeds])
        off = y - [results[s, REFERENCE]["exponent"] for s in seeds]
        print(f"  exponent {y.mean():.4f}, seeds {y.std(ddof=1):.4f}, "
              f"off {off.mean():+.4f} +- {off.std(ddof=1):.4f}, tau {WINDOW[0]:g} to {TAUS[last]:g}")


def draw(tables, seeds, path):
    """Left: <R> against tau. Right: its distance from the mean of REFERENCE, each seed a line."""
    grid = np.geomspace(0.5, TAUS[-1], 200)
    curve = {key: np.interp(grid, t["tau"], t["R"]) for key, t in tables.items()}
    middle = np.mean([curve[s, REFERENCE] for s in seeds], axis=0)
    with plt.rc_context(STYLE):
        fig, (left, right) = plt.subplots(1, 2, figsize=(11.5, 4.6), layout="constrained")
        for run in RUNS:
            label = f"foam/{run[0]} {run[1]}"
            left.loglog(grid, np.mean([curve[s, run] for s in seeds], axis=0), color=COLOURS[run],
                        label=label)
            off = 100 * (np.mean([curve[s, run] for s in seeds], axis=0) / middle - 1)
            right.semilogx(grid, off, color=COLOURS[run])
        spread = 100 * np.std([curve[s, REFERENCE] for s in seeds], axis=0, ddof=1) / middle
        right.fill_between(grid, -spread, spread, color="0.88", lw=0, label="one run: spread of seeds")
        mean = spread / np.sqrt(len(seeds))
        right.fill_between(grid, -mean, mean, color="0.75", lw=0, label=f"mean of {len(seeds)} runs")
        left.set_ylabel(r"mean radius  $\langle R\rangle\,/\,\langle R_\mathrm{in}\rangle$")
        right.set_ylabel(f"mean radius, off foam/{REFERENCE[0]} {REFERENCE[1]}  [%]")
        left.set_yticks([1, 1.5, 2, 3, 4], ["1", "1.5", "2", "3", "4"])
        left.minorticks_off()
        for ax in (left, right):
            ax.set_xlabel(r"$\tau = K t\,/\,\langle R_\mathrm{in}\rangle^2$")
            ax.set_xlim(grid[0], grid[-1])
            ax.set_xticks([1, 3, 10, 40], ["1", "3", "10", "40"])
            ax.legend()
        fig.savefig(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lmp", default="lmp", metavar="COMMAND",
                        help='how to start LAMMPS (default "%(default)s")')
    parser.add_argument("--out", default="growth-tolerance.png", metavar="FILE",
                        help='the picture (default "%(default)s")')
    parser.add_argument("--dir", default="foam-growth", metavar="DIR", type=Path,
                        help='where the tables of the runs are kept (default "%(default)s")')
    parser.add_argument("--seeds", default=5, type=int, metavar="N",
                        help="starts to take (default %(default)s)")
    parser.add_argument("--var", nargs=2, action="append", default=[], metavar=("NAME", "VALUE"),
                        help="a variable of in.growth, such as N 1000")
    args = parser.parse_args()
    args.dir.mkdir(parents=True, exist_ok=True)
    seeds = [1995 + i for i in range(args.seeds)]
    more = [word for pair in args.var for word in ("-var", *pair)]
    tables = {(seed, run): measure(args.lmp, args.dir, seed, run, more)
              for seed in seeds for run in RUNS}
    results = {key: read_off(t) for key, t in tables.items()}
    report(results, seeds)
    draw(tables, seeds, args.out)


if __name__ == "__main__":
    main()
