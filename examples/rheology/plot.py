#!/usr/bin/env python3
"""Pictures and fits of flow curves, collapse and start-up of shear, from what run.py left in a directory.

    python3 plot.py DIR [--bubbles N] [--near DPHI] [--degree N]

Writes DIR/rheology.png (flow curves and their slopes), rheology-collapse.png (scaling around jamming, finite size),
rheology-startup.png, and the means in rheology.csv. Prints fits with their errors, for several windows.
"""
import argparse
import collections
import csv
from pathlib import Path
import re

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from collapse import DEGREE, Collapse, bootstrap

DRAGS = {"static": "drag of the liquid (RD)", "contact": "and between bubbles (CD)"}
STYLE = {"font.size": 12, "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False,
         "mathtext.fontset": "cm", "savefig.dpi": 100}
RATE = r"shear rate  $\dot\gamma \mu_0 / \sigma_0$"
STRESS = r"shear stress  $\Sigma / \sigma_0$"
SKIP, BLOCK = 1.0, 0.5      # strain not counted at each rate; strain of the blocks whose means give the error
FLOOR = 0.01                # relative error that no point falls below in fits: the forms fitted are not exact either
NEAR = 0.0125               # |phi - 0.843| of points that are collapsed, at most
WINDOWS = (1e-2, 1e-3, 1e-4, 1e-5)      # fastest rates of fits
DRAWN = 1e-3                            # the one that is drawn


# ------------------------------------------------------------------ reading

Mean = collections.namedtuple("Mean", "stress error pressure pressure_error blocks")


def read(path):
    """Columns of a file of in.rheology: rate, strain, stress, pressure."""
    return np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)


def block_means(rows):
    """Means of stress and pressure over blocks of strain; by strain, since steps vary in length."""
    strain, end = rows[:, 1], rows[-1, 1]
    blocks = []
    for k in range(int((end - SKIP) / BLOCK + 0.1)):      # the last line may be some steps before the end
        grid = SKIP + BLOCK * (k + (np.arange(200) + 0.5) / 200)
        blocks.append([np.interp(grid, strain, rows[:, column]).mean() for column in (2, 3)])
    return blocks


def read_curves(directory):
    """Means of all flow curves by (bubbles, drag, phi, rate); curves of several seeds are pooled."""
    pooled = collections.defaultdict(list)
    for path in sorted(directory.glob("curve-*.csv")):
        bubbles, phi, drag = re.match(r"curve-(\d+)-([\d.]+)-([a-z]+)-", path.name).groups()
        rows = read(path)
        for rate in set(rows[:, 0]):
            pooled[int(bubbles), drag, float(phi), rate] += block_means(rows[rows[:, 0] == rate])
    means = {}
    for key in sorted(pooled):
        blocks = np.array(pooled[key])
        if len(blocks) > 2:
            mean, error = blocks.mean(0), blocks.std(0, ddof=1) / np.sqrt(len(blocks))
            means[key] = Mean(mean[0], error[0], mean[1], error[1], len(blocks))
    return means


def write_table(means, path):
    with open(path, "w", newline="") as f:
        table = csv.writer(f)
        table.writerow(["bubbles", "drag", "phi", "rate", *Mean._fields])
        table.writerows([*key, *(f"{value:.6g}" for value in mean)] for key, mean in means.items())


def flow_curve(means, bubbles, drag, phi):
    """Rate, stress and its error, from slow to fast."""
    return np.array([(key[3], m.stress, m.error) for key, m in means.items() if key[:3] == (bubbles, drag, phi)]).T


def phis_of(means, bubbles, drag, step=0.0):
    """Gas fractions that there are; with a step only multiples of it."""
    phis = sorted({key[2] for key in means if key[:2] == (bubbles, drag)})
    return [phi for phi in phis if not step or abs(phi / step - round(phi / step)) < 1e-6]


def short(phi):
    """0.80, but 0.835"""
    return f"{phi:.2f}" if abs(100 * phi - round(100 * phi)) < 1e-6 else f"{phi:.4g}"


# ------------------------------------------------------------------ yield stress

def slopes(rate, stress, error):
    """d ln stress / d ln rate between points that are half a decade or a decade apart: rate, slope, error."""
    good = stress > 0
    rate, stress, error = rate[good], stress[good], error[good]
    step = np.diff(np.log(rate))
    relative = error / stress
    return np.sqrt(rate[1:] * rate[:-1]), np.diff(np.log(stress)) / step, np.hypot(relative[1:], relative[:-1]) / step


def herschel_bulkley(rate, stress, error, times=200):
    """sigma_y, k, n of stress = sigma_y + k rate^n; their standard deviations, by noise of that size; chi2.

    A scan over n with a linear fit for each. sigma_y may come out negative: then there is no yield stress.
    """
    error = np.hypot(error, FLOOR * stress)
    noise = np.random.default_rng(1).standard_normal((len(rate), times))
    values = np.column_stack([stress, stress[:, None] + error[:, None] * noise]) / error[:, None]
    fits = []
    for n in np.arange(0.10, 1.305, 0.01):
        columns = np.column_stack([np.ones_like(rate), rate**n]) / error[:, None]
        found = np.linalg.lstsq(columns, values, rcond=None)[0]
        fits.append([*found, np.full(times + 1, n), ((columns @ found - values)**2).sum(0)])
    fits = np.array(fits)
    best = np.take_along_axis(fits, fits[:, 3].argmin(0)[None, None, :], axis=0)[0]
    return best[:3, 0], best[:3, 1:].std(1, ddof=1), best[3, 0] / max(len(rate) - 3, 1)


def report_yield(means, bubbles):
    print(f"\nHerschel-Bulkley, stress = sigma_y + k rate^n, {bubbles} bubbles; slope: d ln stress / d ln rate of the "
          "slowest decade")
    for drag in DRAGS:
        for phi in phis_of(means, bubbles, drag):
            curve = flow_curve(means, bubbles, drag, phi)
            rate, stress, error = curve
            ten = np.searchsorted(rate, 9.9 * rate[0])
            slope = np.log(stress[ten] / stress[0]) / np.log(rate[ten] / rate[0]) if stress[0] > 0 else np.nan
            spread = np.hypot(error[ten] / stress[ten], error[0] / stress[0]) / np.log(rate[ten] / rate[0])
            line = f"  {drag:8s}phi {phi:.4f}  slope {slope:5.2f} +- {spread:.2f} ({rate[0]:g} to {rate[ten]:g})"
            for top in WINDOWS[:2]:
                use = rate <= 1.01 * top
                if use.sum() > 3:
                    fit, off, chi2 = herschel_bulkley(*curve[:, use])
                    line += (f"   rates to {top:g}: sigma_y {fit[0]:9.2e} +- {off[0]:.1e}, n {fit[2]:.2f} +- "
                             f"{off[2]:.2f}, chi2 {chi2:.1f}")
            print(line)


# ------------------------------------------------------------------ collapse

def near_points(means, bubbles, top, near, what="stress"):
    """phi, rate, value, error of ln value, of points around jamming with drag by the liquid alone."""
    points = []
    for (number, drag, phi, rate), m in means.items():
        value, error = (m.stress, m.error) if what == "stress" else (m.pressure, m.pressure_error)
        if number == bubbles and drag == "static" and abs(phi - 0.843) <= near and rate <= 1.01 * top and value > 0:
            points.append((phi, rate, value, np.hypot(error / value, FLOOR)))
    return np.array(points).T


def report_collapse(means, bubbles, near, degree=DEGREE):
    """Fits for some windows; those of the stress by their fastest rate."""
    fits = {}
    print(f"\ncollapse, {bubbles} bubbles, |phi - 0.843| <= {near}, degree {degree}: value = rate^q f((phi - phi_J) / "
          "rate^(1/z nu))")
    for what in ("stress", "pressure"):
        for top in WINDOWS:
            points = near_points(means, bubbles, top, near, what)
            if points.size == 0 or len(points[0]) < 16 or len(set(points[0])) < 4:
                continue
            fit = Collapse(*points, degree)
            off, ends = bootstrap(*points, degree)
            print(f"  {what:9s}rates to {top:g} ({fit.points} points): phi_J {fit.phi_j:.4f} +- {off[0]:.4f}, "
                  f"q {fit.q:.3f} +- {off[1]:.3f}, 1/z nu {fit.inverse:.2f} +- {off[2]:.2f}, beta {fit.beta:.2f} +- "
                  f"{off[3]:.2f}, Delta {fit.delta:.2f} +- {off[4]:.2f}, chi2 {fit.chi2:.1f}"
                  + ("   AT THE EDGE of the scan: no value" if fit.at_edge else "")
                  + (f"   {ends:.0%} of the draws at the edge: errors too small" if ends else ""))
            if what == "stress":
                fits[top] = fit
    return fits


def report_sizes(means):
    """Stresses where there are points of several sizes."""
    keys = sorted({key[1:] for key in means})
    sizes = sorted({key[0] for key in means})
    if len(sizes) > 1:
        print("\nstress by the number of bubbles")
        for drag, phi, rate in keys:
            of = [(n, means[n, drag, phi, rate]) for n in sizes if (n, drag, phi, rate) in means]
            if len(of) > 1:
                print(f"  {drag:8s}phi {phi:.4f} rate {rate:g}  "
                      + "   ".join(f"{n}: {m.stress:.3e} +- {m.error:.0e}" for n, m in of))


# ------------------------------------------------------------------ pictures

def draw_flow(means, bubbles, path):
    """Flow curves and slopes, at multiples of 0.005: the rest is in the collapse."""
    fig, axes = plt.subplots(1, 3, figsize=(13.5, 4.5), layout="constrained")
    every = sorted({phi for drag in DRAGS for phi in phis_of(means, bubbles, drag, 0.005)})
    colours = dict(zip(every, plt.cm.viridis(np.linspace(0.0, 0.92, len(every)))))
    for ax, (drag, label) in zip(axes, DRAGS.items()):
        for phi in phis_of(means, bubbles, drag, 0.005):
            rate, stress, error = flow_curve(means, bubbles, drag, phi)
            ax.errorbar(rate, stress, error, color=colours[phi], marker="o", ms=3.5, lw=1.1, label=short(phi))
        ax.set(xscale="log", yscale="log", xlabel=RATE, ylabel=STRESS, title=label)
        if ax.lines:
            ax.legend(title=r"$\phi$", fontsize=9, handlelength=1.2, loc="lower right", ncols=2, columnspacing=1.0)
    low, high = (f([ax.get_ylim() for ax in axes[:2]]) for f in (np.min, np.max))
    for ax in axes[:2]:
        ax.set_ylim(low, high)
    ax = axes[2]
    for phi in phis_of(means, bubbles, "static", 0.005):
        rate, slope, error = slopes(*flow_curve(means, bubbles, "static", phi))
        ax.errorbar(rate, slope, error, color=colours[phi], marker="o", ms=3.5, lw=1.1)
    for slope, text in ((1.0, "viscous"), (0.0, "yield stress")):
        ax.axhline(slope, color="0.6", lw=0.9, zorder=0)
        ax.annotate(text, (1, slope), xycoords=("axes fraction", "data"), xytext=(0, 4), textcoords="offset points",
                    ha="right", color="0.4", fontsize=10)
    ax.set(xscale="log", xlabel=RATE, ylim=(-0.15, 1.2), title="slope, RD",
           ylabel=r"$\mathrm{d} \ln\Sigma \,/\, \mathrm{d} \ln\dot\gamma$")
    fig.savefig(path, pil_kwargs={"optimize": True})
    plt.close(fig)


def draw_collapse(means, bubbles, fit, top, near, path):
    fig, (left, middle, right) = plt.subplots(1, 3, figsize=(13.5, 4.5), layout="constrained")
    points = near_points(means, bubbles, top, near)
    phi, rate, stress = points[:3]
    phis = sorted(set(phi))
    colours = dict(zip(phis, plt.cm.viridis(np.linspace(0.0, 0.92, len(phis)))))
    x = (phi - fit.phi_j) / rate**fit.inverse
    distance = np.abs(phi - fit.phi_j)
    for one in phis:
        use = phi == one
        style = dict(color=colours[one], marker="o" if one < fit.phi_j else "s", ms=4, ls="", label=short(one))
        left.plot(x[use], stress[use] / rate[use]**fit.q, **style)
        if np.all(distance[use] > 1e-4):
            middle.plot(stress[use] / distance[use]**fit.delta,
                        rate[use] / stress[use] / distance[use]**fit.beta, **style)
    grid = np.linspace(x.min(), x.max(), 300)
    left.plot(grid, fit.curve(grid), color="0.4", lw=0.9, zorder=0)
    left.set(yscale="log", xlabel=r"$(\phi - \phi_J) \,/\, \dot\gamma^{1/z\nu}$", ylabel=r"$\Sigma \,/\, \dot\gamma^q$",
             title=rf"$\phi_J$ = {fit.phi_j:.4f},  $q$ = {fit.q:.2f},  $1/z\nu$ = {fit.inverse:.2f}")
    left.legend(title=r"$\phi$", fontsize=9, handlelength=0.8)
    middle.set(xscale="log", yscale="log", xlabel=r"$\Sigma \,/\, |\phi - \phi_J|^{\Delta}$",
               ylabel=r"$\eta^{-1} \,/\, |\phi - \phi_J|^{\beta}$",
               title=rf"$\beta$ = {fit.beta:.2f},  $\Delta$ = {fit.delta:.2f}")
    sizes = sorted({key[0] for key in means if key[1] == "static"})
    several = min(len(sizes), 2)
    rates = [r for r in (1e-3, 1e-4, 1e-5, 1e-6)
             if len({key[0] for key in means if key[1] == "static" and key[3] == r}) >= several]
    for r, colour in zip(rates, ("#1f5a96", "#c0582b", "#3a8a4d", "0.3")):
        for n, marker, line in zip(sizes, "^os", (":", "-", "--")):
            of = np.array([(key[2], m.stress, m.error) for key, m in means.items()
                           if key[0] == n and key[1] == "static" and key[3] == r and 0.83 <= key[2] <= 0.857]).T
            if of.size:
                right.errorbar(*of, color=colour, marker=marker, ls=line, ms=4, lw=1.0, mfc="none")
        right.plot([], [], color=colour, label=rf"$\dot\gamma$ = {r:g}")
    for n, marker, line in zip(sizes, "^os", (":", "-", "--")):
        right.plot([], [], color="0.3", marker=marker, ls=line, ms=4, lw=1.0, mfc="none", label=f"$N$ = {n}")
    right.set(yscale="log", xlabel=r"gas fraction  $\phi$", ylabel=STRESS, title="number of bubbles")
    right.legend(fontsize=9, handlelength=2.2)
    fig.savefig(path, pil_kwargs={"optimize": True})
    plt.close(fig)


def startups(directory):
    """Stress against strain of all seeds by (bubbles, phi, drag, rate): strain, and a row for each seed."""
    curves = collections.defaultdict(list)
    for path in sorted(directory.glob("startup-*.csv")):
        name = re.match(r"startup-(\d+)-([\d.]+)-([a-z]+)-(.+)-\d+\.csv", path.name)
        rows = read(path)
        grid = (np.arange(round(rows[-1, 1] / 0.005)) + 0.5) * 0.005
        curves[int(name[1]), float(name[2]), name[3], float(name[4])].append(np.interp(grid, rows[:, 1], rows[:, 2]))
    return {key: (0.005 * (np.arange(len(c[0])) + 0.5), np.array(c)) for key, c in sorted(curves.items())}


def report_startup(curves):
    """The largest mean over a strain of 0.05 before the strain 1, against the steady stress and its own largest one."""
    print("\nstart-up; peak: largest stress before the strain 1 (means over 0.05 and the seeds), later: the largest "
          "from 1 to 3,\n  both by the steady stress, the mean from 1 to 3; slope: d stress / d strain below 0.02")
    for (bubbles, phi, drag, rate), (strain, stress) in curves.items():
        windows = stress[:, :len(strain) // 10 * 10].reshape(len(stress), -1, 10).mean(2)
        first = int(1.0 / 0.05)
        steady = windows[:, first:].mean(1)
        k = windows[:, :first].mean(0).argmax()
        ratio = windows[:, k].mean() / steady.mean()
        error = np.hypot(windows[:, k].std(ddof=1) / windows[:, k].mean(), steady.std(ddof=1) / steady.mean()) * ratio
        later = windows[:, first:].mean(0).max() / steady.mean()
        slope = np.polyfit(strain[strain < 0.02], stress[:, strain < 0.02].mean(0), 1)[0]
        root = np.sqrt(len(stress))
        print(f"  {drag:8s}phi {phi:g} rate {rate:g}, {len(stress)} seeds: steady {steady.mean():.3e} +- "
              f"{steady.std(ddof=1) / root:.0e}, peak {ratio:.2f} +- {error / root:.2f} at the strain "
              f"{0.05 * (k + 0.5):.2f}, later {later:.2f}, slope {slope:.3f}")


def draw_startup(curves, path):
    drags = [drag for drag in DRAGS if any(key[2] == drag for key in curves)]
    fig, axes = plt.subplots(1, len(drags), figsize=(5.6 * len(drags), 4.6), layout="constrained", sharey=True,
                             squeeze=False)
    rates = sorted({key[3] for key in curves})
    colours = dict(zip(rates, plt.cm.plasma(np.linspace(0.05, 0.8, len(rates)))))
    for ax, drag in zip(axes[0], drags):
        for (bubbles, phi, one, rate), (strain, stress) in curves.items():
            if one != drag:
                continue
            mean, error = stress.mean(0), stress.std(0, ddof=1) / np.sqrt(len(stress))
            ax.plot(strain, mean, color=colours[rate], lw=1.3, label=f"{rate:g}")
            ax.fill_between(strain, mean - error, mean + error, color=colours[rate], alpha=0.25, lw=0)
        ax.set(xlim=(0, 1.5), yscale="log", xlabel="strain", title=f"{DRAGS[drag]},  $\\phi$ = {phi:g}")
    axes[0, 0].set(ylabel=STRESS, ylim=(1e-3, None))
    axes[0, 0].legend(title=RATE, fontsize=10, ncols=4, loc="lower right")
    fig.savefig(path, pil_kwargs={"optimize": True})
    plt.close(fig)


def make_pictures(directory, bubbles=None, near=NEAR, degree=DEGREE):
    means = read_curves(directory)
    curves = {key: c for key, c in startups(directory).items() if len(c[1]) > 1}
    plt.rcParams.update(STYLE)
    pictures = []
    if means:
        count = collections.Counter(key[0] for key in means)
        bubbles = bubbles if bubbles in count else count.most_common(1)[0][0]
        write_table(means, directory / "rheology.csv")
        report_yield(means, bubbles)
        report_sizes(means)
        pictures.append(directory / "rheology.png")
        draw_flow(means, bubbles, pictures[-1])
        fits = {top: fit for top, fit in report_collapse(means, bubbles, near, degree).items() if not fit.at_edge}
        if fits:
            top = DRAWN if DRAWN in fits else min(fits)
            pictures.append(directory / "rheology-collapse.png")
            draw_collapse(means, bubbles, fits[top], top, near, pictures[-1])
    if curves:
        report_startup(curves)
        pictures.append(directory / "rheology-startup.png")
        draw_startup(curves, pictures[-1])
    print("\npictures:", *pictures, sep="\n  ")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("directory", type=Path)
    parser.add_argument("--bubbles", type=int, help="those of flow curves and collapse (the most frequent number)")
    parser.add_argument("--near", type=float, default=NEAR, help="|phi - 0.843| of points collapsed (%(default)s)")
    parser.add_argument("--degree", type=int, default=DEGREE, help="of the polynomial of the collapse (%(default)s)")
    args = parser.parse_args()
    make_pictures(args.directory, args.bubbles, args.near, args.degree)


if __name__ == "__main__":
    main()
