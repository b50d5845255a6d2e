"""Looks at a plan in space, and says which of its steps the arms can carry out, and why not the others."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from skillc.extras import missing_extras
from skillc.services.planning import Answer, Measure, plan_goal
from skillc.services.task_loading import LoadedTask
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.plan import Excluded, GaveUp, Unsolvable
from skillc_runtime.planning.planners import Planners
from skillc_runtime.planning.progress import ReportProgress
from skillc_runtime.world.state.terms import ARM_DEVICE

if TYPE_CHECKING:
    from skillc_runtime.execution.refinement.plan_refinement import PlanRefinement


@dataclass(frozen=True, slots=True)
class SpaceClaim:
    """How many steps of a plan go in space, of how many; calls that were not looked at, by step; why the next fails.

    chosen: the steps that go only with another posture than the one nearest to home.
    """

    checked: int
    steps: int
    unseen: tuple[tuple[int, str], ...] = ()
    chosen: tuple[int, ...] = ()
    failure: str | None = None

    @property
    def text(self) -> str:
        """The claim, with a line for each step that was not looked at or does not go."""
        looked = self.checked - len({number for number, _ in self.unseen} | {*self.chosen})
        of = f"all {self.steps}" if looked == self.steps else f"{looked} of {self.steps}"
        lines = [f"{of} checked in space: reach, joints, torques, paths, room; the arms begin at home"]
        lines += (f"step {number}: nobody says what {what} needs of space" for number, what in self.unseen)
        lines += (
            f"step {number} goes only with another posture than the nearest one to home" for number in self.chosen
        )
        if self.failure is not None:
            lines.append(f"step {self.checked + 1} does not go: {self.failure}")
        return "\n".join(lines)

    @property
    def data(self) -> dict[str, object]:
        """The claim as plain data."""
        unseen = [{"step": number, "what": what} for number, what in self.unseen]
        return {
            "checked": self.checked,
            "steps": self.steps,
            "unseen": unseen,
            "chosen": list(self.chosen),
            "failure": self.failure,
        }


def plan_goal_in_space(
    loaded: LoadedTask, measure: Measure, planners: Planners, cancel: CancelToken, report: ReportProgress
) -> tuple[Answer, SpaceClaim | None]:
    """Plan as `plan_goal` does, for a plan that the arms can carry out; return it and what is known of it in space.

    None if there is no arm, or if nothing is known because that is not installed which looks at it.
    """

    def plan(without: Sequence[Excluded]) -> Answer:
        return plan_goal(loaded, measure, planners, cancel, report, without)

    if missing_extras("run") or not loaded.assignment.state.instances(ARM_DEVICE):
        return plan(()), None
    # The simulator is slow to import.
    from skillc_runtime.execution.refinement.replanning import plan_in_space

    answer, found = plan_in_space(loaded.library, loaded.assignment.state, plan, cancel)
    if found is None or isinstance(answer, Unsolvable | GaveUp):
        return answer, None
    return answer, make_claim(found, len(answer.plan.steps))


def make_claim(found: PlanRefinement, steps: int) -> SpaceClaim:
    """Return what a refinement of so many steps says."""
    unseen = tuple((number, call) for number, each in enumerate(found.steps, 1) for call in each.unseen)
    chosen = tuple(number for number, each in enumerate(found.steps, 1) if any(one.chosen for one in each.motions))
    failure = None
    if found.failed is not None:
        failure = "no way was found" if found.failure is None else found.failure.message
    return SpaceClaim(len(found.steps), steps, unseen, chosen, failure)
