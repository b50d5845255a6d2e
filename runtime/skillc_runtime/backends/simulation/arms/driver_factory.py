"""Creates the driver of a simulated arm from its specification."""

from __future__ import annotations

from math import inf

from msgspec import structs

from skillc_runtime.backends.simulation.arms.arm import ModelledArm
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.control.driver import CompliantArmDriver
from skillc_runtime.control.gains import LawGains, RobotGains, UnknownController, read_gains
from skillc_runtime.control.laws.virtual_arm import load_virtual_model
from skillc_runtime.control.setup import ArmSetup
from skillc_runtime.control.supervision.safety import SafetyLimits, Workspace
from skillc_runtime.devices.arm import ModeRefused
from skillc_runtime.devices.arm_driver import TaskLimits
from skillc_runtime.world.space.frames import relative_pose, size
from skillc_runtime.world.space.shared_cell import find_shared_limit
from skillc_runtime.world.state.data_sheet import SheetError, number_of
from skillc_runtime.world.state.terms import (
    COLLISION_TORQUE,
    CONTACT_FORCE_LIMIT,
    FORCE_DRIFT_LIMIT,
    HAS_SENSOR,
    HAS_WORKSPACE,
    JERK_LIMIT,
    TOOL_SPEED_LIMIT,
)


def make_driver(facts: ArmSpec, arm: ModelledArm, period_s: float) -> CompliantArmDriver:
    """Return the driver of an arm with the controller its facts name.

    SheetError if it or a gain is missing, or the arm is outside its workspace.
    """
    driver = CompliantArmDriver(read_setup(facts, arm, period_s))
    if driver.outside_workspace_m > 0.0:
        raise SheetError(
            f"the tool of {facts.sheet.state.vocabulary.short(facts.individual)} starts "
            f"{1e3 * driver.outside_workspace_m:.0f} mm outside the arm's workspace; enlarge that, or start elsewhere"
        )
    return driver


def read_setup(facts: ArmSpec, arm: ModelledArm, period_s: float) -> ArmSetup:
    """Return what the driver of an arm needs, and let the arm take the commands of its law.

    SheetError if a fact is missing, or the arm cannot do what its law needs.
    """
    try:
        chosen = read_gains(facts.controller, facts.sheet.number)
    except UnknownController as error:
        raise SheetError(f"{facts.sheet.state.vocabulary.short(facts.individual)}: {error}") from error
    chosen = structs.replace(chosen, limits=read_task_limits(facts, chosen.limits))
    _switch_mode(facts, arm, chosen.law)
    virtual, limits = load_virtual_model(facts.model), read_safety_limits(facts)
    return ArmSetup(arm, virtual, chosen, arm.limits, lambda: arm.live_base, period_s, limits)


def read_task_limits(facts: ArmSpec, limits: TaskLimits) -> TaskLimits:
    """Return the limits of skills: those of the gains, the jerk of the sheet, and what people nearby bear."""
    state, sheet = facts.sheet.state, facts.sheet.individual
    shared = find_shared_limit(state, facts.individual)
    return structs.replace(
        limits,
        force_n=min(limits.force_n, shared.force_n),
        speed_m_s=min(limits.speed_m_s, shared.speed_m_s),
        jerk_m_s3=number_of(state, sheet, JERK_LIMIT, limits.jerk_m_s3),
    )


def _switch_mode(facts: ArmSpec, arm: ModelledArm, law: LawGains) -> None:
    """Switch the arm to the commands of the law; SheetError if it cannot, or has no force sensor that the law needs."""
    short = facts.sheet.state.vocabulary.short
    if isinstance(law, RobotGains) and not arm.has_own_law:
        raise SheetError(
            f"{short(facts.individual)} has the controller {facts.controller!r}, which runs on the robot's side: only "
            "a back end of robots with Cartesian controllers has that"
        )
    try:
        arm.switch(law.mode)
    except ModeRefused as refusal:
        raise SheetError(f"{short(facts.individual)} has the controller {facts.controller!r}: {refusal}") from refusal
    if law.needs_force and not arm.capabilities.feels_force:
        raise SheetError(
            f"{short(facts.individual)} has the controller {facts.controller!r}, which needs a force/torque sensor: "
            f"it has none ({short(HAS_SENSOR)})"
        )


def read_safety_limits(facts: ArmSpec) -> SafetyLimits:
    """Return the safety limits of an arm: those of its sheet and of people nearby, and its workspace.

    The workspace moves with its base.
    """
    state, sheet = facts.sheet.state, facts.sheet.individual
    names = (CONTACT_FORCE_LIMIT, COLLISION_TORQUE, TOOL_SPEED_LIMIT, FORCE_DRIFT_LIMIT)
    force, torque, speed, drift = (number_of(state, sheet, limit, inf) for limit in names)
    shared = find_shared_limit(state, facts.individual)
    spaces = sorted(state.objects(facts.individual, HAS_WORKSPACE))
    space = Workspace(relative_pose(state, facts.individual, spaces[0]), size(state, spaces[0])) if spaces else None
    return SafetyLimits(min(force, shared.force_n), torque, min(speed, shared.speed_m_s), space, drift)
