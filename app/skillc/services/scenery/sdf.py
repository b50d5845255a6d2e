"""Translates SDF (http://sdformat.org) to a MuJoCo model: models, links, collisions, their poses and shapes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from math import radians
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import Element

import mujoco
import numpy as np

from skillc_runtime.motion.pose import Array, Pose, quaternion_from_rotation, rotation_from_angles

CONTAINERS = ("world", "model", "link")
UNDERSTOOD = {
    "sdf": ("world", "model"),
    "world": ("model", "frame"),
    "model": ("model", "link", "pose", "frame", "static", "self_collide", "allow_auto_disable"),
    "link": ("collision", "visual", "pose", "inertial", "self_collide", "gravity", "kinematic", "enable_wind"),
}
"""The elements below each element that have a meaning here, or none for scenery."""

NOWHERE = Pose.of((0.0, 0.0, 0.0))


@dataclass
class _Reader:
    folder: Path
    spec: Any
    notes: list[str]
    ignored: dict[str, list[str]] = field(default_factory=dict)
    names: dict[str, int] = field(default_factory=dict)

    def name_freely(self, name: str) -> str:
        """Return a name that no geometry has, with a number if there is one of that name."""
        wanted = name
        while wanted in self.names:
            self.names[name] += 1
            wanted = f"{name}-{self.names[name]}"
        self.names[wanted] = 1
        return wanted


def read_sdf(root: Element, folder: Path, notes: list[str]) -> Any:
    """Return the model of an SDF document, whose files are relative to a folder; add what is not understood to `notes`.

    ValueError if a pose or size has no numbers.
    """
    reader = _Reader(folder, mujoco.MjSpec(), notes)
    _read_children(reader, root, NOWHERE, ())
    for tag, names in sorted(reader.ignored.items()):
        notes.append(f"left out, <{tag}>: {', '.join(names[:6])}" + (" .." if len(names) > 6 else ""))
    return reader.spec


def _read_children(reader: _Reader, parent: Element, at: Pose, path: tuple[str, ...]) -> None:
    known = UNDERSTOOD[parent.tag]
    for child in parent:
        here = (*path, child.get("name") or child.tag)
        if child.tag not in known:
            reader.ignored.setdefault(child.tag, []).append("/".join(here))
        elif child.tag in CONTAINERS:
            placed = _read_pose(reader, child, here)
            if placed is not None:
                _read_children(reader, child, at @ placed, here)
    if parent.tag == "link":
        _read_shapes(reader, parent, at, path)


def _read_shapes(reader: _Reader, link: Element, at: Pose, path: tuple[str, ...]) -> None:
    """Read the collisions of a link, or its visuals if it has none."""
    for shape in link.findall("collision") or link.findall("visual"):
        here = (*path, shape.get("name") or shape.tag)
        placed = _read_pose(reader, shape, here)
        if placed is not None:
            _add_geometry(reader, shape.find("geometry"), at @ placed, here)


def _read_pose(reader: _Reader, element: Element, path: tuple[str, ...]) -> Pose | None:
    """Return the pose of an element in that around it; None, and a note, if it is given relative to something else."""
    pose = element.find("pose")
    if pose is None:
        return NOWHERE
    other = pose.get("relative_to") or pose.get("frame")
    if other and other not in ("__model__", "world"):
        reader.notes.append(f"left out, {'/'.join(path)}: its pose is relative to {other}")
        return None
    numbers = [float(each) for each in (pose.text or "").split()]
    if pose.get("rotation_format") == "quat_xyzw" and len(numbers) == 7:
        x, y, z, *quaternion = numbers
        return Pose.of((x, y, z), (quaternion[3], *quaternion[:3]))
    if not numbers:
        return NOWHERE
    if len(numbers) != 6:
        raise ValueError(f"the pose of {'/'.join(path)} has {len(numbers)} numbers and not 6")
    turn = numbers[3:] if pose.get("degrees") != "true" else [radians(each) for each in numbers[3:]]
    return Pose(np.array(numbers[:3]), rotation_from_angles(turn[0], turn[1], turn[2]))


def _add_geometry(reader: _Reader, geometry: Element | None, pose: Pose, path: tuple[str, ...]) -> None:
    name = "-".join(path[1:-1] if len(path) > 3 else path[:-1])
    shape = next(iter(geometry), None) if geometry is not None else None
    if shape is None:
        reader.notes.append(f"left out, {'/'.join(path)}: it has no geometry")
        return
    options = dict(_geometry(reader, shape, path))
    if not options and shape.tag != "mesh":
        reader.ignored.setdefault(shape.tag, []).append("/".join(path))
    if not options:
        return
    geom = reader.spec.worldbody.add_geom(pos=pose.position, quat=quaternion_from_rotation(pose.rotation), **options)
    geom.name = reader.name_freely(name)


def _geometry(reader: _Reader, shape: Element, path: tuple[str, ...]) -> Iterator[tuple[str, Any]]:
    """Yield the options of a MuJoCo geometry; none for a shape that is not understood."""
    kinds = mujoco.mjtGeom
    match shape.tag:
        case "box":
            yield from (("type", kinds.mjGEOM_BOX), ("size", _numbers(shape, "size", 3) / 2))
        case "sphere":
            yield from (("type", kinds.mjGEOM_SPHERE), ("size", [*_numbers(shape, "radius", 1), 0, 0]))
        case "cylinder" | "capsule":
            kind = kinds.mjGEOM_CYLINDER if shape.tag == "cylinder" else kinds.mjGEOM_CAPSULE
            size = [*_numbers(shape, "radius", 1), *(_numbers(shape, "length", 1) / 2), 0]
            yield from (("type", kind), ("size", size))
        case "mesh":
            yield from _mesh(reader, shape, path)
        case _:
            return


def _mesh(reader: _Reader, shape: Element, path: tuple[str, ...]) -> Iterator[tuple[str, Any]]:
    uri = (shape.findtext("uri") or "").strip()
    file = reader.folder / uri.removeprefix("file://")
    if file.suffix.lower() not in (".obj", ".stl") or not file.is_file() or shape.find("submesh") is not None:
        reason = "there is no such file" if file.suffix.lower() in (".obj", ".stl") else "meshes are OBJ or STL files"
        reader.notes.append(f"left out, {'/'.join(path)}: the mesh {uri}: {reason}")
        return
    scale = _numbers(shape, "scale", 3) if shape.find("scale") is not None else np.ones(3)
    mesh = reader.spec.add_mesh(name=_free_mesh(reader.spec), file=str(file.resolve()), scale=scale)
    yield from (("type", mujoco.mjtGeom.mjGEOM_MESH), ("meshname", mesh.name))


def _numbers(shape: Element, tag: str, count: int) -> Array:
    """Return the numbers (count,) of an element below a shape; ValueError if there are not as many."""
    numbers = [float(each) for each in (shape.findtext(tag) or "").split()]
    if len(numbers) != count:
        raise ValueError(f"<{tag}> of a <{shape.tag}> has {len(numbers)} numbers and not {count}")
    return np.array(numbers)


def _free_mesh(spec: Any) -> str:
    return f"mesh-{len(spec.meshes) + 1}"
