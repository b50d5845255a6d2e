"""A planning problem from a version of the world and a goal, in one pass over the index."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import msgspec

from skillc_compiler.library.conditions import Anything, Condition, Exists, Forall, Holds, Individual
from skillc_compiler.library.pddl.domain import PlanningDomain
from skillc_compiler.library.pddl.formulas import Formula, Typed
from skillc_compiler.library.pddl.goals import ground_goal, with_predicates_of
from skillc_compiler.library.pddl.names import object_names
from skillc_compiler.library.pddl.planning import planning_domain
from skillc_compiler.library.pddl.problem import Problem
from skillc_compiler.library.pddl.translate import Untranslatable
from skillc_compiler.library.reading import walk
from skillc_compiler.library.skills import SkillLibrary
from skillc_compiler.library.vocabulary import Vocabulary
from skillc_runtime.planning.excluding import excluding
from skillc_runtime.planning.initial import Initial
from skillc_runtime.planning.plan import Step
from skillc_runtime.planning.variables import variables
from skillc_runtime.world.conditions import evaluate
from skillc_runtime.world.expressions import EvaluationError
from skillc_runtime.world.state import WorldState


class GoalError(ValueError):
    """A goal that cannot be planned for; the message says what of it, in the author's words."""


@dataclass(frozen=True, slots=True)
class Posed:
    """A problem with the library it speaks of (the scene's own classes included), and what could not be decided.

    `undecided` are static conditions and durations that have no value for some individuals, which are left out.
    """

    problem: Problem
    library: SkillLibrary
    undecided: tuple[str, ...]


def pose_problem(library: SkillLibrary, state: WorldState, goal: Condition, without: Sequence[Step] = ()) -> Posed:
    """Return the problem of reaching the goal from a version of the world, by other steps than those of `without`.

    Individuals that no action and no goal can speak of are left out. GoalError when the goal names an unknown
    individual or says what a planner cannot reason about.
    """
    library = _in_the_words_of(state.vocabulary, library)
    named = _named(goal, state)
    domain = planning_domain(library, _combined(state))
    types = {iri: domain.type_of(_lowest(state.types(iri), state.vocabulary)) for iri in sorted(state.individuals)}
    types = _relevant(types, domain, named)
    names = object_names(types, state.vocabulary, domain.names.keys() | {each.name for each in domain.predicates})
    objects = tuple(Typed(name, types[iri]) for name, iri in sorted(names.items()))
    by_iri = {iri: name for name, iri in names.items()}
    ground = _ground(goal, library, domain, by_iri, state)
    domain = excluding(without, with_predicates_of(ground, library, domain), by_iri, types)
    initial = Initial(domain, state, objects, names)
    problem = Problem(
        name="task",
        domain=domain,
        objects=objects,
        names=names,
        init=tuple(initial.atoms()),
        costs=tuple(initial.costs()),
        goal=ground,
    )
    return Posed(problem, library, tuple(initial.undecided))


def _in_the_words_of(vocabulary: Vocabulary, library: SkillLibrary) -> SkillLibrary:
    """Return the library with the vocabulary of the world, which may have classes of its own."""
    names = library.names if vocabulary.classes.keys() <= library.vocabulary.classes.keys() else {}
    return msgspec.structs.replace(library, vocabulary=vocabulary, names=names)


def _named(goal: Condition, state: WorldState) -> frozenset[str]:
    """Return the individuals that a goal speaks of, by name, by class or as those that stand in a relation."""
    named = frozenset(each.iri for each in walk(goal) if isinstance(each, Individual))
    unknown = sorted(named - state.individuals)
    if unknown:
        raise GoalError(f"the goal speaks of {state.vocabulary.short(unknown[0])}, which is not in the world model")
    for each in walk(goal):
        match each:
            case Exists(_, cls, _) | Forall(_, cls, _):
                named |= state.instances(cls)
            case Holds(subject, relation, object_) if Anything() in (subject, object_):
                named |= {individual for pair in state.pairs(relation) for individual in pair}
    return named


def _lowest(classes: frozenset[str], vocabulary: Vocabulary) -> frozenset[str]:
    """Return the classes that are above none of the others."""
    return frozenset(
        cls for cls in classes if not any(other != cls and vocabulary.is_a(other, cls) for other in classes)
    )


def _combined(state: WorldState) -> frozenset[frozenset[str]]:
    kinds = {state.types(each) for each in state.individuals}
    lowest = {_lowest(each, state.vocabulary) for each in kinds}
    return frozenset(each for each in lowest if len(each) > 1)


def _relevant(types: dict[str, str], domain: PlanningDomain, named: frozenset[str]) -> dict[str, str]:
    wanted = {each.type for each in variables(domain)}
    fits = {each: any(domain.is_a(each, other) for other in wanted) for each in set(types.values())}
    return {iri: each for iri, each in types.items() if fits[each] or iri in named}


def _ground(
    goal: Condition, library: SkillLibrary, domain: PlanningDomain, by_iri: dict[str, str], state: WorldState
) -> Formula:
    def members(cls: str) -> list[str]:
        return sorted(state.instances(cls) & by_iri.keys())

    def holds(condition: Condition) -> bool:
        return evaluate(condition, state, {})

    try:
        return ground_goal(goal, library, domain, by_iri, members, holds)
    except Untranslatable as reason:
        raise GoalError(f"the goal {reason}") from reason
    except EvaluationError as error:
        raise GoalError(f"the goal cannot be decided: {error}") from error
