"""An output that is read, or returned, without a value."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.analysis.findings import UnassignedOutput, UnassignedRead
from skillc_compiler.analysis.paths import path_labels
from skillc_compiler.analysis.proof import Proofs, findings_of
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_dsl.diagnostics import Diagnostic, Label

NAMES = ("out-unassigned", "out-never-assigned")
NEEDS = Need.TYPES
READS = Reads.PROOFS


def check(proofs: Proofs) -> Iterator[Diagnostic]:
    """Yield a problem for each output that is read too early or left without a value."""
    for one in findings_of(proofs, UnassignedRead):
        yield Diagnostic(
            "out-unassigned",
            one.span,
            f"`{one.name}` has no value here on every path",
            help=f"assign it before, with `-> {one.name}` on a call that always runs",
            labels=path_labels(one.path),
        )
    for two in findings_of(proofs, UnassignedOutput):
        name = two.parameter.name
        yield Diagnostic(
            "out-never-assigned",
            two.implementation.name_span,
            f"`{two.implementation.name}` does not give the output `{name}` a value on every path",
            help=f"take it from a call: `.. -> {name}`",
            labels=(Label(two.parameter.span, "declared here"), *path_labels(two.path)),
        )
