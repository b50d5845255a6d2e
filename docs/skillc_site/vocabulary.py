"""The reference of the terms that ship with skillc, made from the ontology."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TypeAlias

from skillc.services.library.libraries import load_vocabulary
from skillc_model.format_type import format_type
from skillc_rdf.vocabulary.types import ClassTerm, PropertyTerm, RelationTerm, Vocabulary, local_name

Term: TypeAlias = ClassTerm | RelationTerm | PropertyTerm
INTRODUCTION = """\
# The vocabulary

The terms that ship with skillc, by prefix; this page is made from the ontology. Terms are used without prefix where
`use PREFIX` stands, and `prefix:Name` is always possible. Numbers are in SI units. [Ontologies](ontologies.md) explains
how to add terms of your own.
"""


def vocabulary_page() -> str:
    """Return the page as Markdown."""
    vocabulary = load_vocabulary()
    return INTRODUCTION + "".join(
        line
        for prefix, namespace in sorted(vocabulary.prefixes.items())
        for line in _section(prefix, namespace, vocabulary)
    )


def _section(prefix: str, namespace: str, vocabulary: Vocabulary) -> Iterator[str]:
    tables = (
        ("class", "subclass of", vocabulary.classes, lambda term: _names(term.parents, vocabulary)),
        ("relation", "from, to", vocabulary.relations, lambda term: _signatures(term, vocabulary)),
        ("property", "of, values", vocabulary.properties, lambda term: _values(term, vocabulary)),
    )
    rows = [line for kind, about, terms, facts in tables for line in _table(kind, about, terms, facts, namespace)]
    if rows:
        yield f"\n## {prefix}\n\n`{namespace}`\n"
        yield from rows


def _table(
    kind: str, about: str, terms: Mapping[str, Term], facts: Callable[..., str], namespace: str
) -> Iterator[str]:
    own = sorted((iri for iri in terms if _is_in(iri, namespace)), key=lambda iri: local_name(iri).lower())
    if own:
        yield f"\n| {kind} | {about} | meaning |\n|---|---|---|\n"
        yield from (f"| `{local_name(iri)}` | {facts(terms[iri])} | {_plain(terms[iri].comment)} |\n" for iri in own)


def _is_in(iri: str, namespace: str) -> bool:
    return iri.startswith(namespace) and "#" not in iri[len(namespace) :] and "/" not in iri[len(namespace) :]


def _signatures(term: RelationTerm, vocabulary: Vocabulary) -> str:
    pairs = [f"{_name(each.domain, vocabulary)}, {_name(each.range, vocabulary)}" for each in term.signatures]
    notes = [*term.characteristics, *(["computed"] if term.computed_by else [])]
    return "; ".join((*pairs, *notes))


def _values(term: PropertyTerm, vocabulary: Vocabulary) -> str:
    values = ", ".join(f"`{value}`" for value in term.values) or f"`{format_type(term.type, vocabulary)}`"
    bounds = f", {term.bounds}" if term.bounds and str(term.bounds) else ""
    return f"{_names(term.domains, vocabulary)}; {values}{bounds}" if term.domains else values + bounds


def _names(iris: tuple[str, ...], vocabulary: Vocabulary) -> str:
    return ", ".join(_name(iri, vocabulary) for iri in iris)


def _name(iri: str, vocabulary: Vocabulary) -> str:
    for prefix, namespace in sorted(vocabulary.prefixes.items()):
        if _is_in(iri, namespace):
            return f"`{prefix}:{local_name(iri)}`"
    return f"`{local_name(iri)}`"


def _plain(comment: str) -> str:
    text = " ".join(comment.split()).replace("|", "\\|")
    parts = text.split("`")
    parts[::2] = [part.replace("<", "&lt;").replace("*", "\\*") for part in parts[::2]]
    return "`".join(parts)
