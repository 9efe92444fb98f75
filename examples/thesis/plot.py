"""Figures of the runs of run.py, by what lammps_foam.analysis has; run.py calls draw().

Each is written as PNG and PDF, with its numbers as CSV, into the directory of the runs.
"""
from collections import defaultdict
from pathlib import Path

import numpy as np

from lammps_foam.analysis import figure, fraction, growth, rates, runs, table
from lammps_foam.analysis.avalanches import analyse
from lammps_foam.analysis.read import read_frames

LATE = 5.0      # exponents are of what comes after so many times fewer bubbles are left, and before
COLORS = [*(f"C{n}" for n in range(7)), "0.5"]
LAST = 1.3      # so many times as many as in the last line


def draw(directory, figures):
    """figures: {name: names of runs}; figures whose runs are not there are left out."""
    for name, wanted in figures.items():
        here = [run for run in wanted if (directory / run / "run" / "complete").exists()]
        if here:
            print(f"{name}: {len(here)} of {len(wanted)} runs")
            globals()[name](directory, here)


def tables(directory, names):
    return runs.read_runs([directory / name / "run" for name in names], ["R", "N"])


def late(series):
    """Range of tau of the runs in which the exponent is taken."""
    start = max(runs.tau_of_N(one, one["N"][0] / LATE) for one in series)
    return start, min(runs.tau_of_N(one, LAST * one["N"][-1]) for one in series)


def exponents(directory, names):
    by_phi = defaultdict(list)
    for name in names:
        by_phi[float(name[3:7])].append(name)
    rows = []
    for phi, seeds in sorted(by_phi.items()):
        series = tables(directory, seeds)
        fit = growth.fit(series, *late(series))
        rows.append({"phi": phi, "runs": len(seeds), "tau_from": fit.start, "tau_to": fit.end,
                     "beta": fit.beta, "beta_error": fit.beta_error, "1/n": 1 / fit.origin[0],
                     "1/n_error": fit.origin_error[0] / fit.origin[0]**2, "tau0": fit.origin[1]})
    columns = {key: np.array([row[key] for row in rows]) for key in rows[0]}
    table.show(columns)
    table.write(columns, directory / "exponents.csv")
    fig, (ax,) = figure.panels()
    ax.errorbar(columns["phi"], columns["beta"], columns["beta_error"], fmt="o",
                label=r"slope of $\ln\langle R\rangle$ against $\ln\tau$")
    ax.errorbar(columns["phi"] + 0.001, columns["1/n"], columns["1/n_error"], fmt="s", mfc="w", lw=0.8,
                label=r"$1/n$ of $\langle R\rangle^n = k(\tau-\tau_0)$")
    for value, text in ((1 / 3, "1/3"), (1 / 2, "1/2")):
        ax.axhline(value, color="0.7", lw=0.8, zorder=0)
        ax.annotate(text, (1.01, value), xycoords=("axes fraction", "data"), va="center", fontsize=7)
    ax.set(xlabel=r"gas fraction $\varphi$", ylabel="growth exponent")
    ax.legend(loc="upper left")
    figure.save(fig, directory / "exponents")


def error_of(values):
    """Standard error of a mean; nan of fewer than five, of which none is known."""
    return np.std(values, ddof=1) / np.sqrt(len(values)) if len(values) >= 5 else np.nan


def avalanches(directory, names):
    """Energy, its loss and the variance of velocities, a column for each gas fraction; do drops and spikes meet?"""
    fig, axes = figure.panels(3, len(names), width=2.2, height=1.6)
    rows = []
    for column, (name, series) in enumerate(zip(names, tables(directory, names))):
        start, end = late([series])
        found = analyse(series, start, end, threshold=3.0, window=1.0)
        widths = found.drops.end - found.drops.start
        rows.append({"phi": name[3:7], "drops": len(found.drops), "per_ln_tau": len(found.drops) / np.log(end / start),
                     "width": np.mean(widths), "width_error": error_of(widths),
                     "size": np.mean(found.size), "with_spike": np.mean(found.with_spike),
                     "by_chance": np.mean(found.shares), "correlation": found.correlation})
        tau, shown = np.exp(found.ln_tau), slice(-len(found.ln_tau) // 3, None)    # the last third, to see events
        for ax, values, label in zip(axes[column::len(names)], (found.energy, found.loss, found.vvar),
                                     ("energy", r"$-\mathrm{d}\ln E/\mathrm{d}\ln\tau$", "variance of velocity")):
            ax.plot(tau[shown], values[shown], lw=0.6)
            if values is found.vvar:
                ax.set(yscale="log")
            for when in np.exp(found.drops.peak):
                if when > tau[shown][0]:
                    ax.axvline(when, color="C1", lw=0.5, alpha=0.6, zorder=0)
            ax.set(xlim=(tau[shown][0], tau[-1]), **({} if column else {"ylabel": label}))
        axes[column].set(title=rf"$\varphi$ = {name[3:7]}")
        axes[2 * len(names) + column].set(xlabel=r"$\tau$")
    columns = {key: np.array([row[key] for row in rows]) for key in rows[0]}
    table.show(columns)
    table.write(columns, directory / "avalanches.csv")
    figure.save(fig, directory / "avalanches")


def label_of(name):
    """0.851-diluted of large0.851-diluted-1995."""
    return name.removeprefix("large").rsplit("-", 1)[0]


def frames_of(directory, name):
    """(tau, frame) of the snapshots of a run."""
    path = directory / name / "run"
    clock = runs.Clock(path)
    for frame in read_frames(path / "foam.lammpstrj.gz"):
        yield clock.tau(frame), frame


def separation(directory, names, cells=10):
    """Spread and clustering of the local gas fraction, maps of it and of the energy; exponents; rates by energy."""
    rows, maps = [], {}
    for name in names:
        for tau, frame in frames_of(directory, name):
            if len(frame) < 10 * cells**2:    # fewer than ten bubbles in a cell tell nothing
                break
            x, R = frame.positions, frame.radius
            counts = (cells, cells)
            split = fraction.splits(R, frame.box, counts)
            fine = fraction.local_fraction(x, R, frame.box, tuple(split * count for count in counts))
            local = fraction.coarser(fine, split)
            rows.append((name, tau, len(frame), *fraction.spread(local), *fraction.clustering(fine, split)))
            if len(frame) > 15 * cells**2:    # the last with enough bubbles to see
                maps[name] = (tau, frame, fine)
    keys = ("run", "tau", "N", "spread", "spread_error", "clustering", "clustering_error")
    columns = {key: np.array([row[n] for row in rows]) for n, key in enumerate(keys)}
    table.write(columns, directory / "separation.csv")
    fig, (left, right) = figure.panels(1, 2)
    for number, name in enumerate(names):
        mine = columns["run"] == name
        for ax, key in ((left, "spread"), (right, "clustering")):
            ax.errorbar(columns["tau"][mine], columns[key][mine], columns[f"{key}_error"][mine], lw=0.8,
                        fmt="os^Dv<"[number % 6] + "-", color=f"C{number}", label=label_of(name))
            ax.set(xlabel=figure.TAU, xscale="symlog")
    left.set(ylabel="spread of the local gas fraction")
    right.set(ylabel="clustering")
    right.axhline(1, color="0.7", lw=0.8, zorder=0)
    left.legend()
    figure.save(fig, directory / "separation")
    draw_maps(directory, maps)
    draw_energies(directory, maps)
    draw_rates(directory, names)


def draw_maps(directory, maps):
    fig, axes = figure.panels(1, len(maps), width=2.2, height=2.4)
    for ax, (name, (tau, frame, fine)) in zip(axes, maps.items()):
        picture = ax.imshow(fine.T, origin="lower", cmap="RdBu_r", vmin=0.5, vmax=1.2)
        ax.set(title=rf"{label_of(name)}, $\tau$ = {tau:.0f}, {len(frame)} left", xticks=[], yticks=[])
        ax.minorticks_off()
    fig.colorbar(picture, ax=axes, shrink=0.8, label="local gas fraction")
    figure.save(fig, directory / "separation-maps")


def draw_energies(directory, maps):
    """The energy of each bubble, as in the thesis' figure 4.14: lines of force show."""
    from matplotlib.collections import EllipseCollection
    fig, axes = figure.panels(1, len(maps), width=2.2, height=2.4)
    for ax, (name, (tau, frame, _)) in zip(axes, maps.items()):
        x, R, energy = frame.positions, frame.radius, np.maximum(frame["energy"], 1.0e-12)
        middle, size = (frame.box.lo + frame.box.hi) / 2, 30 * R.mean()
        near = np.all(np.abs(x[:, :2] - middle[:2]) < size, axis=1)
        discs = EllipseCollection(2 * R[near], 2 * R[near], np.zeros(near.sum()), units="x", offsets=x[near, :2],
                                  offset_transform=ax.transData, array=np.log10(energy[near] / np.median(energy)),
                                  cmap="magma", linewidths=0, clim=(-2, 1.5))
        ax.add_collection(discs)
        ax.set(xlim=(middle[0] - size, middle[0] + size), ylim=(middle[1] - size, middle[1] + size), aspect="equal",
               title=rf"{label_of(name)}, $\tau$ = {tau:.0f}", xticks=[], yticks=[])
        ax.minorticks_off()
    fig.colorbar(discs, ax=axes, shrink=0.8, label=r"$\log_{10}$ (energy / median)")
    figure.save(fig, directory / "energies")


def draw_rates(directory, names):
    """Rate of growth against radius, for each quartile of the energy (figure 4.13)."""
    fig, axes = figure.panels(1, len(names), width=2.4, height=2.2)
    edges = np.arange(0.2, 2.6, 0.2)
    for ax, name in zip(axes, names):
        chosen, first, N = [], None, np.inf
        for _, frame in frames_of(directory, name):    # the start is forgotten, and few are left of those of the last
            first = first or len(frame)
            if len(frame) < min(first / LATE, N / 1.5):
                chosen.append(rates.from_column(frame, 1.0e-3))
                N = len(frame)
        columns = rates.medians(chosen, edges, within=True)
        for quartile in (1, 2, 3, 4):
            mine = columns["quartile"] == quartile
            ax.errorbar(columns["R"][mine], columns["rate"][mine], columns["error"][mine], lw=0.8,
                        fmt="osDv"[quartile - 1] + "-", label=f"quartile {quartile} of energy")
        ax.axhline(0, color="0.7", lw=0.8, zorder=0)
        ax.set(xlabel=r"$R/\langle R\rangle$", title=label_of(name))
    axes[0].set(ylabel=r"median of $\dot R\,\langle R\rangle / K$")
    axes[0].legend()
    figure.save(fig, directory / "rates")


def questions(directory, names):
    """Mean radius and number of bubbles for other kappa, sizes and with a flow, and their exponents."""
    fig, (left, right) = figure.panels(1, 2)
    rows = []
    for number, name in enumerate(names):
        (series,) = tables(directory, [name])
        start, end = late([series])
        fit = growth.fit([series], start, end)
        label = name.removeprefix("question-").rsplit("-", 1)[0]
        rows.append({"run": label, "tau_from": start, "tau_to": end, "beta": fit.beta, "beta_error": fit.beta_error})
        later, color = series["tau"] > 0.1, COLORS[number % len(COLORS)]
        left.plot(series["tau"][later], series["R"][later], color=color, label=label)
        windows = growth.windows_of([series], 0.5, max(start / 10, 0.1), end, False)
        local = growth.local_exponents([series], windows)
        right.errorbar(local["tau"], local["beta"], local["error"], lw=0.8, color=color, fmt=".-")
    columns = {key: np.array([row[key] for row in rows]) for key in rows[0]}
    table.show(columns)
    table.write(columns, directory / "questions.csv")
    left.set(xscale="log", yscale="log", xlabel=figure.TAU, ylabel=figure.R)
    figure.plain_ticks(left, "y")
    left.legend()
    right.set(xscale="log", xlabel=figure.TAU, ylabel="exponent in half a decade", ylim=(0, 0.8))
    figure.plain_ticks(right, "x")
    for value in (1 / 3, 1 / 2):
        right.axhline(value, color="0.7", lw=0.8, zorder=0)
    figure.save(fig, directory / "questions")


if __name__ == "__main__":
    import sys
    import run
    directory = Path(sys.argv[1])
    full = "full" in sys.argv[2:]
    seeds = sorted({int(path.name[8:]) for path in directory.glob("phi*-*")}) or [1995]
    draw(directory, {name: [one.name for one in runs_of(full, seeds)] for name, runs_of in run.FIGURES.items()})
