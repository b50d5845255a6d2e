"""Reads MJCF, URDF and SDF files as fixed solids; what is not understood is listed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, TypeAlias
from xml.etree import ElementTree

import mujoco
import numpy as np

from skillc.errors import ServiceError
from skillc.services.reporting.files import inspect_path
from skillc.services.scenery.sdf import read_sdf
from skillc_runtime.motion.pose import Array, Pose

SolidKind: TypeAlias = Literal["box", "cylinder", "sphere", "capsule", "mesh"]

FORMATS = {"mujoco": "MJCF", "robot": "URDF", "sdf": "SDF"}
"""The formats by the tag of their root element."""

LISTED = 6
"""The maximum number of names in a note."""

UNUSED = {
    "light": "nlight",
    "camera": "ncam",
    "actuator": "nu",
    "sensor": "nsensor",
    "tendon": "ntendon",
    "flex": "nflex",
}


@dataclass(frozen=True, slots=True, eq=False)
class ImportedMesh:
    """Triangles in m, around the middle of their bounding box: points (n, 3), corners (k, 3) as numbers of points."""

    points: Array
    corners: Array


@dataclass(frozen=True, slots=True, eq=False)
class ImportedSolid:
    """A solid: its name in the file, its kind, the size (3,) in m of its box, the pose of the box's middle in the file.

    Cylinders and capsules are along z.
    """

    name: str
    kind: SolidKind
    size: Array
    pose: Pose
    mesh: ImportedMesh | None = None


@dataclass(frozen=True, slots=True)
class ImportedFile:
    """The solids of a file, its format, and sentences about what was not understood."""

    format: str
    solids: tuple[ImportedSolid, ...]
    notes: tuple[str, ...]


def read_scenery(path: Path) -> ImportedFile:
    """Read a file; the format follows from its root element. ServiceError if it cannot be read."""
    found = inspect_path(path)
    if found.kind != "file":
        raise ServiceError(f"{path} {found.is_what}")
    try:
        root = ElementTree.parse(path).getroot()
    except (ElementTree.ParseError, ValueError) as error:
        raise ServiceError(f"{path} is not XML: {error}") from error
    if root.tag not in FORMATS:
        raise ServiceError(f"{path} is neither MJCF, URDF nor SDF: its root is <{root.tag}>")
    notes: list[str] = []
    try:
        match root.tag:
            case "sdf":
                spec = read_sdf(root, path.parent, notes)
            case "robot":
                spec = _read_urdf(root, path.parent)
            case _:
                spec = mujoco.MjSpec.from_file(str(path))
        model = spec.compile()
    except (ValueError, mujoco.FatalError) as error:
        reason = " ".join(str(error).split())
        raise ServiceError(f"{path} cannot be read as {FORMATS[root.tag]}: {reason}") from error
    solids = tuple(_solids(model, notes))
    return ImportedFile(FORMATS[root.tag], solids, (*notes, *_unused(model)))


def _read_urdf(root: ElementTree.Element, folder: Path) -> Any:
    """Return the model of a URDF document with all links and visual shapes; its files are relative to a folder."""
    options = root.find("mujoco")
    options = ElementTree.SubElement(root, "mujoco") if options is None else options
    compiler = options.find("compiler")
    compiler = ElementTree.SubElement(options, "compiler") if compiler is None else compiler
    if compiler.get("meshdir") is None:
        compiler.attrib |= {"meshdir": str(folder.resolve()), "strippath": "false"}
    compiler.attrib |= {"discardvisual": "false", "fusestatic": "false"}
    return mujoco.MjSpec.from_string(ElementTree.tostring(root, encoding="unicode"))


def _solids(model: Any, notes: list[str]) -> Iterator[ImportedSolid]:
    """Yield the geometries that collide, or all of a body without such; note those that are left out."""
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    solid = {int(model.geom_bodyid[g]) for g in range(model.ngeom) if _collides(model, g)}
    taken, seen, shapes, planes = set[str](), list[str](), list[str](), list[str]()
    for geom in range(model.ngeom):
        name = _name(model, geom)
        if not _collides(model, geom) and int(model.geom_bodyid[geom]) in solid:
            seen.append(name)
            continue
        made = _solid(model, data, geom, _unique(name, taken))
        if made is not None:
            taken.add(made.name)
            yield made
        elif model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_PLANE:
            planes.append(name)
        else:
            shapes.append(f"{name} ({mujoco.mjtGeom(model.geom_type[geom]).name.removeprefix('mjGEOM_').lower()})")
    notes += _note("only visible beside what collides", seen)
    notes += _note("planes, because a scene has its floor at z = 0", planes)
    notes += _note("shapes that bodies cannot have", shapes)


def _collides(model: Any, geom: int) -> bool:
    return bool(model.geom_contype[geom] or model.geom_conaffinity[geom])


def _solid(model: Any, data: Any, geom: int, name: str) -> ImportedSolid | None:
    """Return a geometry as a solid, None for a shape that bodies cannot have."""
    pose = Pose(data.geom_xpos[geom].copy(), data.geom_xmat[geom].reshape(3, 3).copy())
    a, b, c = model.geom_size[geom].tolist()
    match mujoco.mjtGeom(model.geom_type[geom]):
        case mujoco.mjtGeom.mjGEOM_BOX:
            return ImportedSolid(name, "box", np.array([2 * a, 2 * b, 2 * c]), pose)
        case mujoco.mjtGeom.mjGEOM_SPHERE:
            return ImportedSolid(name, "sphere", np.full(3, 2 * a), pose)
        case mujoco.mjtGeom.mjGEOM_CYLINDER:
            return ImportedSolid(name, "cylinder", np.array([2 * a, 2 * a, 2 * b]), pose)
        case mujoco.mjtGeom.mjGEOM_CAPSULE:
            return ImportedSolid(name, "capsule", np.array([2 * a, 2 * a, 2 * (a + b)]), pose)
        case mujoco.mjtGeom.mjGEOM_MESH:
            return _mesh(model, int(model.geom_dataid[geom]), pose, name)
        case _:
            return None


def _mesh(model: Any, mesh: int, pose: Pose, name: str) -> ImportedSolid:
    first, count = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
    inertial = Pose.of(model.mesh_pos[mesh], model.mesh_quat[mesh])  # MuJoCo turns meshes to their axes of inertia
    points = model.mesh_vert[first : first + count] @ inertial.rotation.T + inertial.position
    pose = pose @ inertial.inverse()
    face, faces = int(model.mesh_faceadr[mesh]), int(model.mesh_facenum[mesh])
    low, high = points.min(axis=0), points.max(axis=0)
    middle = (low + high) / 2
    made = ImportedMesh(points - middle, np.array(model.mesh_face[face : face + faces]))
    return ImportedSolid(name, "mesh", high - low, Pose(pose.apply(middle), pose.rotation), made)


def _name(model: Any, geom: int) -> str:
    """Return the name of a geometry, else that of its body, else that of the next named body above it."""
    own, body = model.geom(geom).name, int(model.geom_bodyid[geom])
    while not own and body > 0:
        own, body = model.body(body).name, int(model.body_parentid[body])
    return own or "solid"


def _unique(name: str, taken: set[str]) -> str:
    number = 2
    wanted = name
    while wanted in taken:
        wanted, number = f"{name}-{number}", number + 1
    return wanted


def _unused(model: Any) -> Iterator[str]:
    moving = [model.joint(number).name or f"joint {number + 1}" for number in range(model.njnt)]
    if moving:
        yield f"joints: what they move is fixed where it starts: {_list(moving)}"
    counts = [(getattr(model, size), word) for word, size in UNUSED.items()]
    others = [f"{count} {word}{'s' * (count > 1)}" for count, word in counts if count]
    if others:
        yield f"left out: {', '.join(others)}"


def _note(what: str, names: list[str]) -> list[str]:
    return [f"left out, {what}: {_list(names)}"] if names else []


def _list(names: list[str]) -> str:
    return ", ".join(names[:LISTED]) + (f" and {len(names) - LISTED} more" if len(names) > LISTED else "")
