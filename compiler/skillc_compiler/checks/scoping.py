"""`with` on a skill that is not scoped."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Call, Skill
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Label

NAMES = ("not-scoped",)
NEEDS = Need.TYPES
READS = Reads.DECLARATION


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each `with` that could not undo what it calls."""
    for node in program.nodes:
        if isinstance(node.written, s.With) and node.call and node.call.skill:
            yield from _check_scoped(node.call, node.call.skill)


def _check_scoped(call: Call, skill: Skill) -> Iterator[Diagnostic]:
    if "scoped" not in skill.flags:
        yield Diagnostic(
            "not-scoped",
            call.written.skill.span,
            f"`{skill.name}` is not declared `scoped`, so `with` cannot undo it",
            help="call it as a node of its own, or declare it `scoped`",
            labels=(Label(skill.name_span, "declared here"),),
        )
