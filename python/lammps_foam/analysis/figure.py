"""One style for all figures, fit for a column of a paper, and how they are saved."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Any

from cycler import cycler
import matplotlib

matplotlib.use("Agg")    # files only: no screen needed
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogFormatterSciNotation

from .files import whole

logging.getLogger("fontTools").setLevel(logging.ERROR)    # it warns of dates of fonts

WIDTH, HEIGHT = 3.4, 2.6    # inches: one column
STYLE: Any = {
    "font.size": 8, "axes.labelsize": 9, "axes.titlesize": 8, "legend.fontsize": 7,
    "xtick.labelsize": 8, "ytick.labelsize": 8, "mathtext.fontset": "cm", "font.family": "DejaVu Sans",
    "axes.linewidth": 0.7, "lines.linewidth": 1.2, "lines.markersize": 3.0, "patch.linewidth": 0.7,
    "xtick.direction": "in", "ytick.direction": "in", "xtick.top": True, "ytick.right": True,
    "xtick.minor.visible": True, "ytick.minor.visible": True,
    "legend.frameon": False, "legend.handlelength": 1.6, "errorbar.capsize": 1.5,
    "savefig.dpi": 300, "figure.constrained_layout.use": True, "pdf.fonttype": 42,
    # colours that colour-blind readers can tell: Okabe and Ito (2008)
    "axes.prop_cycle": cycler(color=["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"]),
}
TAU = r"$\tau = K t\,/\,\langle R_\mathrm{in}\rangle^2$"
R = r"$\langle R\rangle\,/\,\langle R_\mathrm{in}\rangle$"


def panels(rows: int = 1, columns: int = 1, *, width: float = WIDTH, height: float = HEIGHT,
           sharex: bool = False) -> tuple[Figure, list[Axes]]:
    """A figure in our style, with rows x columns panels of this size (inches), as a list, row by row."""
    plt.rcParams.update(STYLE)
    fig, axes = plt.subplots(rows, columns, figsize=(width * columns, height * rows), squeeze=False, sharex=sharex)
    return fig, list(axes.flat)


def plain_ticks(ax: Axes, which: str = "both") -> None:
    """Numbers as 2, 30 in the place of powers of ten, on logarithmic axes of few decades."""
    for name, axis in (("x", ax.xaxis), ("y", ax.yaxis)):
        if which in (name, "both"):
            axis.set_major_formatter(_Plain())
            axis.set_minor_formatter(_Plain(minor_thresholds=(1.5, 0.7)))


class _Plain(LogFormatterSciNotation):
    """LogFormatterSciNotation chooses which ticks get a label; the label is the bare number."""

    def __call__(self, x: float, pos: Any = None) -> str:
        return f"{x:g}" if super().__call__(x, pos) else ""


def save(fig: Figure, base: str | Path) -> list[Path]:
    """Write base.pdf and base.png, each whole or not at all, close the figure; their paths."""
    base = Path(base)
    written = [base.with_name(f"{base.name}.{kind}") for kind in ("pdf", "png")]
    for path in written:
        with whole(path) as part:
            fig.savefig(part)
    plt.close(fig)
    return written
