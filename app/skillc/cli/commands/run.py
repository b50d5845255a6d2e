"""Run a task, in simulation or on a robot.

Plans if there is a goal, chooses implementations by the facts of the world model, and executes.

Exit code 3 if the task does not succeed, or if the simulator contradicts what the world model claims at its end; with
--strict also if its success was not sensed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from skillc.cli.command import Command
from skillc.cli.completions import complete_task
from skillc.cli.options import EXECUTION, grouped_option, json_option, store_options, task_arguments
from skillc.cli.run_options import run_options
from skillc_dsl.importing import importing

if TYPE_CHECKING:
    from skillc_runtime.recording.run_spec import RunSpec

EXAMPLES = """
skillc run clean_table --out out
skillc run contact:press_button --seed 3 --pace real
skillc run --scene cell.ttl --goal "lab:Box-A contain lab:Part-A"
skillc run clean_table --breakpoints Wipe
skillc run clean_table --speed 10% --confirm-steps
"""


@click.command(cls=Command, examples=EXAMPLES)
@click.argument("task", required=False, shell_complete=complete_task)
@task_arguments()
@store_options
@run_options()
@grouped_option(
    EXECUTION,
    "--tick-timeout",
    type=click.FloatRange(min=0.0),
    metavar="SECONDS",
    default=30.0,
    show_default=True,
    help="End the run if a tick takes longer than this many seconds of wall time; 0 lets it take any time.",
)
@grouped_option(EXECUTION, "--strict", is_flag=True, help="Exit with code 3 also if success rests on an assumption.")
@json_option
def command(spec: RunSpec, store: str | None, reset: bool, tick_timeout: float, strict: bool, as_json: bool) -> int:
    """Run TASK: plan if it has a goal, choose implementations by the world model, and execute.

    It runs in simulation, or with --backend on real devices.

    TASK is the name of a task of the project here or of a shipped one, or LIBRARY:NAME; `skillc tasks` lists them. In a
    project, TASK may be left out if the manifest names a default one.
    """
    with importing():
        from functools import partial

        from msgspec.structs import replace

        from skillc.cli.console import Terminal, print_json, remark_default
        from skillc.cli.progress.film import FilmProgress
        from skillc.cli.progress.run_output import check_operable, print_results, run_with_progress
        from skillc.services.recording.picture_making import making_pictures
        from skillc.services.reporting.files import check_writable
        from skillc.services.run.running import RunOptions, find_planners
        from skillc.services.scene.stores import StoreChoice
        from skillc.services.tasks.loading import (
            check_request,
            fill_in,
            load_task,
            with_project_deadline,
            with_project_measure,
        )

    kept = StoreChoice(store, reset, writes=True)
    wanted = fill_in(spec, kept)
    remark_default(spec.task, wanted.task)
    check_request(wanted, kept)
    options = RunOptions(wanted, partial(find_planners, wanted.plan_cache), tick_timeout, as_json)
    check_operable(options)
    check_writable(options.out)
    with making_pictures(Terminal(), FilmProgress(as_json)) as pictures:
        with load_task(wanted, Terminal(), kept) as loaded:
            options = replace(options, spec=with_project_measure(with_project_deadline(wanted, loaded), loaded, "run"))
            ran = run_with_progress(loaded, options, as_json, pictures)
        if as_json:
            print_json(ran.result)
        else:
            print_results([ran.result], options.out if ran.written else None)
    if not ran.result.is_sound or (strict and not ran.result.verified):
        return 3
    return 0 if ran.written else 1
