"""The signals of the devices and things of a cell, and how each group of them is read."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress

import msgspec
import numpy as np

from skillc_rdf.vocabulary.types import local_name
from skillc_runtime.devices.arm_driver import ArmDriver
from skillc_runtime.devices.backend import Backend, Clock
from skillc_runtime.devices.base import MobileBase
from skillc_runtime.devices.ground_truth import GroundTruth
from skillc_runtime.motion.pose import Array, Pose, quaternion_from_rotation
from skillc_runtime.recording.signals.signal import Origin, Signal
from skillc_runtime.world.state.terms import (
    ARM_DEVICE,
    FORCE_TORQUE_SENSOR,
    HAS_GRIPPER,
    HAS_SENSOR,
    MANIPULATABLE,
    MOBILE_ROBOT,
    TOOL,
)
from skillc_runtime.world.state.world_state import WorldState

XYZ = ("x", "y", "z")
WORLD = "world"
COMMANDED_FORCE = "force on the tool that is asked for by a push; not known without one"


class Channel(msgspec.Struct, frozen=True):
    """Some signals, and the function that returns their values (n,) at present."""

    signals: tuple[Signal, ...]
    read: Callable[[], Array]


def find_channels(backend: Backend) -> Iterator[Channel]:
    """Yield the channels of all arms and bases of a cell, and as far as the truth is known of hands, tools and things.

    They are in order of IRI.
    """
    cell, truth, state = backend.cell, backend.capabilities.truth, backend.cell.world.snapshot()
    names = name_devices(state)
    for arm in _known(state, ARM_DEVICE):
        with suppress(KeyError):
            feels = any(state.is_a(each, FORCE_TORQUE_SENSOR) for each in state.objects(arm, HAS_SENSOR))
            yield from _of_arm(Columns(names[arm], arm), cell.arm(arm), feels)
        if truth is not None:
            yield from _of_hands(arm, truth, state, names)
    for base in _known(state, MOBILE_ROBOT):
        with suppress(KeyError):
            yield _of_base(Columns(names[base], base), cell.base(base))
    if truth is not None:
        yield from _of_things(truth, backend.clock, state, names)


def _of_hands(arm: str, truth: GroundTruth, state: WorldState, names: Mapping[str, str]) -> Iterator[Channel]:
    """Yield the channels of the hands of an arm."""
    for hand in sorted(state.objects(arm, HAS_GRIPPER)):
        with suppress(KeyError):
            truth.hand(hand)
            yield from _of_hand(Columns(names[hand], hand), hand, truth)


def _of_things(truth: GroundTruth, clock: Clock, state: WorldState, names: Mapping[str, str]) -> Iterator[Channel]:
    """Yield the channels of tools and movable things."""
    for tool in _known(state, TOOL):
        with suppress(KeyError):
            truth.mean_force_n(tool, 0.0)
            yield _of_tool(Columns(names[tool], tool), tool, truth, clock)
    for thing in _known(state, MANIPULATABLE):
        with suppress(KeyError):
            truth.body_pose(thing)
            yield _of_thing(Columns(names[thing], thing), thing, truth)


class Columns(msgspec.Struct, frozen=True):
    """Makes the signals of a device."""

    name: str
    device: str

    def make(self, origin: Origin, names: Sequence[str], unit: str, frame: str, description: str) -> tuple[Signal, ...]:
        suffix = {"": "", "rad/s": "_rad_s", "m/s": "_m_s", "N m": "_nm", "N/m": "_n_m", "N m/rad": "_nm_rad"}
        ending = suffix.get(unit, f"_{unit.lower()}")
        return tuple(
            Signal(
                column=f"{self.name}/{origin}/{each}{ending}",
                device=self.device,
                origin=origin,
                unit=unit,
                frame=frame,
                description=description,
            )
            for each in names
        )

    def pose(self, origin: Origin, what: str, description: str) -> tuple[Signal, ...]:
        """Return the signals of a pose (7,): position in m and unit quaternion (w, x, y, z), in the world."""
        return (
            *self.make(origin, [f"{what}_{axis}" for axis in XYZ], "m", WORLD, f"position of {description}"),
            *self.make(origin, [f"{what}_q{axis}" for axis in "wxyz"], "", WORLD, f"unit quaternion of {description}"),
        )


def _of_arm(columns: Columns, arm: ArmDriver, feels: bool) -> Iterator[Channel]:
    joints = [f"joint_{number}" for number in range(1, len(arm.measured.q) + 1)]
    yield Channel(columns.make("sensor", joints, "rad", "", "angle of a joint"), lambda: arm.measured.q)
    tool = columns.pose("estimate", "tool", "the tool centre point, from the joints")
    yield Channel(tool, lambda: _pose_row(arm.measured.pose))
    speed = "velocity of the tool centre point, from the joints"
    names = [f"tool_v{axis}" for axis in XYZ], [f"tool_w{axis}" for axis in XYZ]
    twist = columns.make("estimate", names[0], "m/s", WORLD, speed) + columns.make(
        "estimate", names[1], "rad/s", WORLD, "angular " + speed
    )
    yield Channel(twist, lambda: arm.measured.velocity)
    origin: Origin = "sensor" if feels else "estimate"
    how = "by the force-torque sensor" if feels else "estimated from the joints"
    wrench = columns.make(origin, [f"force_{axis}" for axis in XYZ], "N", WORLD, f"force on the tool, {how}")
    wrench += columns.make(origin, [f"torque_{axis}" for axis in XYZ], "N m", WORLD, f"torque on the tool, {how}")
    yield Channel(wrench, lambda: arm.measured.wrench)
    yield Channel(columns.pose("command", "tool", "the reference"), lambda: _pose_row(arm.motion.reference.pose))
    pushed = columns.make("command", [f"force_{axis}" for axis in XYZ], "N", WORLD, COMMANDED_FORCE)
    yield Channel(pushed, lambda: arm.compliance.commanded_force)
    frame = "compliance frame"
    stiff = columns.make("command", [f"stiffness_{axis}" for axis in XYZ], "N/m", frame, "stiffness that is asked for")
    turning = [f"turning_stiffness_{axis}" for axis in XYZ]
    stiff += columns.make("command", turning, "N m/rad", frame, "stiffness that is asked for")
    yield Channel(stiff, lambda: arm.compliance.commanded_stiffness)


def _of_hand(columns: Columns, hand: str, truth: GroundTruth) -> Iterator[Channel]:
    def read() -> Array:
        sample = truth.hand(hand)
        known = (np.nan if each is None else each for each in (sample.finger_force_n, sample.measured_m))
        return np.array([*sample.position, sample.opening_m, *known])

    yield Channel(
        (
            *columns.make("truth", [f"tool_{axis}" for axis in XYZ], "m", WORLD, "position of the tool centre point"),
            *columns.make("truth", ["opening"], "m", "", "distance between the fingers"),
            *columns.make("truth", ["finger_force"], "N", "", "force with which each finger presses"),
            *columns.make("sensor", ["opening"], "m", "", "distance between the fingers that was read last"),
        ),
        read,
    )


def _of_base(columns: Columns, base: MobileBase) -> Channel:
    return Channel(columns.pose("sensor", "base", "the centre of the base"), lambda: _pose_row(base.pose))


def _of_tool(columns: Columns, tool: str, truth: GroundTruth, clock: Clock) -> Channel:
    before = [clock.now]

    def read() -> Array:
        since, before[0] = before[0], clock.now
        return np.array([truth.mean_force_n(tool, since)])

    what = "normal force of the contacts of the working face, mean since the sample before"
    return Channel(columns.make("truth", ["contact_force"], "N", "", what), read)


def _of_thing(columns: Columns, thing: str, truth: GroundTruth) -> Channel:
    return Channel(columns.pose("truth", "body", "the body"), lambda: _pose_row(truth.body_pose(thing)))


def _pose_row(pose: Pose) -> Array:
    return np.concatenate([pose.position, quaternion_from_rotation(pose.rotation)])


def _known(state: WorldState, cls: str) -> list[str]:
    return sorted(state.instances(cls)) if cls in state.vocabulary.classes else []


def name_devices(state: WorldState) -> Mapping[str, str]:
    """Return the name of each individual in columns: its local name, with its prefix if it is not the only one."""
    several = Counter(map(local_name, state.individuals))
    short = state.vocabulary.short
    return {
        each: local_name(each) if several[local_name(each)] == 1 else short(each).replace(":", "_").replace("/", "_")
        for each in state.individuals
    }
