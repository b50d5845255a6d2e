"""Children of a `par` that get into each other's way.

Two skills that run together must not write the same fact differently, since the last one would win, and must not both
have the same device for themselves (`uses`), since the second could not start. A skill that `shares` an arm adds to
the motion of whoever uses it; that is no conflict.

Bad:

    use rparts
    import "motion.skill"
    skill Wave { in arm: ArmDevice  in to: Pose  noplan }
    impl both of Wave {
        do par all {
            MoveTo(arm, target: to)
            TakePosture(arm)
        }
    }

Good:

    use rparts
    import "motion.skill"
    skill Wave { in arm: ArmDevice  in to: Pose  noplan }
    impl both of Wave {
        do seq {
            MoveTo(arm, target: to)
            TakePosture(arm)
        }
    }
"""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.typed import Program
from skillc_compiler.proof.findings import Clash
from skillc_compiler.proof.proving import found
from skillc_dsl.diagnostics import Diagnostic, Label

NAMES = ("parallel-conflict",)


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for the first two calls in each two children that clash."""
    for one in found(program, Clash):
        first, second = one.first.written.skill, one.second.written.skill
        yield Diagnostic(
            "parallel-conflict",
            second.span,
            f"`{second.text}` runs beside `{first.text}`, and {one.what}",
            help="let one follow the other in a `seq`",
            labels=(Label(first.span, "beside this one"),),
        )
