"""What a refinement of a plan claims."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from skillc_runtime.recording.space_claim import ChosenPosture, SpaceClaim, StandAt, UnseenCall
from skillc_runtime.world.state.labelling import label_pose

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
        postures=tuple(_list_postures(found)),
        apart=found.apart,
        stands=tuple(
            StandAt(number, each.robot, each.place, each.x_m, each.y_m, each.yaw_rad)
            for number, step in enumerate(found.steps, 1)
            for each in step.stands
        ),
        failure=failure,
        from_home=from_home,
    )


def _list_postures(found: PlanRefinement) -> Iterator[ChosenPosture]:
    for number, step in enumerate(found.steps, 1):
        for each in step.motions:
            if each.tool is not None:
                q = tuple(each.postures[-1].tolist())
                yield ChosenPosture(number, each.arm, q, label_pose(each.tool))
