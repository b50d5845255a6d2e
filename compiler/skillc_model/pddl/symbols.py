"""The predicates of a library: their names, their meaning and which of them skills change."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from skillc_model.pddl.domain import ROOT, ClassMeaning, Predicate, PropertyMeaning, RelationMeaning
from skillc_model.pddl.formulas import Typed
from skillc_model.pddl.hierarchy import Hierarchy
from skillc_model.pddl.names import finite_values, make_unique, value_key
from skillc_model.read_write import may_change
from skillc_rdf.vocabulary.closure import Directed
from skillc_rdf.vocabulary.types import Vocabulary


@dataclass(frozen=True)
class Symbols:
    """Predicates by their meaning.

    `names` maps PDDL names to terms; `changing` are the canonical relations and properties that skills change.
    `settled` if the types of named objects come from a scene, so that they are the most specific ones.
    """

    vocabulary: Vocabulary
    names: dict[str, str]
    hierarchy: Hierarchy
    changing: frozenset[str]
    settled: bool = False

    @cached_property
    def _by_term(self) -> dict[str, str]:
        return {term: name for name, term in self.names.items()}

    @cached_property
    def _members(self) -> dict[str, str]:
        chosen: dict[str, str] = {}
        taken = set(self.names)
        for cls in sorted(self.vocabulary.classes):
            chosen[cls] = make_unique(f"is-{self._by_term[cls]}", taken)
            taken.add(chosen[cls])
        return chosen

    def affected(self, iri: str) -> bool:
        """Whether skills change the facts of a relation or property, directly or through another relation."""
        return may_change(iri, self.changing, self.vocabulary)

    def is_computed(self, iri: str) -> bool:
        """Whether a relation is computed from other facts."""
        return iri in self.vocabulary.relations and self.vocabulary.is_computed(iri)

    def decided_by(self, iri: str) -> tuple[str, ...]:
        """Return the changing terms that a computed term depends on; all of them if it declares no inputs."""
        known = self.vocabulary.inputs_of(iri)
        return tuple(sorted(filter(self.affected, known))) if known else tuple(sorted(self.changing))

    def short(self, iri: str) -> str:
        """Return the name of a term in messages."""
        return self.vocabulary.short(iri)

    def is_a(self, cls: str, ancestor: str) -> bool:
        """Whether every individual of `cls` is also of `ancestor`."""
        return self.vocabulary.is_a(cls, ancestor)

    def member(self, cls: str) -> str:
        """Return the unary predicate of a class."""
        return self._members[cls]

    def relation(self, iri: str) -> str:
        """Return the predicate of a canonical relation."""
        return self._by_term[iri]

    def value(self, iri: str, value: bool | str) -> str:
        """Return the predicate that is true if the property has the value."""
        return self._by_term[value_key(iri, value)]

    def values(self, iri: str) -> tuple[bool | str, ...]:
        """Return the values of the property that have predicates."""
        return finite_values(self.vocabulary.properties[iri])

    def readings(self, relation: str) -> tuple[Directed, ...]:
        """Return the predicates any of which implies the relation: its own and those of its changing subrelations."""
        closure = self.vocabulary.closure
        below = (each for each in closure.canonical_sources[relation] if each.relation in self.changing)
        return tuple(sorted({closure.canonical(relation), *below}))

    def follows_over_steps(self, relation: str) -> bool:
        """Whether the relation may follow from a chain of changing facts, because it has a transitive subrelation."""
        below = (each.relation for each in self.vocabulary.closure.sources[relation])
        return any(self.affected(each) for each in below if each in self.vocabulary.closure.transitive)

    def side_class(self, relation: str, side: int) -> str:
        """Return the class of the individuals on one side (0 subject, 1 object) of the relation."""
        signatures = self.vocabulary.relations[relation].signatures
        return self.hierarchy.common([(each.domain, each.range)[side] for each in signatures])

    def takes(self, relation: str, sides: Sequence[Typed]) -> bool:
        """Whether the relation may hold between terms of these types."""
        return all(self._fits(each, self.side_class(relation, side)) for side, each in enumerate(sides))

    def may_have(self, property_: str, owner: Typed) -> bool:
        """Whether a term of this type may have the property."""
        return self._fits(owner, self._owner(property_))

    def _fits(self, term: Typed, cls: str) -> bool:
        wanted = self.hierarchy.type_name(cls)
        if self.settled and not term.name.startswith("?"):
            return self.hierarchy.is_below(term.type, wanted)
        return self.hierarchy.meet(term.type, wanted)

    def _owner(self, property_: str) -> str:
        return self.hierarchy.common(self.vocabulary.properties[property_].domains)

    def predicate(self, name: str) -> Predicate:
        """Return the declaration of the predicate of a class, a relation or a property value."""
        subject = "?subject"
        if name in self._classes:
            cls = self._classes[name]
            return Predicate(name, (Typed(subject, ROOT),), ClassMeaning(cls), False)
        term = self.names[name]
        if term in self.vocabulary.relations:
            return self._relation_predicate(name, term)
        iri, value = self._values[name]
        typed = Typed(subject, self.hierarchy.type_name(self._owner(iri)))
        return Predicate(name, (typed,), PropertyMeaning(iri, value), iri in self.changing)

    @cached_property
    def _classes(self) -> dict[str, str]:
        return {name: cls for cls, name in self._members.items()}

    @cached_property
    def _values(self) -> dict[str, tuple[str, bool | str]]:
        pairs = [(iri, value) for iri in self.vocabulary.properties for value in self.values(iri)]
        return {self.value(iri, value): (iri, value) for iri, value in pairs}

    def _relation_predicate(self, name: str, iri: str) -> Predicate:
        sides = [self.hierarchy.type_name(self.side_class(iri, side)) for side in (0, 1)]
        narrower = tuple(each for each in self.readings(iri) if each.relation != iri)
        typed = (Typed("?subject", sides[0]), Typed("?value", sides[1]))
        return Predicate(name, typed, RelationMeaning(iri, narrower), iri in self.changing)
