"""Run a task in simulation and report.

Plans if there is a goal, chooses implementations by what the world model knows, executes.

Exit code 3 when the task does not succeed; with --strict also when nothing has sensed that it did.
"""

from __future__ import annotations

from pathlib import Path

import click

from skillc.cli.command import Command
from skillc.cli.options import FOLDER, PATH, json_option, looks_option, planner_options, store_options


@click.command(cls=Command)
@click.argument("task", required=False)
@click.option("--scene", type=PATH, help="The scene to run in, instead of a task's.")
@click.option("--goal", help="The goal to plan for, as in a .skill file or as PDDL.")
@click.option("--skill", help="A call to run instead of a goal, as `Wipe(surface: lab:Table-1)`.")
@click.option("--library", type=PATH, help="The skills to use, if not the shipped ones.")
@click.option("--out", type=FOLDER, help="A folder for report.html, events.jsonl, the figure, the film and stills.")
@looks_option
@store_options
@planner_options
@click.option("--seed", default=0, show_default=True, help="How reality differs from the world model.")
@click.option("--real-time", is_flag=True, help="Let simulated time pass no faster than the clock.")
@click.option("--strict", is_flag=True, help="Exit with code 3 as well where the success rests on an assumption.")
@json_option
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
) -> int:
    """Run TASK (`LIBRARY:NAME`, or a shipped task), or a goal or a call in a scene."""
    from skillc.cli.console import Terminal, print_json
    from skillc.cli.run_output import print_results, run_with_progress
    from skillc.services import task_loading
    from skillc.services.files import check_writable
    from skillc.services.planning import prepare_planners, with_minimal_makespan
    from skillc.services.running import RunOptions
    from skillc.services.stores import StoreChoice

    request = task_loading.TaskRequest(task, scene, goal, skill, library, StoreChoice(store, reset))
    request.check()
    options = RunOptions(out, seed, prepare_planners(plan_cache), looks)
    check_writable(out)
    with task_loading.load_task(request, Terminal()) as loaded:
        wanted = with_minimal_makespan(loaded) if minimise == "makespan" else loaded
        ran = run_with_progress(wanted, options, as_json, real_time)
    if as_json:
        print_json(ran.result)
    else:
        print_results([ran.result], out if ran.written else None)
    if ran.result.status != "success" or (strict and not ran.result.verified):
        return 3
    return 0 if ran.written else 1
