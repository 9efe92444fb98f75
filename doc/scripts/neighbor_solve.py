#!/usr/bin/env python3
"""Drag by the mean velocity of the neighbors, with the lag and solved: error and cost as a foam relaxes after a shear.

    python3 doc/scripts/neighbor_solve.py --lmp "./foam lmp" [--bubbles N] [--out neighbor-solve.png]

Prints a table and draws the energy against time. The reference is the solution with a small tolerance.
"""

import argparse
from pathlib import Path
import resource
import shlex
import subprocess
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

REFERENCE = ("neighbor solve", "abm 1e-5 norm rms")
WAYS = [
    (drag, f"{style} {tol} norm rms")
    for style in ("abm", "rkc")
    for drag in ("neighbor solve", "neighbor")
    for tol in ("1e-3", "1e-4")
]
END = 5.0


def relax(lmp, folder, bubbles, drag, style, end=END):
    """Times, evaluations, energies, and seconds of processor time."""
    file = Path(folder) / "relax.csv"
    file.unlink(missing_ok=True)
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run(
        [
            *shlex.split(lmp),
            "-in",
            str(Path(__file__).resolve().with_name("in.neighbor_solve")),
            "-log",
            "none",
            "-screen",
            "none",
            "-var",
            "N",
            str(bubbles),
            "-var",
            "drag",
            drag,
            "-var",
            "style",
            style,
            "-var",
            "end",
            str(end),
            "-var",
            "file",
            str(file),
        ],
        check=True,
    )
    return (
        *np.loadtxt(file, delimiter=",", skiprows=1).T,
        resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before,
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lmp", default="lmp")
    parser.add_argument("--bubbles", type=int, default=1000)
    parser.add_argument("--out", type=Path, default=Path("neighbor-solve.png"))
    args = parser.parse_args()
    plt.rcParams.update(
        {
            "font.size": 11,
            "axes.spines.top": False,
            "axes.spines.right": False,
            "legend.frameon": False,
            "mathtext.fontset": "cm",
            "savefig.dpi": 120,
        }
    )
    fig, axes = plt.subplots(1, 2, figsize=(10, 4), layout="constrained", sharey=True)
    with tempfile.TemporaryDirectory() as folder:
        before = relax(args.lmp, folder, args.bubbles, "static", "abm 1e-3", 0.0)[-1]    # the foam is made
        t0, _, exact, _ = relax(args.lmp, folder, args.bubbles, *REFERENCE)
        grid = np.linspace(0.05, END, 100)
        reference = np.interp(grid, t0, exact)
        lost = exact[0] - reference[-1]
        print(
            f"{args.bubbles} bubbles; error of the energy, largest over the time to {END}, in parts of what is lost "
            f"({lost:.4g})"
        )
        for drag, style in WAYS:
            t, evaluations, energy, seconds = relax(args.lmp, folder, args.bubbles, drag, style)
            error = np.abs(np.interp(grid, t, energy) - reference).max() / lost
            n = np.interp(END, t, evaluations)
            print(
                f"{drag:15s} foam/{style:20s} error {error:.1e}  evaluations {n:6.0f}  "
                f"processor time {seconds - before:.2f} s",
                flush=True,
            )
            ax = axes[int(drag == "neighbor")]
            ax.plot(
                t, energy, lw=1, ls="--" if "rkc" in style else "-", label="foam/" + style.replace(" norm rms", "")
            )
    for ax, title in zip(axes, ("drag neighbor solve", "drag neighbor (with the lag)")):
        ax.plot(t0, exact, color="black", lw=2.5, alpha=0.4, label="solve, foam/abm 1e-5")
        ax.set(title=title, xlabel=r"time  $t\,\sigma_0/\mu_0$", xlim=(0, END))
        ax.legend(fontsize=8)
    axes[0].set_ylabel(r"energy  ($\sigma_0 \langle R_\mathrm{in}\rangle^2$)")
    fig.savefig(args.out)
    print("picture:", args.out)


if __name__ == "__main__":
    main()
