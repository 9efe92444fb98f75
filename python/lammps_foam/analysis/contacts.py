"""Contacts and rattlers: mean number of contacts in time, distribution of contacts, and both against size.

Bubbles touch where r < R_i + R_j (--reach for attractive shells, as law sticky has them). A rattler has fewer than
d + 1 contacts (--least) once all other rattlers have been taken out: they are removed again and again until none is
left. What is left is the backbone; its mean z counts contacts between bubbles of the backbone. A face of the box that
is not periodic is a wall, and counts as a contact where it cuts a bubble.

Errors are standard errors (one sigma): of all runs together, by leaving out one block of space after the other
(jackknife; 4 x 4 blocks in 2D, 3 x 3 x 3 in 3D). They contain that the gas fraction differs from block to block, which
that of the whole box does not: a little too large, rather than too small.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from . import figure, table
from .frames import STATES, add_every, phi_of, selected, time_axis
from .pairs import Index, Pairs, blocks, checked, close_pairs, jackknife
from .read import Array, Box, Frame, Unusable
from .runs import Range, add_range, add_runs

BLOCKS = {2: 4, 3: 3}    # along each edge of the box
Mask = NDArray[np.bool_]


# ---------------------------------------------------------------- one state

@dataclass
class Contacts:
    """Contacts of a state of n bubbles."""

    number: Index        # (n,): with bubbles and walls
    backbone: Mask       # (n,): no rattler
    inner: Index         # (n,): contacts with the backbone and walls; 0 for rattlers

    @property
    def z(self) -> float:
        """Mean number of contacts, of all bubbles."""
        return float(self.number.mean())

    @property
    def z_backbone(self) -> float:
        """Mean number of contacts in the backbone; nan if there is none."""
        count = np.count_nonzero(self.backbone)
        return float(self.inner.sum() / count) if count else float("nan")


def wall_contacts(x: Array, radius: Array, box: Box) -> Index:
    """(n,): how many faces of the box that are not periodic are nearer than R."""
    number = np.zeros(len(x), dtype=np.intp)
    if np.any(box.tilt) and not box.periodic[:box.dimension].all():
        raise Unusable("walls of a tilted box are not known here; add --no-walls")
    for axis in range(box.dimension):
        if not box.periodic[axis]:
            number += (x[:, axis] - box.lo[axis] < radius).astype(np.intp)
            number += (box.hi[axis] - x[:, axis] < radius).astype(np.intp)
    return number


def without_rattlers(pairs: Pairs, walls: Index, least: int) -> tuple[Mask, Index]:
    """Who is left when bubbles with fewer than `least` contacts are taken out until there are none.

    walls (n,): contacts with walls. Returns a mask (n,), and (n,) contacts with those left and with walls, 0 for
    rattlers.
    """
    n = len(walls)
    left = np.ones(n, dtype=bool)
    while True:
        inner = left[pairs.i] & left[pairs.j]
        number = np.where(left, pairs.only(inner).per_bubble(n) + walls, 0)
        loose = left & (number < least)
        if not loose.any():
            return left, number
        left &= ~loose


def contacts_of(x: Array, radius: Array, box: Box, *, least: int | None = None, reach: float = 1.0,
                walls: bool = True) -> Contacts:
    """Contacts of bubbles at x (n, 3) with radius (n,); `least` is d + 1 if it is None."""
    pairs = close_pairs(x, radius, box, reach)
    faces = wall_contacts(x, radius, box) if walls else np.zeros(len(x), dtype=np.intp)
    backbone, inner = without_rattlers(pairs, faces, box.dimension + 1 if least is None else least)
    return Contacts(pairs.per_bubble(len(x)) + faces, backbone, inner)


# ---------------------------------------------------------------- means with errors

def sums_in(block: Index, count: int, values: Array) -> Array:
    """(count, k): sums over blocks of the columns of values (n, k)."""
    return np.stack([np.bincount(block, column, count) for column in values.T], axis=1)


class Means:
    """Means of a group of quantities, each a ratio of sums over bubbles; from blocks of one state or more."""

    def __init__(self) -> None:
        self.above: list[Array] = []
        self.below: list[Array] = []

    def add(self, frame: Frame, above: Array, below: Array) -> None:
        """above, below (n, k): what each bubble adds to numerators and denominators."""
        each = BLOCKS[frame.box.dimension]
        block, count = blocks(frame.positions, frame.box, each), each**frame.box.dimension
        self.above.append(sums_in(block, count, above))
        self.below.append(sums_in(block, count, below))

    def values(self) -> tuple[Array, Array]:
        """Means (k,) and their errors (k,)."""
        return jackknife(np.concatenate(self.above), np.concatenate(self.below))


def whole(frame: Frame, found: Contacts) -> Means:
    """z, z of the backbone, share of rattlers, share without contacts."""
    means, one = Means(), np.ones(len(frame))
    above = np.column_stack([found.number, found.inner, ~found.backbone, found.number == 0]).astype(float)
    means.add(frame, above, np.column_stack([one, found.backbone, one, one]).astype(float))
    return means


def binned(values: Array, where: Index, count: int) -> tuple[Array, Array]:
    """(n, count) twice: values (n,) in the column `where` of their bin, and 1 there."""
    inside = (where >= 0) & (where < count)
    below = np.zeros((len(values), count))
    below[np.flatnonzero(inside), where[inside]] = 1.0
    return below * values[:, None], below


# ---------------------------------------------------------------- command line

def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_runs(parser, STATES, "contacts")
    add_range(parser, "frames to look at; distributions are those of the last of them", "all")
    add_every(parser)
    parser.add_argument("--least", type=int, metavar="Z",
                        help="a bubble with fewer contacts is a rattler (default: d + 1)")
    parser.add_argument("--reach", type=float, default=1.0, metavar="F",
                        help="contact where r < F (R_i + R_j); 1 + 2 A for law sticky A (default: 1)")
    parser.add_argument("--no-walls", action="store_true", help="walls do not count as contacts")
    parser.epilog = ("also writes BASE-distribution.csv and BASE-size.csv\n"
                     "example: contacts while 5000 to 500 bubbles are left\n"
                     "  lammps-foam contacts DIR --N 5000 500 --out contacts")


def main(args: argparse.Namespace) -> int:
    if not args.reach > 0:
        raise Unusable(f"--reach {args.reach:g} must be above 0")
    if args.least is not None and args.least < 0:
        raise Unusable(f"--least {args.least} must be 0 or more")
    rows: list[list[float]] = []
    last: dict[int, tuple[Frame, Contacts]] = {}
    for run, frame, tau in selected(args.runs, Range(args.tau, args.N), args.every):
        x, radius = checked(frame)
        found = contacts_of(x, radius, frame.box, least=args.least, reach=args.reach, walls=not args.no_walls)
        value, error = whole(frame, found).values()
        pieces = [item for pair in zip(value, error) for item in pair]
        rows.append([run + 1, frame.step, tau, len(frame), phi_of(frame), *pieces])
        last[run] = frame, found
    names = ["run", "step", "tau", "N", "phi", "z", "z_error", "z_backbone", "z_backbone_error", "rattlers",
             "rattlers_error", "loose", "loose_error"]
    times = dict(zip(names, np.array(rows).T))
    shares, sizes = distribution(list(last.values())), against_size(list(last.values()))
    for name, columns in (("", times), ("-distribution", shares), ("-size", sizes)):
        table.write(columns, table.with_end(args.out, f"{name}.csv"))
    table.show(times)
    print()
    table.show(shares)
    print()
    table.show(sizes)
    _draw(times, shares, sizes, args.out)
    return 0


def distribution(states: list[tuple[Frame, Contacts]]) -> dict[str, Array]:
    """Columns z, share, error: shares of all bubbles with z contacts, over states."""
    most = max(int(found.number.max()) for _, found in states)
    means = Means()
    for frame, found in states:
        _, below = binned(np.ones(len(frame)), found.number, most + 1)
        means.add(frame, below, np.ones_like(below))
    share, error = means.values()
    return {"z": np.arange(most + 1.0), "share": share, "error": error}


def against_size(states: list[tuple[Frame, Contacts]], width: float = 0.25) -> dict[str, Array]:
    """Columns R/<R> (middle of a bin), bubbles, z, z_error, rattlers, rattlers_error, over states."""
    sizes = [frame.radius / frame.radius.mean() for frame, _ in states]
    count = int(max(size.max() for size in sizes) / width) + 1
    z, loose, bubbles = Means(), Means(), np.zeros(count)
    for (frame, found), size in zip(states, sizes):
        where = (size / width).astype(np.intp)
        z.add(frame, *binned(found.number.astype(float), where, count))
        loose.add(frame, *binned((~found.backbone).astype(float), where, count))
        bubbles += np.bincount(where, minlength=count)
    columns: dict[str, Array] = {"R/<R>": np.asarray(width * (np.arange(count) + 0.5)), "bubbles": bubbles}
    columns["z"], columns["z_error"] = z.values()
    columns["rattlers"], columns["rattlers_error"] = loose.values()
    return {name: column[bubbles > 0] for name, column in columns.items()}


def _draw(times: dict[str, Array], shares: dict[str, Array], sizes: dict[str, Array], out: str) -> None:
    fig, (top, right, low, last) = figure.panels(2, 2, height=2.2)
    x = time_axis([top, right], times["tau"], times["step"])
    for ax, names in ((top, {"z": "all", "z_backbone": "backbone"}),
                      (right, {"rattlers": "rattlers", "loose": "no contact"})):
        for (name, label), marker in zip(names.items(), "os"):
            ax.errorbar(x, times[name], times[f"{name}_error"], fmt=marker, label=label, lw=0.8)
        ax.margins(y=0.25)    # room for the legend
        ax.legend(ncols=2, loc="upper center")
    top.set(ylabel=r"mean contacts $z$")
    right.set(ylabel="share of bubbles", ylim=(0, None))
    low.bar(shares["z"], shares["share"], yerr=shares["error"], width=0.8, color="C0", ecolor="k", error_kw={"lw": 0.8})
    low.set(xlabel=r"contacts $z$", ylabel="share of bubbles")
    enough = sizes["bubbles"] >= 5
    size = sizes["R/<R>"][enough]
    last.errorbar(size, sizes["z"][enough], sizes["z_error"][enough], fmt="o", color="C0", lw=0.8)
    last.set(xlabel=r"$R\,/\,\langle R\rangle$")
    last.set_ylabel(r"mean contacts $z$", color="C0")
    other = last.twinx()
    last.tick_params(right=False, which="both")
    other.errorbar(size, sizes["rattlers"][enough], sizes["rattlers_error"][enough], fmt="s", color="C1", lw=0.8)
    other.set_ylabel("share of rattlers", color="C1")
    figure.save(fig, out)
