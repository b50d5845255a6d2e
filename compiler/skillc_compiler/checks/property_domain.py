"""A property read of an individual whose class does not have it."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.labels import label_declaration, label_values
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.typed import Program, TypedExpression
from skillc_compiler.program.types import Thing, describe_type, fits
from skillc_compiler.program.walk import all_conditions, all_values
from skillc_dsl.diagnostics import Diagnostic
from skillc_model.conditions import HasProperty, PropertyOf
from skillc_rdf.vocabulary.types import local_name

NAMES = ("property-domain",)
NEEDS = Need.NAMES
READS = Reads.DECLARATION


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each property of an individual whose class does not have it."""
    for value in all_values(program):
        if isinstance(value.meaning, PropertyOf):
            yield from _check_domain(program, value.meaning.property, value.parts[0])
    for condition in all_conditions(program):
        if isinstance(condition.meaning, HasProperty):
            yield from _check_domain(program, condition.meaning.property, condition.values[0])


def _check_domain(program: Program, iri: str, of: TypedExpression) -> Iterator[Diagnostic]:
    term = program.vocabulary.properties.get(iri)
    if term is None or not term.domains:
        return
    if any(fits(program.vocabulary, of.type, Thing(domain)) for domain in term.domains):
        return
    domains = " or ".join(local_name(domain) for domain in term.domains)
    yield Diagnostic(
        "property-domain",
        of.span,
        f"`{local_name(iri)}` is a property of {domains}, and this is {describe_type(of.type)}",
        help="read it of another individual, or narrow the class of the parameter",
        labels=(*label_declaration(term), *label_values(of)),
    )
