"""The classes of the individuals that names denote, and which names can never denote the same individual."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

import msgspec

from skillc_compiler.analysis.knowledge.axioms import CanonicalAxioms
from skillc_compiler.analysis.knowledge.state import IndividualTerm, State
from skillc_model.conditions import Anything, Condition, Individual, IsA, Same, Term, Variable
from skillc_rdf.vocabulary.types import THING, Vocabulary

ANY_PREFIX = "?"
Triple: TypeAlias = tuple[Term, str, Term]


class Pattern(NamedTuple):
    """Facts that may change: those of a relation between two terms, or, of a link, all by a chain in which it is."""

    subject: Term
    relation: str
    object: Term
    is_link: bool = False


class AliasTypes(msgspec.Struct, frozen=True):
    """The class of each name, as far as known. A name with ANY_PREFIX is any individual of the class after it.

    `unfolds` is how often definitions that lead back to themselves are looked into. `forms` stores the canonical forms
    of conditions, `patterns` the facts that writing one may make true and untrue; both depend on the vocabulary only.
    """

    vocabulary: Vocabulary
    axioms: CanonicalAxioms
    classes: dict[str, str] = msgspec.field(default_factory=dict)
    unfolds: int = 2
    forms: dict[Condition, Condition] = msgspec.field(default_factory=dict)
    patterns: dict[tuple[Triple, bool | None], tuple[tuple[Pattern, ...], tuple[Pattern, ...]]] = msgspec.field(
        default_factory=dict
    )

    def class_of(self, thing: IndividualTerm) -> str:
        """Return the declared class of a name; `owl:Thing` for a named individual."""
        if isinstance(thing, Individual):
            return THING
        return thing.name[1:] if thing.name.startswith(ANY_PREFIX) else self.classes.get(thing.name, THING)

    def is_computed(self, relation: str) -> bool:
        """Whether a relation is computed from other facts."""
        return relation in self.vocabulary.relations and self.vocabulary.is_computed(relation)

    def is_written_out(self, relation: str) -> bool:
        """Whether a relation is defined by a condition that does not lead back to it."""
        definition = self.vocabulary.definitions.get(relation)
        return definition is not None and not definition.group

    def values_of(self, relation: str) -> tuple[Individual, ...]:
        """Return the values of the enumeration to which a relation leads; none if it may lead elsewhere."""
        term = self.vocabulary.relations.get(relation)
        ranges = {signature.range for signature in term.signatures} if term is not None else set()
        values = self.vocabulary.enumerations.get(ranges.pop(), ()) if len(ranges) == 1 else ()
        return tuple(map(Individual, values))

    def depends_on(self, relation: str, written: frozenset[str]) -> bool:
        """Whether a computed relation may change with one of these relations (canonical IRIs) and properties."""
        if not self.is_computed(relation):
            return False
        known = self.vocabulary.relations[relation].computed_from
        return not known or not written.isdisjoint(self.axioms.canonical.get(each, (each, False))[0] for each in known)

    def is_a(self, state: State, thing: IndividualTerm, cls: str) -> bool | None:
        """Whether the individual is of the class; None if unknown."""
        if self.vocabulary.is_a(self.class_of(thing), cls):
            return True
        known = state.facts.get(IsA(thing, cls))
        if known is not None:
            return known
        if any(self.vocabulary.is_a(each, cls) for each in self._classes(state, thing)):
            return True
        if any(self.vocabulary.disjoint(each, cls) for each in self._classes(state, thing)):
            return False
        return None

    def are_distinct(self, state: State, one: IndividualTerm, other: IndividualTerm) -> bool:
        """Whether the two are certainly different individuals."""
        if one == other:
            return False
        if isinstance(one, Individual) and isinstance(other, Individual):
            return True
        if state.facts.get(same_individual(one, other)) is False:
            return True
        mine, yours = self._classes(state, one), self._classes(state, other)
        return (
            any(self.vocabulary.disjoint(each, every) for each in mine for every in yours)
            or self._is_excluded(state, one, yours)
            or self._is_excluded(state, other, mine)
        )

    def may_be_same(self, state: State, one: Term, other: Term) -> bool:
        """Whether the two may be the same individual; `_` may be any."""
        if isinstance(one, Anything) or isinstance(other, Anything):
            return True
        return not self.are_distinct(state, one, other)

    def _is_excluded(self, state: State, thing: IndividualTerm, classes: Sequence[str]) -> bool:
        """Whether the individual is known not to be of one of the classes."""
        excluded = state.excluded_classes.get(thing, ())
        return any(self.vocabulary.is_a(cls, each) for each in excluded for cls in classes)

    def _classes(self, state: State, thing: IndividualTerm) -> list[str]:
        return [self.class_of(thing), *state.classes.get(thing, ())]


def same_individual(one: IndividualTerm, other: IndividualTerm) -> Same:
    """Return the condition that both are the same individual, in canonical order."""
    first, second = sorted((one, other), key=_order)
    return Same(first, second)


def any_individual(cls: str) -> Variable:
    """Return a name for any individual of a class."""
    return Variable(ANY_PREFIX + cls)


def is_any_individual(term: object) -> bool:
    """Whether a term stands for any individual, since its own name is not visible."""
    return isinstance(term, Variable) and term.name.startswith(ANY_PREFIX)


def _order(thing: IndividualTerm) -> tuple[bool, str]:
    return (False, thing.iri) if isinstance(thing, Individual) else (True, thing.name)
