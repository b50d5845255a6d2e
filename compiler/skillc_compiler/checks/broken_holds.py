"""A child that breaks a hold of the skill it runs in.

A `hold` must be true for as long as the skill runs. When it breaks, the whole body is halted and the skill fails.
What the last child does, when nothing runs after it any more, breaks nothing. It is a warning where the hold may
break only because two names may stand for the same individual, or because a child that failed may have left the world
half changed.

Bad:

    use rparts, skiros
    import "gripper.skill"
    skill Drop {
        in   arm:     ArmDevice
        in   gripper: GripperEffector
        in   object:  Product
        in   to:      Location
        hold gripper contain object
        post to contain object
        post not gripper contain object
        noplan
    }
    impl waiting of Drop { do seq { Release(arm, gripper, object, to) wait 1 s } }

Good:

    use rparts, skiros
    import "gripper.skill"
    skill Drop {
        in   arm:     ArmDevice
        in   gripper: GripperEffector
        in   object:  Product
        in   to:      Location
        hold gripper contain object
        post to contain object
        post not gripper contain object
        noplan
    }
    impl waiting of Drop { do seq { wait 1 s Release(arm, gripper, object, to) } }
"""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.typed import Program
from skillc_compiler.proof.findings import BrokenHold
from skillc_compiler.proof.proving import found
from skillc_compiler.proof.trail import labels
from skillc_dsl.diagnostics import Diagnostic, Label

NAMES = ("hold-broken",)


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each hold that a child breaks while others still follow."""
    for one in found(program, BrokenHold):
        verb = "breaks" if one.certain else "may break"
        yield Diagnostic(
            "hold-broken",
            one.span,
            f"this {verb} the hold `{one.hold.text}` while the skill still runs",
            help="do it last, or take the `hold` away" if one.certain else "say in a `pre` what rules that out",
            severity="error" if one.certain else "warning",
            labels=(Label(one.hold.span, "must hold all the time"), *labels(one.way)),
        )
