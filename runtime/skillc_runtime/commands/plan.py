"""Plan for a task or a goal; nothing moves.

Says whether the plan is proved optimal: by the time that all steps take together, or by the time at which the last one
is over.

Exit code 3 when there is no plan.
"""

from __future__ import annotations

import sys
from pathlib import Path

import click

from skillc_runtime.commands import _keeping, _planners

SECONDS = click.FloatRange(min=0.1)


@click.command()
@click.argument("task", required=False)
@click.option("--scene", type=click.Path(path_type=Path), help="The scene to plan in, instead of a task's.")
@click.option("--goal", help="The goal, as in a .skill file or as PDDL.")
@click.option("--library", type=click.Path(path_type=Path), help="The skills to plan with, if not the shipped ones.")
@_keeping.options
@_planners.options
@click.option("--prove", is_flag=True, help="Take in more of a large scene until the plan is proved optimal.")
@click.option("--deadline", type=SECONDS, default=30.0, show_default=True, help="Seconds the planner may take.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON document.")
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
) -> None:
    """Plan for TASK (`LIBRARY:NAME`, or a shipped task), or for a goal in a scene."""
    from skillc_runtime.commands import _mission, _plans
    from skillc_runtime.execution.assignment import AchieveGoal
    from skillc_runtime.planning.plan import GaveUp, Unsolvable

    if task is not None and (scene or goal or library):
        raise click.UsageError("a TASK has its own scene, goal and library; leave the options out")
    if task is None and ((scene or store) is None or goal is None):
        raise click.UsageError("say either a TASK or --scene FILE (or --store) with --goal TEXT")
    if prove and minimise != "work":
        raise click.UsageError("--prove goes with --minimise work; by makespan an answer says what is known")
    keeping = _keeping.keeping(store, reset)
    mission = _mission.of_task(task, keeping) if task else _mission.of_scene(scene, goal, None, library, keeping)
    assignment = mission.assignment
    if not isinstance(assignment.objective, AchieveGoal):
        raise click.UsageError(f"the task `{assignment.name}` says itself what to do; run it with `skillc run`")
    measure: _plans.Measure = "makespan" if minimise == "makespan" else "proven work" if prove else "work"
    with _planners.patience(deadline):
        answer = _plans.answer(mission, assignment.objective.goal, measure, _planners.planners(plan_cache), deadline)
    click.echo(_plans.as_json(answer, mission) if as_json else _plans.as_text(answer, mission))
    sys.exit(3 if isinstance(answer, Unsolvable | GaveUp) else 0)
