#!/usr/bin/env python3
"""Bounces, and what steps cost, from what run.py wrote.

    python3 plot.py DIR          writes bounces.csv, trade.csv, map.csv and figures (.pdf, .png) in DIR

Of a bounce: speed is that of the approach when the film closes for the first time. Contacts last from the closing of
the film to its opening, at h0; a film that is still closed at the end has no time. The overlap is the time that the
undeformed sphere would reach into the wall (height < 1): what a picture of the bubble shows. The rebound is the first
maximum of the height after the first minimum, over the height at rest, in R. The share of what the film and the
lubrication take is that of the kinetic energy across the wall at a distance of 2 R, where lubrication begins.
Errors of steps: the largest distance, over R, from the solution of reference.py at whole milliseconds.
"""
from __future__ import annotations

import argparse
from collections.abc import Iterable
import csv
from dataclasses import dataclass
import json
from pathlib import Path
import re
import sys
from typing import Any

from matplotlib import pyplot as plt
import numpy as np
from numpy.typing import NDArray

from lammps_foam.analysis import figure, table
from lammps_foam.analysis.read import Unusable

import reference
from run import DRAGS, FILMS, GRID, SCENES, TRADE, scene

Array = NDArray[np.float64]
Columns = dict[str, Array]
NEEDED = ("time", "height", "slide", "un", "ut", "gap", "h0", "closed", "kinetic", "viscous", "lubrication", "sliding")


def read_series(path: Path) -> Columns:
    """Columns of a series.csv by name."""
    if not path.is_file():
        raise Unusable(f"there is no {path}: in.bounce writes it")
    with path.open(newline="") as file:
        rows = [row for row in csv.reader(file) if row]
    names = rows[0] if rows else []
    missing = [name for name in NEEDED if name not in names]
    if missing:
        raise Unusable(f"{path} lacks the columns: {', '.join(missing)}")
    try:
        values = np.array(rows[1:], dtype=float)
    except ValueError:
        raise Unusable(f"{path} has a line that is no row of {len(names)} numbers") from None
    if len(values) < 3:
        raise Unusable(f"{path} has {len(values)} lines of numbers: a bounce needs three at least")
    return dict(zip(names, values.T))


def complete(directory: Path, group: str) -> list[Path]:
    return sorted(path.parent for path in (directory / group).glob("*/complete"))


def settings_of(path: Path) -> dict[str, Any]:
    found: dict[str, Any] = json.loads((path / "settings.json").read_text())
    return found


# ---------------------------------------------------------------- what a bounce was

@dataclass(frozen=True)
class Bounce:
    """Times in s, lengths over R, speeds in m/s; nan where a thing did not happen."""
    speed: float
    contacts: int
    contact: float      # of the first, closing to opening of the film
    overlap: float      # height < 1, the first time
    deepest: float
    rebound: float
    stays: bool         # the film is closed at the end, and the bubble moves along the wall alone
    sliding: float      # speed at the end
    taken: float        # share of the energy of the approach that the film and the lubrication took


def crossings(t: Array, y: Array) -> tuple[Array, Array]:
    """Times at which y falls below 0, and rises above; between lines y is taken as straight."""
    below = y < 0
    n = np.flatnonzero(below[1:] != below[:-1])
    at = t[n] + (t[n + 1] - t[n]) * y[n] / (y[n] - y[n + 1])
    falls = below[n + 1]
    return at[falls], at[~falls]


def turns(y: Array, start: int) -> tuple[float, float]:
    """The first minimum after this line and the maximum after that; nan where there is none."""
    rises = np.flatnonzero(np.diff(y[start:]) > 0)
    if not len(rises):
        return np.nan, np.nan
    low = start + int(rises[0])
    falls = np.flatnonzero(np.diff(y[low:]) < 0)
    return float(y[low]), float(y[low + int(falls[0])]) if len(falls) else np.nan


def describe(s: Columns) -> Bounce:
    """Raises Unusable where the bubble did not come to the wall."""
    closed = s["closed"] > 0
    if not closed.any():
        raise Unusable("the bubble did not come to the wall: -var time is too short")
    first = int(np.argmax(closed))
    edges = np.flatnonzero(closed[1:] != closed[:-1]) + 1
    contact = np.nan
    if len(edges) > 1:
        lines = slice(edges[1] - 1, edges[1] + 1)    # before and after the film opens, at the h0 of this contact
        contact = float(np.interp(s["h0"][edges[1] - 1], s["gap"][lines], s["time"][lines]) - s["time"][first])
    enters, leaves = crossings(s["time"], s["height"] - 1.0)
    deepest, top = turns(s["height"], first)
    rest = float(s["height"][-1])
    stays = bool(closed[-1] and abs(s["un"][-1]) < 1e-3 * np.abs(s["un"]).max())
    near = int(np.argmax(s["height"] < 2.0))
    approach = s["kinetic"][near] * s["un"][near]**2 / (s["un"][near]**2 + s["ut"][near]**2)
    end = int(edges[1]) if len(edges) > 1 else len(closed) - 1
    taken = float(s["viscous"][end] + s["lubrication"][end] - s["lubrication"][near]) / approach
    return Bounce(speed=float(-s["un"][first]), contacts=int(np.sum(closed[1:] & ~closed[:-1])),
                  contact=contact,
                  overlap=float(leaves[0] - enters[0]) if len(leaves) else np.nan,
                  deepest=deepest, rebound=top - rest if stays else np.nan, stays=stays,
                  sliding=float(s["ut"][-1]), taken=taken)


def row_of(path: Path) -> dict[str, Any]:
    settings = settings_of(path)
    try:
        b = describe(read_series(path / "series.csv"))
    except Unusable as wrong:
        raise Unusable(f"{path}: {wrong}") from None
    variant = "springs" if settings.get("viscous") == "none" else \
        "no tangential" if settings.get("tangential") == "no" else "all"
    return {"R_mm": float(settings["R"]) * 1e3, "tilt": float(settings["tilt"]), "drag": settings["drag"],
            "viscous": settings["viscous"], "terms": variant, "h0": settings.get("h0", "contact"),
            "integral": settings.get("integral", "fit"), "speed": b.speed, "contacts": b.contacts,
            "contact_ms": 1e3 * b.contact, "overlap_ms": 1e3 * b.overlap, "deepest": b.deepest, "rebound": b.rebound,
            "taken": b.taken, "end": "slides" if b.stays else "bounces", "slides_at": b.sliding}


def columns_of(rows: Iterable[dict[str, Any]]) -> dict[str, list[Any]]:
    rows = list(rows)
    return {name: [row[name] for row in rows] for name in rows[0]}


# ---------------------------------------------------------------- figures of bounces

def draw_scenes(directory: Path) -> None:
    """Normal against tangential position in the scenes of the source: all, and below the contaminated ones nearer."""
    fig, axes = figure.panels(2, 3, width=2.4, height=2.2)
    for n, (R, tilt) in enumerate(SCENES[:3]):
        far, near = axes[n], axes[n + 3]
        base = scene(R, tilt)
        curves = [(f"springs, {drag}", f"variant/{base}-springs-{drag}", "C2", drag) for drag in DRAGS]
        curves += [(f"{film}, {drag}", f"bounce/{base}-{film}-{drag}", colour, drag)
                   for film, colour in zip(FILMS, ("C0", "C1")) for drag in DRAGS]
        for label, name, colour, drag in curves:
            s = read_series(directory / name / "series.csv")
            for ax in (far, near) if drag == "contaminated" else (far,):
                ax.plot(s["slide"], s["height"], "-" if drag == "contaminated" else "--", color=colour, lw=0.9,
                        label=label)
        for ax in (far, near):
            ax.axhline(1.0, color="0.8", lw=0.8, zorder=0)
        far.set(title=f"R = {R} mm, {tilt}°", xlim=(0, 30), ylim=(0.2, 6.5))
        near.set(xlabel="place along the wall / R", xlim=(tilt / 5 - 1, tilt / 5 + 9), ylim=(0.6, 1.4))
    for ax in axes[::3]:
        ax.set(ylabel="distance of the centre / R")
    axes[0].legend(loc="upper right", fontsize=6)
    figure.save(fig, directory / "scenes")


def draw_variants(directory: Path) -> None:
    """The three variants of the source at 30 degrees: position, normal and tangential velocity along the wall."""
    R, tilt = SCENES[1]
    base = f"{scene(R, tilt)}"
    shown = [("springs alone", f"variant/{base}-springs-contaminated", "C2", "-"),
             ("with the viscous force", f"variant/{base}-published-contaminated", "C0", "-"),
             ("and the tangential", f"bounce/{base}-published-contaminated", "C1", "-"),
             ("the same, derived", f"bounce/{base}-derived-contaminated", "C3", "--")]
    fig, axes = figure.panels(1, 3, width=2.4, height=2.5)
    for label, name, colour, style in shown:
        s = read_series(directory / name / "series.csv")
        for ax, y in zip(axes, (s["height"], s["un"], s["ut"])):
            ax.plot(s["slide"], y, style, color=colour, lw=1.0, label=label)
    for ax, text in zip(axes, ("distance of the centre / R", "speed across the wall (m/s)",
                               "speed along the wall (m/s)")):
        ax.set(xlabel="place along the wall / R", ylabel=text, xlim=(4, 14))
    axes[0].set(ylim=(0.6, 2.0))
    axes[2].set(ylim=(0.055, 0.09))
    axes[0].legend()
    figure.save(fig, directory / "variants")


def draw_film(directory: Path) -> None:
    """h0 of the contact against the present one, the fit against the integral."""
    R, tilt = SCENES[1]
    fig, axes = figure.panels(1, 2, width=2.8, height=2.5)
    for ax, film in zip(axes, FILMS):
        for n, (end, label) in enumerate((("", "h0 contact, fit"), ("-current", "h0 current"),
                                          ("-exact", "integral exact"))):
            s = read_series(directory / "bounce" / f"{scene(R, tilt)}-{film}-contaminated{end}" / "series.csv")
            t = 1e3 * (s["time"] - s["time"][int(np.argmax(s["closed"] > 0))])
            ax.plot(t, s["height"], ("-", "--", ":")[n], color=f"C{n}", label=label)
        ax.set(title=f"{film}, R = {R} mm, {tilt}°", xlabel="time since the film closed (ms)", xlim=(-2, 30),
               ylim=(0.75, 1.2))
    axes[0].set(ylabel="distance of the centre / R")
    axes[0].legend()
    figure.save(fig, directory / "film")


def draw_energy(directory: Path) -> None:
    """Where the energy of the approach goes; of the two viscous forces, contaminated."""
    R, tilt = SCENES[1]
    fig, axes = figure.panels(1, 2, width=2.8, height=2.5)
    for ax, film in zip(axes, FILMS):
        s = read_series(directory / "bounce" / f"{scene(R, tilt)}-{film}-contaminated" / "series.csv")
        t = 1e3 * (s["time"] - s["time"][int(np.argmax(s["closed"] > 0))])
        across = s["kinetic"] * s["un"]**2 / np.maximum(s["un"]**2 + s["ut"]**2, 1e-30)
        for n, (label, y) in enumerate((("kinetic, across", across), ("elastic", s["elastic"]),
                                        ("lost by lubrication", s["lubrication"]), ("lost in the film", s["viscous"]))):
            ax.plot(t, 1e9 * y, ("-", "--", ":", "-.")[n], color=f"C{n}", label=label)
        ax.set(title=f"{film}, R = {R} mm, {tilt}°", xlabel="time since the film closed (ms)", xlim=(-8, 20),
               ylim=(0, 4.8))
    axes[0].set(ylabel="energy (nJ)")
    axes[1].legend(loc="upper right", ncols=2)
    figure.save(fig, directory / "energy")


# ---------------------------------------------------------------- what steps cost

def at_times(s: Columns, t: Array, R: float) -> Array:
    """Places (2, times) over R: cubic between lines, from places and speeds."""
    out = []
    for place, speed in (("height", "un"), ("slide", "ut")):
        n = np.clip(np.searchsorted(s["time"], t, side="right") - 1, 0, len(s["time"]) - 2)
        h = s["time"][n + 1] - s["time"][n]
        x = (t - s["time"][n]) / h
        y0, y1, v0, v1 = s[place][n], s[place][n + 1], h * s[speed][n] / R, h * s[speed][n + 1] / R
        out.append(y0 * (1 + 2 * x) * (1 - x)**2 + v0 * x * (1 - x)**2 + y1 * x**2 * (3 - 2 * x) + v1 * x**2 * (x - 1))
    return np.array(out)


def trade_rows(directory: Path) -> list[dict[str, Any]]:
    """Steps and errors of each run of the trade."""
    rows: list[dict[str, Any]] = []
    for name, settings in TRADE.items():
        found = [(path, re.match(rf"{name}-(explicit|implicit|chosen)-", path.name))
                 for path in complete(directory, "trade")]
        paths = [(path, match[1]) for path, match in found if match]
        if not paths:
            continue
        b = reference.Bounce(**settings)    # type: ignore[arg-type]
        exact = reference.solve(b)
        times = np.arange(GRID, b.time - 0.5 * GRID, GRID)
        places = exact(times)[:2] / b.R
        for path, kind in paths:
            one = settings_of(path)
            unstable = "unstable" in (path / "complete").read_text()
            s = {} if unstable else read_series(path / "series.csv")
            error = np.nan
            if s and s["time"][-1] >= times[-1] and np.all(np.isfinite(s["height"])):
                error = float(np.hypot(*(at_times(s, times, b.R) - places)).max())
            rows.append({"case": name, "steps_are": kind, "dt": float(one.get("dt", np.nan)),
                         "tol": float(one.get("tol", np.nan)), "steps": s["step"][-1] if s else np.nan, "error": error})
    return sorted(rows, key=lambda row: (list(TRADE).index(row["case"]), row["steps_are"], row["steps"]))


TITLES = {"springs": "springs alone, 0.6 mm", "published": "published, 0.6 mm", "derived": "derived, 0.6 mm",
          "small": "published, 0.05 mm", "small-derived": "derived, 0.05 mm"}


def draw_trade(rows: list[dict[str, Any]], directory: Path) -> None:
    cases = [name for name in TRADE if any(row["case"] == name for row in rows)]
    fig, axes = figure.panels(2, 3, width=2.4, height=2.3)
    for ax, name in zip(axes, cases):
        for n, (kind, label) in enumerate((("explicit", "equal steps, explicit drag"),
                                           ("implicit", "equal steps, implicit drag"), ("chosen", "steps by tol"))):
            mine = [row for row in rows if row["case"] == name and row["steps_are"] == kind]
            ax.loglog([row["steps"] for row in mine], [row["error"] for row in mine], "os^"[n] + "-", color=f"C{n}",
                      lw=0.8, mfc="w" if n == 1 else None, label=label)
        x = np.array([3e3, 3e5])
        ax.loglog(x, 3e-2 * 3e3 / x, "k:", lw=0.8, label="order 1")
        ax.loglog(x, 3e-3 * (3e3 / x)**2, "k--", lw=0.8, label="order 2")
        ax.set(title=TITLES[name], xlabel="steps", xlim=(1e2, 2e6), ylim=(1e-7, 3e1))
    for ax in axes[::3]:
        ax.set(ylabel="error of the place / R")
    for ax in axes[len(cases):]:
        ax.axis("off")
    handles, labels = axes[0].get_legend_handles_labels()
    axes[-1].legend(handles, labels, loc="center")
    figure.save(fig, directory / "steps")


# ---------------------------------------------------------------- the map

def draw_map(rows: list[dict[str, Any]], directory: Path) -> None:
    """Rebound over radius and tilt."""
    R = sorted({row["R_mm"] for row in rows})
    tilt = sorted({row["tilt"] for row in rows})
    fig, axes = figure.panels(2, 2, width=2.8, height=2.3)
    for ax, (drag, film) in zip(axes, ((drag, film) for drag in DRAGS for film in FILMS)):
        height = np.full((len(tilt), len(R)), np.nan)
        for row in rows:
            if row["drag"] == drag and row["viscous"] == film:
                height[tilt.index(row["tilt"]), R.index(row["R_mm"])] = row["rebound"]
        with np.errstate(divide="ignore", invalid="ignore"):
            shown = np.log10(height)
        ax.set(facecolor=plt.get_cmap("viridis")(0.0))    # where there is no rebound at all
        image = ax.pcolormesh(R, tilt, shown, cmap="viridis", vmin=-3, vmax=0.5, shading="nearest")
        lines = ax.contour(R, tilt, shown, levels=[-2, -1, 0], colors="w", linewidths=0.8)
        ax.clabel(lines, fmt=lambda value: f"{10**value:g}", fontsize=7)
        ax.plot([0.6, 0.6, 0.8], [20, 30, 45], "o", color="C1", ms=3)
        ax.axvline(0.4, color="w", lw=0.7, ls=":")
        ax.axhline(60, color="w", lw=0.7, ls=":")
        ax.set(title=f"{film}, {drag}", xlabel="R (mm)", ylabel="tilt (degrees)")
    fig.colorbar(image, ax=axes, label=r"$\log_{10}$ (rebound / R)")
    figure.save(fig, directory / "map")


# ---------------------------------------------------------------- all of it

def draw(directory: Path) -> None:
    paths = complete(directory, "bounce") + complete(directory, "variant")
    trade = complete(directory, "trade")
    chart = complete(directory, "map")
    if not paths and not trade and not chart:
        raise Unusable(f"{directory} has no complete run of run.py")
    if paths:
        columns = columns_of(row_of(path) for path in paths)
        table.show(columns, most=100)
        table.write(columns, directory / "bounces.csv")
        for drawing in (draw_scenes, draw_variants, draw_film, draw_energy):
            drawing(directory)
    if trade:
        rows = trade_rows(directory)
        table.show(columns_of(rows), most=500)
        table.write(columns_of(rows), directory / "trade.csv")
        draw_trade(rows, directory)
    if chart:
        rows = [row_of(path) for path in chart]
        table.write(columns_of(rows), directory / "map.csv")
        draw_map(rows, directory)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("directory", type=Path, metavar="DIR")
    try:
        draw(parser.parse_args().directory)
    except Unusable as wrong:
        sys.exit(str(wrong))
