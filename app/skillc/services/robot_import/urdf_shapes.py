"""Turns what a link of a URDF looks like into simple shapes: its collision elements, else its visual ones.

Meshes are found where ROS finds them, and read by Coal, which comes with pinocchio.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import unquote, urlsplit
from xml.etree import ElementTree

import numpy as np

from skillc.services.robot_import.robot_model import Shape
from skillc.services.robot_import.shape_fitting import fit_shape
from skillc.services.robot_import.urdf_tree import numbers, origin
from skillc_runtime.motion.pose import Array, Pose

PACKAGE_PATHS = ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH")
"""Environment variables that list folders with ROS packages, or folders with `share`."""


def read_shapes(path: Path, link: ElementTree.Element, missing: list[str]) -> tuple[Shape, ...]:
    """Return the shapes of a link in its frame.

    Names of meshes that are not there or cannot be read are added to `missing`; a link may have others instead.
    """
    for kind in ("collision", "visual"):
        lost: list[str] = []
        found = tuple(_shapes(path, link.findall(kind), lost))
        missing += [each for each in lost if each not in missing]
        if found:
            return found
    return ()


def _shapes(path: Path, elements: list[ElementTree.Element], missing: list[str]) -> Iterator[Shape]:
    for element in elements:
        geometry = element.find("geometry")
        here = origin(path, element)
        for each in () if geometry is None else geometry:
            shape = _mesh(path, each, here, missing) if each.tag == "mesh" else _primitive(path, each, here)
            if shape is not None:
                yield shape


def _primitive(path: Path, element: ElementTree.Element, pose: Pose) -> Shape | None:
    radius = float(numbers(path, element, "radius", (0.0,))[0])
    half = float(numbers(path, element, "length", (0.0,))[0]) / 2
    match element.tag:
        case "box":
            size = numbers(path, element, "size", (0.0, 0.0, 0.0)) / 2
            return Shape("box", pose, tuple(size.tolist())) if (size > 0).all() else None
        case "sphere" if radius > 0:
            return Shape("sphere", pose, (radius,))
        case "cylinder" if radius > 0 and half > 0:
            return Shape("cylinder", pose, (radius, half))
        case "capsule" if radius > 0 and half > 0:
            return Shape("capsule", pose, (radius, half))
        case _:
            return None


def _mesh(path: Path, element: ElementTree.Element, pose: Pose, missing: list[str]) -> Shape | None:
    uri = element.get("filename") or ""
    file = _find_mesh(uri, path)
    scale = numbers(path, element, "scale", (1.0, 1.0, 1.0))
    vertices = None if file is None else _read_vertices(file, scale)
    if vertices is None:
        missing.append(uri)
        return None
    fitted = fit_shape(vertices)
    return Shape(fitted.kind, pose @ fitted.pose, fitted.size)


def _find_mesh(uri: str, urdf: Path) -> Path | None:
    """Return the file that a URDF names as `package://`, `file://` or a path relative to it; None if it is missing."""
    parts = urlsplit(uri)
    if parts.scheme in ("package", "model"):
        found = _in_package(parts.netloc, unquote(parts.path).lstrip("/"), urdf)
    elif parts.scheme == "file":
        found = Path(unquote(parts.path))
    else:
        found = urdf.parent / uri
    return found if found is not None and found.is_file() else None


def _read_vertices(mesh: Path, scale: Array) -> Array | None:
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
