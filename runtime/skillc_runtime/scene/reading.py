"""From the statements of a scene to changes of a world, and the problem of each statement that makes no sense."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Sequence
from typing import TypeAlias

import pyoxigraph as ox

from skillc_compiler.library.vocabulary import THING, Vocabulary
from skillc_compiler.turtle.problems import Edit, Note, Place, Problem
from skillc_compiler.turtle.statements import SOMETHING, Statement
from skillc_compiler.turtle.terms import RDF_TYPE
from skillc_runtime.scene.statements import iri_of
from skillc_runtime.scene.suggestions import suggest
from skillc_runtime.store.literals import LiteralError, read
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.values import Value, equal, show

Written: TypeAlias = tuple[Change, Statement]
"""A change and the statement that says so."""


class Reader:
    """Turns facts into changes and notes those that the vocabulary does not allow.

    Nothing is said of what is missing about `doubtful` individuals.
    """

    def __init__(self, vocabulary: Vocabulary, said: Sequence[Statement], doubtful: Collection[str]) -> None:
        self._vocabulary = vocabulary
        self._said = said
        self._types = [each for each in said if each.predicate == RDF_TYPE]
        self._declared = {iri_of(each.subject): each for each in reversed(self._types)}
        self._classes: dict[str, set[str]] = defaultdict(set)
        for each in self._types:
            if iri_of(each.object) in vocabulary.ancestors:
                self._classes[iri_of(each.subject)].add(iri_of(each.object))
        self._doubtful = doubtful
        self._untyped: set[str] = set()
        self._missing: dict[str, list[Statement]] = defaultdict(list)
        self.problems: list[Problem] = []

    def changes(self) -> Iterator[Written]:
        """Yield the changes, individuals first; `problems` is complete afterwards."""
        yield from self._individuals()
        values: dict[tuple[str, str], list[tuple[Value, Statement]]] = defaultdict(list)
        for each in self._said:
            subject = iri_of(each.subject)
            if each.predicate == RDF_TYPE:
                continue
            if subject not in self._declared:
                self._no_class(each, subject)
            if each.predicate in self._vocabulary.properties:
                values[subject, each.predicate].extend(self._value(each))
            elif each.predicate in self._vocabulary.relations:
                yield from self._relation(each, subject)
            else:
                self._unknown_predicate(each, subject)
        for (subject, property_), found in values.items():
            yield from self._property(subject, property_, found)
        if SOMETHING not in self._doubtful:
            missing = {iri: uses for iri, uses in self._missing.items() if iri not in self._doubtful}
            self.problems += (self._unknown_individual(iri, uses) for iri, uses in missing.items())

    def _individuals(self) -> Iterator[Written]:
        for each in self._types:
            cls = iri_of(each.object)
            if cls in self._vocabulary.ancestors:
                yield AddIndividual(iri_of(each.subject), (cls,)), each
            elif not cls:
                self._note("unknown-class", each.object_place, f"{_text(each.object)} is no class", "name a class")
            else:
                self._unknown("class", cls, each.object_place, self._vocabulary.classes)

    def _relation(self, each: Statement, subject: str) -> Iterator[Written]:
        object_ = iri_of(each.object)
        if isinstance(each.object, ox.Literal):
            message = f"{self._short(each.predicate)} is a relation: it leads to an individual, and this is "
            self._note("relation-range", each.object_place, message + _text(each.object), "name an individual")
        elif object_ and object_ not in self._declared:
            self._missing[object_].append(each)
        elif subject in self._classes and object_ in self._classes:
            yield AddRelation(subject, each.predicate, object_), each

    def _value(self, each: Statement) -> Iterator[tuple[Value, Statement]]:
        term = self._vocabulary.properties[each.predicate]
        name = self._short(each.predicate)
        if not isinstance(each.object, ox.Literal):
            message = f"{name} is a property: it has a value, and this is {self._shown(each.object)}"
            self._note("wrong-data-type", each.object_place, message, "write a number or a text in quotes")
            return
        try:
            yield read(each.object, term), each
        except LiteralError as error:
            instead = error.instead
            edit = Edit(each.object_place, instead, f"write {instead}") if instead is not None else None
            self._note("wrong-data-type", each.object_place, f"{name}: {error}", error.help, edit)

    def _property(self, subject: str, property_: str, found: list[tuple[Value, Statement]]) -> Iterator[Written]:
        distinct = [pair for n, pair in enumerate(found) if not any(equal(pair[0], other) for other, _ in found[:n])]
        if not distinct or subject not in self._classes:
            return
        value, place = distinct[0]
        if not self._vocabulary.properties[property_].functional:
            yield SetProperty(subject, property_, tuple(each for each, _ in distinct)), place
            return
        if len(distinct) == 1 or self._is_within(property_, value):
            yield SetProperty(subject, property_, value), place
        for other, second in distinct[1:]:
            both = f"{show(value)} and {show(other)}"
            message = f"{self._short(subject)} has two values of {self._short(property_)}: {both}"
            notes = (Note(place.object_place, "the other one"),)
            point = _decimal(place, second)
            help_ = f"write `{point.text}`: decimals take a point" if point else "keep one of them"
            self.problems.append(Problem(second.object_place, "functional-property", message, help_, notes, point))

    def _is_within(self, property_: str, value: Value) -> bool:
        bounds = self._vocabulary.properties[property_].bounds
        return bounds is None or not isinstance(value, int | float) or bounds.hold(value)

    def _no_class(self, each: Statement, subject: str) -> None:
        if subject in self._untyped or subject in self._doubtful:
            return
        self._untyped.add(subject)
        place = each.subject_place
        near = suggest(subject, place, self._vocabulary, self._declared)
        message = f"{self._short(subject)} is of no class"
        help_ = near.help if near.edit else "say what it is: `a CLASS ;`"
        self._note("unknown-individual", place, message, help_, near.edit)

    def _unknown_predicate(self, each: Statement, subject: str) -> None:
        literal = isinstance(each.object, ox.Literal)
        known: Iterable[str] = self._vocabulary.properties if literal else self._vocabulary.relations
        fitting = [iri for iri in known if self._may_have(subject, iri)]
        self._unknown("property" if literal else "relation", each.predicate, each.predicate_place, known, fitting)

    def _may_have(self, subject: str, predicate: str) -> bool:
        """Whether an individual's class is in the domain of a relation or a property."""
        relation = self._vocabulary.relations.get(predicate)
        if relation is not None:
            domains = tuple(each.domain for each in relation.signatures)
        else:
            domains = self._vocabulary.properties[predicate].domains
        return any(
            self._vocabulary.is_a(cls, domain) for cls in self._classes.get(subject, (THING,)) for domain in domains
        )

    def _unknown_individual(self, iri: str, uses: list[Statement]) -> Problem:
        """Tell of an individual that is not in the scene, at its first use; the others are noted."""
        first = uses[0]
        ranges = {each.range for use in uses for each in self._vocabulary.relations[use.predicate].signatures}
        fitting = [
            one
            for one, classes in self._classes.items()
            if any(self._vocabulary.is_a(cls, range_) for cls in classes for range_ in ranges)
        ]
        near = suggest(iri, first.object_place, self._vocabulary, fitting or self._declared, fitting)
        notes = [Note(use.object_place, "and here") for use in uses[1:]]
        if near.edit is not None:
            meant = next((s for one, s in self._declared.items() if self._short(one) == near.edit.text), None)
            notes += [Note(meant.subject_place, "this one is there")] if meant is not None else []
        message = f"there is no individual {self._short(iri)}"
        edit = near.edit if len(uses) == 1 else None
        return Problem(first.object_place, "unknown-individual", message, near.help, tuple(notes), edit)

    def _unknown(self, kind: str, iri: str, place: Place, known: Iterable[str], fitting: Sequence[str] = ()) -> None:
        near = suggest(iri, place, self._vocabulary, known, fitting if len(fitting) < len(list(known)) else ())
        self._note(f"unknown-{kind}", place, f"there is no {kind} {self._short(iri)}", near.help, near.edit)

    def _note(self, name: str, place: Place, message: str, help_: str, edit: Edit | None = None) -> None:
        self.problems.append(Problem(place, name, message, help_, edit=edit))

    def _short(self, iri: str) -> str:
        return self._vocabulary.short(iri)

    def _shown(self, node: object) -> str:
        return self._short(node.value) if isinstance(node, ox.NamedNode) else _text(node)


def _text(node: object) -> str:
    return "something without a name" if isinstance(node, ox.BlankNode) else str(node)


def _decimal(first: Statement, second: Statement) -> Edit | None:
    """Return the edit that makes one number of two whole ones with but a comma between them."""
    whole, digits = (each.object.value if isinstance(each.object, ox.Literal) else "" for each in (first, second))
    if first.object_at.end + 1 != second.object_at.start or not (whole.lstrip("+-").isdigit() and digits.isdigit()):
        return None
    start, end = first.object_place, second.object_place
    place = Place(start.path, start.line, start.column, end.end_line, end.end_column)
    return Edit(place, f"{whole}.{digits}", "write a decimal point")
