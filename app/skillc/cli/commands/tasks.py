"""List the tasks: those of the project here, of the libraries it depends on, and the shipped ones."""

from __future__ import annotations

import click

from skillc.cli.command import Command
from skillc.cli.options import json_option


@click.command(cls=Command)
@json_option
def command(as_json: bool) -> None:
    """List the tasks that `skillc run NAME` knows here, with what they do and their scenes."""
    from msgspec.structs import asdict

    from skillc.cli.console import print_json
    from skillc.cli.output.tasks import print_tasks
    from skillc.services.tasks.listing import list_tasks

    tasks = list_tasks()
    if as_json:
        print_json([asdict(each) for each in tasks])
    else:
        print_tasks(tasks)
