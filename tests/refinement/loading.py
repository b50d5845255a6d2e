"""Plans of shipped tasks and how the arms carry them out."""

from skillc.services.planning.planning import plan_goal, prepare_planners
from skillc.services.reporting.reporter import Reporter
from skillc.services.tasks.loading import load_task
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.execution.refinement.plan_refinement import PlanRefinement, refine_plan
from skillc_runtime.planning.plan import Solved
from skillc_runtime.recording.run_spec import RunSpec


class Silent(Reporter):
    """Says nothing."""

    def __getattribute__(self, name: str) -> object:
        return lambda *arguments, **named: None


def refined(task: str) -> PlanRefinement:
    """Return how the arms carry out the plan of a task."""
    with load_task(RunSpec(task=task), Silent()) as loaded:  # type: ignore[abstract]
        answer = plan_goal(loaded, prepare_planners(False), CancelToken(30.0))
        assert isinstance(answer, Solved)
        return refine_plan(loaded.library, loaded.assignment.state, answer.plan.steps)
