"""The pictures of draw_separation.py: what its surveys of the runs have."""
from __future__ import annotations

from matplotlib.collections import EllipseCollection, LineCollection
import numpy as np

from common import Place, late, tables
from lammps_foam.analysis import figure, growth, rates
from lammps_foam.analysis.read import Frame

MARKS = "os^Dv<"
MOST = ("0.851", "0.851 diluted", "0.876")    # pictures of these and of the others are apart
ORDER = (*MOST, "0.840", "0.852", "0.865")


def draw(place: Place, surveys) -> None:
    """Pictures of the runs that are here."""
    most = [one for one in surveys if label_of(one.name) in MOST]
    if most:
        draw_states(place, most[0])
        draw_energies(place, most[0])
    for group, end in ((most, ""), ([one for one in surveys if one not in most], "-others")):
        if group:
            draw_maps(place, group, f"thesis-maps{end}")
            draw_growth(place, group, f"thesis-growth{end}")
            draw_paths(place, group, f"thesis-paths{end}")
            draw_rates(place, group, f"thesis-rates{end}")


def label_of(name: str) -> str:
    """0.851 diluted of large0.851-diluted-1995."""
    return name.removeprefix("large").rsplit("-", 1)[0].replace("-", " ")


def whole_box(ax, frame: Frame) -> None:
    ax.set(xlim=(0, frame.box.lengths[0]), ylim=(0, frame.box.lengths[1]), aspect="equal", xticks=[], yticks=[])
    ax.minorticks_off()


# ------------------------------------------------------------------ against tau

def draw_spread(place: Place, table) -> None:
    """Spread with what it would be without clustering (dotted), clustering, gaps, of the rows of separation.csv."""
    fig, axes = figure.panels(1, 3, width=2.7, height=2.4)
    for number, run in enumerate(dict.fromkeys(row["run"] for row in table)):
        mine = [row for row in table if row["run"] == run and float(row["tau"]) > 0]
        rows = {key: np.array([float(row[key] or "nan") for row in mine]) for key in mine[0] if key != "run"}
        shape = {"fmt": MARKS[number % 6] + "-", "color": f"C{number % 7}", "lw": 0.8, "label": run}
        axes[0].errorbar(rows["tau"], rows["spread"], rows["spread_error"], **shape)
        axes[0].plot(rows["tau"], rows["dealt"], ":", color=shape["color"], lw=0.8)
        axes[1].errorbar(rows["tau"], rows["clustering"], rows["clustering_error"], **shape)
        axes[2].plot(rows["tau"], 100 * rows["gaps"], shape["fmt"], color=shape["color"], lw=0.8)
    for ax, label in zip(axes, ("spread of the local gas fraction", "clustering", "gaps, % of the area")):
        ax.set(xlabel=figure.TAU, xscale="log", ylabel=label)
    axes[0].set(yscale="log")
    axes[1].axhline(1, color="0.7", lw=0.8, zorder=0)
    axes[1].legend()
    place.save(fig, "thesis-separation", dpi=160)


def draw_growth(place: Place, surveys, name: str) -> None:
    """Energy, and the exponent in half a decade of tau."""
    fig, (left, right) = figure.panels(1, 2, width=3.0, height=2.4)
    for number, one in enumerate(surveys):
        series = tables(place, [one.name])[0]
        start, end = late([series])
        later, color = series["tau"] > start / 10, f"C{number % 7}"
        left.plot(series["tau"][later], series["energy"][later] / series["N"][later], lw=0.8, color=color,
                  label=label_of(one.name))
        local = growth.local_exponents([series], growth.windows_of([series], 0.5, start / 10, end, False))
        right.errorbar(local["tau"], local["beta"], local["error"], fmt=MARKS[number % 6] + "-", lw=0.8, color=color)
    left.set(xscale="log", yscale="log", xlabel=figure.TAU, ylabel="energy of a bubble")
    left.legend()
    right.set(xscale="log", xlabel=figure.TAU, ylabel="exponent in half a decade")
    for value in (1 / 3, 1 / 2):
        right.axhline(value, color="0.7", lw=0.8, zorder=0)
    place.save(fig, name, dpi=160)


# ------------------------------------------------------------------ states

def discs(ax, frame: Frame, **how) -> EllipseCollection:
    x, R = frame.positions[:, :2] - frame.box.lo[:2], frame.radius
    drawn = EllipseCollection(2 * R, 2 * R, np.zeros(len(R)), units="x", offsets=x, offset_transform=ax.transData,
                              linewidths=0, rasterized=True, **how)
    ax.add_collection(drawn)
    whole_box(ax, frame)
    return drawn


def draw_states(place: Place, one) -> None:
    """The bubbles in the whole box."""
    fig, axes = figure.panels(1, len(one.states), width=3.0, height=3.3)
    for ax, (tau, frame, _) in zip(axes, one.states):
        discs(ax, frame, facecolor="0.15")
        ax.set(title=rf"{label_of(one.name)}, $\tau$ = {tau:.0f}, {len(frame)} bubbles")
    place.save(fig, "thesis-states", dpi=110, colors=12)


def draw_maps(place: Place, surveys, name: str) -> None:
    """Gas fraction of small cells, a line for each run."""
    columns = max(len(one.states) for one in surveys)
    fig, axes = figure.panels(len(surveys), columns, width=1.9, height=2.1)
    for line, one in enumerate(surveys):
        for ax, (tau, frame, fine) in zip(axes[line * columns:], one.states):
            drawn = ax.imshow(fine.T, origin="lower", cmap="RdBu_r", vmin=0.4, vmax=1.3,
                              extent=(0, frame.box.lengths[0], 0, frame.box.lengths[1]))
            ax.set(title=rf"{label_of(one.name)}, $\tau$ = {tau:.0f}")
            whole_box(ax, frame)
    fig.colorbar(drawn, ax=axes, shrink=0.7, label="local gas fraction")
    place.save(fig, name, dpi=90, colors=256)


def draw_energies(place: Place, one) -> None:
    """Energy of each bubble, in the middle of the box. Black bubbles touch none, or hardly."""
    fig, axes = figure.panels(1, len(one.states), width=2.3, height=2.4)
    for ax, (tau, frame, _) in zip(axes, one.states):
        energy = np.log10(np.maximum(frame["energy"], 1.0e-12))
        drawn = discs(ax, frame, array=energy, cmap="magma", clim=(-6.0, -1.8))
        middle, size = frame.box.lengths[0] / 2, 35 * frame.radius.mean()
        ax.set(title=rf"{label_of(one.name)}, $\tau$ = {tau:.0f}", xlim=(middle - size, middle + size),
               ylim=(middle - size, middle + size))
    fig.colorbar(drawn, ax=axes, shrink=0.8, label=r"$\log_{10}$ energy")
    place.save(fig, "thesis-energies", dpi=130, colors=128)


# ------------------------------------------------------------------ bubbles

def draw_paths(place: Place, surveys, name: str) -> None:
    """Ways of the bubbles that are left at the end of the range; mean path and displacement against tau."""
    shown = [one for one in surveys if len(one.tracks) > 1]
    fig, axes = figure.panels(1, len(shown) + 1, width=2.7, height=2.5)
    for ax, one in zip(axes, shown):
        drawn = draw_tracks(ax, one)
    for number, one in enumerate(surveys):
        series, color = tables(place, [one.name])[0], f"C{number % 7}"
        later = series["tau"] > 1
        axes[-1].plot(series["tau"][later], series["path"][later], color=color, label=label_of(one.name))
        axes[-1].plot(series["tau"][later], np.sqrt(series["msd"][later]), "--", color=color)
    if shown:
        fig.colorbar(drawn, ax=axes[:-1], shrink=0.8, label=r"displacement $/\,\langle R\rangle$")
    axes[-1].set(xscale="log", yscale="log", xlabel=figure.TAU,
                 ylabel=r"path, displacement $/\,\langle R_\mathrm{in}\rangle$")
    axes[-1].legend()
    place.save(fig, name, dpi=130, colors=64)


def draw_tracks(ax, one) -> LineCollection:
    """Lines from where bubbles were in the first state, through all states; colour by their displacement."""
    ids = one.tracks[-1][1]
    steps = np.stack([moved[np.searchsorted(these, ids)] for _, these, moved in one.tracks], axis=1)    # (n, times, 2)
    order = np.argsort(one.start["id"])
    first = one.start.positions[order][np.searchsorted(one.start["id"][order], ids), :2] - one.start.box.lo[:2]
    length = np.linalg.norm(steps[:, -1], axis=1) / one.start.radius.mean()
    lines = LineCollection(first[:, None] + steps, array=length, cmap="viridis", linewidths=0.3, rasterized=True,
                           clim=(0, 60))
    ax.add_collection(lines)
    whole_box(ax, one.start)
    ax.set(title=rf"{label_of(one.name)}, $\tau$ = {one.tracks[0][0]:.0f} to {one.tracks[-1][0]:.0f}")
    return lines


def draw_rates(place: Place, surveys, name: str) -> None:
    """Rate of growth against radius, for each quartile of the energy among bubbles of like radius."""
    shown = [one for one in surveys if one.rates]
    fig, axes = figure.panels(1, max(len(shown), 1), width=2.8, height=2.4)
    for ax, one in zip(axes, shown):
        columns = rates.medians(one.rates, np.arange(0.2, 2.6, 0.2), within=True)
        for quartile in (1, 2, 3, 4):
            mine = columns["quartile"] == quartile
            ax.errorbar(columns["R"][mine], columns["rate"][mine], columns["error"][mine], lw=0.8,
                        fmt="osDv"[quartile - 1] + "-", label=f"quartile {quartile} of energy")
        ax.axhline(0, color="0.7", lw=0.8, zorder=0)
        ax.set(xlabel=r"$R/\langle R\rangle$", title=label_of(one.name))
    axes[0].set(ylabel=r"median of $\dot R\,\langle R\rangle / K$")
    axes[0].legend()
    place.save(fig, name, dpi=160)
