"""Write the versions and hashes of the libraries that the project depends on to skillc.lock.

`skillc check` reports a library that has changed since.
"""

from __future__ import annotations

from pathlib import Path

import click

from skillc.cli.command import Command
from skillc.cli.console import print_remark
from skillc.cli.options import PATH


@click.command(cls=Command)
@click.argument("path", type=PATH, default=Path())
def command(path: Path) -> None:
    """Lock the dependencies of the project that PATH, by default the current folder, is in."""
    from skillc.errors import RequestError
    from skillc.services.project.loading import find_project
    from skillc.services.project.lock import lock_libraries, write_lock

    project = find_project(path)
    if project is None:
        raise RequestError(f"{path.resolve()} is in no project: there is no skillc.toml")
    click.echo(write_lock(project))
    count = len(lock_libraries(project))
    print_remark("1 library locked" if count == 1 else f"{count} libraries locked")
