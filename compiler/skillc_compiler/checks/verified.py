"""Properties of every execution, which `verify` lines state.

What must not be (`never A`, `A outside B`, the second of `A before B`) counts from the start of a skill; what must
have been counts once it has succeeded. `after A eventually B` speaks of executions that succeed. Skills that are
called are looked into. A condition is looked at between the nodes of the implementation. `verify never CONDITION` and
`verify never force > 25 N`, which speaks of the measured contact force, are watched while the skill runs too: it
fails when they happen.

## verify-violated: some execution violates a property

Bad:

    use skillc
    import "compliance.skill"
    skill Feel { in arm: CompliantArm  in surface: Surface  noplan }
    impl pressing of Feel {
        do seq {
            Align(arm, surface)
            with Compliance(arm, along: surface.normal) { wait 1 s }
        }
        verify never Align outside Compliance
    }

Good:

    use skillc
    import "compliance.skill"
    skill Feel { in arm: CompliantArm  in surface: Surface  noplan }
    impl pressing of Feel {
        do seq {
            with Compliance(arm, along: surface.normal) { Align(arm, surface) }
            wait 1 s
        }
        verify never Align outside Compliance
    }

## verify-undecided: a property is neither proved nor refuted

Bad:

    use skillc
    import "compliance.skill"
    skill Feel { in arm: CompliantArm  in surface: Surface  noplan }
    impl pressing of Feel {
        do Align(arm, surface)
        verify never Align outside surface.located == false
    }

Good:

    use skillc
    import "compliance.skill"
    skill Feel { in arm: CompliantArm  in surface: Surface  noplan }
    impl pressing of Feel {
        do seq {
            check(surface.located == false)
            Align(arm, surface)
        }
        verify never Align outside surface.located == false
    }
"""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.typed import Program
from skillc_compiler.proof.findings import Unverified, Violated
from skillc_compiler.proof.proving import found
from skillc_compiler.proof.trail import labels
from skillc_dsl.diagnostics import Diagnostic

NAMES = ("verify-violated", "verify-undecided")


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each property that does not hold in all executions, or is not known to."""
    for one in found(program, Violated):
        yield Diagnostic(
            "verify-violated",
            one.property.span,
            f"an execution violates `{one.property.text.removeprefix('verify ')}`",
            help="change the body so that this way cannot be taken, or the property",
            labels=labels(one.way),
        )
    for two in found(program, Unverified):
        yield Diagnostic(
            "verify-undecided",
            two.property.span,
            f"it is not known whether `{two.property.text.removeprefix('verify ')}` holds",
            help="look before, with `check(..)`, or make skills of parts of the body",
            severity="warning",
        )
