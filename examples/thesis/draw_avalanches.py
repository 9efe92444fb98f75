"""Figures 4.2 to 4.5: energy, its drops, and the variance of velocities; do drops and spikes coincide?"""
from __future__ import annotations

from matplotlib.ticker import NullFormatter
import numpy as np

from common import Place, Result, late, tables, with_error
from lammps_foam.analysis import figure
from lammps_foam.analysis.avalanches import Found, analyse

SHOWN = 0.35      # of ln(tau) at the end of the range: long enough for some events, short enough to see them
THRESHOLD = 3.0   # usual deviations by which a drop stands out
THRESHOLDS = (2.0, THRESHOLD, 4.0)
LABELS = ("energy", r"$-\mathrm{d}\ln E/\mathrm{d}\ln\tau$", "variance of velocity")


def draw(place: Place, names: list[str]) -> list[Result]:
    series = tables(place, names)
    found = {threshold: [analyse(one, *late([one]), threshold=threshold, window=1.0) for one in series]
             for threshold in THRESHOLDS}
    every = {threshold: [numbers(name, one) for name, one in zip(names, ones)] for threshold, ones in found.items()}
    rows = every[THRESHOLD]
    place.write(rows, "avalanches")
    place.write([shown(row) for row in rows], "avalanches-table")
    place.write([of_threshold(threshold, row) for threshold, lines in every.items() for row in lines],
                "avalanches-threshold-table")
    picture(place, names, found[THRESHOLD])
    return [Result("4.2 to 4.5", "drops of the energy and spikes of the velocity variance coincide; towards φ = 0.87 "
                   "they get wider and rarer", said(rows), names)]


def error_of(values) -> float:
    """Standard error of a mean; nan of fewer than five, of which none is known."""
    return float(np.std(values, ddof=1) / np.sqrt(len(values))) if len(values) >= 5 else float("nan")


def numbers(name: str, one: Found) -> dict[str, object]:
    """Numbers of a run. A count n has the error sqrt(n), if events are independent. Widths are full at half height."""
    start, end = np.exp(one.ln_tau[[0, -1]])
    count = len(one.drops)
    widths = np.exp(one.drops.end) - np.exp(one.drops.start)
    relative = one.drops.end - one.drops.start
    return {"phi": float(name[3:7]), "tau_from": start, "tau_to": end, "drops": count,
            "per_tau": count / (end - start), "per_tau_error": np.sqrt(count) / (end - start),
            "per_ln_tau": count / np.log(end / start), "per_ln_tau_error": np.sqrt(count) / np.log(end / start),
            "width": np.mean(widths), "width_error": error_of(widths),
            "width_ln_tau": np.mean(relative), "width_ln_tau_error": error_of(relative),
            "size": np.mean(one.size), "size_error": error_of(one.size),
            "with_spike": np.mean(one.with_spike), "with_spike_error": error_of(one.with_spike),
            "by_chance": np.mean(one.shares), "by_chance_scatter": np.std(one.shares),
            "correlation": one.correlation}


def shown(row) -> dict[str, str]:
    def value(key):
        return with_error(row[key], row[f"{key}_error"])
    return {":math:`\\varphi`": f"{row['phi']:.2f}",
            "range of :math:`\\tau`": f"{row['tau_from']:.0f} to {row['tau_to']:.0f}", "drops": f"{row['drops']}",
            "drops per :math:`\\tau`": value("per_tau"), "per :math:`\\ln\\tau`": value("per_ln_tau"),
            "width in :math:`\\tau`": value("width"), "in :math:`\\ln\\tau`": value("width_ln_tau"),
            "with a spike": value("with_spike"),
            "by chance": with_error(row["by_chance"], row["by_chance_scatter"]),
            "correlation": f"{row['correlation']:.2f}"}


def of_threshold(threshold: float, row) -> dict[str, str]:
    return {"threshold": f"{threshold:g}", ":math:`\\varphi`": f"{row['phi']:.2f}", "drops": f"{row['drops']}",
            "drops per :math:`\\tau`": with_error(row["per_tau"], row["per_tau_error"]),
            "width in :math:`\\tau`": f"{row['width']:.2f}", "with a spike": f"{row['with_spike']:.2f}",
            "by chance": f"{row['by_chance']:.2f}"}


def said(rows) -> str:
    def each(key):
        return ", ".join(with_error(row[key], row[f"{key}_error"]) for row in rows)
    most = max(row["by_chance"] for row in rows)
    return (f"φ = {', '.join(format(row['phi'], '.2f') for row in rows)}: share of drops with a spike "
            f"{each('with_spike')} (by chance {most:.2f} at most); drops per τ {each('per_tau')}; "
            f"width in τ {each('width')}")


def picture(place: Place, names: list[str], found: list[Found]) -> None:
    fig, axes = figure.panels(3, len(names), width=2.0, height=1.5)
    for column, (name, one) in enumerate(zip(names, found)):
        panels = axes[column::len(names)]
        draw_one(panels, one)
        panels[0].set(title=rf"$\varphi$ = {name[3:7]}")
        panels[2].set(xlabel=r"$\tau$")
        if column == 0:
            for ax, label in zip(panels, LABELS):
                ax.set(ylabel=label)
    place.save(fig, "thesis-avalanches", dpi=150)


def draw_one(panels, one: Found) -> None:
    tau = np.exp(one.ln_tau)
    late = one.ln_tau > one.ln_tau[-1] - SHOWN
    for ax, values in zip(panels, (one.energy, one.loss, one.vvar)):
        ax.plot(tau[late], values[late], lw=0.6)
        for start, end in zip(np.exp(one.drops.start), np.exp(one.drops.end)):
            if start > tau[late][0]:
                ax.axvspan(start, end, color="C1", lw=0.4, alpha=0.35, zorder=0)
        ax.set(xlim=(tau[late][0], tau[-1]))
    panels[2].set(yscale="log")
    panels[2].yaxis.set_minor_formatter(NullFormatter())
