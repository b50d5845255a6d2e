"""Compile a library to JSON, OWL, PDDL, trees and pages.

The same input gives the same bytes. Exit code 1 when the library has errors; nothing is written then.
"""

from __future__ import annotations

import sys
from pathlib import Path

import click

FOLDER = click.Path(path_type=Path, file_okay=False)


@click.command()
@click.argument("path", type=click.Path(path_type=Path))
@click.option("-o", "--output", required=True, type=FOLDER, help="The folder to write to.")
def command(path: Path, output: Path) -> None:
    """Compile the library at PATH into the folder OUTPUT."""
    from skillc_compiler.emit.artifacts import artifacts
    from skillc_compiler.emit.write import EmitError, write
    from skillc_runtime.commands import _library, _telling

    library = _library.find(path)
    outcome = _library.compile_library(library)
    _telling.tell(outcome.diagnostics, _library.texts(library))
    if not outcome.ok:
        sys.exit(1)
    try:
        written = write(artifacts(outcome.value), output)
    except EmitError as error:
        click.echo(f"error: {error}", err=True)
        sys.exit(1)
    for file in written:
        click.echo(file)
