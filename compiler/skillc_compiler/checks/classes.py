"""Something asked to be of two classes that have nothing in common."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.typed import Program
from skillc_compiler.program.types import Thing, Type, describe
from skillc_compiler.program.walk import clauses
from skillc_dsl.diagnostics import Diagnostic
from skillc_model.conditions import IsA, Same
from skillc_rdf.vocabulary.types import Vocabulary

NAMES = ("disjoint-types",)


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each `is` and `==` that can never hold."""
    for clause in clauses(program):
        match clause.meaning:
            case IsA(cls=cls):
                asked: tuple[Type, Type] = (clause.values[0].type, Thing(cls))
            case Same():
                asked = (clause.values[0].type, clause.values[1].type)
            case _:
                continue
        if _disjoint(program.vocabulary, *asked):
            yield Diagnostic(
                "disjoint-types",
                clause.span,
                f"this never holds: nothing is both {describe(asked[0])} and {describe(asked[1])}",
                help="take the condition away, or ask for another class",
            )


def _disjoint(vocabulary: Vocabulary, one: Type, other: Type) -> bool:
    match one, other:
        case Thing(cls=str(a)), Thing(cls=str(b)):
            return vocabulary.disjoint(a, b)
    return False
