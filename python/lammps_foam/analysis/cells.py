"""Laguerre (power) cells of a state, by pyvoro2; as a table, for ParaView (VTK) and for voro++.

The cell of a bubble is where |x - x_i|^2 - R_i^2 is less than for all others: the border of two bubbles that overlap
is the plane of their lens. Cells fill the box. A bubble that is deep in others may have no cell, and a bubble's centre
need not lie in its own cell.

volume    of the cell; the area in 2D
fraction  area (volume) of the bubble over that of its cell; above 1 where bubbles overlap much. Weighted by the cells,
          its mean is the gas fraction phi
sides     neighbours of the cell: edges in 2D, faces in 3D

BASE.vtu has a cell for each polygon or polyhedron with radius, volume, fraction, sides, id: ParaView opens it. Cells
lie around their bubbles and so stick out of a periodic box. BASE.xyzr has lines id x y z radius, as voro++ -r reads
them.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

import numpy as np

from . import figure, table
from .files import whole
from .frames import STATES, add_every, gas, optional, phi_of, selected
from .pairs import Index, checked, images, into_brick
from .read import Array, Box, Frame, Unusable
from .runs import Range, add_range, add_runs

POLYGON, POLYHEDRON = 7, 42    # cell types of VTK


@dataclass
class Cells:
    """Cells of n bubbles, in their order; a bubble without a cell has volume 0 and no sides."""

    volume: Array                   # (n,)
    sides: Index                    # (n,)
    corners: list[Array]            # of each bubble (corners, 3); in 2D in order around it
    faces: list[list[list[int]]]    # in 3D: of each bubble the faces, as numbers of its corners in order

    def total(self) -> float:
        """Sum of all cells: that of the box."""
        return float(self.volume.sum())


def power_cells(x: Array, radius: Array, box: Box) -> Cells:
    """Laguerre cells of bubbles at x (n, 3) with radius (n,), in any box; walls cut them."""
    pyvoro2 = optional("pyvoro2")
    d, tilted = box.dimension, bool(np.any(box.tilt))
    if tilted and not box.periodic[:d].all():
        raise Unusable("cells of a tilted box with walls are not known here")
    x = into_brick(x, box)
    outside = [axis for axis in range(d) if not box.periodic[axis]
               and np.any((x[:, axis] < box.lo[axis]) | (x[:, axis] >= box.hi[axis]))]
    if outside:
        raise Unusable(f"bubbles lie outside the walls along {'xyz'[outside[0]]}")
    bounds = tuple((float(low), float(high)) for low, high in zip(box.lo, box.hi))
    flags = tuple(bool(p) for p in box.periodic)
    ask: dict[str, Any] = {"mode": "power", "radii": radius, "include_empty": True, "output": "cells"}
    try:
        if d == 2 and not tilted:
            planar = optional("pyvoro2.planar")
            found = planar.compute(x[:, :2], domain=planar.RectangularCell(bounds[:2], flags[:2]), **ask)
            return _planar(found, len(x))
        if d == 2:    # a layer that repeats in z: each cell is a prism
            height = float(np.sqrt(box.volume / len(x)))
            edges = np.diag([0.0, 0.0, height])
            edges[:2, :2] = box.edges[:2, :2]
            places = np.column_stack([x[:, :2], np.full(len(x), height / 2)])
            domain = pyvoro2.PeriodicCell(tuple(map(tuple, edges.tolist())), (*box.lo[:2].tolist(), 0.0))
            return _flattened(_solid(pyvoro2.compute(places, domain=domain, **ask), len(x)), height)
        domain = (pyvoro2.PeriodicCell(tuple(map(tuple, box.edges.tolist())), tuple(box.lo.tolist())) if tilted
                  else pyvoro2.OrthorhombicCell(bounds, flags))
        return _solid(pyvoro2.compute(x, domain=domain, **ask), len(x))
    except ValueError as wrong:
        raise Unusable(f"pyvoro2: {str(wrong).splitlines()[0]}") from None


def _planar(found: list[dict[str, Any]], n: int) -> Cells:
    cells = Cells(np.zeros(n), np.zeros(n, dtype=np.intp), [np.empty((0, 3))] * n, [[] for _ in range(n)])
    for cell in found:
        k = int(cell["id"])
        corners = np.array(cell["vertices"], dtype=float).reshape(-1, 2)
        cells.volume[k], cells.sides[k] = cell["area"], len(cell["edges"])
        order = _around([edge["vertices"] for edge in cell["edges"]]) if len(corners) else []
        cells.corners[k] = np.column_stack([corners, np.zeros(len(corners))])[order]
    return cells


def _around(edges: list[Any]) -> list[int]:
    """Corners in order, from edges (pairs of corners) in any order."""
    beside: dict[int, list[int]] = {}
    for a, b in edges:
        beside.setdefault(int(a), []).append(int(b))
        beside.setdefault(int(b), []).append(int(a))
    start = min(beside)
    order, last = [start], -1
    while len(order) < len(beside):
        here = order[-1]
        step = next((k for k in beside[here] if k != last and k not in order[1:] and k != start), None)
        if step is None:
            break
        last = here
        order.append(step)
    return order


def _solid(found: list[dict[str, Any]], n: int) -> Cells:
    cells = Cells(np.zeros(n), np.zeros(n, dtype=np.intp), [np.empty((0, 3))] * n, [[] for _ in range(n)])
    for cell in found:
        k = int(cell["id"])
        cells.volume[k], cells.sides[k] = cell["volume"], len(cell["faces"])
        cells.corners[k] = np.array(cell["vertices"], dtype=float).reshape(-1, 3)
        cells.faces[k] = [[int(corner) for corner in face["vertices"]] for face in cell["faces"]]
    return cells


def _flattened(prisms: Cells, height: float) -> Cells:
    """2D cells of prisms of this height: the lower face, and two faces fewer."""
    corners = []
    for points, faces in zip(prisms.corners, prisms.faces):
        flat = [points[face] for face in faces if np.all(points[face][:, 2] < 1.0e-6 * height)]
        corners.append(flat[0] * [1.0, 1.0, 0.0] if flat else np.empty((0, 3)))
    return Cells(prisms.volume / height, np.maximum(prisms.sides - 2, 0), corners, [[] for _ in corners])


# ---------------------------------------------------------------- files for other programs

def vtu_text(cells: Cells, columns: dict[str, Array]) -> str:
    """An unstructured grid of VTK (XML, text) of the cells that are not empty, with columns (n,) as cell data.

    Format: VTK File Formats, docs.vtk.org; polyhedra with the arrays faces and faceoffsets.
    """
    kept = [k for k in range(len(cells.volume)) if len(cells.corners[k]) > 2]
    points: list[Array] = []
    connectivity: list[int] = []
    offsets, faces, face_offsets = [], [], []
    first = count = 0
    solid = any(cells.faces[k] for k in kept)
    for k in kept:
        points.append(cells.corners[k])
        connectivity += range(first, first + len(cells.corners[k]))
        offsets.append(len(connectivity))
        if solid:
            words = [len(cells.faces[k])]
            for face in cells.faces[k]:
                words += [len(face), *(first + corner for corner in face)]
            faces += words
            count += len(words)
            face_offsets.append(count)
        first += len(cells.corners[k])
    types = [POLYHEDRON if solid else POLYGON] * len(kept)
    topology = {"connectivity": connectivity, "offsets": offsets, "types": types}
    if solid:
        topology |= {"faces": faces, "faceoffsets": face_offsets}
    flat = np.concatenate(points) if points else np.empty((0, 3))
    return "\n".join([
        '<?xml version="1.0"?>', '<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">',
        "<UnstructuredGrid>", f'<Piece NumberOfPoints="{len(flat)}" NumberOfCells="{len(kept)}">',
        "<CellData>", *(_array("Float64", name, column[kept]) for name, column in columns.items()), "</CellData>",
        "<Points>", _array("Float64", "Points", flat.ravel(), ' NumberOfComponents="3"'), "</Points>",
        "<Cells>", *(_array("UInt8" if name == "types" else "Int64", name, np.array(values, dtype=np.int64))
                     for name, values in topology.items()), "</Cells>",
        "</Piece>", "</UnstructuredGrid>", "</VTKFile>", ""])


def _array(kind: str, name: str, values: Any, more: str = "") -> str:
    words = [f"{value:.10g}" for value in values] if kind == "Float64" else [str(int(value)) for value in values]
    lines = [" ".join(words[n:n + 12]) for n in range(0, len(words), 12)]
    return "\n".join([f'<DataArray type="{kind}" Name="{name}"{more} format="ascii">', *lines, "</DataArray>"])


def voro_text(ids: Array, x: Array, radius: Array) -> str:
    """Lines id x y z radius, as voro++ -r reads them."""
    return "".join(f"{number:.0f} {a:.12g} {b:.12g} {c:.12g} {r:.12g}\n"
                   for number, (a, b, c), r in zip(ids, x, radius))


def write_text(path: Path, text: str) -> None:
    """Whole or not at all."""
    with whole(path) as part:
        part.write_text(text)


# ---------------------------------------------------------------- command line

def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_runs(parser, STATES, "cells")
    add_range(parser, "frames to look at; cells are written of the last of them", "the last frame")
    add_every(parser)
    parser.add_argument("--colour", default="fraction", metavar="COLUMN",
                        help="volume, fraction, sides, radius, or a column of the dump (default: fraction)")
    parser.epilog = ("BASE.csv has a line for each bubble; BASE-sides.csv the distribution of the number of sides\n"
                     "example: for ParaView, while 2000 bubbles are left\n"
                     "  lammps-foam cells DIR --N 2000 1900 --out cells")


def main(args: argparse.Namespace) -> int:
    if len(args.runs) > 1:
        raise Unusable(f"{len(args.runs)} runs are given; cells are of one state")
    frame, tau = None, float("nan")
    for _, frame, tau in selected(args.runs, Range(args.tau, args.N), args.every):
        pass
    frame = cast(Frame, frame)
    x, radius = checked(frame)
    if not np.any(radius > 0):
        raise Unusable(f"{frame.path}, step {frame.step}: all radii are 0")
    cells = power_cells(x, radius, frame.box)
    columns = columns_of(frame, cells)
    if args.colour not in columns:
        columns[args.colour] = frame[args.colour]
    table.write({"x": x[:, 0], "y": x[:, 1], "z": x[:, 2], **columns}, table.with_end(args.out, ".csv"))
    write_text(table.with_end(args.out, ".vtu"), vtu_text(cells, columns))
    write_text(table.with_end(args.out, ".xyzr"), voro_text(columns["id"], into_brick(x, frame.box), radius))
    count = np.bincount(cells.sides[cells.volume > 0])
    shares = {"sides": np.arange(len(count), dtype=float), "share": count / count.sum(),
              "error": np.sqrt(count) / count.sum()}    # of independent cells
    shares = {name: column[count > 0] for name, column in shares.items()}
    table.write(shares, table.with_end(args.out, "-sides.csv"))
    table.show(shares)
    empty = int(np.count_nonzero(cells.volume == 0))
    print(f"\nstep {frame.step}, tau {tau:.5g}: {len(x)} bubbles, {empty} without a cell; mean number of sides "
          f"{cells.sides[cells.volume > 0].mean():.4f}\nsum of cells over the box "
          f"{cells.total() / frame.box.volume:.12f}, gas fraction {phi_of(frame):.6g}")
    _draw(frame, cells, columns[args.colour], args.colour, shares, args.out)
    return 0


def columns_of(frame: Frame, cells: Cells) -> dict[str, Array]:
    """Columns (n,): id, radius, volume, fraction (nan without a cell), sides."""
    ids = frame.columns.get("id", np.arange(1.0, len(frame) + 1))
    content = gas(frame.radius, frame.box.dimension)
    fraction = np.divide(content, cells.volume, out=np.full(len(frame), np.nan), where=cells.volume > 0)
    return {"id": ids, "radius": frame.radius, "volume": cells.volume, "fraction": fraction,
            "sides": cells.sides.astype(float)}


def _draw(frame: Frame, cells: Cells, values: Array, name: str, shares: dict[str, Array], out: str) -> None:
    from matplotlib.collections import EllipseCollection, PolyCollection

    box, x = frame.box, into_brick(frame.positions, frame.box)
    if box.dimension == 3:
        fig, (ax,) = figure.panels()
        ax.bar(shares["sides"], shares["share"], yerr=shares["error"], width=0.8, error_kw={"lw": 0.8})
        ax.set(xlabel="faces of a cell", ylabel="share of bubbles")
        figure.save(fig, out)
        return
    fig, (left, right) = figure.panels(1, 2, width=3.4, height=3.0)
    kept = [k for k in range(len(x)) if len(cells.corners[k]) > 2]
    low, high = np.nanquantile(values[kept], [0.02, 0.98])
    reach = max(float(np.ptp(cells.corners[k], axis=0).max()) for k in kept)
    index, places, _ = images(x, box, reach)    # what reaches into the box through its faces, too
    shown = np.isin(index, kept)
    moved = places - x[index]
    polygons = PolyCollection([(cells.corners[k] + by)[:, :2] for k, by in zip(index[shown], moved[shown])],
                              array=values[index[shown]], cmap="viridis",
                              clim=(low, high), edgecolors="k", linewidths=0.2)
    left.add_collection(polygons)
    size = 2 * frame.radius[index]
    left.add_collection(EllipseCollection(size, size, np.zeros(len(size)), units="xy", offsets=places[:, :2],
                                          facecolors="none", edgecolors="w", linewidths=0.2,
                                          offset_transform=left.transData))
    left.set(xlim=(box.lo[0], box.hi[0]), ylim=(box.lo[1], box.hi[1]), aspect="equal", xticks=[], yticks=[])
    left.minorticks_off()
    fig.colorbar(polygons, ax=left, label=name, shrink=0.9, extend="both")
    right.bar(shares["sides"], shares["share"], yerr=shares["error"], width=0.8, error_kw={"lw": 0.8})
    right.set(xlabel="sides of a cell", ylabel="share of bubbles")
    figure.save(fig, out)
