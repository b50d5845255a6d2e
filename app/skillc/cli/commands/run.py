"""Run a task in simulation.

Plans if there is a goal, chooses implementations by the facts of the world model, and executes.

Exit code 3 if the task does not succeed, or if the simulator contradicts what the world model claims at its end; with
--strict also if its success was not sensed.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from skillc.cli.command import Command
from skillc.cli.completions import complete_scene, complete_task
from skillc.cli.options import (
    BACKEND,
    EXECUTION,
    FOLDER,
    OUTPUT,
    PATH,
    film_option,
    gif_option,
    grouped_option,
    json_option,
    looks_option,
    operating_options,
    planner_options,
    store_options,
    task_arguments,
)

if TYPE_CHECKING:
    from skillc.services.backends import BackendName
    from skillc.services.signal_files import SignalFormat
    from skillc_runtime.execution.pace import Pace

EXAMPLES = """
skillc run clean_table --out out
skillc run contact:press_button --seed 3 --pace real
skillc run --scene cell.ttl --goal "lab:Bin-A contain lab:Part-1"
skillc run clean_table --pause-at Wipe
"""


@click.command(cls=Command, examples=EXAMPLES)
@click.argument("task", required=False, shell_complete=complete_task)
@task_arguments()
@click.option("--goal", metavar="CONDITION", help="Run without a task: plan for this goal, a condition or PDDL.")
@click.option("--skill", metavar="CALL", help="Run without a task: call a skill, as in `Wipe(surface: lab:Table-1)`.")
@click.option("--scene", type=PATH, shell_complete=complete_scene, help="The scene of --goal or --skill.")
@click.option("--library", type=PATH, help="The library of --goal or --skill; by default that here, or `wiping`.")
@grouped_option(
    OUTPUT,
    "--out",
    type=FOLDER,
    help="Write report.html, result.json, events.jsonl, figures, the film and stills to this folder.",
)
@click.option(
    "--signals",
    type=click.Choice(["csv", "parquet"]),
    help="Record forces, poses, joints and references, 100 samples a second, to the folder of --out.",
)
@film_option
@looks_option
@gif_option
@store_options
@planner_options
@grouped_option(
    EXECUTION,
    "--seed",
    default=0,
    show_default=True,
    metavar="N",
    help="The seed of what differs from the world model.",
)
@grouped_option(
    EXECUTION,
    "--backend",
    type=BACKEND,
    default="mujoco",
    show_default=True,
    help="Run in a cell of this backend: `mujoco` simulates with physics, `kinematic` with ideal motion and contact, "
    "faster, but contact is not verified then; packages add others.",
)
@grouped_option(
    EXECUTION,
    "--tick-timeout",
    type=click.FloatRange(min=0.0),
    metavar="SECONDS",
    default=30.0,
    show_default=True,
    help="End the run if a tick takes longer than this many seconds of wall time; 0 lets it take any time.",
)
@operating_options
@grouped_option(EXECUTION, "--strict", is_flag=True, help="Exit with code 3 also if success rests on an assumption.")
@json_option
def command(
    task: str | None,
    arguments: dict[str, str],
    scene: Path | None,
    goal: str | None,
    skill: str | None,
    library: Path | None,
    out: Path | None,
    signals: SignalFormat | None,
    no_film: bool,
    looks: str,
    gif: bool,
    store: str | None,
    reset: bool,
    minimise: str,
    plan_cache: bool,
    seed: int,
    backend: BackendName,
    tick_timeout: float,
    pace: Pace,
    deadline: float | None,
    step_deadline: float | None,
    step: bool,
    pause_at: tuple[str, ...],
    strict: bool,
    as_json: bool,
) -> int:
    """Run TASK in simulation: plan if it has a goal, choose implementations by the world model, and execute.

    TASK is the name of a task of the project here or of a shipped one, or LIBRARY:NAME; `skillc tasks` lists them. In a
    project, TASK may be left out if the manifest names a default one.
    """
    from skillc.cli.console import Terminal, print_json, remark_default
    from skillc.cli.run_output import check_operable, print_results, run_with_progress
    from skillc.services import task_loading
    from skillc.services.files import check_writable
    from skillc.services.planning import prepare_planners, with_minimal_makespan
    from skillc.services.running import RunOptions
    from skillc.services.stores import StoreChoice

    kept = StoreChoice(store, reset, writes=True)
    request = task_loading.TaskRequest(task, scene, goal, skill, library, kept, arguments).with_defaults()
    remark_default(task, request.task)
    request.check()
    options = RunOptions(
        out,
        seed,
        prepare_planners(plan_cache),
        looks,
        tick_timeout,
        as_json,
        deadline,
        step_deadline,
        step,
        pause_at,
        backend,
        signals,
        gif,
        not no_film,
    )
    check_operable(options)
    check_writable(out)
    with task_loading.load_task(request, Terminal()) as loaded:
        wanted = with_minimal_makespan(loaded) if minimise == "makespan" else loaded
        ran = run_with_progress(wanted, options, as_json, pace)
    if as_json:
        print_json(ran.result)
    else:
        print_results([ran.result], out if ran.written else None)
    if not ran.result.is_sound or (strict and not ran.result.verified):
        return 3
    return 0 if ran.written else 1
