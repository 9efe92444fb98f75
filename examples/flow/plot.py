#!/usr/bin/env python3
"""Profiles and pictures of foams that flow, from what run.py left in a directory.

    python3 plot.py DIR         # writes DIR/flow-channel.png, flow-couette.png, flow-vortex.png

Velocities are displacements from frame to frame by the time between them: means over time, however long steps are.
Errors are those of the mean of blocks of time. Where the drag is that of the liquid, lines are those of a continuous
fluid with the flow curve that in.rheology measured for the same foam: nothing is fitted.
"""
import argparse
from pathlib import Path

import matplotlib
matplotlib.use("Agg")
from matplotlib.collections import EllipseCollection
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

CHANNEL, JET = dict(along=0.25, across=1.0, V=0.01), dict(along=1.0, across=0.2, V=0.02, wall=1.0, time=6000)
COUETTE, VORTEX = dict(rate=1e-3, layer=3.0), dict(strain=3.0, frames=60)
WALLS = (0.0, 0.5, 0.9, 1.0)
SPEEDS = (1e-1, 3e-2, 1e-2, 5e-3, 3e-3, 2e-3, 1.5e-3, 1e-3, 5e-4)
SEEDS = range(1, 9)          # of Couette flow; of vortices the first four
CASES = {                    # name of the dump: input script, its variables
    **{f"channel-wall-{wall:g}": ("channel", dict(wall=wall, **CHANNEL)) for wall in WALLS},
    **{f"channel-jet-{drag.split()[0]}": ("channel", dict(drag=drag, **JET))
       for drag in ("static", "contact 10", "neighbor")},
    **{f"couette-layers-{drag.split()[0]}": ("couette", dict(how="layers", drag=drag, **COUETTE))
       for drag in ("static", "contact 10", "neighbor")},
    **{f"couette-{how}-{drag}-{seed}": ("couette", dict(how=how, drag=drag, seed=seed, **COUETTE))
       for how, drag in (("plates", "neighbor"), ("box", "static")) for seed in SEEDS},
    **{f"vortex-{U:g}-{seed}": ("vortex", dict(U=U, seed=seed, **VORTEX)) for U in SPEEDS for seed in SEEDS[:4]},
}
CURVE = "curve.csv"         # flow curve, by in.rheology
SKIP, BLOCKS = 0.3, 8       # part of the time not counted; blocks of the rest
STYLE = {"font.size": 12, "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False,
         "mathtext.fontset": "cm", "savefig.dpi": 100}
BLUE, RED, GREEN, YELLOW = "#1f5a96", "#c0582b", "#3b8a4e", "#b59400"


# ------------------------------------------------------------------ reading

class Frames:
    """A dump: places of bubbles at times, wrapped (x) and not (path)."""

    def __init__(self, path):
        times, boxes, states = [], [], []
        with open(path) as f:
            for line in f:
                if line.startswith("ITEM: TIME\n"):
                    times.append(float(next(f)))
                elif line.startswith("ITEM: NUMBER"):
                    number = int(next(f))
                elif line.startswith("ITEM: BOX"):
                    boxes.append([[float(word) for word in next(f).split()] for _ in range(3)])
                elif line.startswith("ITEM: ATOMS"):
                    states.append(np.fromstring("".join(next(f) for _ in range(number)), sep=" ").reshape(number, -1))
        self.time, states = np.array(times), np.array(states)
        self.x, self.path, self.radius = states[:, :, 1:3], states[:, :, 3:5], states[0, :, 5]
        self.side = np.array([boxes[0][1][1], boxes[0][1][1]])      # from 0; in x, a tilted box has it by its volume
        if len(boxes[0][0]) == 2:
            self.side[0] = boxes[0][0][1]
        self.density = len(self.radius) / self.side.prod()

    def moves(self):
        """Velocities from frame to frame, and places half-way, without the first part of the time."""
        d = np.diff(self.path, axis=0)
        v, x = d / np.diff(self.time)[:, None, None], self.x[:-1] + 0.5 * d
        first = int(SKIP * len(v))
        return v[first:], x[first:]


def mean_error(blocks):
    """Of rows."""
    return blocks.mean(0), blocks.std(0, ddof=1) / np.sqrt(len(blocks))


def profile(v, y, height, width=2.5, blocks=BLOCKS):
    """Means of v over bins of y: middle of a bin, mean, error."""
    bins = int(height / width)
    which = np.floor(y / height * bins).astype(int) % bins
    means = []
    for block in np.array_split(np.arange(len(v)), blocks):
        count = np.bincount(which[block].ravel(), minlength=bins)
        means.append(np.bincount(which[block].ravel(), v[block].ravel(), bins) / np.maximum(count, 1))
    middle = (np.arange(bins) + 0.5) * height / bins
    return (middle, np.array(means)) if blocks == 1 else (middle, *mean_error(np.array(means)))


def in_blocks(*values):
    """Means over blocks of time of each, as rows."""
    return np.array([[value[block].mean() for value in values]
                     for block in np.array_split(np.arange(len(values[0])), BLOCKS)])


def flow_curve(path):
    """Rate and stress, means over the strain beyond 1 at each rate; strain counts, since steps vary in length."""
    rows, points = np.loadtxt(path, delimiter=",", skiprows=1), []
    for rate in np.unique(rows[:, 0]):
        _, strain, stress, _ = rows[rows[:, 0] == rate].T
        points.append((rate, np.interp(np.linspace(1.0, strain[-1], 2000), strain, stress).mean()))
    return np.array(points).T


def stress_of(curve, rate):
    """Between points by powers; below the slowest rate constant, as of a solid that yields."""
    return np.exp(np.interp(np.log(np.maximum(rate, 1e-12)), np.log(curve[0]), np.log(curve[1])))


def continuum(curve, height, density, liquid, hold=None, points=400):
    """y and velocity where d stress / dy = density mu0 (hold v - u), mu0 = 1, with u = liquid(y).

    hold(y) > 1 is drag of walls.
    """
    y, step = (np.arange(points) + 0.5) * height / points, height / points
    u, drag, k = liquid(y), np.ones(points) if hold is None else hold(y), np.arange(points - 1)
    viscosity = np.full(points - 1, 10.0)
    for _ in range(400):
        matrix = np.diag(density * drag)
        for i, j in ((k, k), (k + 1, k + 1)):
            matrix[i, j] += viscosity / step**2
        for i, j in ((k, k + 1), (k + 1, k)):
            matrix[i, j] -= viscosity / step**2
        v = np.linalg.solve(matrix, density * u)
        rate = np.maximum(np.abs(np.diff(v)) / step, 1e-9)
        viscosity = np.sqrt(viscosity * stress_of(curve, rate) / rate)      # half-way, so that it does not swing
    return y, v


# ------------------------------------------------------------------ pictures

def bubbles(ax, frames, number, values, shift=None, **style):
    """Bubbles of a frame as circles, coloured by values."""
    x = frames.x[number] if shift is None else frames.x[number] + shift
    d = 2 * frames.radius
    circles = EllipseCollection(d, d, np.zeros_like(d), units="xy", offsets=x, transOffset=ax.transData, array=values,
                                edgecolors="0.25", linewidths=0.25, **style)
    ax.add_collection(circles)
    ax.set(xlim=(0, frames.side[0]), ylim=(0, frames.side[1]), aspect="equal", xticks=[], yticks=[])
    for side in ("top", "right"):
        ax.spines[side].set_visible(True)
    return circles


def stripes(frames, width=12.0, axis=0):
    """0 or 1 by the place of a bubble in the first frame."""
    number = max(2 * round(frames.side[axis] / width / 2), 2)
    return np.floor(frames.x[0][:, axis] / frames.side[axis] * number) % 2


def draw_channel(directory, curve):
    fig, (picture, left, right) = plt.subplots(1, 3, figsize=(13.5, 5.6), layout="constrained",
                                               gridspec_kw=dict(width_ratios=(0.75, 1, 1)))
    print("\nchannel: a quarter of its length is driven; velocities by V")
    V, along = CHANNEL["V"], CHANNEL["along"]
    for wall, colour in zip(WALLS, (BLUE, GREEN, YELLOW, RED)):
        frames = Frames(directory / f"channel-wall-{wall:g}.dump")
        v, x = frames.moves()
        v = v[..., 0] / V
        length, height = frames.side
        y, mean, error = profile(v, x[..., 1], height)
        left.errorbar(mean, y, xerr=error, color=colour, marker="o", ms=3, lw=0, elinewidth=1, label=f"{wall:g}")
        driven = np.abs(x[..., 0] % length / length - 0.5) < 0.5 * along
        touch = np.minimum(x[..., 1], height - x[..., 1]) < frames.radius
        drag = wall / (1 - wall) if wall < 1 else 1e6           # of the wall, by mu0
        layer = 0.5 * touch.mean() * height
        line = continuum(curve, height, frames.density, lambda y: np.full_like(y, driven.mean() * V),
                         lambda y: np.where(np.minimum(y, height - y) < layer, 1 + drag, 1.0))
        left.plot(line[1] / V, line[0], color=colour, lw=1.2)
        core = np.abs(y / height - 0.5) < 0.25
        depth = [np.interp(0.9 * w[len(w) // 2], w[:len(w) // 2], z[:len(w) // 2]) for z, w in ((y, mean), line)]
        (part, of_all, held, at_wall), errors = mean_error(in_blocks(driven, v, touch, np.where(touch, v, 0.0)))
        print(f"  wall drag {wall:g}: driven part {part:.4f} +- {errors[0]:.4f}, mean velocity {of_all:.4f} +- "
              f"{errors[1]:.4f}, in the middle half {mean[core].mean():.4f}, {mean[core].min():.4f} to "
              f"{mean[core].max():.4f} (continuum {line[1][200] / V:.4f}); at a wall {held:.4f} of all, velocity "
              f"{at_wall / held:.4f}")
        if wall < 1:
            print(f"    mean, with {drag:.3g} times those at a wall: {of_all + drag * at_wall:.4f}")
        print(f"    stress at a wall, by balance: {0.5 * frames.density * height * (part - of_all) * V:.5f}; nine "
              f"tenths of the velocity in the middle at {depth[0]:.1f} from a wall (continuum {depth[1]:.1f})")
        ends = np.linspace(0, length, 11)
        area = np.histogram(x[..., 0] % length, ends, weights=np.broadcast_to(np.pi * frames.radius**2, v.shape))[0]
        gas = area / len(v) / (height * length / 10)
        print(f"    gas fraction along the channel: {gas.min():.3f} to {gas.max():.3f}")
    number = np.searchsorted(frames.time, frames.time[0] + 9.0 / (0.24 * V))        # moved by 9
    bubbles(picture, frames, number, stripes(frames), cmap="coolwarm", clim=(-0.25, 1.25))
    for side in (-1, 1):
        picture.axvline(length * (0.5 + side * 0.5 * along), color="k", lw=1.5, ls="--")
    picture.set_title("wall drag 1; dashed: driven part", fontsize=11)
    left.set(xlabel=r"velocity / $V$", ylabel=r"$y$", ylim=(0, height), xlim=(-0.01, None),
             title="a quarter of the length driven")
    left.legend(title="wall drag", loc="center", fontsize=10)

    print("channel: a fifth of its width is driven, walls stick; velocities by V")
    V, across = JET["V"], JET["across"]
    for drag, colour in (("static", BLUE), ("contact 10", GREEN), ("neighbor", RED)):
        frames = Frames(directory / f"channel-jet-{drag.split()[0]}.dump")
        v, x = frames.moves()
        height = frames.side[1]
        y, mean, error = profile(v[..., 0] / V, x[..., 1], height)
        edge, middle = 0.5 * (1 - across) * height, len(y) // 2
        right.errorbar(mean, y, xerr=error, color=colour, marker="o", ms=3, lw=0, elinewidth=1, label=drag)
        reach = edge - np.interp(0.1, mean[:middle], y[:middle])
        of_all, off = mean_error(in_blocks(v[..., 0] / V))
        print(f"  drag {drag}: middle {mean[middle]:.4f} +- {error[middle]:.4f}, mean {of_all[0]:.4f} +- {off[0]:.4f}; "
              f"a tenth of V at {reach:.1f} from the jet; next to the wall {mean[0]:.4f}, then {mean[1]:.4f} +- "
              f"{error[1]:.4f}")
        if drag == "static":
            line = continuum(curve, height, frames.density,
                             lambda y: np.where(np.abs(y / height - 0.5) < 0.5 * across, V, 0.0),
                             lambda y: np.where(np.minimum(y, height - y) < 1.5, 1e6, 1.0))
            right.plot(line[1] / V, line[0], color=colour, lw=1.2)
            there = edge - np.interp(0.1 * V, line[1][:200], line[0][:200])
            print(f"    continuum: {line[1][200] / V:.4f}, a tenth of V at {there:.1f}")
        if drag == "neighbor":
            right.plot([0, 1, 1, 0], [0, edge, height - edge, height], color=colour, lw=1.2)
    right.axhspan(edge, height - edge, color="k", alpha=0.08, lw=0)
    right.set(xlabel=r"velocity / $V$", ylabel=r"$y$", ylim=(0, height), title="a fifth of the width driven (grey)")
    right.legend(title="drag", loc="lower right", fontsize=10)
    save(fig, directory / "flow-channel.png")


def slip_in_box(frames):
    """Velocity relative to a box that is sheared, and y in it. Unwrapped places are of one image all the time."""
    v, x = frames.moves()
    y = frames.path[:, :, 1]
    y = (0.5 * (y[1:] + y[:-1]))[-len(v):]
    return v[..., 0] - COUETTE["rate"] * y, x[..., 1] % frames.side[1]


def couette_profile(directory, name):
    """The last frames, y, mean velocity and its error, mean of all and its error; of all seeds where there are some."""
    paths = sorted(directory.glob(f"couette-{name}-[1-9].dump")) or [directory / f"couette-{name}.dump"]
    rows, drifts = [], []
    for path in paths:
        frames = Frames(path)
        height = frames.side[1]
        if name.startswith("box"):
            v, y = slip_in_box(frames)
        else:
            v, x = frames.moves()
            v, y = v[..., 0], x[..., 1]
        if len(paths) == 1:
            return frames, *profile(v, y, height), mean_error(in_blocks(v))
        middle, means = profile(v, y, height, blocks=1)
        rows.append(means[0])
        drifts.append([v.mean()])
    mean, error = mean_error(np.array(rows))
    if name.startswith("box"):
        mean += COUETTE["rate"] * (middle - 0.5 * height)
    return frames, middle, mean, error, mean_error(np.array(drifts))


def draw_couette(directory, curve):
    fig, (picture, left, right) = plt.subplots(1, 3, figsize=(13.5, 4.9), layout="constrained")
    rate, layer = COUETTE["rate"], COUETTE["layer"]
    print("\nCouette flow; velocities by that of the layers")
    for name, label, colour in (("layers-static", "layers, static", BLUE),
                                ("layers-contact", "layers, contact 10", GREEN),
                                ("layers-neighbor", "layers, neighbor", YELLOW),
                                ("plates-neighbor", "plates, neighbor", RED),
                                ("box-static", "box that is sheared", "k")):
        frames, y, mean, error, drift = couette_profile(directory, name)
        height = frames.side[1]
        V = 0.5 * rate * (height - 2 * layer)
        mean, error, off = mean / V, error / V, (mean - rate * (y - 0.5 * height)) / V
        inner = (y > layer + 2.5) & (y < height - layer - 2.5)
        if name.startswith("box"):
            inner[:] = True
        far = np.abs(np.where(inner, off, 0.0)).argmax()
        slope = np.polyfit(y[inner], mean[inner] * V / rate, 1)[0]
        print(f"  {label}: mean {drift[0][0] / V:.1e} +- {drift[1][0] / V:.1e}, slope {slope:.3f} of the rate, largest "
              f"deviation {off[far]:.4f} +- {error[far]:.4f}, rms {np.sqrt((off[inner]**2).mean()):.4f}, rms of errors "
              f"{np.sqrt((error[inner]**2).mean()):.4f}; in the layers {mean[0]:.3f} +- {error[0]:.3f}, "
              f"{mean[-1]:.3f} +- {error[-1]:.3f}")
        left.errorbar(mean, y, xerr=error, color=colour, marker="o", ms=3, lw=0, elinewidth=1, label=label)
        if name == "layers-static":
            line = continuum(curve, height, frames.density,
                             lambda y: np.where(y < layer, -V, np.where(y > height - layer, V, 0.0)))
            left.plot(line[1] / V, line[0], color=colour, lw=1.2)
        if name in ("box-static", "plates-neighbor"):
            right.errorbar(off[inner], y[inner], xerr=error[inner], color=colour, marker="o", ms=3, lw=0, elinewidth=1)
        if name == "plates-neighbor":
            number = int(np.searchsorted(frames.time - frames.time[0], 1.0 / rate))
            bubbles(picture, frames, number, stripes(frames), cmap="coolwarm", clim=(-0.25, 1.25))
            strain = (frames.time[number] - frames.time[0]) * rate
            picture.set_title(f"plates, neighbor: strain {strain:.1f}")
    left.plot([-1, 1], [layer, height - layer], color="0.5", lw=1.2, zorder=0)
    left.set(xlabel=r"velocity / $V$", ylabel=r"$y$", ylim=(0, height), title="mean velocity")
    left.legend(fontsize=9, loc="upper left")
    right.axvline(0, color="0.5", lw=1.2, zorder=0)
    right.set(xlabel=r"(velocity $-$ linear) / $V$", ylabel=r"$y$", ylim=(0, height),
              title=f"off the line, {len(SEEDS)} seeds")
    save(fig, directory / "flow-couette.png")


def vortex(frames, U):
    """Velocities of bubbles and of the liquid there, where they are, and the wavenumber."""
    k = 2 * np.pi / frames.side[0]
    v, x = frames.moves()
    kx, ky = k * x[..., 0], k * x[..., 1]
    return v, U * np.stack([np.sin(kx) * np.cos(ky), -np.cos(kx) * np.sin(ky)], axis=-1), x % frames.side, k


def one_mode(curve, U, k, density):
    """Part of U that a foam has whose velocity is like that of the liquid, by the balance of power.

    The liquid brings in density mu0 (U - a) a / 2; a foam that flows at the rate 2 k a |cos kx cos ky| takes up that
    times its stress.
    """
    c = np.cos((np.arange(60) + 0.5) / 60 * 0.5 * np.pi)
    c = np.outer(c, c)
    low, high = 0.0, U
    for _ in range(50):
        a = 0.5 * (low + high)
        takes = (stress_of(curve, 2 * k * a * c) * 2 * k * c).mean()
        low, high = (a, high) if 0.5 * density * (U - a) > takes else (low, a)
    return low / U


def draw_cells(picture, middle, frames, U, cells=14):
    """Means over square cells: arrows upon the bubbles, and against the velocity of the liquid."""
    v, u, x, _ = vortex(frames, U)
    which = np.floor(x / frames.side * cells).astype(int) @ [cells, 1]
    count = np.bincount(which.ravel(), minlength=cells**2)
    foam, liquid = (np.stack([np.bincount(which.ravel(), f[..., c].ravel(), cells**2) / count for c in (0, 1)], axis=-1)
                    / U for f in (v, u))
    centre = (np.stack(np.divmod(np.arange(cells**2), cells), axis=-1) + 0.5) * frames.side / cells
    circles = bubbles(picture, frames, -1, np.linalg.norm(v[-1], axis=-1) / U, cmap="Blues", clim=(0, 1.2))
    picture.quiver(*centre.T, *foam.T, color=RED, angles="xy", scale_units="xy", scale=1 / 6.5, width=0.006)
    picture.figure.colorbar(circles, ax=picture, shrink=0.85, label=r"speed / $U$")
    picture.set_title(f"$U$ = {U:g}; arrows: mean velocity", fontsize=11)
    slope = (foam * liquid).sum() / (liquid**2).sum()
    middle.plot(liquid.ravel(), foam.ravel(), ".", color=BLUE, ms=4)
    middle.plot([-1, 1], [-1, 1], color="0.5", lw=1.2, zorder=0)
    middle.plot([-1, 1], [-slope, slope], color=RED, lw=1.2)
    middle.set(xlabel="velocity of the liquid / $U$", ylabel="mean velocity of the foam / $U$",
               title=f"both components, $U$ = {U:g}")
    off = foam - slope * liquid
    print(f"  U {U:g}: means over {cells**2} cells are {slope:.4f} times the liquid's velocity, rms deviation "
          f"{np.sqrt((off**2).mean()):.4f} U")


def draw_vortex(directory, curve):
    fig, (picture, middle, right) = plt.subplots(1, 3, figsize=(13.5, 4.5), layout="constrained")
    print(f"\nvortices: v.u / u.u, {len(SEEDS[:4])} seeds, mean and its error; one mode")
    for U in SPEEDS:
        parts = []
        for seed in SEEDS[:4]:
            frames = Frames(directory / f"vortex-{U:g}-{seed}.dump")
            v, u, _, k = vortex(frames, U)
            parts.append((v * u).sum() / (u**2).sum())
            if U == 0.01 and seed == 1:
                draw_cells(picture, middle, frames, U)
        mean, error = mean_error(np.array(parts))
        print(f"  U {U:g}: {mean:.4f} +- {error:.4f}, {min(parts):.4f} to {max(parts):.4f}; "
              f"{one_mode(curve, U, k, frames.density):.4f}")
        right.plot([U] * len(parts), parts, "o", color=BLUE, ms=4)
    grid = np.geomspace(min(SPEEDS), max(SPEEDS), 200)
    right.plot(grid, [one_mode(curve, u, k, frames.density) for u in grid], color=RED, lw=1.2)
    yields = curve[1][0] * k / frames.density
    right.axvline(yields, color="0.5", lw=1.2, ls=":")
    right.annotate(r"$k \sigma_y / n \mu_0$", (yields, 0.9), xytext=(6, 0), textcoords="offset points")
    right.set(xscale="log", ylim=(-0.02, 1.0), xlabel="$U$", ylabel="velocity of the foam / of the liquid",
              title="by the speed of the liquid")
    print(f"  yield stress {curve[1][0]:.5f}, that of the slowest flow: at rest below U = {yields:.5f}, in one mode "
          f"below {yields * 16 / np.pi**2:.5f}")
    save(fig, directory / "flow-vortex.png")


def save(fig, path):
    fig.savefig(path)
    Image.open(path).convert("RGB").quantize(256).save(path, optimize=True)
    plt.close(fig)
    print("picture:", path)


def make_pictures(directory):
    plt.rcParams.update(STYLE)
    curve = flow_curve(directory / CURVE)
    print("flow curve:", "  ".join(f"{rate:g} {stress:.5f}" for rate, stress in zip(*curve)))
    draw_channel(directory, curve)
    draw_couette(directory, curve)
    draw_vortex(directory, curve)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("directory", type=Path)
    make_pictures(parser.parse_args().directory)


if __name__ == "__main__":
    main()
