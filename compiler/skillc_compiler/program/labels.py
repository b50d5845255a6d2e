"""Labels that point to the declaration of a value or of a term of the vocabulary."""

from __future__ import annotations

from skillc_compiler.program.expressions import TypedExpression
from skillc_dsl.diagnostics import Label
from skillc_dsl.source import Span
from skillc_rdf.vocabulary.types import ClassTerm, FunctionTerm, PropertyTerm, RelationTerm


def label_values(*values: TypedExpression) -> tuple[Label, ...]:
    """Return labels at the declarations of the values that are names."""
    return tuple(Label(value.declared, "declared here") for value in values if value.declared is not None)


def label_declaration(term: ClassTerm | RelationTerm | PropertyTerm | FunctionTerm) -> tuple[Label, ...]:
    """Return a label at a term's declaration in a `.skill` or Turtle file, or no label if its place is unknown."""
    place = declaration_place(term)
    return (Label(place, "declared here"),) if place is not None else ()


def declaration_place(term: ClassTerm | RelationTerm | PropertyTerm | FunctionTerm) -> Span | None:
    """Return the place of a term's declaration, None if it is unknown."""
    at = term.source
    return Span(at.path, at.line, at.column, at.line, at.column + 1) if at is not None else None
