"""Where everything is at a place of a body: the world model, the posture of each arm, its fingers, what it presses."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from skillc_runtime.collision.arm_assembly import ArmAssembly
from skillc_runtime.collision.arm_parts import ArmParts
from skillc_runtime.collision.swept_space import SweptSpace, sweep_space
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.primitives.planned_postures import PlannedPosture
from skillc_runtime.primitives.standing_bases import leaving_changes
from skillc_runtime.world.state.changes import AddRelation, Change
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of
from skillc_runtime.world.state.labels.labelled import LabelledIri
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import ARM_DEVICE, AT, HAS_GRIPPER
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True, eq=False)
class RefinedMotion:
    """A motion of an arm through postures, each (nv,) in rad; `along` if its tool follows a path.

    start (nv,): rad, where it begins; base: of the arm in the world; assembly: the arm with what it holds meanwhile.
    `tool` is the pose in the world for which the last posture was found, None if it was given.
    """

    arm: str
    start: Array
    postures: tuple[Array, ...]
    base: Pose
    assembly: ArmAssembly
    along: bool
    tool: Pose | None = None

    @property
    def reach_m(self) -> float:
        """From how far away from its base another part may come near to the arm at most, in m."""
        return ArmParts(self.assembly).reach_m

    def sweep(self) -> SweptSpace:
        """Return the space that the arm sweeps."""
        return sweep_space(self.assembly, self.base, (self.start, *self.postures))


@dataclass(frozen=True, slots=True)
class ChosenStand:
    """Where a base was let stand at a place, in its frame: in m, and turned by an angle in rad."""

    robot: LabelledIri
    place: LabelledIri
    x_m: float
    y_m: float
    yaw_rad: float


@dataclass(frozen=True, slots=True, eq=False)
class ChosenPlace:
    """Where a thing was let stand at a place: the pose of the thing, as a tool, in the frame of a support.

    middle (3,): of the thing there, in m; board, stated: as of `PossiblePlace`.
    """

    thing: LabelledIri
    place: LabelledIri
    support: LabelledIri
    at: Pose
    middle: Array
    board: int
    stated: bool


@dataclass(frozen=True, slots=True)
class ChosenWay:
    """A way of a base to a place that is not straight: its corners (x, y) in m in the world, around what it goes."""

    robot: LabelledIri
    place: LabelledIri
    corners: tuple[tuple[float, float], ...]
    around: tuple[LabelledIri, ...]


@dataclass(frozen=True, slots=True)
class BaseDrive:
    """A drive of a base, by IRI: straight through points (x, y) in m in the world, first where it starts.

    radius_m: of the circle around its middle in which it is while it turns; top_m: how high it is there, in the world;
    arms: those that ride on it, by IRI.
    """

    robot: str
    points: tuple[tuple[float, float], ...]
    radius_m: float
    top_m: float
    arms: frozenset[str]


@dataclass(frozen=True, slots=True, eq=False)
class Situation:
    """The world as it is believed to be then, and the devices in it.

    postures: of arms, (nv,) in rad; openings: of grippers, in m; forces: of tools that press, (3,) in N in the world;
    spreads: offsets (n, 3) in m in the world of tools with a motion that is added; motions, stands, places, ways,
    drives: all so far; models: of arms in situations like this one, which share them, by what they depend on.
    planned: postures that are taken near where they bring tools, as a run takes those of its plan; none by default.
    slack_rad: how far beyond its range a joint may be on a line of the tool, rad or m: in a run arms give way so far.
    """

    state: WorldState
    postures: Mapping[str, Array]
    openings: Mapping[str, float]
    forces: Mapping[str, Array] = field(default_factory=dict)
    spreads: Mapping[str, Array] = field(default_factory=dict)
    motions: tuple[RefinedMotion, ...] = ()
    stands: tuple[ChosenStand, ...] = ()
    places: tuple[ChosenPlace, ...] = ()
    ways: tuple[ChosenWay, ...] = ()
    drives: tuple[BaseDrive, ...] = ()
    models: dict[Hashable, Any] = field(default_factory=dict)
    planned: tuple[PlannedPosture, ...] = ()
    slack_rad: float = 0.0

    def with_changes(self, changes: tuple[Change, ...] | list[Change]) -> Situation:
        """Return the situation after changes of the world; WorldError if they contradict it.

        Who is at another place then has left the pose where it stood.
        """
        adding = (each for each in changes if isinstance(each, AddRelation) and each.relation == AT)
        arriving = (each.subject for each in adding if each.object not in self.state.objects(each.subject, AT))
        leaving = [left for each in arriving for left in leaving_changes(self.state, each)]
        return replace(self, state=WorldModel(self.state).commit([*leaving, *changes]).after) if changes else self

    def with_motion(self, motion: RefinedMotion) -> Situation:
        """Return the situation after a motion."""
        postures = {**self.postures, motion.arm: motion.postures[-1]}
        return replace(self, postures=postures, motions=(*self.motions, motion))


def begin_at(state: WorldState, postures: Mapping[str, Sequence[float]]) -> Situation:
    """Return the situation in which arms have postures, each (nv,) in rad, by IRI, their fingers open."""
    home = begin_at_home(state)
    return replace(home, postures={**home.postures, **{arm: np.array(q) for arm, q in postures.items()}})


def begin_at_home(state: WorldState) -> Situation:
    """Return the situation in which all arms that have a data sheet are at home, their fingers open."""
    postures, openings = dict[str, Array](), dict[str, float]()
    for arm in sorted(state.instances(ARM_DEVICE)):
        with suppress(SheetError):
            postures[arm] = sheet_of(state, arm).posture("home")
            for gripper in state.objects(arm, HAS_GRIPPER):
                openings[gripper] = sheet_of(state, gripper).number("maxOpening")
    return Situation(state, postures, openings)
