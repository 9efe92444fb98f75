#!/usr/bin/env python3
"""Pictures of a coarsening run: growth.png and foam.png, from what in.coarsen wrote.

    python3 plot.py DIR          DIR holds series.csv, foam.lammpstrj and last.lammpstrj
"""
import argparse
import csv
from pathlib import Path

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import EllipseCollection
from matplotlib.colors import LogNorm
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator
import numpy as np

STYLE = {
    "font.size": 13, "axes.labelsize": 15, "axes.titlesize": 14, "axes.linewidth": 0.9,
    "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False,
    "mathtext.fontset": "cm", "savefig.dpi": 200, "lines.linewidth": 2.0,
}
TAU = r"$\tau = K t\,/\,\langle R_\mathrm{in}\rangle^2$"
BLUE, GREY = "#1f5a96", "0.45"


# ------------------------------------------------------------------ reading

def read_series(path):
    """Columns of series.csv by name."""
    with open(path, newline="") as f:
        rows = list(csv.reader(f))
    table = np.array(rows[1:], dtype=float)
    return {name: table[:, i] for i, name in enumerate(rows[0])}


class Frame:
    """One snapshot: time step, box corners lo and hi, and columns such as x, radius by name."""

    def __init__(self, step, box, columns):
        self.step, self.columns = step, columns
        self.lo, self.hi = box[:, 0], box[:, 1]

    def __getitem__(self, name):
        return self.columns[name]

    def __len__(self):
        return len(self.columns["id"])


def read_dump(path):
    """Frames of a `dump custom` text file, one after the other."""
    with open(path) as f:
        while line := f.readline():
            if line.startswith("ITEM: TIMESTEP"):
                step = int(f.readline())
            elif line.startswith("ITEM: NUMBER OF ATOMS"):
                natoms = int(f.readline())
            elif line.startswith("ITEM: BOX BOUNDS"):
                box = np.array([f.readline().split()[:2] for _ in range(3)], dtype=float)
            elif line.startswith("ITEM: ATOMS"):
                names = line.split()[2:]
                rows = np.loadtxt(f, max_rows=natoms, ndmin=2)
                yield Frame(step, box, dict(zip(names, rows.T)))


def three_frames(directory):
    """First, middle and last snapshot; in the middle ln N is half-way between the others."""
    first = middle = None
    last = list(read_dump(Path(directory) / "last.lammpstrj"))[-1]
    for frame in read_dump(Path(directory) / "foam.lammpstrj"):
        first = first or frame
        target = 0.5 * (np.log(len(first)) + np.log(len(last)))
        off = abs(np.log(len(frame)) - target)
        if middle is None or off < best:
            middle, best = frame, off
    return first, middle, last


# ------------------------------------------------------------------ growth

def exponent(series, decades=0.3):
    """d ln <R> / d ln tau over the last `decades` of tau."""
    tau, size = series["tau"], series["R"]
    late = tau > tau[-1] / 10**decades
    if late.sum() < 3:
        return float("nan")
    return np.polyfit(np.log(tau[late]), np.log(size[late]), 1)[0]


def slope_guides(ax, x, y, offset, slopes):
    """Straight lines beside the end of the curve, from offset * y at a quarter of the last x."""
    ends = np.array([x[-1] / 4, x[-1]])
    start = offset * np.interp(ends[0], x, y)
    lines = []
    for (label, slope), dash in zip(slopes.items(), ("-", (0, (4, 2)))):
        line = start * (ends / ends[0])**slope
        ax.plot(ends, line, color=GREY, lw=1.2, ls=dash)
        ax.annotate(label, (ends[1], line[1]), xytext=(5, 0), textcoords="offset points",
                    va="center", color=GREY)
        lines.append(line)
    return np.array(lines)


def limit_axis(axis, low, high):
    """Limits of a logarithmic axis; plain numbers at its ticks, as many as its span bears."""
    span = high / low
    steps = (1, 1.5, 2, 3, 4, 5, 7) if span < 15 else (1, 2, 5) if span < 300 else (1,)
    ticks = [m * 10.0**e for e in range(-3, 9) for m in steps]
    axis.set_view_interval(low, high, ignore=True)
    axis.set_major_locator(FixedLocator([t for t in ticks if low <= t <= high]))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))


def plot_growth(series, path, dim):
    """<R>/<R_in> and N against tau, with the slopes of a bubbly liquid and of a dry foam."""
    use = series["tau"] > 0
    tau, size, number = (series[name][use] for name in ("tau", "R", "N"))

    with plt.rc_context(STYLE):
        fig, (left, right) = plt.subplots(1, 2, figsize=(11, 4.6), layout="constrained")
        left.loglog(tau, size, color=BLUE)
        left.set_ylabel(r"mean radius  $\langle R\rangle\,/\,\langle R_\mathrm{in}\rangle$")
        guides = slope_guides(left, tau, size, 0.7, {"1/2": 1 / 2, "1/3": 1 / 3})
        limit_axis(left.yaxis, 0.93 * min(guides.min(), size.min()), 1.07 * max(size))

        # N <R>^d is constant once the distribution of R / <R> is
        right.loglog(tau, number, color=BLUE)
        right.set_ylabel(r"bubbles  $N$")
        labels = ("−1", "−2/3") if dim == 2 else ("−3/2", "−1")
        guides = slope_guides(right, tau, number, 2.0, dict(zip(labels, (-dim / 2, -dim / 3))))
        limit_axis(right.yaxis, 0.8 * number[-1], 1.25 * max(guides.max(), number.max()))

        for ax in (left, right):
            ax.set_xlabel(TAU)
            ax.set_xlim(max(tau[0], tau[-1] * 1e-3), tau[-1] * 2)
        fig.savefig(path)
        plt.close(fig)


# ------------------------------------------------------------------ the foam

def discs(frame, dim):
    """Centres and radii of the circles to draw, images across the periodic border included.

    2D: the bubbles. 3D: their cut with the plane in the middle of the box.
    """
    box = frame.hi - frame.lo
    x, y, radius = (frame[name] for name in ("x", "y", "radius"))
    full = radius
    if dim == 3:
        z = frame["z"] - 0.5 * (frame.lo[2] + frame.hi[2])
        z -= box[2] * np.round(z / box[2])
        cut = np.abs(z) < radius
        x, y, full = x[cut], y[cut], radius[cut]
        radius = np.sqrt(full**2 - z[cut]**2)
    centre = np.column_stack((x, y)) - frame.lo[:2]

    parts = []
    for shift in np.ndindex(3, 3):
        moved = centre + (np.array(shift) - 1) * box[:2]
        seen = np.all((moved > -radius[:, None]) & (moved < box[:2] + radius[:, None]), axis=1)
        parts.append((moved[seen], radius[seen], full[seen]))
    centre, radius, full = (np.concatenate(part) for part in zip(*parts))
    order = np.argsort(-radius)           # small ones on top, where they overlap
    return centre[order], radius[order], full[order]


def plot_foam(frames, series, path, dim, rin):
    """The foam at three times in the same box, to scale, coloured by radius."""
    every = np.concatenate([frame["radius"] for frame in frames]) / rin
    norm = LogNorm(np.quantile(every, 0.002), every.max())

    with plt.rc_context(STYLE):
        fig, axes = plt.subplots(1, len(frames), figsize=(15, 5.2), layout="constrained")
        for ax, frame in zip(axes, frames):
            centre, radius, full = discs(frame, dim)
            box = (frame.hi - frame.lo)[:2]
            apart = np.sqrt(box.prod() / max(len(radius), 1)) / box[0]   # as part of the panel
            ax.add_collection(EllipseCollection(
                2 * radius, 2 * radius, np.zeros_like(radius), units="xy", offsets=centre,
                offset_transform=ax.transData, array=full / rin, cmap="viridis", norm=norm,
                edgecolors="0.1", linewidths=np.clip(16 * apart, 0.12, 0.8)))
            ax.set(xlim=(0, box[0]), ylim=(0, box[1]), xticks=[], yticks=[], aspect="equal")
            for spine in ax.spines.values():
                spine.set(visible=True, color="0.3", linewidth=0.8)
            tau = np.interp(frame.step, series["step"], series["tau"])
            count = f"{len(frame):,}".replace(",", "\u202f")
            ax.set_title(rf"$\tau = {tau:.3g}$,   {count} bubbles", pad=8)
        bar = fig.colorbar(axes[0].collections[0], ax=axes, shrink=0.82, aspect=28, pad=0.012)
        bar.set_label(r"radius  $R\,/\,\langle R_\mathrm{in}\rangle$")
        limit_axis(bar.ax.yaxis, norm.vmin, norm.vmax)
        bar.outline.set_linewidth(0.6)
        fig.savefig(path, bbox_inches="tight", pad_inches=0.08)
        plt.close(fig)


# ------------------------------------------------------------------ all of it

def make_pictures(directory):
    """Write growth.png and foam.png into `directory`; return their paths and lines of summary."""
    directory = Path(directory)
    series = read_series(directory / "series.csv")
    frames = three_frames(directory)
    dim = 2 if np.ptp(frames[0]["z"]) == 0 else 3
    rin = frames[0]["radius"].mean() / series["R"][0]
    growth, foam = directory / "growth.png", directory / "foam.png"
    plot_growth(series, growth, dim)
    plot_foam(frames, series, foam, dim, rin)

    first, last = ({name: column[i] for name, column in series.items()} for i in (0, -1))
    drift = np.ptp(series["phi"]) / series["phi"][0]
    summary = [
        f"bubbles          {first['N']:.0f} -> {last['N']:.0f}",
        f"tau              {last['tau']:.4g}",
        f"mean radius      {first['R']:.4g} -> {last['R']:.4g}  <R_in>"
        f"   (largest {last['Rmax']:.4g})",
        f"growth exponent  {exponent(series):.3f}   (d ln <R> / d ln tau, last third of a decade)",
        f"gas fraction     {last['phi']:.6f}   (varied by {drift:.1e})",
        f"steps            {last['step']:.0f}   ({last['evaluations']:.0f} evaluations)",
    ]
    return [growth, foam], summary


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("directory", type=Path)
    pictures, summary = make_pictures(parser.parse_args().directory)
    print("\n".join(summary))
    print("pictures:", *pictures, sep="\n  ")


if __name__ == "__main__":
    main()
