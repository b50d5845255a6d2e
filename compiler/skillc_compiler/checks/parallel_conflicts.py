"""Children of a `par` that conflict."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.analysis.findings import ParallelConflict
from skillc_compiler.analysis.proof import Proofs, findings_of
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_dsl.diagnostics import Diagnostic, Label

NAMES = ("parallel-conflict",)
NEEDS = Need.BODY
READS = Reads.PROOFS


def check(proofs: Proofs) -> Iterator[Diagnostic]:
    """Yield a problem for the first two conflicting calls of each pair of children."""
    for one in findings_of(proofs, ParallelConflict):
        first, second = one.first.written.skill, one.second.written.skill
        yield Diagnostic(
            "parallel-conflict",
            second.span,
            f"`{second.text}` runs in parallel with `{first.text}`, and {one.what}",
            help="run one after the other in a `seq`" + ("" if one.certain else ", or add a `pre` that rules this out"),
            severity="error" if one.certain else "warning",
            labels=(Label(first.span, "in parallel with this one"),),
        )
