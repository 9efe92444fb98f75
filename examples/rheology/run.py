#!/usr/bin/env python3
"""Flow curves of 2D foams: runs in.rheology over gas fractions and rates, and draws what it wrote.

    python3 run.py [--lmp LMP] [--out DIR] [--bubbles N] [--full] [--plot-only]

Draws DIR/rheology.png: shear stress against rate for gas fractions around jamming, with drag by the liquid alone
(static, model RD) and with drag between bubbles in contact, too (contact 1.0, model CD). Tables of the means are in
DIR/rheology.csv. Minutes on two cores with 400 bubbles; --full has 10^4, more gas fractions and longer strains: hours.
"""
import argparse
import concurrent.futures
import csv
import os
from pathlib import Path
import shlex
import subprocess
import sys
import time

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

HERE = Path(__file__).resolve().parent
DRAGS = {"static": "drag of the liquid (RD)", "contact 1.0": "and between bubbles (CD)"}


def choices(full):
    if full:
        return dict(phis=[0.80, 0.82, 0.83, 0.84, 0.845, 0.85, 0.86, 0.88, 0.92, 1.0],
                    rates=[0.1, 0.03, 0.01, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5], strain=10.0)
    return dict(phis=[0.80, 0.83, 0.84, 0.85, 0.87, 0.90, 0.95], rates=[0.1, 0.01, 1e-3, 1e-4, 1e-5], strain=4.0)


def name_of(phi, drag):
    return f"curve-{phi:.3f}-{drag.split()[0]}.csv"


def run(lmp, out, bubbles, phi, drag, rates, strain):
    """One flow curve, unless its file is there already."""
    path = out / name_of(phi, drag)
    if path.exists():
        return
    part = path.with_suffix(".part")
    command = shlex.split(lmp) + ["-in", str(HERE / "in.rheology"), "-log", "none", "-screen", "none",
                                  "-var", "N", str(bubbles), "-var", "phi", str(phi), "-var", "drag", drag,
                                  "-var", "rates", " ".join(map(str, rates)), "-var", "strain", str(strain),
                                  "-var", "file", str(part)]
    done = subprocess.run(command, cwd=out, env=dict(os.environ, OMP_NUM_THREADS="1"), check=False)
    if done.returncode:
        sys.exit(f"LAMMPS failed: {shlex.join(command)}")
    part.rename(path)


def means(path):
    """For each rate: the stress and its error, pressure, over the second half of the strain."""
    with open(path, newline="") as f:
        rows = np.array([row for row in csv.reader(f) if row][1:], float)
    table = []
    for rate in sorted(set(rows[:, 0])):
        _, strain, stress, pressure = rows[rows[:, 0] == rate].T
        grid = np.linspace(0.5 * strain[-1], strain[-1], 400)    # by strain, since steps vary
        s = np.interp(grid, strain, stress)
        blocks = s.reshape(8, -1).mean(1)
        table.append((rate, s.mean(), blocks.std(ddof=1) / np.sqrt(8), np.interp(grid, strain, pressure).mean()))
    return np.array(table)


def draw(out, phis):
    plt.rcParams.update({"font.size": 12, "axes.spines.top": False, "axes.spines.right": False,
                         "legend.frameon": False, "mathtext.fontset": "cm", "savefig.dpi": 150})
    fig, axes = plt.subplots(1, 2, figsize=(11, 4.8), layout="constrained")
    colours = plt.cm.viridis(np.linspace(0.0, 0.9, len(phis)))
    with open(out / "rheology.csv", "w", newline="") as f:
        table = csv.writer(f)
        table.writerow(["drag", "phi", "rate", "stress", "error", "pressure"])
        for ax, (drag, label) in zip(axes, DRAGS.items()):
            for phi, colour in zip(phis, colours):
                path = out / name_of(phi, drag)
                if not path.exists():
                    continue
                m = means(path)
                table.writerows([drag, phi, *row] for row in m)
                ax.errorbar(m[:, 0], m[:, 1], m[:, 2], color=colour, marker="o", ms=4, lw=1.2, label=f"{phi:.2f}")
            ax.set(xscale="log", yscale="log", xlabel=r"shear rate  $\dot\gamma \mu_0 / \sigma_0$",
                   ylabel=r"shear stress  $\Sigma$  ($\sigma_0$)", title=label)
            ax.legend(title=r"$\phi$", fontsize=9)
    fig.savefig(out / "rheology.png")
    print("picture:", out / "rheology.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lmp", default="lmp", help="command that starts LAMMPS with the styles (%(default)s)")
    parser.add_argument("--out", type=Path, default=Path("foam-rheology"), help="directory for results (%(default)s)")
    parser.add_argument("--bubbles", type=int, help="number of bubbles (400; with --full 10000)")
    parser.add_argument("--full", action="store_true")
    parser.add_argument("--plot-only", action="store_true", help="draw from the files that are there")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="runs side by side (%(default)s)")
    args = parser.parse_args()
    bubbles = args.bubbles or (10000 if args.full else 400)
    args.out.mkdir(parents=True, exist_ok=True)
    out = args.out.resolve()
    what = choices(args.full)
    if not args.plot_only:
        jobs = [(phi, drag) for phi in what["phis"] for drag in DRAGS]
        start = time.monotonic()
        with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
            running = [pool.submit(run, args.lmp, out, bubbles, phi, drag, what["rates"], what["strain"])
                       for phi, drag in jobs]
            for n, one in enumerate(concurrent.futures.as_completed(running), 1):
                one.result()
                spent = time.monotonic() - start
                to_go = spent / n * (len(jobs) - n)
                print(f"{n} of {len(jobs)} curves, {spent:.0f} s, to go {to_go:.0f} s", flush=True)
    draw(out, what["phis"])


if __name__ == "__main__":
    main()
