"""What a run of tradeoff/in.run prints and writes, and how far two states are apart."""

import re

import numpy as np

from machine import Failed

REACHED = re.compile(r"^reached (?P<until>\S+) rest (?P<rest>\S+) bubbles (?P<N>\d+) radius (?P<R>\S+) "
                     r"square \S+ energy (?P<energy>\S+) evaluations (?P<evaluations>\S+) "
                     r"rejected (?P<rejected>\S+) steps (?P<steps>\S+)", re.M)
LOOP = re.compile(r"^Loop time of (\S+)|^([\d.]+)% CPU use", re.M)


def reached(text):
    """What was printed at each of the times, if they were hit."""
    found = list(REACHED.finditer(text))
    if any(abs(float(one["rest"])) > 1.0e-6 for one in found):
        raise Failed("a step went beyond the time that was to be hit")
    return found


def loop_seconds(text):
    """Seconds of wall clock and processor in the loops of all runs in a piece of output."""
    wall = cpu = last = 0.0
    for loop, share in LOOP.findall(text):
        if loop:
            last = float(loop)
            wall += last
            cpu += last
        else:
            cpu += last * (float(share) / 100.0 - 1.0)
    return wall, cpu


def read_state(path):
    """Columns id, radius, x, y, z of a dump, by id."""
    lines = path.read_text().split("ITEM: ATOMS", 1)[1].split("\n", 1)[1]
    return np.array(lines.split(), float).reshape(-1, 5)


def distribution_distance(a, b):
    """Largest distance of two cumulative distributions (Kolmogorov-Smirnov)."""
    a, b = np.sort(a), np.sort(b)
    at = np.concatenate([a, b])
    return float(np.abs(np.searchsorted(a, at, "right") / len(a) -
                        np.searchsorted(b, at, "right") / len(b)).max())


def errors(state, row, other, other_row, dim):
    """Differences of two states at one time, as columns of the table. Energies are compared
    relatively, but for loose bubbles, which have none, as energies of a bubble."""
    _, i, j = np.intersect1d(state[:, 0], other[:, 0], return_indices=True)
    n, energy = len(other), float(other_row["energy"])
    # the smallest bubbles shrink fastest: how far radii differ on the whole is another matter
    return {
        "error N": abs(len(state) - n) / n,
        "error R": abs(float(row["R"]) / float(other_row["R"]) - 1.0),
        "error energy": abs(float(row["energy"]) - energy) / max(energy, 1.0e-6 * n),
        "error sizes": distribution_distance(state[:, 1], other[:, 1]),
        "error radii": float(np.sqrt(np.mean((state[i, 1] - other[j, 1])**2))),
        "error x": float(np.sqrt(np.mean((state[i, 2:2 + dim] - other[j, 2:2 + dim])**2) * dim)),
    }
