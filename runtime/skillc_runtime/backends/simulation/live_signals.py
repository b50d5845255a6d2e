"""Offers what changes in each control period of a simulated cell."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from skillc_runtime.backends.simulation.arms.arm import ModelledArm
from skillc_runtime.backends.simulation.names import face_sensor_name
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.control.driver import CompliantArmDriver
from skillc_runtime.devices.live import LiveArm, LiveBodies, LiveSensors, LiveSignals, Place, Places
from skillc_runtime.motion.pose import Array


def make_live_signals(
    scene: SceneSpec,
    period_s: float,
    arms: Mapping[str, ModelledArm],
    drivers: Mapping[str, CompliantArmDriver],
    model: Any,
    data: Any,
) -> LiveSignals:
    """Return the live signals of a cell; its arrays stay where they are."""
    sensors, positions, quaternions = data.sensordata, data.xpos, data.xquat
    faces = ((each.individual, face_sensor_name(scene.names[each.individual], "touch")) for each in scene.tools)
    return LiveSignals(
        period_s=period_s,
        now=lambda: float(data.time),
        arms=tuple(_describe_arm(each, arms[each], drivers[each]) for each in sorted(arms)),
        sensors=LiveSensors(
            sensors.size,
            sensors.tobytes,
            tuple(sorted((tool, int(model.sensor(sensor).adr[0])) for tool, sensor in faces)),
        ),
        bodies=LiveBodies(positions.tobytes, quaternions.tobytes),
        places=_places_of([(arms[each], drivers[each]) for each in sorted(arms)], sensors),
    )


def _places_of(arms: Sequence[tuple[ModelledArm, CompliantArmDriver]], sensors: Array) -> Callable[[], Places]:
    """Return a function that returns where the arrays of a cell are, in the order of a recording.

    It is the same tuple until an arm follows a reference elsewhere.
    """
    motions = [driver.motion for _, driver in arms]
    known: list[Array] = []
    places: Places = ()

    def find() -> Places:
        nonlocal known, places
        for motion, reference in zip(motions, known, strict=False):  # a loop, as before each run of steps
            if motion.live_reference is not reference:
                known = []
                break
        if not known:
            known = [motion.live_reference for motion in motions]
            of_arms = (array for pair in arms for array in _arrays_of(*pair))
            places = tuple(map(_place_of, (*of_arms, sensors)))
        return places

    return find


def _arrays_of(arm: ModelledArm, driver: CompliantArmDriver) -> Iterator[Array]:
    yield arm.live_joints
    yield driver.motion.live_reference
    if (wrench := arm.live_wrench) is not None:
        yield wrench
    yield arm.live_velocity
    yield driver.compliance.live_force


def _place_of(array: Array) -> Place:
    return int(array.__array_interface__["data"][0]), array.size


def _describe_arm(individual: str, arm: ModelledArm, driver: CompliantArmDriver) -> LiveArm:
    measured, wrench = arm.live_joints, arm.live_wrench
    return LiveArm(
        individual=individual,
        joints=measured.shape[1],
        measured=measured.tobytes,
        wrench=None if wrench is None else wrench.tobytes,
        reference=driver.motion.copy_tool_reference,
        base=lambda: arm.base,
        velocity=arm.live_velocity.tobytes,
        force=driver.compliance.live_force.tobytes,
    )
