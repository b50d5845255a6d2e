"""An output that is read, or returned, without a value."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.analysis.findings import UnassignedOutput, UnassignedRead
from skillc_compiler.analysis.paths import path_labels
from skillc_compiler.analysis.proof import Proofs
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_dsl.diagnostics import Diagnostic, Label

NAMES = ("out-unassigned", "out-never-assigned")
NEEDS = Need.TYPES
READS = Reads.PROOFS


def check(proofs: Proofs) -> Iterator[Diagnostic]:
    """Yield a problem for each output that is read too early, or else left without a value."""
    for proof in proofs.values():
        read = [one for one in proof.findings if isinstance(one, UnassignedRead)]
        yield from map(_read, read)
        left = (one for one in proof.findings if isinstance(one, UnassignedOutput))
        names = {one.name for one in read}
        yield from (_left(one) for one in left if one.parameter.name not in names)


def _read(found: UnassignedRead) -> Diagnostic:
    return Diagnostic(
        "out-unassigned",
        found.span,
        f"`{found.name}` has no value here on every path",
        help=f"assign it before, with `-> {found.name}` on a call that always runs",
        labels=(Label(found.declared, "declared here", is_cause=True), *path_labels(found.path)),
    )


def _left(found: UnassignedOutput) -> Diagnostic:
    name = found.parameter.name
    return Diagnostic(
        "out-never-assigned",
        found.implementation.name_span,
        f"`{found.implementation.name}` does not give the output `{name}` a value on every path",
        help=f"take it from a call: `.. -> {name}`",
        labels=(Label(found.parameter.span, "declared here", is_cause=True), *path_labels(found.path)),
    )
