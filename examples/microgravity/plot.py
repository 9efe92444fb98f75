#!/usr/bin/env python3
"""Scaling states of foams against their liquid fraction, from what run.py wrote.

    python3 plot.py DIR          writes microgravity.csv, microgravity.png, sizes.png in DIR

The scaling state is what is left after three quarters of the bubbles are gone. Exponents are slopes d ln <R> / d ln tau
over that range, and slopes 1/n of R^n = k (tau - tau0), which do not depend on the origin of time; errors are those of
lammps_foam.analysis.growth: block bootstrap of one run, or the scatter of seeds. Contacts and rattlers are counted in
all snapshots of that range; rattlers have fewer than four contacts, taken out one after the other. Bubbles that stick
(law sticky A) rest at a distance of R_i + R_j: contacts are those up to 1 + A times that. z_wide counts so in all
series, with A = 0.05: that alone can be compared between laws.
"""
import argparse
from collections import defaultdict
from pathlib import Path
import re
import sys

import numpy as np

from lammps_foam.analysis import contacts, figure, growth, runs, sizes, table
from lammps_foam.analysis.read import Unusable, read_frames

from run import SERIES

NAME = re.compile(r"(?P<series>.+)-(?P<fraction>\d\.\d\d)-(?P<seed>\d+)$")
WIDE = 1.05     # reach of contacts that is the same for all laws
LATE = 4.0      # the scaling state begins when so many times fewer bubbles are left


def found(directory):
    """{series: {liquid fraction: [directories of seeds]}} of complete runs."""
    all_runs = defaultdict(lambda: defaultdict(list))
    for done in sorted(directory.glob("*/complete")):
        match = NAME.match(done.parent.name)
        if match:
            all_runs[match["series"]][float(match["fraction"])].append(done.parent)
    return all_runs


def reach_of(series):
    """Up to which share of R_i + R_j bubbles are in contact."""
    law = SERIES[series][0].split()
    return 1.0 + float(law[1]) if law[0] == "sticky" else 1.0


def scaling_state(paths, reach):
    """A row of numbers of one series and liquid fraction, and the radii over their mean of each run."""
    series = runs.read_runs(paths, ["R", "N"])
    start = max(runs.tau_of_N(one, one["N"][0] / LATE) for one in series)
    end = min(float(one["tau"][-1]) for one in series)
    fit = growth.fit(series, start, end)
    row = {"runs": len(paths), "tau_from": start, "tau_to": end, "beta": fit.beta, "beta_error": fit.beta_error,
           "1/n": 1 / fit.origin[0], "1/n_error": fit.origin_error[0] / fit.origin[0]**2}
    means, radii = contacts.Means(), []
    for path, one in zip(paths, series):
        for frame in read_frames(path / "left.lammpstrj"):
            if len(frame) > one["N"][0] / LATE * 1.001:
                continue
            x, R = frame.positions, frame.radius
            found_here = contacts.contacts_of(x, R, frame.box, reach=reach)
            loose = ~found_here.backbone
            ones = np.ones(len(R))
            wide = contacts.contacts_of(x, R, frame.box, reach=WIDE)
            means.add(frame, np.column_stack([found_here.number, wide.number, loose, R**3 * loose]).astype(float),
                      np.column_stack([ones, ones, ones, R**3]))
            radii.append((R / R.mean(), loose))
    value, error = means.values()
    for name, v, e in zip(("z", "z_wide", "rattlers", "rattlers_gas"), value, error):
        row[name], row[f"{name}_error"] = float(v), float(e)
    x = np.concatenate([r for r, _ in radii])
    row["polydispersity"] = float(np.cbrt(np.mean(x**3))**2 / np.mean(x**2) - 1)
    row["width"] = float(x.std())
    last = [{name: column[one["tau"] >= start].mean() for name, column in one.items()} for one in series]
    row["through_films"] = float(np.mean([one["vfilm"] / (one["vfilm"] + one["vliquid"]) for one in last]))
    return row, radii


def draw(directory):
    all_runs = found(directory)
    if not all_runs:
        raise Unusable(f"{directory} has no complete run of run.py")
    rows, radii = [], {}
    for series, by_fraction in all_runs.items():
        for fraction, paths in sorted(by_fraction.items()):
            row, found_radii = scaling_state(paths, reach_of(series))
            rows.append({"series": series, "liquid_fraction": fraction, **row})
            radii[series, fraction] = found_radii
    columns = {name: np.array([row[name] for row in rows]) for name in rows[0]}
    table.show(columns, most=100)
    table.write(columns, directory / "microgravity.csv")
    draw_states(columns, directory / "microgravity")
    draw_sizes(radii, directory / "sizes")


def draw_states(columns, base):
    fig, axes = figure.panels(2, 2, height=2.3)
    panels = (("1/n", "growth exponent 1/n"),
              ("z_wide", r"neighbours at $r < 1.05\,(R_i+R_j)$"),
              ("rattlers", "share of rattlers"),
              ("width", r"width of sizes, sd / $\langle R\rangle$"))
    uncertain = columns["1/n_error"] > 0.2    # the range was too short to tell n and tau0 apart
    columns = {**columns, "1/n": np.where(uncertain, np.nan, columns["1/n"])}
    for number, name in enumerate(dict.fromkeys(columns["series"])):
        mine = columns["series"] == name
        x = columns["liquid_fraction"][mine]
        for ax, (what, _) in zip(axes, panels):
            error = columns.get(f"{what}_error")
            ax.errorbar(x, columns[what][mine], None if error is None else error[mine], lw=0.8, label=name,
                        fmt="os^Dv<>p"[number % 8] + "-", color=f"C{number % 7}", mfc="w" if number % 2 else None)
    for ax, (_, label) in zip(axes, panels):
        ax.set(xlabel="liquid fraction", ylabel=label)
    for value in (1 / 3, 1 / 2):
        axes[0].axhline(value, color="0.8", lw=0.8, zorder=0)
    axes[1].legend()
    figure.save(fig, base)


def draw_sizes(radii, base):
    """Densities of R / <R>, of all bubbles and of rattlers, at three liquid fractions of the first series."""
    series = next(iter(radii))[0]
    fractions = [fraction for name, fraction in radii if name == series]
    shown = sorted({fractions[0], fractions[len(fractions) // 2], fractions[-1]})
    edges = np.linspace(0, 3, 31)
    x = np.linspace(0, 2.5, 400)
    fig, axes = figure.panels(1, len(shown), width=2.4, height=2.3)
    for ax, fraction in zip(axes, shown):
        states = radii[series, fraction]
        everyone = np.concatenate([r for r, _ in states])
        loose = np.concatenate([r[mask] for r, mask in states])
        ax.stairs(sizes.histogram(everyone, edges), edges, color="C0", label="all")
        ax.stairs(np.histogram(loose, edges)[0] / (len(everyone) * np.diff(edges)), edges, color="C1", fill=True,
                  alpha=0.4, label="rattlers")
        for theory, style in (("lsw", "k--"), ("lemlich", "k:")):
            ax.plot(x, sizes.density_over_mean(theory, x, 3), style, lw=0.9, label=theory)
        ax.set(title=f"{series}, liquid fraction {fraction:.2f}", xlabel=r"$R / \langle R\rangle$", xlim=(0, 2.6))
    axes[0].set(ylabel="density")
    axes[0].legend()
    figure.save(fig, base)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("directory", type=Path, metavar="DIR")
    try:
        draw(parser.parse_args().directory)
    except Unusable as wrong:
        sys.exit(str(wrong))
