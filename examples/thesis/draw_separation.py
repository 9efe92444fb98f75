"""Figures 4.6 to 4.14: does the liquid separate? States, energy, growth, paths of bubbles, rates, energies of bubbles.

A foam has separated where dense is beside dense at the scale of a 10 x 10 grid (clustering, lammps-foam fraction -h),
and where there are gaps: small cells, four mean radii wide, that are less than half full.
"""
from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

import separation_figures
from common import LATE, Place, Result, late, tables, with_error
from lammps_foam.analysis import fraction, growth, rates, runs
from lammps_foam.analysis.motion import Followed
from lammps_foam.analysis.read import Frame, read_frames
from separation_figures import label_of

CELLS = 10           # the thesis' grid
FEWEST = 1000        # bubbles, ten in a cell: fewer tell nothing
FALL = 1.15          # so many times fewer bubbles are in the next frame that is looked at
EMPTY = 0.5          # a small cell with less gas is a gap
SEEN = 1.0e-3        # of the area in gaps: from here on a picture shows them
STATES = (8.0, 30.0, 100.0)    # so many times fewer bubbles than at the start are in the states that are shown
FOLLOWED = (6.0, 70.0)         # the same of the first and last state between which bubbles are followed
REGIONS = 30         # along an edge: cells by whose gas fraction bubbles are told apart
CLASSES = (0.0, 0.70, 0.82, 0.86)    # lower ends
K = 1.0e-3

@dataclass
class Survey:
    """What is kept of the frames of a run."""

    name: str
    rows: list[dict[str, float]] = field(default_factory=list)
    states: list[tuple[float, Frame, np.ndarray]] = field(default_factory=list)    # tau, frame, small cells
    tracks: list[tuple[float, np.ndarray, np.ndarray]] = field(default_factory=list)    # tau, ids, displacements
    start: Frame | None = None                                         # of the tracks
    rates: list[rates.Rates] = field(default_factory=list)


def draw(place: Place, names: list[str]) -> list[Result]:
    surveys, order = [survey(place, name) for name in names], separation_figures.ORDER
    rows = place.merge([{"run": label_of(one.name), **row} for one in surveys for row in one.rows], "separation", order)
    place.merge([line for one in surveys for line in shown(one)], "separation-table", order)
    place.merge([line for one in surveys for tau, frame, _ in one.states[:1] for line in gas(one.name, tau, frame)],
                "separation-gas-table", order)
    separation_figures.draw_spread(place, rows)
    separation_figures.draw(place, surveys)
    return results(place, names, surveys)


# ------------------------------------------------------------------ one pass over the frames of a run

def frames_of(place: Place, name: str):
    """(tau, frame) of the snapshots of a run, each with fewer bubbles than the one before by the factor FALL."""
    clock, next_N = runs.Clock(place.run(name)), np.inf
    for frame in read_frames(place.run(name)):
        if len(frame) <= next_N:
            next_N = len(frame) / FALL
            yield clock.tau(frame), frame


def survey(place: Place, name: str) -> Survey:
    kept, first, bubbles, next_rates, start = Survey(name), 0, None, np.inf, None
    for tau, frame in frames_of(place, name):
        first = first or len(frame)
        left = first / len(frame)
        if len(frame) >= FEWEST:
            row, local = grid(tau, frame)
            start = local if start is None else start
            kept.rows.append({**row, "like_start": float(np.corrcoef(start.ravel(), local.ravel())[0, 1])})
        if len(kept.states) < len(STATES) and left >= STATES[len(kept.states)]:
            kept.states.append((tau, frame, small_cells(frame)[0]))
        if FOLLOWED[0] <= left <= FOLLOWED[1]:
            bubbles = follow(kept, bubbles, tau, frame)
        if left >= LATE and len(frame) <= next_rates:
            kept.rates.append(rates.from_column(frame, K))
            next_rates = len(frame) / 1.5
    return kept


def follow(kept: Survey, bubbles: Followed | None, tau: float, frame: Frame) -> Followed:
    if bubbles is None:
        bubbles, kept.start = Followed(frame), frame
    else:
        bubbles.go_on(frame)
    kept.tracks.append((tau, bubbles.id, bubbles.displacement[:, :2]))
    return bubbles


def small_cells(frame: Frame) -> tuple[np.ndarray, int]:
    """Gas fraction of small cells, and how many of them lie along an edge of a cell of the grid."""
    split = fraction.splits(frame.radius, frame.box, (CELLS, CELLS))
    return fraction.local_fraction(frame.positions, frame.radius, frame.box, (split * CELLS, split * CELLS)), split


def grid(tau: float, frame: Frame) -> tuple[dict[str, float], np.ndarray]:
    """Spread over the cells of the grid, what it would be if small cells were dealt at random, gaps; and the cells."""
    fine, split = small_cells(frame)
    local = fraction.coarser(fine, split)
    spread, spread_error = fraction.spread(local)
    clustering, clustering_error = fraction.clustering(fine, split)
    gap = fine < EMPTY
    return {"tau": tau, "N": len(frame), "spread": spread, "spread_error": spread_error,
            "dealt": spread / clustering, "clustering": clustering, "clustering_error": clustering_error,
            "gaps": float(np.mean(gap)), "outside": float(np.mean(fine[~gap]))}, local


# ------------------------------------------------------------------ tables

def shown(one: Survey) -> list[dict[str, str]]:
    """Lines at the start, where gaps are largest, at the states that are shown, and the last."""
    chosen = [0.0, max(one.rows, key=lambda row: row["gaps"])["tau"], *(tau for tau, *_ in one.states), np.inf]
    rows = [row for row in one.rows if any(row is nearest(one, tau) for tau in chosen)]
    return [{"run": label_of(one.name), ":math:`\\tau`": f"{row['tau']:.0f}", "bubbles": f"{row['N']:.0f}",
             "spread": with_error(row["spread"], row["spread_error"]),
             "dealt at random": f"{row['dealt']:.4f}",
             "clustering": with_error(row["clustering"], row["clustering_error"]),
             "gaps [%]": f"{100 * row['gaps']:.2f}",
             "outside gaps": f"{row['outside']:.3f}", "like the start": f"{row['like_start']:.2f}"} for row in rows]


def gas(name: str, tau: float, frame: Frame) -> list[dict[str, str]]:
    """Bubbles by the gas fraction around them: sizes, contacts, and whether they gain gas, as a group."""
    places = (frame.positions[:, :2] - frame.box.lo[:2]) / frame.box.lengths[:2] * REGIONS
    x, y = np.clip(places.astype(int), 0, REGIONS - 1).T
    local = fraction.local_fraction(frame.positions, frame.radius, frame.box, (REGIONS, REGIONS))[x, y]
    R, gain = frame.radius, 2 * np.pi * frame.radius * frame["rdot"] / K
    rows = []
    for low, high in zip(CLASSES, (*CLASSES[1:], np.inf)):
        here = (local >= low) & (local < high)
        if np.count_nonzero(here) >= rates.FEWEST:
            rows.append({"run": label_of(name), ":math:`\\tau`": f"{tau:.0f}",
                         "local gas fraction": f"{low:.2f} to {high:.2f}" if high < np.inf else f"above {low:.2f}",
                         "bubbles": f"{np.count_nonzero(here)}", "mean radius": f"{R[here].mean():.2f}",
                         "contacts": f"{frame['contacts'][here].mean():.2f}",
                         "gain of gas": f"{gain[here].sum() / np.sum(np.pi * R[here]**2):.5f}"})
    return rows


def nearest(one: Survey, tau: float) -> dict[str, float]:
    return min(one.rows, key=lambda row: abs(row["tau"] - min(tau, one.rows[-1]["tau"])))


def results(place: Place, names: list[str], surveys: list[Survey]) -> list[Result]:
    found = []
    for one, series in zip(surveys, tables(place, names)):
        fit = growth.fit([series], *late([series]))
        found.append({"run": label_of(one.name), "separated": separated(one),
                      "slope": f"slope {with_error(fit.beta, fit.beta_error)}", "paths": paths_said(one),
                      "rates": rates_said(one), "energies": energies_said(one)})
    rows = place.merge(found, "separation-said", separation_figures.ORDER)
    seed = names[0].rsplit("-", 1)[1]
    all_names = [f"large{str(row['run']).replace(' ', '-')}-{seed}" for row in rows]

    def said(key: str) -> str:
        return "; ".join(f"{row['run']}: {row[key]}" for row in rows if row[key])

    return [
        Result("4.6 to 4.9", "the local gas fraction deviates from τ = 60 on; gaps at φ = 0.851, none at 0.876",
               said("separated"), all_names),
        Result("4.10", "exponent of these foams", said("slope"), all_names),
        Result("4.11 and 4.12", "paths of bubbles", said("paths"), all_names),
        Result("4.13", "rate against radius, by quartile of the energy",
               "rate of the quartile of most energy less that of least, at the mean radius, in K/⟨R⟩: " + said("rates"),
               all_names),
        Result("4.14", "map of the energy in time", "mean energy of a bubble: " + said("energies"), all_names),
    ]


def separated(one: Survey) -> str:
    known = [row for row in one.rows if row["tau"] > 0 and np.isfinite(row["clustering"])]
    if not known:
        return "too few bubbles to tell"
    most = max(known, key=lambda row: row["clustering"])
    gaps = max(one.rows, key=lambda row: row["gaps"])
    begun = next((row for row in one.rows if row["gaps"] > SEEN), None)
    text = (f"clustering up to {with_error(most['clustering'], most['clustering_error'])} at τ = {most['tau']:.0f}; ")
    if begun is None:
        return text + f"no gaps of more than {100 * SEEN:g} % of the area"
    return text + (f"gaps from τ = {begun['tau']:.0f} on, most at τ = {gaps['tau']:.0f}: "
                   f"{100 * gaps['gaps']:.1f} % of the area")


def paths_said(one: Survey) -> str:
    if len(one.tracks) < 2:
        return ""
    length = np.linalg.norm(one.tracks[-1][2], axis=1) / one.start.radius.mean()
    return (f"displacement {np.median(length):.1f} (median) and {length.max():.0f} (largest) mean radii of the first "
            f"state, from τ = {one.tracks[0][0]:.0f} to {one.tracks[-1][0]:.0f}")


def energies_said(one: Survey) -> str:
    return ", ".join(f"{frame['energy'].mean():.2g} (τ = {tau:.0f})" for tau, frame, _ in one.states)


def rates_said(one: Survey) -> str:
    """Rate of the quartile of most energy less that of least, for bubbles of the mean size."""
    columns = rates.medians(one.rates, np.array([0.9, 1.1]), within=True)
    value = {int(q): (r, e) for q, r, e in zip(columns["quartile"], columns["rate"], columns["error"])}
    if not {1, 4} <= set(value):
        return ""
    return with_error(value[4][0] - value[1][0], float(np.hypot(value[1][1], value[4][1])))
