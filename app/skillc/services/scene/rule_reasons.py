"""Says from which facts, and by which axioms of ontologies, what rules say of an individual follows."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import NamedTuple

import pyoxigraph as ox

from skillc_dsl.position import Position
from skillc_dsl.source import Source
from skillc_rdf.turtle.statements import Statement
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_rdf.vocabulary.places import TermPositions
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.scene.classification import RuleFact, SceneRules
from skillc_runtime.scene.documents import Document
from skillc_runtime.scene.justification import Justification, justify
from skillc_runtime.scene.load import read_with_sheets


class RuleReason(NamedTuple):
    """A fact that rules derive, the facts from which it follows, in short names, and the places of the axioms."""

    fact: tuple[str, str, str]
    since: tuple[tuple[str, str, str], ...]
    axioms: tuple[Position, ...]


class RuleReasons:
    """Why facts follow from a scene by the rules of a vocabulary, which `ontologies` state."""

    def __init__(self, document: Document, vocabulary: Vocabulary, ontologies: Sequence[Source]) -> None:
        self._document, self._vocabulary = document, vocabulary
        self._positions = TermPositions(ontologies)

    def find(self, individual: str) -> tuple[Justification, ...]:
        """Return why each fact about an individual holds that rules derive, as far as a reason is found."""
        return tuple(justify(self._said, self._vocabulary, individual)) if self._vocabulary.rules else ()

    def describe(self, individual: str) -> tuple[RuleReason, ...]:
        """Return the same in short names."""
        return tuple(
            RuleReason(self._short(each.fact), tuple(map(self._short, each.facts)), tuple(map(self.place, each.rules)))
            for each in self.find(individual)
        )

    def place(self, head: ox.Triple) -> Position:
        """Return where an axiom is stated; where its class or property is declared if it cannot be told from others."""
        alike = [unit[0] for unit in self._rules.units if _is_alike(unit[0], head)]
        subject = head.subject.value if isinstance(head.subject, ox.NamedNode) else ""
        stated = self._positions.unnamed_objects(subject, head.predicate.value)
        if len(stated) == len(alike):
            span = stated[alike.index(head)]
            return Position(span.path, span.line, span.column)
        named = (each.value for each in (head.subject, head.object) if isinstance(each, ox.NamedNode))
        return self._positions.position(next(named, subject))

    @cached_property
    def _said(self) -> tuple[Statement, ...]:
        return read_with_sheets(self._document, self._vocabulary).said

    @cached_property
    def _rules(self) -> SceneRules:
        return SceneRules(self._vocabulary)

    def _short(self, fact: RuleFact) -> tuple[str, str, str]:
        subject, said, object_ = fact
        short = self._vocabulary.short
        value = short(object_.value) if isinstance(object_, ox.NamedNode) else object_.value
        return short(subject.value), "a" if said.value == RDF_TYPE else short(said.value), value


def _is_alike(one: ox.Triple, other: ox.Triple) -> bool:
    """Whether axioms begin with the same subject, or both with one that has no name, and say the same kind of thing."""
    unnamed = isinstance(one.subject, ox.BlankNode) and isinstance(other.subject, ox.BlankNode)
    return one.predicate == other.predicate and (unnamed or one.subject == other.subject)
