"""Grasps and releases objects; that they are between the fingers, or not, is decided by what the fingers measure."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from types import MappingProxyType

from skillc_runtime.devices.cell import Cell
from skillc_runtime.devices.gripper import Gripper
from skillc_runtime.motion.pose import Pose
from skillc_runtime.motion.working_face import working_face
from skillc_runtime.primitives.contradiction import contradict_place
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status
from skillc_runtime.primitives.space_needs import Hold, Leave, SpaceNeed
from skillc_runtime.primitives.support import SupportCheck
from skillc_runtime.primitives.time_limits import finger_limit_s
from skillc_runtime.world.space.cargo import cargo_changes
from skillc_runtime.world.space.frame_tree import FrameError, frame_tree_of
from skillc_runtime.world.space.frames import frame_name, pose, put_down_changes, relocation_changes, size
from skillc_runtime.world.space.grasping.grasp_geometry import is_sideways
from skillc_runtime.world.space.grasping.grasps import width_between
from skillc_runtime.world.space.grasping.grip_force import mass_of
from skillc_runtime.world.space.grasping.hand_shape import RELEASE_CLEARANCES_M, read_hand_shape
from skillc_runtime.world.space.occupants import read_occupants
from skillc_runtime.world.space.placing.chosen_places import end_of_reservation
from skillc_runtime.world.space.whereabouts import holders_of
from skillc_runtime.world.state.changes import AddRelation, RemoveRelation, SetProperty
from skillc_runtime.world.state.data_sheet import SheetError, number_of
from skillc_runtime.world.state.labels.labelled import LabelledIri, LabelledQuantity
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.terms import CONTAIN, END_EFFECTOR, GRASP_WIDTH, HELD_SIDEWAYS, WIDTH_TOLERANCE
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

FREE_CLEARANCE_M = 0.005
"""How much farther than while holding it the fingers must be open for an object to be free."""

BESIDE_FINGERS_M = 0.004
"""How much room both fingers together leave to what is beside them where they let go."""

WIDTH_TOLERANCE_M = 0.004
"""By how much the fingers may be closer or further apart than what they hold is wide, unless that is stated."""


class Grasp(Primitive):
    """Counts the object that keeps the fingers from closing as held by the gripper, if it is as wide as the object.

    The fingers cannot tell one object from another of the same width.

    `at` is where the hand was to close: of a derived grasp the middle of the object, so that the fingers, which meet in
    the middle, have moved it there along the direction in which they close. In other directions its pose in the hand is
    assumed to be as it was believed. While it is held, the world model has its pose relative to the frame of the
    gripper, the tool centre point.
    """

    moves = MappingProxyType({"object": None})
    highlights = (("ends", "object", "grasped"),)

    @classmethod
    def needs_space(cls, arguments: Mapping[str, Value], state: WorldState) -> tuple[SpaceNeed, ...] | None:
        """Return that the gripper holds the object."""
        gripper, thing, at = (arguments.get(each) for each in ("gripper", "object", "at"))
        if not isinstance(gripper, str) or not isinstance(thing, str) or not isinstance(at, Pose):
            return None
        return (Hold(gripper, thing, at),)

    def __init__(self, cell: Cell, *, arm: str, gripper: str, object: str, at: Pose, place: str) -> None:
        super().__init__(cell)
        self._gripper, self._object, self._at = gripper, object, at

    def start(self) -> None:
        """Attach the object; SkillFailure if the fingers are not blocked, not at its width, or it cannot be held."""
        gripper, state = self.cell.gripper(self._gripper), self.cell.world.snapshot()
        hand, thing = (label(each, state.vocabulary) for each in (self._gripper, self._object))
        self._check_fingers(gripper, hand, thing, state)
        self._frame = frame_name(state, self._gripper)
        self._in_hand = self._at.inverse() @ pose(state, self._object)
        self._cargo = cargo_changes(state, self._object)
        try:
            gripper.attach(self._object, self._in_hand, mass_of(state, self._object))
        except RuntimeError as error:
            raise SkillFailure(str(error)) from error

    def tick(self) -> Status:
        """Write that the gripper holds the object, its assumed pose in the hand, and that its load moves with it."""
        self.cell.world.commit([AddRelation(self._gripper, CONTAIN, self._object)], "Grasp", "sensed")
        state = self.cell.world.snapshot()
        held = [*self._cargo, *relocation_changes(state, self._object, self._in_hand, self._frame)]
        sideways = is_sideways(self._at)
        if sideways != (state.value(self._object, HELD_SIDEWAYS) is True):
            held.append(SetProperty(self._object, HELD_SIDEWAYS, sideways))
        self.cell.world.commit(held, "Grasp", "assumed")
        return Status.SUCCESS

    def _check_fingers(self, gripper: Gripper, hand: LabelledIri, thing: LabelledIri, state: WorldState) -> None:
        """SkillFailure if the fingers have closed on nothing, or stand where the object's width does not put them."""
        opening = gripper.opening_m
        if not gripper.blocked:
            raise self._withdraw_place(
                SkillFailure(
                    "{gripper} does not hold {object}: nothing keeps its fingers from closing, they stand "
                    "{opening:.0f mm} open",
                    gripper=hand,
                    object=thing,
                    opening=LabelledQuantity(opening, "m"),
                )
            )
        width = width_between(state, self._gripper, self._object, self._at)
        tolerance = number_of(state, self._object, WIDTH_TOLERANCE, default=WIDTH_TOLERANCE_M)
        if width is not None and abs(opening - width) > tolerance + gripper.opening_error_m:
            raise self._withdraw_place(
                SkillFailure(
                    "{gripper} holds something else than {object}, or holds it elsewhere: its fingers stand "
                    "{opening:.1f mm} open, {object} is {width:.1f mm} wide",
                    gripper=hand,
                    object=thing,
                    opening=LabelledQuantity(opening, "m"),
                    width=LabelledQuantity(width, "m"),
                )
            )

    def _withdraw_place(self, failure: SkillFailure) -> SkillFailure:
        """Withdraw where the object is, unless another hand holds it, whose fingers feel it; return the failure."""
        world = self.cell.world
        state = world.snapshot()
        if any(state.is_a(each, END_EFFECTOR) for each in holders_of(state, self._object)):
            return failure
        return contradict_place(world, "Grasp", self._object, failure)


class Release(Primitive):
    """Lowers the object until something is felt to carry it, and opens the fingers; fails before that if nothing does.

    As soon as the object is free, the world model has the pose to which the arm brought it.
    """

    moves = MappingProxyType({"object": None})
    highlights = (("ends", "object", "released"),)

    @classmethod
    def needs_space(cls, arguments: Mapping[str, Value], state: WorldState) -> tuple[SpaceNeed, ...] | None:
        """Return that the object is left at the place."""
        arm, gripper, thing, to = (arguments.get(each) for each in ("arm", "gripper", "object", "to"))
        if not isinstance(arm, str) or not isinstance(gripper, str):
            return None
        return (Leave(arm, gripper, thing, to),) if isinstance(thing, str) and isinstance(to, str) else None

    def __init__(self, cell: Cell, *, arm: str, gripper: str, object: str, to: str) -> None:
        super().__init__(cell)
        self._arm, self._gripper = cell.arm(arm), cell.gripper(gripper)
        self._hand, self._object, self._to = gripper, object, to
        self._support = SupportCheck(cell, arm, object, to)
        self._free_at_m = self._width_m = self._limit_s = self._ends = 0.0
        self._face, self._carried, self._freed = Pose.of((0.0, 0.0, 0.0)), False, False

    def start(self) -> None:
        """Start to feel what carries the object; SkillFailure if another object or none is held."""
        state = self.cell.world.snapshot()
        held, short = self._gripper.holding, state.vocabulary.short
        if held != self._object:
            raise SkillFailure(f"the gripper holds {short(held) if held else 'nothing'}, not {short(self._object)}")
        self._face = working_face(size(state, self._object))
        self._free_at_m = self._gripper.opening_m + FREE_CLEARANCE_M
        width = state.value(self._object, GRASP_WIDTH)
        self._width_m = width if isinstance(width, float) else self._gripper.opening_m
        self._limit_s = finger_limit_s(state, self._hand, self._gripper.max_opening_m)
        self._support.start()

    def tick(self) -> Status:
        """Open once the object is carried, and detach it once it is free; return SUCCESS when the fingers are open.

        SkillFailure if nothing carries it, if they do not come to rest, or if the object is not free then.
        """
        if not self._carried:
            self._carried = self._support.is_carried()
            if self._carried:
                self._support.end()
                self._move()
            return Status.RUNNING
        if not self._freed and self._gripper.opening_m >= self._free_at_m:
            self._detach()
        if self._gripper.moving and self.cell.now <= self._ends:
            return Status.RUNNING
        if self._gripper.moving:
            raise SkillFailure(
                "the fingers of {gripper} have not come to rest within {limit:.1f}: they are {opening:.0f mm} open",
                gripper=label(self._hand, self.cell.world.snapshot().vocabulary),
                limit=LabelledQuantity(self._limit_s, "s"),
                opening=LabelledQuantity(self._gripper.opening_m, "m"),
            )
        if not self._freed:
            words = self.cell.world.snapshot().vocabulary
            raise SkillFailure(
                "the fingers of {gripper} came to rest {opening:.0f mm} open: {object} is not free",
                gripper=label(self._hand, words),
                opening=LabelledQuantity(self._gripper.opening_m, "m"),
                object=label(self._object, words),
            )
        return Status.SUCCESS

    def halt(self, reason: str) -> None:
        """Stop arm and fingers."""
        self._support.end()
        self._gripper.stop()

    def _move(self) -> None:
        self._ends = self.cell.now + self._limit_s
        self._gripper.move(self._find_opening_m(), self._gripper.max_force_n)

    def _find_opening_m(self) -> float:
        """Return how far in m the fingers open: less where what is known to be around leaves no room for more."""
        state, most_m = self.cell.world.snapshot(), self._gripper.max_opening_m
        openings = [min(self._width_m + each, most_m) for each in RELEASE_CLEARANCES_M]
        with suppress(SheetError, FrameError):
            at = self._arm.measured.pose @ self._face.inverse() @ frame_tree_of(state).own_pose(self._object).inverse()
            hand, others = read_hand_shape(state, self._hand), read_occupants(state)
            around = [each for each in others if each.individual != self._object]
            free = (each for each in openings if hand.find_in_the_way(at, each + BESIDE_FINGERS_M, 0.0, around) is None)
            return next(free, openings[-1])
        return openings[0]

    def _detach(self) -> None:
        """Detach the object and write it to the world model.

        That the hand is empty is sensed by the fingers. That the object stays where the arm brought it is assumed.
        """
        left_at = self._arm.measured.pose @ self._face.inverse()
        self._gripper.detach()
        self._freed = True
        world = self.cell.world
        world.commit([RemoveRelation(self._hand, CONTAIN, self._object)], "Release", "sensed")
        state = world.snapshot()
        world.commit(
            (
                *put_down_changes(state, self._object, left_at, self._to),
                AddRelation(self._to, CONTAIN, self._object),
                *end_of_reservation(state, self._object, self._to),
            ),
            "Release",
            "assumed",
        )
