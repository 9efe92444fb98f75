"""Figure 4.1: growth exponents against the gas fraction."""
from __future__ import annotations

from collections import defaultdict

import numpy as np

from common import Place, Result, late, tables, with_error
from lammps_foam.analysis import figure, growth


def draw(place: Place, names: list[str]) -> list[Result]:
    by_phi = defaultdict(list)
    for name in names:
        by_phi[float(name[3:7])].append(name)
    rows = [exponents(phi, tables(place, seeds)) for phi, seeds in sorted(by_phi.items())]
    place.write(rows, "exponents")
    place.write([shown(row) for row in rows], "exponents-table")
    picture(place, rows)
    return [Result("4.1", "exponent rises from 1/3 (φ = 0.80) to 1/2 (φ = 1.00)", said(rows), names)]


def exponents(phi: float, series) -> dict[str, float]:
    fit = growth.fit(series, *late(series))
    n = fit.origin[0]
    return {"phi": phi, "runs": len(series), "tau_from": fit.start, "tau_to": fit.end,
            "beta": fit.beta, "beta_error": fit.beta_error, "1/n": 1 / n, "1/n_error": fit.origin_error[0] / n**2,
            "tau0": fit.origin[1], "tau0_error": fit.origin_error[1]}


def shown(row) -> dict[str, str]:
    return {":math:`\\varphi`": f"{row['phi']:.2f}", "runs": f"{row['runs']}",
            "range of :math:`\\tau`": f"{row['tau_from']:.0f} to {row['tau_to']:.0f}",
            "slope": with_error(row["beta"], row["beta_error"]), "1/n": with_error(row["1/n"], row["1/n_error"]),
            ":math:`\\tau_0`": with_error(row["tau0"], row["tau0_error"])}


def said(rows) -> str:
    least = min(rows, key=lambda row: row["beta"])
    return "; ".join(f"φ = {row['phi']:.2f}{what}: slope {with_error(row['beta'], row['beta_error'])}, "
                     f"1/n {with_error(row['1/n'], row['1/n_error'])}"
                     for row, what in ((rows[0], ""), (least, " (least slope)"), (rows[-1], "")))


def picture(place: Place, rows) -> None:
    columns = {key: np.array([row[key] for row in rows]) for key in rows[0]}
    fig, (ax,) = figure.panels(width=4.6, height=3.2)
    ax.errorbar(columns["phi"], columns["beta"], columns["beta_error"], fmt="o",
                label=r"slope of $\ln\langle R\rangle$ against $\ln\tau$")
    ax.errorbar(columns["phi"] + 0.0015, columns["1/n"], columns["1/n_error"], fmt="s", mfc="w", lw=0.8,
                label=r"$1/n$ of $\langle R\rangle^n = k(\tau-\tau_0)$")
    for value, text in ((1 / 3, "1/3"), (1 / 2, "1/2")):
        ax.axhline(value, color="0.7", lw=0.8, zorder=0)
        ax.annotate(text, (1.01, value), xycoords=("axes fraction", "data"), va="center", fontsize=7)
    ax.set(xlabel=r"gas fraction $\varphi$", ylabel="growth exponent")
    ax.legend(loc="lower right")
    place.save(fig, "thesis-exponents")
