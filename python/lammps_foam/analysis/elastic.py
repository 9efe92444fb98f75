"""Pressure and elastic moduli of a packing of bubbles with the law spring.

The force of a contact is f = k overlap, with k = sigma0 <R_in> / (R_i + R_j); its energy is k overlap^2 / 2 (Durian,
Phys. Rev. Lett. 75, 4780 (1995)). Bubbles have no kinetic part, so the pressure is the virial, p = sum f r / (d V).

Moduli are those of linear response, at infinitesimal strain: with a strain e, bubbles move with the box and relax
besides by u, until they are at rest again. The second derivative of the energy is E_ee - E_eu E_uu^-1 E_ue: the affine
part less what the bubbles' own motion relaxes (Lutsko, J. Appl. Phys. 65, 2991 (1989); Lemaitre & Maloney, J. Stat.
Phys. 123, 415 (2006)). A contact adds k n n - (f / r)(1 - n n) to the Hessian E_uu, so the pressure is in it.

shear     mean over the directions of shear (2 in 2D, 5 in 3D: simple and pure shear at constant volume)
low high  the least and the largest of them: a packing is isotropic only if it is large
bulk      - V dp/dV

Rattlers (see `lammps-foam contacts`) are taken out for the moduli. What may still move freely, such as the packing as a
whole, carries no force and does not matter. A state has to be at rest: `residual` is the root mean square of the net
force on a bubble over the mean force of a contact, and `lowest` the lowest eigenvalue of the Hessian over its mean
diagonal. With a residual above 1e-3, or an eigenvalue below 0, the moduli are not those of a packing. --relax brings a
state to rest first, without exchange of gas and in the box as it is. It is for packings of some hundred bubbles: bring
larger ones to rest in LAMMPS, by relax_foam or minimize.

The pressure's error is a standard error by leaving out one block of space after the other; that of the moduli is known
only from several packings: the last lines have the means over runs and their standard errors.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
import sys

import numpy as np
from scipy import sparse
from scipy.optimize import minimize
from scipy.sparse.linalg import ArpackError, SuperLU, eigsh, splu

from . import figure, table
from .contacts import BLOCKS, without_rattlers
from .frames import STATES, add_every, phi_of, selected, time_axis
from .pairs import Pairs, blocks, checked, close_pairs, jackknife
from .read import Array, Box, Frame, Unusable
from .runs import Clock, Range, add_range, add_runs

REST = 1.0e-3           # residual up to which a state counts as at rest
NEAR = 1.0e-5           # residual from which Newton's method takes over
SKIN = 1.3              # of the list of neighbours that relaxing uses: pairs up to SKIN (R_i + R_j)
REGULAR = 1.0e-12       # added to the Hessian, over its mean diagonal: what moves freely stays where it is


# ---------------------------------------------------------------- forces, energy, pressure

def contact_forces(pairs: Pairs, spring: float) -> tuple[Array, Array]:
    """k and f of pairs (m,); spring = sigma0 <R_in>. f = 0 where bubbles do not touch."""
    k = spring / pairs.sums
    return k, k * np.maximum(pairs.sums - pairs.distance, 0.0)


def energy(pairs: Pairs, spring: float) -> float:
    """Sum of k overlap^2 / 2."""
    k, f = contact_forces(pairs, spring)
    return float(np.sum(f**2 / (2 * k)))


def net_forces(pairs: Pairs, spring: float, n: int) -> Array:
    """(n, 3): the force on each bubble."""
    _, f = contact_forces(pairs, spring)
    pull = (f / pairs.distance)[:, None] * pairs.vector
    return np.stack([np.bincount(pairs.i, column, n) - np.bincount(pairs.j, column, n) for column in pull.T], axis=1)


def pressure(pairs: Pairs, spring: float, box: Box) -> float:
    """Virial pressure, sum f r / (d V)."""
    _, f = contact_forces(pairs, spring)
    return float(np.sum(f * pairs.distance) / (box.dimension * box.volume))


def pressure_error(pairs: Pairs, spring: float, x: Array, box: Box) -> float:
    """Standard error of the pressure by blocks of space; half a contact's virial goes to either bubble."""
    d = box.dimension
    _, f = contact_forces(pairs, spring)
    block, count = blocks(x, box, BLOCKS[d]), BLOCKS[d]**d
    half = f * pairs.distance / (2 * d)
    above = np.asarray(np.bincount(block[pairs.i], half, count) + np.bincount(block[pairs.j], half, count), dtype=float)
    return float(jackknife(above, np.full(count, box.volume / count))[1])


# ---------------------------------------------------------------- moduli

@dataclass
class Moduli:
    """Shear moduli by direction, bulk modulus, lowest eigenvalue of the Hessian over its mean diagonal, backbone."""

    shears: Array
    bulk: float
    lowest: float
    bubbles: int        # in the backbone

    @property
    def shear(self) -> float:
        """Mean over directions."""
        return float(self.shears.mean())


def directions(d: int) -> list[Array]:
    """Shears of unit size (d, d), orthogonal, at constant volume; the box is deformed by exp(e A)."""
    shears = []
    for a in range(d):
        for b in range(a):
            shear = np.zeros((d, d))
            shear[b, a] = 1.0
            shears.append(shear)
    shears.append(np.diag([0.5, -0.5, 0.0][:d]))
    if d == 3:
        shears.append(np.diag([1.0, 1.0, -2.0]) / np.sqrt(12))    # the same sum of squares as (1/2, -1/2, 0)
    return shears


def backbone(pairs: Pairs, n: int, d: int) -> tuple[Pairs, int]:
    """The contacts of the backbone, with bubbles numbered anew from 0, and how many those are."""
    left, _ = without_rattlers(pairs, np.zeros(n, dtype=np.intp), d + 1)
    number = np.cumsum(left) - 1
    inner = pairs.only(left[pairs.i] & left[pairs.j])
    return Pairs(number[inner.i], number[inner.j], inner.vector, inner.sums), int(np.count_nonzero(left))


def blocks_of_contacts(pairs: Pairs, spring: float, d: int) -> Array:
    """(m, d, d): second derivatives of the energy of each contact by its vector, k n n - (f / r)(1 - n n)."""
    k, f = contact_forces(pairs, spring)
    r = pairs.distance
    n = pairs.vector[:, :d] / r[:, None]
    along = n[:, :, None] * n[:, None, :]
    return np.asarray(k[:, None, None] * along - (f / r)[:, None, None] * (np.eye(d) - along))


def hessian(pairs: Pairs, block: Array, n: int) -> sparse.csc_matrix:
    """Second derivatives of the energy by the bubbles' positions, (n d, n d)."""
    d = block.shape[1]
    rows, columns, values = [], [], []
    for a, b, sign in ((pairs.i, pairs.i, 1), (pairs.j, pairs.j, 1), (pairs.i, pairs.j, -1), (pairs.j, pairs.i, -1)):
        rows.append((d * a[:, None, None] + np.arange(d)[:, None] + np.zeros((1, d), dtype=np.intp)).ravel())
        columns.append((d * b[:, None, None] + np.arange(d)[None, :] + np.zeros((d, 1), dtype=np.intp)).ravel())
        values.append(sign * block.ravel())
    return sparse.csc_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))),
                             shape=(n * d, n * d))


def moduli(pairs: Pairs, spring: float, n: int, box: Box, with_lowest: bool = True) -> Moduli:
    """Moduli of the packing of n bubbles with these contacts."""
    d, volume, p = box.dimension, box.volume, pressure(pairs, spring, box)
    pairs, count = backbone(pairs, n, d)
    if count == 0:
        return Moduli(np.zeros(len(directions(d))), 0.0, float("nan"), 0)
    block = blocks_of_contacts(pairs, spring, d)
    H = hessian(pairs, block, count)
    scale = H.diagonal().mean()
    solve = splu(H + REGULAR * scale * sparse.identity(count * d, format="csc"))
    second = [second_derivative(A, pairs, block, spring, count, solve) for A in (*directions(d), np.eye(d))]
    # E(e) with all lengths times exp(e): E' = - d p V, so - V dp/dV = E'' / (d^2 V) + p
    bulk = second[-1] / (d**2 * volume) + p
    lowest = lowest_eigenvalue(H, d) / scale if with_lowest else float("nan")
    return Moduli(np.array(second[:-1]) / volume, bulk, lowest, count)


def second_derivative(A: Array, pairs: Pairs, block: Array, spring: float, n: int, solve: SuperLU) -> float:
    """d^2 E / d e^2 of the relaxed packing, when the box is deformed by exp(e A)."""
    d = len(A)
    _, f = contact_forces(pairs, spring)
    vector = pairs.vector[:, :d]
    moved = vector @ A.T                                  # d vector / d e
    pull = np.einsum("mij,mj->mi", block, moved)          # d force / d e, with the sign of the energy's gradient
    curved = vector @ (A @ A).T                           # d^2 vector / d e^2
    slope = -(f / pairs.distance)[:, None] * vector       # d energy / d vector
    affine = float(np.sum(moved * pull) + np.sum(slope * curved))
    push = np.zeros((n, d))
    for axis in range(d):
        push[:, axis] = np.bincount(pairs.i, pull[:, axis], n) - np.bincount(pairs.j, pull[:, axis], n)
    push -= push.mean(axis=0)                             # rounding: nothing pushes the whole
    return affine - float(push.ravel() @ solve.solve(push.ravel()))


def lowest_eigenvalue(H: sparse.csc_matrix, d: int) -> float:
    """The lowest eigenvalue but the d of a packing that moves as a whole, which are 0; nan if it is not found."""
    if H.shape[0] <= 4 * d:
        return float(np.linalg.eigvalsh(H.toarray())[d])
    shift = -1.0e-6 * H.diagonal().mean()
    try:
        values = eigsh(H, k=d + 1, sigma=shift, which="LM", return_eigenvectors=False)
    except (ArpackError, RuntimeError):
        return float("nan")
    values = values[np.argsort(np.abs(values))]
    return float(values[d])


# ---------------------------------------------------------------- at rest

def residual(pairs: Pairs, spring: float, n: int) -> float:
    """Root mean square of the net force on bubbles over the mean force of contacts; 0 without contacts."""
    _, f = contact_forces(pairs, spring)
    if not np.any(f > 0):
        return 0.0
    return float(np.sqrt(np.mean(np.sum(net_forces(pairs, spring, n)**2, axis=1))) / f[f > 0].mean())


def relaxed(x: Array, radius: Array, box: Box, spring: float, rest: float = 1.0e-6, rounds: int = 50) -> Array:
    """Positions (n, 3) at rest: L-BFGS until nearly at rest, then Newton's method.

    Stops when the residual is below `rest`, or after `rounds` of each: the caller has to look at the residual.
    """
    for _ in range(rounds):
        pairs = close_pairs(x, radius, box)
        if residual(pairs, spring, len(x)) < max(rest, NEAR):
            break
        x = _descended(x, radius, box, spring)
    for _ in range(rounds):
        pairs = close_pairs(x, radius, box)
        now = residual(pairs, spring, len(x))
        if now < rest:
            break
        x_new = x + _newton_step(pairs, spring, len(x), box.dimension)
        if not residual(close_pairs(x_new, radius, box), spring, len(x)) < now:
            break
        x = x_new
    return x


def _descended(x: Array, radius: Array, box: Box, spring: float) -> Array:
    """Positions after L-BFGS within what the list of neighbours allows: pairs up to SKIN (R_i + R_j)."""
    d, n = box.dimension, len(x)
    near = close_pairs(x, radius, box, SKIN)
    _, f = contact_forces(near, spring)
    limit = (SKIN - 1) * np.quantile(radius, 0.1)    # a smaller bubble may slip into another: the next round finds it

    def energy_and_slope(u: Array) -> tuple[float, Array]:
        move = np.zeros((n, 3))
        move[:, :d] = u.reshape(n, d)
        now = Pairs(near.i, near.j, near.vector + move[near.i] - move[near.j], near.sums)
        return energy(now, spring), -net_forces(now, spring, n)[:, :d].ravel()

    found = minimize(energy_and_slope, np.zeros(n * d), jac=True, method="L-BFGS-B", bounds=[(-limit, limit)] * (n * d),
                     options={"maxiter": 1000, "maxfun": 2000, "ftol": 0.0, "maxcor": 20,
                              "gtol": 0.1 * NEAR * float(f[f > 0].mean())})
    moved = x.copy()
    moved[:, :d] += found.x.reshape(n, d)
    return moved


def _newton_step(pairs: Pairs, spring: float, n: int, d: int) -> Array:
    """(n, 3): where the forces would be 0; bubbles that nothing holds stay."""
    H = hessian(pairs, blocks_of_contacts(pairs, spring, d), n)
    H = H + REGULAR * 1.0e3 * H.diagonal().mean() * sparse.identity(n * d, format="csc")
    step = np.zeros((n, 3))
    step[:, :d] = splu(H).solve(net_forces(pairs, spring, n)[:, :d].ravel()).reshape(n, d)
    return step


# ---------------------------------------------------------------- command line

def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_runs(parser, STATES, "elastic")
    add_range(parser, "frames to look at", "the last frame")
    add_every(parser)
    parser.add_argument("--sigma0", type=float, default=1.0, help="spring constant, that of pair_coeff (default: 1)")
    parser.add_argument("--rin", type=float, help="<R_in>, the mean radius at the start of everything (default: from "
                        "series.csv beside the dump)")
    parser.add_argument("--stress", nargs="+", metavar="NAME", help="columns sxx syy [szz] of compute stress/atom NULL "
                        "virial: the pressure by LAMMPS, in the column p_dump")
    parser.add_argument("--relax", action="store_true", help="bring each state to rest first")
    parser.add_argument("--largest", type=int, default=30000, metavar="N",
                        help="of more bubbles only the pressure, as moduli take long and much memory (default: 30000)")
    parser.epilog = ("example: moduli of the last state of three runs\n"
                     "  lammps-foam elastic seed1 seed2 seed3 --relax --out elastic")


def main(args: argparse.Namespace) -> int:
    if not args.sigma0 > 0 or (args.rin is not None and not args.rin > 0):
        raise Unusable("--sigma0 and --rin must be above 0")
    which, rows = Range(args.tau, args.N), []
    last: dict[int, tuple[Frame, float]] = {}
    for run, frame, tau in selected(args.runs, which, args.every):
        if which:
            rows.append([run + 1.0, *_row(args, run, frame, tau)])
        last[run] = frame, tau
    if not which:
        rows = [[run + 1.0, *_row(args, run, frame, tau)] for run, (frame, tau) in last.items()]
    names = ["run", "step", "tau", "N", "phi", "p", "p_error", "p_dump", "shear", "low", "high", "bulk", "backbone",
             "residual", "lowest"]
    columns = dict(zip(names, np.array(rows).T))
    table.show(columns)
    _means(columns, len(args.runs))
    table.write(columns, table.with_end(args.out, ".csv"))
    _draw(columns, args.out)
    return 0


def _row(args: argparse.Namespace, run: int, frame: Frame, tau: float) -> list[float]:
    box, d, n = frame.box, frame.box.dimension, len(frame)
    if not box.periodic[:d].all():
        raise Unusable(f"{frame.path}, step {frame.step}: moduli need a box that is periodic in all directions")
    x, radius = checked(frame)
    rin = Clock(args.runs[run]).start_radius(frame) if args.rin is None else args.rin
    if not np.isfinite(rin):
        raise Unusable(f"<R_in> is not known: there is no series.csv with the columns step and R beside {frame.path}; "
                       "give --rin")
    spring = args.sigma0 * rin
    if args.relax:
        print(f"step {frame.step}: bringing {n} bubbles to rest", file=sys.stderr, flush=True)
        x = relaxed(x, radius, box, spring)
    pairs = close_pairs(x, radius, box)
    if np.any(pairs.distance == 0):
        raise Unusable(f"{frame.path}, step {frame.step}: two bubbles have the same centre")
    p_dump = _pressure_of(args.stress, frame) if args.stress else float("nan")
    found = Moduli(np.full(1, np.nan), float("nan"), float("nan"), 0) if n > args.largest else moduli(
        pairs, spring, n, box)
    return [frame.step, tau, n, phi_of(frame), pressure(pairs, spring, box), pressure_error(pairs, spring, x, box),
            p_dump, found.shear, found.shears.min(), found.shears.max(), found.bulk, found.bubbles / n,
            residual(pairs, spring, n), found.lowest]


def _pressure_of(names: list[str], frame: Frame) -> float:
    """- sum of the stresses of bubbles over d V: compute stress/atom is a stress times a volume."""
    d = frame.box.dimension
    if len(names) != d:
        raise Unusable(f"--stress {' '.join(names)} must be {d} columns for a {d}D foam")
    return float(-sum(frame[name].sum() for name in names) / (d * frame.box.volume))


def _means(columns: dict[str, Array], runs: int) -> None:
    """Means over runs, where each has one state."""
    bad = (columns["residual"] > REST) | (columns["lowest"] < 0)
    if bad.any():
        print(f"\n{np.count_nonzero(bad)} of {len(bad)} states are not at rest (residual above {REST:g}, or lowest "
              "below 0): their moduli are not those of a packing; add --relax")
    if runs > 1 and len(columns["run"]) == runs:
        print(f"\nmeans over {runs} runs and their standard errors")
        for name in ("p", "shear", "bulk"):
            values = columns[name]
            print(f"  {name:<6} {table.with_error(float(values.mean()), float(values.std(ddof=1) / np.sqrt(runs)))}")


def _draw(columns: dict[str, Array], out: str) -> None:
    fig, (ax,) = figure.panels()
    one = len(columns["run"]) == len(set(columns["run"]))
    x = columns["phi"] if one else time_axis([ax], columns["tau"], columns["step"])
    if one:
        ax.set_xlabel(r"gas fraction $\phi$")
    ax.errorbar(x, columns["p"], columns["p_error"], fmt="o", lw=0.8, label="pressure")
    reach = np.abs(np.stack([columns["shear"] - columns["low"], columns["high"] - columns["shear"]]))
    ax.errorbar(x, columns["shear"], reach, fmt="s", lw=0.8, label="shear modulus (all directions)")
    ax.plot(x, columns["bulk"], "^", label="bulk modulus")
    values = np.concatenate([columns[name] for name in ("p", "shear", "bulk")])
    values = values[np.isfinite(values)]
    ax.set(ylabel="units of LAMMPS")
    if np.all(values > 0):
        ax.set(yscale="log", ylim=(values.min() / 2, values.max() * 8))
    ax.legend(loc="upper right")
    figure.save(fig, out)
