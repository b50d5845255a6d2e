"""The options that say how plans are found; nothing heavy is imported here."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeVar

import click

if TYPE_CHECKING:
    from skillc_runtime.commands._mission import Mission
    from skillc_runtime.planning.planners import Planners

Command = TypeVar("Command", bound=Callable[..., Any])

WONDER_S = 2.0
MEASURES = ("work", "makespan")


def options(command: Command) -> Command:
    """Add `--minimise` and `--no-plan-cache` to a command, which gets them as `minimise` and `plan_cache`."""
    cache = click.option(
        "--plan-cache/--no-plan-cache", default=True, help="Take plans that were found before for the same problem."
    )
    measure = click.option(
        "--minimise",
        type=click.Choice(MEASURES),
        default=MEASURES[0],
        show_default=True,
        help="The time that all steps take together, or the time until the last one is over.",
    )
    return cache(measure(command))


def planners(plan_cache: bool) -> Planners:
    """Return the planners of this installation, with the answers that they gave before."""
    from skillc_runtime.commands._shelf import user_shelf
    from skillc_runtime.planning.planners import find_planners

    return find_planners(user_shelf() if plan_cache else None)


@contextmanager
def patience(deadline_s: float) -> Iterator[None]:
    """Say on stderr that planning goes on, once it has taken so long that somebody may wonder."""
    text = f"planning, for {deadline_s:g} s at most .."
    talk = threading.Timer(WONDER_S, lambda: click.echo(text, err=True))
    talk.daemon = True
    talk.start()
    try:
        yield
    finally:
        talk.cancel()


def aimed(mission: Mission, minimise: str) -> Mission:
    """Return a mission whose plan is to have little of that; UsageError where there is nothing to plan."""
    from skillc_runtime.execution.assignment import AchieveGoal

    if minimise == "work":
        return mission
    if not isinstance(mission.assignment.objective, AchieveGoal):
        raise click.UsageError(f"`{mission.assignment.name}` says itself what to do: there is no plan to minimise")
    aim = AchieveGoal(mission.assignment.objective.goal, "makespan")
    return replace(mission, assignment=replace(mission.assignment, objective=aim))
