"""A called skill whose precondition does not hold at its start, or is not known to hold."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.analysis.findings import UnprovedPrecondition
from skillc_compiler.analysis.paths import path_labels
from skillc_compiler.analysis.proof import Proofs, findings_of
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_dsl.diagnostics import Diagnostic, Label

NAMES = ("child-precondition",)
NEEDS = Need.BODY
READS = Reads.PROOFS


def check(proofs: Proofs) -> Iterator[Diagnostic]:
    """Yield a problem for each such precondition of each call."""
    for one in findings_of(proofs, UnprovedPrecondition):
        name, text = one.call.written.skill.text, one.requirement.text
        what = "does not hold" if one.false else "is not guaranteed"
        yield Diagnostic(
            "child-precondition",
            one.call.written.skill.span,
            f"`{name}` needs `{text}`, which {what} here",
            help=_help(one),
            severity="error" if one.false else "warning",
            labels=(Label(one.requirement.span, "needed here"), *path_labels(one.path)),
        )


def _help(one: UnprovedPrecondition) -> str:
    if one.false:
        return "call it where its precondition holds, or establish it before"
    return "add it as a `pre` of the calling skill, establish it before, or test it: `check(..)`"
