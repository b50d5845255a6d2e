"""A property read of an individual whose class does not have it."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.expressions import TypedExpression
from skillc_compiler.program.labels import label_declaration, label_values
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.types import Thing, describe_type, fits
from skillc_dsl.diagnostics import Diagnostic
from skillc_model.conditions import HasProperty, PropertyOf
from skillc_rdf.vocabulary.types import PropertyTerm, local_name

NAMES = ("property-domain",)
NEEDS = Need.NAMES
READS = Reads.DECLARATION


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each property of an individual whose class does not have it."""
    for value in program.values:
        if isinstance(value.meaning, PropertyOf):
            yield from _check_domain(program, value.meaning.property, value.parts[0])
    for condition in program.conditions:
        if isinstance(condition.meaning, HasProperty):
            yield from _check_domain(program, condition.meaning.property, condition.values[0])


def _check_domain(program: Program, iri: str, of: TypedExpression) -> Iterator[Diagnostic]:
    vocabulary = program.vocabulary
    term = vocabulary.properties.get(iri) or vocabulary.relations.get(iri)
    if term is None:
        return
    is_property = isinstance(term, PropertyTerm)
    allowed = term.domains if isinstance(term, PropertyTerm) else [each.domain for each in term.signatures]
    if not allowed or any(fits(vocabulary, of.type, Thing(domain)) for domain in allowed):
        return
    domains = " or ".join(dict.fromkeys(local_name(domain) for domain in allowed))
    yield Diagnostic(
        "property-domain",
        of.span,
        f"`{local_name(iri)}` is a {'property' if is_property else 'relation'} of {domains}, and this is "
        f"{describe_type(of.type)}",
        help="read it of another individual, or narrow the class of the parameter",
        labels=(*label_declaration(term), *label_values(of)),
    )
