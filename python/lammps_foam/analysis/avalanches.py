"""Avalanches: drops of the energy, spikes of the velocity variance, and whether they coincide.

Two signals at equal steps of ln(tau): the rate at which energy is lost, -d ln(E)/d ln(tau), and the velocity variance
over its running median. In the scaling state they have no trend; what trend there is, a running median takes away. Each
is divided by its usual deviation, 1.48 times the running median of |deviation|, which is one standard deviation of
normal noise and hardly feels the peaks. A peak is an event if it stands out by --threshold, from the median and from
the valleys beside it. It lasts while the signal is above half of that (full width at half prominence). The size of a
drop is the share of the energy that is lost in this time.

A drop and a spike coincide if their times overlap. The chance of that: the same with the spikes shifted along ln(tau),
by 1000 random distances of 5 % of the range or more; what leaves at the end comes in at the start. The share p of
shifts with as many or more coincidences says how likely chance alone would do it.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from functools import partial

from matplotlib.axes import Axes
import numpy as np
from scipy.ndimage import median_filter
from scipy.signal import find_peaks, peak_widths
from scipy.stats import spearmanr

from . import figure, table
from .read import Array, Series, Unusable
from .runs import Range, add_range, add_runs, at, read_runs

SHIFTS = 1000
MOST_POINTS = 4000
FEWEST_LINES = 50


# ---------------------------------------------------------------- signals and events

@dataclass
class Events:
    """Peaks in the order of time; all in ln(tau)."""

    peak: Array     # (n,)
    start: Array    # (n,)
    end: Array      # (n,)

    def __len__(self) -> int:
        return len(self.peak)


def equal_steps(tau: Array, value: Array, start: float, end: float) -> tuple[Array, Array]:
    """ln(tau) at equal steps from start to end, as many as there are lines (4000 at most), and `value` there."""
    good = (tau > 0) & np.isfinite(value)
    lines = int(np.count_nonzero(good & (tau >= start) & (tau <= end)))
    if lines < FEWEST_LINES:
        raise Unusable(f"the range of tau {start:.4g} to {end:.4g} has {lines} lines, {FEWEST_LINES} are needed")
    ln_tau = np.linspace(np.log(start), np.log(end), min(lines, MOST_POINTS))
    return ln_tau, np.interp(ln_tau, np.log(tau[good]), value[good])


def loss_rate(ln_tau: Array, energy: Array) -> Array:
    """-d ln(E)/d ln(tau), by central differences."""
    return -np.asarray(np.gradient(np.log(energy), ln_tau))


def running_median(signal: Array, window: int) -> Array:
    """The median of `window` points around each, fewer than there are."""
    return np.asarray(median_filter(signal, max(3, min(window, len(signal)) | 1), mode="reflect"))


def standing_out(signal: Array, window: int) -> Array:
    """The signal less its running median, in units of its usual deviation there."""
    deviation = signal - running_median(signal, window)
    usual = 1.4826 * running_median(np.abs(deviation), window)
    # a signal at rest deviates by rounding: less than a table's digits, or little of what it does elsewhere
    floor = max(1.0e-9 * np.max(np.abs(signal), initial=0.0), 1.0e-3 * np.max(np.abs(deviation), initial=0.0), 1.0e-300)
    return np.asarray(deviation / np.maximum(usual, floor))


def events(ln_tau: Array, signal: Array, threshold: float) -> Events:
    """Peaks of a signal of `standing_out` that exceed `threshold`."""
    peaks, found = find_peaks(signal, height=threshold, prominence=threshold)
    prominences = (found["prominences"], found["left_bases"], found["right_bases"])
    _, _, left, right = peak_widths(signal, peaks, rel_height=0.5, prominence_data=prominences)
    points = np.arange(len(ln_tau))
    return Events(ln_tau[peaks], np.interp(left, points, ln_tau), np.interp(right, points, ln_tau))


def coincide(drops: Events, spikes: Events) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """(drops,): whether a spike lasts while the drop does."""
    overlap = (spikes.start[None] <= drops.end[:, None]) & (spikes.end[None] >= drops.start[:, None])
    return np.asarray(np.any(overlap, axis=1))


def chance(drops: Events, spikes: Events, start: float, end: float, seed: int = 1) -> Array:
    """(SHIFTS,): shares of drops that coincide with a spike when the spikes are shifted at random along start..end."""
    length = end - start
    shares = []
    for shift in np.random.default_rng(seed).uniform(0.05 * length, 0.95 * length, SHIFTS):
        peak = start + (spikes.peak - start + shift) % length
        moved = Events(peak, peak + spikes.start - spikes.peak, peak + spikes.end - spikes.peak)
        shares.append(np.mean(coincide(drops, moved)))
    return np.array(shares)


def correlation(a: Array, b: Array) -> float:
    """Spearman's rank correlation of two signals; it needs no threshold."""
    return float(spearmanr(a, b).statistic)


# ---------------------------------------------------------------- a run

@dataclass
class Found:
    """What a run has: signals at ln_tau, drops, and spikes if the table has vvar."""

    ln_tau: Array
    energy: Array
    loss: Array
    drops: Events
    size: Array                       # (drops,) share of the energy lost
    vvar: Array | None = None
    spikes: Events | None = None
    shares: Array | None = None       # of `chance`
    correlation: float = float("nan")

    @property
    def with_spike(self) -> Array:
        """(drops,): 1 with a spike, 0 without, nan if the table has no vvar."""
        if self.spikes is None:
            return np.full(len(self.drops), np.nan)
        return coincide(self.drops, self.spikes).astype(float)


def analyse(run: Series, start: float, end: float, threshold: float, window: float, seed: int = 1) -> Found:
    """Events of a run between two values of tau; `window` of the median in units of ln(tau)."""
    if not np.all(run["energy"][(run["tau"] >= start) & (run["tau"] <= end)] > 0):
        raise Unusable("the energy is not above 0 in the whole range: without contacts there are no drops")
    ln_tau, energy = equal_steps(run["tau"], run["energy"], start, end)
    points = int(window / (ln_tau[1] - ln_tau[0]))
    loss = loss_rate(ln_tau, energy)
    out = standing_out(loss, points)
    drops = events(ln_tau, out, threshold)
    before, after = (np.interp(edge, ln_tau, energy) for edge in (drops.start, drops.end))
    found = Found(ln_tau, energy, loss, drops, 1 - after / before)
    if "vvar" in run:
        _, vvar = equal_steps(run["tau"], run["vvar"], start, end)
        if not np.all(vvar > 0):
            raise Unusable("vvar is not above 0 in the whole range")
        moving = standing_out(vvar / running_median(vvar, points), points)
        found.vvar, found.spikes = vvar, events(ln_tau, moving, threshold)
        found.correlation = correlation(out, moving)
        if len(drops) and len(found.spikes):
            found.shares = chance(drops, found.spikes, ln_tau[0], ln_tau[-1], seed)
    return found


# ---------------------------------------------------------------- command line

def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_runs(parser, "tables with the columns tau, energy and, for spikes, vvar", "avalanches")
    add_range(parser, "range that is searched", "the last decade of tau")
    parser.add_argument("--threshold", type=float, default=3.0, metavar="T",
                        help="events stand out by T usual deviations (default: 3)")
    parser.add_argument("--window", type=float, default=1.0, metavar="W",
                        help="of the running median, in ln(tau) (default: 1)")
    parser.epilog = "example:\n  lammps-foam avalanches phi0.95 --tau 20 80 --out avalanches-0.95"


def main(args: argparse.Namespace) -> int:
    if not (args.threshold > 0 and args.window > 0):
        raise Unusable(f"--threshold {args.threshold} and --window {args.window} must be above 0")
    which = Range(args.tau, args.N)
    runs = read_runs(args.runs, ["energy", "N"] if which.N else ["energy"])
    found = [analyse(run, *_limits(run, which), args.threshold, args.window, seed) for seed, run in enumerate(runs)]
    rows = _rows(found, runs)
    table.show(rows)
    summary = _summary(found)
    print()
    table.show(summary)
    print("standard errors: " + ("scatter of the runs' means" if len(found) > 1 else "scatter of events / sqrt(n)"))
    table.write(rows, table.with_end(args.out, ".csv"))
    table.write(summary, table.with_end(args.out, "-summary.csv"))
    _draw(found[0], args.out)
    return 0


def _limits(run: Series, which: Range) -> tuple[float, float]:
    if which.tau:
        start, end = which.tau
        return max(start, float(run["tau"][run["tau"] > 0][0])), min(end, float(run["tau"][-1]))
    if which.N:
        meant = run["tau"][(run["N"] >= which.N[0]) & (run["N"] <= which.N[1]) & (run["tau"] > 0)]
        if not len(meant):
            raise Unusable(f"no line has {which.N[0]:g} to {which.N[1]:g} bubbles")
        return float(meant[0]), float(meant[-1])
    return float(run["tau"][-1]) / 10, float(run["tau"][-1])


def _rows(found: list[Found], runs: list[Series]) -> dict[str, Array]:
    """A row for each drop."""
    tau = [np.exp(one.drops.peak) for one in found]
    join = partial(np.concatenate, axis=0)
    return {
        "run": join([np.full(len(t), n + 1.0) for n, t in enumerate(tau)]),
        "tau": join(tau),
        "N": join([at(run, "N", t) if "N" in run else np.full(len(t), np.nan) for run, t in zip(runs, tau)]),
        "size": join([one.size for one in found]),
        "width": join([np.exp(one.drops.end) - np.exp(one.drops.start) for one in found]),
        "waiting": join([np.append(np.nan, np.diff(t))[:len(t)] for t in tau]),
        "with_spike": join([one.with_spike for one in found]),
    }


def _summary(found: list[Found]) -> dict[str, list[object]]:
    """Means and standard errors; widths and waiting times in ln(tau), which grow with the foam otherwise."""
    parts = {
        "size of a drop": [one.size for one in found],
        "width of a drop, in ln(tau)": [one.drops.end - one.drops.start for one in found],
        "time between drops, in ln(tau)": [np.diff(one.drops.peak) for one in found],
        "width of a spike, in ln(tau)": [s.end - s.start if (s := one.spikes) else np.empty(0) for one in found],
    }
    per, error, _ = _mean([np.array([len(one.drops) / (one.ln_tau[-1] - one.ln_tau[0])]) for one in found])
    drops = sum(len(one.drops) for one in found)
    if len(found) == 1:    # a count n has the error sqrt(n), if events are independent
        error = per / np.sqrt(max(drops, 1))
    rows: list[tuple[object, ...]] = [("drops per unit of ln(tau)", per, error, drops)]
    rows += [(name, *_mean(values)) for name, values in parts.items()]
    with_chance = [one for one in found if one.shares is not None]
    if with_chance:
        shared = [one.with_spike for one in with_chance]
        shares = np.mean([one.shares for one in with_chance if one.shares is not None], axis=0)
        measured = float(np.mean([np.mean(values) for values in shared]))
        rows.append(("share of drops with a spike", *_mean(shared)))
        rows.append(("  the same by chance", float(shares.mean()), float(shares.std(ddof=1)), SHIFTS))
        rows.append(("  p of chance", (1 + np.count_nonzero(shares >= measured)) / (1 + SHIFTS), float("nan"), SHIFTS))
        rows.append(("correlation of loss and velocity", *_mean([np.array([one.correlation]) for one in with_chance])))
    return dict(zip(("quantity", "mean", "error", "count"), map(list, zip(*rows))))


def _mean(values: list[Array]) -> tuple[float, float, int]:
    """Mean of runs, its standard error, number of values."""
    values = [one for one in values if len(one)]
    count = sum(map(len, values))
    if not count:
        return float("nan"), float("nan"), 0
    of = np.array([one.mean() for one in values]) if len(values) > 1 else values[0]
    return float(of.mean()), float(of.std(ddof=1) / np.sqrt(len(of))) if len(of) > 1 else float("nan"), count


def _draw(one: Found, out: str) -> None:
    fig, axes = figure.panels(2 if one.vvar is None else 3, sharex=True, height=1.5, width=4.2)
    tau, drops = np.exp(one.ln_tau), np.exp(one.drops.peak)
    axes[0].plot(tau, one.energy)
    axes[1].plot(tau, one.loss, color="C2")
    axes[0].set(ylabel="energy")
    axes[1].set(ylabel=r"$-\mathrm{d}\ln E\,/\,\mathrm{d}\ln\tau$")
    if one.vvar is not None and one.spikes is not None:
        axes[2].semilogy(tau, one.vvar, color="C3")
        axes[2].set(ylabel="velocity variance")
        _mark(axes[2], tau, one.vvar, np.exp(one.spikes.peak), "spikes")
    _mark(axes[0], tau, one.energy, drops, "drops")
    _mark(axes[1], tau, one.loss, drops, "drops")
    for ax in axes:
        for start, end in zip(one.drops.start, one.drops.end):
            ax.axvspan(np.exp(start), np.exp(end), color="0.88", lw=0, zorder=0)
    axes[-1].set(xlabel=figure.TAU, xlim=(tau[0], tau[-1]))
    figure.save(fig, out)


def _mark(ax: Axes, tau: Array, values: Array, where: Array, label: str) -> None:
    ax.plot(where, np.interp(where, tau, values), "v", color="C1", ms=3.5)
    ax.set_title(f"{len(where)} {label}", loc="right", pad=3)
