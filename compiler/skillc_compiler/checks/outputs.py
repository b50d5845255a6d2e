"""An output that is read, or handed out, where no call has given it a value.

## out-unassigned: an output is read where it may have no value

Bad:

    use rparts
    skill Measure { in arm: ArmDevice  out height: Length  noplan }
    impl waiting of Measure { run python "skillc_runtime.primitives.stand_in:StandIn" }
    skill Probe { in arm: ArmDevice  noplan }
    impl hasty of Probe {
        do seq {
            try { Measure(arm) -> height }
            check(height > 1 cm)
        }
    }

Good:

    use rparts
    skill Measure { in arm: ArmDevice  out height: Length  noplan }
    impl waiting of Measure { run python "skillc_runtime.primitives.stand_in:StandIn" }
    skill Probe { in arm: ArmDevice  noplan }
    impl careful of Probe {
        do seq {
            Measure(arm) -> height
            check(height > 1 cm)
        }
    }

## out-never-assigned: an implementation can succeed without giving an output a value

Bad:

    use rparts
    skill Measure { in arm: ArmDevice  out height: Length  noplan }
    impl waiting of Measure { run python "skillc_runtime.primitives.stand_in:StandIn" }
    skill Probe { in arm: ArmDevice  out height: Length  noplan }
    impl hasty of Probe { do try { Measure(arm) -> height } }

Good:

    use rparts
    skill Measure { in arm: ArmDevice  out height: Length  noplan }
    impl waiting of Measure { run python "skillc_runtime.primitives.stand_in:StandIn" }
    skill Probe { in arm: ArmDevice  out height: Length  noplan }
    impl careful of Probe { do Measure(arm) -> height }
"""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.typed import Program
from skillc_compiler.proof.findings import NeverAssigned, Unassigned
from skillc_compiler.proof.proving import found
from skillc_compiler.proof.trail import labels
from skillc_dsl.diagnostics import Diagnostic, Label

NAMES = ("out-unassigned", "out-never-assigned")


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each reading too early and each output left without a value."""
    for one in found(program, Unassigned):
        yield Diagnostic(
            "out-unassigned",
            one.span,
            f"`{one.name}` has no value here on every path",
            help=f"assign it before, with `-> {one.name}` on a call that always runs",
            labels=labels(one.way),
        )
    for two in found(program, NeverAssigned):
        name = two.parameter.name
        yield Diagnostic(
            "out-never-assigned",
            two.implementation.name_span,
            f"`{two.implementation.name}` does not give the output `{name}` a value on every path",
            help=f"take it from a call: `.. -> {name}`",
            labels=(Label(two.parameter.span, "declared here"), *labels(two.way)),
        )
