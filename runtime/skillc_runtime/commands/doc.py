"""Write a reference of a library to browse.

Pages for skills, tasks, terms and files that link to each other; they work without a server. The same input gives the
same bytes. Exit code 1 when the library has errors; nothing is written then.
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
    """Write the reference of the library at PATH into the folder OUTPUT."""
    from skillc_compiler.emit.docs.site import MARK, site
    from skillc_compiler.emit.write import EmitError, write
    from skillc_compiler.resolve.files import read
    from skillc_runtime.commands import _library, _telling

    library = _library.find(path)
    outcome = _library.compile_library(library)
    _telling.tell(outcome.diagnostics, _library.texts(library))
    if not outcome.ok:
        sys.exit(1)
    files = read(library.sources, library.shelf, library.name).value
    try:
        write(site(outcome.value, files), output, lambda text: MARK in text.partition("\n")[0])
    except EmitError as error:
        click.echo(f"error: {error}", err=True)
        sys.exit(1)
    click.echo(output / "index.html")
