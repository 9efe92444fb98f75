"""The rate of growth against the radius, by quartile of the energy: do squeezed bubbles shrink faster?

The rate is dR/dt times <R>/K, a number that the scaling state keeps; the radius is R/<R>. K = tau <R_in>^2 / t comes
from series.csv beside the dump; without it rates are as in the dump. Rates are the column rdot, or, without it, come
from two frames: (R_2 - R_1)/(t_2 - t_1) of the bubbles in both, at their mean radius and the first one's energy. Then
the frames should be close: those that vanish between them, the fastest to shrink, are not seen.

The energy is the column energy. Without it, it is half the energy of the contacts of a bubble by the law spring,
sum_j overlap^2 / (4 (R_i + R_j)) for sigma0 <R_in> = 1; quartiles do not depend on the unit. Quartile 1 has the least
energy. Bubbles without contacts have none: if they are more than a quarter, the first group has all of them and is
larger. Quartiles are those of each frame, or with --within radius those of each bin of radius in a frame: large bubbles
have more contacts and so more energy.

Medians, with standard errors from a bootstrap (200 samples). It draws bubbles, each with all its frames, since these
are not independent. That neighbours exchange gas with each other it does not know.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from . import figure, table
from .pairs import checked, close_pairs
from .read import Array, Frame, Unusable, read_frames
from .runs import Clock, Range, add_range, add_runs, chosen_frames

SAMPLES = 200
FEWEST = 10    # bubbles of a median


# ---------------------------------------------------------------- bubbles of a frame

@dataclass
class Rates:
    """Bubbles of a frame, each (n,): id, R/<R>, rate, energy."""

    id: Array
    radius: Array
    rate: Array
    energy: Array


def spring_energy(frame: Frame) -> Array:
    """(n,): half of the energy of each bubble's contacts, for sigma0 <R_in> = 1: U_ij = overlap^2 / (2 (R_i + R_j))
    (Durian, PRL 75, 4780 (1995)). A bubble that touches its own image has the whole of that."""
    x, radius = checked(frame)
    pairs = close_pairs(x, radius, frame.box)
    half = (pairs.sums - pairs.distance) ** 2 / (4 * pairs.sums)
    n = len(radius)
    return np.asarray(np.bincount(pairs.i, half, n) + np.bincount(pairs.j, half, n))


def energy_of(frame: Frame) -> Array:
    """The column energy, or what `spring_energy` finds."""
    return frame["energy"] if "energy" in frame.columns else spring_energy(frame)


def from_column(frame: Frame, K: float) -> Rates:
    """Rates of the column rdot, times <R>/K."""
    R = frame.radius
    return Rates(frame["id"], R / R.mean(), frame["rdot"] * R.mean() / K, energy_of(frame))


def from_two(first: Frame, second: Frame, K: float) -> Rates:
    """Rates between two frames, of the bubbles in both, times <R>/K. <R> is that of the time between, too."""
    if first.time is None or second.time is None:
        raise Unusable(f"{first.path} has no times; write it with dump_modify time yes, or with a column rdot")
    _, a, b = np.intersect1d(first["id"], second["id"], assume_unique=True, return_indices=True)
    before, after = first.radius[a], second.radius[b]
    mean = (first.radius.mean() + second.radius.mean()) / 2
    rate = (after - before) / (second.time - first.time)
    return Rates(first["id"][a], (before + after) / (2 * mean), rate * mean / K, energy_of(first)[a])


def quartiles(energy: Array) -> Array:
    """(n,): 1 to 4, by the quartiles of the values; equal values are in the same group, the lower one."""
    return np.asarray(1 + np.searchsorted(np.quantile(energy, [0.25, 0.5, 0.75]), energy, side="left"), dtype=float)


def quartiles_within(energy: Array, bins: Array) -> Array:
    """The same within each bin; bins (n,) are whole numbers."""
    found = np.zeros(len(energy))
    for number in np.unique(bins):
        found[bins == number] = quartiles(energy[bins == number])
    return found


# ---------------------------------------------------------------- medians

def weighted_median(values: Array, weights: Array) -> Array:
    """Medians (k,) of values (n,) with rows of weights (k, n); nan of a row without weight.

    The mean of the two values where half of the weight is reached and where it is exceeded.
    """
    order = np.argsort(values)
    values, weights = values[order], weights[:, order]
    sums = np.cumsum(weights, axis=1)
    half = sums[:, -1:] / 2
    last = len(values) - 1
    low = np.minimum(np.sum(sums < half, axis=1), last)
    high = np.minimum(np.sum(sums <= half, axis=1), last)
    return np.where(sums[:, -1] > 0, (values[low] + values[high]) / 2, np.nan)


def median(values: Array, bubble: Array, seed: int = 1) -> tuple[float, float]:
    """The median and its standard error: by weights that each bubble has at random (Poisson, mean 1) in all frames.

    bubble (n,): whose value it is.
    """
    _, whose = np.unique(bubble, return_inverse=True)
    weights = np.random.default_rng(seed).poisson(1.0, (SAMPLES, whose.max() + 1)).astype(float)[:, whose]
    return float(np.median(values)), float(np.nanstd(weighted_median(values, weights), ddof=1))


def medians(bubbles: list[Rates], edges: Array, within: bool) -> dict[str, Array]:
    """Columns quartile, R, count, rate, error, energy: for each quartile and bin of R/<R> (edges) with ten or more.

    The same id in several of `bubbles` is the same bubble.
    """
    bins = [np.digitize(one.radius, edges).astype(float) for one in bubbles]
    group = np.concatenate([quartiles_within(one.energy, b) if within else quartiles(one.energy)
                            for one, b in zip(bubbles, bins)])
    ids, rate, energy = (np.concatenate([getattr(one, name) for one in bubbles]) for name in ("id", "rate", "energy"))
    where, rows = np.concatenate(bins), []
    for quartile in (1, 2, 3, 4):
        for number, middle in enumerate((edges[1:] + edges[:-1]) / 2, 1):
            here = (group == quartile) & (where == number)
            if np.count_nonzero(here) >= FEWEST:
                rows.append((quartile, middle, np.count_nonzero(here), *median(rate[here], ids[here]),
                             np.median(energy[here])))
    names = ("quartile", "R", "count", "rate", "error", "energy")
    return dict(zip(names, np.array(rows, dtype=float).reshape(-1, len(names)).T))


# ---------------------------------------------------------------- command line

def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_runs(parser, "dumps with the columns id, radius, and rdot, energy if there are", "rates")
    add_range(parser, "frames that are used", "a quarter of the first number of bubbles to 100")
    parser.add_argument("--within", choices=("frame", "radius"), default="frame",
                        help="quartiles of a frame, or of each bin of radius in it (default: frame)")
    parser.add_argument("--apart", type=float, default=1.3, metavar="F",
                        help="with rdot: factor by which N falls between frames that are used (default: 1.3)")
    parser.add_argument("--width", type=float, default=0.2, metavar="W", help="of a bin of R/<R> (default: 0.2)")
    parser.epilog = "example:\n  lammps-foam rates phi0.85 --N 5000 2000 --within radius --out rates"


def main(args: argparse.Namespace) -> int:
    if not (0 < args.width <= 1 and args.apart >= 1):
        raise Unusable(f"--width {args.width} must be above 0 and up to 1, --apart {args.apart} 1 or more")
    which, bubbles, known = Range(args.tau, args.N), [], True
    for number, path in enumerate(args.runs):
        for rates, K_known in _of_run(path, which, args.apart):
            rates.id = rates.id + number * 1.0e12    # ids of other runs are other bubbles
            bubbles.append(rates)
            known = known and K_known
    if not bubbles:
        raise Unusable(f"no rates in {args.runs[0]}: the range needs a frame with rdot, or two frames")
    columns = medians(bubbles, np.arange(0, 3 + args.width / 2, args.width), args.within == "radius")
    if not len(columns["R"]):
        raise Unusable(f"no quartile has {FEWEST} bubbles of like radius in this range; make it longer")
    table.show(columns, most=60)
    print(f"\n{len(bubbles)} frames or pairs of frames of {len(args.runs)} run(s), {sum(len(b.id) for b in bubbles)} "
          "rates; rate: " + ("<R>/K dR/dt" if known else "<R> dR/dt in the units of the dump; K is not known"))
    table.write(columns, table.with_end(args.out, ".csv"))
    _draw(columns, known, args.out)
    return 0


def _of_run(path: Path, which: Range, factor: float) -> Iterator[tuple[Rates, bool]]:
    """Rates of the chosen frames, and whether K is known."""
    clock = Clock(path)
    if not which:
        first = next(iter(read_frames(path)), None)
        which = Range(None, [100, len(first) / 4 if first else 100])
    before, next_N = None, float("inf")
    for frame, _ in chosen_frames(path, which):
        if not len(frame):
            continue
        K = clock.exchange(frame)
        known = bool(np.isfinite(K))
        if "rdot" in frame.columns:
            if len(frame) <= next_N:
                yield from_column(frame, K if known else 1.0), known
                next_N = len(frame) / factor
        elif before is not None:
            yield from_two(before, frame, K if known else 1.0), known
        before = frame


def _draw(columns: dict[str, Array], known: bool, out: str) -> None:
    fig, (ax,) = figure.panels()
    for quartile, mark in zip((1, 2, 3, 4), "os^D"):
        here = columns["quartile"] == quartile
        ax.errorbar(columns["R"][here], columns["rate"][here], columns["error"][here], fmt=f"{mark}-", lw=0.8,
                    label=f"quartile {quartile}" + {1: ", least energy", 4: ", most"}.get(quartile, ""))
    ax.axhline(0, color="0.7", lw=0.7, zorder=0)
    unit = r"\langle R\rangle\,\dot R\,/\,K" if known else r"\langle R\rangle\,\dot R"
    ax.set(xlabel=r"$R\,/\,\langle R\rangle$", ylabel=f"median of ${unit}$")
    ax.legend()
    figure.save(fig, out)
