"""Run a task many times in realities that differ, and say how good it is.

Exit code 3 when a trial did not go as it should.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import get_args

import click

from skillc_runtime.evaluation.trials.trial import Disturbance


@click.command()
@click.argument("task")
@click.option("-n", "--number", type=click.IntRange(min=1), default=50, show_default=True, help="How many trials.")
@click.option("--seed", type=click.IntRange(min=0), default=0, show_default=True, help="Seed of the first trial.")
@click.option("--jobs", type=click.IntRange(min=1), help="Trials at a time.  [default: one a core]")
@click.option(
    "--disturb",
    type=click.Choice(get_args(Disturbance)),
    default="none",
    show_default=True,
    help="What happens besides: what is worked on is missing, something is in the way, a person pushes the arm.",
)
@click.option("--out", type=click.Path(path_type=Path, file_okay=False), help="A folder that keeps the trials.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON document.")
def command(
    task: str, number: int, seed: int, jobs: int | None, disturb: Disturbance, out: Path | None, as_json: bool
) -> None:
    """Run TASK (`LIBRARY:NAME`, or a shipped task) in simulation with -n seeds from --seed on.

    Each seed draws how reality differs, within the ranges in the scene. With --out the trials are kept, and those that
    are there already are not run again.
    """
    from skillc_runtime.commands import _trialling
    from skillc_runtime.commands._console import console
    from skillc_runtime.evaluation.trials.table import render

    at_a_time = min(jobs or os.cpu_count() or 1, number)
    wanted = _trialling.Wanted(task, disturb, range(seed, seed + number), at_a_time, out, as_json)
    result = _trialling.tried(wanted)
    if as_json:
        click.echo(_trialling.as_json(result))
    else:
        console().print(render(result))
    if out is not None:
        _trialling.write_page(result, out)
    sys.exit(0 if result.good else 3)
