"""Individuals with their classes, relations and values, and how to find them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from skillc_model.format_type import SI_UNITS
from skillc_rdf.vocabulary.types import THING, NumberType, VectorType, Vocabulary
from skillc_runtime.world.state.names import NoSuchName, resolve_individual, resolve_term
from skillc_runtime.world.state.properties import property_of
from skillc_runtime.world.state.values import Value, has_value, show
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class PropertyValue:
    """The value of a property with its SI unit, which is empty for values without one."""

    property: str
    value: Value
    unit: str

    def __str__(self) -> str:
        return f"{show(self.value)} {self.unit}".strip()


@dataclass(frozen=True, slots=True, eq=False)
class Element:
    """An individual in one version of the world. Terms are given by IRI or `prefix:name`; NoSuchName for others."""

    state: WorldState
    iri: str

    def __str__(self) -> str:
        return self.state.vocabulary.short(self.iri)

    @property
    def types(self) -> tuple[str, ...]:
        """Its declared classes, sorted."""
        return tuple(sorted(self.state.types(self.iri)))

    @property
    def relations(self) -> tuple[tuple[str, str], ...]:
        """Its asserted relations with their objects, sorted; relations that follow from axioms are left out."""
        links = sorted(self.state.asserted.items())
        return tuple((name, each) for name, pairs in links for each in sorted(pairs.forward.get(self.iri)))

    @property
    def properties(self) -> tuple[PropertyValue, ...]:
        """Its stored properties, sorted."""
        found = ((name, table.get(self.iri)) for name, table in sorted(self.state.stored.items()))
        known = self.state.vocabulary
        return tuple(PropertyValue(name, value, unit_of(name, known)) for name, value in found if value is not None)

    def is_a(self, cls: str) -> bool:
        """Whether it is of a class or of a subclass of it."""
        return self.state.is_a(self.iri, resolve_term(cls, self.state.vocabulary))

    def objects(self, relation: str) -> tuple[Element, ...]:
        """Return the individuals that it has the relation to, also by axioms, sorted by IRI."""
        found = self.state.objects(self.iri, _relation(relation, self.state.vocabulary))
        return elements_of(self.state, found)

    def subjects(self, relation: str) -> tuple[Element, ...]:
        """Return the individuals that have the relation to it, also by axioms, sorted by IRI."""
        found = self.state.subjects(_relation(relation, self.state.vocabulary), self.iri)
        return elements_of(self.state, found)

    def property_value(self, property_: str) -> PropertyValue | None:
        """Return a stored or computed property with its unit; None when it has no value."""
        iri = _property(property_, self.state.vocabulary)
        value = property_of(self.state, self.iri, iri)
        return None if value is None else PropertyValue(iri, value, unit_of(iri, self.state.vocabulary))


def elements_of(state: WorldState, individuals: Iterable[str]) -> tuple[Element, ...]:
    """Return individuals, given by IRI, sorted by IRI."""
    return tuple(Element(state, each) for each in sorted(individuals))


def find_element(state: WorldState, name: str) -> Element:
    """Return the individual with an IRI or `prefix:name`; NoSuchName suggests existing ones."""
    return Element(state, resolve_individual(name, state))


def find_elements(
    state: WorldState,
    cls: str = THING,
    related: Mapping[str, str] | None = None,
    having: Mapping[str, Value] | None = None,
) -> tuple[Element, ...]:
    """Return the individuals of a class with all these relations to individuals and values, sorted by IRI."""
    known = state.vocabulary
    found = state.instances(resolve_term(cls, known))
    for relation, object_ in (related or {}).items():
        found &= state.subjects(_relation(relation, known), resolve_individual(object_, state))
    for name, value in (having or {}).items():
        table = state.stored[_property(name, known)]
        found = frozenset(each for each in found if has_value(table.get(each), value))
    return elements_of(state, found)


def search_elements(state: WorldState, words: str) -> tuple[Element, ...]:
    """Return the individuals whose names, classes and texts contain all the words, in any case; sorted by IRI."""
    wanted = words.casefold().split()
    found = (Element(state, each) for each in sorted(state.individuals))
    return tuple(each for each in found if all(word in _text(each) for word in wanted))


def unit_of(property_: str, vocabulary: Vocabulary) -> str:
    """Return the SI unit of a property, empty for a property without one."""
    match vocabulary.properties[property_].type:
        case NumberType(dimension) | VectorType(dimension):
            return SI_UNITS.get(dimension, "")
        case _:
            return ""


def _text(each: Element) -> str:
    short = each.state.vocabulary.short
    texts = [show(quantity.value) for quantity in each.properties]
    return " ".join([str(each), *map(short, each.types), *texts]).casefold()


def _relation(name: str, vocabulary: Vocabulary) -> str:
    iri = resolve_term(name, vocabulary)
    if iri not in vocabulary.relations:
        raise NoSuchName(f"{vocabulary.short(iri)} is no relation")
    return iri


def _property(name: str, vocabulary: Vocabulary) -> str:
    iri = resolve_term(name, vocabulary)
    if iri not in vocabulary.properties:
        raise NoSuchName(f"{vocabulary.short(iri)} is no property")
    return iri
