"""Add a skill, robot, gripper or tool to the project here."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from skillc.cli.command import Command
from skillc.cli.completions import complete_device

if TYPE_CHECKING:
    from skillc.services.additions import Kind


@click.command(cls=Command)
@click.argument("kind", metavar="KIND", type=click.Choice(["skill", "robot", "gripper", "tool"]))
@click.argument("name")
@click.option(
    "--like",
    metavar="DEVICE",
    shell_complete=complete_device,
    help="The shipped device to copy, such as `ur5e`, `wsg50` or `peg`.",
)
def command(kind: Kind, name: str, like: str | None) -> None:
    """Add the files of a KIND (skill, robot, gripper or tool) called NAME to the project here.

    A skill is a `.skill` file. A robot, gripper or tool is a data sheet and a model in the project's ontology folder,
    copied from a shipped device, to be replaced by your numbers.
    """
    from skillc.services.additions import add_files
    from skillc.services.errors import RequestError
    from skillc.services.project.project import find_project

    project = find_project(Path())
    if project is None:
        raise RequestError("there is no skillc.toml here or above; `skillc new NAME` writes a project")
    for path in add_files(project, kind, name, like):
        click.echo(path)
