"""Builds the MuJoCo model of a scene: surfaces, furniture, devices, contacts and sensors."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from typing import Any

import mujoco
import numpy as np
from msgspec import structs

from skillc_runtime.backends.simulation.model.body_builder import (
    add_fixed_body,
    add_movable_body,
    set_support,
)
from skillc_runtime.backends.simulation.model.device_builder import add_arm, add_fixture, add_pressing_sensor, add_tool
from skillc_runtime.backends.simulation.model.hold import Hold, fix_fingers
from skillc_runtime.backends.simulation.model.own_overlaps import exclude_own_overlaps
from skillc_runtime.backends.simulation.names import (
    base_body_name,
    box_geom_name,
    hole_name,
    obstacle_name,
    part_name,
    weld_name,
)
from skillc_runtime.backends.simulation.scene_spec import BaseSpec, SceneSpec, SurfaceSpec
from skillc_runtime.backends.simulation.variation.variation import SurfaceVariation, Variation
from skillc_runtime.motion.layout import Hole
from skillc_runtime.motion.pose import Array, Pose, quaternion_from_rotation
from skillc_runtime.world.state.data_sheet import SheetError

MARK_M = 0.0003
"""Thickness of the mark of a flat hole."""

FLOOR_FRICTION = 0.6
"""Wood against felt; it only keeps a tool where it lies."""

WELD_SOLREF = (0.004, 1.0)
WELD_SOLIMP = (0.99, 0.999, 0.0005, 0.5, 2.0)
"""A grasp as stiff as a 1 ms step allows: a few micrometres at 20 N."""

NO_HOLDS: Mapping[str, Hold] = {}

SLIDING_TOLERANCE = 1e-4
"""Conjugate gradients stop when a further step would improve the solution by less.

The force on a soft face differs by up to 2e-3 of itself from an exact solution, 1.5e-4 in the median; with MuJoCo's
1e-8 it differs by up to 2e-5, and a step takes an eighth to a quarter longer. Wipes of the same seeds are the same: no
force RMSE changed by more than 0.005 % of the force.
"""

BOARD, STEEL = (0.93, 0.94, 0.95, 1.0), (0.4, 0.43, 0.47, 1.0)


def build_model(
    scene: SceneSpec, variation: Variation, timestep_s: float = 0.001, holds: Mapping[str, Hold] = NO_HOLDS
) -> mujoco.MjModel:
    """Build the model of a scene with its true differences from the facts; `holds` are by IRI of what is held.

    Raises SheetError if a data sheet's model cannot be read or lacks a part that the simulation needs.
    """
    try:
        return describe_model(scene, variation, timestep_s, holds).compile()
    except ValueError as error:
        raise SheetError(f"the models of the data sheets cannot be used: {error}") from error


def describe_model(
    scene: SceneSpec, variation: Variation, timestep_s: float = 0.001, holds: Mapping[str, Hold] = NO_HOLDS
) -> mujoco.MjSpec:
    """Return the specification of a scene with its true differences, which MuJoCo compiles to a model.

    What is held, by IRI in `holds`, is a part of the hand, whose fingers do not move; all else lies free.

    Raises ValueError if a model cannot be read or lacks a part.
    """
    spec = _empty(timestep_s)
    for body in scene.bodies:
        if not body.movable and body.individual not in scene.mounted:
            add_fixed_body(spec, spec.worldbody, scene.names[body.individual], body, body.pose)
    for surface in scene.surfaces:
        true = variation.of(surface.individual)
        if true.present:
            _add_surface(spec, scene.names[surface.individual], surface, true)
    for fixture, how in zip(scene.fixtures, variation.fixtures, strict=True):
        add_fixture(spec, scene.names[fixture.individual], fixture, how)
    mounts = {base.individual: _add_base(spec, scene, base) for base in scene.bases}
    _add_mounted_bodies(spec, scene, mounts)
    for arm in scene.arms:
        mount, frame = mounts.get(arm.robot or "", (spec.worldbody, Pose(np.zeros(3), np.eye(3))))
        add_arm(spec, scene.names, arm, mount, frame.inverse() @ arm.base, variation.sizes(arm))
    for hold in holds.values():
        fix_fingers(spec, hold)
    _add_graspable(spec, scene, variation, holds)
    exclude_own_overlaps(spec, scene)
    _add_welds(spec, scene, holds)
    for tool, surface in product(scene.tools, scene.surfaces):
        if variation.of(surface.individual).present:
            add_pressing_sensor(spec, scene.names[tool.individual], scene.names[surface.individual])
    _set_solver(spec, scene, holds)
    return spec


def _set_solver(spec: Any, scene: SceneSpec, holds: Mapping[str, Hold]) -> None:
    """Let conjugate gradients find contact forces where only arms and what they hold can move.

    Newton's method, else used, factorises the Hessian of all friction cones twice a step, a third of a step in which a
    soft face slides. Conjugate gradients take 6 cheap iterations there, and come as close: forces differ by 1e-5 of
    themselves. They end after 2 or 3, see `SLIDING_TOLERANCE`. In welds and in stacks, which are stiffer, they take 20
    and creep.
    """
    moving = {scene.names[each] for each in (*holds, *(arm.individual for arm in scene.arms))}
    if holds and all(joint.name.partition("/")[0] in moving for joint in spec.joints):
        spec.option.solver, spec.option.tolerance = mujoco.mjtSolver.mjSOL_CG, SLIDING_TOLERANCE


def _add_graspable(spec: Any, scene: SceneSpec, variation: Variation, holds: Mapping[str, Hold]) -> None:
    """Add tools and movable bodies, where they lie or in the hands that hold them."""
    for tool in scene.tools:
        pose = variation.true_pose(tool.individual, tool.pose)
        there = structs.replace(tool, pose=pose, mass_kg=variation.mass(tool))
        stiffness = None if tool.rigid else variation.pad_stiffness(tool)
        add_tool(spec, scene.names, there, stiffness, holds.get(tool.individual), variation.sizes(tool))
    for body in scene.movable:
        lying = structs.replace(body, pose=variation.true_pose(body.individual, body.pose))
        add_movable_body(spec, scene.names[body.individual], lying, holds.get(body.individual))


def _empty(timestep_s: float) -> Any:
    spec = mujoco.MjSpec()
    spec.option.timestep = timestep_s
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET
    # Bodies have few geoms, so that testing all pairs costs less than a search in trees of their boxes.
    spec.option.disableflags |= mujoco.mjtDisableBit.mjDSBL_MIDPHASE
    # What is in contact is one island in most steps, so that looking for islands costs more than solving all at once.
    spec.option.disableflags |= mujoco.mjtDisableBit.mjDSBL_ISLAND
    spec.visual.global_.offwidth, spec.visual.global_.offheight = 1280, 720
    spec.visual.headlight.ambient = [0.4, 0.4, 0.4]
    _add_sky(spec)
    spec.worldbody.add_light(pos=[1.0, -2.0, 4.0], dir=[-0.2, 0.4, -1.0])
    floor = spec.worldbody.add_geom(name="floor", type=mujoco.mjtGeom.mjGEOM_PLANE, size=[10.0, 10.0, 0.1])
    floor.rgba = [0.82, 0.84, 0.86, 1.0]
    set_support(floor, FLOOR_FRICTION)
    return spec


def _add_sky(spec: mujoco.MjSpec) -> None:
    """Give films a light background."""
    sky = spec.add_texture(name="sky", type=mujoco.mjtTexture.mjTEXTURE_SKYBOX, width=64, height=384)
    sky.builtin = mujoco.mjtBuiltin.mjBUILTIN_GRADIENT
    sky.rgb1, sky.rgb2 = [0.93, 0.95, 0.97], [0.70, 0.75, 0.80]


def _add_box(spec: Any, name: str, top: Pose, size: Array, friction: float, rgba: tuple[float, ...]) -> None:
    """Add a fixed box with the centre of its top at `top`."""
    body = spec.worldbody.add_body(name=name, pos=top.position, quat=quaternion_from_rotation(top.rotation))
    geom = body.add_geom(name=box_geom_name(name), type=mujoco.mjtGeom.mjGEOM_BOX, size=size / 2)
    geom.pos, geom.rgba = [0.0, 0.0, -size[2] / 2], list(rgba)
    set_support(geom, friction)


def _add_surface(spec: Any, name: str, surface: SurfaceSpec, true: SurfaceVariation) -> None:
    """Add a surface at its true pose, with its holes and an obstacle on it."""
    pose = true.true_pose(surface.pose)
    _add_box(spec, name, pose, surface.size, true.friction, BOARD)
    for number, each in enumerate(surface.layout.holes):
        _add_hole(spec, hole_name(name, number), pose, each, true.friction)
    if true.obstacle is not None:
        size = np.array(true.obstacle.size)
        top = pose @ Pose(np.array([*true.obstacle.place, size[2]]), np.eye(3))
        _add_box(spec, obstacle_name(name), top, size, true.friction, STEEL)


def _add_hole(spec: Any, name: str, surface: Pose, area: Hole, friction: float) -> None:
    """Add the protrusion of a hole, or a dark mark without contact for a flat one."""
    height = max(area.height, MARK_M)
    top = surface @ Pose(np.append(area.centre, height), np.eye(3))
    _add_box(spec, name, top, np.append(area.size, height), friction, STEEL)
    if area.height == 0:
        spec.geom(box_geom_name(name)).contype = spec.geom(box_geom_name(name)).conaffinity = 0


def _add_base(spec: Any, scene: SceneSpec, base: BaseSpec) -> tuple[Any, Pose]:
    """Add a mobile base as a mocap body; its frame is at its centre on the floor."""
    name = base_body_name(scene.names[base.individual])
    body = spec.worldbody.add_body(name=name, mocap=True)
    body.pos, body.quat = base.pose.position, quaternion_from_rotation(base.pose.rotation)
    geom = body.add_geom(name=box_geom_name(scene.names[base.individual]), type=mujoco.mjtGeom.mjGEOM_BOX)
    geom.size = base.size / 2
    set_support(geom, FLOOR_FRICTION)
    geom.pos, geom.rgba = [0.0, 0.0, base.size[2] / 2], list(STEEL)
    return body, base.pose


def _add_mounted_bodies(spec: Any, scene: SceneSpec, mounts: Mapping[str, tuple[Any, Pose]]) -> None:
    """Add the fixed bodies that mobile bases carry to their bodies, which `mounts` has with their poses."""
    for body in scene.bodies:
        if body.individual in scene.mounted:
            mount, frame = mounts[scene.mounted[body.individual]]
            add_fixed_body(spec, mount, scene.names[body.individual], body, frame.inverse() @ body.pose)


def _add_welds(spec: Any, scene: SceneSpec, holds: Mapping[str, Hold]) -> None:
    """Add an inactive weld for every gripper and what it can hold, unless that is held; a grasp activates it."""
    grippers = [scene.names[arm.gripper.individual] for arm in scene.arms if arm.gripper is not None]
    free = [scene.names[each.individual] for each in scene.graspable if each.individual not in holds]
    for gripper, thing in product(grippers, free):
        equality = spec.add_equality(name=weld_name(gripper, thing), type=mujoco.mjtEq.mjEQ_WELD)
        equality.objtype = mujoco.mjtObj.mjOBJ_BODY
        equality.name1, equality.name2 = part_name(gripper, "palm"), part_name(thing, "block")
        equality.solref, equality.solimp, equality.active = WELD_SOLREF, WELD_SOLIMP, False
