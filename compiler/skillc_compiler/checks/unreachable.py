"""A node that never starts, whatever its neighbours do."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.analysis.findings import UnreachableNode
from skillc_compiler.analysis.proof import findings_of
from skillc_compiler.program.typed import Program
from skillc_dsl.diagnostics import Diagnostic

NAMES = ("unreachable-node",)


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for the first of several nodes that never start."""
    for one in findings_of(program, UnreachableNode):
        yield Diagnostic(
            "unreachable-node",
            one.node.written.span,
            "this never starts: what comes before it always ends otherwise",
            help="take it away, or look again at the node before it",
            severity="warning",
        )
