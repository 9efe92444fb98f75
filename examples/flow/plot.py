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

CHANNEL, JET = dict(along=0.25, across=1.0, V=0.01), dict(along=1.0, across=0.2, V=0.02, wall=1.0)
COUETTE, VORTEX = dict(rate=1e-3, layer=3.0), dict(strain=3.0, frames=60)
SPEEDS = (1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4)
CASES = {                    # name of the dump: input script, its variables
    **{f"channel-wall-{wall:g}": ("channel", dict(wall=wall, **CHANNEL)) for wall in (0.0, 0.5, 1.0)},
    **{f"channel-jet-{drag.split()[0]}": ("channel", dict(drag=drag, **JET))
       for drag in ("static", "contact 10", "neighbor")},
    "couette-box": ("couette", dict(how="box", **COUETTE)),
    **{f"couette-{how}-{drag.split()[0]}": ("couette", dict(how=how, drag=drag, **COUETTE))
       for how, drag in (("layers", "static"), ("layers", "contact 10"), ("layers", "neighbor"),
                         ("plates", "neighbor"))},
    **{f"vortex-{U:g}": ("vortex", dict(U=U, **VORTEX)) for U in SPEEDS},
}
CURVE = "curve.csv"         # flow curve, by in.rheology
SKIP, BLOCKS = 0.3, 8       # part of the time not counted; blocks of the rest
STYLE = {"font.size": 12, "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False,
         "mathtext.fontset": "cm", "savefig.dpi": 100}
BLUE, RED, GREEN, GREY = "#1f5a96", "#c0582b", "#3b8a4e", "0.55"


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
                    states.append(np.array([next(f).split() for _ in range(number)], dtype=float))
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


def profile(v, y, height, width=2.5):
    """Means of v over bins of y: middle of a bin, mean, error."""
    bins = int(height / width)
    which = np.floor(y / height * bins).astype(int) % bins
    means = []
    for block in np.array_split(np.arange(len(v)), BLOCKS):
        count = np.bincount(which[block].ravel(), minlength=bins)
        means.append(np.bincount(which[block].ravel(), v[block].ravel(), bins) / np.maximum(count, 1))
    return (np.arange(bins) + 0.5) * height / bins, *mean_error(np.array(means))


def flow_curve(path):
    """Rate and stress, means over the strain beyond 1 at each rate; strain counts, since steps vary in length."""
    rows, points = np.loadtxt(path, delimiter=",", skiprows=1), []
    for rate in np.unique(rows[:, 0]):
        _, strain, stress, _ = rows[rows[:, 0] == rate].T
        points.append((rate, np.interp(np.linspace(1.0, strain[-1], 2000), strain, stress).mean()))
    return np.array(points).T


def continuum(curve, height, density, liquid, hold=None, points=400):
    """y and velocity where d stress / dy = density mu0 (hold v - u), mu0 = 1, with u = liquid(y).

    The stress is that of the flow curve; below its slowest rate it is constant. hold(y) > 1 is drag of walls.
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
        v = np.linalg.solve(matrix, density * u * np.where(drag > 1e3, drag, 1.0))
        rate = np.maximum(np.abs(np.diff(v)) / step, 1e-9)
        stress = np.exp(np.interp(np.log(rate), np.log(curve[0]), np.log(curve[1])))
        viscosity = np.sqrt(viscosity * stress / rate)      # half-way, so that it does not swing
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
    print("\nchannel: a quarter of its length is driven")
    V = CHANNEL["V"]
    for wall, colour in ((0.0, BLUE), (0.5, GREEN), (1.0, RED)):
        frames = Frames(directory / f"channel-wall-{wall:g}.dump")
        v, x = frames.moves()
        length, height = frames.side
        y, mean, error = profile(v[..., 0], x[..., 1], height)
        left.errorbar(mean / V, y, xerr=error / V, color=colour, marker="o", ms=3, lw=0, elinewidth=1,
                      label=f"wall drag {wall:g}")
        driven = (np.abs(x[..., 0] % length / length - 0.5) < 0.5 * CHANNEL["along"]).mean()
        touch = (x[..., 1] < frames.radius) | (x[..., 1] > height - frames.radius)
        w = touch.mean()
        layer = 0.5 * w * height
        beta = wall / (1 - wall) if wall < 1 else 1e6

        def hold(y):
            return np.where(np.minimum(y, height - y) < layer, 1 + beta, 1.0)

        line = continuum(curve, height, frames.density, lambda y: np.full_like(y, driven * V), hold)
        left.plot(line[1] / V, line[0], color=colour, lw=1.2)
        blocks = np.array([[v[b][..., 0].mean(), v[b][..., 0][touch[b]].mean()]
                           for b in np.array_split(np.arange(len(v)), BLOCKS)])
        (all_of, at_wall), (off, off_wall) = mean_error(blocks)
        print(f"  wall drag {wall:g}: driven part {driven:.4f}, touching {w:.4f}; mean {all_of / V:.4f} +- "
              f"{off / V:.4f} V, at the walls {at_wall / V:.4f} +- {off_wall / V:.4f}; middle "
              f"{mean[len(y) // 2] / V:.4f} +- {error[len(y) // 2] / V:.4f}, of the continuum {line[1][200] / V:.4f}"
              + (f"; balance {(all_of + beta * w * at_wall) / V:.4f}" if wall < 1 else ""))
    circles = bubbles(picture, frames, -1, stripes(frames), cmap="coolwarm", clim=(-0.25, 1.25))
    del circles
    picture.axvspan(*(length * (0.5 + s * 0.5 * CHANNEL["along"]) for s in (-1, 1)), color="k", alpha=0.15, lw=0)
    picture.set_title("walls that hold; grey: driven part")
    left.set(xlabel=r"velocity / $V$", ylabel=r"$y$", ylim=(0, height), title="a quarter of the length driven")
    left.legend(loc="center", fontsize=10)

    print("channel: a fifth of its width is driven, walls stick")
    V, across = JET["V"], JET["across"]
    for name, label, colour in (("static", "static", BLUE), ("contact", "contact 10", GREEN),
                                ("neighbor", "neighbor", RED)):
        frames = Frames(directory / f"channel-jet-{name}.dump")
        v, x = frames.moves()
        height = frames.side[1]
        y, mean, error = profile(v[..., 0], x[..., 1], height)
        right.errorbar(mean / V, y, xerr=error / V, color=colour, marker="o", ms=3, lw=0, elinewidth=1,
                       label=f"drag {label}")
        reach = np.interp(0.1, (mean / V)[:len(y) // 2], y[:len(y) // 2])
        print(f"  drag {label}: middle {mean[len(y) // 2] / V:.4f} +- {error[len(y) // 2] / V:.4f} V, mean "
              f"{mean.mean() / V:.4f}; a tenth of V at {0.5 * (1 - across) * height - reach:.1f} from the jet")
        if name == "static":
            hold = np.where
            line = continuum(curve, height, frames.density,
                             lambda y: np.where(np.abs(y / height - 0.5) < 0.5 * across, V, 0.0),
                             lambda y: hold(np.minimum(y, height - y) < 1.5, 1e6, 1.0))
            right.plot(line[1] / V, line[0], color=colour, lw=1.2)
        if name == "neighbor":
            edge = 0.5 * (1 - across) * height
            right.plot([0, 1, 1, 0], [0, edge, height - edge, height], color=colour, lw=1.2)
    right.axhspan(*(height * (0.5 + s * 0.5 * across) for s in (-1, 1)), color="k", alpha=0.08, lw=0)
    right.set(xlabel=r"velocity / $V$", ylabel=r"$y$", ylim=(0, height), title="a fifth of the width driven")
    right.legend(loc="lower right", fontsize=10)
    save(fig, directory / "flow-channel.png")


def slip_in_box(frames):
    """Velocity relative to a box that is sheared, and y in it. Unwrapped places are of one image all the time."""
    v, x = frames.moves()
    y = frames.path[:, :, 1]
    y = (0.5 * (y[1:] + y[:-1]))[-len(v):]
    return v[..., 0] - COUETTE["rate"] * y, x[..., 1] % frames.side[1]


def draw_couette(directory, curve):
    fig, (picture, left, right) = plt.subplots(1, 3, figsize=(13.5, 4.7), layout="constrained")
    rate, layer = COUETTE["rate"], COUETTE["layer"]
    print("\nCouette flow")
    for name, label, colour in (("layers-static", "layers, static", BLUE),
                                ("layers-contact", "layers, contact 10", GREEN),
                                ("layers-neighbor", "layers, neighbor", "#b59400"),
                                ("plates-neighbor", "plates, neighbor", RED), ("box", "box that is sheared", "k")):
        frames = Frames(directory / f"couette-{name}.dump")
        height = frames.side[1]
        V = 0.5 * rate * (height - 2 * layer)
        if name == "box":
            slip, y = slip_in_box(frames)
            y, off, error = profile(slip, y, height)
            straight = rate * (y - 0.5 * height)
            mean = straight + off
            v = slip
        else:
            v, x = frames.moves()
            v = v[..., 0]
            y, mean, error = profile(v, x[..., 1], height)
            straight = np.clip(rate * (y - 0.5 * height), -V, V)
            off = mean - straight
        drift = mean_error(np.array([v[b].mean() for b in np.array_split(np.arange(len(v)), BLOCKS)]))
        inner = slice(None) if name == "box" else (y > layer + 2.5) & (y < height - layer - 2.5)
        far = np.abs(off[inner]).argmax()
        slope = np.polyfit(y[inner], mean[inner], 1, cov=True)
        print(f"  {label}: mean {drift[0] / V:.2e} +- {drift[1] / V:.1e} V, slope {slope[0][0] / rate:.3f} of the one "
              f"wanted; largest deviation {off[inner][far] / V:.4f} +- {error[inner][far] / V:.4f} V, rms "
              f"{np.sqrt((off[inner]**2).mean()) / V:.4f}, rms of errors {np.sqrt((error[inner]**2).mean()) / V:.4f}; "
              f"at the lower wall {mean[0] / V:.3f} +- {error[0] / V:.3f}")
        left.errorbar(mean / V, y, xerr=error / V, color=colour, marker="o", ms=3, lw=0, elinewidth=1, label=label)
        if name == "layers-static":
            line = continuum(curve, height, frames.density,
                             lambda y: np.where(y < layer, -V, np.where(y > height - layer, V, 0.0)))
            left.plot(line[1] / V, line[0], color=colour, lw=1.2)
        if name in ("box", "plates-neighbor"):
            right.errorbar(off[inner] / V, y[inner], xerr=error[inner] / V, color=colour, marker="o", ms=3, lw=0,
                           elinewidth=1, label=label)
        if name == "plates-neighbor":
            number = int(np.searchsorted(frames.time - frames.time[0], 1.0 / rate))
            bubbles(picture, frames, number, stripes(frames), cmap="coolwarm", clim=(-0.25, 1.25))
            strain = (frames.time[number] - frames.time[0]) * rate
            picture.set_title(f"plates, neighbor, after a strain of {strain:.1f}")
    left.plot([-1, 1], [layer, height - layer], color="0.5", lw=1.2, zorder=0)
    left.set(xlabel=r"velocity / $V$", ylabel=r"$y$", ylim=(0, height))
    left.legend(fontsize=9, loc="upper left")
    right.axvline(0, color="0.5", lw=1.2, zorder=0)
    right.set(xlabel=r"(velocity $-$ linear) / $V$", ylabel=r"$y$", ylim=(0, height))
    right.legend(fontsize=10, loc="upper left")
    save(fig, directory / "flow-couette.png")


def follows(v, u):
    """How far the foam goes with the liquid: v.u / u.u, and its error."""
    rows = np.array([(v[b] * u[b]).sum() / (u[b]**2).sum() for b in np.array_split(np.arange(len(v)), BLOCKS)])
    return mean_error(rows)


def draw_vortex(directory, curve):
    fig, (picture, middle, right) = plt.subplots(1, 3, figsize=(13.5, 4.5), layout="constrained")
    print("\nvortices: part of the liquid's velocity that the foam has")
    found = []
    for U in SPEEDS:
        frames = Frames(directory / f"vortex-{U:g}.dump")
        side = frames.side[0]
        k = 2 * np.pi / side
        v, x = frames.moves()
        u = U * np.stack([np.sin(k * x[..., 0]) * np.cos(k * x[..., 1]),
                          -np.cos(k * x[..., 0]) * np.sin(k * x[..., 1])], axis=-1)
        found.append((U, *follows(v, u)))
        drift = v.mean((0, 1)) / U
        print(f"  U {U:g}: {found[-1][1]:.4f} +- {found[-1][2]:.4f}, mean velocity {drift[0]:.1e} {drift[1]:.1e} U")
        if U == 0.01:
            cells = 14
            which = (np.floor(x / side * cells).astype(int) % cells) @ [cells, 1]
            count = np.bincount(which.ravel(), minlength=cells**2)
            mean_v, mean_u = (np.stack([np.bincount(which.ravel(), f[..., c].ravel(), cells**2) / count
                                        for c in (0, 1)], axis=-1) for f in (v, u))
            centre = (np.stack(np.divmod(np.arange(cells**2), cells), axis=-1) + 0.5) * side / cells
            speed = np.linalg.norm(v[-1], axis=-1) / U
            circles = bubbles(picture, frames, -1, speed, cmap="Blues", clim=(0, 1))
            picture.quiver(*centre.T, *mean_v.T / U, color=RED, angles="xy", scale_units="xy", scale=1 / 6.5,
                           width=0.006)
            fig.colorbar(circles, ax=picture, shrink=0.85, label=r"speed / $U$")
            picture.set_title(f"$U$ = {U:g}; arrows: mean velocity")
            middle.plot(mean_u.ravel() / U, mean_v.ravel() / U, ".", color=BLUE, ms=4)
            middle.plot([-1, 1], [-1, 1], color="0.5", lw=1.2, zorder=0)
            middle.plot([-1, 1], [-found[-1][1], found[-1][1]], color=RED, lw=1.2)
            middle.set(xlabel="velocity of the liquid / $U$", ylabel="mean velocity of the foam / $U$",
                       title=f"both components, $U$ = {U:g}")
    U, part, error = np.array(found).T
    right.errorbar(U, part, error, color=BLUE, marker="o", ms=4, lw=1.2)
    yields = curve[1][0] * k / frames.density
    right.axvline(yields, color="0.5", lw=1.2, ls=":")
    right.annotate(r"$k \sigma_y / n \mu_0$", (yields, 1.0), xytext=(5, -4), textcoords="offset points", va="top")
    right.set(xscale="log", ylim=(0, 1.05), xlabel="$U$", ylabel="velocity of the foam by that of the liquid")
    print(f"  the stress of a foam at rest is that of the slowest flow, {curve[1][0]:.5f}, at U = {yields:.5f}")
    save(fig, directory / "flow-vortex.png")


def save(fig, path):
    fig.savefig(path, pil_kwargs={"optimize": True})
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
