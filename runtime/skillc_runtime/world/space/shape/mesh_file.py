"""Meshes in files: reads OBJ and STL, scales them to the size of a thing, and cuts them into convex pieces."""

from __future__ import annotations

import struct
from functools import lru_cache
from itertools import pairwise
from pathlib import Path

from skillc_ontology.catalogue import model_path
from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.space.shape.shapes import Mesh, ShapeError
from skillc_runtime.world.space.shape.solids import Hull, Size

PROPORTION = 0.02
"""The sides of a mesh are scaled alike but for this share; else the stated size is not that of the file."""

CONVEX_SHARE = 1e-3
"""A mesh counts as convex if no point is farther outside the plane of a face than this share of its extent."""

STL_HEAD, STL_FACE = 84, 50
"""Bytes of the head of a binary STL file, and of each of its triangles."""


def read_mesh(name: str, size: Size, whole: bool) -> Mesh:
    """Return the mesh of a file, scaled to a size (3,) in m; `whole` for its convex hull, else its convex pieces.

    A file is found in the ontology folders or from the current folder. ShapeError if it cannot be read, has other
    proportions than the size, or has to be cut into pieces without the extra `meshes`.
    """
    path = _find(name)
    triangles = _fit(path.name, _read(path, path.stat().st_mtime_ns), size)
    if whole or _is_convex(triangles):
        return Mesh(size, (_hull(path.name, triangles),), True)
    return Mesh(size, tuple(_hull(path.name, each) for each in _cut(path.name, triangles.tobytes())), False)


def _find(name: str) -> Path:
    if Path(name).is_file():
        return Path(name)
    try:
        return model_path(name)
    except FileNotFoundError as error:
        raise ShapeError(
            f"has the mesh {name!r}, which is in no ontology folder and not below the current one"
        ) from error


@lru_cache(maxsize=32)
def _read(path: Path, _written_ns: int) -> Array:
    """Return the triangles (n, 3, 3) of a file, in its unit."""
    reader = {".obj": _read_obj, ".stl": _read_stl}.get(path.suffix.lower())
    if reader is None:
        raise ShapeError(f"has the mesh {path.name}; meshes are OBJ or STL files")
    try:
        triangles = reader(path)
    except (ValueError, IndexError, struct.error) as error:
        raise ShapeError(f"has the mesh {path.name}, which cannot be read: {error}") from error
    if triangles.size == 0 or not np.isfinite(triangles).all():
        raise ShapeError(f"has the mesh {path.name}, which has no triangles")
    return triangles


def _read_obj(path: Path) -> Array:
    """Read vertices and faces; more than three corners become a fan, a negative index counts from the end."""
    points: list[list[float]] = []
    corners: list[tuple[int, int, int]] = []
    for line in path.read_text("utf-8", errors="replace").splitlines():
        kind, *rest = line.split() or [""]
        if kind == "v":
            points.append([float(each) for each in rest[:3]])
        elif kind == "f":
            face = [int(each.split("/")[0]) for each in rest]
            face = [each - 1 if each > 0 else len(points) + each for each in face]
            corners += [(face[0], one, other) for one, other in pairwise(face[1:])]
    return np.asarray(np.array(points).reshape(-1, 3)[np.array(corners, dtype=int).reshape(-1, 3)])


def _read_stl(path: Path) -> Array:
    data = path.read_bytes()
    count = struct.unpack_from("<I", data, STL_HEAD - 4)[0] if len(data) >= STL_HEAD else -1
    if len(data) == STL_HEAD + STL_FACE * count:
        faces = np.frombuffer(data, np.uint8, offset=STL_HEAD).reshape(count, STL_FACE)[:, 12:48]
        return np.ascontiguousarray(faces).view("<f4").reshape(-1, 3, 3).astype(np.float64)
    lines = [line.split() for line in data.decode("utf-8", errors="replace").splitlines()]
    return np.array([[float(each) for each in line[1:4]] for line in lines if line[:1] == ["vertex"]]).reshape(-1, 3, 3)


def _fit(name: str, triangles: Array, size: Size) -> Array:
    """Scale and move triangles so that their box is one of a size (3,) in m around the origin."""
    low, high = triangles.min(axis=(0, 1)), triangles.max(axis=(0, 1))
    extent = high - low
    if extent.min() <= 0:
        raise ShapeError(f"has the mesh {name}, which is flat")
    scale = np.array(size) / extent
    if scale.max() > scale.min() * (1 + PROPORTION):
        found = " x ".join(f"{each:g}" for each in extent)
        wanted = " x ".join(f"{each:g}" for each in size)
        raise ShapeError(f"is {wanted} m, which has other proportions than its mesh {name}, {found} in its unit")
    return np.asarray((triangles - (low + high) / 2) * scale)


def _is_convex(triangles: Array) -> bool:
    """Whether no point is outside the plane of any face."""
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    faces = lengths > 0
    normals, points = normals[faces] / lengths[faces, None], np.unique(triangles.reshape(-1, 3), axis=0)
    limit = CONVEX_SHARE * float(np.ptp(points, axis=0).max())
    return all((points @ n).max() - n @ p <= limit for n, p in zip(normals, triangles[faces, 0], strict=True))


def _hull(name: str, triangles: Array) -> Hull:
    """Return the points of triangles; volume and centre are of the tetrahedra that they form with the origin.

    V = sum a . (b x c) / 6, centre = sum (a + b + c) / 4 a . (b x c) / 6 / V.
    """
    contents = np.einsum("ij,ij->i", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2])) / 6
    volume = float(contents.sum())
    if volume <= 0:
        raise ShapeError(f"has the mesh {name}, which is not closed or is turned inside out: it has no volume")
    centre = contents @ triangles.sum(axis=1) / 4 / volume
    return Hull(np.unique(triangles.reshape(-1, 3), axis=0), volume, centre)


@lru_cache(maxsize=32)
def _cut(name: str, data: bytes) -> tuple[Array, ...]:
    """Return the triangles (n, 3, 3) of convex pieces of a mesh, with CoACD (Wei et al. 2022) and a fixed seed."""
    try:
        import coacd
    except ImportError as error:
        raise ShapeError(
            f"has the mesh {name}, which is not convex: `pip install 'skillc[meshes]'` cuts it into convex pieces, "
            '`skillc:shape "hull"` takes its convex hull'
        ) from error
    triangles = np.frombuffer(data).reshape(-1, 3, 3)
    points, corners = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    coacd.set_log_level("error")
    pieces = coacd.run_coacd(coacd.Mesh(points, corners.reshape(-1, 3)), seed=0)
    return tuple(np.asarray(found)[np.asarray(faces)] for found, faces in pieces)
