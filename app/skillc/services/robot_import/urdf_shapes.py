"""Turns what a link of a URDF looks like into simple shapes: its collision elements, else its visual ones."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

from skillc.services.robot_import.mesh_files import find_mesh, read_vertices
from skillc.services.robot_import.robot_model import Shape
from skillc.services.robot_import.shape_fitting import fit_shape
from skillc.services.robot_import.urdf_tree import numbers, origin
from skillc_runtime.motion.pose import Pose


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
    file = find_mesh(uri, path)
    scale = numbers(path, element, "scale", (1.0, 1.0, 1.0))
    vertices = None if file is None else read_vertices(file, scale)
    if vertices is None:
        missing.append(uri)
        return None
    fitted = fit_shape(vertices)
    return Shape(fitted.kind, pose @ fitted.pose, fitted.size)
