"""What moves in a cell at one instant, for displays: samples may be dropped, events never are."""

from __future__ import annotations

from typing import Annotated

import msgspec

from skillc_runtime.devices.control_report import ControlReport

PoseNumbers = tuple[float, float, float, float, float, float, float]
"""A pose in the world: position in m, then the unit quaternion (w, x, y, z)."""


Vector = tuple[float, float, float]


class ArmSample(msgspec.Struct, frozen=True):
    """An arm: joint angles in rad and speeds in rad/s, as measured last, and the poses of base and tool in the world.

    `wrench` is what a force-torque sensor measures on the tool, N and N m, in the arm's base frame; None without one.
    `velocity` is that of the tool as measured, `commanded` that of its reference, in m/s, in the world. The difference
    of the poses of two samples is neither: the tool and its reference may change from one sample to the next.
    `commanded_force` is that on the tool which a push asks for now, in N, in the world; None without a push.
    `reference` is the pose at which the tool is commanded to be, in the world; None if that is not known. `control` is
    the report of the process that controls a real arm; None without one.
    """

    joints: tuple[float, ...]
    speeds: tuple[float, ...]
    base: PoseNumbers
    tool: PoseNumbers
    wrench: tuple[float, float, float, float, float, float] | None = None
    velocity: Vector = (0.0, 0.0, 0.0)
    commanded: Vector = (0.0, 0.0, 0.0)
    commanded_force: Vector | None = None
    reference: PoseNumbers | None = None
    control: ControlReport | None = None


class ForceSample(msgspec.Struct, frozen=True):
    """The true force in N with which what a tool touches presses on its working face, at a point in m, in the world."""

    force: tuple[float, float, float]
    point: tuple[float, float, float]


class Sample(msgspec.Struct, frozen=True):
    """A cell at `time_s` of its clock: its arms, and where things are in the world, both by IRI.

    In a simulation that is where they really are; in a real cell what hands hold is in them, and all else is where the
    world model has it.
    `joints` are the angles in rad and ways in m of what moves otherwise, as fingers and drawers, by the names of the
    cell's model; `forces` the contact forces on tools, by IRI of the tool, where there are any.
    """

    cell: str
    time_s: float
    arms: dict[str, ArmSample]
    things: dict[str, PoseNumbers]
    joints: dict[str, float] = {}
    forces: dict[str, ForceSample] = {}


MAX_HZ = 50.0
"""How many samples a second there are at most."""


class SampleHello(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The first message of a client, as JSON: its token, the cell, and how many samples a second it wants.

    A page has the cookie of a session instead of a token.
    """

    cell: Annotated[str, msgspec.Meta(max_length=200)]
    token: Annotated[str, msgspec.Meta(max_length=200)] | None = None
    rate_hz: Annotated[float, msgspec.Meta(gt=0.0, le=MAX_HZ)] = 10.0
