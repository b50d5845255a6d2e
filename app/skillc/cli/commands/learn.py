"""Learn the parameters of skills from trials of a task.

Exit code 3 if nothing better than the defaults was found and confirmed, or not all was tried.
"""

from __future__ import annotations

import sys
from pathlib import Path

import click

from skillc.cli.command import Command
from skillc.cli.completions import complete_task
from skillc.cli.options import FOLDER, json_option, task_arguments
from skillc.cli.server_completions import complete_asked_argument
from skillc.cli.struct_options import struct_options
from skillc.contract.learning import LearnSpec

EXAMPLES = """
skillc learn clean_table --minimise time,force_rmse --subject-to "coverage == 100 %, contact_lost == 0, impact <= 2"
skillc learn contact:insert_peg --minimise simulated_time --subject-to "greatest_force <= 30 N" --candidates 100
skillc learn clean_table --minimise time --parameters speed,rate --out learned --apply
skillc learn clean_table --minimise time --scheduler tls://cluster:8786 --jobs 64
"""


@click.command(cls=Command, examples=EXAMPLES)
@click.argument("task", required=False, shell_complete=complete_task)
@task_arguments(complete_asked_argument)
@struct_options(LearnSpec)
@click.option(
    "--jobs",
    type=click.IntRange(min=1),
    metavar="N",
    help="The number of parallel trials: processes here, by default one per core, or trials that the scheduler has, "
    "by default 8.",
)
@click.option(
    "--scheduler",
    metavar="ADDRESS",
    help="Run the trials on the workers of this scheduler of Dask, `tls://HOST:PORT`, instead of in processes here.",
)
@click.option(
    "--out",
    type=FOLDER,
    help="The folder of the study, by default `learning/TASK`. The same command goes on with what is there.",
)
@json_option
def command(
    spec: LearnSpec,
    task: str | None,
    arguments: dict[str, str],
    jobs: int | None,
    scheduler: str | None,
    out: Path | None,
    as_json: bool,
) -> int:
    """Learn parameters that have a range from trials of TASK in simulation, and show them as a change of the text.

    Candidates are tried one after the other, each in several worlds, until one is surely worse than another or breaks
    a constraint. The best one is compared with the defaults in worlds that were not used to choose it.

    Ctrl-C ends what runs; the same command goes on. With --apply, the values are written.
    """
    from skillc.cli.console import Terminal, page_of, print_json, print_result, remark_default
    from skillc.cli.output.learning import format_learned
    from skillc.cli.progress.learning import LearningProgress
    from skillc.services.learning.coordinator import LearnOrder, learn
    from skillc.services.learning.page import write_page
    from skillc.services.learning.place import choose_place
    from skillc.services.tasks.listing import require_task

    chosen = require_task(task)
    remark_default(task, chosen)
    executor, parallel = choose_place(jobs, scheduler, Terminal())
    folder = out or Path("learning") / chosen.rpartition(":")[2]
    request = LearnOrder(chosen, spec, folder, executor, parallel, arguments)
    learned = learn(request, lambda name: LearningProgress(name, spec, quiet=as_json), Terminal())
    write_page(learned, folder)
    if as_json:
        print_json(learned)
    else:
        print_result(format_learned(learned, page_of(sys.stdout)))
    return 0 if learned.complete and learned.is_confirmed else 3
