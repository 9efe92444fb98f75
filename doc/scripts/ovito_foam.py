#!/usr/bin/env python3
"""A picture of a 3D foam by OVITO, without a screen.

    pip install ovito
    python3 ovito_foam.py foam.lammpstrj foam3d.png [--frame N] [--cut] [--colour COLUMN]

With a column `radius` OVITO draws each bubble in its size. --cut takes a quarter of the box away, to look inside.
"""
import argparse

from ovito.io import import_file
from ovito.modifiers import ColorCodingModifier, ExpressionSelectionModifier, DeleteSelectedModifier
from ovito.vis import TachyonRenderer, Viewport


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("dump")
    parser.add_argument("picture")
    parser.add_argument("--frame", type=int, default=-1, help="number of the snapshot (default: the last)")
    parser.add_argument("--colour", default="Radius", help="name of a column (default: Radius)")
    parser.add_argument("--cut", action="store_true", help="take a quarter of the box away")
    parser.add_argument("--size", type=int, nargs=2, default=[900, 800], help="in pixels")
    args = parser.parse_args()

    pipeline = import_file(args.dump)
    frame = args.frame % pipeline.num_frames
    if args.cut:
        quarter = "ReducedPosition.X > 0.5 && ReducedPosition.Y < 0.5"
        pipeline.modifiers.append(ExpressionSelectionModifier(expression=quarter))
        pipeline.modifiers.append(DeleteSelectedModifier())
    pipeline.modifiers.append(ColorCodingModifier(property=args.colour, gradient=ColorCodingModifier.Viridis()))
    pipeline.add_to_scene()
    pipeline.compute(frame).cell.vis.line_width = 0.2
    view = Viewport(type=Viewport.Type.Perspective, camera_dir=(-1.0, 1.6, -0.9))
    view.zoom_all(size=tuple(args.size))
    view.render_image(filename=args.picture, size=tuple(args.size), frame=frame, background=(1, 1, 1),
                      renderer=TachyonRenderer(ambient_occlusion=True, antialiasing_samples=8))


if __name__ == "__main__":
    main()
