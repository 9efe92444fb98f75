#!/usr/bin/env python3
"""Draws how a foam drifts under neighbour drag, and what `drift remove` does about it.

    python3 doc/scripts/drift.py --lmp "./foam lmp" --out doc/figures/drift.png
"""
import argparse
from pathlib import Path
import shlex
import subprocess
import tempfile

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

RUNS = (("keep", "1e-3", 5), ("keep", "1e-4", 20), ("keep", "1e-5", 50),
        ("remove", "1e-3", 5), ("remove", "1e-4", 20), ("remove", "1e-5", 50))
COLOURS = {"1e-3": "#1f5a96", "1e-4": "#c8702a", "1e-5": "#8c1c4c"}
STYLE = {
    "font.size": 12, "axes.labelsize": 14, "axes.titlesize": 13, "axes.spines.top": False,
    "axes.spines.right": False, "legend.frameon": False, "mathtext.fontset": "cm",
    "savefig.dpi": 160, "lines.linewidth": 1.8,
}


def measure(lmp, drift, tol, every, folder):
    """Run in.drift; columns of its table by name."""
    script = Path(__file__).resolve().with_name("in.drift")
    table = Path(folder) / f"{drift}-{tol}.csv"
    subprocess.run([*shlex.split(lmp), "-in", str(script), "-log", "none", "-screen", "none",
                    "-var", "file", str(table), "-var", "drift", drift, "-var", "tol", tol,
                    "-var", "every", str(every)], check=True)
    return np.genfromtxt(table, delimiter=",", names=True)


def draw(tables, path):
    with plt.rc_context(STYLE):
        fig, (left, right) = plt.subplots(1, 2, figsize=(11.5, 4.6), layout="constrained")
        for (drift, tol), t in tables.items():
            look = {"color": COLOURS[tol], "ls": "-" if drift == "keep" else (0, (4, 1.5))}
            # without its mean the velocity would be lost in rounding: show what bubbles do then
            speed = np.hypot(t["vx"], t["vy"]) if drift == "keep" else t["vrms"]
            left.semilogy(t["tau"][1:], speed[1:], **look)
            right.semilogy(t["tau"][1:], np.hypot(t["dx"], t["dy"])[1:], **look)
            print(f"drift {drift:6s} tol {tol}: to tau {t['tau'][-1]:.3f} in "
                  f"{t['evaluations'][-1]:.0f} evaluations; mean velocity "
                  f"{np.hypot(t['vx'], t['vy'])[-1]:.2e}, rms {t['vrms'][-1]:.2e}, "
                  f"mean displacement {np.hypot(t['dx'], t['dy'])[-1]:.2e}")
        left.set_title("velocity: mean (keep), root mean square (remove)")
        left.set_ylabel(r"velocity  $[\sigma_0\langle R_\mathrm{in}\rangle/\mu_0]$")
        right.set_title("mean displacement")
        right.set_ylabel(r"displacement  $[\langle R_\mathrm{in}\rangle]$")
        for ax in (left, right):
            ax.set_xlabel(r"$\tau = K t\,/\,\langle R_\mathrm{in}\rangle^2$")
            ax.set_xlim(left=0)
        right.set_ylim(bottom=1e-6)
        for tol, colour in COLOURS.items():
            right.plot([], [], color=colour, label=f"tolerance {tol}")
        right.plot([], [], color="0.3", label="drift keep")
        right.plot([], [], color="0.3", ls=(0, (4, 1.5)), label="drift remove")
        fig.legend(*right.get_legend_handles_labels(), loc="outside lower center", ncols=5)
        fig.savefig(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lmp", default="lmp", metavar="COMMAND",
                        help='how to start LAMMPS (default "%(default)s")')
    parser.add_argument("--out", default="drift.png", metavar="FILE",
                        help='the picture (default "%(default)s")')
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        tables = {(drift, tol): measure(args.lmp, drift, tol, every, folder)
                  for drift, tol, every in RUNS}
    draw(tables, args.out)


if __name__ == "__main__":
    main()
