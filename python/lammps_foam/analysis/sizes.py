"""The distribution of sizes in the scaling state, its moments, and the closed forms of mean-field theories.

All bubbles of a frame count alike, all frames alike. Frames that lie close together show the same bubbles: of each run
only frames are taken between which N falls by a factor (--apart). Errors are standard errors. With several runs (seeds)
they come from the scatter of the runs' averages. With one run they come from the number of its bubbles, and from how
many of them its frames share: see `error_of_one_run`.

The theories. In both each bubble meets the average of all; R_c is the radius that neither grows nor shrinks:

    lsw      dR/dt ~ (1/R) (1/R_c - 1/R): diffusion through much liquid. Lifshitz & Slyozov, J. Phys. Chem. Solids 19,
             35 (1961); Wagner, Z. Elektrochem. 65, 581 (1961). <R> ~ t^(1/3).
    lemlich  dR/dt ~ 1/R_c - 1/R: exchange through walls or a common liquid, R_c = <R^2>/<R> in 3D. Lemlich, Ind. Eng.
             Chem. Fundam. 17, 89 (1978). <R> ~ t^(1/2). The same law was solved by Wagner (1961) for slow reactions and
             by Hillert, Acta Metall. 13, 227 (1965) for grains. The law `area` of fix foam/coarsen is a multiple of it
             that depends on time alone, and so has the same distribution.

In 2D lsw means the same law with the area of gas conserved, as `liquid lsw` has it for free bubbles; a real 2D liquid
screens (Marqusee, J. Chem. Phys. 81, 976 (1984)), which has no closed form. How the forms follow: see `density`.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.integrate import quad

from . import figure, table
from .read import Array, Unusable, read_frames
from .runs import Range, add_range, add_runs, chosen_frames

THEORIES = ("lsw", "lemlich")
END = {"lsw": 1.5, "lemlich": 2.0}    # largest z = R / R_c


# ---------------------------------------------------------------- theory

def velocity(theory: str, z: Array) -> Array:
    """v(z) = dz / d ln R_c of a bubble of size z = R / R_c in the scaling state.

    With dR/dt = R^-m (1/R_c - 1/R) and gamma = R_c^(m+1) dR_c/dt, v = z^-m (1 - 1/z) / gamma - z. The stable state is
    that in which v has a double zero, at the largest z: m = 1 (lsw): gamma = 4/27, z < 3/2; m = 0 (lemlich):
    gamma = 1/4, z < 2.
    """
    z = np.asarray(z, dtype=float)
    if theory == "lsw":
        return np.asarray(-(z - 1.5) ** 2 * (z + 3) / z**2)
    return np.asarray(-(z - 2) ** 2 / z)


def density(theory: str, z: Array, dimension: int) -> Array:
    """Probability density of z = R / R_c, normalised; 0 from the largest z on.

    N bubbles have N f(z) dz of them at z, and N ~ R_c^-d, since gas is conserved. Then d(f v)/dz = d f, so
    f = C / |v| exp(d int dz / v), and f |v| = d at z = 0: all bubbles vanish there. In closed form, with u the distance
    of z from its largest value:
        lsw      f = d (3/2)^(5d/9) 3^(4d/9) e^(d/3) z^2 u^(-2 - 5d/9) (z + 3)^(-1 - 4d/9) e^(-d/(2u))
        lemlich  f = d (2e)^d z u^(-2 - d) e^(-2d/u)
    """
    d = dimension
    z = np.asarray(z, dtype=float)
    inside = (z > 0) & (z < END[theory])
    z = np.where(inside, z, 1.0)
    u = END[theory] - z
    if theory == "lsw":
        f = (d * 1.5 ** (5 * d / 9) * 3 ** (4 * d / 9) * z**2 * u ** (-2 - 5 * d / 9) * (z + 3) ** (-1 - 4 * d / 9)
             * np.exp(d / 3 - d / (2 * u)))
    else:
        f = d * 2**d * z * u ** (-2.0 - d) * np.exp(d - 2 * d / u)
    return np.where(inside, f, 0.0)


def theory_moment(theory: str, power: float, dimension: int) -> float:
    """<z^power>, by quadrature."""
    value, _ = quad(lambda z: z**power * float(density(theory, np.array(z), dimension)), 0, END[theory],
                    epsabs=1e-12, epsrel=1e-10)
    return float(value)


def density_over_mean(theory: str, x: Array, dimension: int) -> Array:
    """Probability density of x = R / <R>. <R> is not R_c: in 3D <R> = 8/9 R_c for lemlich."""
    mean = theory_moment(theory, 1, dimension)
    return mean * density(theory, np.asarray(x) * mean, dimension)


def volume_density(theory: str, w: Array, dimension: int) -> Array:
    """Probability density of w = V / <V>, V ~ R^d: that of z times dz/dw."""
    w = np.asarray(w, dtype=float)
    scale = theory_moment(theory, dimension, dimension) ** (1 / dimension)
    z = scale * np.where(w > 0, w, 1.0) ** (1 / dimension)
    return np.where(w > 0, density(theory, z, dimension) * z / (dimension * np.where(w > 0, w, 1.0)), 0.0)


# ---------------------------------------------------------------- what is measured

MOMENTS = ("spread", "skewness", "R21", "R32", "R2", "R3", "p", "largest")
MEANING = {"spread": "standard deviation / <R>", "skewness": "third standardised moment",
           "R21": "<R^2>/<R>^2", "R32": "<R^3>/(<R^2> <R>), Sauter radius / <R>", "R2": "<R^2>^(1/2)/<R>",
           "R3": "<R^3>^(1/3)/<R>", "p": "<R^3>^(2/3)/<R^2> - 1, polydispersity", "largest": "R_max/<R>"}


def moments(R: Array) -> Array:
    """The numbers of MOMENTS of radii (n,)."""
    x = R / R.mean()
    return np.append(_moments(1.0, *(float(np.mean(x**power)) for power in (2, 3))), x.max())


def theory_moments(theory: str, dimension: int) -> Array:
    """The numbers of MOMENTS of a theory; the largest is the end of its distribution."""
    one, two, three = (theory_moment(theory, power, dimension) for power in (1, 2, 3))
    return np.append(_moments(one, two, three), END[theory] / one)


def _moments(one: float, two: float, three: float) -> Array:
    variance = two - one**2
    third = three - 3 * one * two + 2 * one**3
    skewness = third / variance**1.5 if variance > 1e-14 * two else np.nan
    return np.array([np.sqrt(max(variance, 0.0)) / one, skewness, two / one**2, three / (two * one),
                     np.sqrt(two) / one, np.cbrt(three) / one, np.cbrt(three) ** 2 / two - 1])


def histogram(x: Array, edges: Array) -> Array:
    """Densities (len(edges) - 1,) of x (n,); what lies outside counts in the norm."""
    return np.histogram(x, edges)[0] / (len(x) * np.diff(edges))


def apart(numbers: Iterable[int], factor: float) -> list[int]:
    """Indices of frames between which the number of bubbles falls by `factor` or more, the last one always."""
    chosen, least = [], 0.0
    for index, N in reversed(list(enumerate(numbers))):
        if N >= least:
            chosen.append(index)
            least = factor * N
    return chosen[::-1]


@dataclass
class Average:
    """Mean over frames and runs, with its standard error."""

    mean: Array
    error: Array
    how: str


def average(runs: list[list[Array]], errors: list[Array], bubbles: Sequence[int]) -> Average:
    """Over `runs`, each a list of the frames' values. `errors`, `bubbles`: of the frames, if there is one run."""
    means = np.array([np.mean(frames, axis=0) for frames in runs])
    if len(runs) > 1:
        return Average(means.mean(axis=0), means.std(axis=0, ddof=1) / np.sqrt(len(runs)),
                       f"scatter of {len(runs)} runs")
    return Average(means[0], error_of_one_run(np.array(errors), np.asarray(bubbles)),
                   f"bootstrap of the bubbles of {len(bubbles)} frame(s) of one run")


def error_of_one_run(errors: Array, bubbles: Array) -> Array:
    """Standard error of the mean over frames of one run, from the `errors` (frames, ...) of each frame.

    A frame with fewer bubbles has those of a frame before it that are left. If these keep their R/<R>, then means over
    n and m < n of them correlate by sqrt(m / n). Bubbles do change their R/<R>: so this is an upper estimate.
    """
    shared = np.sqrt(np.minimum.outer(bubbles, bubbles) / np.maximum.outer(bubbles, bubbles))
    variance = np.einsum("i...,ij,j...->...", errors, shared, errors)
    return np.asarray(np.sqrt(variance) / len(bubbles))


def bootstrap_error(R: Array, dimension: int, edges: list[Array], samples: int = 200) -> list[Array]:
    """Standard errors of what `measure` gives for one frame, by drawing its bubbles with replacement."""
    rng = np.random.default_rng(1)
    drawn = [measure(rng.choice(R, len(R)), dimension, edges) for _ in range(samples)]
    return [np.std(values, axis=0, ddof=1) for values in zip(*drawn)]


def measure(R: Array, dimension: int, edges: list[Array]) -> tuple[Array, Array, Array]:
    """Histogram of R/<R>, histogram of V/<V>, moments; edges: those of both histograms."""
    x, w = R / R.mean(), R**dimension / np.mean(R**dimension)
    return histogram(x, edges[0]), histogram(w, edges[1]), moments(R)


# ---------------------------------------------------------------- command line

def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_runs(parser, "dumps with the column radius", "sizes")
    add_range(parser, "frames that are averaged", "a quarter of the first number of bubbles to 100")
    parser.add_argument("--apart", type=float, default=1.3, metavar="F",
                        help="factor by which N falls between frames that are used (default: 1.3)")
    parser.add_argument("--bins", type=int, default=30, help="from 0 to the largest R/<R> and V/<V> (default: 30)")
    parser.epilog = ("example: while 3000 to 300 bubbles are left\n"
                     "  lammps-foam sizes seed1 seed2 seed3 --N 3000 300 --out sizes")


def main(args: argparse.Namespace) -> int:
    if args.bins < 2 or not args.apart >= 1:
        raise Unusable(f"--bins {args.bins} must be 2 or more, and --apart {args.apart} must be 1 or more")
    radii, dimension = [], 0
    for path in args.runs:
        R, dimension_here = _radii(path, Range(args.tau, args.N), args.apart)
        if dimension and dimension_here != dimension:
            raise Unusable(f"{path} is {dimension_here}D, the runs before it {dimension}D")
        radii.append(R)
        dimension = dimension_here
    edges = [np.linspace(0, max(3, top), args.bins + 1) for top in _largest(radii, dimension)]
    measured = [[measure(R, dimension, edges) for R in run] for run in radii]
    errors = [bootstrap_error(R, dimension, edges) for R in radii[0]] if len(radii) == 1 else []
    parts = [average([[frame[part] for frame in run] for run in measured],
                     [error[part] for error in errors], [len(R) for R in radii[0]]) for part in range(3)]
    _report(args, radii, dimension, edges, parts)
    return 0


def _radii(path: Path, which: Range, factor: float) -> tuple[list[Array], int]:
    """The radii of the chosen frames of a run."""
    if not which:
        first = next(iter(read_frames(path)), None)
        which = Range(None, [100, len(first) / 4 if first else 100])
    frames = [(frame.radius, frame.box.dimension) for frame, _ in chosen_frames(path, which)]
    frames = [(R, d) for R, d in frames if len(R) > 1]
    if not frames:
        raise Unusable(f"{path} has no frame with two bubbles or more in the range; choose another with --N or --tau")
    return [frames[n][0] for n in apart([len(R) for R, _ in frames], factor)], frames[0][1]


def _largest(radii: list[list[Array]], dimension: int) -> tuple[float, float]:
    """The largest R/<R> and V/<V> of all frames, upward to halves and to whole numbers."""
    x = max(float(R.max() / R.mean()) for run in radii for R in run)
    w = max(float(R.max() ** dimension / np.mean(R**dimension)) for run in radii for R in run)
    return float(np.ceil(2 * x) / 2), float(np.ceil(w))


def _report(args: argparse.Namespace, radii: list[list[Array]], dimension: int, edges: list[Array],
            parts: list[Average]) -> None:
    of_R, of_V, numbers = parts
    theory = {name: theory_moments(name, dimension) for name in THEORIES}
    rows = {"moment": list(MOMENTS), "value": numbers.mean, "error": numbers.error, **theory,
            "meaning": [MEANING[name] for name in MOMENTS]}
    counts = [len(R) for run in radii for R in run]
    table.show(rows)
    print(f"\n{len(counts)} frames of {len(radii)} run(s) in {dimension}D, of {max(counts)} to {min(counts)} bubbles; "
          f"standard errors from the {numbers.how}")
    x, w = ((edge[1:] + edge[:-1]) / 2 for edge in edges)
    columns: dict[str, Array] = {"R": x, "P_R": of_R.mean, "error_R": of_R.error}
    columns |= {f"{name}_R": density_over_mean(name, x, dimension) for name in THEORIES}
    columns |= {"V": w, "P_V": of_V.mean, "error_V": of_V.error}
    columns |= {f"{name}_V": volume_density(name, w, dimension) for name in THEORIES}
    table.write(columns, table.with_end(args.out, ".csv"))
    table.write(rows, table.with_end(args.out, "-moments.csv"))
    _draw(columns, dimension, args.out)


def _draw(columns: dict[str, Array], dimension: int, out: str) -> None:
    fig, axes = figure.panels(1, 2)
    labels = {"lsw": "Lifshitz, Slyozov, Wagner", "lemlich": "Lemlich"}
    for ax, of, density_of in zip(axes, "RV", (density_over_mean, volume_density)):
        shown = columns[f"P_{of}"] > 0
        ax.errorbar(columns[of][shown], columns[f"P_{of}"][shown], columns[f"error_{of}"][shown], fmt="o", color="k",
                    lw=0.7, label="simulation")
        fine = np.linspace(0.002, columns[of][-1], 1500)
        for name, style in zip(THEORIES, ("-", "--")):
            p = density_of(name, fine, dimension)
            ax.plot(fine, np.where(p > 0, p, np.nan), style, label=labels[name], zorder=1)
    axes[0].set(xlabel=r"$R\,/\,\langle R\rangle$", ylabel=r"probability density", ylim=(0, None), xlim=(0, None))
    axes[1].set(xlabel=r"$V\,/\,\langle V\rangle$", yscale="log", xlim=(0, None))
    P = columns["P_V"][columns["P_V"] > 0]
    axes[1].set_ylim(P.min() / 5, 5 * max(P.max(), 1))
    axes[0].legend(loc="upper right")
    figure.save(fig, out)
