"""Plan for a task or a goal, without running it.

Prints whether the plan is proved optimal, in total work or in makespan.

Exit code 3 if no plan is found.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import click

from skillc.cli.command import Command
from skillc.cli.completions import complete_task
from skillc.cli.options import PATH, json_option, planner_options, store_options
from skillc.cli.settings import output_settings

if TYPE_CHECKING:
    from skillc.services.planning import Measure

NOTICE_AFTER_S = 2.0


@click.command(cls=Command)
@click.argument("task", required=False, shell_complete=complete_task)
@click.option("--scene", type=PATH, help="The scene to plan in; by default the task's.")
@click.option("--goal", help="The goal to plan for, as a condition or as PDDL.")
@click.option("--library", type=PATH, help="The library with the skills to plan with; by default the shipped one.")
@store_options
@planner_options
@click.option("--prove", is_flag=True, help="Include more of a large scene until the plan is proved optimal.")
@click.option(
    "--deadline",
    type=click.FloatRange(min=0.1),
    default=30.0,
    show_default=True,
    help="Time limit of the planner, in seconds.",
)
@json_option
def command(
    task: str | None,
    scene: Path | None,
    goal: str | None,
    library: Path | None,
    store: str | None,
    reset: bool,
    minimise: str,
    plan_cache: bool,
    prove: bool,
    deadline: float,
    as_json: bool,
) -> int:
    """Plan for TASK (`LIBRARY:NAME`, or one of the project here, or a shipped one), or for --goal in --scene."""
    from skillc.cli.console import Terminal
    from skillc.cli.plan_output import format_plan, plan_as_json
    from skillc.services.planning import plan_goal, prepare_planners
    from skillc.services.stores import StoreChoice
    from skillc.services.task_loading import TaskRequest, load_task
    from skillc_runtime.cancellation import CancelToken
    from skillc_runtime.planning.plan import GaveUp, Unsolvable

    request = TaskRequest(task, scene, goal, None, library, StoreChoice(store, reset)).with_defaults()
    request.check(calls=False)
    if prove and minimise != "work":
        raise click.UsageError("--prove requires --minimise work; for makespan the answer always has a lower bound")
    measure: Measure = "makespan" if minimise == "makespan" else "proven work" if prove else "work"
    with load_task(request, Terminal()) as loaded:
        with _notice_if_slow(deadline):
            answer = plan_goal(loaded, measure, prepare_planners(plan_cache), CancelToken(deadline))
        click.echo(plan_as_json(answer, loaded) if as_json else format_plan(answer, loaded))
    return 3 if isinstance(answer, Unsolvable | GaveUp) else 0


@contextmanager
def _notice_if_slow(deadline_s: float) -> Iterator[None]:
    """Print to stderr that planning is in progress once it has taken longer than NOTICE_AFTER_S."""
    text = f"planning, for at most {deadline_s:g} s .."
    wanted = not output_settings().quiet
    notice = threading.Timer(NOTICE_AFTER_S, lambda: click.echo(text, err=True) if wanted else None)
    notice.daemon = True
    notice.start()
    try:
        yield
    finally:
        notice.cancel()
