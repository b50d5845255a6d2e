"""Loads a scene: the individuals of Turtle files, checked against the vocabulary, as the first version of a world."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from difflib import get_close_matches
from pathlib import Path

import msgspec
import pyoxigraph as ox

from skillc_compiler.library.vocabulary import Vocabulary, local_name
from skillc_ontology.catalogue import vocabulary_files
from skillc_runtime.world.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.contents import contents
from skillc_runtime.world.documents import Document, Placed, SceneError, SceneProblem, parse, resolved
from skillc_runtime.world.individuals import facts, iri_of, with_own_classes
from skillc_runtime.world.literals import LiteralError, read
from skillc_runtime.world.plausible import flaws
from skillc_runtime.world.rules import broken
from skillc_runtime.world.state import WorldState
from skillc_runtime.world.turtle import RDF_TYPE
from skillc_runtime.world.values import Value, equal, show

Written = tuple[Change, Placed]
LISTED = 12
"""How many individuals help lists at most."""


def load_scene(path: Path, vocabulary: Vocabulary) -> WorldState:
    """Return the world of a scene file and of the packaged data sheets; SceneError with all that is wrong."""
    sheets = [Document(name, text) for name, text in vocabulary_files()]
    own = Document.read(path)
    state = world_of([own, *sheets], vocabulary)
    if state.individuals.isdisjoint(contents([own]).subjects):
        nothing = SceneProblem(
            own.path, 1, 1, "empty-scene", "there is nothing in this scene", "name a thing: `:x a CLASS .`"
        )
        raise SceneError([nothing])
    return state


def world_of(documents: Iterable[Document], vocabulary: Vocabulary) -> WorldState:
    """Return the world of Turtle documents; SceneError with all that is wrong.

    Any numeric literal is a number. Prefixes and classes that a document declares join the vocabulary of the world;
    templates and annotations are passed over.
    """
    parsed = [parse(document) for document in documents]
    said = [resolved(each, vocabulary.aliases) for document in parsed for each in document.statements]
    prefixes = {name: base for document in reversed(parsed) for name, base in document.prefixes.items() if name}
    vocabulary = msgspec.structs.replace(vocabulary, prefixes={**prefixes, **vocabulary.prefixes})
    vocabulary = with_own_classes(vocabulary, said)
    reader = _Reader(vocabulary, facts(said, vocabulary))
    written = list(reader.changes())
    state = WorldState.empty(vocabulary).changed(change for change, _ in written)
    breaches = [place.problem(each.axiom, each.message) for change, place in written for each in broken(state, change)]
    problems = [*reader.problems, *breaches] or list(_implausible(state, written))
    if problems:
        raise SceneError(dict.fromkeys(problems))
    return state


def _implausible(state: WorldState, written: Sequence[Written]) -> Iterator[SceneProblem]:
    places = {_said_by(change): place for change, place in reversed(written)}
    for flaw in flaws(state):
        yield places[flaw.individual, flaw.predicate].problem(flaw.name, flaw.message, flaw.help)


def _said_by(change: Change) -> tuple[str, str]:
    """Return the individual and the predicate of the statement that a change was read from."""
    match change:
        case AddIndividual(individual, _):
            return individual, RDF_TYPE
        case AddRelation(subject, relation, _):
            return subject, relation
        case SetProperty(individual, property_, _):
            return individual, property_
        case _:
            raise AssertionError(f"no statement says {change}")


class _Reader:
    """Turns facts into changes and notes those that the vocabulary does not allow."""

    def __init__(self, vocabulary: Vocabulary, said: Sequence[Placed]) -> None:
        self._vocabulary = vocabulary
        self._said = said
        self._types = [each for each in said if each.predicate == RDF_TYPE]
        self._declared = {iri_of(each.subject) for each in self._types}
        self._known = {iri_of(each.subject) for each in self._types if iri_of(each.object) in vocabulary.ancestors}
        self.problems: list[SceneProblem] = []

    def changes(self) -> Iterator[Written]:
        """Yield the changes, individuals first."""
        yield from self._individuals()
        values: dict[tuple[str, str], list[tuple[Value, Placed]]] = defaultdict(list)
        for each in self._said:
            subject = iri_of(each.subject)
            if each.predicate == RDF_TYPE:
                continue
            if subject not in self._declared:
                self._untyped(each, subject)
            elif each.predicate in self._vocabulary.properties:
                values[subject, each.predicate].extend(self._value(each))
            elif each.predicate in self._vocabulary.relations:
                yield from self._relation(each, subject)
            else:
                self._unknown_predicate(each)
        for (subject, property_), found in values.items():
            yield from self._property(subject, property_, found)

    def _individuals(self) -> Iterator[Written]:
        for each in self._types:
            cls = iri_of(each.object)
            if cls in self._vocabulary.ancestors:
                yield AddIndividual(iri_of(each.subject), (cls,)), each
            else:
                self._unknown(each, "class", cls, self._vocabulary.classes)

    def _relation(self, each: Placed, subject: str) -> Iterator[Written]:
        object_ = iri_of(each.object)
        short = self._vocabulary.short
        if not isinstance(each.object, ox.NamedNode):
            message = f"{short(each.predicate)} is a relation: it leads to an individual, and this is {each.object}"
            self.problems.append(each.problem("relation-range", message, "name an individual of the scene"))
        elif object_ not in self._declared:
            self._unknown(each, "individual", object_, self._declared, self._fitting(each.predicate))
        elif subject in self._known and object_ in self._known:
            yield AddRelation(subject, each.predicate, object_), each

    def _value(self, each: Placed) -> Iterator[tuple[Value, Placed]]:
        term = self._vocabulary.properties[each.predicate]
        name = self._vocabulary.short(each.predicate)
        if not isinstance(each.object, ox.Literal):
            message = f"{name} is a property: it has a value, and this is {each.object}"
            self.problems.append(each.problem("wrong-data-type", message, "write a number or a text in quotes"))
            return
        try:
            yield read(each.object, term), each
        except LiteralError as error:
            self.problems.append(each.problem("wrong-data-type", f"{name}: {error}"))

    def _property(self, subject: str, property_: str, found: list[tuple[Value, Placed]]) -> Iterator[Written]:
        distinct = [pair for n, pair in enumerate(found) if not any(equal(pair[0], other) for other, _ in found[:n])]
        if not distinct or subject not in self._known:
            return
        value, place = distinct[0]
        if not self._vocabulary.properties[property_].functional:
            yield SetProperty(subject, property_, tuple(each for each, _ in distinct)), place
            return
        yield SetProperty(subject, property_, value), place
        for other, second in distinct[1:]:
            short = self._vocabulary.short
            message = f"{short(subject)} has two values of {short(property_)}: {show(value)} and {show(other)}"
            self.problems.append(second.problem("functional-property", message, "keep one of them"))

    def _untyped(self, each: Placed, subject: str) -> None:
        message = f"{self._vocabulary.short(subject)} is of no class"
        self.problems.append(each.problem("unknown-individual", message, "say what it is: `a CLASS ;`"))
        self._declared.add(subject)

    def _unknown_predicate(self, each: Placed) -> None:
        if isinstance(each.object, ox.Literal):
            self._unknown(each, "property", each.predicate, self._vocabulary.properties)
        else:
            self._unknown(each, "relation", each.predicate, self._vocabulary.relations)

    def _fitting(self, relation: str) -> list[str]:
        """Return the individuals that the relation may lead to, by their short names."""
        ranges = [each.range for each in self._vocabulary.relations[relation].signatures]
        types = ((iri_of(each.subject), iri_of(each.object)) for each in self._types)
        fitting = {one for one, cls in types if any(self._vocabulary.is_a(cls, range_) for range_ in ranges)}
        return sorted(map(self._vocabulary.short, fitting))

    def _unknown(self, each: Placed, kind: str, iri: str, known: Iterable[str], others: Sequence[str] = ()) -> None:
        """Note that there is no such term or individual; help is what it is like, else the others there are."""
        short = self._vocabulary.short
        names = {local_name(other): other for other in sorted(known)}
        near = [short(names[name]) for name in get_close_matches(local_name(iri), names, n=3, cutoff=0.6)]
        message = f"there is no {kind} {short(iri)}" if iri else f"{each.object} is no {kind}"
        listed = f"there is {', '.join(others[:LISTED])}{', ..' if others[LISTED:] else ''}" if others else ""
        help_ = f"did you mean {' or '.join(near)}?" if near else listed
        self.problems.append(each.problem(f"unknown-{kind}", message, help_))
