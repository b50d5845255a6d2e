"""Reads the specification of a simulated scene from the world model, once."""

from __future__ import annotations

from typing import Final

from skillc_runtime.backends.simulation.cameras.camera import read_inspection_camera
from skillc_runtime.backends.simulation.cameras.camera_spec import read_cameras
from skillc_runtime.backends.simulation.cameras.image_camera_spec import read_image_camera
from skillc_runtime.backends.simulation.displacement import read_displacement_ranges
from skillc_runtime.backends.simulation.fixture_spec import read_fixtures
from skillc_runtime.backends.simulation.friction import read_friction_range
from skillc_runtime.backends.simulation.people import read_people
from skillc_runtime.backends.simulation.scene_spec import (
    ArmSpec,
    BaseSpec,
    GripperSpec,
    SceneSpec,
    SurfaceSpec,
    ToolSpec,
)
from skillc_runtime.devices.arm import Mode
from skillc_runtime.devices.reality import read_reality
from skillc_runtime.world.space.bodies import RigidBody, read_bodies
from skillc_runtime.world.space.dirt import read_dirt_map
from skillc_runtime.world.space.frames import moves_with, pose, size
from skillc_runtime.world.space.surfaces import dirt_friction, least_force_n, surface_layout
from skillc_runtime.world.state.data_sheet import SheetError, number_of, sheet_of, text_of
from skillc_runtime.world.state.terms import (
    ARM_DEVICE,
    COMPLIANT_CONTROLLER,
    DIRT_REMOVAL,
    FORCE_NOISE,
    FORCE_TORQUE_SENSOR,
    HAS_ARM,
    HAS_GRIPPER,
    HAS_SENSOR,
    JOINT_SPEED_NOISE,
    MOBILE_ROBOT,
    OFFSET_RANGE,
    OPENING_BIAS,
    OPENING_NOISE,
    POSITION_CONTROLLED_ARM,
    POSTURE_RANGE,
    RIGID_TOOL_SHEET,
    SENSING_PERIOD,
    STIFFNESS_RANGE,
    SURFACE,
    TILT_RANGE,
    TOOL,
    TORQUE_CONTROLLED_ARM,
    TORQUE_NOISE,
    VELOCITY_CONTROLLED_ARM,
    WEIGHT,
)
from skillc_runtime.world.state.world_state import WorldState

MODES: Final[dict[str, Mode]] = {
    TORQUE_CONTROLLED_ARM: "torque",
    POSITION_CONTROLLED_ARM: "position",
    VELOCITY_CONTROLLED_ARM: "velocity",
}
"""The kinds of commands of arms by class."""


def read_scene_spec(state: WorldState) -> SceneSpec:
    """Read what a simulation needs; SheetError or FrameError if a fact is missing."""
    short, bodies = state.vocabulary.short, read_bodies(state)
    return SceneSpec(
        names={individual: short(individual) for individual in sorted(state.individuals)},
        arms=tuple(_arm(state, iri) for iri in sorted(state.instances(ARM_DEVICE))),
        bases=tuple(_base(state, iri) for iri in sorted(state.instances(MOBILE_ROBOT))),
        tools=tuple(_tool(state, iri) for iri in sorted(state.instances(TOOL))),
        surfaces=tuple(_surface(state, iri) for iri in sorted(state.instances(SURFACE))),
        bodies=bodies,
        mounted=_mounted(state, bodies),
        fixtures=read_fixtures(state),
        people=read_people(state),
        cameras=read_cameras(state),
        inspection=read_inspection_camera(state),
        image_camera=read_image_camera(state),
        displaced=read_displacement_ranges(state),
    )


def _mounted(state: WorldState, bodies: tuple[RigidBody, ...]) -> dict[str, str]:
    """Return the mobile robot with which each fixed body moves."""
    robots, fixed = sorted(state.instances(MOBILE_ROBOT)), [each.individual for each in bodies if not each.movable]
    return {one: robot for one in fixed for robot in robots if moves_with(state, one, robot)}


def _arm(state: WorldState, arm: str) -> ArmSpec:
    sheet = sheet_of(state, arm)
    sheet.require_complete()
    robots = sorted(state.subjects(HAS_ARM, arm))
    sensors = sorted(each for each in state.objects(arm, HAS_SENSOR) if state.is_a(each, FORCE_TORQUE_SENSOR))
    grippers = sorted(state.objects(arm, HAS_GRIPPER))
    return ArmSpec(
        individual=arm,
        robot=robots[0] if robots else None,
        base=pose(state, arm),
        model=sheet.model,
        modes=_modes(state, arm),
        home=sheet.posture("home"),
        force_torque=bool(sensors),
        controller=text_of(state, arm, COMPLIANT_CONTROLLER),
        gripper=_gripper(state, grippers[0]) if grippers else None,
        sheet=sheet,
        posture_range_rad=number_of(state, arm, POSTURE_RANGE, default=0.0),
        joint_speed_noise=number_of(state, arm, JOINT_SPEED_NOISE, default=0.0),
        force_noise_n=number_of(state, sensors[0], FORCE_NOISE, default=0.0) if sensors else 0.0,
        torque_noise_n_m=number_of(state, sensors[0], TORQUE_NOISE, default=0.0) if sensors else 0.0,
        reality=read_reality(state, arm),
    )


def _modes(state: WorldState, arm: str) -> tuple[Mode, ...]:
    modes = tuple(mode for cls, mode in MODES.items() if state.is_a(arm, cls))
    if modes:
        return modes
    kinds = " nor a ".join(map(state.vocabulary.short, MODES))
    raise SheetError(f"nothing tells what {state.vocabulary.short(arm)} takes: it is neither a {kinds}")


def _gripper(state: WorldState, gripper: str) -> GripperSpec:
    sheet = sheet_of(state, gripper)
    return GripperSpec(
        gripper,
        sheet.model,
        sheet.number("maxOpening"),
        sheet.number("maxForce"),
        sheet.number("fingerSpeed"),
        opening_bias_m=number_of(state, sheet.individual, OPENING_BIAS, default=0.0),
        opening_noise_m=number_of(state, sheet.individual, OPENING_NOISE, default=0.0),
        sensing_period_s=number_of(state, sheet.individual, SENSING_PERIOD, default=0.0),
    )


def _base(state: WorldState, robot: str) -> BaseSpec:
    sheet = sheet_of(state, robot)
    limits = (sheet.number(name) for name in ("driveSpeed", "driveAcceleration", "turnSpeed", "turnAcceleration"))
    return BaseSpec(robot, pose(state, robot), size(state, robot), *limits)


def _tool(state: WorldState, tool: str) -> ToolSpec:
    sheet = sheet_of(state, tool)
    return ToolSpec(
        individual=tool,
        model=sheet.model,
        pose=pose(state, tool),
        size=size(state, tool),
        mass_kg=number_of(state, tool, WEIGHT),
        sheet=sheet,
        stiffness_range=number_of(state, tool, STIFFNESS_RANGE, default=0.0),
        rigid=state.is_a(sheet.individual, RIGID_TOOL_SHEET),
        reality=read_reality(state, tool),
    )


def _surface(state: WorldState, surface: str) -> SurfaceSpec:
    rubs = dirt_friction(state, surface)
    return SurfaceSpec(
        individual=surface,
        pose=pose(state, surface),
        size=size(state, surface),
        layout=surface_layout(state, surface),
        friction=read_friction_range(state, surface),
        offset_range_m=number_of(state, surface, OFFSET_RANGE, default=0.0),
        tilt_range_rad=number_of(state, surface, TILT_RANGE, default=0.0),
        least_n=least_force_n(state, surface),
        dirt=read_dirt_map(state, surface),
        removal_s=0.0 if rubs == 1.0 else number_of(state, surface, DIRT_REMOVAL),
        dirt_friction=rubs,
    )
