"""A body with more states than are kept apart."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.analysis.findings import TooManyStates
from skillc_compiler.analysis.proof import Proofs, findings_of
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_dsl.diagnostics import Diagnostic

NAMES = ("not-decided",)
NEEDS = Need.BODY
READS = Reads.PROOFS


def check(proofs: Proofs) -> Iterator[Diagnostic]:
    """Yield a warning for each body that was analysed only in part."""
    for one in findings_of(proofs, TooManyStates):
        yield Diagnostic(
            "not-decided",
            one.span,
            "this has more possible states than are analysed separately, so warnings about it may be false positives",
            help="move parts of it into skills",
            severity="warning",
        )
