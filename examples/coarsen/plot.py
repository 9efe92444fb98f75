#!/usr/bin/env python3
"""Pictures of a coarsening run: growth.png, foam.png and sizes.png, from what in.coarsen wrote.

    python3 plot.py DIR          DIR holds series.csv, foam.lammpstrj and last.lammpstrj,
                                 and tau.lammpstrj, N.lammpstrj for sizes.png
"""
import argparse
import csv
from pathlib import Path
import sys

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

class Unusable(Exception):
    """What is wrong with a file of the user's."""


NEEDED = ("step", "tau", "N", "R")                 # of series.csv
WELCOME = ("Rmax", "phi", "evaluations")           # without them the summary is shorter
OF_A_BUBBLE = ("id", "x", "y", "z", "radius")      # of snapshots


def check_columns(path, names, needed, also=()):
    missing = [name for name in needed if name not in names]
    if missing:
        more = f" (and for the whole summary {', '.join(also)})" if also else ""
        raise Unusable(f"{path} lacks the columns: {', '.join(missing)}. Needed are "
                       f"{', '.join(needed)}{more}; it has {', '.join(names) or 'none'}")


def read_series(path):
    """Columns of series.csv by name."""
    if not path.is_file():
        raise Unusable(f"there is no {path}, a table with a line of names, "
                       f"{','.join(NEEDED + WELCOME)}, and commas between columns")
    with open(path, newline="") as f:
        rows = [row for row in csv.reader(f) if row]
    names = [name.strip() for name in rows[0]] if rows else []
    check_columns(path, names, NEEDED, WELCOME)
    try:
        table = np.array(rows[1:], dtype=float)
    except ValueError as wrong:
        raise Unusable(f"{path} has a line that is no row of {len(names)} numbers: {wrong}") from None
    if len(table) < 2 or table.shape[1] != len(names) or not table[-1, names.index("tau")] > 0:
        raise Unusable(f"{path} needs two lines at least, of {len(names)} numbers each, "
                       "the last with a tau above 0")
    return {name: table[:, i] for i, name in enumerate(names)}


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
    if not path.is_file():
        raise Unusable(f"there is no {path}, snapshots of the foam (dump custom) with the columns "
                       f"{' '.join(OF_A_BUBBLE)}")
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
                check_columns(path, names, OF_A_BUBBLE)
                rows = np.loadtxt(f, max_rows=natoms, ndmin=2)
                yield Frame(step, box, dict(zip(names, rows.T)))


def three_frames(directory):
    """First, middle and last snapshot; in the middle ln N is half-way between the others."""
    first = last = middle = best = None
    for last in read_dump(directory / "last.lammpstrj"):
        pass
    for frame in read_dump(directory / "foam.lammpstrj") if last else ():
        first = first or frame
        target = 0.5 * (np.log(len(first)) + np.log(len(last)))
        off = abs(np.log(len(frame)) - target)
        if middle is None or off < best:
            middle, best = frame, off
    if middle is None:
        raise Unusable(f"no snapshot in foam.lammpstrj or last.lammpstrj of {directory}")
    return first, middle, last


# ------------------------------------------------------------------ growth

WINDOW = 1 / 3      # decades of tau, the width of the windows that slide


def exponent(series, end, decades):
    """d ln <R> / d ln tau: a straight line through all points in end / 10^decades < tau <= end.

    nan where these are fewer than 3 or do not span half of the window.
    """
    tau, size = series["tau"], series["R"]
    # the points are as dense as steps: without the last digits of both limits
    use = (tau > end / 10**decades * (1 - 1e-9)) & (tau <= end * (1 + 1e-9)) & (tau > 0)
    if use.sum() < 3 or tau[use].max() < tau[use].min() * 10**(0.5 * decades):
        return float("nan")
    return np.polyfit(np.log(tau[use]), np.log(size[use]), 1)[0]


def local_exponents(series, decades=1.0, points=60):
    """Exponents in windows that slide over the last `decades` of tau: middles (in ln tau), slopes."""
    ends = series["tau"][-1] * 10**np.linspace(WINDOW - decades, 0, points)
    slopes = np.array([exponent(series, end, WINDOW) for end in ends])
    good = np.isfinite(slopes)
    return ends[good] / 10**(0.5 * WINDOW), slopes[good]


def growth_lines(series):
    """The exponent in words: over the last decade, and how much it depends on the window."""
    end = series["tau"][-1]
    begin = max(end / 10, series["tau"][series["tau"] > 0][0])
    _, slopes = local_exponents(series)
    if not len(slopes):
        return ["growth exponent  too few points"]
    return [
        f"growth exponent  {exponent(series, end, 1.0):.2f}, between {slopes.min():.2f} and "
        f"{slopes.max():.2f} in parts of the window",
        f"                 (d ln <R> / d ln tau, tau = {begin:.3g} to {end:.4g}; parts of 1/3 decade)",
    ]


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
        fig, (left, middle, right) = plt.subplots(1, 3, figsize=(15, 4.4), layout="constrained")
        left.loglog(tau, size, color=BLUE)
        left.set_ylabel(r"mean radius  $\langle R\rangle\,/\,\langle R_\mathrm{in}\rangle$")
        guides = slope_guides(left, tau, size, 0.7, {"1/2": 1 / 2, "1/3": 1 / 3})
        limit_axis(left.yaxis, 0.93 * min(guides.min(), size.min()), 1.07 * max(size))

        # N <R>^d is constant once the distribution of R / <R> is
        middle.loglog(tau, number, color=BLUE)
        middle.set_ylabel(r"bubbles  $N$")
        labels = ("−1", "−2/3") if dim == 2 else ("−3/2", "−1")
        guides = slope_guides(middle, tau, number, 2.0, dict(zip(labels, (-dim / 2, -dim / 3))))
        limit_axis(middle.yaxis, 0.8 * number[-1], 1.25 * max(guides.max(), number.max()))

        where, slopes = local_exponents(series, decades=3.0, points=180)
        right.semilogx(where, slopes, color=BLUE)
        for label, slope in {"1/2": 1 / 2, "1/3": 1 / 3}.items():
            right.axhline(slope, color=GREY, lw=1.2, ls="-" if slope == 1 / 2 else (0, (4, 2)))
            right.annotate(label, (1, slope), xytext=(5, 0), textcoords="offset points",
                           xycoords=("axes fraction", "data"), va="center", color=GREY)
        right.set_ylim(min([-0.05, *slopes]) - 0.05, max([0.6, *slopes]) + 0.05)
        right.set_ylabel(r"slope  $\mathrm{d}\ln\langle R\rangle\,/\,\mathrm{d}\ln\tau$")
        right.set_title("in windows of a third of a decade", fontsize=12)

        for ax in (left, middle, right):
            ax.set_xlabel(TAU)
            ax.set_xlim(max(tau[0], tau[-1] * 1e-3), tau[-1] * (1 if ax is right else 2))
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


# ------------------------------------------------------------------ sizes

def chosen_frames(directory):
    """The start, and the snapshots that at_tau and at_N asked for, in the order of time."""
    paths = [directory / name for name in ("tau.lammpstrj", "N.lammpstrj")]
    frames = {frame.step: frame for path in paths if path.is_file() for frame in read_dump(path)}
    return [frames[step] for step in sorted(frames)]


def plot_sizes(frames, series, path):
    """How R / <R> is distributed among the bubbles of each frame."""
    relative = [frame["radius"] / frame["radius"].mean() for frame in frames]
    top = 1.02 * max(np.quantile(r, 0.999) for r in relative)
    with plt.rc_context(STYLE):
        fig, ax = plt.subplots(figsize=(7.5, 4.8), layout="constrained")
        colours = plt.get_cmap("viridis")(np.linspace(0, 0.92, len(frames)))
        for frame, r, colour in zip(frames, relative, colours):
            # as many bins as one in ten bubbles, so that each holds some; no more than 40
            edges = np.linspace(0, top, int(np.clip(len(r) / 10, 8, 40)) + 1)
            tau = np.interp(frame.step, series["step"], series["tau"])
            ax.stairs(np.histogram(r, edges)[0] / (len(r) * np.diff(edges)), edges, color=colour,
                      lw=1.6, label=rf"$\tau = {tau:.3g}$,  $N = {len(r)}$,  "
                                    rf"$s/\langle R\rangle = {r.std():.2f}$")
        ax.set(xlim=(0, top), ylim=(0, None), ylabel="probability density",
               xlabel=r"radius  $R\,/\,\langle R\rangle$")
        ax.legend(fontsize=11)
        fig.savefig(path)
        plt.close(fig)


# ------------------------------------------------------------------ all of it

def make_pictures(directory):
    """Write the pictures into `directory`; return their paths and lines of summary.

    Everything is read, and Unusable raised where something is missing, before anything is drawn.
    """
    directory = Path(directory)
    series = read_series(directory / "series.csv")
    frames = three_frames(directory)
    chosen = chosen_frames(directory)

    dim = 2 if np.ptp(frames[0]["z"]) == 0 else 3
    rin = frames[0]["radius"].mean() / series["R"][0]
    pictures = [directory / "growth.png", directory / "foam.png"]
    plot_growth(series, pictures[0], dim)
    plot_foam(frames, series, pictures[1], dim, rin)
    if chosen:
        pictures.append(directory / "sizes.png")
        plot_sizes([frames[0], *chosen], series, pictures[2])

    first, last = ({name: column[i] for name, column in series.items()} for i in (0, -1))
    largest = f"   (largest {last['Rmax']:.4g})" if "Rmax" in last else ""
    evaluations = f"   ({last['evaluations']:.0f} evaluations)" if "evaluations" in last else ""
    summary = [
        f"bubbles          {first['N']:.0f} -> {last['N']:.0f}",
        f"tau              {last['tau']:.4g}",
        f"mean radius      {first['R']:.4g} -> {last['R']:.4g}  <R_in>" + largest,
        *growth_lines(series),
    ]
    if "phi" in last:
        drift = np.ptp(series["phi"]) / series["phi"][0]
        summary.append(f"gas fraction     {last['phi']:.6f}   (varied by {drift:.1e})")
    summary.append(f"steps            {last['step']:.0f}" + evaluations)
    return pictures, summary


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("directory", type=Path)
    try:
        pictures, summary = make_pictures(parser.parse_args().directory)
    except Unusable as wrong:
        sys.exit(str(wrong))
    print("\n".join(summary))
    print("pictures:", *pictures, sep="\n  ")


if __name__ == "__main__":
    main()
