"""The exponent of growth, beta = d ln<R> / d ln(tau), in a sliding window, and over a range with and without an origin.

Uncertainties are standard errors (one sigma). With four runs (seeds) or more: from the scatter of the runs' exponents.
With one run: from a block bootstrap. With two or three: the larger of both, since the scatter of so few says little.

The bootstrap: <R> is the sum of what happened before. So its deviations from a power law are correlated over the whole
run, and the standard error of a straight line through its points is far too small. Its increments at equal steps of
ln(tau) are less so: the window is cut into 8 blocks of increments, blocks are drawn with replacement, and each series
put together from them is fitted again. This is right for a random walk about the law, and too large by up to a few
times where the foam forgets its deviations within the window. Several seeds are better.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from . import figure, table
from .read import Array, Series, Unusable
from .runs import Range, add_range, add_runs, at, read_runs, tau_of_N

POINTS = 64      # of a window, at equal steps of ln(tau)
BLOCKS = 8       # of increments in a window
SAMPLES = 200    # of the bootstrap
MANY = 4         # runs whose scatter alone tells the error: that of three is known to half of itself, 1/sqrt(2 (3 - 1))

Estimator = Callable[[Array, Array], Array]    # ln(tau) (n,) and rows of ln<R> (k, n) to rows of estimates (k, m)
Window = list[tuple[float, float]]             # from and to tau, for each run


# ---------------------------------------------------------------- one window

def resample(tau: Array, R: Array, start: float, end: float, points: int = POINTS) -> tuple[Array, Array]:
    """ln(tau) at equal steps from start to end, and ln(R) there, both (points,); linear in ln, ln between lines.

    Raises Unusable if fewer than two lines per block lie in the range, or if the range exceeds the data.
    """
    good = (tau > 0) & (R > 0)
    tau, R = tau[good], R[good]
    inside = np.count_nonzero((tau >= start) & (tau <= end))
    slack = 1.0e-9 * end
    if inside < 2 * BLOCKS or start < tau[0] - slack or end > tau[-1] + slack:
        raise Unusable(f"the range of tau {start:.4g} to {end:.4g} has {inside} lines with tau > 0; "
                       f"{2 * BLOCKS} are needed, of a table that reaches over the range")
    ln_tau = np.linspace(np.log(start), np.log(end), points)
    return ln_tau, np.interp(ln_tau, np.log(tau), np.log(R))


def slopes(ln_tau: Array, ln_R: Array) -> Array:
    """Slopes (k, 1) of the straight lines through rows of ln_R (k, n), by least squares."""
    x = ln_tau - ln_tau.mean()
    return np.asarray(ln_R @ x / (x @ x))[:, None]


def rebuilt(ln_R: Array, blocks: int = BLOCKS, samples: int = SAMPLES, seed: int = 1) -> Array:
    """Series (samples, n) like ln_R (n,), put together from blocks of its increments.

    A straight line in the increments (a slope that changes steadily) is kept and what deviates from it is drawn, in
    blocks that may begin anywhere and go on at the start. Deviations are enlarged by sqrt(blocks / (blocks - 2)): of
    so many independent pieces the line took two.
    """
    steps = np.diff(ln_R)
    n = np.arange(len(steps))
    trend = np.polyval(np.polyfit(n, steps, 1), n)
    deviation = (steps - trend) * np.sqrt(blocks / (blocks - 2))
    length = -(-len(steps) // blocks)
    starts = np.random.default_rng(seed).integers(len(steps), size=(samples, blocks))
    drawn = (starts[:, :, None] + np.arange(length)).reshape(samples, -1)[:, :len(steps)] % len(steps)
    new = trend + deviation[drawn]
    return np.asarray(ln_R[0] + np.concatenate([np.zeros((samples, 1)), np.cumsum(new, axis=1)], axis=1))


def estimate(ln_tau: Array, ln_R: Array, estimator: Estimator = slopes, samples: int = SAMPLES) -> tuple[Array, Array]:
    """Estimates (m,) of one run, and their standard errors (m,) by the block bootstrap. Failed fits are left out."""
    value = estimator(ln_tau, ln_R[None])[0]
    drawn = estimator(ln_tau, rebuilt(ln_R, samples=samples))
    good = np.all(np.isfinite(drawn), axis=1)
    if np.count_nonzero(good) <= samples // 2:
        return value, np.full(len(value), np.nan)
    return value, np.std(drawn[good], axis=0, ddof=1)


def over_runs(values: Array, errors: Array) -> tuple[Array, Array]:
    """Mean of runs and its standard error, along the first axis (runs), from their scatter and their own errors."""
    runs = len(values)
    own = np.sqrt(np.sum(errors**2, axis=0)) / runs
    if runs == 1:
        return values[0], own
    scatter = values.std(axis=0, ddof=1) / np.sqrt(runs)
    return values.mean(axis=0), scatter if runs >= MANY else np.fmax(scatter, own)


# ---------------------------------------------------------------- with an origin of tau

def from_origin(ln_tau: Array, ln_R: Array) -> Array:
    """Rows (n, tau0, k) of R^n = k (tau - tau0), fitted to rows of ln_R (k, n) by least squares in ln R.

    In the scaling state d<R>/dtau = k / (n <R>^(n-1)), so R^n - R0^n = k tau from any state R0: tau0 = -R0^n / k.
    The slope d ln R / d ln tau = tau / (n (tau - tau0)) comes to 1/n only for tau >> |tau0|. Rows without a fit: nan.
    """
    tau = np.exp(ln_tau)
    low, high = ln_tau[0] - 12.0, ln_tau[-1] + 5.0    # beyond, no power law can be told from an exponential
    q = np.tile(np.linspace(low, high, 60), (len(ln_R), 1))
    for _ in range(12):    # each time a finer grid around the best of the last
        misfit, a, b = _straight(tau, ln_R, q)
        best = np.argmin(misfit, axis=1)[:, None]
        middle, step = np.take_along_axis(q, best, 1), q[:, 1:2] - q[:, :1]
        q = middle + step * np.linspace(-1, 1, 11)
    _, a, b = _straight(tau, ln_R, middle)
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        found = np.concatenate([1 / b, tau[0] - np.exp(middle), np.exp(a / b)], axis=1)
    found[np.any((middle < low + 0.5) | (middle > high - 0.5) | (b < 1.0e-3), axis=1)] = np.nan
    return found


def _straight(tau: Array, ln_R: Array, q: Array) -> tuple[Array, Array, Array]:
    """ln R = a + b ln(tau - tau0), tau0 = tau[0] - e^q < tau[0]: the sum of squares, a and b, each like q (k, m)."""
    x = np.log(tau - tau[0] + np.exp(q)[..., None])
    x_mean, y_mean = x.mean(axis=-1), ln_R.mean(axis=1, keepdims=True)
    dx, dy = x - x_mean[..., None], (ln_R - y_mean)[:, None]
    b = np.sum(dx * dy, axis=-1) / np.sum(dx * dx, axis=-1)
    return np.sum((dy - b[..., None] * dx) ** 2, axis=-1), y_mean - b * x_mean, b


# ---------------------------------------------------------------- results

@dataclass
class Fit:
    """beta over a range, and the fit with an origin: n, tau0, k; each with its standard error."""

    start: float
    end: float
    beta: float
    beta_error: float
    origin: Array         # (3,): n, tau0, k
    origin_error: Array


def fit(runs: list[Series], start: float, end: float) -> Fit:
    """The fits of several runs over a range of tau."""
    windows = [resample(run["tau"], run["R"], start, end) for run in runs]
    straight = [estimate(*window) for window in windows]
    curved = [estimate(*window, from_origin, SAMPLES if len(runs) < MANY else 2) for window in windows]
    beta, beta_error = over_runs(np.array([v for v, _ in straight]), np.array([e for _, e in straight]))
    origin, origin_error = over_runs(np.array([v for v, _ in curved]), np.array([e for _, e in curved]))
    return Fit(start, end, float(beta[0]), float(beta_error[0]), origin, origin_error)


def windows_of(runs: list[Series], width: float, start: float, end: float, by_N: bool) -> list[Window]:
    """Sliding windows, a quarter of their width apart, each with its range of tau in every run.

    `width` is in decades of tau, or with by_N the factor by which N falls. start and end are tau of the first run.
    """
    if not by_N:
        step = width / 4
        count = int(np.floor((np.log10(end / start) - width) / step + 1.0e-6)) + 1
        first = np.log10(start) + step * np.arange(max(count, 0))
        return [[(10**u, 10**(u + width))] * len(runs) for u in first]
    most, least = float(at(runs[0], "N", start)), float(at(runs[0], "N", end))
    step = np.log(width) / 4
    count = int(np.floor((np.log(most / least) - np.log(width)) / step + 1.0e-6)) + 1
    tops = most * np.exp(-step * np.arange(max(count, 0)))
    return [[(tau_of_N(run, top), tau_of_N(run, top / width)) for run in runs] for top in tops]


def local_exponents(runs: list[Series], windows: list[Window], origin: float = 0.0) -> dict[str, Array]:
    """Columns tau, N, R, beta, error: d ln R / d ln(tau - origin) in windows; tau is the geometric middle."""
    rows = []
    for ranges in windows:
        try:
            pieces = [resample(run["tau"] - origin, run["R"], a - origin, b - origin)
                      for run, (a, b) in zip(runs, ranges)]
        except Unusable:    # too few lines, or beyond the end of a run
            continue
        found = [estimate(*piece) for piece in pieces]
        beta, error = over_runs(np.array([v for v, _ in found]), np.array([e for _, e in found]))
        middle = [float(np.exp(ln_tau.mean())) + origin for ln_tau, _ in pieces]
        N = np.mean([float(at(run, "N", t)) if "N" in run else np.nan for run, t in zip(runs, middle)])
        R = np.mean([float(at(run, "R", t)) for run, t in zip(runs, middle)])
        rows.append((np.mean(middle), N, R, beta[0], error[0]))
    return dict(zip(("tau", "N", "R", "beta", "error"), np.array(rows, dtype=float).reshape(-1, 5).T))


# ---------------------------------------------------------------- command line

def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_runs(parser, "tables with the columns tau and R", "growth")
    add_range(parser, "range of the fit", "the last decade of tau")
    parser.add_argument("--window", type=float, default=0.5, metavar="W", help="width in decades of tau (default: 0.5)")
    parser.add_argument("--window-N", type=float, metavar="F", help="windows in which N falls by the factor F instead")
    parser.add_argument("--show", nargs=2, type=float, metavar=("FROM", "TO"),
                        help="windows over this range of tau (default: the last two decades)")
    parser.add_argument("--origin", default="0", metavar="TAU0|fit",
                        help="slopes in windows against tau - TAU0; fit: the tau0 of the range (default: 0)")
    parser.epilog = ("example: three runs of the same foam with other seeds; fit while 3000 to 300 bubbles are left\n"
                     "  lammps-foam growth seed1 seed2 seed3 --N 3000 300 --out growth")


def main(args: argparse.Namespace) -> int:
    by_N = args.N is not None or args.window_N is not None
    runs = read_runs(args.runs, ["R", "N"] if by_N else ["R"])
    start, end = _fit_range(runs, Range(args.tau, args.N))
    whole = fit(runs, start, end)
    origin = _origin(args.origin, whole)
    width = args.window if args.window_N is None else args.window_N
    if args.window_N is not None and not width > 1:
        raise Unusable(f"--window-N {width:g} must be above 1")
    if not width > 0:
        raise Unusable(f"--window {width:g} must be above 0")
    last = min(run["tau"][-1] for run in runs)
    first = max(run["tau"][run["tau"] > 0][0] for run in runs)
    shown = args.show or [max(first, last / 100), last]
    columns = local_exponents(runs, windows_of(runs, width, shown[0], shown[1], args.window_N is not None), origin)
    table.show(columns)
    _say(whole, len(runs), origin)
    table.write(columns, table.with_end(args.out, ".csv"))
    table.write(_fits(whole), table.with_end(args.out, "-fit.csv"))
    _draw(runs, columns, whole, origin, args.out)
    return 0


def _fit_range(runs: list[Series], which: Range) -> tuple[float, float]:
    last = min(run["tau"][-1] for run in runs)
    if which.tau:
        return which.tau
    if which.N:
        few, many = which.N
        start, end = (max(tau_of_N(run, many) for run in runs), min(tau_of_N(run, few) for run in runs))
        if not 0 < start < end:
            least = max(run["N"][-1] for run in runs)
            raise Unusable(f"--N {many:g} {few:g}: not all runs go from {many:g} to {few:g} bubbles at the same tau; "
                           f"they end with {least:g} or fewer")
        return start, end
    return last / 10, last


def _origin(text: str, whole: Fit) -> float:
    try:
        value = float(whole.origin[1]) if text == "fit" else float(text)
    except ValueError:
        raise Unusable(f"--origin {text} must be a value of tau, or fit") from None
    if not np.isfinite(value):
        raise Unusable("--origin fit: this range has no fit with an origin; give a longer one with --tau or --N")
    return value


def _fits(whole: Fit) -> dict[str, list[object]]:
    n, error = float(whole.origin[0]), float(whole.origin_error[0])
    return {"quantity": ["beta", "1/n", "n", "tau0", "k"], "from": [whole.start] * 5, "to": [whole.end] * 5,
            "value": [whole.beta, 1 / n, *map(float, whole.origin)],
            "error": [whole.beta_error, error / n**2, *map(float, whole.origin_error)]}


def _say(whole: Fit, runs: int, origin: float) -> None:
    n, error = float(whole.origin[0]), float(whole.origin_error[0])
    how = f"bootstrap of {BLOCKS} blocks" if runs == 1 else f"scatter of {runs} runs"
    if 1 < runs < MANY:
        how += f", or the bootstrap of {BLOCKS} blocks of each where that is larger"
    print(f"\nrange of tau {whole.start:.4g} to {whole.end:.4g}; standard errors from the {how}")
    print(f"  slope:                  beta = {table.with_error(whole.beta, whole.beta_error)}")
    if np.isfinite(n):
        print(f"  R^n = k (tau - tau0):   1/n = {table.with_error(1 / n, error / n**2)}, "
              f"tau0 = {table.with_error(float(whole.origin[1]), float(whole.origin_error[1]))}")
    else:
        print("  R^n = k (tau - tau0):   no fit: the range is too short to tell n and tau0 apart")
    if origin:
        print(f"slopes in windows are against tau - tau0 with tau0 = {origin:.4g}")


def _draw(runs: list[Series], columns: dict[str, Array], whole: Fit, origin: float, out: str) -> None:
    fig, (top, bottom) = figure.panels(2, sharex=True, height=2.1)
    first = min(columns["tau"], default=whole.start) / 3
    for run in runs:
        later = run["tau"] >= first
        top.plot(run["tau"][later], run["R"][later], color="C0", alpha=1.0 if len(runs) == 1 else 0.5)
    x = np.array([whole.start, whole.end])
    middle = np.sqrt(x[0] * x[1])
    height = np.exp(np.mean([np.log(at(run, "R", middle)) for run in runs]))
    top.plot(x, 1.12 * height * (x / middle) ** whole.beta, "k--", lw=0.9,
             label=rf"$\beta = {table.with_error(whole.beta, whole.beta_error).replace('+-', chr(92) + 'pm')}$")
    top.set(xscale="log", yscale="log", ylabel=figure.R)
    figure.plain_ticks(top, "y")
    top.legend(loc="upper left")
    for value, name in ((1 / 2, "1/2"), (1 / 3, "1/3")):
        bottom.axhline(value, color="0.7", lw=0.8, zorder=0)
        bottom.annotate(name, (1.01, value), xycoords=("axes fraction", "data"), va="center", fontsize=7)
    bottom.errorbar(columns["tau"], columns["beta"], columns["error"], fmt="o", color="C0", lw=0.8)
    against = r"\tau" if not origin else r"(\tau-\tau_0)"
    bottom.set(xlabel=figure.TAU, ylabel=rf"$\mathrm{{d}}\ln\langle R\rangle\,/\,\mathrm{{d}}\ln{against}$")
    low, high = np.nanmin([*columns["beta"], 1 / 3]), np.nanmax([*columns["beta"], 1 / 2])
    bottom.set_ylim(low - 0.06, high + 0.06)
    figure.save(fig, out)
