"""Tables of statements by predicate, read in bulk without positions, or made from statements with positions."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import islice
from sys import intern
from typing import TypeAlias

import pyoxigraph as ox

from skillc_rdf.turtle.statements import Statement
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.scene.checks.ineffective import is_ordinary, is_ordinary_class
from skillc_runtime.scene.documents import BASE, CACHED, SMALL_CHARACTERS, Document
from skillc_runtime.scene.memory import MemoryGuard
from skillc_runtime.scene.standard_terms import is_misspelt
from skillc_runtime.scene.statements import NAMED_INDIVIDUAL, is_term_kind, terms_of

AT_ONCE = 100_000
"""The number of triples between two checks of the available memory."""

Named: TypeAlias = list[tuple[str, str]]
"""Subjects and objects; empty for blank nodes."""
Literals: TypeAlias = list[tuple[str, ox.Literal]]


@dataclass(slots=True)
class StatementTable:
    """The rows of each predicate, in the order of the texts: those with a node and those with a literal as object.

    `is_unusual` is set if the rows are not enough to interpret the texts: something may be misspelt or have no effect.
    `nameless` are the predicates of statements with blank nodes.
    """

    named: dict[str, Named] = field(default_factory=lambda: defaultdict(list))
    literal: dict[str, Literals] = field(default_factory=lambda: defaultdict(list))
    prefixes: dict[str, str] = field(default_factory=dict)
    nameless: set[str] = field(default_factory=set)
    is_unusual: bool = False


def tabulate(statements: Iterable[Statement]) -> StatementTable:
    """Return the table of statements."""
    table = StatementTable()
    for each in statements:
        subject = each.subject.value if isinstance(each.subject, ox.NamedNode) else ""
        if isinstance(each.object, ox.Literal):
            table.literal[each.predicate].append((subject, each.object))
        else:
            name = each.object.value if isinstance(each.object, ox.NamedNode) else ""
            table.named[each.predicate].append((subject, name))
    return table


def read_table(documents: Sequence[Document], vocabulary: Vocabulary, scenes: int) -> StatementTable:
    """Return the table of documents, the first `scenes` of them scenes; SyntaxError, UnicodeEncodeError,
    TooLittleMemory. Small ones that are no scenes, such as data sheets, are read once."""
    table, guard, aliases = StatementTable(), MemoryGuard(), tuple(vocabulary.aliases.items())
    for number, document in enumerate(documents):
        if number < scenes or len(document.text) > SMALL_CHARACTERS:
            prefixes = _read(document.text, vocabulary.aliases, table, guard)
        else:
            known = _read_once(document.text, aliases)
            prefixes = known.prefixes
            _extend(table, known)
        if number < scenes:
            table.is_unusual = not _is_plain(table, vocabulary)
        for prefix, base in prefixes.items():
            other = vocabulary.namespaces.get(prefix, base) != base
            table.is_unusual |= other and base not in vocabulary.namespaces.values()  # it may be misspelt
            if prefix:
                table.prefixes.setdefault(prefix, base)
        if table.is_unusual:
            return table
    table.is_unusual = _has_suspicious_terms(table, vocabulary)
    return table


@lru_cache(maxsize=CACHED)
def _read_once(text: str, aliases: tuple[tuple[str, str], ...]) -> StatementTable:
    """Return the table of a text and its prefixes, which nobody changes."""
    table, parser = StatementTable(), _parse(text)
    _add(parser, dict(aliases), table)
    table.prefixes = dict(parser.prefixes)
    return table


def _extend(table: StatementTable, other: StatementTable) -> None:
    """Add the rows of another table."""
    for predicate, named in other.named.items():
        table.named[predicate].extend(named)
    for predicate, literals in other.literal.items():
        table.literal[predicate].extend(literals)
    table.nameless |= other.nameless


def _read(text: str, aliases: dict[str, str], table: StatementTable, guard: MemoryGuard) -> dict[str, str]:
    """Add the triples of a text, and return its prefixes."""
    parser = _parse(text)
    while _add(islice(parser, AT_ONCE), aliases, table) == AT_ONCE:
        guard.check()
    return dict(parser.prefixes)


def _parse(text: str) -> ox.QuadParser:
    return ox.parse(text.encode(), format=ox.RdfFormat.TURTLE, base_iri=BASE)


def _add(triples: Iterable[ox.Quad], aliases: dict[str, str], table: StatementTable) -> int:
    """Add triples and return how many there were; equal IRIs become the same string object."""
    named, literal, count = table.named, table.literal, 0
    for count, each in enumerate(triples, 1):  # noqa: B007  it is how many there were
        subject, object_, predicate = each.subject, each.object, each.predicate.value
        predicate = aliases.get(predicate, predicate)
        name = intern(value) if isinstance(subject, ox.NamedNode) and (value := subject.value) else ""
        if isinstance(object_, ox.Literal):
            literal[predicate].append((name, object_))
        elif isinstance(object_, ox.NamedNode):
            value = object_.value
            named[predicate].append((name, intern(aliases.get(value, value))))
        else:
            named[predicate].append((name, ""))
            table.nameless.add(predicate)
        if not name:
            table.nameless.add(predicate)
    return count


def _is_plain(table: StatementTable, vocabulary: Vocabulary) -> bool:
    """Whether a scene has individuals, no blank nodes, and only facts about individuals and annotations."""
    types = table.named[RDF_TYPE]
    subjects = {subject for rows in table.named.values() for subject, _ in rows}
    subjects |= {subject for rows in table.literal.values() for subject, _ in rows}
    terms = {subject for subject, cls in types if is_term_kind(cls)}
    return (
        any(cls != NAMED_INDIVIDUAL and subject not in terms for subject, cls in types)
        and not table.nameless
        and subjects.isdisjoint(terms_of(vocabulary))
        and all(map(is_ordinary, table.named.keys() | table.literal.keys()))
        and all(map(is_ordinary_class, {cls for _, cls in types}))
    )


def _has_suspicious_terms(table: StatementTable, vocabulary: Vocabulary) -> bool:
    """Whether a term of OWL or RDFS may be misspelt, or an individual is a blank node."""
    predicates, types = table.named.keys() | table.literal.keys(), table.named[RDF_TYPE]
    return (
        any(map(is_misspelt, predicates | {cls for _, cls in types}))
        or not table.nameless.isdisjoint(vocabulary.relations)
        or not table.nameless.isdisjoint(vocabulary.properties)
        or (RDF_TYPE in table.nameless and any(not subject and cls in vocabulary.classes for subject, cls in types))
    )
