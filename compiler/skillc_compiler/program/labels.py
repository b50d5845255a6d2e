"""Labels that point to the declaration of a term of the vocabulary."""

from __future__ import annotations

from skillc_dsl.diagnostics import Label
from skillc_dsl.source import Span
from skillc_rdf.vocabulary.types import ClassTerm, FunctionTerm, PropertyTerm, RelationTerm


def label_declaration(term: ClassTerm | RelationTerm | PropertyTerm | FunctionTerm) -> tuple[Label, ...]:
    """Return a label at a term's declaration in a `.skill` or Turtle file, or no label if its place is unknown."""
    place = term.source
    if place is None:
        return ()
    return (Label(Span(place.path, place.line, place.column, place.line, place.column + 1), "declared here"),)
