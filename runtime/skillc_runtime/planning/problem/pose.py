"""Poses planning problems: from a library, a version of the world and a goal."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import cached_property

import msgspec

from skillc_model.conditions import Anything, Condition, Exists, Forall, Holds, Individual
from skillc_model.levels import list_level_classes
from skillc_model.pddl.constants import most_specific
from skillc_model.pddl.costs import common_scale
from skillc_model.pddl.domain import Action, ComputedCost, PlanningDomain
from skillc_model.pddl.formulas import FALSE, TRUE, Formula, Typed, conjunction, rename_terms
from skillc_model.pddl.goals import add_goal_predicates, ground_goal
from skillc_model.pddl.names import assign_object_names
from skillc_model.pddl.problem import Problem, action_durations
from skillc_model.pddl.translate import Untranslatable
from skillc_model.skills import SkillLibrary
from skillc_model.traversal import walk
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.cancellation import Cancelled, CancelToken
from skillc_runtime.planning.plan import Excluded, LeftOut, Step, StepWhile
from skillc_runtime.planning.problem.domain_cache import get_planning_domain
from skillc_runtime.planning.problem.excluded_steps import allow_steps, exclude_steps, negate
from skillc_runtime.planning.problem.initial_state import Cost, InitialState
from skillc_runtime.planning.problem.moved_things import describe_moved, track_moves
from skillc_runtime.planning.problem.neighbourhood import AbstractionSize
from skillc_runtime.planning.problem.object_selection import IndividualsByClass, group_by_class, select_objects
from skillc_runtime.planning.problem.relevance import RelevantDomain, keep_relevant_actions
from skillc_runtime.planning.problem.unplannable_skills import select_skills_that_may_matter
from skillc_runtime.planning.search.grounding import Grounding
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState

APPLICABILITY_S = 2.0
"""The time limit for finding out whether actions without a known duration can apply."""


class GoalError(ValueError):
    """A goal that cannot be planned for; the message names the part of it that cannot."""


class PosedProblem(msgspec.Struct, frozen=True, dict=True):
    """A problem, its library (with the classes that the scene defines), and what the problem leaves open or out.

    `undecided` are static conditions that cannot be evaluated for some individuals and count as false for them;
    `untimed` are the costs whose durations have no value, with the reasons. `left_out` lists the individuals,
    skills and steps that are not part of the problem, with reasons; `others` are the individuals among them that may be
    relevant, by type: if there are any, the problem is `narrowed`. An `open_goal` refers to any individual in a
    relation (`_`), of which a narrowed problem knows only those that it keeps.
    """

    problem: Problem
    library: SkillLibrary
    undecided: tuple[str, ...]
    untimed: Mapping[Cost, str] = msgspec.field(default_factory=dict)
    left_out: tuple[LeftOut, ...] = ()
    others: dict[str, tuple[str, ...]] = msgspec.field(default_factory=dict)
    open_goal: bool = False

    @cached_property
    def assumptions(self) -> tuple[str, ...]:
        """Which durations are not known before the plan is executed; finding them takes as long as grounding."""
        estimates = _describe_estimates(self.problem.domain, self.library.vocabulary)
        return (*_describe_unknown_durations(self.untimed, self.problem), *estimates)

    @property
    def narrowed(self) -> bool:
        """Whether a plan, or a cheaper plan, may need an individual that was left out."""
        return bool(self.others)

    @property
    def restricted(self) -> tuple[LeftOut, ...]:
        """The skills and steps that were left out although a plan, or a cheaper plan, may need them."""
        return tuple(each for each in self.left_out if each.kind != "individuals" and not each.harmless)

    @property
    def candidate_count(self) -> int:
        """The number of individuals of the scene that may be relevant."""
        return len(self.problem.objects) + sum(map(len, self.others.values()))


def already_holds(goal: Condition, state: WorldState) -> bool:
    """Whether a goal holds in a version of the world; GoalError if it cannot be decided or names an unknown."""
    _check_known(goal, state)
    try:
        return evaluate(goal, state, {})
    except EvaluationError as reason:
        raise GoalError(f"the goal cannot be decided: {reason}") from reason


def pose_problem(
    library: SkillLibrary,
    state: WorldState,
    goal: Condition,
    without: Sequence[Excluded] = (),
    size: AbstractionSize | None = None,
    *,
    keep_unneeded: bool = False,
) -> PosedProblem:
    """Return the problem of reaching the goal from a version of the world without the steps in `without`.

    Irrelevant skills and individuals are left out, and skills that planners cannot use; with a `size` also individuals
    that are far from those of the goal. Individuals that no helpful step involves are left out, too, unless they are to
    be kept, for an explanation. GoalError if the goal names an unknown individual or cannot be expressed.
    """
    library = with_vocabulary(library, state.vocabulary)
    kinds = group_by_class(state)
    named = _referenced_individuals(goal, state, kinds)
    named |= frozenset().union(*map(state.instances, list_level_classes(state.vocabulary)))
    domain = get_planning_domain(
        library, _class_combinations(kinds, state.vocabulary), lambda iri: _most_specific_classes(iri, state)
    )
    conditional = [each for each in without if isinstance(each, StepWhile) and each.step not in without]
    named = named.union(*(_check_known(each.condition, state) for each in conditional))
    named = named.union(*((*each.unmoved, *each.moved) for each in conditional))
    wanted = _ground_goal(goal, library, domain, named, state)
    conditions = [(each.step, _ground_goal(each.condition, library, domain, named, state)) for each in conditional]
    if any(each.unmoved or each.moved for each in conditional):
        domain, moved = track_moves(domain, state.vocabulary)
        conditions = [
            (step, conjunction((holds, describe_moved(each, moved))))
            for each, (step, holds) in zip(conditional, conditions, strict=True)
        ]
    domain = add_goal_predicates(conjunction((wanted, *(each for _, each in conditions))), library, domain)
    aims = conjunction((wanted, *(negate(each) for _, each in conditions)))
    useful = RelevantDomain(domain, ()) if wanted == TRUE else keep_relevant_actions(domain, aims)
    constants = {each.name: domain.names[each.name] for each in useful.domain.constants}
    closed = None if keep_unneeded or conditional or _has_wildcard(goal) or wanted in (TRUE, FALSE) else wanted
    selection = select_objects(useful.domain, state, kinds, named.union(constants.values()), size, closed)
    types = selection.kept
    if _has_wildcard(goal):
        wanted = _ground_goal(goal, library, domain, named | types.keys(), state)
    names = _name_objects(constants, types, domain, state.vocabulary)
    by_iri = {iri: name for name, iri in names.items()}
    objects = tuple(Typed(name, types[iri]) for name, iri in sorted(names.items()))
    forbidden = [(each, rename_terms(formula, by_iri)) for each, formula in conditions]
    domain = allow_steps(forbidden, exclude_steps(without, useful.domain, by_iri), useful.domain, by_iri)
    domain = replace(domain, constants=objects) if forbidden else domain  # actions name them
    initial = InitialState(domain, state, objects, names)
    problem = Problem(
        name="task",
        domain=domain,
        objects=objects,
        names=names,
        init=tuple(initial.atoms()),
        costs=tuple(initial.costs()),
        goal=rename_terms(wanted, by_iri),
    )
    left_out = (
        *_list_left_out_skills(useful, goal, library),
        *_list_left_out_steps(without, state),
        *selection.left_out,
    )
    problem = msgspec.structs.replace(problem, domain=replace(domain, scale=common_scale(action_durations(problem))))
    return PosedProblem(
        problem, library, tuple(initial.undecided), initial.untimed, left_out, selection.others, _has_wildcard(goal)
    )


def _name_objects(
    constants: Mapping[str, str], types: Mapping[str, str], domain: PlanningDomain, vocabulary: Vocabulary
) -> dict[str, str]:
    """Return the individuals (IRIs) of the problem by name; those that the domain names are its constants."""
    others = types.keys() - set(constants.values())
    taken = domain.names.keys() | {each.name for each in domain.predicates}
    return {**constants, **assign_object_names(others, vocabulary, taken)}


def _describe_unknown_durations(unknown: Mapping[Cost, str], problem: Problem) -> Iterator[str]:
    """Yield why durations have no value, for actions that may apply as far as is known within the time limit."""
    if not unknown:
        return
    actions = {each.name: each for each in problem.domain.actions if isinstance(each.cost, ComputedCost)}
    used = set(unknown)
    with suppress(Cancelled):
        grounding = Grounding(problem, CancelToken(APPLICABILITY_S))
        used &= {_cost_of(actions[words[0]], words[1:]) for words in grounding.applicable if words[0] in actions}
    yield from dict.fromkeys(unknown[each] for each in sorted(used))


def _cost_of(action: Action, names: Sequence[str]) -> Cost:
    assert isinstance(action.cost, ComputedCost)
    bound = {each.name: name for each, name in zip(action.parameters, names, strict=True)}
    return action.cost.function, tuple(bound[each] for each in action.cost.arguments)


def _describe_estimates(domain: PlanningDomain, vocabulary: Vocabulary) -> Iterator[str]:
    for each in domain.costs:
        if each.moving is not None:
            read = vocabulary.short(each.moving)
            yield f"duration of {each.skill}: reads `{read}`, which may change; its value before the plan is taken"


def _list_left_out_skills(useful: RelevantDomain, goal: Condition, library: SkillLibrary) -> Iterator[LeftOut]:
    """Yield the skills that are left out, with the reasons."""
    if useful.unhelpful:
        why = "they change nothing that the goal depends on"
        yield LeftOut(useful.unhelpful, why, harmless=True, kind="skills")
    excluded = useful.domain.excluded
    helpful = (each.skill for each in useful.domain.actions if each.skill is not None)
    matter = select_skills_that_may_matter(excluded, helpful, goal, library) if excluded else frozenset()
    for each in excluded:
        yield LeftOut((each.skill,), each.reason, harmless=each.skill not in matter, kind="skills")


def _list_left_out_steps(steps: Sequence[Excluded], state: WorldState) -> Iterator[LeftOut]:
    short = state.vocabulary.short

    def show(step: Step) -> str:
        return f"{step.skill}({', '.join(map(short, step.arguments.values()))})"

    failed = tuple(show(each) for each in steps if isinstance(each, Step))
    if failed:
        yield LeftOut(failed, "they failed before", harmless=False, kind="steps")
    for each in steps:
        if isinstance(each, StepWhile):
            yield LeftOut((show(each.step),), each.why, harmless=False, kind="steps")


def with_vocabulary(library: SkillLibrary, vocabulary: Vocabulary) -> SkillLibrary:
    """Return the library with the vocabulary of the world, which may define further classes."""
    names = library.names if vocabulary.classes.keys() <= library.vocabulary.classes.keys() else {}
    return msgspec.structs.replace(library, vocabulary=vocabulary, names=names)


def _referenced_individuals(goal: Condition, state: WorldState, kinds: IndividualsByClass) -> frozenset[str]:
    """Return the individuals that a goal refers to, by name, by class or by a relation."""
    named = _check_known(goal, state)
    for each in walk(goal):
        match each:
            case Exists(_, cls, _) | Forall(_, cls, _):
                named |= state.instances(cls)
            case Holds(subject, relation, object_) if Anything() in (subject, object_):
                named |= {individual for pair in state.pairs(relation) for individual in pair}
                named |= set(_sample_individuals(relation, state, kinds))
    return named


def _check_known(goal: Condition, state: WorldState) -> frozenset[str]:
    """Return the individuals that a goal names; GoalError if the world does not have one of them."""
    named = frozenset(each.iri for each in walk(goal) if isinstance(each, Individual))
    unknown = sorted(named - state.individuals)
    if unknown:
        raise GoalError(f"the goal names {state.vocabulary.short(unknown[0])}, which is not in the world model")
    return named


def _sample_individuals(relation: str, state: WorldState, kinds: IndividualsByClass) -> Iterator[str]:
    """Yield one individual of each combination of classes that may be subject or object of a relation."""
    signatures = state.vocabulary.relations[relation].signatures
    classes = {cls for each in signatures for cls in (each.domain, each.range)}
    for individuals in kinds.values():
        first = min(individuals)
        if any(state.is_a(first, cls) for cls in classes):
            yield first


def _has_wildcard(goal: Condition) -> bool:
    """Whether a goal has the wildcard `_` in a relation, which steps may change to other individuals."""
    return any(isinstance(each, Holds) and Anything() in (each.subject, each.object) for each in walk(goal))


def _class_combinations(kinds: IndividualsByClass, vocabulary: Vocabulary) -> frozenset[frozenset[str]]:
    return frozenset(each for each in (most_specific(kind, vocabulary) for kind in kinds) if len(each) > 1)


def _most_specific_classes(individual: str, state: WorldState) -> frozenset[str]:
    return most_specific(state.types(individual), state.vocabulary)


def _ground_goal(
    goal: Condition, library: SkillLibrary, domain: PlanningDomain, named: frozenset[str], state: WorldState
) -> Formula:
    """Return the goal as a formula whose objects are named by their IRIs."""

    def members(cls: str) -> list[str]:
        return sorted(state.instances(cls) & named)

    def holds(condition: Condition) -> bool:
        return evaluate(condition, state, {})

    try:
        objects = {iri: Typed(iri, domain.type_of(_most_specific_classes(iri, state))) for iri in named}
        return ground_goal(goal, library, domain, objects, members, holds)
    except Untranslatable as reason:
        raise GoalError(f"the goal {reason}") from reason
    except EvaluationError as error:
        raise GoalError(f"the goal cannot be decided: {error}") from error
