"""For which worlds a step is known not to go in space: as long as what matters for it stands where it stands."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress

from msgspec.structs import replace

from skillc_model import tree
from skillc_model.conditions import And, Expression, Holds, Individual
from skillc_model.foresight import FORESEEN, RESTS_ON, find_terms_of_skills
from skillc_model.skills import SkillLibrary
from skillc_runtime.collision.scenery import PoseKey, pose_key
from skillc_runtime.execution.refinement.siblings import find_hand
from skillc_runtime.execution.refinement.situation import Situation
from skillc_runtime.execution.refinement.walk import Scope, Walk
from skillc_runtime.planning.plan import Step, StepWhile
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import moves_with, pose
from skillc_runtime.world.state.changes import Change, RemoveRelation, SetProperty
from skillc_runtime.world.state.model import WorldError
from skillc_runtime.world.state.terms import AT, BASE_FRAME_ID, CONTAIN, MANIPULATABLE, MOBILE_ROBOT, ON
from skillc_runtime.world.state.world_state import WorldState

NOWHERE = "nowhere"
"""The frame of things that are thought away: none has this name, so that they have no pose."""

MOST_THINGS = 1000
"""With more things that can be moved it is not asked which of them is in the way."""


def call_of(step: Step, library: SkillLibrary, way: str | None = None) -> tree.Call:
    """Return the call of a step, with one implementation if `way` names it."""
    arguments: dict[str, Expression] = {name: Individual(iri) for name, iri in step.arguments.items()}
    return tree.Call(
        skill=step.skill, implementation=way, arguments=arguments, out=None, source=library.skills[step.skill].source
    )


def find_excluded(library: SkillLibrary, begin: WorldState, before: Situation, step: Step, why: str) -> StepWhile:
    """Return what a plan from a version of the world on may not contain because a step does not go in a situation.

    The step is looked at again without the things that skills can move, and with as few of them as keep it from going:
    while these are there and have not been moved, or not again, it does not go. If it does not go without all of them,
    it does not while the things that it names, and no hand holds, have not been moved, or not again: whatever is known
    of another place. Then it is said why it does not go without them: nothing that can be moved helps.
    """
    placed = _place_movable(before.state, step)
    if 0 < len(placed) <= MOST_THINGS:
        alone = _find_problem(library, before, step, placed)
        if alone is None:
            blocking = sorted(_find_blocking(library, before, step, placed))
            rests = not find_terms_of_skills(library).isdisjoint(FORESEEN)
            there = And(tuple(_where(before.state, each, placed[each], rests) for each in blocking))
            return _limit_to_places(begin, before.state, StepWhile(step, there, why), blocking)
        why = alone or why
    return _limit_to_places(begin, before.state, StepWhile(step, And(()), why), step.arguments.values())


def _limit_to_places(begin: WorldState, now: WorldState, excluded: StepWhile, things: Iterable[str]) -> StepWhile:
    """Return what is excluded as long as things that skills can move, and no hand holds, are where they are now."""
    movable = (each for each in things if now.is_a(each, MANIPULATABLE))
    free = sorted({each for each in movable if find_hand(now, each) is None})
    moved = tuple(each for each in free if _find_place(begin, each) != _find_place(now, each))
    return replace(excluded, unmoved=tuple(each for each in free if each not in moved), moved=moved)


def _find_place(state: WorldState, thing: str) -> PoseKey | None:
    """Return where a thing is, None if that is not known."""
    try:
        return pose_key(pose(state, thing))
    except FrameError:
        return None


def _place_movable(state: WorldState, step: Step) -> dict[str, str]:
    """Return the things that can be moved and are not named by a step, each with the place that it is in or at."""
    named = set(step.arguments.values())
    moving = state.instances(MANIPULATABLE) | state.instances(MOBILE_ROBOT)
    things = [each for each in sorted(moving - named) if not _bears(state, each, named)]
    return {each: at for each in things for at in (*state.subjects(CONTAIN, each), *state.objects(each, AT))}


def _find_blocking(library: SkillLibrary, before: Situation, step: Step, placed: Mapping[str, str]) -> Sequence[str]:
    """Return the things, of some that are placed, that keep a step from going, which goes without them."""
    return find_blocking(
        sorted(placed, reverse=True),
        lambda there: _find_problem(library, before, step, placed.keys() - set(there)) is not None,
    )


def _where(state: WorldState, thing: str, holder: str, rests: bool) -> Holds:
    """Return where a thing is: on what it rests, if planners foresee that with the library, else what contains it.

    Of a robot it is where that is at.
    """
    if state.is_a(thing, MOBILE_ROBOT):
        return Holds(Individual(thing), AT, Individual(holder))
    support = min(state.objects(thing, RESTS_ON), default=None) if rests else None
    if support is not None:
        return Holds(Individual(thing), RESTS_ON, Individual(support))
    return Holds(Individual(holder), CONTAIN, Individual(thing))


def find_blocking(
    things: Sequence[str], blocks: Callable[[Sequence[str]], bool], there: Sequence[str] = (), is_new: bool = False
) -> Sequence[str]:
    """Return as few of some things, which together block, as block with what is `there`; the first ones if several do.

    QuickXplain, U. Junker, AAAI 2004: for k of n things `blocks` is asked about k log2(n) times. `is_new` if it is not
    known whether what is there blocks alone.
    """
    if is_new and blocks(there):
        return ()
    if len(things) == 1:
        return things
    first, second = things[: len(things) // 2], things[len(things) // 2 :]
    of_second = find_blocking(second, blocks, (*there, *first), is_new=True)
    of_first = find_blocking(first, blocks, (*there, *of_second), is_new=bool(of_second))
    return (*of_first, *of_second)


def _bears(state: WorldState, thing: str, named: Iterable[str]) -> bool:
    """Whether something that a step names is placed on a thing, so that it would have no pose without it."""
    for each in named:
        with suppress(FrameError):
            if moves_with(state, each, thing):
                return True
    return False


def _find_problem(library: SkillLibrary, before: Situation, step: Step, away: Iterable[str]) -> str | None:
    """Return why a step does not go in a situation if some things are away, "" if nobody can say; None if it goes."""
    changes: list[Change] = []
    for each in sorted(away):
        supports = before.state.facts[ON].forward.get(each) if ON in before.state.facts else ()
        changes += [RemoveRelation(each, ON, support) for support in sorted(supports or ())]
        changes.append(SetProperty(each, BASE_FRAME_ID, NOWHERE))
    try:
        there = before.with_changes(changes)
    except WorldError:
        return ""
    walk = Walk(library)
    if next(walk.go(call_of(step, library), there, Scope({})), None) is not None:
        return None
    return walk.furthest.message if walk.furthest is not None and walk.furthest.is_in_space else ""
