"""Properties of all executions, stated by `verify` lines."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.analysis.findings import UndecidedProperty, ViolatedProperty
from skillc_compiler.analysis.paths import path_labels
from skillc_compiler.analysis.proof import Proofs, findings_of
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_dsl.diagnostics import Diagnostic

NAMES = ("verify-violated", "verify-undecided")
NEEDS = Need.BODY
READS = Reads.PROOFS


def check(proofs: Proofs) -> Iterator[Diagnostic]:
    """Yield a problem for each property that some execution violates, or that is undecided."""
    for one in findings_of(proofs, ViolatedProperty):
        yield Diagnostic(
            "verify-violated",
            one.property.span,
            f"an execution violates `{one.property.text.removeprefix('verify ')}`",
            help="change the body so that this way cannot be taken, or the property",
            labels=path_labels(one.path),
        )
    for two in findings_of(proofs, UndecidedProperty):
        yield Diagnostic(
            "verify-undecided",
            two.property.span,
            f"it is not known whether `{two.property.text.removeprefix('verify ')}` holds",
            help="add a `check(..)` before, or move parts of the body into skills",
            severity="warning",
        )
