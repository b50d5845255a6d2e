"""Walks through a body as a run would, and looks for implementations and postures with which all of it goes.

Each part of a body has alternatives, which are tried lazily: where a later part does not go, the next alternative of
the part before it is tried.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import assert_never

from msgspec import structs

from skillc_dsl.descriptions.nodes import DECORATOR_OF
from skillc_dsl.position import Position
from skillc_model import tree
from skillc_model.conditions import Condition
from skillc_model.skills import Compound, Declared, Implementation, Primitive, SkillLibrary
from skillc_runtime.cancellation import check_current
from skillc_runtime.execution.refinement.failure import SpaceFailure
from skillc_runtime.execution.refinement.meetings import Moving, find_meeting
from skillc_runtime.execution.refinement.needs import meet
from skillc_runtime.execution.refinement.placing import list_values
from skillc_runtime.execution.refinement.situation import Situation
from skillc_runtime.execution.selection.binding import BoundImplementation, bind_implementation
from skillc_runtime.execution.selection.python_targets import PrimitiveError, import_primitive
from skillc_runtime.execution.selection.select import ranked_implementations
from skillc_runtime.primitives.space_needs import SpaceNeed, ToolOffsets
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.effects import changes_of
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.grasping.grip_force import GraspError, NoOtherWay
from skillc_runtime.world.space.placing.no_place import PlaceError
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.model import WorldError
from skillc_runtime.world.state.python_calls import FOREIGN_ERRORS, EvaluationError
from skillc_runtime.world.state.values import Value

NEEDS = 400
"""How many needs are looked at before the search ends."""


@dataclass(frozen=True, slots=True)
class Scope:
    """The values by name in a body, and the calls around it, from the outermost on, which begins at `source`."""

    values: Mapping[str, Value]
    within: tuple[str, ...] = ()
    source: Position | None = None


@dataclass(slots=True)
class Walk:
    """A walk through bodies with a library. `unseen` are the calls of which nobody knows what they need of space.

    `stuck_in` is in how many calls the body is in which a call does not go in any posture: no others are tried in it.
    """

    library: SkillLibrary
    left: int = NEEDS
    failures: list[SpaceFailure] = field(default_factory=list)
    unseen: dict[str, None] = field(default_factory=dict)
    stuck_in: int | None = None

    @property
    def furthest(self) -> SpaceFailure | None:
        """The failure before which the most went well, the first of these; None if nothing failed.

        A value that is not known counts first: what would have come after it is not known. That an implementation does
        not fit counts only if as much went well with no other.
        """
        return max(self.failures, key=_rank, default=None)

    def go(self, node: tree.Node, here: Situation, scope: Scope) -> Iterator[Situation]:
        """Yield the situations after a body, the best first; Cancelled as `cancellation.cancelling` says."""
        match node:
            case tree.Sequence(children=children):
                yield from self._in_order(children, here, scope)
            case tree.Parallel(children=children, after=after) if after:
                yield from self._in_order(children, here, scope)
            case tree.Parallel(children=children):
                together = sorted(children, key=lambda child: not self._only_spreads(child, here, scope))
                yield from (replace(end, spreads=here.spreads) for end in self._at_once(together, here, scope))
            case tree.Selector(children=children):
                for child in children:
                    self.stuck_in = None
                    yield from self.go(child, here, scope)
            case tree.Wait() | tree.WaitUntil() | tree.Check() | tree.Fail() | tree.Apply():
                yield here
            case tree.If():
                yield from self._branch(node, here, scope)
            case tree.ForEach():
                yield from self._for_each(node, here, scope)
            case tree.With(call=call, child=child):
                for inside in self.go(call, here, scope):
                    yield from (replace(end, forces=here.forces) for end in self.go(child, inside, scope))
            case tree.Call():
                yield from self._call(node, here, scope)
            case _:
                yield from self._control(node, here, scope)

    def _control(
        self, node: tree.While | tree.OnFailure | tree.Finally | tree.Decorator, here: Situation, scope: Scope
    ) -> Iterator[Situation]:
        """Go on through a node that only controls when its child runs."""
        if isinstance(node, tree.OnFailure):
            yield from self._on_failure(node, here, scope)
            return
        if isinstance(node, tree.Finally):
            for ended in self.go(node.child, here, scope):
                yield from self._in_order((tree.Try(node.last, node.source),), ended, scope)
            return
        if not isinstance(node, tree.While):
            yield from self.go(node.child, here, scope)
            if DECORATOR_OF[tree.kind_of(node)].on_failure != "success":
                return
        elif self._holds(node.condition, here, scope) is not False:
            yield from self.go(node.child, here, scope)
        self.stuck_in = None
        yield here

    def _in_order(self, nodes: Sequence[tree.Node], here: Situation, scope: Scope) -> Iterator[Situation]:
        if not nodes:
            yield here
            return
        for after in self.go(nodes[0], here, scope):
            yield from self._in_order(nodes[1:], after, scope)

    def _at_once(
        self, nodes: Sequence[tree.Node], here: Situation, scope: Scope, done: tuple[Moving, ...] = ()
    ) -> Iterator[Situation]:
        """Go through nodes that run at the same time: none may bring an arm or a base to where another is meanwhile."""
        if not nodes:
            meeting = find_meeting(done)
            if meeting is None:
                yield here
            else:
                one, other = map(here.state.vocabulary.short, meeting)
                why = f"{one} and {other} would come into one place at the same time"
                both_drive = {drive.robot for each in done for drive in each.drives}.issuperset(meeting)
                failure = SpaceFailure("in-the-way", why, in_any_posture=both_drive)
                self._fail(failure, here, replace(scope, within=(*scope.within, "par")))
            return
        for after in self.go(nodes[0], here, scope):
            used = self._find_used(nodes[0], here, scope)
            moving = Moving(after.motions[len(here.motions) :], after.drives[len(here.drives) :], used)
            yield from self._at_once(nodes[1:], after, scope, (*done, moving))

    def _find_used(self, node: tree.Node, here: Situation, scope: Scope) -> frozenset[Value]:
        """Return the individuals that a node uses from its start to its end, as far as they are passed."""
        if not isinstance(node, tree.Call):
            return frozenset()
        passed = (node.arguments[name] for name in self.library.skills[node.skill].uses if name in node.arguments)
        return frozenset(value_of(each, here.state, scope.values) for each in passed)

    def _on_failure(self, node: tree.OnFailure, here: Situation, scope: Scope) -> Iterator[Situation]:
        yield from self.go(node.child, here, scope)
        self.stuck_in = None
        told = dict.fromkeys(tree.name_failure(node.why), "") if node.why is not None else {}
        yield from self.go(node.handler, here, replace(scope, values={**scope.values, **told}))

    def _branch(self, node: tree.If, here: Situation, scope: Scope) -> Iterator[Situation]:
        holds = self._holds(node.condition, here, scope)
        if holds is not False:
            yield from self.go(node.then, here, scope)
        if holds is not True:
            self.stuck_in = None
            yield from (here,) if node.orelse is None else self.go(node.orelse, here, scope)

    def _for_each(self, node: tree.ForEach, here: Situation, scope: Scope) -> Iterator[Situation]:
        try:
            items = value_of(node.items, here.state, scope.values)
        except EvaluationError as why:
            self._fail(_without_value(why), here, scope)
            return
        inside = [{**scope.values, node.variable: each} for each in (items if isinstance(items, tuple) else (items,))]
        yield from self._rounds(node.child, inside, here, scope)

    def _rounds(
        self, child: tree.Node, rounds: list[dict[str, Value]], here: Situation, scope: Scope
    ) -> Iterator[Situation]:
        if not rounds:
            yield here
            return
        for after in self.go(child, here, replace(scope, values=rounds[0])):
            yield from self._rounds(child, rounds[1:], after, scope)

    def _call(self, call: tree.Call, here: Situation, scope: Scope) -> Iterator[Situation]:
        inside = replace(scope, within=(*scope.within, call.skill), source=scope.source or call.source)
        try:
            arguments = {name: value_of(each, here.state, scope.values) for name, each in call.arguments.items()}
        except EvaluationError as why:
            self._fail(_without_value(why), here, inside)
            return
        for implementation in ranked_implementations(self.library, call.skill, call.implementation):
            if self.stuck_in is not None:
                return
            try:
                bound = bind_implementation(implementation, arguments, here.state)
            except EvaluationError as why:
                self._fail(SpaceFailure("nothing-fits", f"{implementation.name}: {why}"), here, inside)
                continue
            if isinstance(bound, BoundImplementation):
                yield from self._run(bound.implementation, bound.bindings, here, inside)
            else:
                self._fail(SpaceFailure("nothing-fits", f"{implementation.name}: {bound.reason}"), here, inside)

    def _run(
        self, implementation: Implementation, values: dict[str, Value], here: Situation, scope: Scope
    ) -> Iterator[Situation]:
        """Yield the situations after an implementation with bound parameters."""
        try:
            for there, known in list_values(implementation.lets, here, values):
                yield from self._run_body(implementation, known, there, scope)
                if self.stuck_in == len(scope.within) or there is not here:
                    self.stuck_in = None  # with another grasp or place it may go
                elif self.stuck_in is not None:
                    return
        except EvaluationError as why:
            self._fail(_without_value(why), here, scope)

    def _run_body(
        self, implementation: Implementation, values: dict[str, Value], here: Situation, scope: Scope
    ) -> Iterator[Situation]:
        match implementation.body:
            case Compound(node=node):
                if len(scope.within) <= len(self.library.skills):  # else a skill that calls itself
                    yield from self.go(node, here, replace(scope, values=values))
            case Primitive(python=python):
                yield from self._primitive(implementation, python, values, here, scope)
            case Declared():  # nobody looks in space at what has no body
                yield here
            case _:
                assert_never(implementation.body)

    def _primitive(
        self, implementation: Implementation, python: str, values: dict[str, Value], here: Situation, scope: Scope
    ) -> Iterator[Situation]:
        needs = self._needs(python, values, here)
        if needs is None:
            self.unseen[" > ".join(scope.within)] = None
            needs = ()
        skill = self.library.skills[implementation.skill]
        effects = [effect for post in (*skill.post, *implementation.post) for effect in post.effects]
        for after in self._meet_all(needs, here, scope):
            try:
                yield after.with_changes(changes_of(effects, after.state, values))
            except (EvaluationError, WorldError):
                yield after

    def _needs(self, python: str, values: dict[str, Value], here: Situation) -> tuple[SpaceNeed, ...] | None:
        try:
            return import_primitive(python).needs_space(values, here.state)
        except (FrameError, SheetError, PrimitiveError):
            return None
        except FOREIGN_ERRORS:  # user code: whatever it raises, nobody knows what it needs
            return None

    def _meet_all(self, needs: Sequence[SpaceNeed], here: Situation, scope: Scope) -> Iterator[Situation]:
        if not needs:
            yield here
            return
        check_current()
        self.left -= 1
        if self.left < 0:
            return
        try:
            for after in meet(needs[0], here):
                if isinstance(after, SpaceFailure):
                    self._fail(after, here, scope)
                else:
                    yield from self._meet_all(needs[1:], after, scope)
                if self.stuck_in is not None:
                    return
        except (FrameError, SheetError, WorldError):
            self.unseen[" > ".join(scope.within)] = None
            yield here

    def _only_spreads(self, node: tree.Node, here: Situation, scope: Scope) -> bool:
        """Whether a part of a body only adds a motion to those of its siblings."""
        if not isinstance(node, tree.Call):
            return False
        for implementation in ranked_implementations(self.library, node.skill, node.implementation):
            if isinstance(implementation.body, Primitive):
                try:
                    values = {name: value_of(each, here.state, scope.values) for name, each in node.arguments.items()}
                except EvaluationError:
                    return False
                needs = self._needs(implementation.body.python, values, here)
                return bool(needs) and all(isinstance(each, ToolOffsets) for each in needs or ())
        return False

    def _holds(self, condition: Condition, here: Situation, scope: Scope) -> bool | None:
        try:
            return evaluate(condition, here.state, scope.values)
        except EvaluationError:
            return None

    def _fail(self, failure: SpaceFailure, here: Situation, scope: Scope) -> None:
        self.failures.append(
            structs.replace(failure, depth=len(here.motions), within=scope.within, source=scope.source)
        )
        if failure.in_any_posture:
            self.stuck_in = len(scope.within) - 1


def _rank(failure: SpaceFailure) -> tuple[bool, int, bool]:
    return failure.cause == "no-value", failure.depth, failure.cause != "nothing-fits"


def _without_value(why: EvaluationError) -> SpaceFailure:
    """Return the failure of a call one of whose values cannot be computed."""
    if isinstance(why, NoOtherWay):
        return SpaceFailure("nothing-fits", str(why))
    unfit = isinstance(why, GraspError | PlaceError)
    return SpaceFailure("no-grasp-or-place" if unfit else "no-value", str(why))
