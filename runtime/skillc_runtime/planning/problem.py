"""A planning problem from a version of the world and a goal, in one pass over the index."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import msgspec

from skillc_compiler.library.conditions import Anything, Condition, Exists, Forall, Holds, Individual
from skillc_compiler.library.pddl.constants import lowest
from skillc_compiler.library.pddl.domain import PlanningDomain
from skillc_compiler.library.pddl.formulas import TRUE, Formula, Typed, renamed
from skillc_compiler.library.pddl.goals import ground_goal, with_predicates_of
from skillc_compiler.library.pddl.names import object_names
from skillc_compiler.library.pddl.problem import Problem
from skillc_compiler.library.pddl.translate import Untranslatable
from skillc_compiler.library.reading import walk
from skillc_compiler.library.skills import SkillLibrary
from skillc_compiler.library.vocabulary import Vocabulary
from skillc_runtime.planning.domains import domain_of
from skillc_runtime.planning.excluding import excluding
from skillc_runtime.planning.initial import Initial
from skillc_runtime.planning.left_out import LeftOut
from skillc_runtime.planning.narrowing import Breadth
from skillc_runtime.planning.plan import Step
from skillc_runtime.planning.relevance import Helpful, helpful
from skillc_runtime.planning.selecting import Kinds, kinds_of, select
from skillc_runtime.planning.unplanned import may_matter
from skillc_runtime.world.conditions import evaluate
from skillc_runtime.world.expressions import EvaluationError
from skillc_runtime.world.state import WorldState


class GoalError(ValueError):
    """A goal that cannot be planned for; the message says what of it, in the author's words."""


@dataclass(frozen=True, slots=True)
class Posed:
    """A problem with the library it speaks of (the scene's own classes included), and what could not be decided.

    `undecided` are static conditions and durations that have no value for some individuals, which are left out.
    `left_out` lists what the scene and the library have beyond the problem, with reasons; `others` are those
    individuals of it that might make a difference, by their types: where there are any, the problem is `narrowed`.
    """

    problem: Problem
    library: SkillLibrary
    undecided: tuple[str, ...]
    left_out: tuple[LeftOut, ...] = ()
    others: dict[str, tuple[str, ...]] = field(default_factory=dict)

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


def pose_problem(
    library: SkillLibrary,
    state: WorldState,
    goal: Condition,
    without: Sequence[Step] = (),
    breadth: Breadth | None = None,
) -> Posed:
    """Return the problem of reaching the goal from a version of the world, by other steps than those of `without`.

    Skills and individuals are left out that can make no difference; with a `breadth` also individuals that are far from
    what the goal speaks of. Skills that cannot be planned with are left out too. GoalError when the goal names an
    unknown individual or says what a planner cannot reason about.
    """
    library = _in_the_words_of(state.vocabulary, library)
    named = _named(goal, state)
    kinds = kinds_of(state)
    domain = domain_of(library, _combined(kinds, state.vocabulary), lambda iri: _lowest(iri, state))
    wanted = _ground(goal, library, domain, named, state)
    domain = with_predicates_of(wanted, library, domain)
    useful = Helpful(domain, ()) if wanted == TRUE else helpful(domain, wanted)
    constants = {each.name: domain.names[each.name] for each in useful.domain.constants}
    selection = select(useful.domain, state, kinds, named.union(constants.values()), breadth)
    types = selection.kept
    others = types.keys() - set(constants.values())
    taken = domain.names.keys() | {each.name for each in domain.predicates}
    names = {**constants, **object_names(others, state.vocabulary, taken)}
    by_iri = {iri: name for name, iri in names.items()}
    objects = tuple(Typed(name, types[iri]) for name, iri in sorted(names.items()))
    domain = excluding(without, useful.domain, by_iri, types)
    initial = Initial(domain, state, objects, names)
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
    return Posed(problem, library, tuple(initial.undecided), left_out, selection.others)


def _skills_left_out(useful: Helpful, goal: Condition, library: SkillLibrary) -> Iterator[LeftOut]:
    """Yield the skills that are not planned with, which authors did not want kept out."""
    if useful.unhelpful:
        why = "nothing that the goal depends on is changed by them"
        yield LeftOut(useful.unhelpful, why, harmless=True, kind="skills")
    excluded = useful.domain.excluded
    helpful = (each.skill for each in useful.domain.actions if each.skill is not None)
    matter = may_matter(excluded, helpful, goal, library) if excluded else frozenset()
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
