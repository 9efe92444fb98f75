"""Laguerre cells: lattices, two bubbles with a known border, sums over the box, and the files read back."""

import csv
import re
from xml.etree import ElementTree

import numpy as np
import pytest

pytest.importorskip("pyvoro2")

from lammps_foam.analysis import cells
from lammps_foam.command import analyse
from test_contacts import box_of, lattice, triangular, write_dump

BOXES = {"2D": box_of([12.0, 10.0, 1.0], 2), "2D tilted": box_of([12.0, 10.0, 1.0], 2, (4, 0, 0)),
         "2D walls": box_of([12.0, 10.0, 1.0], 2, periodic=(True, False, True)),
         "3D": box_of([6.0, 5.0, 7.0], 3), "3D tilted": box_of([6.0, 5.0, 7.0], 3, (2, -1.5, 1)),
         "3D walls": box_of([6.0, 5.0, 7.0], 3, periodic=(False, False, False))}


def foam(box, rng, n=60):
    x = rng.random((n, 3)) @ box.edges
    if box.dimension == 2:
        x[:, 2] = 0
    return x, rng.uniform(0.2, 0.9, n)


@pytest.mark.parametrize("name", BOXES)
def test_cells_fill_the_box_and_points_lie_in_theirs(name, rng):
    """Cells by the least power distance of points at random, against their volumes: counting error, 4 sigma."""
    box = BOXES[name]
    x, radius = foam(box, rng)
    found = cells.power_cells(x, radius, box)
    assert found.total() == pytest.approx(box.volume, rel=1e-9)
    points = rng.random((8000, 3)) @ box.edges
    if box.dimension == 2:
        points[:, 2] = 0
    best, owner = np.full(len(points), np.inf), np.zeros(len(points), int)
    for k in range(len(x)):
        power = np.sum(box.minimum_image(points - x[k])**2, axis=1) - radius[k]**2
        owner[power < best] = k
        best = np.minimum(best, power)
    share = np.bincount(owner, minlength=len(x)) / len(points)
    expected = found.volume / box.volume
    assert np.all(np.abs(share - expected) < 4.5 * np.sqrt(expected / len(points)) + 1e-4)


def test_tilted_by_a_whole_box_is_the_same(rng):
    for name, tilt in (("2D", (12, 0, 0)), ("3D", (6, 0, 0)), ("3D", (0, -6, 5))):
        box = BOXES[name]
        x, radius = foam(box, rng)
        straight = cells.power_cells(x, radius, box)
        tilted = cells.power_cells(x, radius, box_of(box.lengths, box.dimension, tilt))
        np.testing.assert_allclose(tilted.volume, straight.volume, atol=1e-7 * box.volume)
        assert np.mean(tilted.sides == straight.sides) > 0.98    # sides of no length are or are not counted


def test_lattices():
    x, box = triangular(5)
    found = cells.power_cells(x, np.full(len(x), 0.5), box)
    assert np.all(found.sides == 6)
    np.testing.assert_allclose(found.volume, np.sqrt(3) / 2, rtol=1e-9)
    bcc = lattice((3, 3, 3), [(0, 0, 0), (0.5, 0.5, 0.5)], np.eye(3))
    found = cells.power_cells(bcc + 0.1, np.full(54, 0.3), box_of([3, 3, 3], 3))
    assert np.all(found.sides == 14)    # truncated octahedra
    np.testing.assert_allclose(found.volume, 0.5, rtol=1e-9)


def test_border_is_the_plane_of_the_lens():
    """Two bubbles in a long box: the border at a = (r^2 + R_j^2 - R_i^2) / (2 r) from j, on either side."""
    box = box_of([8.0, 1.0, 1.0], 2)
    x, radius = np.array([[2.0, 0.5, 0], [5.0, 0.5, 0]]), np.array([2.0, 1.5])
    near, far = (((r**2 + radius[1]**2 - radius[0]**2) / (2 * r)) for r in (3.0, 5.0))
    found = cells.power_cells(x, radius, box)
    np.testing.assert_allclose(found.volume, [8 - near - far, near + far], rtol=1e-9)


def test_a_bubble_without_a_cell(rng):
    box = BOXES["2D"]
    x, radius = foam(box, rng, 30)
    x, radius = np.vstack([x, x[0] + [0.1, 0, 0]]), np.append(radius, 1e-3)
    radius[0] = 1.5
    found = cells.power_cells(x, radius, box)
    assert found.volume[-1] == 0 and found.sides[-1] == 0 and found.total() == pytest.approx(box.volume)


def area_of(corners):
    a, b = corners[:, :2], np.roll(corners[:, :2], -1, axis=0)
    return abs(np.sum(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])) / 2


def volume_of(points, faces, middle):
    """Volume of a polyhedron with faces in order around them: pyramids over a point inside."""
    total = 0.0
    for face in faces:
        p = points[face] - middle
        total += abs(sum(np.dot(p[0], np.cross(p[k], p[k + 1])) for k in range(1, len(p) - 1))) / 6
    return total


@pytest.mark.parametrize("name", ["2D", "2D tilted", "3D", "3D tilted"])
def test_vtu_read_back(name, rng):
    """The file by a reader of XML: counts, offsets and types fit, and the shapes have the volumes of the cells."""
    box = BOXES[name]
    x, radius = foam(box, rng, 60)
    found = cells.power_cells(x, radius, box)
    kept = np.array([len(c) > 2 for c in found.corners])
    tree = ElementTree.fromstring(cells.vtu_text(found, {"volume": found.volume, "radius": radius}))
    arrays = {a.get("Name"): np.array((a.text or "").split(), float) for a in tree.iter("DataArray")}
    piece = next(tree.iter("Piece"))
    assert int(piece.get("NumberOfCells")) == kept.sum() == len(arrays["offsets"]) == len(arrays["types"])
    points = arrays["Points"].reshape(-1, 3)
    assert int(piece.get("NumberOfPoints")) == len(points) == arrays["offsets"][-1] == len(arrays["connectivity"])
    assert set(arrays["types"]) == {7.0 if box.dimension == 2 else 42.0}
    np.testing.assert_allclose(arrays["radius"], radius[kept], rtol=1e-9)
    starts = np.concatenate([[0], arrays["offsets"][:-1]]).astype(int)
    stream, place = [int(word) for word in arrays.get("faces", [])], 0
    for k, (start, end) in enumerate(zip(starts, arrays["offsets"].astype(int))):
        if box.dimension == 2:
            volume = area_of(points[start:end])
        else:
            count, place, faces = stream[place], place + 1, []
            for _ in range(count):
                faces.append(stream[place + 1:place + 1 + stream[place]])
                place += 1 + stream[place]
            assert place == arrays["faceoffsets"][k] and all(start <= c < end for face in faces for c in face)
            volume = volume_of(points, faces, points[start:end].mean(axis=0))
        assert volume == pytest.approx(arrays["volume"][k], rel=1e-5, abs=1e-9)    # points have ten digits


def test_vtk_itself_reads_it(tmp_path, rng):
    vtk = pytest.importorskip("vtk")
    for name in ("2D", "3D"):
        box = BOXES[name]
        x, radius = foam(box, rng, 60)
        found = cells.power_cells(x, radius, box)
        cells.write_text(tmp_path / "c.vtu", cells.vtu_text(found, {"volume": found.volume}))
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(tmp_path / "c.vtu"))
        reader.Update()
        sizes = vtk.vtkCellSizeFilter()
        sizes.SetInputConnection(reader.GetOutputPort())
        sizes.Update()
        data = sizes.GetOutput().GetCellData()
        size = data.GetArray("Area" if box.dimension == 2 else "Volume")
        measured = np.array([size.GetValue(k) for k in range(size.GetNumberOfTuples())])
        np.testing.assert_allclose(measured.sum(), box.volume, rtol=1e-6)


def test_command(tmp_path, rng):
    box = BOXES["2D"]
    x, radius = foam(box, rng)
    write_dump(tmp_path / "foam.lammpstrj", [(x, radius, box)])
    analyse("cells", [str(tmp_path), "--out", str(tmp_path / "c")])
    with open(tmp_path / "c.csv") as file:
        rows = list(csv.DictReader(file))
    assert sum(float(row["volume"]) for row in rows) == pytest.approx(box.volume, rel=1e-8)
    lines = (tmp_path / "c.xyzr").read_text().splitlines()
    assert len(lines) == 60 and all(re.fullmatch(r"\d+( \S+){4}", line) for line in lines)
    for end in (".pdf", ".png", ".vtu", "-sides.csv"):
        assert (tmp_path / f"c{end}").stat().st_size > 0
    with pytest.raises(SystemExit, match="lacks the column wrong; it has id, x, y, z, radius"):
        analyse("cells", [str(tmp_path), "--colour", "wrong", "--out", str(tmp_path / "d")])
    with pytest.raises(SystemExit, match="2 runs are given"):
        analyse("cells", [str(tmp_path), str(tmp_path), "--out", str(tmp_path / "d")])
    x[1] = x[0]
    write_dump(tmp_path / "same", [(x, radius, box)])
    with pytest.raises(SystemExit, match="pyvoro2: "):
        analyse("cells", [str(tmp_path / "same"), "--out", str(tmp_path / "d")])
    assert not list(tmp_path.glob("d*"))
