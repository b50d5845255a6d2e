"""Adds the solids of a file to a scene file, as fixed things with a place of their own."""

from __future__ import annotations

import re
from math import degrees
from pathlib import Path

import numpy as np
import pyoxigraph as ox

from skillc.errors import RequestError, ServiceError
from skillc.services.reporting.files import writing_to
from skillc.services.scene.scene_file import SceneFile
from skillc.services.scene.things import Pairs, PoseRequest
from skillc.services.scenery.reading import ImportedFile, ImportedMesh, ImportedSolid, read_scenery
from skillc_rdf.turtle.terms import RDF_TYPE, XSD
from skillc_runtime.motion.pose import Pose, angles_from_rotation, rotation_from_angles
from skillc_runtime.world.state.terms import ANGLES, BASE_FRAME_ID, MESH, POSITION, SHAPE, SIZE
from skillc_runtime.world.state.world_state import WorldState

ARTIFACT = "http://www.inf.ufrgs.br/phi-group/ontologies/sumo.owl#Artifact"
_OUTSIDE = re.compile(r"[^A-Za-z0-9_-]+")


def import_scenery(scene: Path, state: WorldState, source: Path, pose: PoseRequest) -> ImportedFile:
    """Add the solids of an MJCF, URDF or SDF file to a scene; the origin of the file is at a pose, in a frame.

    Meshes are written as OBJ files into a folder beside the scene. ServiceError, and the scene unchanged, if the file
    cannot be read or the scene would have errors.
    """
    if pose.on or pose.at or pose.anchor or pose.face:
        raise RequestError("the origin of the file is at --position in a --frame, turned by --roll, --pitch and --yaw")
    found = read_scenery(source)
    if not found.solids:
        raise ServiceError(f"{source} has no solids that can be imported" + "".join(f"\n  {n}" for n in found.notes))
    file, origin = SceneFile(scene, state), _origin(pose)
    meshes, taken = scene.parent / f"{source.stem}-meshes", set[str]()
    for each in found.solids:
        name = _free_name(file, each.name, taken)
        taken.add(name)
        rows = (_body(each, meshes / f"{name}.obj"), _place(origin @ each.pose, pose.frame or "map"))
        file.append(file.name_new_thing(name), ([(RDF_TYPE, ox.NamedNode(ARTIFACT))], *rows))
        if each.mesh is not None:
            _write_mesh(each.mesh, meshes / f"{name}.obj")
    file.write()
    return found


def _origin(pose: PoseRequest) -> Pose:
    roll, pitch, yaw = (np.radians(float(each or 0.0)) for each in pose.angles)
    return Pose(np.array([float(each) for each in pose.position or (0, 0, 0)]), rotation_from_angles(roll, pitch, yaw))


def _body(solid: ImportedSolid, mesh: Path) -> Pairs:
    pairs: Pairs = [(name, _number(each, 6)) for name, each in zip(SIZE, solid.size.tolist(), strict=True)]
    if solid.kind == "mesh":
        return [*pairs, (SHAPE, ox.Literal("hull")), (MESH, ox.Literal(mesh.as_posix()))]
    return pairs if solid.kind == "box" else [*pairs, (SHAPE, ox.Literal(solid.kind))]


def _place(pose: Pose, frame: str) -> Pairs:
    place: Pairs = [(BASE_FRAME_ID, ox.Literal(frame))]
    place += [(name, _number(each, 6)) for name, each in zip(POSITION, pose.position.tolist(), strict=True)]
    angles = [_number(degrees(each), 4) for each in angles_from_rotation(pose.rotation)]
    turns = [(name, each) for name, each in zip(ANGLES, angles, strict=True) if float(each.value) or name == ANGLES[2]]
    return [*place, *turns]


def _number(number: float, digits: int) -> ox.Literal:
    text = f"{round(number, digits) + 0.0:.{digits}f}".rstrip("0")
    return ox.Literal(f"{text}0" if text.endswith(".") else text, datatype=ox.NamedNode(XSD + "decimal"))


def _free_name(file: SceneFile, name: str, taken: set[str]) -> str:
    """Return a name for a new individual, made of that in the file."""
    base = _OUTSIDE.sub("-", name).strip("-_") or "solid"
    base = base if base[0].isalpha() else f"solid-{base}"
    number, wanted = 2, base
    while wanted in taken or file.has_thing(wanted):
        wanted, number = f"{base}-{number}", number + 1
    return wanted


def _write_mesh(mesh: ImportedMesh, path: Path) -> None:
    lines = [f"v {x:.6f} {y:.6f} {z:.6f}" for x, y, z in mesh.points.tolist()]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in mesh.corners.tolist()]
    with writing_to(path.parent):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
