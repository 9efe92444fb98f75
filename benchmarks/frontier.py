"""Tables and work-precision diagrams from the rows of tradeoff.csv."""

from pathlib import Path

import numpy as np

from scenes import SCENES

# column, what it is called, at the last time (or at the first, before chaos)
ERRORS = {
    "error R": (r"mean radius, relative", "last"),
    "error energy": (r"energy, relative", "last"),
    "error radii": (r"radii, rms  $[\langle R_\mathrm{in}\rangle]$", "last"),
    "error sizes": ("size distribution (Kolmogorov-Smirnov)", "last"),
    "error x": (r"positions, rms  $[\langle R_\mathrm{in}\rangle]$", "first"),
}
# error allowed in number, mean radius, energy
LEVELS = {"loose": (2.0e-3, 1.0e-3, 1.0e-2), "middle": (2.0e-4, 1.0e-4, 1.0e-3),
          "tight": (1.0e-4, 1.0e-5, 1.0e-4)}
FAMILIES = {"source": ["source"], "abm": ["abm max", "abm rms"], "rkc": ["rkc max", "rkc rms"]}
FAR = 1.0e-2        # of the smallest error: chaos below that is told by a number, not drawn
CURVES = [curve for family in FAMILIES.values() for curve in family]
SPECIAL = [*CURVES, "reference", "chaos"]
COLOURS = {"source": "0.45", "abm max": "#1f5a96", "abm rms": "#6aa0d8", "rkc max": "#c8702a",
           "rkc rms": "#8c1c4c"}
STYLE = {
    "font.size": 11, "axes.labelsize": 12, "axes.titlesize": 12, "axes.spines.top": False,
    "axes.spines.right": False, "legend.frameon": False, "mathtext.fontset": "cm",
    "savefig.dpi": 130, "lines.linewidth": 1.6,
}


def number(row, column):
    return float(row[column]) if row.get(column) else float("nan")


class Group:
    """All rows of one scene with one number of bubbles."""

    def __init__(self, rows):
        self.rows = rows
        self.scene, self.bubbles = rows[0]["scene"], int(rows[0]["bubbles"])
        clocks = sorted({float(row["clock"]) for row in rows})
        self.times = {"first": clocks[0], "last": clocks[-1]}

    def at(self, when, *curves):
        """The newest row of each run of these curves at a time, cheapest first."""
        chosen = {}
        for row in self.rows:
            if float(row["clock"]) == self.times[when] and (not curves or row["curve"] in curves):
                chosen[row["curve"], row["value"], row["step"], row["precision"]] = row
        return sorted(chosen.values(), key=lambda row: number(row, "evaluations"))

    def method(self, curve, when):
        """Rows of one method, loosest tolerance first."""
        rows = [row for row in self.at(when, curve) if row["precision"] == "double"]
        return sorted(rows, key=lambda row: -float(row["value"]))

    def spread(self, column, when):
        """What a displacement by 1e-12 at the start makes: root mean square over seeds."""
        found = [number(row, column) for row in self.at(when, "chaos") if row["against"]]
        return float(np.sqrt(np.mean(np.square(found)))) if found else None

    def cheapest(self, family, level):
        """The cheapest settings of a family of methods that end within these errors, as do all
        tighter tolerances of the same method: no lucky hit."""
        best = None
        for curve in FAMILIES[family]:
            good = []
            for row in reversed(self.method(curve, "last")):
                if not within(row, level):
                    break
                good.append(row)
            for row in good:
                if best is None or number(row, "evaluations") < number(best, "evaluations"):
                    best = row
        return best


def within(row, level):
    return all(number(row, column) <= allowed for column, allowed in
               zip(("error N", "error R", "error energy"), LEVELS[level]))


def groups(rows):
    found = {}
    for row in rows:
        found.setdefault((row["scene"], int(row["bubbles"])), []).append(row)
    # a reference was made at least, with the newest recipe
    return [Group([row for row in part if row["recipe"] == part[-1]["recipe"]])
            for part in found.values()]


# ---- tables -------------------------------------------------------------------------------------

def tables(rows):
    parts = []
    for group in groups(rows):
        scene = SCENES[group.scene]
        clock = "tau" if scene.K else "strain"
        parts += ["", f"{scene.title}: {group.bubbles} bubbles, {clock} 0 to {group.times['last']}; "
                  f"positions at {group.times['first']}", run_head()]
        for curve in ["reference", *CURVES]:
            parts += [run_line(row, group) for row in (
                group.method(curve, "last") if curve != "reference" else
                group.at("last", curve))]
        if group.spread("error R", "last") is not None:
            parts.append(f"{'displaced by 1e-12':34s}{'':38s}" + "".join(
                f"{group.spread(column, when):10.1e}" for column, when in COLUMNS))
        others = [row for row in group.at("last") if row["curve"] not in SPECIAL]
        parts += [run_line(row, group)
                  for row in sorted(others, key=lambda row: (row["curve"], row["precision"]))]
    return "\n".join([recommended(rows), *parts])


COLUMNS = [("error N", "last"), ("error R", "last"), ("error energy", "last"),
           ("error sizes", "last"), ("error radii", "last"), ("error x", "first")]


def run_head():
    return (f"{'settings':34s}{'evaluations':>12s}{'rejected':>9s}{'seconds':>9s}{'N':>8s}" +
            "".join(f"{name:>10s}" for name in ("N", "<R>", "energy", "sizes", "radii", "x")))


def run_line(row, group):
    first = next((other for other in group.at("first", row["curve"]) if all(
        other[key] == row[key] for key in ("value", "step", "precision"))), {})
    name = row["step"].removeprefix("foam/")
    if row["settings"]:
        name += " " + row["settings"]
    if row["precision"] != "double":
        name += f" ({row['precision']})"
    if row["curve"] == "reference":
        name += "  [reference]"
    line = (f"{name:34s}{number(row, 'evaluations'):12.0f}{number(row, 'rejected'):9.0f}"
            f"{number(row, 'cpu seconds'):9.3g}{row['N']:>8s}")
    if not row["against"]:
        return line
    return line + "".join(f"{number(row if when == 'last' else first, column):10.1e}"
                          for column, when in COLUMNS)


def recommended(rows):
    """The cheapest settings of each family of methods at equal error."""
    lines = ["Cheapest settings that end within an error, and evaluations up to there",
             *(f"  {name:7s} " + (f"N within {n:.2%}" if n else "N exact") +
               f", <R> within {R:.0e}, energy within {E:.0e}" for name, (n, R, E) in LEVELS.items()),
             f"{'scene':8s}{'bubbles':>9s} {'error':8s}" +
             "".join(f"  {family + ':':20s}" for family in FAMILIES)]
    for group in groups(rows):
        for level in LEVELS:
            line = f"{group.scene:8s}{group.bubbles:9d} {level:8s}"
            for family in FAMILIES:
                row = group.cheapest(family, level)
                text = f"{'-':>8s}"
                if row:
                    text = f"{number(row, 'evaluations'):8.0f}  " + " ".join(
                        [row["value"], *row["curve"].split()[1:]])
                line += f"  {text:20s}"
            lines.append(line.rstrip())
    return "\n".join(lines)


# ---- diagrams -----------------------------------------------------------------------------------

def draw(rows, directory):
    import matplotlib
    matplotlib.use("Agg")
    for group in groups(rows):
        if any(group.method(curve, "last") for curve in CURVES):
            diagram(group, Path(directory) / f"{group.scene}-{group.bubbles}.png")


def diagram(group, path):
    """Error over evaluations, a curve for each method, a panel for each error."""
    import matplotlib.pyplot as plt
    scene = SCENES[group.scene]
    unit = r"\tau" if scene.K else r"\gamma"
    shown = [(column, *about) for column, about in ERRORS.items()
             if column != "error sizes" and any(
                 number(row, column) > 0.0 for row in group.at(about[1], *CURVES))]
    if not scene.K:     # nothing is chaotic in sizes, so positions are compared at the end, too
        shown.append(("error x", ERRORS["error x"][0], "last"))
    with plt.rc_context(STYLE):
        fig, axes = plt.subplots(1, len(shown), figsize=(1.0 + 3.9 * len(shown), 4.6),
                                 squeeze=False, layout="constrained")
        for ax, (column, title, when) in zip(axes[0], shown):
            panel(ax, group, column, when)
            ax.set_title(title)
            ax.set_xlabel(rf"evaluations to ${unit} = {group.times[when]:g}$")
        axes[0][0].set_ylabel("error")
        fig.suptitle(f"{scene.title}: {group.bubbles} bubbles")
        handles, labels = axes[0][0].get_legend_handles_labels()
        fig.legend(handles, labels, loc="outside lower center", ncols=len(labels))
        fig.savefig(path)
        plt.close(fig)


def panel(ax, group, column, when):
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
    names = {"source": "abm, scheme source", "abm max": "abm, norm max", "abm rms": "abm, norm rms",
             "rkc max": "rkc, norm max", "rkc rms": "rkc, norm rms"}
    lowest = []
    for curve in CURVES:
        rows = group.method(curve, when)
        points = [(number(row, "evaluations"), number(row, column), row["value"]) for row in rows]
        points = [point for point in points if point[1] > 0.0]
        if not points:
            continue
        x, y, tolerances = zip(*points)
        lowest.append(min(y))
        ax.loglog(x, y, "o-", ms=4, color=COLOURS[curve], label=names[curve])
        for xi, yi, tol in (points[0], points[-1]) if len(points) > 1 else points:
            ax.annotate(tol, (xi, yi), textcoords="offset points", xytext=(4, 4), fontsize=7,
                        color=COLOURS[curve])
    spread = group.spread(column, when)
    if spread and lowest:
        if spread > FAR * min(lowest):
            ax.axhspan(min(*lowest, spread) / 3.0, spread, color="0.85", lw=0,
                       label=r"chaos: start displaced by $10^{-12}$")
        else:
            ax.text(0.03, 0.03, f"chaos: {spread:.0e}", transform=ax.transAxes, color="0.5",
                    fontsize=9)
        ax.set_ylim(bottom=min(*lowest, spread if spread > FAR * min(lowest) else 1.0) / 3.0)
    ax.grid(alpha=0.25, which="major", lw=0.5)
    low, high = ax.get_xlim()
    ax.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5) if high < 40 * low else (1,)))
    ax.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    ax.xaxis.set_minor_formatter(NullFormatter())
