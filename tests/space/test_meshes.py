"""Meshes in files are scaled to the size of a thing, weighed, and made of convex pieces."""

from __future__ import annotations

import struct
from itertools import product
from pathlib import Path

import numpy as np
import pytest

from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.shape.mesh_file import read_mesh
from skillc_runtime.world.space.shape.shapes import ShapeError, solids_of

UP = np.array([0.0, 0.0, 1.0])
FACES = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4)]
FACES += [(2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)]


def cuboid(low: tuple[float, ...], high: tuple[float, ...]) -> Array:
    """Return the triangles (12, 3, 3) of a box, turned outwards."""
    points = np.array([(z, y, x) for x, y, z in product(*zip(low[::-1], high[::-1], strict=True))])
    triangles = points[FACES]
    middle = points.mean(axis=0)
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    inwards = np.einsum("ij,ij->i", normals, triangles[:, 0] - middle) < 0
    triangles[inwards] = triangles[inwards][:, ::-1]
    return np.asarray(triangles)


def write_obj(path: Path, triangles: Array) -> str:
    """Write triangles with vertices of their own; return the path."""
    corners = [f"v {x} {y} {z}" for x, y, z in triangles.reshape(-1, 3)]
    faces = [f"f {3 * n + 1}//1 {3 * n + 2}//1 {3 * n + 3}//1" for n in range(len(triangles))]
    path.write_text("\n".join(["# a comment", *corners, *faces]), encoding="utf-8")
    return str(path)


def write_stl(path: Path, triangles: Array) -> str:
    faces = b"".join(struct.pack("<12fH", 0, 0, 0, *each.ravel(), 0) for each in triangles)
    path.write_bytes(b"binary".ljust(80) + struct.pack("<I", len(triangles)) + faces)
    return str(path)


def write_text_stl(path: Path, triangles: Array) -> str:
    lines = ["solid thing"]
    for each in triangles:
        corners = [f"vertex {x} {y} {z}" for x, y, z in each]
        lines += ["facet normal 0 0 0", "outer loop", *corners, "endloop", "endfacet"]
    path.write_text("\n".join([*lines, "endsolid"]), encoding="utf-8")
    return str(path)


@pytest.mark.parametrize(
    ("name", "write"),
    [("a.obj", write_obj), ("a.stl", write_stl), ("b.STL", write_text_stl)],
    ids=["obj", "binary", "text"],
)
def test_a_convex_mesh_in_millimetres_has_its_stated_size(tmp_path: Path, name: str, write: object) -> None:
    assert callable(write)
    path = write(tmp_path / name, cuboid((100, 0, 0), (140, 50, 60)))
    mesh = read_mesh(path, (0.04, 0.05, 0.06), whole=False)
    (solid,) = solids_of(mesh)
    assert mesh.whole
    assert solid.half == pytest.approx((0.02, 0.025, 0.03))
    assert solid.volume == pytest.approx(0.04 * 0.05 * 0.06)
    assert solid.centre == pytest.approx([0, 0, 0], abs=1e-9)
    assert solid.reach(UP, Pose.of((0, 0, 1))) == pytest.approx(1.03)


def u_shape() -> Array:
    """Return the triangles of a trough: a floor, and two walls that stand on it."""
    outline = [(0, 0), (3, 0), (3, 2), (2, 2), (2, 1), (1, 1), (1, 2), (0, 2)]
    flat = [(0, 1, 5), (1, 4, 5), (1, 2, 4), (2, 3, 4), (0, 5, 7), (5, 6, 7)]
    front = [[(*outline[i], 0) for i in each[::-1]] for each in flat]
    back = [[(*outline[i], 1) for i in each] for each in flat]
    ring = list(zip(outline, [*outline[1:], outline[0]], strict=True))
    sides = [[(*a, 0), (*b, 0), (*b, 1)] for a, b in ring] + [[(*a, 0), (*b, 1), (*a, 1)] for a, b in ring]
    return np.array([*front, *back, *sides], dtype=float)


def test_a_trough_is_cut_into_pieces(tmp_path: Path) -> None:
    pytest.importorskip("coacd", reason="the extra `meshes` is not installed")
    mesh = read_mesh(write_obj(tmp_path / "u.obj", u_shape()), (0.3, 0.2, 0.1), whole=False)
    solids = solids_of(mesh)
    assert len(solids) >= 3
    assert sum(each.volume for each in solids) == pytest.approx(0.005 * 0.8 * 1.25, rel=0.06)
    in_the_trough = np.array([0.0, 0.05, 0.0])
    for each in solids:
        points = each.of_hull.points
        assert not ((points.min(axis=0) < in_the_trough) & (in_the_trough < points.max(axis=0))).all()


def test_the_hull_of_a_trough_is_one_piece_with_the_volume_of_the_trough(tmp_path: Path) -> None:
    mesh = read_mesh(write_obj(tmp_path / "u.obj", u_shape()), (0.3, 0.2, 0.1), whole=True)
    (solid,) = solids_of(mesh)
    assert solid.volume == pytest.approx(0.005)
    assert solid.centre[1] < -0.005


@pytest.mark.parametrize(
    ("triangles", "size", "message"),
    [
        (cuboid((0, 0, 0), (1, 1, 1)), (0.1, 0.1, 0.2), "other proportions than its mesh a.obj, 1 x 1 x 1 in its unit"),
        (cuboid((0, 0, 0), (1, 1, 1))[:, ::-1], (0.1, 0.1, 0.1), "is not closed or is turned inside out"),
        (cuboid((0, 0, 0), (1, 1, 1))[:2], (0.1, 0.1, 0.1), "which is flat"),
        (np.zeros((0, 3, 3)), (0.1, 0.1, 0.1), "which has no triangles"),
    ],
)
def test_a_mesh_that_cannot_be_used_says_why(
    tmp_path: Path, triangles: Array, size: tuple[float, float, float], message: str
) -> None:
    with pytest.raises(ShapeError, match=message):
        read_mesh(write_obj(tmp_path / "a.obj", triangles), size, whole=True)


def test_a_file_that_is_no_mesh_says_so(tmp_path: Path) -> None:
    (tmp_path / "a.obj").write_text("v 1 2 x", encoding="utf-8")
    (tmp_path / "a.step").write_text("", encoding="utf-8")
    for name, message in (
        ("a.obj", "cannot be read"),
        ("a.step", "meshes are OBJ or STL files"),
        ("none.obj", "is in no ontology folder and not below"),
    ):
        with pytest.raises(ShapeError, match=message):
            read_mesh(str(tmp_path / name), (0.1, 0.1, 0.1), whole=True)
