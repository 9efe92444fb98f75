"""What a run of in.microgravity is like in its late states: exponents, contacts, rattlers, sizes, forces.

The late states are those with at most a quarter of the bubbles (LATE). Errors are standard errors:

* exponents: block bootstrap of one run, or scatter of seeds (lammps_foam.analysis.growth);
* contacts, rattlers, share of gas through films: blocks of space of each snapshot (jackknife);
* sizes: bubbles of each snapshot, drawn with replacement;
* means over the snapshots of one run: snapshots share bubbles, and the error allows for it
  (lammps_foam.analysis.sizes.error_of_one_run). Of two or three seeds: the
  larger of this and their scatter. Of more: their scatter.
"""
from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
import re

import numpy as np

from lammps_foam.analysis import contacts, growth, pairs, runs, sizes
from lammps_foam.analysis.read import Frame, Unusable, read_frames

from run import ALL

NAME = re.compile(r"(?P<series>.+)-(?P<fraction>\d\.\d\d)-(?P<seed>\d+)$")
LATE = 4.0                           # late states have so many times fewer bubbles than the start
WIDE = 1.05                          # reach of contacts that is the same for all laws
EDGES = np.linspace(0, 4, 41)        # of R / <R>
MEANS = ("z", "z_wide", "rattlers", "rattlers_gas", "through_films")
SIZES = ("width", "skewness", "polydispersity", "below_0.5", "below_0.3")


@dataclass
class State:
    """One snapshot."""

    N: int
    tau: float
    means: np.ndarray          # MEANS
    means_error: np.ndarray
    sizes: np.ndarray          # SIZES
    sizes_error: np.ndarray
    density: np.ndarray        # of R / <R>, in EDGES
    density_error: np.ndarray
    loose: np.ndarray          # the part of it that is rattlers
    liquid: float              # liquid fraction in which overlaps count once
    imbalance: float           # net force on a bubble over the forces of its contacts, root mean squares
    across: float              # largest diameter over the shortest side of the box


@dataclass
class Foam:
    """Runs of one series at one liquid fraction: their snapshots, and their late states as one row of numbers."""

    series: str
    fraction: float
    states: list[list[State]]      # of each run, the earliest first
    row: dict[str, float]
    density: sizes.Average | None = None
    paths: list[Path] = field(default_factory=list)

    @property
    def scales(self) -> bool:
        """Whether there are late states. Without exchange through the liquid a foam may unjam before."""
        return "1/n" in self.row


def is_late(N: float, first: float) -> bool:
    """Of a snapshot with N bubbles, in a run that begins with `first`, which LATE need not divide: 0.1 %."""
    return N <= first / LATE * 1.001


# ------------------------------------------------------------------ one snapshot

def attraction(series: str) -> float:
    """A of law sticky; 0 without attraction."""
    words = ALL[series][0].split()
    return float(words[1]) if words[0] == "sticky" else 0.0


def force(pair: pairs.Pairs, A: float) -> np.ndarray:
    """Forces of the law, positive if they push apart, in units of sigma0 <R_in>."""
    depth = 1 - pair.distance / pair.sums
    return np.where(depth > -A, depth, np.minimum(-depth - 2 * A, 0.0) if A else 0.0)


def imbalance(pair: pairs.Pairs, A: float, n: int) -> float:
    """Root mean square of the net force on a bubble over that of the forces of its contacts. 0 is rest."""
    f = force(pair, A)
    vector = f[:, None] * pair.vector / pair.distance[:, None]
    net = np.stack([np.bincount(pair.i, v, n) - np.bincount(pair.j, v, n) for v in vector.T])
    all_forces = 2 * np.sum(f**2)
    return float(np.sqrt(np.sum(net**2) / all_forces)) if all_forces > 0 else float("nan")


def lens_volume(pair: pairs.Pairs, radius: np.ndarray) -> float:
    """Volume that lies in two bubbles, summed over pairs that touch."""
    touching = pair.only(pair.distance < pair.sums)
    d, s = touching.distance, touching.sums
    a, b = radius[touching.i], radius[touching.j]
    inside = d <= np.abs(a - b)
    d_safe = np.where(inside, 1.0, d)
    lens = np.pi * (s - d)**2 * (d**2 + 2 * d * s - 3 * (a - b)**2) / (12 * d_safe)
    return float(np.sum(np.where(inside, 4 / 3 * np.pi * np.minimum(a, b)**3, lens)))


def size_numbers(R: np.ndarray) -> np.ndarray:
    """The numbers of SIZES."""
    x = R / R.mean()
    spread, skewness, p = (float(sizes.moments(R)[sizes.MOMENTS.index(name)]) for name in ("spread", "skewness", "p"))
    return np.array([spread, skewness, p, np.mean(x < 0.5), np.mean(x < 0.3)])


def state_of(frame: Frame, tau: float, A: float) -> State:
    x, R = frame.positions, frame.radius
    found = contacts.contacts_of(x, R, frame.box, reach=1 + A)
    wide = contacts.contacts_of(x, R, frame.box, reach=WIDE)
    reach = pairs.close_pairs(x, R, frame.box, 1 + 2 * A)
    loose, one = ~found.backbone, np.ones(len(R))
    film, all_gas = np.abs(frame["vfilm"]), np.abs(frame["vfilm"]) + np.abs(frame["vliquid"])
    means = contacts.Means()
    means.add(frame, np.column_stack([found.number, wide.number, loose, R**3 * loose, film]).astype(float),
              np.column_stack([one, one, one, R**3, all_gas]))
    value, error = means.values()
    rng = np.random.default_rng(1)
    drawn = [rng.choice(R, len(R)) for _ in range(200)]
    density = sizes.histogram(R / R.mean(), EDGES)
    spread = np.std([sizes.histogram(r / r.mean(), EDGES) for r in drawn], axis=0, ddof=1)
    part = np.histogram((R / R.mean())[loose], EDGES)[0] / (len(R) * np.diff(EDGES))
    gas = 4 / 3 * np.pi * np.sum(R**3) - lens_volume(reach, R)
    return State(len(R), tau, value, error, size_numbers(R), np.std([size_numbers(r) for r in drawn], axis=0, ddof=1),
                 density, spread, part, 1 - gas / frame.box.volume, imbalance(reach, A, len(R)),
                 float(2 * R.max() / frame.box.lengths.min()))


def states_of(path: Path, series: str) -> list[State]:
    """Snapshots of a run. One that ended early has the last more than once: it counts once."""
    clock, found = runs.Clock(path), {}
    for frame in map(runs.alive, read_frames(path / "left.lammpstrj")):
        if len(frame) not in found:
            found[len(frame)] = state_of(frame, clock.tau(frame), attraction(series))
    return list(found.values())


# ------------------------------------------------------------------ runs of one series and liquid fraction

def over_states(late: list[list[State]], name: str) -> sizes.Average:
    """Mean of a quantity over the late states, with its error: that of one run, or as growth.over_runs of several."""
    each = [sizes.average([[getattr(state, name) for state in run]], [getattr(state, f"{name}_error") for state in run],
                          [state.N for state in run]) for run in late]
    mean, error = growth.over_runs(np.array([one.mean for one in each]), np.array([one.error for one in each]))
    return sizes.Average(mean, error, f"{len(late)} runs")


def exponents(series: list, start: float, end: float) -> dict[str, float]:
    """Slopes and exponents of <R>; 1/n of the Sauter radius; slopes in the first and the second half of ln tau."""
    fit = growth.fit(series, start, end)
    row = {"beta": fit.beta, "beta_error": fit.beta_error, "1/n": 1 / fit.origin[0],
           "1/n_error": fit.origin_error[0] / fit.origin[0]**2,
           "tau0": fit.origin[1], "tau0_error": fit.origin_error[1]}
    sauter = growth.fit([{**one, "R": one["R32"]} for one in series], start, end)
    row |= {"1/n_R32": 1 / sauter.origin[0], "1/n_R32_error": sauter.origin_error[0] / sauter.origin[0]**2}
    return row


def foam_of(name: str, fraction: float, paths: list[Path]) -> Foam:
    series = runs.read_runs(paths, ["R", "N", "R32", "phi", "energy"])
    states = [states_of(path, name) for path in paths]
    first = series[0]["N"][0]
    row: dict[str, float] = {"runs": len(paths), "bubbles": float(first),
                             "last_N": float(max(s["N"][-1] for s in series)),
                             "last_tau": float(min(s["tau"][-1] for s in series)),
                             "gas_change": float(max(np.max(np.abs(s["phi"] / s["phi"][0] - 1)) for s in series)),
                             "minutes": sum(map(minutes, paths))}
    late = [[state for state in run if is_late(state.N, first)] for run in states]
    if not all(len(run) > 1 for run in late):
        return Foam(name, fraction, states, row, paths=paths)
    start = max(runs.tau_of_N(one, one["N"][0] / LATE) for one in series)
    row |= {"tau_from": start, "tau_to": row["last_tau"]}
    try:
        row |= exponents(series, start, row["last_tau"])
    except Unusable:     # too few lines of the table in the range
        return Foam(name, fraction, states, row, paths=paths)
    for names, kind in ((MEANS, "means"), (SIZES, "sizes")):
        found = over_states(late, kind)
        for column, value, error in zip(names, found.mean, found.error):
            row |= {column: float(value), f"{column}_error": float(error)}
    row["liquid"] = float(np.mean([state.liquid for run in late for state in run]))
    row["imbalance"] = float(np.max([state.imbalance for run in late for state in run]))
    row["across"] = float(np.max([run[-1].across for run in late]))
    return Foam(name, fraction, states, row, over_states(late, "density"), paths)


def minutes(path: Path) -> float:
    found = re.search(r"^Total wall time: (\d+):(\d+):(\d+)", (path / "log.microgravity").read_text(errors="replace"),
                      re.MULTILINE) if (path / "log.microgravity").exists() else None
    return sum(int(part) * unit for part, unit in zip(found.groups(), (60, 1, 1 / 60))) if found else 0.0


def foams_in(directory: Path) -> dict[tuple[str, float], Foam]:
    """Of all complete runs of run.py, by series and liquid fraction."""
    paths: dict[tuple[str, float], list[Path]] = {}
    for done in sorted(directory.glob("*/complete")):
        match = NAME.match(done.parent.name)
        if match and match["series"] in ALL:
            paths.setdefault((match["series"], float(match["fraction"])), []).append(done.parent)
    return {key: foam_of(*key, found) for key, found in sorted(paths.items())}
