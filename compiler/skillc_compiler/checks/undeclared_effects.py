"""A child that changes something that its skill does not declare."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.analysis.findings import UndeclaredEffect
from skillc_compiler.analysis.paths import path_labels
from skillc_compiler.analysis.proof import findings_of
from skillc_compiler.program.marks import Need
from skillc_compiler.program.typed import Program
from skillc_dsl.diagnostics import Diagnostic, Label

NAMES = ("undeclared-effect",)
NEEDS = Need.BODY


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each effect of a call that lasts beyond the skill and that no `post` declares."""
    for one in findings_of(program, UndeclaredEffect):
        skill = one.implementation.skill
        yield Diagnostic(
            "undeclared-effect",
            one.call.written.skill.span,
            f"`{one.call.written.skill.text}` causes `{one.post.text}`, which `{skill.name}` does not declare",
            help=f"add a `post` that declares it to `{skill.name}` or to this implementation, or undo it",
            labels=(
                Label(one.post.span, "the effect"),
                Label(skill.name_span, "whose posts do not declare it"),
                *path_labels(one.path),
            ),
        )
