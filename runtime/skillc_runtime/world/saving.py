"""Writes a version of the world as a scene: Turtle from which the same facts are loaded again."""

from __future__ import annotations

import os
import re
from collections import defaultdict
from collections.abc import Iterable, Iterator
from math import isfinite
from pathlib import Path

import pyoxigraph as ox

from skillc_compiler.library.vocabulary import Vocabulary
from skillc_compiler.turtle.terms import RDF_TYPE, XSD
from skillc_runtime.world.documents import Document, resolved, statements_of
from skillc_runtime.world.individuals import facts, iri_of, with_own_classes
from skillc_runtime.world.state import WorldState
from skillc_runtime.world.store.facts import CLASS, SUBCLASS, TYPE, all_facts
from skillc_runtime.world.store.store import StoreError

_LOCAL = re.compile(r"[A-Za-z_](?:[\w-]*\w)?", re.ASCII)
LISTED = 3
"""How many facts a message names."""


class SaveError(ValueError):
    """A world that no scene file can state; the message says which facts are in the way."""


def save(state: WorldState, path: Path, without: WorldState, source: Document | None = None) -> None:
    """Write a scene file, whole or not at all; see `turtle`. OSError when the file cannot be written."""
    text = turtle(state, without, source)
    new = path.with_name(f".{path.name}.{os.getpid()}.new")
    try:
        with new.open("x", encoding="utf-8") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        new.replace(path)
    finally:
        new.unlink(missing_ok=True)


def turtle(state: WorldState, without: WorldState, source: Document | None = None) -> str:
    """Return a scene in which is said what was written of the world, and not what `without` says, the data sheets.

    Of `source`, the scene that the world was loaded from, labels and other remarks, templates and declarations are
    kept, except about individuals that are gone; comments are not. The same facts give the same text. SaveError
    when facts of `without` are true no more, or Turtle has no words for a fact; SceneError for a source that is no
    Turtle.
    """
    known, facts_now = _facts(without), _facts(state)
    if not known <= facts_now:
        lost = "; ".join(sorted(map(str, known - facts_now))[:LISTED])
        raise SaveError(f"a scene cannot take back what data sheets say, and this is true no more: {lost}")
    said = (facts_now - known) | set(_classes(state, without.vocabulary))
    said.update(_besides(source, state) if source is not None else ())
    return _Printed(state.vocabulary).text(said)


def _facts(state: WorldState) -> set[ox.Triple]:
    try:
        return set(all_facts(state))
    except StoreError as error:
        raise SaveError(f"the world cannot be saved: {error}") from error


def _classes(state: WorldState, library: Vocabulary) -> Iterator[ox.Triple]:
    """Yield what declares the classes that the scene has beside the library."""
    for iri in state.vocabulary.classes.keys() - library.classes.keys():
        yield ox.Triple(ox.NamedNode(iri), TYPE, CLASS)
        for parent in state.vocabulary.classes[iri].parents:
            yield ox.Triple(ox.NamedNode(iri), SUBCLASS, ox.NamedNode(parent))


def _besides(source: Document, state: WorldState) -> Iterator[ox.Triple]:
    """Yield what a scene says beside its facts."""
    said = [resolved(each, state.vocabulary.aliases) for each in statements_of(source)]
    about = facts(said, with_own_classes(state.vocabulary, said))
    gone = {iri_of(each.subject) for each in about} - state.individuals
    told = {(each.subject_at, each.predicate_at, each.object_at) for each in about}
    for each in said:
        if iri_of(each.subject) not in gone and (each.subject_at, each.predicate_at, each.object_at) not in told:
            yield ox.Triple(each.subject, ox.NamedNode(each.predicate), each.object)  # type: ignore[arg-type]


class _Printed:
    def __init__(self, vocabulary: Vocabulary) -> None:
        self._prefixes = sorted(vocabulary.prefixes.items(), key=lambda pair: -len(pair[1]))
        self._used: dict[str, str] = {}

    def text(self, said: Iterable[ox.Triple]) -> str:
        """Return Turtle, ordered: subjects by name, what they are first."""
        by_subject: dict[str, list[ox.Triple]] = defaultdict(list)
        for each in said:
            by_subject[str(each.subject)].append(each)
        blocks = [self._block(by_subject[subject]) for subject in sorted(by_subject)]
        head = [f"@prefix {prefix}: <{base}> ." for prefix, base in sorted(self._used.items())]
        return "\n".join([*head, "", *blocks])

    def _block(self, about: list[ox.Triple]) -> str:
        by_predicate: dict[str, list[str]] = defaultdict(list)
        for each in about:
            by_predicate[each.predicate.value].append(self._term(each.object))
        order = sorted(by_predicate, key=lambda predicate: (predicate != RDF_TYPE, predicate))
        lines = [f"{self._predicate(each)} {', '.join(sorted(by_predicate[each]))}" for each in order]
        return f"{self._term(about[0].subject)} " + " ;\n    ".join(lines) + " .\n"

    def _predicate(self, iri: str) -> str:
        return "a" if iri == RDF_TYPE else self._term(ox.NamedNode(iri))

    def _term(self, node: ox.NamedNode | ox.BlankNode | ox.Literal | ox.Triple) -> str:
        if isinstance(node, ox.NamedNode):
            return self._name(node)
        if isinstance(node, ox.Literal) and node.datatype.value == XSD + "double":
            return _double(node)
        return str(node)

    def _name(self, node: ox.NamedNode) -> str:
        for prefix, base in self._prefixes:
            if node.value.startswith(base) and _LOCAL.fullmatch(node.value[len(base) :]):
                self._used[prefix] = base
                return f"{prefix}:{node.value[len(base) :]}"
        return str(node)


def _double(literal: ox.Literal) -> str:
    """Return a number as Turtle abbreviates doubles: with an exponent; what is none stays as it is."""
    try:
        number = float(literal.value)
    except ValueError:
        return str(literal)
    if not isfinite(number):
        return str(literal)
    return repr(number) if "e" in repr(number) else f"{number!r}e0"
