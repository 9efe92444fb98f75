#!/usr/bin/env python3
"""Figures and numbers of waves.

    python3 plot.py DIR [--at T ...]      of one run: DIR/wave.lammpstrj and DIR/series.csv
    python3 plot.py DIR                   of all that run.py wrote in its --out DIR

Tables (.csv), figures (.pdf, .png) and a movie go into DIR. Energy is that beyond the liquid at rest with a level
surface. The volume that has been entrained is that of the bubbles and of those that have burst. Sizes are those of all
snapshots, a bubble in each of them; errors are by the number of different bubbles, as Poisson has it. Lines are the
powers that the source has below and above the size of Hinze, a_H = We^(-3/5) / 2: -3/2 and -10/3.
"""
from __future__ import annotations

import argparse
from pathlib import Path
import sys
from typing import Any

from matplotlib import pyplot as plt
from matplotlib.axes import Axes
import numpy as np
from numpy.typing import NDArray

sys.path.append(str(Path(__file__).resolve().parents[1] / "plume"))
from common import columns, complete, cost, film, frames_of
from lammps_foam.analysis import figure, table
from lammps_foam.analysis.read import Frame, Series, Unusable, read_series

Array = NDArray[np.float64]
Rows = list[dict[str, Any]]
DUMP = "wave.lammpstrj"
WE = 1.98e4
HINZE = WE**-0.6 / 2
CLASSES = np.geomspace(HINZE / 20, 24 * HINZE, 19)
BELOW, ABOVE = (HINZE / 8, HINZE), (HINZE, 6 * HINZE)      # where slopes are fitted
NONE = 1.0e-12                                             # volume of no bubble


# ---------------------------------------------------------------- what a run has

class Wave:
    def __init__(self, directory: Path, keep: tuple[float, ...] = ()) -> None:
        """Snapshots nearest to the times `keep` are kept, the others looked at."""
        self.directory = directory
        self.series: Series = read_series(directory / "series.csv")
        self.kept: dict[float, Frame] = {}
        self.n, self.volume, self.at_rest = 0, 0.0, 0.0
        radii: list[Array] = []
        bubbles: list[Array] = []                          # ID and radius
        for frame in frames_of(directory / DUMP):
            liquid = frame["type"] == 1
            if not self.n:
                dr = 2 * frame["radius"][liquid][0]
                self.n = round(1 / dr)
                self.volume = np.count_nonzero(liquid) * dr**3
                self.at_rest = self.volume**2 / (2 * frame.box.lengths[0] * frame.box.lengths[1])
            radii.append(frame["radius"][~liquid])
            bubbles.append(np.column_stack([frame["id"][~liquid], frame["radius"][~liquid]]))
            for time in keep:
                if time not in self.kept or abs(time - (frame.time or 0)) < abs(time - (self.kept[time].time or 0)):
                    self.kept[time] = frame
        if not self.n:
            raise Unusable(f"{directory / DUMP} has no snapshot yet")
        self.radii = np.concatenate(radii)
        self.different = np.unique(np.concatenate(bubbles), axis=0)[:, 1]

    @property
    def energy(self) -> Array:
        """Over that at the start."""
        beyond = self.series["energy"] - self.at_rest
        return beyond / beyond[0]

    @property
    def entrained(self) -> Array:
        return self.series["gas"] + self.series["lost"]

    def sinks(self) -> float:
        """How far the liquid has come down, mean of the later half: the two energies of a wave are equal."""
        late = self.series["time"] > self.series["time"][-1] / 2
        potential = self.series["energy"] - self.series["kinetic"] - self.at_rest
        return float(np.mean((self.series["kinetic"] - potential)[late]) / self.volume)

    def at(self, name: str, time: float) -> float:
        values = {"energy": self.energy, "entrained": self.entrained,
                  "kinetic": self.series["kinetic"] / self.series["kinetic"][0]}[name]
        return float(np.interp(time, self.series["time"], values))

    def sizes(self) -> Rows:
        """Density of radii by class, over all bubbles."""
        number, _ = np.histogram(self.radii, CLASSES)
        different, _ = np.histogram(self.different, CLASSES)
        density = number / np.diff(CLASSES) / max(len(self.radii), 1)
        return [{"a": np.sqrt(low * high), "density": d, "error": d / np.sqrt(m), "bubbles": k, "different": m}
                for low, high, d, k, m in zip(CLASSES, CLASSES[1:], density, number, different) if m]


def slope(rows: Rows, bounds: tuple[float, float]) -> tuple[float, float]:
    """Power of the density within bounds, and its error."""
    mine = [row for row in rows if bounds[0] < row["a"] < bounds[1] and row["different"] > 2]
    if len(mine) < 4:
        return np.nan, np.nan
    x, y = (np.log([row[name] for row in mine]) for name in ("a", "density"))
    error = np.array([1 / np.sqrt(row["different"]) for row in mine])
    (power, _), covariance = np.polyfit(x, y, 1, w=1 / error, cov="unscaled")
    return float(power), float(np.sqrt(covariance[0, 0]))


def growth(wave: Wave) -> tuple[float, float, float]:
    """When entrainment begins, its rate from a tenth to nine tenths of the volume, and the most it is off a line."""
    time, volume = wave.series["time"], wave.entrained
    if volume[-1] < NONE:
        return np.nan, np.nan, np.nan
    some = (volume > 0.1 * volume[-1]) & (volume < 0.9 * volume[-1])
    begins = float(time[np.argmax(volume > NONE)])
    if len(np.unique(volume[some])) < 5:
        return begins, np.nan, np.nan
    line = np.polyfit(time[some], volume[some], 1)
    return begins, float(line[0]), float(np.max(abs(np.polyval(line, time[some]) - volume[some])) / volume[-1])


def summary(wave: Wave) -> dict[str, Any]:
    steps, seconds = cost(wave.directory / "log.liquid")
    rows, (begins, rate, off) = wave.sizes(), growth(wave)
    below, above = slope(rows, BELOW), slope(rows, ABOVE)
    end = float(wave.series["time"][-1])
    return {"run": wave.directory.name, "born": int(wave.series["born"][-1]), "broken": int(wave.series["broken"][-1]),
            "begins": begins, "rate": rate, "off_line": off, "entrained": wave.at("entrained", end),
            **{f"{name}_{time:g}": wave.at(name, time) for name in ("energy", "kinetic") for time in (2.5, 5.0)},
            "sinks": wave.sinks(), "below": below[0], "below_error": below[1], "above": above[0],
            "above_error": above[1], "steps": steps, "ms_step": 1e3 * seconds / steps}


# ---------------------------------------------------------------- figures

def draw_frame(frame: Frame, ax: Axes, what: str, n: int) -> Any:
    """A layer of liquid in the middle of the width; with its vorticity, bubbles of a tenth of the width, to scale."""
    liquid, off = frame["type"] == 1, abs(frame["y"] - frame.box.lengths[1] / 2) / frame.box.lengths[1]
    mine = liquid & (off < 0.6 / n / frame.box.lengths[1])
    if what == "curl":
        values, style = frame["curl"], {"cmap": "RdBu", "vmin": -10, "vmax": 10}
    else:
        values, style = np.hypot(frame["vx"], frame["vz"]), {"cmap": "viridis", "vmin": 0, "vmax": 0.7}
    drawn = ax.scatter(frame["x"][mine], frame["z"][mine], c=values[mine], s=(160 / n)**2, marker="s", lw=0,
                       rasterized=True, **style)
    if what == "curl":
        few = ~liquid & (off < 0.05)
        size = 2 * frame["radius"][few] * 72 * ax.bbox.width / ax.figure.dpi      # points, of an axis that is 1 long
        ax.scatter(frame["x"][few], frame["z"][few], s=np.maximum(size, 0.5)**2, color="#009E73", lw=0, rasterized=True)
    ax.set(xlim=(0, 1), ylim=(0.15, 0.75), aspect="equal")
    ax.minorticks_off()
    return drawn


def draw_pictures(wave: Wave, out: Path) -> None:
    fig, axes = figure.panels(len(wave.kept), 2, width=3.2, height=2.0)
    for row, time in enumerate(sorted(wave.kept)):
        frame = wave.kept[time]
        for ax, what in zip(axes[2 * row:], ("speed", "curl")):
            drawn = draw_frame(frame, ax, what, wave.n)
            if row == len(wave.kept) - 1:
                fig.colorbar(drawn, ax=axes[what == "curl"::2], location="bottom", shrink=0.6, aspect=40,
                             label={"speed": "speed", "curl": "vorticity along y"}[what])
        axes[2 * row].set(title=f"t = {frame.time:.2f}, n = {wave.n}")
        axes[2 * row + 1].set(title=f"{np.count_nonzero(frame['type'] == 2)} bubbles")
    figure.save(fig, out / "wave-pictures")


def draw_film(directory: Path, out: Path, n: int) -> None:
    fig, (ax,) = figure.panels(1, 1, width=4.4, height=3.0)
    fig.set_dpi(100)

    def draw(frame: Frame) -> None:
        ax.clear()
        draw_frame(frame, ax, "curl", n)
        ax.set(title=f"t = {frame.time:4.2f}, {np.count_nonzero(frame['type'] == 2)} bubbles")

    every = (frame for number, frame in enumerate(frames_of(directory / DUMP)) if number % 2 == 0)
    film(every, fig, draw, out / "wave")
    plt.close(fig)


def draw_energy(waves: dict[str, Wave], out: Path, name: str) -> None:
    fig, (left, middle, right) = figure.panels(1, 3, width=2.5, height=2.5)
    for wave_name, wave in waves.items():
        time = wave.series["time"]
        line = left.plot(time, wave.energy, label=wave_name)[0]
        left.plot(time, wave.series["kinetic"] / wave.series["kinetic"][0], ":", color=line.get_color())
        middle.plot(time, wave.entrained)
        right.plot(time, wave.series["gas"])
    left.set(xlabel="t", ylabel="energy (dotted: kinetic)", ylim=(0, None))
    middle.set(xlabel="t", ylabel="volume entrained so far")
    right.set(xlabel="t", ylabel="volume of the bubbles")
    left.legend(ncols=2)
    figure.save(fig, out / f"wave-{name}")


def draw_sizes(waves: dict[str, Wave], out: Path) -> None:
    fig, (ax,) = figure.panels(1, 1, width=4.2, height=3.2)
    found: Rows = []
    level = np.nan
    for m, (name, wave) in enumerate(waves.items()):
        rows = wave.sizes()
        if not rows:
            continue
        a, density, error = (np.array([row[key] for row in rows]) for key in ("a", "density", "error"))
        ax.errorbar(a / HINZE, density * HINZE, error * HINZE, fmt="os^dv"[m % 5], color=f"C{m}",
                    label=f"{name}: {len(wave.different)} bubbles")
        ax.axvline(1 / wave.n / HINZE, color=f"C{m}", lw=0.7, ls=":")
        level = np.interp(HINZE, a, density * HINZE)
        found += [{"run": name, **row} for row in rows]
    if found:
        for power, x, style in ((-3 / 2, np.array([0.06, 1]), "k--"), (-10 / 3, np.array([1, 10]), "k-.")):
            ax.plot(x, level * x**power, style, lw=0.9, label=f"power {'-3/2' if x[0] < 1 else '-10/3'}")
        table.write(columns(found), out / "sizes.csv")
    ax.set(xscale="log", yscale="log", xlabel=r"radius $a/a_H$; dotted: spacing of the liquid",
           ylabel=r"density of $a/a_H$")
    ax.legend()
    figure.save(fig, out / "wave-sizes")


def write_summary(waves: dict[str, Wave], path: Path) -> None:
    rows = [{**summary(wave), "run": name} for name, wave in waves.items()]
    table.show(columns(rows))
    table.write(columns(rows), path)


def draw(out: Path) -> None:
    """All that run.py wrote."""
    paths = {group: complete(out, group) for group in ("wave", "steepness", "seeds")}
    if not any(paths.values()):
        raise Unusable(f"{out} has no run of run.py, and no {DUMP}")
    if paths["wave"]:
        finest = paths["wave"][-1]
        times = (0.8, 1.2, 1.6, 2.2, 3.0)
        waves = {f"n = {path.name}": Wave(path, times if path == finest else ()) for path in paths["wave"]}
        fine = list(waves.values())[-1]
        draw_pictures(fine, out)
        draw_film(finest, out, fine.n)
        draw_energy(waves, out, "energy")
        draw_sizes(waves, out)
        write_summary(waves, out / "waves.csv")
        seeds = {f"seeds {path.name}": Wave(path) for path in paths["seeds"]}
        if seeds:
            write_summary({"seeds 1": waves.get("n = 60", fine), **seeds}, out / "seeds.csv")
    if paths["steepness"]:
        steep = {path.name: Wave(path) for path in sorted(paths["steepness"])}
        write_summary(steep, out / "steepness.csv")
        finer = max(name.split("-")[1] for name in steep)
        draw_energy({name[:4]: wave for name, wave in steep.items() if name.endswith(finer)}, out, "steepness")


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("directory", type=Path, metavar="DIR")
    parser.add_argument("--at", nargs="+", type=float, metavar="T", help="times of pictures (default: four)")
    args = parser.parse_args()
    try:
        if not (args.directory / DUMP).is_file():
            draw(args.directory)
            return
        end = float(read_series(args.directory / "series.csv")["time"][-1])
        wave = Wave(args.directory, tuple(args.at or np.linspace(0, end, 4)))
        draw_pictures(wave, args.directory)
        draw_energy({f"n = {wave.n}": wave}, args.directory, "energy")
        draw_sizes({f"n = {wave.n}": wave}, args.directory)
    except Unusable as wrong:
        sys.exit(f"plot.py: {wrong}")


if __name__ == "__main__":
    main()
