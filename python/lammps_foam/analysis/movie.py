"""A movie of a run: discs in 2D; in 3D shaded spheres, seen from outside, or a slice through the box.

Written as mp4 where imageio-ffmpeg is installed (pip install "lammps-foam[analysis]"), else as GIF. Colours have the
same range in all pictures: --range, or what covers 98 % of the bubbles of the first and of the last frame. --log T
shows frames at equal steps of ln(tau), for each picture the nearest of the dump.
"""

from __future__ import annotations

import argparse
import os
from pathlib import Path
import time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import table
from .files import whole
from .frames import add_every, optional, say
from .pairs import checked, images, into_brick
from .read import Array, Frame, Unusable
from .runs import Range, add_range, add_runs, chosen_frames

Picture = NDArray[np.uint8]
LIGHT = np.array([-0.45, 0.55, 0.70])


# ---------------------------------------------------------------- pictures of bubbles

def drawn(place: Array, radius: Array, depth: Array | None, colour: Array, width: int, height: int,
          background: float = 1.0) -> Array:
    """Discs, or spheres if depth is given, as a picture (height, width, 3) of numbers from 0 to 1.

    place (n, 2) and radius (n,) in pixels, y upwards; depth (n,): how near, in pixels; colour (n, 3). Spheres hide what
    is behind them, pixel by pixel; discs have a dark rim.
    """
    picture = np.full((height, width, 3), background)
    nearest = np.full((height, width), -np.inf)
    order = np.argsort(-radius) if depth is None else np.argsort(depth)
    for k in order:
        (x, y), r = place[k], radius[k]
        left, right = max(0, int(np.floor(x - r))), min(width, int(np.ceil(x + r)) + 1)
        low, high = max(0, int(np.floor(y - r))), min(height, int(np.ceil(y + r)) + 1)
        if left >= right or low >= high:
            continue
        dx, dy = np.meshgrid(np.arange(left, right) + 0.5 - x, np.arange(low, high) + 0.5 - y)
        square = dx**2 + dy**2
        part = picture[low:high, left:right]
        if depth is None:
            cover = np.clip(r - np.sqrt(square) + 0.5, 0, 1)[..., None]
            rim = np.clip(r - np.sqrt(square) - 0.5, 0.35, 1)[..., None] if r > 2.5 else 1.0
            part[:] = part * (1 - cover) + cover * rim * colour[k]
            continue
        up = np.sqrt(np.maximum(r**2 - square, 0.0))
        before = nearest[low:high, left:right]
        front = (square < r**2) & (depth[k] + up > before)
        shade = 0.35 + 0.65 * np.maximum((dx * LIGHT[0] + dy * LIGHT[1] + up * LIGHT[2]) / r, 0.0)
        part[front] = shade[front][:, None] * colour[k]
        before[front] = (depth[k] + up)[front]
    return picture[::-1]


def view(azimuth: float, elevation: float) -> Array:
    """(3, 3): rows to the right, upwards and towards the eye, for angles in degrees."""
    a, e = np.radians(azimuth), np.radians(elevation)
    right = np.array([-np.sin(a), np.cos(a), 0.0])
    eye = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    return np.stack([right, np.cross(eye, right), eye])


def picture_of(frame: Frame, values: Array, limits: tuple[float, float], args: argparse.Namespace) -> Array:
    """The bubbles of a frame, (about args.pixels high, ..., 3); all frames of a box of one shape have the same size."""
    from matplotlib import colormaps

    x, radius = checked(frame)
    box = frame.box
    low, high = limits
    colour = colormaps[args.map](np.clip((values - low) / (high - low or 1.0), 0, 1))[:, :3]
    x = into_brick(x, box)
    if box.dimension == 3 and args.slice is None:
        axes = view(*args.view)
        corners = np.stack(np.meshgrid(*([0, 1],) * 3), axis=-1).reshape(-1, 3) * box.lengths @ axes.T
        least, most = corners.min(axis=0), corners.max(axis=0)
        margin = 0.03 * (most - least)[:2].max()
        scale = args.pixels / (most - least + 2 * margin)[1]
        place = (x - box.lo) @ axes.T
        width = int(scale * (most - least + 2 * margin)[0]) // 2 * 2
        return drawn((place[:, :2] - least[:2] + margin) * scale, radius * scale, place[:, 2] * scale, colour, width,
                     args.pixels)
    if box.dimension == 3:
        height = box.lo[2] + args.slice * box.lengths[2]
        index, x, _ = images(x, box, radius)
        cut = np.abs(x[:, 2] - height) < radius[index]
        index, x = index[cut], x[cut]
        radius = np.sqrt(radius[index]**2 - (x[:, 2] - height)**2)
    else:
        index, x, _ = images(x, box, radius)
        radius = radius[index]
    scale = args.pixels / box.lengths[1]
    width = max(2, int(scale * box.lengths[0]) // 2 * 2)
    return drawn((x[:, :2] - box.lo[:2]) * scale, radius * scale, None, colour[index], width, args.pixels)


def captioned(picture: Array, text: str, name: str, limits: tuple[float, float], colours: str) -> Picture:
    """With tau and N above and the scale of colours below; sides are even, as mp4 wants it."""
    from matplotlib import colormaps
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    height, width = picture.shape[:2]
    bar = 2 * max(14, height // 34)
    strips = []
    for below in (False, True):
        fig = Figure(figsize=(width / 100, bar / 100), dpi=100)
        canvas = FigureCanvasAgg(fig)
        size = 0.36 * bar
        if not below:
            fig.text(0.01, 0.5, text, va="center", fontsize=size)
        else:
            ax = fig.add_axes((0.5, 0.3, 0.3, 0.4))
            ax.imshow(colormaps[colours](np.linspace(0, 1, 256))[None, :, :3], aspect="auto")
            ax.set_axis_off()
            fig.text(0.34, 0.5, name, va="center", ha="right", fontsize=size)
            fig.text(0.49, 0.5, f"{limits[0]:.3g}", va="center", ha="right", fontsize=size)
            fig.text(0.81, 0.5, f"{limits[1]:.3g}", va="center", fontsize=size)
        canvas.draw()    # type: ignore[no-untyped-call]
        strips.append(np.asarray(canvas.buffer_rgba())    # type: ignore[no-untyped-call]
                      [:bar, :width, :3])
    body = (255 * np.clip(picture, 0, 1)).astype(np.uint8)
    whole = np.concatenate([strips[0], body, strips[1]])
    return np.ascontiguousarray(whole[:whole.shape[0] // 2 * 2, :whole.shape[1] // 2 * 2])


# ---------------------------------------------------------------- files

class Writer:
    """Pictures of one size to an mp4, or a GIF; whole or not at all."""

    def __init__(self, base: str, kind: str, rate: float) -> None:
        self.final = table.with_end(base, f".{kind}")
        self.part = self.final.with_name(f".{self.final.stem}.part.{kind}")
        self.kind, self.rate, self.shape = kind, rate, (0, 0)
        self.pictures: list[Any] = []
        self.stream: Any = None

    def add(self, picture: Picture) -> None:
        """One picture; a box that changes its shape is cut or filled up with white."""
        if self.shape == (0, 0):
            self.shape = picture.shape[:2]
            self.final.parent.mkdir(parents=True, exist_ok=True)
            if self.kind == "mp4":
                ffmpeg = optional("imageio_ffmpeg")
                self.stream = ffmpeg.write_frames(str(self.part), (self.shape[1], self.shape[0]), fps=self.rate,
                                                  quality=8, macro_block_size=2, ffmpeg_log_level="error")
                self.stream.send(None)
        full = np.full((*self.shape, 3), 255, dtype=np.uint8)
        rows, columns = np.minimum(picture.shape[:2], self.shape)
        full[:rows, :columns] = picture[:rows, :columns]
        if self.stream is not None:
            self.stream.send(full)
        else:
            from PIL import Image
            self.pictures.append(Image.fromarray(full).quantize(128))

    def close(self, good: bool) -> None:
        """Finish the file, or throw it away."""
        try:
            if self.stream is not None:
                self.stream.close()
            elif good and self.pictures:
                self.pictures[0].save(self.part, save_all=True, append_images=self.pictures[1:], loop=0,
                                      duration=1000 / self.rate)
            if good:
                os.replace(self.part, self.final)
        finally:
            self.part.unlink(missing_ok=True)


def kind_of_file(wanted: str) -> str:
    """mp4 or gif; auto: mp4 if there is a program for it."""
    if wanted != "auto":
        return wanted
    try:
        optional("imageio_ffmpeg")
    except Unusable:
        return "gif"
    return "mp4"


# ---------------------------------------------------------------- command line

def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_runs(parser, "a dump with the columns x y z radius", "movie")
    add_range(parser, "frames to show", "all")
    add_every(parser)
    parser.add_argument("--log", type=int, metavar="T", help="T pictures at equal steps of ln(tau)")
    parser.add_argument("--colour", default="radius", metavar="COLUMN",
                        help="a column of the dump, or speed from vx vy vz (default: radius)")
    parser.add_argument("--range", nargs=2, type=float, metavar=("LOW", "HIGH"), help="of the colours")
    parser.add_argument("--map", default="viridis", help="colours, by their name in matplotlib (default: viridis)")
    parser.add_argument("--slice", type=float, metavar="S", help="3D: a slice across z at this part of the box, 0 to 1")
    parser.add_argument("--view", nargs=2, type=float, default=(35.0, 25.0), metavar=("AZIMUTH", "ELEVATION"),
                        help="3D: from where, in degrees (default: 35 25)")
    parser.add_argument("--pixels", type=int, default=720, help="height of the box (default: 720)")
    parser.add_argument("--rate", type=float, default=12.0, help="pictures per second (default: 12)")
    parser.add_argument("--format", choices=("auto", "mp4", "gif"), default="auto")
    parser.epilog = ("writes BASE.mp4 or BASE.gif, and the last picture as BASE.png\n"
                     "example: 60 pictures at equal steps of ln(tau), in colours of the speed\n"
                     "  lammps-foam movie DIR --log 60 --colour speed --out movie")


def main(args: argparse.Namespace) -> int:
    from matplotlib import colormaps

    if len(args.runs) > 1:
        raise Unusable(f"{len(args.runs)} runs are given; a movie is of one")
    for name, bad in (("pixels", args.pixels < 16), ("rate", not args.rate > 0), ("every", args.every < 1),
                      ("log", args.log is not None and args.log < 2),
                      ("slice", args.slice is not None and not 0 <= args.slice <= 1)):
        if bad:
            raise Unusable(f"--{name} {getattr(args, name)} is not allowed; see lammps-foam movie -h")
    if args.map not in colormaps:
        raise Unusable(f"--map {args.map} is not known to matplotlib; viridis, plasma, coolwarm, ... are")
    args.pixels = args.pixels // 2 * 2
    counts, limits = _looked_through(args)
    total, begun, done = sum(counts.values()), time.monotonic(), 0
    writer, picture, good = Writer(args.out, kind_of_file(args.format), args.rate), None, False
    try:
        for number, (frame, tau) in enumerate(chosen_frames(args.runs[0], Range(args.tau, args.N))):
            if number not in counts:
                continue
            clock = rf"$\tau$ = {tau:.4g}" if np.isfinite(tau) else f"step {frame.step}"
            picture = captioned(picture_of(frame, colour_values(frame, args.colour), limits, args),
                                f"{clock}     N = {len(frame)}", args.colour, limits, args.map)
            for _ in range(counts[number]):
                writer.add(picture)
            done += counts[number]
            rest = (time.monotonic() - begun) * (total - done) / done
            say(f"picture {done} of {total}, about {rest:.0f} s to go")
        good = picture is not None
    finally:
        say("")
        writer.close(good)
    if picture is not None:
        _save_png(picture, table.with_end(args.out, ".png"))
    print(f"{writer.final}: {total} pictures")
    return 0


def colour_values(frame: Frame, name: str) -> Array:
    """(n,): the column that gives the colours."""
    if name == "speed" and "speed" not in frame.columns:
        square = frame["vx"]**2 + frame["vy"]**2 + (frame["vz"]**2 if frame.box.dimension == 3 else 0.0)
        return np.asarray(np.sqrt(square))
    return frame[name]


def _looked_through(args: argparse.Namespace) -> tuple[dict[int, int], tuple[float, float]]:
    """How often each chosen frame is shown, by its number, and the range of the colours."""
    taus: list[float] = []
    ends: list[Frame] = []
    last: Any = None
    for frame, tau in chosen_frames(args.runs[0], Range(args.tau, args.N)):
        if len(frame) and not ends:
            ends.append(frame)
        last = frame if len(frame) else last
        taus.append(tau)
    if not ends:
        raise Unusable(f"{args.runs[0]}: no frame with bubbles {'in this range' if args.tau or args.N else 'yet'}")
    ends.append(last)
    bounds = [np.nanquantile(colour_values(frame, args.colour), [0.01, 0.99]) for frame in ends]
    low, high = args.range or (min(low for low, _ in bounds), max(high for _, high in bounds))
    if args.log is None:
        return {number: 1 for number in range(0, len(taus), args.every)}, (float(low), float(high))
    return at_equal_steps(np.array(taus), args.log), (float(low), float(high))


def at_equal_steps(taus: Array, pictures: int) -> dict[int, int]:
    """Which frames stand for equal steps of ln(tau), and how often each: the nearest in ln(tau)."""
    positive = np.flatnonzero(taus > 0)
    if len(positive) < 2:
        raise Unusable("--log needs two frames or more whose tau is known, from series.csv beside the dump")
    ln = np.log(taus[positive])
    steps = np.linspace(ln[0], ln[-1], pictures)
    nearest = positive[np.argmin(np.abs(ln[None] - steps[:, None]), axis=1)]
    frames, counts = np.unique(nearest, return_counts=True)
    return {int(frame): int(count) for frame, count in zip(frames, counts)}


def _save_png(picture: Picture, path: Path) -> None:
    from matplotlib import image

    with whole(path) as part:
        image.imsave(part, picture)
