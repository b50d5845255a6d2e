"""Make a library that checks, compiles, runs and tests.

It has a first skill, a scene, a task, a test and a workflow that checks every change.
"""

from __future__ import annotations

from pathlib import Path

import click

from skillc.cli.command import Command
from skillc.cli.options import PATH


@click.command(cls=Command)
@click.argument("name", type=PATH)
def command(name: Path) -> None:
    """Make the library NAME, a new folder; its last part names the skill and the task, as `press_button`."""
    from skillc.services.new_library import create_library

    for path in create_library(name):
        click.echo(path)
    click.echo(f"\nGo on with\n  cd {name}\n  skillc check .\n  skillc run .:{name.name}", err=True)
