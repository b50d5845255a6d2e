"""The vocabulary of a library: classes, relations, properties and functions with their axioms."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import TypeVar

import msgspec

from skillc_dsl.position import Position
from skillc_rdf.vocabulary.closure import RelationClosure
from skillc_rdf.vocabulary.components import components
from skillc_rdf.vocabulary.conditions import ClassType as ClassType
from skillc_rdf.vocabulary.conditions import Condition, Variable
from skillc_rdf.vocabulary.conditions import DirectionType as DirectionType
from skillc_rdf.vocabulary.conditions import ListType as ListType
from skillc_rdf.vocabulary.conditions import NumberType as NumberType
from skillc_rdf.vocabulary.conditions import PlainType as PlainType
from skillc_rdf.vocabulary.conditions import ValueType as ValueType
from skillc_rdf.vocabulary.conditions import VectorType as VectorType

T = TypeVar("T")

THING = "http://www.w3.org/2002/07/owl#Thing"
LITERAL = "http://www.w3.org/2000/01/rdf-schema#Literal"
CHARACTERISTICS = ("functional", "inverse_functional", "symmetric", "transitive", "asymmetric", "irreflexive")
"""The characteristics of relations, in the order of messages."""


class ClassTerm(msgspec.Struct, frozen=True, kw_only=True):
    """An ontology class.

    `required` are the relations and properties that must be stated of each individual, but for idle ones of the
    vocabulary.
    """

    iri: str
    parents: tuple[str, ...] = ()
    disjoint: tuple[str, ...] = ()
    required: tuple[str, ...] = ()
    comment: str = ""
    source: Position | None = None


class Signature(msgspec.Struct, frozen=True):
    """One domain and range of a relation; a relation with several is overloaded."""

    domain: str
    range: str


class RelationTerm(msgspec.Struct, frozen=True, kw_only=True):
    """An object property with its axioms.

    `computed_by` names a Python class, "module:class", that computes from other facts whether the relation holds; such
    a relation has no other axioms. `computed_from` are the relations and properties that it depends on: plans cannot
    read it if skills change one of them. Empty: the dependencies are unknown.
    """

    iri: str
    signatures: tuple[Signature, ...]
    parents: tuple[str, ...] = ()
    inverse: str | None = None
    functional: bool = False
    inverse_functional: bool = False
    symmetric: bool = False
    transitive: bool = False
    asymmetric: bool = False
    irreflexive: bool = False
    acyclic: bool = False
    computed_by: str | None = None
    computed_from: tuple[str, ...] = ()
    comment: str = ""
    source: Position | None = None

    @property
    def is_acyclic(self) -> bool:
        """Whether no chain of facts leads back to where it begins."""
        return self.acyclic or (self.transitive and self.irreflexive)

    @property
    def characteristics(self) -> tuple[str, ...]:
        """The names of the relation's characteristics, such as `inverse functional`."""
        return tuple(name.replace("_", " ") for name in CHARACTERISTICS if getattr(self, name))


class Definition(msgspec.Struct, frozen=True, kw_only=True):
    """What a relation of two individuals is defined as: a condition on `subject` and `object`.

    `text` is the condition as its author wrote it. `group` are the relations that are defined by one another, itself
    included, sorted; empty if its condition does not lead back to it.
    """

    subject: Variable
    object: Variable
    condition: Condition
    text: str
    group: tuple[str, ...] = ()


class Bounds(msgspec.Struct, frozen=True, kw_only=True):
    """Bounds of a number: `least` and `greatest` are inclusive, `above` and `below` exclusive."""

    least: float | None = None
    above: float | None = None
    greatest: float | None = None
    below: float | None = None

    def hold(self, number: float) -> bool:
        """Whether a number is within the bounds."""
        return (
            (self.least is None or number >= self.least)
            and (self.above is None or number > self.above)
            and (self.greatest is None or number <= self.greatest)
            and (self.below is None or number < self.below)
        )

    def __str__(self) -> str:
        ends = (("at least", self.least), ("above", self.above), ("at most", self.greatest), ("below", self.below))
        return " and ".join(f"{word} {end:g}" for word, end in ends if end is not None)


class PropertyTerm(msgspec.Struct, frozen=True, kw_only=True):
    """A data property.

    `values` is the finite set of values of a text property, () for any; `bounds` are those of a number; `datatype` is
    the datatype of texts which are no strings, such as dates, and LITERAL if the property has no range. `computed_by`
    names a Python function, "module:function", (world state, individual) -> value; `computed_from` are the relations
    and properties of the individual that it reads, all facts if it names none. `measure` is the property of the same
    individual with the number from which the value was judged, `threshold` the one with the number that it needs.
    """

    iri: str
    domains: tuple[str, ...]
    type: ValueType
    values: tuple[str, ...] = ()
    bounds: Bounds | None = None
    datatype: str = ""
    functional: bool = True
    computed_by: str | None = None
    computed_from: tuple[str, ...] = ()
    measure: str | None = None
    threshold: str | None = None
    comment: str = ""
    source: Position | None = None


class FunctionTerm(msgspec.Struct, frozen=True, kw_only=True):
    """A Python function, "module:function", called as f(world state, *arguments); numbers in SI units."""

    name: str
    parameters: tuple[tuple[str, ValueType], ...]
    result: ValueType
    python: str
    comment: str = ""
    source: Position | None = None


class Vocabulary(msgspec.Struct, frozen=True, dict=True, kw_only=True):
    """All terms by IRI (functions by name), the prefixes that shorten IRIs, and the aliases of terms.

    `deprecated` maps deprecated terms to their replacements, "" without one; `since` has the terms that came after the
    first edition of the language, with the edition of each. `symbolic`: worlds of these terms have no
    bodies, so that they need not state what a simulation has to know: sizes, poses and data sheets. `idle` are the
    relations and properties of other ontologies than the shipped ones that no skill reads (`with_named`), sorted:
    scenes may contradict them. `individuals` are those of these ontologies, such as units, with their classes.
    `definitions` are those of the relations that the library defines by conditions.
    `enumerations` are the closed classes, each with all its individuals in order, which are part of every world.
    `rules` are axioms that classify individuals or derive relations between them, in N-Triples; `changing` are the
    relations and properties that skills change (`with_named`), of which nothing that lasts is derived, sorted.
    """

    symbolic: bool = False
    prefixes: dict[str, str] = {}
    aliases: dict[str, str] = {}
    deprecated: dict[str, str] = {}
    since: dict[str, int] = {}
    classes: dict[str, ClassTerm] = {}
    relations: dict[str, RelationTerm] = {}
    definitions: dict[str, Definition] = {}
    properties: dict[str, PropertyTerm] = {}
    functions: dict[str, FunctionTerm] = {}
    idle: tuple[str, ...] = ()
    individuals: dict[str, tuple[str, ...]] = {}
    enumerations: dict[str, tuple[str, ...]] = {}
    rules: tuple[str, ...] = ()
    changing: tuple[str, ...] = ()

    @cached_property
    def ancestors(self) -> dict[str, frozenset[str]]:
        """Each class with all its superclasses, itself and `owl:Thing` included."""
        parents = {iri: (*term.parents, THING) for iri, term in self.classes.items()}
        parents.setdefault(THING, ())
        return _ancestors(parents)

    @cached_property
    def super_relations(self) -> dict[str, frozenset[str]]:
        """Each relation with all its super-relations, itself included."""
        parents = {iri: term.parents for iri, term in self.relations.items()}
        return _ancestors(parents)

    @cached_property
    def closure(self) -> RelationClosure:
        """The closure of the relations by sub-relations, inverses and symmetry."""
        return RelationClosure(self.relations)

    def implied_links(self, relation: str, subject: T, object_: T) -> Iterator[tuple[RelationTerm, T, T]]:
        """Yield what a relation between two things implies, itself included: relations with their subject and object.

        Every rule about axioms of relations looks at these: of the compiler between terms, of the planner between
        variables, of the world between individuals.
        """
        for implied in self.closure.implied.get(relation, ()):
            yield self.relations[implied.relation], *implied.ends(subject, object_)

    @cached_property
    def namespaces(self) -> dict[str, str]:
        """The prefixes whose namespaces contain terms."""
        iris = (*self.classes, *self.relations, *self.properties)
        bases = set(map(namespace_of, iris))
        return {prefix: base for prefix, base in self.prefixes.items() if base in bases}

    def is_a(self, cls: str, ancestor: str) -> bool:
        """Whether every individual of `cls` is one of `ancestor`; an unknown class is only itself and a Thing."""
        return ancestor in self.ancestors.get(cls, (cls, THING))

    def find_value(self, cls: str | None, name: str) -> str | None:
        """Return the individual of an enumeration that is called `name`; None for other names and classes."""
        values = self.enumerations.get(cls or "", ())
        return next((iri for iri in values if value_name(iri) == name), None)

    @cached_property
    def enumerated(self) -> dict[str, str]:
        """Each individual of an enumeration, with its class."""
        return {iri: cls for cls, values in self.enumerations.items() for iri in values}

    @cached_property
    def value_names(self) -> frozenset[str]:
        """The names of all values of enumerations."""
        return frozenset(map(value_name, self.enumerated))

    def later_than(self, edition: int) -> frozenset[str]:
        """Return the terms that came after an edition of the language."""
        return self._later.get(edition, frozenset())

    @cached_property
    def _later(self) -> dict[int, frozenset[str]]:
        editions = range(1, max(self.since.values(), default=1))
        return {each: frozenset(iri for iri, since in self.since.items() if since > each) for each in editions}

    @cached_property
    def judged_from(self) -> dict[str, tuple[str, ...]]:
        """The Boolean properties that are judged from a number or with a threshold, by its IRI."""
        judged = [each for each in self.properties.values() if each.measure and each.threshold]
        judged = [each for each in judged if each.type == PlainType("Bool")]
        numbers = {iri for each in judged for iri in (each.measure, each.threshold) if iri is not None}
        return {iri: tuple(each.iri for each in judged if iri in (each.measure, each.threshold)) for iri in numbers}

    @property
    def terms(self) -> Iterator[str]:
        """The IRIs of all classes, relations and properties."""
        yield from (*self.classes, *self.relations, *self.properties)

    def is_computed(self, term: str) -> bool:
        """Whether a relation or property is computed from other facts."""
        known = self.relations.get(term) or self.properties.get(term)
        return known is not None and known.computed_by is not None

    def inputs_of(self, term: str) -> tuple[str, ...]:
        """Return the relations and properties from which a term is computed; none if it does not say."""
        known = self.relations.get(term) or self.properties.get(term)
        return known.computed_from if known is not None else ()

    def disjoint(self, one: str, other: str) -> bool:
        """Whether no individual can be of both classes."""
        ours, theirs = self.ancestors.get(one, frozenset()), self.ancestors.get(other, frozenset())
        return any(not theirs.isdisjoint(self.classes[a].disjoint) for a in ours if a in self.classes) or any(
            not ours.isdisjoint(self.classes[a].disjoint) for a in theirs if a in self.classes
        )

    def short(self, iri: str) -> str:
        """Return `prefix:name` by the longest fitting prefix, `name` if that is empty, or the IRI if none fits."""
        fitting = [(len(base), prefix, base) for prefix, base in self.prefixes.items() if iri.startswith(base)]
        if not fitting:
            return iri
        _, prefix, base = max(fitting)
        name = iri[len(base) :]
        return f"{prefix}:{name}" if prefix else name

    def expand(self, name: str) -> str:
        """Return the IRI of `prefix:name`; KeyError for an unknown prefix."""
        prefix, _, local = name.partition(":")
        return self.prefixes[prefix] + local


def local_name(iri: str) -> str:
    """Return the part of an IRI after its last `#` or `/`."""
    return iri.rsplit("#", 1)[-1].rsplit("/", 1)[-1]


def value_iri(enumeration: str, name: str) -> str:
    """Return the IRI of a value of an enumeration; values of the same name in others are different individuals."""
    return f"{enumeration}-{name}"


def value_name(iri: str) -> str:
    """Return the name of a value of an enumeration, by its IRI."""
    return iri.rpartition("-")[2]


def namespace_of(iri: str) -> str:
    """Return an IRI without its local name."""
    return iri.removesuffix(local_name(iri))


def _ancestors(parents: Mapping[str, tuple[str, ...]]) -> dict[str, frozenset[str]]:
    """Return the terms above each, itself included; a term has those of its parents, equivalent terms share theirs."""
    unknown = {other: () for others in parents.values() for other in others if other not in parents}
    above: dict[str, frozenset[str]] = {}
    for group in components({**parents, **unknown}):
        outside = {other for iri in group for other in parents.get(iri, ())}.difference(group)
        above |= dict.fromkeys(group, frozenset(group).union(*(above[other] for other in outside)))
    return {iri: above[iri] for iri in parents}
