"""Decides whether what is wrong in a cell keeps a task from starting."""

from __future__ import annotations

from pathlib import Path

from skillc.services.cell_checks.report import ScenePlaces, grade, locate, used_individuals
from skillc.services.cell_checks.verdicts import judge_state_once
from skillc.services.reporting.reporter import Reporter, find_texts
from skillc.services.tasks.loading import LoadedTask
from skillc_runtime.execution.assignment import AchieveGoal
from skillc_runtime.scene.load import read_scene
from skillc_runtime.scene.violation import SceneViolation


def find_start_problem(task: LoadedTask, reporter: Reporter) -> str | None:
    """Return what is so wrong with the things that a task uses that it cannot succeed, each with its place; else None.

    Everything else that is wrong in its cell is reported as warnings.
    """
    state, objective = task.assignment.state, task.assignment.objective
    item = objective.goal if isinstance(objective, AchieveGoal) else objective.body
    goals = (objective.goal,) if isinstance(objective, AchieveGoal) else ()
    found = list(grade(judge_state_once(state, goals), used_individuals(item, state)))
    if not found:
        return None
    places = _places(task)
    _warn([each for each in found if each.severity == "warning"], places, reporter)
    return "\n".join(_describe(each, places) for each in found if each.severity == "error") or None


def _places(task: LoadedTask) -> ScenePlaces:
    """Return where the scene of a task states something; nowhere if its world comes from a store."""
    if not task.scene:
        return ScenePlaces({})
    return ScenePlaces.of(read_scene(Path(task.scene), task.library.vocabulary).said, task.scene)


def _warn(found: list[SceneViolation], places: ScenePlaces, reporter: Reporter) -> None:
    located = [each.diagnostic for each in locate(found, places)]
    if located:
        reporter.show(located, find_texts(located, {}))
    for each in found:
        if places.find(each) is None:
            reporter.say(f"warning: {each.message}: {each.help}")


def _describe(violation: SceneViolation, places: ScenePlaces) -> str:
    span, text = places.find(violation), f"{violation.message}: {violation.help}"
    return text if span is None else f"{span.path}:{span.line}: {text}"
