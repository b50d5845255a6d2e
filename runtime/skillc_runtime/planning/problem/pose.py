"""A planning problem from a version of the world and a goal, in one pass over the index."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace

import msgspec

from skillc_model.conditions import Anything, Condition, Exists, Forall, Holds, Individual
from skillc_model.pddl.constants import lowest
from skillc_model.pddl.costs import common_scale
from skillc_model.pddl.domain import Action, ComputedCost, PlanningDomain
from skillc_model.pddl.formulas import TRUE, Formula, Typed, renamed
from skillc_model.pddl.goals import ground_goal, with_predicates_of
from skillc_model.pddl.names import object_names
from skillc_model.pddl.problem import Problem, durations
from skillc_model.pddl.translate import Untranslatable
from skillc_model.reading import walk
from skillc_model.skills import SkillLibrary
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.planning.plan import LeftOut, Step
from skillc_runtime.planning.problem.domain_cache import get_planning_domain
from skillc_runtime.planning.problem.excluded_steps import exclude_steps
from skillc_runtime.planning.problem.initial_state import InitialState
from skillc_runtime.planning.problem.neighbourhood import AbstractionSize
from skillc_runtime.planning.problem.object_selection import Kinds, group_by_class, select_objects
from skillc_runtime.planning.problem.relevance import RelevantDomain, keep_relevant_actions
from skillc_runtime.planning.problem.unplannable_skills import select_skills_that_may_matter
from skillc_runtime.planning.search.grounding import Grounding, GroundingTimeout
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState

LONGEST_S = 2.0
"""Finding out whether an action without a known duration may ever apply takes no longer than this."""


class GoalError(ValueError):
    """A goal that cannot be planned for; the message says what of it, in the author's words."""


@dataclass(frozen=True, slots=True)
class Posed:
    """A problem with the library it speaks of (the scene's own classes included), and what could not be decided.

    `undecided` are static conditions that have no value for some individuals, which are left out; `assumptions` say
    which durations are not known before the plan is executed.
    `left_out` lists what the scene and the library have beyond the problem, with reasons; `others` are those
    individuals of it that might make a difference, by their types: where there are any, the problem is `narrowed`.
    An `open_goal` speaks of whoever stands in a relation, of which a narrowed problem knows only those that it keeps.
    """

    problem: Problem
    library: SkillLibrary
    undecided: tuple[str, ...]
    assumptions: tuple[str, ...] = ()
    left_out: tuple[LeftOut, ...] = ()
    others: dict[str, tuple[str, ...]] = field(default_factory=dict)
    open_goal: bool = False

    @property
    def narrowed(self) -> bool:
        """Whether a cheaper plan or any plan at all may need an individual that was left out."""
        return bool(self.others)

    @property
    def restricted(self) -> tuple[LeftOut, ...]:
        """The skills and steps that were left out and that a cheaper plan or any plan at all may need."""
        return tuple(each for each in self.left_out if each.kind != "individuals" and not each.harmless)

    @property
    def things(self) -> int:
        """How many individuals of the scene might make a difference."""
        return len(self.problem.objects) + sum(map(len, self.others.values()))


def already_holds(goal: Condition, state: WorldState) -> bool:
    """Whether a goal holds in a version of the world; GoalError when it cannot be decided or names an unknown."""
    _refuse_unknown(goal, state)
    try:
        return evaluate(goal, state, {})
    except EvaluationError as reason:
        raise GoalError(f"the goal cannot be decided: {reason}") from reason


def pose_problem(
    library: SkillLibrary,
    state: WorldState,
    goal: Condition,
    without: Sequence[Step] = (),
    breadth: AbstractionSize | None = None,
) -> Posed:
    """Return the problem of reaching the goal from a version of the world, by other steps than those of `without`.

    Skills and individuals are left out that can make no difference; with a `breadth` also individuals that are far from
    what the goal speaks of. Skills that cannot be planned with are left out too. GoalError when the goal names an
    unknown individual or says what a planner cannot reason about.
    """
    library = _in_the_words_of(state.vocabulary, library)
    kinds = group_by_class(state)
    named = _named(goal, state, kinds)
    domain = get_planning_domain(library, _combined(kinds, state.vocabulary), lambda iri: _lowest(iri, state))
    wanted = _ground(goal, library, domain, named, state)
    domain = with_predicates_of(wanted, library, domain)
    useful = RelevantDomain(domain, ()) if wanted == TRUE else keep_relevant_actions(domain, wanted)
    constants = {each.name: domain.names[each.name] for each in useful.domain.constants}
    selection = select_objects(useful.domain, state, kinds, named.union(constants.values()), breadth)
    types = selection.kept
    if _is_open(goal):
        wanted = _ground(goal, library, domain, named | types.keys(), state)
    others = types.keys() - set(constants.values())
    taken = domain.names.keys() | {each.name for each in domain.predicates}
    names = {**constants, **object_names(others, state.vocabulary, taken)}
    by_iri = {iri: name for name, iri in names.items()}
    objects = tuple(Typed(name, types[iri]) for name, iri in sorted(names.items()))
    domain = exclude_steps(without, useful.domain, by_iri, types)
    initial = InitialState(domain, state, objects, names)
    problem = Problem(
        name="task",
        domain=domain,
        objects=objects,
        names=names,
        init=tuple(initial.atoms()),
        costs=tuple(initial.costs()),
        goal=renamed(wanted, by_iri),
    )
    left_out = (*_skills_left_out(useful, goal, library), *_steps_left_out(without, state), *selection.left_out)
    problem = replace(problem, domain=replace(domain, scale=common_scale(durations(problem))))
    assumptions = (*_untimed(initial, problem), *_estimates(domain, state.vocabulary))
    return Posed(problem, library, tuple(initial.undecided), assumptions, left_out, selection.others, _is_open(goal))


def _untimed(initial: InitialState, problem: Problem) -> Iterator[str]:
    """Yield why durations of actions have no value, if those may ever apply as far as can be found out soon."""
    unknown = initial.untimed
    if not unknown:
        return
    actions = {each.name: each for each in problem.domain.actions if isinstance(each.cost, ComputedCost)}
    used = set(unknown)
    with suppress(GroundingTimeout):
        grounding = Grounding(problem, time.monotonic() + LONGEST_S)
        used &= {
            _cost_of(actions[each.words[0]], each.words[1:]) for each in grounding.actions if each.words[0] in actions
        }
    yield from dict.fromkeys(unknown[each] for each in sorted(used))


def _cost_of(action: Action, names: Sequence[str]) -> tuple[str, tuple[str, ...]]:
    assert isinstance(action.cost, ComputedCost)
    bound = {each.name: name for each, name in zip(action.parameters, names, strict=True)}
    return action.cost.function, tuple(bound[each] for each in action.cost.arguments)


def _estimates(domain: PlanningDomain, vocabulary: Vocabulary) -> Iterator[str]:
    for each in domain.costs:
        if each.moving is not None:
            read = vocabulary.short(each.moving)
            yield f"duration of {each.skill}: reads `{read}`, which may change; its value before the plan is taken"


def _skills_left_out(useful: RelevantDomain, goal: Condition, library: SkillLibrary) -> Iterator[LeftOut]:
    """Yield the skills that are not planned with, which authors did not want kept out."""
    if useful.unhelpful:
        why = "nothing that the goal depends on is changed by them"
        yield LeftOut(useful.unhelpful, why, harmless=True, kind="skills")
    excluded = useful.domain.excluded
    helpful = (each.skill for each in useful.domain.actions if each.skill is not None)
    matter = select_skills_that_may_matter(excluded, helpful, goal, library) if excluded else frozenset()
    for each in excluded:
        yield LeftOut((each.skill,), each.reason, harmless=each.skill not in matter, kind="skills")


def _steps_left_out(steps: Sequence[Step], state: WorldState) -> Iterator[LeftOut]:
    if steps:
        short = state.vocabulary.short
        shown = (f"{each.skill}({', '.join(map(short, each.arguments.values()))})" for each in steps)
        yield LeftOut(tuple(shown), "they failed before", harmless=False, kind="steps")


def _in_the_words_of(vocabulary: Vocabulary, library: SkillLibrary) -> SkillLibrary:
    """Return the library with the vocabulary of the world, which may have classes of its own."""
    names = library.names if vocabulary.classes.keys() <= library.vocabulary.classes.keys() else {}
    return msgspec.structs.replace(library, vocabulary=vocabulary, names=names)


def _named(goal: Condition, state: WorldState, kinds: Kinds) -> frozenset[str]:
    """Return the individuals that a goal speaks of, by name, by class or as those that stand in a relation."""
    named = _refuse_unknown(goal, state)
    for each in walk(goal):
        match each:
            case Exists(_, cls, _) | Forall(_, cls, _):
                named |= state.instances(cls)
            case Holds(subject, relation, object_) if Anything() in (subject, object_):
                named |= {individual for pair in state.pairs(relation) for individual in pair}
                named |= set(_samples(relation, state, kinds))
    return named


def _refuse_unknown(goal: Condition, state: WorldState) -> frozenset[str]:
    """Return the individuals that a goal names; GoalError when the world does not have one of them."""
    named = frozenset(each.iri for each in walk(goal) if isinstance(each, Individual))
    unknown = sorted(named - state.individuals)
    if unknown:
        raise GoalError(f"the goal speaks of {state.vocabulary.short(unknown[0])}, which is not in the world model")
    return named


def _samples(relation: str, state: WorldState, kinds: Kinds) -> Iterator[str]:
    """Yield one individual of each kind that may stand on some side of a relation: the goal reads what these need."""
    signatures = state.vocabulary.relations[relation].signatures
    classes = {cls for each in signatures for cls in (each.domain, each.range)}
    for individuals in kinds.values():
        first = min(individuals)
        if any(state.is_a(first, cls) for cls in classes):
            yield first


def _is_open(goal: Condition) -> bool:
    """Whether a goal speaks of whoever stands in a relation, which may be somebody else once steps change it."""
    return any(isinstance(each, Holds) and Anything() in (each.subject, each.object) for each in walk(goal))


def _combined(kinds: Kinds, vocabulary: Vocabulary) -> frozenset[frozenset[str]]:
    return frozenset(each for each in (lowest(kind, vocabulary) for kind in kinds) if len(each) > 1)


def _lowest(individual: str, state: WorldState) -> frozenset[str]:
    return lowest(state.types(individual), state.vocabulary)


def _ground(
    goal: Condition, library: SkillLibrary, domain: PlanningDomain, named: frozenset[str], state: WorldState
) -> Formula:
    """Return the goal as a formula in which objects are called by their IRIs."""

    def members(cls: str) -> list[str]:
        return sorted(state.instances(cls) & named)

    def holds(condition: Condition) -> bool:
        return evaluate(condition, state, {})

    try:
        objects = {iri: Typed(iri, domain.type_of(_lowest(iri, state))) for iri in named}
        return ground_goal(goal, library, domain, objects, members, holds)
    except Untranslatable as reason:
        raise GoalError(f"the goal {reason}") from reason
    except EvaluationError as error:
        raise GoalError(f"the goal cannot be decided: {error}") from error
