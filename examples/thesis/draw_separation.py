"""Figures 4.6 to 4.14: does the liquid separate? States, energy, growth, paths of bubbles, rates, energies of bubbles.

A foam has separated where dense is beside dense at the scale of a 10 x 10 grid (clustering, lammps-foam fraction -h),
and where there are gaps: small cells, four mean radii wide, that are less than half full.
"""
from __future__ import annotations

from dataclasses import dataclass, field

from matplotlib.collections import EllipseCollection, LineCollection
import numpy as np

from common import LATE, Place, Result, late, tables, with_error
from lammps_foam.analysis import figure, fraction, growth, rates, runs
from lammps_foam.analysis.motion import Followed
from lammps_foam.analysis.read import Frame, read_frames

CELLS = 10           # the thesis' grid
FEWEST = 1000        # bubbles, ten in a cell: fewer tell nothing
FALL = 1.15          # so many times fewer bubbles are in the next frame that is looked at
EMPTY = 0.5          # a small cell with less gas is a gap
STATES = (8.0, 30.0, 100.0)    # so many times fewer bubbles than at the start are in the states that are shown
FOLLOWED = (6.0, 70.0)         # the same of the first and last state between which bubbles are followed
K = 1.0e-3
MARKS = "os^Dv<"


@dataclass
class Survey:
    """What is kept of the frames of a run."""

    name: str
    rows: list[dict[str, float]] = field(default_factory=list)
    states: list[tuple[float, Frame]] = field(default_factory=list)    # tau, frame
    tracks: list[tuple[float, np.ndarray, np.ndarray]] = field(default_factory=list)    # tau, ids, displacements
    start: Frame | None = None                                         # of the tracks
    rates: list[rates.Rates] = field(default_factory=list)


def draw(place: Place, names: list[str]) -> list[Result]:
    surveys = [survey(place, name) for name in names]
    place.write([{"run": label_of(one.name), **row} for one in surveys for row in one.rows], "separation")
    place.write([line for one in surveys for line in shown(one)], "separation-table")
    draw_spread(place, surveys)
    draw_states(place, surveys)
    draw_growth(place, names)
    draw_paths(place, surveys)
    draw_rates(place, surveys)
    draw_energies(place, surveys)
    return results(place, names, surveys)


def label_of(name: str) -> str:
    """0.851 diluted of large0.851-diluted-1995."""
    return name.removeprefix("large").rsplit("-", 1)[0].replace("-", " ")


# ------------------------------------------------------------------ one pass over the frames of a run

def frames_of(place: Place, name: str):
    """(tau, frame) of the snapshots of a run, each with fewer bubbles than the one before by the factor FALL."""
    clock, next_N = runs.Clock(place.run(name)), np.inf
    for frame in read_frames(place.run(name)):
        if len(frame) <= next_N:
            next_N = len(frame) / FALL
            yield clock.tau(frame), frame


def survey(place: Place, name: str) -> Survey:
    kept, first, bubbles, next_rates = Survey(name), 0, None, np.inf
    for tau, frame in frames_of(place, name):
        first = first or len(frame)
        left = first / len(frame)
        if len(frame) >= FEWEST:
            kept.rows.append(grid(tau, frame))
        if len(kept.states) < len(STATES) and left >= STATES[len(kept.states)]:
            kept.states.append((tau, frame))
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


def grid(tau: float, frame: Frame) -> dict[str, float]:
    """Spread over the cells of the grid, what it would be if small cells were dealt at random, and gaps."""
    split = fraction.splits(frame.radius, frame.box, (CELLS, CELLS))
    fine = fraction.local_fraction(frame.positions, frame.radius, frame.box, (split * CELLS, split * CELLS))
    spread, spread_error = fraction.spread(fraction.coarser(fine, split))
    clustering, clustering_error = fraction.clustering(fine, split)
    gap = fine < EMPTY
    return {"tau": tau, "N": len(frame), "spread": spread, "spread_error": spread_error,
            "dealt": spread / clustering, "clustering": clustering, "clustering_error": clustering_error,
            "gaps": float(np.mean(gap)), "outside": float(np.mean(fine[~gap]))}


# ------------------------------------------------------------------ tables

def shown(one: Survey) -> list[dict[str, str]]:
    """Lines at the states that are shown, and the last."""
    rows = [min(one.rows, key=lambda row: abs(row["tau"] - tau)) for tau, _ in one.states]
    rows += [one.rows[-1]] if one.rows[-1] not in rows else []
    return [{"run": label_of(one.name), ":math:`\\tau`": f"{row['tau']:.0f}", "bubbles": f"{row['N']:.0f}",
             "spread": with_error(row["spread"], row["spread_error"]),
             "dealt at random": f"{row['dealt']:.4f}",
             "clustering": with_error(row["clustering"], row["clustering_error"]),
             "gaps [% of the area]": f"{100 * row['gaps']:.2f}",
             "gas fraction outside gaps": f"{row['outside']:.3f}"} for row in rows]


def results(place: Place, names: list[str], surveys: list[Survey]) -> list[Result]:
    ours = []
    for one in surveys:
        late_rows = [row for row in one.rows if row["tau"] >= 60] or one.rows[-1:]
        most = max(late_rows, key=lambda row: row["clustering"])
        gaps = max(late_rows, key=lambda row: row["gaps"])
        ours.append(f"{label_of(one.name)}: clustering up to "
                    f"{with_error(most['clustering'], most['clustering_error'])} "
                    f"(τ = {most['tau']:.0f}), gaps up to {100 * gaps['gaps']:.2f} % (τ = {gaps['tau']:.0f})")
    slopes = []
    for one, series in zip(surveys, tables(place, names)):
        fit = growth.fit([series], *late([series]))
        slopes.append(f"{label_of(one.name)}: slope {with_error(fit.beta, fit.beta_error)}")
    return [
        Result("4.6 to 4.9", "the local gas fraction deviates from τ = 60 on; gaps at φ = 0.851, none at 0.876",
               "; ".join(ours), names),
        Result("4.10", "energy and exponent of these runs", "; ".join(slopes), names),
        Result("4.11 and 4.12", "paths of bubbles", paths_said(surveys), names),
        Result("4.13", "rate against radius, by quartile of the energy", rates_said(surveys), names),
        Result("4.14", "energy of the bubbles in time", "map below", names),
    ]


def paths_said(surveys: list[Survey]) -> str:
    parts = []
    for one in surveys:
        if len(one.tracks) > 1:
            length = np.linalg.norm(one.tracks[-1][2], axis=1) / one.start.radius.mean()
            parts.append(f"{label_of(one.name)}: median displacement from τ = {one.tracks[0][0]:.0f} to "
                         f"{one.tracks[-1][0]:.0f} {np.median(length):.1f}, largest {length.max():.0f} mean radii "
                         "of the first state")
    return "; ".join(parts)


def rates_said(surveys: list[Survey]) -> str:
    """Rate of the quartile of most energy less that of least, for bubbles of the mean size."""
    parts = []
    for one in surveys:
        columns = rates.medians(one.rates, np.array([0.9, 1.1]), within=True)
        value = {int(q): (r, e) for q, r, e in zip(columns["quartile"], columns["rate"], columns["error"])}
        if {1, 4} <= set(value):
            error = np.hypot(value[1][1], value[4][1])
            parts.append(f"{label_of(one.name)}: at the mean radius the quartile of most energy grows by "
                         f"{with_error(value[4][0] - value[1][0], error)} K/⟨R⟩ faster than that of least")
    return "; ".join(parts)


# ------------------------------------------------------------------ figures

def draw_spread(place: Place, surveys: list[Survey]) -> None:
    fig, axes = figure.panels(1, 3, width=2.7, height=2.4)
    for number, one in enumerate(surveys):
        rows = {key: np.array([row[key] for row in one.rows]) for key in one.rows[0]}
        shape = {"fmt": MARKS[number % 6] + "-", "color": f"C{number % 7}", "lw": 0.8, "label": label_of(one.name)}
        axes[0].errorbar(rows["tau"], rows["spread"], rows["spread_error"], **shape)
        axes[0].plot(rows["tau"], rows["dealt"], ":", color=f"C{number % 7}", lw=0.8)
        axes[1].errorbar(rows["tau"], rows["clustering"], rows["clustering_error"], **shape)
        axes[2].plot(rows["tau"], 100 * rows["gaps"], shape["fmt"], color=shape["color"], lw=0.8)
    for ax, label in zip(axes, ("spread of the local gas fraction", "clustering", "gaps, % of the area")):
        ax.set(xlabel=figure.TAU, xscale="symlog", ylabel=label, xlim=(0, None))
    axes[0].set(yscale="log")
    axes[1].axhline(1, color="0.7", lw=0.8, zorder=0)
    axes[1].legend()
    place.save(fig, "thesis-separation")


def discs(ax, frame: Frame, **how) -> EllipseCollection:
    x, R = frame.positions[:, :2] - frame.box.lo[:2], frame.radius
    drawn = EllipseCollection(2 * R, 2 * R, np.zeros(len(R)), units="x", offsets=x, offset_transform=ax.transData,
                              linewidths=0, rasterized=True, **how)
    ax.add_collection(drawn)
    ax.set(xlim=(0, frame.box.lengths[0]), ylim=(0, frame.box.lengths[1]), aspect="equal", xticks=[], yticks=[])
    ax.minorticks_off()
    return drawn


def draw_states(place: Place, surveys: list[Survey]) -> None:
    """Whole boxes, a line for each run."""
    fig, axes = figure.panels(len(surveys), len(STATES), width=2.3, height=2.45)
    for line, one in enumerate(surveys):
        for ax, (tau, frame) in zip(axes[line * len(STATES):], one.states):
            discs(ax, frame, facecolor="0.15")
            ax.set(title=rf"{label_of(one.name)}, $\tau$ = {tau:.0f}, {len(frame)} bubbles")
    place.save(fig, "thesis-states", dpi=110)


def draw_energies(place: Place, surveys: list[Survey]) -> None:
    """Energy of each bubble over the median of the state, in the middle of the box."""
    fig, axes = figure.panels(len(surveys), len(STATES), width=2.3, height=2.4)
    for line, one in enumerate(surveys):
        for ax, (tau, frame) in zip(axes[line * len(STATES):], one.states):
            energy = np.maximum(frame["energy"], 1.0e-30)
            drawn = discs(ax, frame, array=np.log10(energy / np.median(energy)), cmap="magma", clim=(-1.5, 1.5))
            middle, size = frame.box.lengths[0] / 2, 40 * frame.radius.mean()
            ax.set(title=rf"{label_of(one.name)}, $\tau$ = {tau:.0f}", xlim=(middle - size, middle + size),
                   ylim=(middle - size, middle + size))
    fig.colorbar(drawn, ax=axes, shrink=0.8, label=r"$\log_{10}$ (energy / median)")
    place.save(fig, "thesis-energies", dpi=110)


def draw_growth(place: Place, names: list[str]) -> None:
    """Energy, and the exponent in half a decade of tau."""
    fig, (left, right) = figure.panels(1, 2, width=3.0, height=2.4)
    for number, (name, series) in enumerate(zip(names, tables(place, names))):
        start, end = late([series])
        later = series["tau"] > start / 10
        left.plot(series["tau"][later], series["energy"][later] / series["N"][later], lw=0.8, color=f"C{number % 7}",
                  label=label_of(name))
        local = growth.local_exponents([series], growth.windows_of([series], 0.5, start / 10, end, False))
        right.errorbar(local["tau"], local["beta"], local["error"], fmt=MARKS[number % 6] + "-", lw=0.8,
                       color=f"C{number % 7}")
    left.set(xscale="log", yscale="log", xlabel=figure.TAU, ylabel="energy of a bubble")
    left.legend()
    right.set(xscale="log", xlabel=figure.TAU, ylabel="exponent in half a decade")
    for value in (1 / 3, 1 / 2):
        right.axhline(value, color="0.7", lw=0.8, zorder=0)
    place.save(fig, "thesis-growth")


def draw_paths(place: Place, surveys: list[Survey]) -> None:
    """Ways of the bubbles that are left at the end of the range; mean path and displacement against tau."""
    fig, axes = figure.panels(1, len(surveys) + 1, width=2.6, height=2.4)
    for number, (ax, one) in enumerate(zip(axes, surveys)):
        drawn = draw_tracks(ax, one)
        series = tables(place, [one.name])[0]
        later = series["tau"] > 1
        axes[-1].plot(series["tau"][later], series["path"][later], color=f"C{number % 7}", label=label_of(one.name))
        axes[-1].plot(series["tau"][later], np.sqrt(series["msd"][later]), "--", color=f"C{number % 7}")
    fig.colorbar(drawn, ax=axes[:-1], shrink=0.8, label=r"displacement / $\langle R\rangle$ at the first")
    axes[-1].set(xscale="log", yscale="log", xlabel=figure.TAU, ylabel=r"path, displacement / $\langle R_{in}\rangle$")
    axes[-1].legend()
    place.save(fig, "thesis-paths", dpi=130)


def draw_tracks(ax, one: Survey) -> LineCollection:
    """Lines from where bubbles were in the first state, through all states; colour by their displacement."""
    ids = one.tracks[-1][1]
    steps = np.stack([moved[np.searchsorted(these, ids)] for _, these, moved in one.tracks], axis=1)    # (n, times, 2)
    order = np.argsort(one.start["id"])
    first = one.start.positions[order][np.searchsorted(one.start["id"][order], ids), :2] - one.start.box.lo[:2]
    length = np.linalg.norm(steps[:, -1], axis=1) / one.start.radius.mean()
    lines = LineCollection(first[:, None] + steps, array=length, cmap="viridis", linewidths=0.4, rasterized=True,
                           clim=(0, 30))
    ax.add_collection(lines)
    ax.set(xlim=(0, one.start.box.lengths[0]), ylim=(0, one.start.box.lengths[1]), aspect="equal", xticks=[], yticks=[],
           title=rf"{label_of(one.name)}, $\tau$ = {one.tracks[0][0]:.0f} to {one.tracks[-1][0]:.0f}")
    ax.minorticks_off()
    return lines


def draw_rates(place: Place, surveys: list[Survey]) -> None:
    """Rate of growth against radius, for each quartile of the energy among bubbles of like radius."""
    fig, axes = figure.panels(1, len(surveys), width=2.8, height=2.4)
    for ax, one in zip(axes, surveys):
        columns = rates.medians(one.rates, np.arange(0.2, 2.6, 0.2), within=True)
        for quartile in (1, 2, 3, 4):
            mine = columns["quartile"] == quartile
            ax.errorbar(columns["R"][mine], columns["rate"][mine], columns["error"][mine], lw=0.8,
                        fmt="osDv"[quartile - 1] + "-", label=f"quartile {quartile} of energy")
        ax.axhline(0, color="0.7", lw=0.8, zorder=0)
        ax.set(xlabel=r"$R/\langle R\rangle$", title=label_of(one.name))
    axes[0].set(ylabel=r"median of $\dot R\,\langle R\rangle / K$")
    axes[0].legend()
    place.save(fig, "thesis-rates")
