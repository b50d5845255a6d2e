"""Builds a second model of a scene, for pictures only, with the meshes of a model collection for devices.

It has the same joints in the same order as the simulated model, so postures apply to both.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.film.look_cache import model_file
from skillc_runtime.film.looks import Look, Looks, LooksError
from skillc_runtime.motion.pose import Pose, exp, log, quaternion_from_rotation

FAR_M, FAR_RAD = 0.005, 0.02
"""Greatest difference between the motion of links of a device and of its look; models have rounded numbers."""

HINGE_RAD, SLIDE_M = 0.4, 0.01
"""Joint displacements with which two models are compared."""


def add_looks(spec: Any, looks: Looks) -> Any:
    """Return a scene's description, in which the meshes of its devices' looks replace their own shapes.

    LooksError where meshes cannot be had or used, or move otherwise than the device.
    """
    for look in looks.looks:
        _dress(spec, look, model_file(looks.collection, look.model))
    _compiled(spec, looks.collection.name)
    return spec


def _dress(spec: Any, look: Look, file: Path) -> None:
    """Remove a device's own shapes and add the meshes of its look, each to the corresponding link."""
    theirs = _read(file)
    model = _compiled(theirs, look.model)
    ours = mujoco.MjModel.from_xml_path(str(look.own))
    turn = _turn(ours, model, look)
    for geom in [geom for geom in spec.geoms if geom.parent.name.startswith(look.prefix)]:
        spec.delete(geom)
    links, data = _links(ours, at_rest=True), _placed(model, at_rest=True)
    for geom in _meshes_of(model):
        link = _link_of(model, int(model.geom_bodyid[geom]))
        body = spec.body(look.prefix + ours.body(_bodies(ours)[link]).name)
        _add_mesh(spec, body, look, theirs, model, geom, links[link].inverse() @ turn @ _authored(model, data, geom))


def _read(file: Path) -> Any:
    try:
        return mujoco.MjSpec.from_file(str(file))
    except ValueError as error:
        raise LooksError(f"{file} cannot be read: {error}") from error


def _compiled(spec: Any, name: str) -> mujoco.MjModel:
    try:
        return spec.compile()
    except ValueError as error:
        raise LooksError(f"the meshes of {name} cannot be used: {error}") from error


def _turn(ours: Any, theirs: Any, look: Look) -> Pose:
    """Return the rotation of a look's base in the device's: the quarter turn with which their links move equally."""
    if ours.njnt != theirs.njnt:
        raise LooksError(f"{look.model} has {theirs.njnt} joints and {look.device} has {ours.njnt}")
    quarters = [Pose(np.zeros(3), exp(np.array([0.0, 0.0, k * np.pi / 2]))) for k in range(4)]
    differences = [_difference(ours, theirs, quarter) for quarter in quarters]
    best = min(range(4), key=lambda k: differences[k])
    if differences[best] > 1.0:
        raise LooksError(f"{look.model} does not move as {look.device} does, so its meshes would be in wrong places")
    return quarters[best]


def _difference(ours: Any, theirs: Any, turn: Pose) -> float:
    """Return the difference of the motions of links of two models; up to 1 is allowed."""
    places = [zip(_links(ours, at_rest), _links(theirs, at_rest), strict=True) for at_rest in (True, False)]
    rest, bent = ([one.inverse() @ turn @ other for one, other in pairs] for pairs in places)
    moves = [before.inverse() @ after for before, after in zip(rest, bent, strict=True)]
    away = max(float(np.linalg.norm(move.position)) for move in moves)
    turned = max(float(np.linalg.norm(log(move.rotation))) for move in moves)
    return max(away / FAR_M, turned / FAR_RAD)


def _placed(model: Any, at_rest: bool) -> Any:
    """Return the kinematics of a model with its joints at zero, or all of them displaced."""
    data = mujoco.MjData(model)
    if not at_rest:
        data.qpos[:] += np.where(model.jnt_type == mujoco.mjtJoint.mjJNT_SLIDE, SLIDE_M, HINGE_RAD)
    mujoco.mj_kinematics(model, data)
    return data


def _links(model: Any, at_rest: bool) -> list[Pose]:
    """Return the poses of the links in the frame of the model: the base, then the link of each joint."""
    data = _placed(model, at_rest)
    return [Pose(data.xpos[body].copy(), data.xmat[body].reshape(3, 3).copy()) for body in _bodies(model)]


def _bodies(model: Any) -> list[int]:
    first = int(model.jnt_bodyid[0])
    return [int(model.body_parentid[first]), *map(int, model.jnt_bodyid)]


def _link_of(model: Any, body: int) -> int:
    """Return the index of the link that a body belongs to, 0 for the base."""
    while body != 0 and model.body_jntnum[body] == 0:
        body = int(model.body_parentid[body])
    return 0 if body == 0 else int(model.body_jntadr[body]) + 1


def _meshes_of(model: Any) -> list[int]:
    """Return the visual geoms: meshes without contact."""
    seen = (model.geom_type == mujoco.mjtGeom.mjGEOM_MESH) & (model.geom_contype == 0) & (model.geom_conaffinity == 0)
    return [int(geom) for geom in np.flatnonzero(seen)]


def _authored(model: Any, data: Any, geom: int) -> Pose:
    """Return the pose of a mesh's own frame; MuJoCo moves meshes to their centres and principal axes."""
    mesh = int(model.geom_dataid[geom])
    centred = Pose(data.geom_xpos[geom].copy(), data.geom_xmat[geom].reshape(3, 3).copy())
    return centred @ Pose.of(model.mesh_pos[mesh], model.mesh_quat[mesh]).inverse()


def _add_mesh(spec: Any, body: Any, look: Look, theirs: Any, model: Any, geom: int, pose: Pose) -> None:
    """Add a mesh of a look to a body of the scene, without mass and contact, in its colour."""
    mesh = theirs.mesh(model.mesh(int(model.geom_dataid[geom])).name)
    name = f"{look.prefix}look/{mesh.name or Path(mesh.file).stem}"
    if spec.mesh(name) is None:
        file = Path(theirs.modelfiledir, theirs.meshdir, mesh.file)
        added = spec.add_mesh(name=name, file=str(file), scale=mesh.scale, refpos=mesh.refpos, refquat=mesh.refquat)
        added.inertia, added.smoothnormal = mesh.inertia, mesh.smoothnormal
    shown = body.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname=name, contype=0, conaffinity=0, group=1, mass=0)
    shown.pos, shown.quat = pose.position, quaternion_from_rotation(pose.rotation)
    material = int(model.geom_matid[geom])
    shown.rgba = model.mat_rgba[material] if material >= 0 else model.geom_rgba[geom]
