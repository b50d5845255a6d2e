"""Wipe a board and a table with one skill and two robots.

Exit code 3 when a task does not succeed.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from skillc_runtime.commands import _looks

if TYPE_CHECKING:
    from skillc_runtime.evaluation.report.drawing import Drawing
    from skillc_runtime.evaluation.report.result import TaskResult

SEED = 1
"""With this seed both surfaces lie more than a centimetre away from where the world model believes."""

TASKS = {"ur5e": "clean_whiteboard", "iiwa": "clean_table"}


@click.command()
@click.option("--robot", type=click.Choice([*TASKS, "all"]), default="all", show_default=True, help="Which robot.")
@click.option("--out", type=click.Path(path_type=Path, file_okay=False), help="A folder for reports, figures, films.")
@click.option("--seed", default=SEED, show_default=True, help="How reality differs from the world model.")
@_looks.option
@click.option("--json", "as_json", is_flag=True, help="Print one JSON document: a list with one object a task.")
def command(robot: str, out: Path | None, seed: int, looks: str, as_json: bool) -> None:
    """Run the two shipped wiping tasks in simulation."""
    from skillc_runtime.commands import _mission, _results, _running

    _looks.check(looks, out)
    _running.check_writable(out)
    results: list[TaskResult] = []
    written = True
    drawings: list[Drawing] = []
    for task in TASKS.values() if robot == "all" else [TASKS[robot]]:
        directory = out / task if out is not None else None
        _running.check_writable(directory)
        options = _running.Options(out=directory, seed=seed, quiet=as_json, looks=looks)
        ran = _running.run(_mission.of_task(task), options)
        results.append(ran.result)
        drawings += ran.drawings
        if not as_json:
            _results.show([ran.result], directory if ran.written else None)
        written = written and ran.written
    if as_json:
        click.echo(_results.list_as_json(results))
    if out is not None:
        _side_by_side(out, drawings, as_json)
    if any(result.status != "success" for result in results):
        sys.exit(3)
    sys.exit(0 if written else 1)


def _side_by_side(out: Path, drawings: Sequence[Drawing], quiet: bool) -> None:
    """Write the figure that compares what was wiped."""
    from skillc_runtime.commands._running import writing
    from skillc_runtime.evaluation.report.write import write_figure

    with writing(out):
        written = write_figure(out, drawings)
    if written is not None and not quiet:
        click.echo(f"side by side: {out / 'wiping.png'}")
