"""Print the vocabulary of a library as SHACL shapes."""

from __future__ import annotations

from pathlib import Path

import click

from skillc.cli.command import Command
from skillc.cli.options import PATH


@click.command(cls=Command)
@click.argument("path", required=False, type=PATH)
def command(path: Path | None) -> None:
    """Print SHACL shapes, in Turtle, of the vocabulary of the library at PATH.

    By default it is that of the project here, or else the shipped one. Other tools can check scenes with them.
    """
    from skillc.services.library.compiled_libraries import compile_valid
    from skillc.services.library.files import find_library
    from skillc.services.tasks.listing import default_library
    from skillc_runtime.scene.shapes import format_shapes

    library = compile_valid(find_library(path) if path else default_library())
    click.echo(format_shapes(library.vocabulary), nl=False)
