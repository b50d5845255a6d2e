"""Adds arms with grippers, tools and fixtures to a model under construction, with the numbers of their data sheets."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.backends.simulation.arms.geometry_errors import make_mounting_error, move_links
from skillc_runtime.backends.simulation.fixture_spec import FixtureSpec
from skillc_runtime.backends.simulation.model.contact_bits import set_solid
from skillc_runtime.backends.simulation.model.hold import Hold, add_mount
from skillc_runtime.backends.simulation.names import (
    box_geom_name,
    contact_sensor_name,
    face_sensor_name,
    mount_name,
    part_name,
    pressing_sensor_name,
    wrist_sensor_name,
)
from skillc_runtime.backends.simulation.scene_spec import ArmSpec, GripperSpec, ToolSpec
from skillc_runtime.backends.simulation.variation.fixture_variation import FixtureVariation
from skillc_runtime.devices.reality import NO_SIZES, Sizes
from skillc_runtime.motion.pose import Pose, quaternion_from_rotation
from skillc_runtime.motion.working_face import working_face
from skillc_runtime.world.state.data_sheet import SheetError

WRIST_SENSORS = (
    ("force", mujoco.mjtSensor.mjSENS_FORCE),
    ("torque", mujoco.mjtSensor.mjSENS_TORQUE),
    ("acceleration", mujoco.mjtSensor.mjSENS_ACCELEROMETER),
)
"""The sensors of a wrist, in this order."""

NET_FORCE = 3
"""The reduction of MuJoCo's contact sensor that adds the forces of all contacts, in world axes."""

BLOCKAGE = "blockage"
"""The geom of a model that blocks a fixture; it is removed unless the fixture is blocked."""

TOUCH_MARGIN_M = 0.01
"""Margin of a tool's touch sensor around its working geom, so that penetrating contacts count."""


def add_arm(spec: Any, names: Mapping[str, str], arm: ArmSpec, mount: Any, base: Pose, sizes: Sizes = NO_SIZES) -> None:
    """Attach an arm to the body `mount` at `base`, given in that body's frame, and its gripper to its flange.

    `sizes` are its imperfections: it and its links are where they really are.
    """
    model = mujoco.MjSpec.from_file(str(arm.model))
    _check_posture(model, names[arm.individual], arm)
    model.option.timestep = spec.option.timestep
    set_solid(model.geoms)
    for joint in model.joints:
        joint.armature = arm.sheet.number("armature")
    move_links(model, sizes)
    if arm.has_servos:
        _set_servos(model, arm)
    if (error := make_mounting_error(sizes)) is not None:
        turned = quaternion_from_rotation(base.rotation)
        mount, base = mount.add_body(name=mount_name(names[arm.individual]), pos=base.position, quat=turned), error
    frame = mount.add_frame(pos=base.position, quat=quaternion_from_rotation(base.rotation))
    spec.attach(model, prefix=part_name(names[arm.individual], ""), frame=frame)
    if arm.gripper is not None:
        _add_gripper(spec, names, arm, arm.gripper)


def add_tool(
    spec: Any,
    names: Mapping[str, str],
    tool: ToolSpec,
    pad_stiffness: float | None,
    hold: Hold | None = None,
    sizes: Sizes = NO_SIZES,
) -> None:
    """Add a tool, free to move or a part of the hand that holds it, with its mass and ground truth sensors.

    pad_stiffness: N/m, of the pad under its working face; None for a rigid tool.
    sizes: its imperfections.
    """
    name, model = names[tool.individual], mujoco.MjSpec.from_file(str(tool.model))
    _check_face(model, name, tool)
    scale = tool.mass_kg / sum(body.mass for body in model.bodies)
    for body in model.bodies[1:]:
        body.mass, body.inertia = body.mass * scale, body.inertia * scale
    root = model.worldbody.first_body()
    # The root has all that does not yield, so that its centre moves by more than that of the whole tool.
    root.ipos += np.asarray(sizes.get("centreError", np.zeros(3))) * tool.mass_kg / root.mass
    if pad_stiffness is not None:
        _set_foundation(model, tool, pad_stiffness, *sizes.get("padDampingFactor", (1.0,)))
        model.geom("face").parent.pos[2] -= sizes.get("padThicknessError", (0.0,))[0]
    set_solid(root.geoms)
    if hold is None:
        root.add_freejoint(name="free")
    face = working_face(tool.size)
    root.add_site(name="face", pos=face.position, quat=quaternion_from_rotation(face.rotation))
    felt = model.geom("face")
    felt.parent.add_site(
        name="touch", type=mujoco.mjtGeom.mjGEOM_BOX, pos=felt.pos, size=felt.size + TOUCH_MARGIN_M, rgba=[0, 0, 0, 0]
    )
    spec.attach(model, prefix=part_name(name, ""), frame=add_mount(spec, tool.pose, hold))
    _add_face_sensors(spec, name)
    _add_contact_sensor(spec, name, root)


def _set_servos(model: Any, arm: ArmSpec) -> None:
    kp, kv = arm.sheet.number("servoStiffness"), arm.sheet.number("servoDamping")
    for actuator in model.actuators:
        actuator.gainprm[0], actuator.biasprm[1], actuator.biasprm[2] = kp, -kp, -kv


def _check_posture(model: Any, name: str, arm: ArmSpec) -> None:
    joints = len(model.joints)
    if arm.home.shape != (joints,):
        raise SheetError(f"the posture home of {name} has {arm.home.size} values; {arm.model.name} has {joints} joints")


def _add_gripper(spec: Any, names: Mapping[str, str], arm: ArmSpec, gripper: GripperSpec) -> None:
    name, model = names[gripper.individual], mujoco.MjSpec.from_file(str(gripper.model))
    actuator = model.actuator("opening")
    actuator.ctrlrange = [0.0, gripper.max_opening_m]
    actuator.forcerange = [-gripper.max_force_n, gripper.max_force_n]
    set_solid(model.geoms)
    model.body("palm").add_site(name="wrist")
    spec.attach(model, prefix=part_name(name, ""), site=spec.site(part_name(names[arm.individual], "flange")))
    if arm.force_torque:
        for quantity, kind in WRIST_SENSORS:
            _add_sensor(spec, wrist_sensor_name(name, quantity), kind, part_name(name, "wrist"))


def _check_face(model: Any, name: str, tool: ToolSpec) -> None:
    face = model.geom("face")
    if face is None or face.type != mujoco.mjtGeom.mjGEOM_BOX:
        raise SheetError(f"the model {tool.model.name} of {name} has no box geom `face`")
    modelled, believed = 2 * np.asarray(face.size[:2]), tool.size[:2]
    if not np.allclose(modelled, believed, atol=1e-6):
        raise SheetError(f"the face of {name} is {believed} m in the world model and {modelled} m in {tool.model.name}")


def _set_foundation(model: Any, tool: ToolSpec, stiffness: float, damping_factor: float) -> None:
    """Set the springs under the working face, an elastic foundation: K_z = k, K_rx = k b^2/12, K_ry = k a^2/12.

    a, b: extent of the face along x and y; the dampers follow in the same way. A face whose model has joints for it
    yields along itself as well, with the same stiffness: K_x = K_y = k.
    """
    damping = damping_factor * tool.sheet.number("padDamping")
    a, b = tool.size[:2]
    for joint, lever in (("press", 1.0), ("tilt_x", b * b / 12), ("tilt_y", a * a / 12)):
        found = model.joint(joint)
        if found is None:
            raise SheetError(f"the model {tool.model.name} has no joint `{joint}` under its working face")
        found.stiffness[0], found.damping[0] = stiffness * lever, damping * lever
    for joint in filter(None, map(model.joint, ("shear_x", "shear_y"))):
        joint.stiffness[0], joint.damping[0] = stiffness, damping


def _add_face_sensors(spec: Any, name: str) -> None:
    """Add, in this order: the normal force on the face; its position, quaternion and linear velocity in the world."""
    _add_sensor(spec, face_sensor_name(name, "touch"), mujoco.mjtSensor.mjSENS_TOUCH, part_name(name, "touch"))
    for quantity, kind in (
        ("position", mujoco.mjtSensor.mjSENS_FRAMEPOS),
        ("quaternion", mujoco.mjtSensor.mjSENS_FRAMEQUAT),
        ("velocity", mujoco.mjtSensor.mjSENS_FRAMELINVEL),
    ):
        _add_sensor(spec, face_sensor_name(name, quantity), kind, part_name(name, "face"))


def add_pressing_sensor(spec: Any, tool: str, surface: str) -> None:
    """Add the force (3,) of a tool on a surface itself, without what lies on that, as the solver has it."""
    spec.add_sensor(
        name=pressing_sensor_name(tool, surface),
        type=mujoco.mjtSensor.mjSENS_CONTACT,
        objtype=mujoco.mjtObj.mjOBJ_XBODY,
        objname=part_name(tool, "block"),
        reftype=mujoco.mjtObj.mjOBJ_GEOM,
        refname=box_geom_name(surface),
        intprm=[1 << int(mujoco.mjtConDataField.mjCONDATA_FORCE), NET_FORCE, 1],
    )


def _add_contact_sensor(spec: Any, name: str, root: Any) -> None:
    """Add the force (3,) of a tool on all that it touches, as the solver has it; its own body is `root`."""
    spec.add_sensor(
        name=contact_sensor_name(name),
        type=mujoco.mjtSensor.mjSENS_CONTACT,
        objtype=mujoco.mjtObj.mjOBJ_XBODY,
        objname=root.name,
        intprm=[1 << int(mujoco.mjtConDataField.mjCONDATA_FORCE), NET_FORCE, 1],
    )


def _add_sensor(spec: Any, name: str, kind: Any, site: str) -> None:
    spec.add_sensor(name=name, type=kind, objtype=mujoco.mjtObj.mjOBJ_SITE, objname=site)


def add_fixture(spec: Any, name: str, fixture: FixtureSpec, true: FixtureVariation) -> None:
    """Attach the model of a fixture at its true pose; an absent one is invisible and without contact."""
    model, pose = mujoco.MjSpec.from_file(str(fixture.model)), true.true_pose(fixture.pose)
    blockage = model.geom(BLOCKAGE)
    if blockage is not None and not true.blocked:
        model.delete(blockage)
    for geom in model.geoms:
        _set_friction(geom, true.friction)
        if not true.present:
            _hide(geom)
    for joint in model.joints:
        joint.stiffness[0] *= 1.0 + true.stiffness_share
    frame = spec.worldbody.add_frame(pos=pose.position, quat=quaternion_from_rotation(pose.rotation))
    spec.attach(model, prefix=part_name(name, ""), frame=frame)


def _set_friction(geom: Any, friction: float | None) -> None:
    if friction is not None:
        geom.friction[0] = friction


def _hide(geom: Any) -> None:
    geom.contype = geom.conaffinity = 0
    geom.rgba = [0.0, 0.0, 0.0, 0.0]
