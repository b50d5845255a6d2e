"""Run a task in simulation and report.

Plans if there is a goal, chooses implementations by what the world model knows, executes.

Exit code 3 when the task does not succeed; with --strict also when nothing has sensed that it did.
"""

from __future__ import annotations

import sys
from pathlib import Path

import click

from skillc_runtime.commands import _keeping, _looks, _planners

FOLDER = click.Path(path_type=Path, file_okay=False)


@click.command()
@click.argument("task", required=False)
@click.option("--scene", type=click.Path(path_type=Path), help="The scene to run in, instead of a task's.")
@click.option("--goal", help="The goal to plan for, as in a .skill file or as PDDL.")
@click.option("--skill", help="A call to run instead of a goal, as `Wipe(surface: lab:Table-1)`.")
@click.option("--library", type=click.Path(path_type=Path), help="The skills to use, if not the shipped ones.")
@click.option(
    "--out",
    type=FOLDER,
    help="A folder for report.html, events.jsonl, the figure, the film and stills.",
)
@_looks.option
@_keeping.options
@_planners.options
@click.option("--seed", default=0, show_default=True, help="How reality differs from the world model.")
@click.option("--real-time", is_flag=True, help="Let simulated time pass no faster than the clock.")
@click.option("--strict", is_flag=True, help="Exit with code 3 as well where the success rests on an assumption.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON document.")
def command(
    task: str | None,
    scene: Path | None,
    goal: str | None,
    skill: str | None,
    library: Path | None,
    out: Path | None,
    looks: str,
    store: str | None,
    reset: bool,
    minimise: str,
    plan_cache: bool,
    seed: int,
    real_time: bool,
    strict: bool,
    as_json: bool,
) -> None:
    """Run TASK (`LIBRARY:NAME`, or a shipped task), or a goal or a call in a scene."""
    from skillc_runtime.commands import _mission, _results, _running

    if task is not None and (scene or goal or skill or library):
        raise click.UsageError("a TASK has its own scene, goal and library; leave the options out")
    if task is None and ((scene or store) is None or (goal is None) == (skill is None)):
        raise click.UsageError("say either a TASK or --scene FILE (or --store) with --goal TEXT or --skill CALL")
    _looks.check(looks, out)
    keeping = _keeping.keeping(store, reset)
    _running.check_writable(out)
    mission = _mission.of_task(task, keeping) if task else _mission.of_scene(scene, goal, skill, library, keeping)
    options = _running.Options(out, seed, real_time, as_json, _planners.planners(plan_cache), looks)
    ran = _running.run(_planners.aimed(mission, minimise), options)
    if as_json:
        click.echo(_results.as_json(ran.result))
    else:
        _results.show([ran.result], out if ran.written else None)
    if ran.result.status != "success" or (strict and not ran.result.verified):
        sys.exit(3)
    sys.exit(0 if ran.written else 1)
