"""A relation between individuals of the wrong classes."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.expressions import TypedExpression
from skillc_compiler.program.labels import label_declaration, label_values
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.types import Thing, UnknownType, describe_type, fits
from skillc_dsl.diagnostics import Diagnostic
from skillc_model.conditions import Holds
from skillc_rdf.vocabulary.types import RelationTerm, local_name

NAMES = ("relation-domain", "relation-range")
NEEDS = Need.NAMES
READS = Reads.DECLARATION


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each side of a relation whose class does not fit."""
    for condition in program.conditions:
        if isinstance(condition.meaning, Holds) and condition.meaning.relation in program.vocabulary.relations:
            relation = program.vocabulary.relations[condition.meaning.relation]
            subject, object_ = condition.values
            if all(isinstance(side.type, Thing | UnknownType) for side in condition.values):
                yield from _check_sides(program, relation, subject, object_)


def _check_sides(
    program: Program, relation: RelationTerm, subject: TypedExpression, object_: TypedExpression
) -> Iterator[Diagnostic]:
    fitting = [x for x in relation.signatures if fits(program.vocabulary, subject.type, Thing(x.domain))]
    if not fitting and relation.signatures:
        yield _problem("relation-domain", relation, subject, "on its left")
    elif relation.signatures and not any(fits(program.vocabulary, object_.type, Thing(x.range)) for x in fitting):
        yield _problem("relation-range", relation, object_, "on its right")


def _problem(name: str, relation: RelationTerm, side: TypedExpression, where: str) -> Diagnostic:
    ways = " or ".join(f"{local_name(x.domain)} to {local_name(x.range)}" for x in relation.signatures)
    return Diagnostic(
        name,
        side.span,
        f"`{local_name(relation.iri)}` goes from {ways}, but {where} stands {describe_type(side.type)}",
        help="swap the sides, narrow the class of the parameter, or use another relation",
        labels=(*label_declaration(relation), *label_values(side)),
    )
