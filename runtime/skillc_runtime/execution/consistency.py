"""Checks recorded events against the library that they name: whether each is possible after those before it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias, assert_never

from skillc_model.skills import Implementation, Post, Requirement, SkillLibrary
from skillc_model.traversal import free_variables
from skillc_runtime.execution.attempt import TICK_S
from skillc_runtime.execution.task_state import ALLOWED, ALLOWED_AFTER_FAILURE, ANSWER, TRANSITIONS
from skillc_runtime.recording import events
from skillc_runtime.recording.commands import Abort
from skillc_runtime.recording.events import Event
from skillc_runtime.recording.states import ENDS, State
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.labels.labelled_reading import change_of, value_of_labelled
from skillc_runtime.world.state.python_calls import FOREIGN_ERRORS
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

_Following: TypeAlias = (
    events.StateChanged
    | events.Requested
    | events.Disturbed
    | events.PlanArrived
    | events.PlanMade
    | events.Replanned
    | events.NodeStarted
    | events.NodeEnded
    | events.ImplementationChosen
    | events.WorldChanged
    | events.Note
    | events.PromptsChanged
    | events.Paused
    | events.Resumed
    | events.TaskEnded
)


@dataclass(frozen=True, slots=True)
class Inconsistency:
    """The event with this number, from 1, cannot follow those before it, and why; one after the last is missing."""

    number: int
    why: str

    def __str__(self) -> str:
        return f"event {self.number} cannot be: {self.why}"


def check_events(recorded: Sequence[Event], library: SkillLibrary, start: WorldState) -> Inconsistency | None:
    """Return the first event of a run that is not possible after those before it; None if all are.

    Checked are the order of states, requests and nodes, names and parameters of calls, and the conditions of skills in
    the world, which is `start` before the first event: pres and holds when a call starts, holds while it runs, posts
    when it succeeds. A run without end is possible.
    """
    checker = _Checker(library, start)
    for number, event in enumerate(recorded, 1):
        why = checker.check(event)
        if why is not None:
            return Inconsistency(number, why)
    return None


@dataclass(slots=True)
class _RunningNode:
    """A node that has started; of a call, what it chose, its parameters, and since when a hold is violated."""

    start: events.NodeStarted
    implementation: Implementation | None = None
    frame: Mapping[str, Value] | None = None
    violated: tuple[float, Requirement] | None = None


class _Checker:
    """Follows the events of a run; `check` returns why the next one is impossible."""

    def __init__(self, library: SkillLibrary, start: WorldState) -> None:
        self._library, self._world, self._before = library, start, start
        self._time = 0.0
        self._state: State | None = None
        self._nodes: dict[int, _RunningNode] = {}
        self._asked = False

    def check(self, event: Event) -> str | None:
        """Take the next event; return why it cannot follow, or None."""
        if self._state is None:
            return self._begin(event)
        if self._state in ENDS:
            return "the task has ended"
        if event.time < self._time:
            return f"it was at {event.time:g} s, before the event that precedes it, at {self._time:g} s"
        if event.time > self._time:
            self._before, self._time = self._world, event.time
        return "the task has started" if isinstance(event, events.TaskStarted) else self._follow(event)

    def _follow(self, event: _Following) -> str | None:
        match event:
            case events.StateChanged(state=state):
                return f"a run that is {state} has the end of its task" if state in ENDS else self._enter(state)
            case events.TaskEnded(status=state):
                return self._enter(state) or self._find_running()
            case events.Requested():
                return self._check_request(event)
            case events.NodeStarted():
                return self._start(event)
            case events.NodeEnded():
                return self._end(event)
            case events.ImplementationChosen():
                return self._choose(event)
            case events.WorldChanged():
                return self._change(event)
            case events.PlanArrived() | events.PlanMade() | events.Replanned():
                return self._check_plan(event)
            case events.PromptsChanged(prompts=prompts):
                self._asked = bool(prompts)
                return None
            case events.Disturbed() | events.Paused() | events.Resumed() | events.Note():
                return None
            case _:
                assert_never(event)

    def _begin(self, event: Event) -> str | None:
        if not isinstance(event, events.TaskStarted):
            return "a run begins with the start of a task"
        if event.hash != self._library.hash:
            return f"the run used the library {event.library} {event.hash[:12]}, not {self._library.hash[:12]}"
        self._state, self._time = "queued", event.time
        return None

    def _enter(self, state: State) -> str | None:
        assert self._state is not None, "the run has begun"
        before, self._state = self._state, state
        if state in (before, "interrupted") or state in TRANSITIONS[before]:
            return None
        return f"a run that is {before} does not become {state}"

    def _find_running(self) -> str | None:
        """Return which node still runs at the end; those of a run that was interrupted need no end."""
        if self._state == "interrupted" or not self._nodes:
            return None
        node = next(iter(self._nodes.values()))
        return f"{_describe(node.start)} still runs"

    def _check_request(self, event: events.Requested) -> str | None:
        assert self._state is not None, "the run has begun"
        name, allowed = event.command.name, (*ALLOWED[self._state], *ALLOWED_AFTER_FAILURE)
        if isinstance(event.command, Abort) or event.refused:
            return None
        if name == ANSWER:
            return None if self._asked else "nothing is asked"
        if name not in (allowed if self._state == "paused" else ALLOWED[self._state]):
            return f"a run that is {self._state} allows no {name}"
        return None

    def _check_plan(self, event: events.PlanArrived | events.PlanMade | events.Replanned) -> str | None:
        if isinstance(event, events.PlanMade):
            unknown = [each.skill for each in event.steps if each.skill not in self._library.skills]
            return f"the library has no skill {unknown[0]}" if unknown else None
        if isinstance(event, events.PlanArrived) and self._state != "planning":
            return f"no plan is awaited by a run that is {self._state}"
        return self._find_running() if isinstance(event, events.Replanned) else None

    def _start(self, event: events.NodeStarted) -> str | None:
        if event.node in self._nodes:
            return f"{_describe(event)} runs already"
        if event.parent and event.parent not in self._nodes:
            return f"{_describe(event)} starts inside node {event.parent}, which does not run"
        if event.kind == "call" and _skill_of(event) not in self._library.skills:
            return f"the library has no skill {event.name}"
        self._nodes[event.node] = _RunningNode(event)
        return None

    def _choose(self, event: events.ImplementationChosen) -> str | None:
        node = self._nodes.get(event.node)
        if node is None or node.start.kind != "call" or _skill_of(node.start) != event.skill:
            return f"no call of {event.skill} with the number {event.node} runs"
        implementation = self._library.implementations.get(f"{event.skill}.{event.implementation}")
        if implementation is None:
            return f"{event.skill} has no implementation {event.implementation}"
        names = {each.name for each in implementation.parameters}
        if unknown := [name for name in event.bindings if name not in names]:
            return f"{event.skill}[{event.implementation}] has no parameter {unknown[0]}"
        node.implementation, node.violated = implementation, None
        node.frame = {name: value_of_labelled(value) for name, value in event.bindings.items()}
        return self._find_false(node, (*implementation.pre, *implementation.hold), "when it starts")

    def _end(self, event: events.NodeEnded) -> str | None:
        node = self._nodes.pop(event.node, None)
        if node is None:
            return f"{event.name} (node {event.node}) does not run"
        if inside := [each for each in self._nodes.values() if each.start.parent == event.node]:
            return f"{_describe(inside[0].start)} still runs inside {event.name}"
        if event.status != "success" or node.implementation is None:
            return None
        if node.violated is not None and event.time > node.violated[0] + 2.5 * TICK_S:
            since, hold = node.violated
            return f"{event.name} succeeds, and its hold `{hold.text}` ({hold.source}) is false since {since:.2f} s"
        return self._find_false(node, node.implementation.post, "when it succeeds")

    def _change(self, event: events.WorldChanged) -> str | None:
        try:
            self._world = self._world.with_changes([change_of(each) for each in event.changes])
        except (ValueError, KeyError) as error:
            return f"the change by {event.origin} is impossible: {error}"
        for node in self._nodes.values():
            holds = node.implementation.hold if node.implementation is not None else ()
            false = next((hold for hold in holds if self._is_false(node, hold, (self._world,))), None)
            node.violated = None if false is None else node.violated or (event.time, false)
        return None

    def _find_false(self, node: _RunningNode, conditions: Iterable[Requirement | Post], when: str) -> str | None:
        """Return which condition of a call is false, before and after what was written in this tick."""
        for condition in conditions:
            try:
                if self._is_false(node, condition, (self._world, self._before)):
                    return f"`{condition.text}` ({condition.source}) of {node.start.name} is false {when}"
            except FOREIGN_ERRORS as error:
                return f"`{condition.text}` ({condition.source}) cannot be evaluated: {error}"
        return None

    def _is_false(self, node: _RunningNode, condition: Requirement | Post, worlds: tuple[WorldState, ...]) -> bool:
        """Whether a condition is false in all these worlds; one about what is not recorded, an output, is not."""
        frame = node.frame or {}
        if not free_variables(condition.condition) <= frame.keys():
            return False
        return not any(evaluate(condition.condition, world, frame) for world in worlds)


def _skill_of(start: events.NodeStarted) -> str:
    """Return the skill of a call; one that starts again has the implementation that it chose before in its name."""
    return start.name.partition("[")[0]


def _describe(start: events.NodeStarted) -> str:
    return f"{start.kind} {start.name} ({start.source})" if start.name else f"{start.kind} ({start.source})"
