"""Whether the actions of a planning problem do what the world model does, step by step."""

from __future__ import annotations

from collections.abc import Iterator, Set
from typing import assert_never

from oracle.forced import steps, worked
from skillc_model.conditions import And
from skillc_model.pddl.domain import PropertyMeaning, RelationMeaning
from skillc_model.pddl.formulas import Atom, Conjunction, Disjunction, Equal, Existential, Formula, Negation, Universal
from skillc_model.skills import SkillLibrary
from skillc_runtime.planning.plan import Step
from skillc_runtime.planning.plan_text import read_step
from skillc_runtime.planning.problem.chains import unroll_chains
from skillc_runtime.planning.problem.pose import PosedProblem
from skillc_runtime.planning.search.ground_actions import GroundAction
from skillc_runtime.planning.search.grounding import Grounding
from skillc_runtime.world.state.world_state import WorldState


def disagreements(library: SkillLibrary, state: WorldState) -> Iterator[str]:
    """Yield the steps that work in one of the two only, or after which the two hold different facts."""
    posed = unroll_chains(library, state, And(())).pose(())
    planned = {each.skill for each in posed.problem.domain.actions}
    before = frozenset(posed.problem.init)
    actions = {_key(read_step(posed.problem, each.words)): each for each in Grounding(posed.problem).actions}
    for step in steps(library, state):
        if step.skill in planned:
            action, after = actions.get(_key(step)), worked(step, library, state)
            applies = action is not None and _holds(action.precondition, before)
            if applies != (after is not None):
                yield f"{step} {'works' if after else 'fails'} in the world model only"
            elif action is not None and after is not None:
                yield from (f"after {step}: {each}" for each in _differences(posed, _after(action, before), after))


def _key(step: Step | None) -> tuple[str, tuple[tuple[str, str], ...]]:
    assert step is not None
    return step.skill, tuple(sorted(step.arguments.items()))


def _after(action: GroundAction, before: Set[Atom]) -> Set[Atom]:
    fired = [each for each in action.effects if _holds(each.condition, before)]
    gone = {each.atom for each in fired if not each.positive}
    return (before - gone) | {each.atom for each in fired if each.positive}


def _differences(posed: PosedProblem, atoms: Set[Atom], after: WorldState) -> Iterator[str]:
    """Yield what a condition would read otherwise: a relation that follows, a value of a property."""
    closure, problem = after.vocabulary.closure, posed.problem
    predicates = problem.domain.predicates
    names = {
        iri: each.name
        for each in predicates
        if isinstance(each.meaning, RelationMeaning)
        for iri in [each.meaning.relation]
    }
    for iri in after.vocabulary.relations:
        below = [each for each in closure.canonical_sources[iri] if each.relation in names]
        if iri in closure.chained or len(below) != len(closure.canonical_sources[iri]):
            continue  # no condition on it is planned with, or none is here
        for subject, first in problem.names.items():
            for object_, second in problem.names.items():
                pairs = {False: (subject, object_), True: (object_, subject)}
                said = any(Atom(names[each.relation], pairs[each.flipped]) in atoms for each in below)
                if said != after.holds(first, iri, second):
                    yield f"{first} {iri} {second}"
    for each in predicates:
        if isinstance(each.meaning, PropertyMeaning) and each.changes:
            value = each.meaning.value
            yield from (
                f"{owner}.{each.name}"
                for name, owner in problem.names.items()
                if (Atom(each.name, (name,)) in atoms) != (after.value(owner, each.meaning.property) == value)
            )


def _holds(formula: Formula, atoms: Set[Atom]) -> bool:
    match formula:
        case Atom():
            return formula in atoms
        case Negation(body):
            return not _holds(body, atoms)
        case Conjunction(parts):
            return all(_holds(part, atoms) for part in parts)
        case Disjunction(parts):
            return any(_holds(part, atoms) for part in parts)
        case Equal() | Existential() | Universal():
            raise AssertionError(f"{formula} is not ground")
        case _:
            assert_never(formula)
