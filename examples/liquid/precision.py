"""What precision costs: errors of a Beltrami flow and of the front of a dam break against seconds."""
from __future__ import annotations

from pathlib import Path
from typing import Any

from matplotlib.axes import Axes

from lammps_foam.analysis import figure

from dambreak import rows_of
from run import LIMITED, PRECISION, SETTINGS, SHORT_STEPS
from turbulence import beltrami_row
from written import Rows, complete, folder, is_complete, of_sizes, report

KINDS = {"ma": ("s", "C1", "Ma"), "tol": ("^", "C2", "solver"), "dt": ("v", "C3", "longest step"),
         "courant": ("D", "C4", "courant")}


def kind(name: str) -> str:
    return name.split()[0]


def draw_flow(ax: Axes, sizes: Rows, others: dict[str, dict[str, Any]], title: str) -> None:
    """A line of sizes, and from its middle a line for each setting, whose ends are named."""
    sizes = sorted(sizes, key=lambda row: row["n"])
    ax.plot([row["seconds"] for row in sizes], [row["error"] for row in sizes], "o-", color="C0", label="spacing")
    for row in sizes:
        ax.annotate(f"n = {row['n']}", (row["seconds"], row["error"]), (4, 5), textcoords="offset points",
                    fontsize=6)
    for one, (mark, colour, label) in KINDS.items():
        some = {name.split(" ", 1)[1]: row for name, row in others.items() if kind(name) == one}
        if not some:
            continue
        some = dict(sorted(some.items(), key=lambda pair: pair[1]["seconds"]))
        ax.plot([row["seconds"] for row in some.values()], [row["error"] for row in some.values()], mark + ":",
                color=colour, label=label, lw=0.7)
        for name in {min(some, key=lambda key: some[key]["error"]), max(some, key=lambda key: some[key]["error"])}:
            if some[name]["error"] > 1.05 * min(row["error"] for row in some.values()):
                ax.annotate(name, (some[name]["seconds"], some[name]["error"]), (4, 3), textcoords="offset points",
                            fontsize=6, color=colour)
    ax.set(xlabel="seconds of CPU", ylabel="error", xscale="log", yscale="log", title=title)
    ax.margins(0.2, 0.13)
    figure.plain_ticks(ax)
    ax.legend(fontsize=6)


def draw_precision(out: Path) -> None:
    flows = [beltrami_row(path) for path in complete(out / "beltrami")]
    decay = {name: beltrami_row(out / "precision" / folder(name)) for name in PRECISION
             if is_complete(out / "precision" / folder(name))}
    fronts: Rows = []
    if complete(out / "projection"):
        fronts = [row for row in rows_of(out)[0] if row["method"] == "projection"]
    named = {row["run"]: row for row in fronts}
    front = {name: named[name] for name in {**SETTINGS, **SHORT_STEPS} if name in named and kind(name) in KINDS}
    fig, axes = figure.panels(1, 2, width=3.3, height=3.0)
    by_flow = [row for row in flows if row["dtmax"] == float(LIMITED)]
    draw_flow(axes[0], by_flow, decay, "Beltrami flow, Re = 50; n = 16")
    draw_flow(axes[1], of_sizes(fronts), front, "dam break; n = 16")
    figure.save(fig, out / "precision")
    base = {"Beltrami": next((row for row in by_flow if row["n"] == 16), None), "dam break": named.get("16")}
    rows: Rows = []
    for flow, settings in (("Beltrami", decay), ("dam break", front)):
        first = base[flow]
        if first is None:
            continue
        for name, row in {"default": first, **settings}.items():
            rows.append({"flow": flow, "setting": name, "seconds": row["seconds"],
                         "over default": row["seconds"] / first["seconds"], "error": row["error"],
                         "error over default": row["error"] / first["error"], "iterations": row["iterations"]})
    report(rows, out / "precision.csv")
