"""Compile a library to JSON, OWL, PDDL, behaviour trees and HTML.

The same input gives the same bytes. Exit code 1 if the library has errors; then nothing is written.
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
    """Compile the library at PATH, by default the project or folder here, into the folder OUTPUT."""
    from skillc.cli.console import Terminal
    from skillc.services.library.artifacts import write_artifacts

    for file in write_artifacts(path, output, Terminal()):
        click.echo(file)
