"""An `apply` that claims what has not been done yet."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.analysis.findings import EarlyApply
from skillc_compiler.analysis.paths import path_labels
from skillc_compiler.analysis.proof import Proofs, findings_of
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_dsl.diagnostics import Diagnostic, Label

NAMES = ("applied-early",)
NEEDS = Need.BODY
READS = Reads.PROOFS


def check(proofs: Proofs) -> Iterator[Diagnostic]:
    """Yield a problem for each `apply` of what nothing has established when it is written."""
    for one in findings_of(proofs, EarlyApply):
        why, help_ = _explain(one)
        yield Diagnostic(
            "applied-early",
            one.node.written.span,
            f"this claims `{one.post.text}` {why}",
            help=help_,
            severity="warning",
            labels=(Label(one.post.span, "the postcondition"), *path_labels(one.path)),
        )


def _explain(one: EarlyApply) -> tuple[str, str]:
    if one.call is not None:
        name = one.call.written.skill.text
        return f"before `{name}` establishes it, and `{name}` may fail", "remove it: the skill itself writes it"
    if one.at_the_end:
        return "also where the block has failed", "write it at the end of the block, not in `finally`"
    return "before anything was done, and what follows may fail", "write it after what makes it so"
