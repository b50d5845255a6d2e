"""Print the JSON Schema of a file that skillc writes or reads."""

from __future__ import annotations

import click

from skillc.cli.command import Command

NAMES = ("library", "events", "result", "diagnostics", "signals", "project")


@click.command(cls=Command)
@click.argument("name", type=click.Choice(NAMES))
def command(name: str) -> None:
    """Print the JSON Schema (draft 2020-12) of NAME.

    It is that of library.json, of a line of events.jsonl, of result.json and `run --json`, of what `check --json`
    prints, of signals.json, or of skillc.toml.
    """
    from skillc.services.library.schemas import read_schema

    click.echo(read_schema(name), nl=False)
