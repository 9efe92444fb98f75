#!/usr/bin/env python3
"""A foam that coarsens at a constant pressure and one in a box of constant size: pressure, gas fraction, mean radius.

python3 doc/scripts/pressure.py --lmp "./foam lmp" [--bubbles N] [--out pressure.png]
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

TARGET = 0.02
WAYS = {
    "constant pressure": ("press", "1e-3"),
    "the same, tolerance 1e-4": ("press", "1e-4"),
    "constant size of the box": ("volume", "1e-3"),
}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lmp", default="lmp")
    parser.add_argument("--bubbles", type=int, default=1000)
    parser.add_argument("--out", type=Path, default=Path("pressure.png"))
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
    fig, axes = plt.subplots(1, 3, figsize=(12, 3.8), layout="constrained")
    for (label, (how, tol)), style in zip(WAYS.items(), ("-", ":", "--")):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "pressure.csv"
            subprocess.run(
                [
                    *shlex.split(args.lmp),
                    "-in",
                    str(Path(__file__).resolve().with_name("in.pressure")),
                    "-log",
                    "none",
                    "-screen",
                    "none",
                    "-var",
                    "N",
                    str(args.bubbles),
                    "-var",
                    "how",
                    how,
                    "-var",
                    "tol",
                    tol,
                    "-var",
                    "target",
                    str(TARGET),
                    "-var",
                    "end",
                    str(args.bubbles // 10),
                    "-var",
                    "file",
                    str(file),
                ],
                check=True,
            )
            tau, bubbles, radius, phi, pressure, evaluations = np.loadtxt(file, delimiter=",", skiprows=1).T
        late = tau > 0.1
        print(
            f"{label}: {bubbles[-1]:.0f} bubbles at tau = {tau[-1]:.3g} after {evaluations[-1]:.0f} evaluations, gas "
            f"fraction {phi[0]:.4f} to {phi[-1]:.4f}, pressure {pressure[0]:.4g} to {pressure[-1]:.4g}, "
            f"from {pressure[late].min():.4g} to {pressure[late].max():.4g} after tau = 0.1",
            flush=True,
        )
        for ax, y in zip(axes, (pressure, phi, radius)):
            ax.plot(tau, y, style, label=label)
    for ax, name in zip(
        axes, (r"pressure  ($\sigma_0$)", r"gas fraction  $\phi$", r"mean radius  $\langle R\rangle$")
    ):
        ax.set(xlabel=r"$\tau$", ylabel=name)
    axes[0].set_ylim(bottom=0.0)
    axes[2].set(xscale="log", yscale="log", xlim=(0.05, None))
    axes[1].legend(fontsize=8)
    fig.savefig(args.out)
    print("picture:", args.out)


if __name__ == "__main__":
    main()
