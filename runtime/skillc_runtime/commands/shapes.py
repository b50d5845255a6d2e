"""Print the vocabulary of a library as SHACL shapes, by which other tools check scenes."""

from __future__ import annotations

from pathlib import Path

import click


@click.command()
@click.argument("path", required=False, type=click.Path(path_type=Path))
def command(path: Path | None) -> None:
    """Print the shapes of the vocabulary of the library at PATH, or of the shipped one, in Turtle."""
    from skillc_runtime.commands import _files, _mission
    from skillc_runtime.scene.shapes import shapes

    library = _mission.compiled(_files.find(path or _files.SHIPPED / "wiping"))
    click.echo(shapes(library.vocabulary), nl=False)
