"""Finds the mesh that a URDF names, and reads its vertices with Coal, which comes with pinocchio."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import unquote, urlsplit

import numpy as np

from skillc_runtime.motion.pose import Array

PACKAGE_PATHS = ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH")
"""Environment variables that list folders with ROS packages, or folders with `share`."""


def find_mesh(uri: str, urdf: Path) -> Path | None:
    """Return the file that a URDF names as `package://`, `file://` or a path relative to it; None if it is missing."""
    parts = urlsplit(uri)
    if parts.scheme in ("package", "model"):
        found = _in_package(parts.netloc, unquote(parts.path).lstrip("/"), urdf)
    elif parts.scheme == "file":
        found = Path(unquote(parts.path))
    else:
        found = urdf.parent / uri
    return found if found is not None and found.is_file() else None


def read_vertices(mesh: Path, scale: Array) -> Array | None:
    """Return the vertices (n, 3) in m of a mesh; None if it cannot be read."""
    import coal

    try:
        vertices = np.array(coal.MeshLoader().load(str(mesh), scale).vertices(), dtype=float)
    except (ValueError, RuntimeError):
        return None
    return vertices if vertices.size and np.isfinite(vertices).all() else None


def _in_package(package: str, inner: str, urdf: Path) -> Path | None:
    """Return the file in a package: a folder of that name above the URDF, beside these, or in the environment."""
    return next((found for folder in _folders(package, urdf) if (found := folder / inner).is_file()), None)


def _folders(package: str, urdf: Path) -> Iterator[Path]:
    for folder in urdf.resolve().parents:
        if folder.name == package:
            yield folder
        yield folder / package
    for name in PACKAGE_PATHS:
        for listed in filter(None, os.environ.get(name, "").split(os.pathsep)):
            yield from (Path(listed) / package, Path(listed) / "share" / package)
