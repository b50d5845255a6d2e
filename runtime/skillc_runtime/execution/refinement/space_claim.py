"""What a refinement of a plan claims."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.recording.space_claim import SpaceClaim, UnseenCall

if TYPE_CHECKING:
    from skillc_runtime.execution.refinement.plan_refinement import PlanRefinement


def make_claim(found: PlanRefinement, steps: int, from_home: bool = True) -> SpaceClaim:
    """Return what a refinement of so many steps says; `from_home` if the arms begin at home."""
    failure = None
    if found.failed is not None:
        failure = "no way was found" if found.failure is None else found.failure.message
    return SpaceClaim(
        checked=len(found.steps),
        steps=steps,
        unseen=tuple(UnseenCall(number, call) for number, each in enumerate(found.steps, 1) for call in each.unseen),
        chosen=tuple(number for number, each in enumerate(found.steps, 1) if any(one.chosen for one in each.motions)),
        failure=failure,
        from_home=from_home,
    )
