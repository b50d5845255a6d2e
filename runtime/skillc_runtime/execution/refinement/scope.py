"""For which worlds a step is known not to go in space: those in which what is in its way stands where it stands."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress

from skillc_model import tree
from skillc_model.conditions import And, Expression, Holds, Individual
from skillc_model.skills import SkillLibrary
from skillc_runtime.execution.refinement.situation import Situation
from skillc_runtime.execution.refinement.walk import Scope, Walk
from skillc_runtime.planning.plan import Excluded, Step, StepWhile
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import moves_with
from skillc_runtime.world.state.changes import Change, RemoveRelation, SetProperty
from skillc_runtime.world.state.model import WorldError
from skillc_runtime.world.state.terms import BASE_FRAME_ID, CONTAIN, MANIPULATABLE, ON
from skillc_runtime.world.state.world_state import WorldState

NOWHERE = "nowhere"
"""The frame of things that are thought away: none has this name, so that they have no pose."""

MOST_THINGS = 30
"""With more things that can be moved it is not asked which of them is in the way."""


def call_of(step: Step, library: SkillLibrary) -> tree.Call:
    """Return the call of a step."""
    arguments: dict[str, Expression] = {name: Individual(iri) for name, iri in step.arguments.items()}
    return tree.Call(
        skill=step.skill, implementation=None, arguments=arguments, out=None, source=library.skills[step.skill].source
    )


def find_excluded(library: SkillLibrary, before: Situation, step: Step, why: str) -> Excluded:
    """Return what a plan may not contain because a step does not go in a situation.

    The step is looked at again without the things that skills can move, and with as few of them as keep it from going:
    while these are where they are, it does not go. If it does not go without all of them, it is excluded for good.
    """
    state = before.state
    named = set(step.arguments.values())
    things = [each for each in sorted(state.instances(MANIPULATABLE) - named) if not _bears(state, each, named)]
    placed = {each: holder for each in things for holder in state.subjects(CONTAIN, each)}
    if not placed or len(placed) > MOST_THINGS or not _goes(library, before, step, placed):
        return step
    blocking = dict(placed)
    for each in placed:
        fewer = {thing: holder for thing, holder in blocking.items() if thing != each}
        if not _goes(library, before, step, placed.keys() - fewer.keys()):
            blocking = fewer
    facts = tuple(Holds(Individual(holder), CONTAIN, Individual(thing)) for thing, holder in blocking.items())
    return StepWhile(step, And(facts), why)


def _bears(state: WorldState, thing: str, named: Iterable[str]) -> bool:
    """Whether something that a step names is placed on a thing, so that it would have no pose without it."""
    for each in named:
        with suppress(FrameError):
            if moves_with(state, each, thing):
                return True
    return False


def _goes(library: SkillLibrary, before: Situation, step: Step, away: Iterable[str]) -> bool:
    """Whether a step goes in a situation if some things are away."""
    changes: list[Change] = []
    for each in sorted(away):
        supports = before.state.facts[ON].forward.get(each) if ON in before.state.facts else ()
        changes += [RemoveRelation(each, ON, support) for support in sorted(supports or ())]
        changes.append(SetProperty(each, BASE_FRAME_ID, NOWHERE))
    try:
        there = before.with_changes(changes)
    except WorldError:
        return False
    return next(Walk(library).go(call_of(step, library), there, Scope({})), None) is not None
