"""Reads an arm from MJCF, as MuJoCo compiles it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from skillc.errors import RequestError
from skillc.services.robot_import.chain import check_count
from skillc.services.robot_import.mechanism import MujocoMechanism
from skillc.services.robot_import.mjcf_chain import MjcfChain, choose_chain, cut_to_chain
from skillc.services.robot_import.reading import Reading, ReadOptions
from skillc.services.robot_import.robot_model import Base, Inertia, Joint, RobotLink, RobotModel, Shape, ShapeKind
from skillc.services.robot_import.shape_fitting import fit_shape
from skillc.services.robot_import.urdf_shapes import stand_in
from skillc_runtime.motion.pose import Array, Pose

WHOLE_TURN = 2 * np.pi
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
    full = _compile(path, spec)
    chain = choose_chain(path, full, options.base, options.tip)
    check_count(str(path), list(chain.joints), f"between `{chain.base}` and `{chain.tip}`")
    armatures = {float(full.joint(name).armature[0]) for name in chain.joints}
    notes += cut_to_chain(spec, chain)
    model = _compile(path, spec)
    arm = _Arm(path, model, chain, full)
    links = tuple(arm.links())
    if len(armatures) > 1:
        notes.append(f"the armature of joints differs; the largest, {max(armatures):g} kg m^2, is taken for all")
    found = RobotModel(
        Base(chain.base, tuple(arm.shapes_of(0))), links, arm.flange(options.turn), chain.tip, max(armatures) or None
    )
    source = MujocoMechanism(model, arm.joints, found.flange, arm.base)
    return Reading(found, source, "MuJoCo", tuple(notes))


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


def _compile(path: Path, spec: Any) -> Any:
    try:
        return spec.compile()
    except ValueError as error:
        raise RequestError(f"{path} is refused by MuJoCo: {' '.join(str(error).split())}") from error


class _Arm:
    """The compiled arm in its zero posture; link 0 is the base, the others are those that the joints move."""

    def __init__(self, path: Path, model: Any, chain: MjcfChain, full: Any) -> None:
        self._path, self._model, self._chain, self._full = path, model, chain, full
        self._data = mujoco.MjData(model)
        for joint in range(model.njnt):
            model.dof_armature[int(model.jnt_dofadr[joint])] = 0.0
        mujoco.mj_kinematics(model, self._data)
        self.joints = [model.joint(name).id for name in chain.joints]
        moved = [int(model.jnt_bodyid[joint]) for joint in self.joints]
        root = 0 if chain.base == "world" else model.body(chain.base).id
        self.base = self._body(root)
        anchors = [Pose(model.jnt_pos[joint].copy(), np.eye(3)) for joint in self.joints]
        self._frames = [self.base, *(self._body(body) @ at for body, at in zip(moved, anchors, strict=True))]
        self._owner = self._owners(root, moved)

    def links(self) -> Iterator[RobotLink]:
        """Yield the links from the base on; one without a shape has a capsule to the next joint."""
        for number, joint in enumerate(self.joints, 1):
            here, before = self._frames[number], self._frames[number - 1]
            shapes = tuple(self.shapes_of(number))
            if not shapes and number < len(self.joints):
                shapes = stand_in((here.inverse() @ self._frames[number + 1]).position)
            body = self._model.body(self._model.jnt_bodyid[joint]).name or f"link{number}"
            yield RobotLink(body, before.inverse() @ here, self._joint(joint), self._inertia(number), shapes)

    def flange(self, turn: Array) -> Pose:
        """Return the flange in the frame of the last link."""
        data, chain = self._data, self._chain
        at = data.site(chain.tip) if chain.tip_is_site else data.body(chain.tip)
        here = self._frames[-1].inverse() @ Pose(at.xpos.copy(), at.xmat.reshape(3, 3).copy())
        return Pose(here.position, here.rotation @ turn)

    def shapes_of(self, number: int) -> Iterator[Shape]:
        """Yield the shapes of a link: of geoms that touch others, else of all."""
        model = self._model
        own = [geom for geom in range(model.ngeom) if self._owner.get(int(model.geom_bodyid[geom])) == number]
        solid = [geom for geom in own if model.geom_contype[geom] or model.geom_conaffinity[geom]]
        for geom in solid or own:
            at = Pose(self._data.geom_xpos[geom].copy(), self._data.geom_xmat[geom].reshape(3, 3).copy())
            shape = self._shape(geom)
            if shape is not None:
                here = self._frames[number].inverse() @ at @ shape.pose
                yield Shape(shape.kind, here, shape.size)

    def _shape(self, geom: int) -> Shape | None:
        model, kind = self._model, self._model.geom_type[geom]
        if kind == mujoco.mjtGeom.mjGEOM_MESH:
            mesh = int(model.geom_dataid[geom])
            first = int(model.mesh_vertadr[mesh])
            vertices = model.mesh_vert[first : first + int(model.mesh_vertnum[mesh])]
            return fit_shape(np.array(vertices, dtype=float))
        name = _KINDS.get(int(kind))
        size = tuple(model.geom_size[geom][: _SIZES.get(name or "", 0)].tolist())
        return Shape(name, Pose(np.zeros(3), np.eye(3)), size) if name else None

    def _inertia(self, number: int) -> Inertia:
        """Return the inertia of all bodies of a link together, in its frame."""
        model, home = self._model, self._frames[number].inverse()
        bodies = [body for body, owner in self._owner.items() if owner == number]
        masses = model.body_mass[bodies]
        total = float(masses.sum())
        if total <= 0.0:
            raise RequestError(f"{self._path}: what joint `{self._chain.joints[number - 1]}` moves has no mass")
        centres = np.array([home.apply(self._data.xipos[body]) for body in bodies])
        centre = masses @ centres / total
        matrix = np.zeros((3, 3))
        for body, mass, at in zip(bodies, masses, centres - centre, strict=True):
            axes = home.rotation @ self._data.ximat[body].reshape(3, 3)
            matrix += axes * model.body_inertia[body] @ axes.T + mass * (at @ at * np.eye(3) - np.outer(at, at))
        return Inertia(total, centre, matrix)

    def _joint(self, joint: int) -> Joint:
        model, zero = self._model, float(self._model.qpos0[self._model.jnt_qposadr[joint]])
        low, high = (model.jnt_range[joint] - zero).tolist() if model.jnt_limited[joint] else (-WHOLE_TURN, WHOLE_TURN)
        slides = bool(model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_SLIDE)
        name = model.joint(joint).name
        return Joint(name, slides, model.jnt_axis[joint].copy(), low, high, _effort(self._full, name), None)

    def _owners(self, root: int, moved: list[int]) -> dict[int, int]:
        """Return for each body of the arm the number of the link that it is fixed to."""
        found = {root: 0} | {body: number for number, body in enumerate(moved, 1)}
        for body in range(1, self._model.nbody):
            parent = int(self._model.body_parentid[body])
            if body not in found and parent in found and (parent, root) != (0, 0):
                found[body] = found[parent]
        return found

    def _body(self, body: int) -> Pose:
        return Pose(self._data.xpos[body].copy(), self._data.xmat[body].reshape(3, 3).copy())


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
