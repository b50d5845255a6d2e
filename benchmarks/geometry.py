"""Plans looked at in space: processor time a step, and what feedback to the planner solves that a look alone does not.

A part lies under others, in a cell with boxes to put them into. With feedback, what does not go is excluded while what
is in its way stands there, and planned again; without, the first plan is looked at and that is all.
"""

from __future__ import annotations

import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time
from typing import Any

from skillc.services.planning.planning import plan_goal, prepare_planners
from skillc.services.reporting.reporter import Reporter
from skillc.services.tasks.loading import LoadedTask, load_task
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.execution.refinement.plan_refinement import refine_plan
from skillc_runtime.execution.refinement.replanning import plan_in_space
from skillc_runtime.planning.plan import GaveUp, Unsolvable
from skillc_runtime.recording.run_spec import RunSpec
from skillc_skills import sorting

TASKS = (
    "wiping:clean_table",
    "wiping:clean_whiteboard",
    "wiping:clean_both",
    "sorting:sort_parts",
    "sorting:sort_shapes",
)
PART_B = "skillc:on lab:Table ; skillc:atX 0.0 ; skillc:atY -0.2 ."
LIMIT_S = 300.0


class Silent(Reporter):
    """Says nothing."""

    def __getattribute__(self, name: str) -> object:
        return lambda *arguments, **named: None


def measure_task(task: str) -> str:
    """Return what it costs to look at the plan of a shipped task, for the first time and again."""
    with load_task(RunSpec(task=task), Silent()) as loaded:  # type: ignore[abstract]
        answer = plan_goal(loaded, prepare_planners(True), CancelToken(LIMIT_S))
        assert not isinstance(answer, Unsolvable | GaveUp)
        steps, times = answer.plan.steps, list[float]()
        for _ in range(2):
            began = process_time()
            found = refine_plan(loaded.library, loaded.assignment.state, steps)
            times.append((process_time() - began) / len(steps))
    first, again = (f"{1e3 * each:.0f}" for each in times)
    return f"{task}: {len(found.steps)} of {len(steps)} steps go; {first} ms a step, {again} again"


def pile(count: int) -> str:
    """Return a cell in which so many parts lie on Part-A, and boxes to put them into."""
    text = (Path(sorting.__path__[0]) / "panda.ttl").read_text().replace(PART_B, "skillc:on lab:Part-A .")
    below, more = "lab:Part-B", list[str]()
    for number in range(2, count + 1):
        more.append(
            f"lab:Cell skiros:contain lab:Box-{number} .\nlab:Box-{number} a sorting:Box ; skiros:SizeX 0.26 ; "
            f"skiros:SizeY 0.26 ; skiros:SizeZ 0.05 ; skillc:on lab:Table ; skillc:atX 0.12 ; "
            f"skillc:atY {0.3 * number - 0.6:.2f} ."
        )
        more.append(
            f"lab:Cell skiros:contain lab:Part-{number} .\nlab:Part-{number} a sorting:WorkPart ; skiros:SizeX 0.03 ; "
            f"skiros:SizeY 0.03 ; skiros:SizeZ 0.04 ; skiros:Weight 0.1 ; skillc:on {below} ."
        )
        below = f"lab:Part-{number}"
    return "\n".join([text, *more])


def measure_pile(count: int, folder: Path) -> str:
    """Return what is solved with feedback and without, and how long it takes."""
    scene = folder / f"pile{count}.ttl"
    scene.write_text(pile(count))
    spec = RunSpec(scene=str(scene), library="sorting", goal="lab:Box-A contain lab:Part-A")
    with load_task(spec, Silent()) as loaded:  # type: ignore[abstract]
        alone = refine_plan(loaded.library, loaded.assignment.state, _plan(loaded, ()).plan.steps)
        rounds = 0

        def plan(without: Any) -> Any:
            nonlocal rounds
            rounds += 1
            return plan_goal(loaded, prepare_planners(False), token, without=without)

        token, began = CancelToken(LIMIT_S), process_time()
        answer, found = plan_in_space(loaded.library, loaded.assignment.state, plan, token)
        seconds = process_time() - began
    solved = found is not None and found.failed is None and not isinstance(answer, Unsolvable | GaveUp)
    steps = len(answer.plan.steps) if solved else 0
    return (
        f"{count} on top: alone {len(alone.steps)} steps go; with feedback {'all ' + str(steps) if solved else 'none'} "
        f"after {rounds} plans, {seconds:.1f} s without the planner's own"
    )


def _plan(loaded: LoadedTask, without: tuple[()]) -> Any:
    return plan_goal(loaded, prepare_planners(True), CancelToken(LIMIT_S), without=without)


if __name__ == "__main__":
    for name in TASKS:
        print(measure_task(name))
    with TemporaryDirectory() as there:
        for height in range(1, int(sys.argv[1]) + 1 if len(sys.argv) > 1 else 4):
            print(measure_pile(height, Path(there)))
