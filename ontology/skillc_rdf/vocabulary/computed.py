"""Relations that are computed have no axioms: what they would imply is nowhere kept."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span
from skillc_rdf.vocabulary.types import Position, RelationTerm, Vocabulary


def computed_alone(vocabulary: Vocabulary) -> Iterator[Diagnostic]:
    """Report computed relations of which an axiom is stated, and those that are computed from what there is not."""
    for _, term in sorted(vocabulary.relations.items()):
        if term.computed_by is None:
            continue
        short = vocabulary.short(term.iri)
        for axiom in _axioms(term, vocabulary):
            message = f"`{short}` is computed by {term.computed_by}, so it cannot be {axiom}"
            yield _error(term, message, "leave the axiom out: what computes the relation decides alone")
        for other in term.computed_from:
            if other not in vocabulary.relations and other not in vocabulary.properties:
                message = (
                    f"`{short}` is computed from `{vocabulary.short(other)}`, which is neither relation nor property"
                )
                yield _error(term, message, "name the relations and properties that decide whether it holds")


def _axioms(term: RelationTerm, vocabulary: Vocabulary) -> Iterator[str]:
    yield from term.characteristics
    yield from (f"a kind of `{vocabulary.short(parent)}`" for parent in term.parents)
    if term.inverse is not None:
        yield f"the inverse of `{vocabulary.short(term.inverse)}`"
    for iri, other in sorted(vocabulary.relations.items()):
        if term.iri in other.parents:
            yield f"what `{vocabulary.short(iri)}` is a kind of"


def _error(term: RelationTerm, message: str, help_: str) -> Diagnostic:
    place = term.source or Position(term.iri, 1, 1)
    return Diagnostic("computed-relation", Span(place.path, place.line, 1, place.line, 2), message, help=help_)
