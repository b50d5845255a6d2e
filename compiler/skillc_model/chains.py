"""Unrolls conditions on transitive relations whose chains of facts skills change, for planners without axioms.

`a within b` follows from any number of facts, such as `b contain c` and `c contain a`. Of these, most never change: a
shelf stays in its cell. So a library for planners has a relation of its own for chains of facts that no skill
changes, of any length, and a condition becomes: such a chain leads from one to the other, or with one fact in between
that skills change, or with two, and so on, up to a number that its scene allows.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import NamedTuple, TypeVar

from msgspec import structs

from skillc_model.conditions import (
    And,
    Anything,
    Assert,
    Condition,
    Exists,
    Forall,
    Holds,
    Individual,
    Not,
    Or,
    Retract,
    Same,
    Term,
    Variable,
    single_effect,
)
from skillc_model.pddl.names import assign_names
from skillc_model.read_write import terms_read, terms_written
from skillc_model.skills import Implementation, Requirement, Skill, SkillLibrary
from skillc_rdf.vocabulary.closure import Directed
from skillc_rdf.vocabulary.types import THING, ClassType, Vocabulary

FIXED, MOVING = "-always", "-moved"
"""What ends the names of the relations for chains of facts that no skill changes, and for things that skills move."""

UNKNOWN_SCENE = 2
"""How many facts that skills change are followed where no scene says how many there can be."""

DescribedT = TypeVar("DescribedT", Skill, Implementation)

Depth = Callable[["Chains", str], int]
"""How many facts that skills change a chain may have to (or from, if `at_start`) something of a class."""


def read_relation(relation: str) -> str:
    """Return the relation that a relation for chains, or any other, stands for; both are IRIs."""
    return relation.removesuffix(FIXED)


class Chains(NamedTuple):
    """A transitive relation and the steps of its chains that skills change, directed as the relation.

    `moved` are the classes (or individuals) of what skills move: what a step leads to, or, if `at_start`, what it leads
    from. So of `holds` and of `lies in`, of which a thing has one each, both move what is held or lies there. They
    are `climbed` if they have one relation of steps, of which a thing that is moved has one, and then another one.
    """

    relation: str
    steps: tuple[Directed, ...]
    moved: frozenset[str]
    at_start: bool
    climbed: bool

    @property
    def fixed(self) -> str:
        """The relation, an IRI, for chains of any length of facts that no skill changes, that of no fact included."""
        return self.relation + FIXED

    @property
    def moving(self) -> str:
        """The relation, an IRI, of each thing to itself that skills move, or that is fixed to such a thing."""
        return self.relation + MOVING


def find_chains(library: SkillLibrary, goal: Condition | None = None) -> tuple[Chains, ...]:
    """Return the transitive relations that planned skills or a goal read and that follow from facts that skills change.

    Without those that skills state or take back themselves, which planners cannot use.
    """
    closure = library.vocabulary.closure
    planned = [each for each in library.skills.values() if each.planned]
    read = {iri for each in planned for condition in _conditions(each, library) for iri in terms_read(condition)}
    read |= terms_read(goal) if goal is not None else frozenset()
    relations = sorted({closure.canonical(iri).relation for iri in read & closure.transitive})
    if not relations:
        return ()
    written = terms_written((result for each in planned for result in each.results), library.vocabulary)
    found = (_chains(relation, written, planned, library.vocabulary) for relation in relations)
    return tuple(each for each in found if each is not None)


def unroll_library(library: SkillLibrary, unrolling: Unrolling) -> SkillLibrary:
    """Return a library whose planned skills read no changing chain of these relations, and its vocabulary."""
    vocabulary = add_fixed_relations(library.vocabulary, unrolling.chains.values())
    skills = {
        name: _unrolled(skill, skill, unrolling) if skill.planned else skill for name, skill in library.skills.items()
    }
    implementations = {
        name: _unrolled(each, library.skills[each.skill], unrolling) for name, each in library.implementations.items()
    }
    unrolled = structs.replace(library, vocabulary=vocabulary, skills=skills, implementations=implementations)
    return structs.replace(unrolled, names=assign_names(unrolled))


def unroll_for_any_scene(library: SkillLibrary) -> SkillLibrary:
    """Return a library whose planned skills read no changing chain, with chains as long as in most scenes."""
    chains = find_chains(library)
    known = {each.relation: each for each in chains}
    unrolling = Unrolling(known, lambda *_: UNKNOWN_SCENE, frozenset(known), library.vocabulary)
    return unroll_library(library, unrolling) if chains else library


def add_fixed_relations(vocabulary: Vocabulary, chains: Iterable[Chains]) -> Vocabulary:
    """Return a vocabulary with the relations for chains that never change."""
    known = vocabulary.relations
    added = {
        iri: structs.replace(
            known[each.relation], iri=iri, parents=(), inverse=None, transitive=False, asymmetric=False,
            irreflexive=False, functional=False, inverse_functional=False, symmetric=False,
        )
        for each in chains
        for iri in (each.fixed, each.moving)
    }  # fmt: skip
    return structs.replace(vocabulary, relations={**known, **added})


def _chains(relation: str, written: frozenset[str], planned: Iterable[Skill], vocabulary: Vocabulary) -> Chains | None:
    closure = vocabulary.closure
    steps = tuple(each for each in closure.canonical_sources[relation] if each.relation in written)
    if not steps or any(each.relation in closure.transitive for each in steps):
        return None
    at_start = all(_is_unique(each, 0, vocabulary) for each in steps)
    moved = frozenset(each for skill in planned for each in _moved_by(skill, steps, at_start, vocabulary))
    climbed = len(steps) == 1 and _is_unique(steps[0], int(not at_start), vocabulary)
    kept = all(_keeps(skill, steps, at_start, vocabulary) for skill in planned)
    return Chains(relation, steps, moved, at_start, climbed and kept)


def _keeps(skill: Skill, steps: Iterable[Directed], at_start: bool, vocabulary: Vocabulary) -> bool:
    """Whether a skill gives each thing a new step that it takes one from."""
    taken, given = set[Term](), set[Term]()
    for effect, each, turned in _effects_on(skill, steps, at_start, vocabulary):
        side = effect.subject if turned else effect.object
        if isinstance(effect, Assert) and each == vocabulary.closure.canonical(effect.relation):
            given.add(side)
        elif isinstance(effect, Retract):
            taken.add(side)
    return taken <= given and Anything() not in taken


def _moved_by(skill: Skill, steps: Iterable[Directed], at_start: bool, vocabulary: Vocabulary) -> Iterator[str]:
    """Yield what stands on the moved side of the steps that a skill makes or ends: classes or individuals."""
    flipped = {each.relation: each.flipped for each in steps}
    for effect, each, turned in _effects_on(skill, steps, at_start, vocabulary):
        yield _class_of(effect.subject if turned else effect.object, skill)
        if not at_start and _is_unique(Directed(each.relation, flipped[each.relation]), 0, vocabulary):
            yield THING  # a new fact ends the one before, which may lead to anything


def _effects_on(
    skill: Skill, steps: Iterable[Directed], at_start: bool, vocabulary: Vocabulary
) -> Iterator[tuple[Assert | Retract, Directed, bool]]:
    """Yield the effects that make or end steps, with the relation of the step, and whether its subject is moved."""
    flipped, closure = {each.relation: each.flipped for each in steps}, vocabulary.closure
    effects = [single_effect(each) for result in skill.results for each in result.effects]
    for effect in (each for each in effects if isinstance(each, Assert | Retract)):
        for each in {closure.canonical(effect.relation), *closure.canonical_sources.get(effect.relation, ())}:
            if each.relation in flipped:
                yield effect, each, (each.flipped != flipped[each.relation]) != at_start


def _is_unique(step: Directed, side: int, vocabulary: Vocabulary) -> bool:
    """Whether what stands on a side of a step, 0 for its start, has one such step only."""
    term = vocabulary.relations[step.relation]
    return term.functional if bool(side) == step.flipped else term.inverse_functional


def _class_of(term: Term, skill: Skill) -> str:
    match term:
        case Individual(iri):
            return iri
        case Variable(name):
            types = (each.type for each in skill.parameters if each.name == name)
            return next((each.iri for each in types if isinstance(each, ClassType)), THING)
        case Anything():
            return THING


def _conditions(skill: Skill, library: SkillLibrary) -> Iterator[Condition]:
    described: tuple[Skill | Implementation, ...] = (skill, *library.implementations_of(skill.name))
    for one in described:
        yield from (each.condition for each in (*one.pre, *one.hold))


def _unrolled(one: DescribedT, skill: Skill, unrolling: Unrolling) -> DescribedT:
    classes = {each.name: each.type.iri for each in skill.parameters if isinstance(each.type, ClassType)}

    def changed(requirements: tuple[Requirement, ...]) -> tuple[Requirement, ...]:
        return tuple(structs.replace(each, condition=unrolling.of(each.condition, classes)) for each in requirements)

    return structs.replace(one, pre=changed(one.pre), hold=changed(one.hold))


class Unrolling(NamedTuple):
    """Unrolls conditions; `chains` by relation, an IRI.

    `climbed` are the relations of which each thing that skills move has exactly one step, always: that no chain leads
    from one to another is said by where the only one leads, since planners multiply out what is said of all steps.
    Conditions that need that of other relations are left as they are, and planners refuse them.
    """

    chains: Mapping[str, Chains]
    depth: Depth
    climbed: frozenset[str]
    vocabulary: Vocabulary

    def of(self, condition: Condition, classes: Mapping[str, str], *, negated: bool = False) -> Condition:
        """Return a condition that reads no changing chain; `classes` are those of its variables by name.

        `negated` if it stands in an odd number of negations.
        """
        match condition:
            case Holds(subject, relation, object_) if self._chains_of(relation) is not None:
                if Anything() in (subject, object_):
                    return condition
                chains = self._chains_of(relation)
                assert chains is not None
                start, end = self.vocabulary.closure.canonical(relation).ends(subject, object_)
                steps = self._steps(chains, start, end, classes)
                if not negated:
                    return self._path(chains, start, end, steps)
                return Not(self._no_path(chains, start, end, steps)) if chains.relation in self.climbed else condition
            case Not(body):
                return Not(self.of(body, classes, negated=not negated))
            case Exists(variable, cls, body) | Forall(variable, cls, body):
                inner = self.of(body, {**classes, variable: cls}, negated=negated)
                return structs.replace(condition, body=inner)
            case And(parts) | Or(parts):
                return type(condition)(tuple(self.of(each, classes, negated=negated) for each in parts))
            case _:
                return condition

    def _chains_of(self, relation: str) -> Chains | None:
        return self.chains.get(self.vocabulary.closure.canonical(relation).relation)

    def _steps(self, chains: Chains, start: Term, end: Term, classes: Mapping[str, str]) -> int:
        side = start if chains.at_start else end
        return self.depth(chains, classes.get(side.name, THING) if isinstance(side, Variable) else THING)

    def _path(self, chains: Chains, start: Term, end: Term, steps: int) -> Condition:
        fixed = And((Not(Same(start, end)), Holds(start, chains.fixed, end)))
        return Or((fixed, self._onwards(chains, start, end, steps))) if steps else fixed

    def _onwards(self, chains: Chains, start: Term, end: Term, left: int) -> Condition:
        """Return that a chain leads from one to the other with at least one step that skills change, `left` at most."""
        over, under = Variable(f"over-{left}"), Variable(f"under-{left}")
        rest: Condition = Holds(under, chains.fixed, end)
        if left > 1:
            rest = Or((rest, self._onwards(chains, under, end, left - 1)))
        return self._some_step(chains, over, under, And((Holds(start, chains.fixed, over), rest)))

    def _no_path(self, chains: Chains, start: Term, end: Term, steps: int) -> Condition:
        return Or((Same(start, end), self._elsewhere(chains, start, end, steps)))

    def _elsewhere(self, chains: Chains, start: Term, end: Term, left: int) -> Condition:
        """Return that no chain of no or more steps leads from one to the other, with `left` changing ones at most.

        From the moved side, either there is no such step, as nothing is there that skills move, or the only one leads
        to where no chain comes from, or goes to.
        """
        fixed = Not(Holds(start, chains.fixed, end))
        if not left:
            return fixed
        over, under = Variable(f"over-{left}"), Variable(f"under-{left}")
        if chains.at_start:
            here = Holds(start, chains.fixed, over)
            rest = self._elsewhere(chains, under, end, left - 1)
            moved: Condition = Holds(start, chains.moving, start)
        else:
            here = Holds(under, chains.fixed, end)
            rest = self._elsewhere(chains, start, over, left - 1)
            moved = Holds(end, chains.moving, end)
        return And((fixed, Or((Not(moved), self._some_step(chains, over, under, And((here, rest)))))))

    def _some_step(self, chains: Chains, over: Variable, under: Variable, also: Condition) -> Condition:
        ends = ((each.relation, *each.ends(over, under)) for each in chains.steps)
        step = Or(tuple(Holds(subject, relation, object_) for relation, subject, object_ in ends))
        before, after = (self._side(chains, side) for side in (0, 1))
        return Exists(over.name, before, Exists(under.name, after, And((step, also))))

    def _side(self, chains: Chains, side: int) -> str:
        """Return the class of what stands on a side of all steps: 0 before, 1 after."""
        found = {
            (each.domain, each.range)[side != step.flipped]
            for step in chains.steps
            for each in self.vocabulary.relations[step.relation].signatures
        }
        return next(iter(found)) if len(found) == 1 else THING
