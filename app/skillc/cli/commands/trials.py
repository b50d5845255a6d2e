"""Run a task many times with different seeds, and measure its quality.

Exit code 3 if a trial did not pass.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import get_args

import click
import msgspec

from skillc.cli.command import Command
from skillc.cli.options import FOLDER, json_option, task_arguments
from skillc.cli.server_access import cell_options, refuse_options
from skillc.cli.server_completions import complete_asked_argument, complete_asked_task
from skillc.cli.server_connection import asks_cell
from skillc.cli.struct_options import struct_options
from skillc_runtime.evaluation.trials.trial import TrialDisturbance

EXAMPLES = """
skillc trials clean_table -n 20
skillc trials contact:insert_peg -n 100 --out trials
skillc trials clean_table --disturb push --json
skillc trials clean_whiteboard --reality typical:forceBias -n 10
skillc trials clean_table -n 1000 --scheduler tls://cluster:8786 --out trials
skillc trials clean_table --cell iiwa_table -n 20
"""


class AskedTrials(msgspec.Struct, frozen=True, kw_only=True):
    """What is tried, how often, and where it is recorded."""

    task: str | None
    arguments: dict[str, str]
    number: int
    seed: int
    jobs: int | None
    scheduler: str | None
    disturb: TrialDisturbance
    reality: str | None
    out: Path | None
    deadline_s: float


COUNT, SEED = click.IntRange(min=1), click.IntRange(min=0)


@click.command(cls=Command, examples=EXAMPLES)
@click.argument("task", required=False, shell_complete=complete_asked_task)
@task_arguments(complete_asked_argument)
@click.option(
    "-n",
    "--number",
    type=click.IntRange(min=1),
    metavar="N",
    default=50,
    show_default=True,
    help="The number of trials.",
)
@click.option("--seed", type=SEED, metavar="N", default=0, show_default=True, help="The seed of the first trial.")
@click.option("--jobs", type=COUNT, metavar="N", help="The number of parallel trials; by default one per core.")
@click.option(
    "--scheduler",
    metavar="ADDRESS",
    help="Run the trials on the workers of this scheduler of Dask, `tls://HOST:PORT`, instead of in processes here.",
)
@click.option(
    "--disturb",
    type=click.Choice(get_args(TrialDisturbance)),
    default="none",
    show_default=True,
    help="Disturb each trial: the object is missing, an obstacle is in the way, or a person pushes the arm, or takes "
    "what a hand holds out of it.",
)
@click.option(
    "--reality",
    metavar="LEVEL",
    help="How far simulated arms and tools are from what they should be: `ideal`, `typical` or `wide`, all "
    "imperfections that their sheets state, or only some of them: `wide:jointFriction,forceBias`.",
)
@click.option(
    "--out", type=FOLDER, help="Record the trials in this folder; trials that are recorded there are not run again."
)
@click.option(
    "--deadline",
    type=click.FloatRange(min=1.0),
    default=3600.0,
    show_default=True,
    metavar="SECONDS",
    help="The time limit of one trial, in wall time.",
)
@struct_options(AskedTrials)
@cell_options
@json_option
def command(asked: AskedTrials, as_json: bool) -> int:
    """Run TASK, as `skillc run` does, in simulation with -n successive seeds, starting at --seed.

    Each seed draws how the simulation differs from the world model, within the ranges that the scene states.

    With --cell or --server, a server runs a task of a cell's library, from the cell's scene, one trial at a time. It
    keeps the result; the cell itself does nothing.
    """
    from skillc.cli import cell_questions
    from skillc.cli.console import Terminal, is_unicode, page_of, print_json, print_result, remark_default
    from skillc.cli.output.trials import format_series
    from skillc.cli.progress.trials import TrialProgress
    from skillc.errors import RequestError
    from skillc.services.tasks.listing import require_task
    from skillc.services.trials.executors import choose_executor
    from skillc.services.trials.running import TrialRequest, run_trials, write_page

    def progress(name: str, done: int) -> TrialProgress:
        return TrialProgress(name, asked.disturb, asked.number, done, quiet=as_json)

    if asks_cell():
        refuse_options(jobs=asked.jobs, scheduler=asked.scheduler, out=asked.out, reality=asked.reality)
        if asked.task is None:
            raise RequestError("name a task of the cell's library")
        with progress(asked.task, 0) as shown:
            result = cell_questions.run_trials(
                asked.task,
                asked.arguments,
                asked.number,
                asked.seed,
                asked.disturb,
                asked.deadline_s,
                shown.show_done,
            )
    else:
        chosen = require_task(asked.task)
        remark_default(asked.task, chosen)
        executor = choose_executor(asked.jobs, asked.scheduler, asked.number, Terminal())
        seeds = range(asked.seed, asked.seed + asked.number)
        request = TrialRequest(
            chosen, asked.disturb, seeds, executor, asked.out, asked.deadline_s, asked.arguments, asked.reality
        )
        result = run_trials(request, progress, Terminal())
    if as_json:
        print_json(result)
    else:
        print_result(format_series(result, page_of(sys.stdout), is_unicode(sys.stdout)))
    if asked.out is not None:
        write_page(result, asked.out)
    return 0 if result.is_good else 3
