"""`when` where it does not say which individuals an effect is on."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.expressions import TypedCondition
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_dsl.diagnostics import Diagnostic
from skillc_model.conditions import And

NAMES = ("misplaced-when",)
NEEDS = Need.NAMES
READS = Reads.DECLARATION


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each `when` that is no part of the conjunction which an outcome is, or a post not sensed."""
    written = (each for each in program.requirements if each.kind == "outcome" or not each.sensed)
    ends = (each for each in written if each.says_what_comes)
    effects = {id(part) for end in ends for part in _parts(end.condition)}
    for each in program.conditions:
        if each.conditional is not None and id(each) not in effects:
            yield Diagnostic(
                "misplaced-when",
                each.parts[1].span,
                "`when` says which individuals an effect is on, and this is none",
                help="in a condition write `forall x: Class (.. implies ..)`; a `post` is a conjunction of effects",
            )


def _parts(condition: TypedCondition) -> Iterator[TypedCondition]:
    yield condition
    for part in condition.parts if isinstance(condition.meaning, And) and condition.conditional is None else ():
        yield from _parts(part)
