"""The plan of a task as boxes of its picture."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import assert_never

import click

from skillc_compiler.emit.picture.boxes import Box
from skillc_runtime.commands import _mission
from skillc_runtime.execution.assignment import AchieveGoal
from skillc_runtime.planning.plan import GaveUp, Solved, Unsolvable, describe_quality
from skillc_runtime.planning.solve import solve


class NoPlan(Exception):
    """There is none, or none was found; the message says which, and why."""


def planned(path: Path, task: str) -> Box:
    """Plan for a task of the library at `path` and return the steps in a box.

    NoPlan when there is none, UsageError when it is no task or has no goal.
    """
    mission = _mission.of_task(f"{path}:{task}")
    aim, state = mission.assignment.objective, mission.assignment.state
    if not isinstance(aim, AchieveGoal):
        raise click.UsageError(f"the task `{task}` says itself what to do; draw it without --plan")
    answer = solve(mission.library, state, aim.goal)
    match answer:
        case Solved(plan=plan):
            good = describe_quality(answer.optimal, answer.left_out, answer.at_least_s)
            steps = (_step(step.skill, step.arguments, state.vocabulary.short) for step in plan.steps)
            return Box("flow", "→", "plan", (f"{plan.duration_s:g} s expected, {good}",), tuple(steps))
        case Unsolvable() | GaveUp():
            raise NoPlan(answer.message)
        case _:
            assert_never(answer)


def _step(skill: str, arguments: Mapping[str, str], short: Callable[[str], str]) -> Box:
    bound = ", ".join(f"{name}: {short(iri)}" for name, iri in arguments.items())
    return Box("call", "▶", skill, (bound,) if bound else (), (), skill)
