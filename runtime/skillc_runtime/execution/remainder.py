"""What a run that was interrupted has left to do, from its recorded events."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import cast

from skillc_model import tree
from skillc_model.traversal import find_calls
from skillc_runtime.execution.plans.plan_record import restore_steps
from skillc_runtime.planning.plan import Optimal, Plan, Solved, Step
from skillc_runtime.recording.events import (
    Event,
    ImplementationChosen,
    NodeEnded,
    NodeStarted,
    PlanArrived,
    PlanMade,
    TaskStarted,
)
from skillc_runtime.recording.space_claim import SpaceClaim
from skillc_runtime.world.state.labels.labelled import LabelledIri


@dataclass(frozen=True, slots=True)
class PlanRemainder:
    """The steps of a plan that had begun and not succeeded, and those that had not begun, in the order of the plan.

    `space` is what was known of the plan in space, None if nobody had looked.
    """

    solved: Solved
    begun: tuple[Step, ...]
    waiting: tuple[Step, ...]
    space: SpaceClaim | None = None


@dataclass(frozen=True, slots=True)
class BodyRemainder:
    """The part of a body that has not succeeded: a sequence from its first step that has not, or else all of it.

    None if it needs what a step has computed that has succeeded. `space` is what was known of the body in space, None
    if nobody had looked.
    """

    body: tree.Node | None
    space: SpaceClaim | None = None


def read_remainder(events: Sequence[Event]) -> PlanRemainder | BodyRemainder | None:
    """Return what is left of the last attempt of a run; None if it is to plan for a goal and has not begun a plan."""
    started = events[0]
    assert isinstance(started, TaskStarted), "the first event of a run"
    if started.body is not None:
        looks = [each.space for each in events if isinstance(each, PlanArrived)]
        return BodyRemainder(_find_rest_of_body(started.body, events), looks[-1] if looks else None)
    plans = [number for number, event in enumerate(events) if isinstance(event, PlanMade)]
    return _read_plan(events[plans[-1] :]) if plans else None


def _read_plan(events: Sequence[Event]) -> PlanRemainder:
    """Return what is left of the plan that the first event makes."""
    made = events[0]
    assert isinstance(made, PlanMade)
    steps = restore_steps(made.steps)
    begun, succeeded = Counter[str](), Counter[str]()
    for choice, status in _find_outermost_calls(events):
        name = next((_name(each) for each in steps if _is_call_of(each, choice)), "")
        (succeeded if status == "success" else begun)[name] += 1
    left: dict[bool, list[Step]] = {True: [], False: []}
    for step in steps:
        if succeeded[_name(step)] > 0:
            succeeded[_name(step)] -= 1
        else:
            left[begun[_name(step)] > 0].append(step)
            begun[_name(step)] -= 1
    apart = made.space.apart_pairs if made.space is not None else frozenset[tuple[int, int]]()
    solved = Solved(Plan(steps, made.cost, apart), cast(Optimal, made.optimal), made.planner)
    return PlanRemainder(solved, tuple(left[True]), tuple(left[False]), made.space)


def _find_outermost_calls(events: Sequence[Event]) -> Iterator[tuple[ImplementationChosen, str]]:
    """Yield the last choice of each call that no other call contains, and how it ended; empty if it did not."""
    inside, calls = set[int](), dict[int, tuple[ImplementationChosen, str]]()
    for event in events:
        match event:
            case NodeStarted(node=node, parent=parent) if parent in inside or parent in calls:
                inside.add(node)
            case ImplementationChosen(node=node) if node not in inside:
                calls[node] = (event, "")
            case NodeEnded(node=node, status=status) if node in calls:
                calls[node] = (calls[node][0], status)
            case _:
                pass
    yield from calls.values()


def _is_call_of(step: Step, choice: ImplementationChosen) -> bool:
    """Whether a call runs a step of a plan."""
    bound = {name: value.iri for name, value in choice.bindings.items() if isinstance(value, LabelledIri)}
    return step.skill == choice.skill and step.arguments.items() <= bound.items()


def _name(step: Step) -> str:
    return f"{step.skill} {sorted(step.arguments.items())}"


def _find_rest_of_body(body: tree.Node, events: Sequence[Event]) -> tree.Node | None:
    """Return what of a body has not succeeded in its last attempt; None if that cannot run alone."""
    roots = [number for number, event in enumerate(events) if isinstance(event, NodeStarted) and event.parent == 0]
    if not roots or not isinstance(body, tree.Sequence) or body.reactive:
        return body
    attempt, root = events[roots[-1] :], cast(NodeStarted, events[roots[-1]]).node
    children = {event.node for event in attempt if isinstance(event, NodeStarted) and event.parent == root}
    done = sum(
        isinstance(event, NodeEnded) and event.node in children and event.status == "success" for event in attempt
    )
    if any(call.out for each in body.children[:done] for call in find_calls(each)):
        return None
    return tree.Sequence(children=body.children[done:], reactive=False, source=body.source)
