"""Write the HTML reference of a library.

Linked pages for skills, tasks, terms and files, which can be read without a server. The same input gives the same
bytes. Exit code 1 if the library has errors; then nothing is written.
"""

from __future__ import annotations

from pathlib import Path

import click

from skillc.cli.command import Command
from skillc.cli.options import FOLDER, PATH


@click.command(cls=Command)
@click.argument("path", type=PATH, default=Path())
@click.option("-o", "--output", required=True, type=FOLDER, help="The folder to write to.")
def command(path: Path, output: Path) -> None:
    """Write the HTML reference of the library at PATH, by default the project or folder here, into OUTPUT."""
    from skillc.cli.console import Terminal
    from skillc.services.library.artifacts import write_reference

    click.echo(write_reference(path, output, Terminal()))
