"""Run the demo: one wiping skill on two robots.

Exit code 3 if a task does not succeed.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click
from msgspec import structs

from skillc.cli.command import Command
from skillc.cli.run_options import run_options

if TYPE_CHECKING:
    from skillc.services.run.result import ReportedRun
    from skillc_runtime.recording.run_spec import RunSpec

SEED = 1
"""With this seed both surfaces are more than 1 cm away from their poses in the world model."""

TASKS = {"ur5e": "clean_whiteboard", "iiwa": "clean_table"}


@click.command(cls=Command)
@click.option("--robot", type=click.Choice([*TASKS, "all"]), default="all", show_default=True, help="The robot to run.")
@click.option(
    "--seed",
    metavar="N",
    default=SEED,
    show_default=True,
    help="The seed of what differs from the world model.",
)
@run_options(only=("out", "film", "film_quality", "looks", "gif"))
@click.option("--json", "as_json", is_flag=True, help="Print the results as JSON: a list with one object per task.")
def command(spec: RunSpec, robot: str, as_json: bool) -> int:
    """Run the two shipped wiping tasks in simulation."""
    from skillc.cli.console import Terminal, print_json
    from skillc.cli.progress.film import FilmProgress
    from skillc.cli.progress.run_output import print_results, run_with_progress
    from skillc.services.recording.picture_making import making_pictures
    from skillc.services.reporting.files import check_writable
    from skillc.services.run.running import RunOptions
    from skillc.services.tasks.loading import load_task

    out = None if spec.out is None else Path(spec.out)
    check_writable(out)
    runs: list[ReportedRun] = []
    with making_pictures(Terminal(), FilmProgress(as_json)) as pictures:
        for task in TASKS.values() if robot == "all" else [TASKS[robot]]:
            folder = out / task if out is not None else None
            options = RunOptions(structs.replace(spec, task=task, out=None if folder is None else str(folder)))
            check_writable(folder)
            with load_task(options.spec, Terminal()) as loaded:
                runs.append(run_with_progress(loaded, options, as_json, pictures))
            if not as_json:
                print_results([runs[-1].result], folder if runs[-1].written else None)
        if as_json:
            print_json([run.result for run in runs])
        if out is not None:
            _compare(out, runs, as_json)
    if not all(run.result.is_sound for run in runs):
        return 3
    return 0 if all(run.written for run in runs) else 1


def _compare(folder: Path, runs: Sequence[ReportedRun], quiet: bool) -> None:
    """Write the figure that compares the wipings of the runs, and say where unless `quiet`."""
    from skillc.services.run.report import write_comparison

    figure = write_comparison(folder, [drawing for run in runs for drawing in run.drawings])
    if figure is not None and not quiet:
        click.echo(f"side by side: {figure}")
