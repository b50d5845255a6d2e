"""Rehearse a task in a simulated twin of a cell of a server.

The twin is the cell as it is known now: its world, the postures of its arms, what its grippers hold. Nothing moves in
the cell itself.

Exit code 3 if the task does not succeed in the twin.
"""

from __future__ import annotations

import sys
from pathlib import Path

import click
import msgspec

from skillc.cli.command import Command
from skillc.cli.options import json_option
from skillc.cli.server_access import request_options
from skillc.cli.server_connection import connect_server, server_options
from skillc.cli.struct_options import struct_options
from skillc.contract.rehearsal import RehearsalRequest

EXAMPLES = """
skillc rehearse clean_table --cell iiwa_table
skillc rehearse deliver tray=lab:Tray-1 --film rehearsal.mp4
skillc rehearse --goal "lab:Box-A contain lab:Part-A" --seed 3
"""


@click.command(cls=Command, examples=EXAMPLES)
@request_options
@click.option("--film", "film_file", type=click.Path(), metavar="FILE", help="Write a film of it, an MP4 file.")
@struct_options(RehearsalRequest)
@server_options
@json_option
def command(request: RehearsalRequest, film_file: str | None, as_json: bool) -> int:
    """Do TASK of the cell's library in a simulated twin of the cell, and print how it ends."""
    from skillc.cli.console import page_of, print_remark, print_result
    from skillc.cli.output.result import format_result

    with connect_server() as server:
        result = server.cell(request.cell).rehearse(
            request.task,
            arguments=request.arguments,
            goal=request.goal,
            call=request.call,
            seed=request.seed,
            deadline_s=request.deadline_s,
            answers=request.answers,
            film=film_file,
        )
    if as_json:
        click.echo(msgspec.json.format(msgspec.json.encode(result)))
    else:
        print_result(format_result(result, page_of(sys.stdout)))
    if film_file is not None:
        exists = Path(film_file).exists()
        print_remark(f"the film is in {film_file}" if exists else "there is no film: nothing has moved")
    return 0 if result.is_sound else 3
