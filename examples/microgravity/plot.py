#!/usr/bin/env python3
"""Tables and figures of foams against their liquid fraction, of the runs of run.py that are complete.

    python3 plot.py DIR                                  into DIR
    python3 plot.py DIR --full --no-pdf --out FOLDER     tables list all runs of run.py --full
    python3 plot.py DIR --full --small DIR2              with smaller runs where DIR has none

A series of which DIR has one liquid fraction at most is taken from DIR2, and its number of bubbles stands beside its
name. changes.csv keeps what stands there of runs that are not here.

microgravity.csv has all numbers. states.py says how they are measured, crossover.py how crossovers are read off,
tables.py makes the tables of the manual. What is not run yet is said to be so.
"""
from __future__ import annotations

import argparse
from pathlib import Path
import sys

import numpy as np

import tables
from lammps_foam.analysis import figure, sizes
from lammps_foam.analysis.pairs import into_brick
from lammps_foam.analysis.read import Frame, Unusable, read_frames
from lammps_foam.analysis import contacts
from packing import packings
from run import FRACTIONS, SERIES
from states import EDGES, LATE, Foam, attraction, foams_in, is_late

DPI = 200
PANELS = (("1/n", r"1/n of $\langle R\rangle$"), ("1/n_R32", r"1/n of $R_{32}$"), ("rattlers", "share of rattlers"),
          ("z_wide", "neighbors"), ("through_films", "share of gas through films"),
          ("width", r"width of sizes, sd / $\langle R\rangle$"),
          ("below_0.5", r"bubbles below $0.5\,\langle R\rangle$"),
          ("rattlers_gas", "share of gas in rattlers"))
MARKS = "os^Dv<>p"
SHOWN = (0.20, 0.30, 0.36, 0.45)      # liquid fractions of size distributions and slices
UNCERTAIN = 0.15                      # exponents with a larger error are not drawn


def draw(directory: Path, out: Path | None = None, full: bool = False, pdf: bool = True,
         small: Path | None = None) -> None:
    out = out or directory
    out.mkdir(parents=True, exist_ok=True)
    foams = foams_in(directory)
    smaller = foams_in(small) if small else {}
    changed = tables.keep_others(tables.changes(smaller) + tables.changes(foams), out / "changes.csv")
    foams = tables.with_smaller(foams, smaller)
    for key, packed in packings(directory).items():
        if key in foams:
            foams[key].row |= {name: packed[name] for name in ("rcp", "rcp_error")}
    fractions = sorted({fraction for _, fraction in foams} | (set(FRACTIONS) if full else set()))
    write_tables(foams, fractions, out)
    tables.write(changed or [{"series": tables.MISSING}], out / "changes.csv")
    if not foams:
        print(f"{directory} has no complete run of run.py: tables alone")
        return
    draw_against_fraction(foams, tables.ADHESION, out / "microgravity-adhesion", pdf)
    draw_against_fraction(foams, tables.EXCHANGE, out / "microgravity-exchange", pdf)
    draw_sizes(foams, out / "microgravity-sizes", pdf)
    draw_approach(foams, out / "microgravity-approach", pdf)
    draw_slices(foams, out / "microgravity-slices", pdf)


def write_tables(foams: tables.Foams, fractions: list[float], out: Path) -> None:
    fractions = fractions or FRACTIONS
    for name, what in (("1/n", "exponents"), ("beta", "slopes"), ("1/n_R32", "exponents-sauter"),
                       ("z_wide", "contacts"), ("rattlers", "rattlers"), ("through_films", "films")):
        tables.write(tables.matrix(foams, tables.ADHESION, fractions, name), out / f"{what}-adhesion.csv")
        tables.write(tables.matrix(foams, tables.EXCHANGE, fractions, name), out / f"{what}-exchange.csv")
    tables.write(tables.matrix(foams, ["spring", "sticky0.05"], fractions, "rcp"), out / "packing.csv")
    for series in ("spring", "sticky0.05"):
        tables.write(tables.size_table(foams, series, fractions), out / f"sizes-{series}.csv")
    tables.write(tables.crossovers(foams, list(SERIES)), out / "crossovers.csv")
    tables.write(tables.shifts(foams), out / "shifts.csv")
    tables.write(tables.checks(foams), out / "checks.csv")
    tables.write(tables.summary(foams), out / "summary.csv")
    (out / "findings.txt").write_text(tables.findings(foams))
    tables.write(tables.run_table(foams, list(SERIES), fractions), out / "runs.csv")
    numbers = [{"series": foam.series, "liquid_fraction": foam.fraction, **foam.row} for foam in foams.values()]
    tables.write(numbers or [{"series": tables.MISSING}], out / "microgravity.csv")


def save(fig, base: Path, pdf: bool) -> None:
    if pdf:
        figure.save(fig, base)
        return
    fig.savefig(base.with_suffix(".png"), dpi=DPI)
    figure.plt.close(fig)


# ------------------------------------------------------------------ against the liquid fraction

def draw_against_fraction(foams: tables.Foams, series: list[str], base: Path, pdf: bool) -> None:
    fig, axes = figure.panels(2, 4, width=2.1, height=2.1)
    shown = [fraction for _, fraction in foams]
    limits = (min(shown) - 0.02, max(shown) + 0.02)
    for number, name in enumerate(series):
        for ax, (what, _) in zip(axes, PANELS):
            x, y, error = tables.column(foams, name, what)
            good = error < UNCERTAIN if what.startswith("1/n") else np.ones(len(x), dtype=bool)
            ax.errorbar(x[good], y[good], error[good], lw=0.8, label=tables.label(foams, name),
                        fmt=MARKS[number] + "-", color=f"C{number}", mfc="w" if number % 2 else None)
    for ax, (_, label) in zip(axes, PANELS):
        ax.set(xlabel="liquid fraction", ylabel=label, xlim=limits)
    for ax in axes[:2]:
        ax.set(ylim=(min(0.2, ax.get_ylim()[0]), max(0.55, ax.get_ylim()[1])))
        for value in (1 / 3, 1 / 2):
            ax.axhline(value, color="0.7", lw=0.8, zorder=0)
    for theory, style in (("lsw", "--"), ("lemlich", ":")):
        width = sizes.theory_moments(theory, 3)[0]
        axes[5].axhline(width, color="0.5", ls=style, lw=0.8, zorder=0)
        axes[5].annotate(theory.upper() if theory == "lsw" else "Lemlich", (0.02, width), fontsize=6, va="bottom",
                         xycoords=("axes fraction", "data"))
    packed = tables.column(foams, "spring", "rcp")[1]
    for ax in axes if len(packed) else ():
        ax.axvspan(packed.min(), packed.max(), color="0.85", zorder=0)
    fig.legend(*axes[0].get_legend_handles_labels(), loc="outside upper center", ncols=len(series))
    save(fig, base, pdf)


# ------------------------------------------------------------------ sizes

def nearest(foams: tables.Foams, series: str, scaling: bool = True) -> list[Foam]:
    """The foams of a series at the liquid fractions SHOWN, or those next to them."""
    there = [foam for (name, _), foam in foams.items() if name == series and (foam.scales or not scaling)]
    if not there:
        return []
    chosen = [min(there, key=lambda foam: abs(foam.fraction - fraction)) for fraction in SHOWN]
    return list({foam.fraction: foam for foam in chosen}.values())


def draw_sizes(foams: tables.Foams, base: Path, pdf: bool) -> None:
    """Densities of R / <R> in the late states; filled: rattlers."""
    rows = [found for found in (nearest(foams, series) for series in ("spring", "sticky0.05")) if found]
    if not rows:
        return
    columns = max(map(len, rows))
    fig, axes = figure.panels(len(rows), columns, width=1.95, height=2.0, sharex=True)
    x, middle = np.linspace(0, 2.5, 400), (EDGES[1:] + EDGES[:-1]) / 2
    for row, found in enumerate(rows):
        for column in range(columns):
            ax = axes[row * columns + column]
            if column >= len(found):
                ax.set_visible(False)
                continue
            foam = found[column]
            mean, error = foam.density.mean, foam.density.error
            late = [state for run in foam.states for state in run if is_late(state.N, foam.row["bubbles"])]
            ax.stairs(np.mean([state.loose for state in late], axis=0), EDGES, color="C1", fill=True, alpha=0.4,
                      label="rattlers")
            ax.stairs(mean, EDGES, color="C0", label="all")
            ax.errorbar(middle, mean, error, fmt="none", ecolor="C0", lw=0.8)
            for theory, style in (("lsw", "k--"), ("lemlich", "k:")):
                ax.plot(x, sizes.density_over_mean(theory, x, 3), style, lw=0.8,
                        label="LSW" if theory == "lsw" else "Lemlich")
            ax.set(title=f"{foam.series}, {foam.fraction:.2f}", xlim=(0, 3), ylim=(0, 2.3))
            if row == len(rows) - 1 or column >= len(rows[row + 1]):    # nothing below
                ax.set(xlabel=r"$R / \langle R\rangle$")
                ax.tick_params(labelbottom=True)
        axes[row * columns].set(ylabel="density")
    axes[0].legend()
    save(fig, base, pdf)


# ------------------------------------------------------------------ on the way

def draw_approach(foams: tables.Foams, base: Path, pdf: bool) -> None:
    """Width of sizes, rattlers and share of gas through films while bubbles vanish, without and with adhesion."""
    what = (("sizes", 0, r"sd / $\langle R\rangle$"), ("means", 2, "share of rattlers"),
            ("means", 4, "share of gas through films"))
    fig, axes = figure.panels(1, 3, width=2.6, height=2.4)
    found = nearest(foams, "spring", scaling=False)
    for number, foam in enumerate(found):
        first = foam.row["bubbles"]
        for ax, (kind, index, _) in zip(axes, what):
            states = foam.states[0]
            ax.errorbar([state.N / first for state in states], [getattr(state, kind)[index] for state in states],
                        [getattr(state, f"{kind}_error")[index] for state in states], fmt=MARKS[number] + "-",
                        color=f"C{number}", lw=0.8, label=f"{foam.fraction:.2f}")
    for ax, (_, _, label) in zip(axes, what):
        ax.set(xscale="log", xlabel="bubbles left / bubbles at the start", ylabel=label)
        ax.set_xticks([0.5, 0.2, 0.1, 0.05], ["0.5", "0.2", "0.1", "0.05"])
        ax.xaxis.set_minor_formatter("")
        ax.axvspan(1 / LATE, ax.get_xlim()[1], color="0.93", zorder=0)
        ax.invert_xaxis()
    fig.legend(*axes[0].get_legend_handles_labels(), title="liquid fraction", loc="outside right center")
    save(fig, base, pdf)


# ------------------------------------------------------------------ pictures of the foam

def draw_slices(foams: tables.Foams, base: Path, pdf: bool) -> None:
    """A plane through the first late states; rattlers are orange."""
    rows = [[(foam, late_frame(foam)) for foam in nearest(foams, series, scaling=False)]
            for series in ("spring", "sticky0.05")]
    rows = [row for row in rows if row]
    if not rows:
        return
    columns = max(map(len, rows))
    fig, axes = figure.panels(len(rows), columns, width=1.9, height=2.05)
    for ax in axes:
        ax.set_visible(False)
    for number, row in enumerate(rows):
        for ax, (foam, frame) in zip(axes[number * columns:], row):
            ax.set_visible(True)
            slice_of(ax, frame, attraction(foam.series))
            ax.set_title(f"{foam.series}, {foam.fraction:.2f}, N = {len(frame)}")
    save(fig, base, pdf)


def late_frame(foam: Foam) -> Frame:
    """The late state of the first run with the most bubbles, or the last one."""
    frames = list(read_frames(foam.paths[0] / "left.lammpstrj"))
    late = [frame for frame in frames if is_late(len(frame), foam.row["bubbles"])]
    return late[0] if late else frames[-1]


def slice_of(ax, frame: Frame, A: float) -> None:
    """Circles in which the plane z = middle cuts the bubbles, with their periodic images."""
    box, R = frame.box, frame.radius
    loose = ~contacts.contacts_of(frame.positions, R, box, reach=1 + A).backbone
    x = into_brick(frame.positions, box) - box.lo
    side = box.lengths
    height = x[:, 2] - side[2] / 2
    height -= np.round(height / side[2]) * side[2]
    for k in np.flatnonzero(np.abs(height) < R):
        r = np.sqrt(R[k]**2 - height[k]**2)
        for shift_x in (-side[0], 0, side[0]):
            for shift_y in (-side[1], 0, side[1]):
                center = x[k, 0] + shift_x, x[k, 1] + shift_y
                if all(-r < c < s + r for c, s in zip(center, side)):
                    ax.add_patch(figure.plt.Circle(center, r, fc="C4" if loose[k] else "#cfe3f2", ec="0.25", lw=0.4))
    ax.set(xlim=(0, side[0]), ylim=(0, side[1]), aspect="equal", xticks=[], yticks=[])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("directory", type=Path, metavar="DIR", help="the --out of run.py")
    parser.add_argument("--out", type=Path, metavar="FOLDER", help="of figures and tables (default: DIR)")
    parser.add_argument("--full", action="store_true", help="list all runs of run.py --full")
    parser.add_argument("--small", type=Path, metavar="DIR2", help="of smaller runs, for series that DIR lacks")
    parser.add_argument("--no-pdf", action="store_true", help="PNG alone")
    args = parser.parse_args()
    for directory in (args.directory, *([args.small] if args.small else [])):
        if not directory.is_dir():
            parser.error(f"{directory} is no directory; it should be the --out of run.py")
    try:
        draw(args.directory, args.out, args.full, not args.no_pdf, args.small)
    except Unusable as wrong:
        sys.exit(str(wrong))


if __name__ == "__main__":
    main()
