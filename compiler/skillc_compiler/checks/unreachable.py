"""A node that never starts, whatever its neighbours do.

It stands after a node that cannot succeed, or in a `sel` after one that cannot fail, or in the branch of a condition
that is decided beforehand.

Bad:

    use skillc
    import "compliance.skill"
    skill Touch { in arm: CompliantArm  in surface: Surface  noplan }
    impl patient of Touch {
        do sel {
            try { Align(arm, surface) }
            wait 2 s
        }
    }

Good:

    use skillc
    import "compliance.skill"
    skill Touch { in arm: CompliantArm  in surface: Surface  noplan }
    impl patient of Touch {
        do sel {
            Align(arm, surface)
            wait 2 s
        }
    }
"""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.typed import Program
from skillc_compiler.proof.findings import Unreachable
from skillc_compiler.proof.proving import found
from skillc_dsl.diagnostics import Diagnostic

NAMES = ("unreachable-node",)


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for the first of several nodes that never start."""
    for one in found(program, Unreachable):
        yield Diagnostic(
            "unreachable-node",
            one.step.written.span,
            "this never starts: what comes before it always ends otherwise",
            help="take it away, or look again at the node before it",
            severity="warning",
        )
