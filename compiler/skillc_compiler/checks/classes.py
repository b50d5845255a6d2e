"""A condition that requires an individual to be of two disjoint classes."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.types import Thing, Type, describe_type
from skillc_dsl.diagnostics import Diagnostic
from skillc_model.conditions import IsA, Same
from skillc_rdf.vocabulary.types import Vocabulary

NAMES = ("disjoint-types",)
NEEDS = Need.NAMES
READS = Reads.DECLARATION


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each `is` and `==` that can never hold."""
    for condition in program.conditions:
        match condition.meaning:
            case IsA(cls=cls):
                asked: tuple[Type, Type] = (condition.values[0].type, Thing(cls))
            case Same():
                asked = (condition.values[0].type, condition.values[1].type)
            case _:
                continue
        if _are_disjoint(program.vocabulary, *asked):
            yield Diagnostic(
                "disjoint-types",
                condition.span,
                f"this never holds: nothing is both {describe_type(asked[0])} and {describe_type(asked[1])}",
                help="remove the condition, or ask for another class",
            )


def _are_disjoint(vocabulary: Vocabulary, one: Type, other: Type) -> bool:
    match one, other:
        case Thing(cls=str(a)), Thing(cls=str(b)):
            return vocabulary.disjoint(a, b)
    return False
