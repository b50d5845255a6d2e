"""Make a library that checks, compiles, runs and tests.

It has a first skill, a scene, a task, a test and a workflow that checks every change.
"""

from __future__ import annotations

import sys
from pathlib import Path

import click


@click.command()
@click.argument("name", type=click.Path(path_type=Path))
def command(name: Path) -> None:
    """Make the library NAME, a new folder; its last part names the skill and the task, as `press_button`."""
    from skillc_runtime.commands import _new
    from skillc_runtime.commands._paths import look

    found = look(name)
    if found.kind == "unusable":
        raise click.UsageError(f"{name} {found.is_what}; choose another name")
    if found.kind != "missing":
        raise click.UsageError(f"{name} exists already; choose another name, or remove it first")
    texts = _new.library(name.name)
    try:
        written = _new.write(texts, name)
    except OSError as error:
        click.echo(f"error: cannot make {name}: {error.strerror}; nothing was written", err=True)
        sys.exit(1)
    for path in written:
        click.echo(path)
    click.echo(f"\nGo on with\n  cd {name}\n  skillc check .\n  skillc run .:{name.name}", err=True)
