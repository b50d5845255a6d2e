"""A node that never starts."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.analysis.findings import UnreachableNode
from skillc_compiler.analysis.proof import Proofs, findings_of
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_dsl.diagnostics import Diagnostic

NAMES = ("unreachable-node",)
NEEDS = Need.BODY
READS = Reads.PROOFS


def check(proofs: Proofs) -> Iterator[Diagnostic]:
    """Yield a problem for the first of consecutive nodes that never start."""
    for one in findings_of(proofs, UnreachableNode):
        yield Diagnostic(
            "unreachable-node",
            one.node.written.span,
            "this never starts: the nodes before it always end otherwise",
            help="remove it, or check the node before it",
            severity="warning",
        )
