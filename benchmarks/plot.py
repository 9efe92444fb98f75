#!/usr/bin/env python3
"""Draws bench.json of run.py: time per bubble and evaluation over the number of bubbles.

    plot.py DIR/bench.json DIR/bench.png
"""

import json
import sys
from pathlib import Path

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

STYLE = {
    "font.size": 12, "axes.labelsize": 14, "axes.titlesize": 13, "axes.spines.top": False,
    "axes.spines.right": False, "legend.frameon": False, "mathtext.fontset": "cm",
    "savefig.dpi": 160, "lines.linewidth": 1.8,
}
COLOURS = {"base": "0.25", "serial": "#6a51a3", "omp1": "#1f5a96", "cuda": "#3b7d23"}
THREADS = ["#c8702a", "#8c1c4c", "#a08010", "#207070"]      # omp2 and more

# what, which figure of it, look, name
CURVES = [
    ("foam", "ns", {"ls": "-", "marker": "o"}, "durian/foam, whole run"),
    ("foam", "floor ns", {"ls": ":", "lw": 1.2}, "its floor, set by memory"),
    ("history", "ns", {"ls": "--", "lw": 1.2, "marker": "s", "ms": 4}, "gran/hooke/history"),
    ("hooke", "ns", {"ls": "-.", "lw": 1.2, "marker": "^", "ms": 4}, "gran/hooke"),
]


def colour(configuration, known):
    if configuration in COLOURS:
        return COLOURS[configuration]
    more = [c for c in known if c.startswith("omp") and c != "omp1"]
    return THREADS[more.index(configuration) % len(THREADS)]


def name(configuration):
    if configuration.startswith("omp"):
        threads = configuration[3:]
        return f"kk, {threads} OpenMP thread{'s' * (threads != '1')}"
    return {"base": "without KOKKOS", "serial": "kk, Serial", "cuda": "kk, CUDA"}[configuration]


def draw(report, path):
    runs = report["runs"]
    scenes = list(dict.fromkeys(run["scene"] for run in runs))
    known = list(dict.fromkeys(run["configuration"] for run in runs))
    with plt.rc_context(STYLE):
        fig, axes = plt.subplots(1, len(scenes), figsize=(1.5 + 5.2 * len(scenes), 5.6),
                                 sharey=True, squeeze=False, layout="constrained")
        shown = set()
        floors = set()      # configurations with the same floor need one curve
        for ax, scene in zip(axes[0], scenes):
            for what, key, look, label in CURVES:
                for configuration in known:
                    points = sorted((run["bubbles"], run[key]) for run in runs
                                    if run["scene"] == scene and run["what"] == what and
                                    run["configuration"] == configuration and run.get(key))
                    if not points or (key == "floor ns" and (scene, points[0][1]) in floors):
                        continue
                    if key == "floor ns":
                        floors.add((scene, points[0][1]))
                    ax.loglog(*zip(*points), color=colour(configuration, known), **look)
                    shown.add(label)
            for other in report["others"]:
                if other["scene"] == scene:
                    ax.loglog(other["bubbles"], other["ns"], "*", ms=12, color="#b00020",
                              label=other["label"])
            phi = next(run["phi"] for run in runs if run["scene"] == scene)
            ax.set_title(f"{scene.upper()}, gas fraction {phi:.2f}")
            ax.set_xlabel("bubbles")
            ax.grid(alpha=0.25, which="both", lw=0.5)
            ax.xaxis.set_minor_formatter(NullFormatter())
            ax.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
            ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
            ax.yaxis.set_minor_formatter(NullFormatter())
        axes[0][0].set_ylabel("ns per bubble and evaluation")
        fig.suptitle("; ".join(filter(None, (report["gpu"], report["machine"]))), fontsize=11)
        entries = [Line2D([], [], color=colour(c, known), lw=3, label=name(c)) for c in known]
        entries += [Line2D([], [], color="0.5", label=label, **look)
                    for _, _, look, label in CURVES if label in shown]
        entries += axes[0][0].get_legend_handles_labels()[0]
        fig.legend(handles=entries, loc="outside lower center", ncols=2 * len(scenes))
        fig.savefig(path)
        plt.close(fig)


if __name__ == "__main__":
    draw(json.loads(Path(sys.argv[1]).read_text()), sys.argv[2])
