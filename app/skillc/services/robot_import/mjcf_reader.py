"""Reads an arm from MJCF, as MuJoCo compiles it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from skillc.errors import RequestError
from skillc.services.robot_import.arm_reader import ArmReader, Reading, ReadOptions, compile_model
from skillc.services.robot_import.chain import choose_chain, cut_to_chain
from skillc.services.robot_import.possible_inertia import correct_inertia
from skillc.services.robot_import.robot_model import WHOLE_TURN, Joint, Shape, ShapeKind
from skillc.services.robot_import.shape_fitting import fit_shape
from skillc_runtime.motion.pose import Pose, rotation_from_quaternion

_KINDS: Mapping[int, ShapeKind] = {
    int(mujoco.mjtGeom.mjGEOM_BOX): "box",
    int(mujoco.mjtGeom.mjGEOM_SPHERE): "sphere",
    int(mujoco.mjtGeom.mjGEOM_CAPSULE): "capsule",
    int(mujoco.mjtGeom.mjGEOM_CYLINDER): "cylinder",
    int(mujoco.mjtGeom.mjGEOM_ELLIPSOID): "box",
}
_SIZES = {"box": 3, "sphere": 1, "capsule": 2, "cylinder": 2}


def read_mjcf(path: Path, options: ReadOptions) -> Reading:
    """Return the arm of an MJCF file between a body and a body or site.

    RequestError if there is no such arm, or MuJoCo refuses the file.
    """
    spec, notes = _load(path)
    chain = choose_chain(path, spec, "body", options.base, options.tip)
    for body in chain.moved:
        _check_joints(path, body)
    stated = correct_inertia(spec) if options.correct_inertia else {}
    full = compile_model(path, spec)
    armatures = {float(full.joint(name).armature[0]) for name in chain.joints}
    if len(armatures) > 1:
        notes.append(f"the armature of joints differs; the largest, {max(armatures):g} kg m^2, is taken for all")
    notes += cut_to_chain(spec, chain, "their zero position")
    arm = ArmReader(path, spec, chain, options, stated)
    joints = [_joint(arm.model, full, joint) for joint in arm.joints]
    return arm.read(joints, partial(_find_shapes, arm.model), max(armatures) or None, notes)


def _load(path: Path) -> tuple[Any, list[str]]:
    """Return the specification of a file, without the geoms whose meshes are missing, and notes about these."""
    try:
        spec = mujoco.MjSpec.from_file(str(path))
    except ValueError as error:
        raise RequestError(f"{path} cannot be read by MuJoCo: {' '.join(str(error).split())}") from error
    folder = path.parent / (spec.meshdir or "")
    missing = [mesh for mesh in spec.meshes if mesh.file and not (folder / mesh.file).is_file()]
    names = [mesh.name or Path(mesh.file).stem for mesh in missing]
    for geom in [each for each in spec.geoms if each.meshname in names]:
        spec.delete(geom)
    for mesh in missing:
        spec.delete(mesh)
    note = f"{', '.join(names[:4])}: these meshes are missing; other shapes of the links are taken instead"
    return spec, [note] if names else []


def _check_joints(path: Path, body: Any) -> None:
    """Refuse a body with several joints, or one that no motor moves. RequestError."""
    if len(body.joints) > 1:
        raise RequestError(f"{path}: body `{body.name}` has {len(body.joints)} joints; give each a body of its own")
    if body.joints[0].type not in (mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_SLIDE):
        raise RequestError(
            f"{path}: the joint of body `{body.name}` is free or a ball, and an arm's joints turn or slide"
        )


def _find_shapes(model: Any, bodies: Sequence[int]) -> Iterator[tuple[int, Shape]]:
    """Yield the shapes of bodies, each with its body: of geoms that touch others, else of all."""
    own = [geom for geom in range(model.ngeom) if int(model.geom_bodyid[geom]) in bodies]
    for geom in [each for each in own if model.geom_contype[each] or model.geom_conaffinity[each]] or own:
        at = Pose(model.geom_pos[geom].copy(), rotation_from_quaternion(model.geom_quat[geom]))
        shape = _shape(model, geom)
        if shape is not None:
            yield int(model.geom_bodyid[geom]), Shape(shape.kind, at @ shape.pose, shape.size)


def _shape(model: Any, geom: int) -> Shape | None:
    kind = model.geom_type[geom]
    if kind == mujoco.mjtGeom.mjGEOM_MESH:
        mesh = int(model.geom_dataid[geom])
        first = int(model.mesh_vertadr[mesh])
        vertices = model.mesh_vert[first : first + int(model.mesh_vertnum[mesh])]
        return fit_shape(np.array(vertices, dtype=float))
    name = _KINDS.get(int(kind))
    size = tuple(model.geom_size[geom][: _SIZES.get(name or "", 0)].tolist())
    return Shape(name, Pose(np.zeros(3), np.eye(3)), size) if name else None


def _joint(model: Any, full: Any, joint: int) -> Joint:
    """Return a joint of a model with the effort that its actuators in the whole model state."""
    zero, name = float(model.qpos0[model.jnt_qposadr[joint]]), model.joint(joint).name
    low, high = (model.jnt_range[joint] - zero).tolist() if model.jnt_limited[joint] else (-WHOLE_TURN, WHOLE_TURN)
    slides = bool(model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_SLIDE)
    return Joint(name, slides, model.jnt_axis[joint].copy(), low, high, _effort(full, name), None)


def _effort(model: Any, joint: str) -> float | None:
    """Return the greatest effort of a joint in N m or N that its limits or actuators state, None if they do not."""
    number = model.joint(joint).id
    found = [float(np.abs(model.jnt_actfrcrange[number]).max())] if model.jnt_actfrclimited[number] else []
    for each in range(model.nu):
        if model.actuator_trntype[each] != mujoco.mjtTrn.mjTRN_JOINT or model.actuator_trnid[each, 0] != number:
            continue
        gear = abs(float(model.actuator_gear[each, 0]))
        if model.actuator_forcelimited[each]:
            found.append(gear * float(np.abs(model.actuator_forcerange[each]).max()))
        elif model.actuator_ctrllimited[each] and model.actuator_biastype[each] == mujoco.mjtBias.mjBIAS_NONE:
            gain = abs(float(model.actuator_gainprm[each, 0]))
            found.append(gear * gain * float(np.abs(model.actuator_ctrlrange[each]).max()))
    return min(found) if found else None
