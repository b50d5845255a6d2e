"""Create a new library.

It contains a skill, a scene, a task, a test and a CI workflow, and can be checked, compiled and run at once.
"""

from __future__ import annotations

from pathlib import Path

import click

from skillc.cli.command import Command
from skillc.cli.options import PATH


@click.command(cls=Command)
@click.argument("name", type=PATH)
def command(name: Path) -> None:
    """Create a library in the new folder NAME, with a skill, a scene, a task, a test and a CI workflow.

    The last part of NAME, such as `press_button`, names the skill and the task.
    """
    from skillc.services.new_library import create_library

    for path in create_library(name):
        click.echo(path)
    click.echo(f"\nNext steps:\n  cd {name}\n  skillc check .\n  skillc run .:{name.name}", err=True)
