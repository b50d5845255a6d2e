"""Writes a version of the world as a scene: Turtle from which the same facts can be loaded."""

from __future__ import annotations

import os
import re
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from math import isfinite
from pathlib import Path

import pyoxigraph as ox

from skillc_rdf.turtle.statements import Extent, Statement
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_rdf.vocabulary.types import NumberType, Vocabulary
from skillc_runtime.scene.aside import set_aside
from skillc_runtime.scene.documents import Document, statements_of, with_canonical_terms
from skillc_runtime.scene.load import read_documents, sheet_documents
from skillc_runtime.scene.statements import iri_of, select_facts, with_own_classes
from skillc_runtime.store.literals import text_literal
from skillc_runtime.store.triples import CLASS, SUBCLASS, TYPE
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, SetProperty
from skillc_runtime.world.state.values import Value, has_value, show
from skillc_runtime.world.state.vectors import format_vector, is_vector
from skillc_runtime.world.state.world_state import WorldState

_LOCAL = re.compile(r"[A-Za-z_](?:[\w-]*\w)?", re.ASCII)
LISTED = 3
"""The maximum number of facts in a message."""


class SaveError(ValueError):
    """A world that a scene file cannot state; the message names the facts."""


def save_scene(state: WorldState, path: Path, without: WorldState, source: Document | None = None) -> None:
    """Write a scene file, completely or not at all; see `format_scene`. OSError when it cannot be written."""
    text = format_scene(state, without, source)
    new = path.with_name(f".{path.name}.{os.getpid()}.new")
    try:
        with new.open("x", encoding="utf-8") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        new.replace(path)
    finally:
        new.unlink(missing_ok=True)


def format_scene(state: WorldState, without: WorldState, source: Document | None = None) -> str:
    """Return a scene with the asserted facts of the world, except those of `without`, the data sheets.

    From `source`, the scene that the world was loaded from, annotations, templates and declarations are kept, except
    about individuals that were removed; comments are not kept. The same facts give the same text. SaveError when facts
    of `without` no longer hold or Turtle cannot state a fact; SceneError when the source is not Turtle.
    """
    _check_nothing_lost(state, without)
    written = _TurtleWriter(state.vocabulary)
    for subject, predicate, object_ in _links(state):
        if not _is_asserted(without, subject, predicate, object_):
            written.add_link(subject, predicate, object_)
    for subject, property_, value in _values(state):
        if not has_value(without.value(subject, property_), value):
            written.add_value(subject, property_, value)
    for triple in (
        *_classes(state, without.vocabulary),
        *(_other_statements(source, state) if source is not None else ()),
    ):
        written.add_triple(triple)
    return written.text() if not state.hidden.facts else _with_truth(written, state)


def _with_truth(written: _TurtleWriter, state: WorldState) -> str:
    """Return a scene as TriG, with what is true but not known."""
    from skillc_rdf.formats.read import TRUTH

    truth = written.beside()
    for each in state.hidden.facts:
        match each:
            case AddRelation(subject, relation, object_):
                truth.add_link(subject, relation, object_)
            case SetProperty(individual, property_, value):
                for one in value if isinstance(value, tuple) else (value,):
                    truth.add_value(individual, property_, one)
            case AddIndividual(individual, types):
                for cls in types:
                    truth.add_link(individual, RDF_TYPE, cls)
            case _:
                raise SaveError("a scene cannot state that what is known is not true")
    name = truth.name(TRUTH.value)
    return f"{written.text()}\n{name} {{\n{truth.statements()}}}\n"


def _links(state: WorldState) -> Iterator[tuple[str, str, str]]:
    """Yield the asserted classes and relations."""
    yield from ((each, RDF_TYPE, cls) for each, classes in state.direct.items() for cls in classes)
    for relation, links in state.asserted.items():
        yield from ((subject, relation, object_) for subject, object_ in links.pairs())


def _values(state: WorldState) -> Iterator[tuple[str, str, Value]]:
    """Yield each value of each property."""
    for property_, table in state.stored.items():
        for individual, value in table.items():
            several = value if isinstance(value, tuple) else (value,)
            yield from ((individual, property_, one) for one in several if one is not None)


def _is_asserted(state: WorldState, subject: str, predicate: str, object_: str) -> bool:
    """Whether a class or relation is asserted."""
    if predicate == RDF_TYPE:
        return object_ in state.types(subject)
    return object_ in state.asserted[predicate].forward.get(subject)


def _check_nothing_lost(state: WorldState, without: WorldState) -> None:
    short = state.vocabulary.short
    lost = [" ".join(map(short, fact)) for fact in _links(without) if not _is_asserted(state, *fact)]
    for individual, property_, value in _values(without):
        if not has_value(state.value(individual, property_), value):
            lost.append(f"{short(individual)}.{short(property_)} = {show(value)}")
    if lost:
        listed = "; ".join(sorted(lost)[:LISTED])
        raise SaveError(f"a scene cannot retract facts of data sheets, but these no longer hold: {listed}")


def _classes(state: WorldState, library: Vocabulary) -> Iterator[ox.Triple]:
    """Yield the declarations of classes that the scene has in addition to the library."""
    for iri in state.vocabulary.classes.keys() - library.classes.keys():
        yield ox.Triple(ox.NamedNode(iri), TYPE, CLASS)
        for parent in state.vocabulary.classes[iri].parents:
            yield ox.Triple(ox.NamedNode(iri), SUBCLASS, ox.NamedNode(parent))


def _other_statements(source: Document, state: WorldState) -> Iterator[ox.Triple]:
    """Yield the statements of a scene that are not facts."""
    said = [with_canonical_terms(each, state.vocabulary.aliases) for each in statements_of(source)]
    vocabulary = with_own_classes(state.vocabulary, said)
    about = select_facts(set_aside(said, vocabulary).understood, vocabulary)
    gone = {iri_of(each.subject) for each in about} - state.individuals
    unfit = _unfit(source, vocabulary, about)
    stated = {(each.subject_at, each.predicate_at, each.object_at) for each in about} - unfit
    for each in said:
        if iri_of(each.subject) not in gone and (each.subject_at, each.predicate_at, each.object_at) not in stated:
            yield ox.Triple(each.subject, ox.NamedNode(each.predicate), each.object)  # type: ignore[arg-type]


def _unfit(source: Document, vocabulary: Vocabulary, about: Sequence[Statement]) -> set[tuple[Extent, Extent, Extent]]:
    """Return where the statements are that are no facts, because they contradict terms that no skill reads."""
    if not any(each.predicate in vocabulary.idle for each in about):
        return set()
    found = read_documents([source, *sheet_documents()], vocabulary).unfit
    return {(each.subject_at, each.predicate_at, each.object_at) for each in found}


class _TurtleWriter:
    """Collects statements by subject and predicate and writes them as Turtle."""

    def __init__(self, vocabulary: Vocabulary) -> None:
        self._vocabulary = vocabulary
        self._prefixes = sorted(vocabulary.prefixes.items(), key=lambda pair: -len(pair[1]))
        self._used: dict[str, str] = {}
        self._names: dict[str, str] = {}
        self._blank: dict[ox.BlankNode, str] = {}
        self._said: dict[str, dict[str, list[str]]] = defaultdict(lambda: defaultdict(list))

    def add_link(self, subject: str, predicate: str, object_: str) -> None:
        """Add a relation or a class."""
        self._said[self._name(subject)][predicate].append(self._name(object_))

    def add_value(self, individual: str, property_: str, value: Value) -> None:
        """Add a value; numbers are written as doubles."""
        term = self._vocabulary.properties[property_]
        is_number = isinstance(term.type, NumberType)
        match value:
            case bool():
                text = "true" if value else "false"
            case int() if not is_number:
                text = str(value)
            case int() | float() if isfinite(value):
                text = _double(float(value))
            case str():
                text = str(text_literal(value, term))
            case _ if is_vector(value):
                text = f'"{format_vector(value)}"'
            case _:
                reason = f"{show(value)} is not a number, text or truth value"
                raise SaveError(f"a scene cannot state <{property_}> of <{individual}>: {reason}")
        self._said[self._name(individual)][property_].append(text)

    def add_triple(self, triple: ox.Triple) -> None:
        """Add a triple."""
        self._said[self._term(triple.subject)][triple.predicate.value].append(self._term(triple.object))

    def text(self) -> str:
        """Return the text, sorted by subject, with classes first."""
        statements = self.statements()
        head = [f"@prefix {prefix}: <{base}> ." for prefix, base in sorted(self._used.items())]
        return "\n".join([*head, "", statements])

    def statements(self) -> str:
        """Return the text without prefixes."""
        said = sorted(self._said.items(), key=lambda each: each[0])
        return "\n".join(self._block(subject, about) for subject, about in said)

    def beside(self) -> _TurtleWriter:
        """Return a writer of another graph, with the same prefixes."""
        other = _TurtleWriter(self._vocabulary)
        other._used = self._used
        return other

    def name(self, iri: str) -> str:
        """Return how an IRI is written."""
        return self._name(iri)

    def _block(self, subject: str, about: Mapping[str, list[str]]) -> str:
        order = sorted(about, key=lambda predicate: (predicate != RDF_TYPE, predicate))
        names = ("a" if each == RDF_TYPE else self._name(each) for each in order)
        lines = [f"{name} {', '.join(sorted(set(about[each])))}" for name, each in zip(names, order, strict=True)]
        return f"{subject} " + " ;\n    ".join(lines) + " .\n"

    def _term(self, node: ox.NamedNode | ox.BlankNode | ox.Literal | ox.Triple) -> str:
        if isinstance(node, ox.BlankNode):
            return self._blank.setdefault(node, f"_:b{len(self._blank)}")
        return self._name(node.value) if isinstance(node, ox.NamedNode) else str(node)

    def _name(self, iri: str) -> str:
        if iri not in self._names:
            self._names[iri] = self._shortened(iri)
        return self._names[iri]

    def _shortened(self, iri: str) -> str:
        for prefix, base in self._prefixes:
            if iri.startswith(base) and _LOCAL.fullmatch(iri, len(base)):
                self._used[prefix] = base
                return f"{prefix}:{iri[len(base) :]}"
        try:
            return str(ox.NamedNode(iri))
        except ValueError as error:
            raise SaveError(f"a scene cannot mention `{iri}`: it is not an IRI") from error


def _double(number: float) -> str:
    """Return a number as a Turtle double, which has an exponent."""
    return repr(number) if "e" in repr(number) else f"{number!r}e0"
