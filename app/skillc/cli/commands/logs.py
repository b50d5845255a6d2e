"""Show what has happened in an operation, and what happens."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from skillc.cli.command import Command
from skillc.cli.console import print_remark
from skillc.cli.options import PATH
from skillc.cli.server_access import any_operation_argument
from skillc.cli.server_connection import connect_server, server_options

if TYPE_CHECKING:
    from collections.abc import Iterator

    from skillc.client.operation import ServerOperation
    from skillc_runtime.recording.envelope import Envelope

EXAMPLES = """
skillc logs -f
skillc logs carry-20260131T120000Z-1f0c9a --json
skillc logs carry-20260131T120000Z-1f0c9a --recording carry.mcap
"""


@click.command(cls=Command, examples=EXAMPLES)
@any_operation_argument
@click.option("-f", "--follow", is_flag=True, help="Go on until the operation has ended.")
@click.option("--after", type=click.IntRange(min=0), default=0, metavar="N", help="Begin after event number N.")
@click.option("--json", "as_json", is_flag=True, help="Print each event as a line of JSON.")
@click.option("--recording", type=PATH, metavar="FILE", help="Write the recording, an MCAP file, to a file instead.")
@server_options
def command(operation: str | None, follow: bool, after: int, as_json: bool, recording: Path | None) -> None:
    """Print the events of OPERATION: number, time of the cell in s, and what happened.

    With --follow no event is missing or doubled, also when the server is started again meanwhile.
    """
    if recording is not None and (follow or after or as_json):
        raise click.UsageError("--recording cannot be used with --follow, --after or --json")
    import msgspec

    from skillc.cli.output.event_lines import EventLines

    lines = EventLines()
    with connect_server() as server:
        found = server.operation(operation)
        if recording is not None:
            print_remark(f"the recording of {found.id} is in {found.recording(recording)}")
            return
        for each in found.events() if follow else read_events(found):
            shown = [msgspec.json.encode(each).decode()] if as_json else lines.format(each)
            for line in shown if each.sequence > after else ():
                click.echo(line)


def read_events(operation: ServerOperation) -> Iterator[Envelope]:
    """Yield the events up to now."""
    last = operation.status.events
    for each in operation.events() if last else ():
        yield each
        if each.sequence >= last:
            return
