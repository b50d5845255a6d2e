"""Makes pictures of plans, as nested boxes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import assert_never

from skillc.errors import RequestError
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_library
from skillc.services.planning.plan_text import describe_expected
from skillc.services.planning.planning import plan_goal
from skillc.services.reporting.reporter import Reporter
from skillc.services.tasks.loading import load_task
from skillc_compiler.emit.picture.boxes import PictureBox
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.execution.assignment import AchieveGoal
from skillc_runtime.planning.plan import GaveUp, Solved, Unsolvable
from skillc_runtime.planning.planners import find_planners
from skillc_runtime.planning.schedule import DEADLINE_S, Scheduled
from skillc_runtime.recording.run_spec import RunSpec


def draw_plan(path: Path, task: str, reporter: Reporter) -> PictureBox | Unsolvable | GaveUp:
    """Plan for a task of the library at `path` and return the picture of the plan. RequestError without a goal."""
    library = compile_valid(find_library(path))
    if task in library.skills and task not in library.tasks:
        raise RequestError(f"`{task}` is a skill, and plans are for goals of tasks; draw it without --plan")
    with load_task(RunSpec(task=f"{path}:{task}"), reporter) as loaded:
        aim, state = loaded.assignment.objective, loaded.assignment.state
        if not isinstance(aim, AchieveGoal):
            raise RequestError(f"the task `{task}` has a body, not a goal; draw it without --plan")
        answer = plan_goal(loaded, find_planners(), CancelToken(DEADLINE_S))
    match answer:
        case Solved(plan=plan) | Scheduled(plan=plan):
            steps = (_step(step.skill, step.arguments, state.vocabulary.short) for step in plan.steps)
            return PictureBox("flow", "→", "plan", (describe_expected(answer),), tuple(steps))
        case Unsolvable() | GaveUp():
            return answer
        case _:
            assert_never(answer)


def _step(skill: str, arguments: Mapping[str, str], short: Callable[[str], str]) -> PictureBox:
    bound = ", ".join(f"{name}: {short(iri)}" for name, iri in arguments.items())
    return PictureBox("call", "▶", skill, (bound,) if bound else (), (), skill)
