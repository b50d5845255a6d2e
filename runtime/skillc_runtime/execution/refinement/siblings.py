"""Steps like one that does not go in space: with other things and places of a plan, which fail for the same reason."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice, product

from skillc_model.skills import SkillLibrary
from skillc_runtime.execution.refinement.situation import Situation
from skillc_runtime.planning.plan import Step
from skillc_runtime.planning.validation import PlanError, find_startable_implementations
from skillc_runtime.world.space.frame_tree import FrameError, frame_tree_of
from skillc_runtime.world.space.frames import frame_name, pose, relocation_changes
from skillc_runtime.world.space.whereabouts import holders_of
from skillc_runtime.world.state.changes import AddRelation, Change, RemoveRelation
from skillc_runtime.world.state.model import WorldError
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.terms import CONTAIN, END_EFFECTOR, LOCATION, MANIPULATABLE
from skillc_runtime.world.state.world_state import WorldState

MOST = 24
"""So many steps that are like another one are looked at, at most."""


def list_siblings(
    library: SkillLibrary, before: Situation, step: Step, steps: Sequence[Step]
) -> Iterator[tuple[Step, Situation]]:
    """Yield steps like one that a plan has after some others, each with the situation in which it could begin instead.

    They have other things which the plan gives to the same skill, and other places of the same class. What a hand holds
    is exchanged for the other thing. Left out are those that could not begin, as far as facts say.
    """
    choices = [_list_choices(before.state, step, name, steps) for name in step.arguments]
    for values in islice(product(*choices), 1, MOST + 1):
        sibling = Step(step.skill, dict(zip(step.arguments, values, strict=True)))
        there = _exchange(before, step, sibling)
        if there is not None and _can_start(library, there.state, sibling):
            yield sibling, there


def _list_choices(state: WorldState, step: Step, name: str, steps: Iterable[Step]) -> tuple[str, ...]:
    """Return what may stand for an argument of a step, first what does."""
    own = step.arguments[name]
    if state.is_a(own, LOCATION):
        others = {each for each in state.instances(LOCATION) if state.direct.get(each) == state.direct.get(own)}
    elif state.is_a(own, MANIPULATABLE):
        others = {each.arguments[name] for each in steps if each.skill == step.skill}
    else:
        others = set[str]()
    return (own, *sorted(others - {own}))


def _exchange(before: Situation, step: Step, sibling: Step) -> Situation | None:
    """Return the situation in which a hand holds the thing of another step instead; None if that cannot be."""
    state, changes = before.state, list[Change]()
    try:
        for name, thing in step.arguments.items():
            other = sibling.arguments[name]
            hand = find_hand(state, thing)
            if other != thing and hand is not None:
                if find_hand(state, other) is not None:
                    return None
                places = holders_of(state, other)
                changes += [RemoveRelation(each, CONTAIN, other) for each in places]
                changes += [RemoveRelation(hand, CONTAIN, thing), AddRelation(hand, CONTAIN, other)]
                changes += [AddRelation(each, CONTAIN, thing) for each in places]
                in_hand = frame_tree_of(state).own_pose(thing)
                changes += relocation_changes(state, thing, pose(state, other))
                changes += relocation_changes(state, other, in_hand, frame_name(state, hand))
        return before.with_changes(changes)
    except (FrameError, WorldError):
        return None


def find_hand(state: WorldState, thing: str) -> str | None:
    """Return the gripper that holds a thing, None if none does."""
    return next((each for each in holders_of(state, thing) if state.is_a(each, END_EFFECTOR)), None)


def _can_start(library: SkillLibrary, state: WorldState, step: Step) -> bool:
    try:
        return bool(find_startable_implementations(step, library, state))
    except (PlanError, EvaluationError):
        return False
