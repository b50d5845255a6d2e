"""What `skillc plan`, `world` and `scene edit` do with a cell of a server."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, cast

import click
import msgspec

from skillc.cli.server_connection import asked_cell

if TYPE_CHECKING:
    from skillc.contract.world import WorldFact, WorldFormat, WorldWrite
    from skillc_runtime.evaluation.trials.series import Series
    from skillc_runtime.evaluation.trials.trial import TrialDisturbance
    from skillc_runtime.recording.run_spec import RunSpec

NS = 1e9


def plan(spec: RunSpec, prove: bool, as_json: bool) -> int:
    """Print the plan of a cell, or why there is none; return the exit code."""
    from skillc.cli.console import print_text
    from skillc.client.async_cell import PLANNING_S

    with asked_cell() as cell:
        answer = cell.plan(
            spec.task,
            arguments=spec.arguments,
            goal=spec.goal,
            minimise=spec.minimise,
            prove=prove,
            deadline_s=spec.deadline_s or PLANNING_S,
            geometry=spec.geometry,
        )
    if as_json:
        click.echo(msgspec.json.format(msgspec.json.encode(answer)))
    else:
        print_text(answer.text)
    return 0 if answer.status == "solved" else 3


def run_trials(
    task: str,
    arguments: dict[str, str],
    number: int,
    seed: int,
    disturb: TrialDisturbance,
    deadline_s: float,
    show_done: Callable[[int], None],
) -> Series:
    """Let a server run trials of a cell's task, and return them; `show_done` is called with how many are done."""
    with asked_cell() as cell:
        return cell.trials(
            task,
            number,
            arguments=arguments,
            seed=seed,
            disturb=disturb,
            deadline_s=deadline_s,
            watch=lambda job: show_done(job.done),
        ).series


def show_world(sparql: str | None, individuals: Sequence[str], words: str | None, history: bool, as_json: bool) -> None:
    """Print the answer to a query, the facts, those about individuals, or who has written them."""
    from skillc.cli.console import page_of, print_result, print_text
    from skillc.cli.output.scene import format_answer
    from skillc_runtime.scene.query import QueryAnswer

    with asked_cell() as cell:
        if sparql is not None:
            rows = cell.query(sparql)
            print_result(format_answer(QueryAnswer(rows.columns, rows.rows), as_json, page_of(sys.stdout)))
            return
        subjects: Sequence[str | None] = individuals or (None,)
        facts = [fact for each in subjects for fact in cell.facts(each, search=words)] if not history else []
        found = cell.world_history() if history else facts
    if as_json:
        click.echo(msgspec.json.format(msgspec.json.encode(found)))
    elif history:
        print_text("\n".join(map(_format_write, cast("Sequence[WorldWrite]", found))))
    else:
        print_text("\n".join(map(_format_fact, cast("Sequence[WorldFact]", found))))


def export_world(format: str, everything: bool, file: Path | None) -> None:
    """Print the world of a cell in a format, or write it to a file, whose path is printed."""
    from skillc.services.reporting.files import write_file

    with asked_cell() as cell:
        text = cell.export(cast("WorldFormat", format), everything)
    if file is None:
        click.echo(text, nl=False)
    else:
        write_file(file, text)
        click.echo(file)


def show_things(folder: Path, as_json: bool) -> None:
    """List the things of a cell with their poses, as it is believed, and draw them from above into a folder."""
    from skillc.cli.console import page_of, print_remark, print_result
    from skillc.cli.output.scene import format_placed
    from skillc.services.reporting.files import write_file

    with asked_cell() as cell:
        print_result(format_placed(cell.things(), as_json, page_of(sys.stdout)))
        picture, file = cell.export("top-view"), folder / f"{cell.name}.svg"
    write_file(file, picture)
    print_remark(str(file))


def edit_world(edits: Sequence[str], why: str | None) -> None:
    """Change the world of a cell, and print that it is done."""
    from skillc.cli.console import print_remark

    if not edits or why is None:
        raise click.UsageError("say what to change, and --why")
    with asked_cell() as cell:
        cell.edit(*edits, why=why)
        name = cell.name
    print_remark(f"{name}: {len(edits)} edit{'s' * (len(edits) > 1)} applied")


def _format_fact(each: WorldFact) -> str:
    from skillc_runtime.world.state.labels.labelled_text import format_fact

    known = f"  ({each.evidence} by {each.origin})" if each.evidence else f"  ({each.origin})" if each.origin else ""
    return f"{format_fact(each.fact)}{known}"


def _format_write(each: WorldWrite) -> str:
    from skillc.cli.output.event_lines import format_change

    when = datetime.fromtimestamp(each.written_ns / NS, UTC).astimezone().isoformat(" ", "seconds")
    changes = "; ".join(map(format_change, each.changes))
    return f"{each.sequence}  {when if each.written_ns else '-'}  {each.origin}: {changes}"
