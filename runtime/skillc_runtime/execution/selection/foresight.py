"""What is known before anything moves about where things are at each place of a body."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property, reduce
from typing import TypeAlias, TypeVar

from skillc_model.conditions import Condition, Expression, Holds, Individual
from skillc_model.traversal import conjuncts, free_variables
from skillc_runtime.primitives.primitive import Primitive
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import states_own_pose
from skillc_runtime.world.state.changes import AddRelation, SetProperty
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.model import WorldError
from skillc_runtime.world.state.python_calls import FOREIGN_ERRORS, EvaluationError
from skillc_runtime.world.state.terms import AT, BASE_FRAME_ID
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

UNKNOWN_FRAME = "not known before anything moves"
"""The frame of things that have moved: none has this name, so that no pose can be computed from it."""

Found = TypeVar("Found")
Check: TypeAlias = Callable[[], Found]


@dataclass(frozen=True)
class Foresight:
    """What is known of poses at a place of a body.

    `placed` are the robots that have been driven, with the places where they are; `moved` the things whose poses are
    not known any more. `lost` if something ran that may have moved anything.
    """

    start: WorldState = field(compare=False)
    placed: Mapping[str, str] = field(default_factory=dict)
    moved: frozenset[str] = frozenset()
    lost: bool = False

    @cached_property
    def state(self) -> WorldState | None:
        """The world model with what is known; None if that is nothing."""
        if self.lost:
            return None
        unknown = (SetProperty(each, BASE_FRAME_ID, UNKNOWN_FRAME) for each in sorted(self.moved))
        driven = (AddRelation(robot, AT, place) for robot, place in sorted(self.placed.items()))
        try:
            return self.start.with_changes([*unknown, *driven]) if self.moved or self.placed else self.start
        except (WorldError, KeyError):
            return None

    def compute(self, expressions: Mapping[str, Expression], bound: Mapping[str, Value]) -> dict[str, Value]:
        """Return the values of those expressions that can be evaluated with what is known; `bound` are known values."""
        state, found = self.state, dict[str, Value]()
        if state is None:
            return found
        for name, expression in expressions.items():
            if bound.keys() >= free_variables(expression):
                with suppress(EvaluationError):
                    found[name] = value_of(expression, state, bound)
        return found

    def find_problem(self, primitive: type[Primitive], arguments: Mapping[str, Value]) -> str | None:
        """Return why a primitive cannot do here what the known arguments say; None if it may."""
        if self.state is None:
            return None
        try:
            return primitive.find_problem(arguments, self.state)
        except (FrameError, SheetError):
            return None
        except FOREIGN_ERRORS as error:  # user code: whatever it raises, the arguments are not checked
            return f"{primitive.__name__}.find_problem fails: {type(error).__name__}: {error}"

    def after(self, primitive: type[Primitive], arguments: Mapping[str, Value]) -> Foresight:
        """Return what is known after a primitive has run with the known arguments."""
        if primitive.moves is None:
            return Foresight(self.start, lost=True)
        here = self
        for parameter, goal in primitive.moves.items():
            thing, place = arguments.get(parameter), arguments.get(goal or "")
            if not isinstance(thing, str):
                return Foresight(self.start, lost=True)
            here = here.place(thing, place if isinstance(place, str) else None)
        return here

    def place(self, thing: str, place: str | None) -> Foresight:
        """Return what is known once a thing is at a place, or at one that is not known."""
        placed = {each: at for each, at in self.placed.items() if each != thing}
        if place is None or states_own_pose(self.start, thing):
            return replace(self, placed=placed, moved=self.moved | {thing})
        return replace(self, placed={**placed, thing: place}, moved=self.moved - {thing})

    def assume(self, condition: Condition) -> Foresight:
        """Return what is known where a condition holds: it may say where things are."""
        here = self
        for each in conjuncts(condition):
            match each:
                case Holds(subject=Individual(thing), relation=relation, object=Individual(place)) if relation == AT:
                    here = here.place(thing, place)
                case _:
                    pass
        return here

    def either(self, other: Foresight) -> Foresight:
        """Return what is known where either of two may hold."""
        if self == other:
            return self
        both = {robot: place for robot, place in self.placed.items() if other.placed.get(robot) == place}
        unsure = (self.placed.keys() | other.placed.keys()) - both.keys()
        return Foresight(self.start, both, self.moved | other.moved | unsure, self.lost or other.lost)

    def all_of(self, ends: Sequence[Foresight]) -> Foresight:
        """Return what is known after parts that ran side by side and that each began here."""
        placed = {**self.placed, **{robot: place for end in ends for robot, place in end.placed.items()}}
        moved = self.moved.union(*(end.moved for end in ends))
        driven = {robot: place for robot, place in placed.items() if robot not in moved}
        return Foresight(self.start, driven, moved, self.lost or any(end.lost for end in ends))


class ForesightTracker:
    """Follows a body in the order in which it runs; `here` is what is known at the present place.

    A check walks through a part of the body, moves `here` to its end, and returns what it found.
    """

    def __init__(self, state: WorldState) -> None:
        self.here = Foresight(state)

    def lose(self) -> None:
        """Note that anything may have moved."""
        self.here = Foresight(self.here.start, lost=True)

    def optional(self, check: Check[Found], unless: Condition | None = None) -> Found:
        """Run the check of a part that runs or not, or not to its end; if it is skipped, the condition holds."""
        before, found = self.here, check()
        skipped = before if unless is None else before.assume(unless)
        self.here = skipped.either(self.here)
        return found

    def repeated(self, check: Check[Found]) -> Found:
        """Run the check of a part that runs at least once, and may have moved things before it runs again."""
        before, found = self.here, check()
        if self.here == before:
            return found
        self.here = before.either(self.here)
        return check()

    def alternatives(self, checks: Sequence[Check[Found]]) -> list[Found]:
        """Run the checks of one or more parts of which one runs."""
        before, ends, found = self.here, list[Foresight](), list[Found]()
        for check in checks:
            self.here = before
            found.append(check())
            ends.append(self.here)
        self.here = reduce(Foresight.either, ends)
        return found

    def together(self, checks: Sequence[Check[Found]]) -> list[Found]:
        """Run the checks of parts that run side by side: where things are depends on all others."""
        before, ends, found = self.here, list[Foresight](), list[Found]()
        for check in checks:
            self.here = before
            found.append(check())
            ends.append(self.here)
        if any(end != before for end in ends):
            found = []
            for number, check in enumerate(checks):
                self.here = reduce(Foresight.either, (*ends[:number], *ends[number + 1 :]), before)
                found.append(check())
        self.here = Foresight.all_of(before, ends)
        return found
