"""Show what a scene says, or query it.

Lists its individuals with types, relations and properties, or answers a SPARQL query.

Exit code 1 when the scene has errors or the query is not SPARQL.
"""

from __future__ import annotations

import sys
from pathlib import Path

import click


@click.command()
@click.argument("scene", type=click.Path(path_type=Path))
@click.option("--query", "sparql", help="A SPARQL query; the vocabulary's prefixes need no declaration.")
@click.option(
    "--library",
    type=click.Path(path_type=Path),
    help="Whose terms the scene uses, if not the shipped ones.",
)
@click.option("--all", "everything", is_flag=True, help="List the shipped data sheets and postures too.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON document.")
def command(scene: Path, sparql: str | None, library: Path | None, everything: bool, as_json: bool) -> None:
    """Show what SCENE, a Turtle file or the name of a shipped scene, says.

    A query sees what is written in the scene, the data sheets and the vocabulary, and nothing that follows from it:
    to include subclasses ask for `?x a/rdfs:subClassOf* skillc:CompliantArm`. Conditions of the language include
    subclasses and sub-relations by themselves.
    """
    from skillc_runtime.commands import _files, _library, _listing, _mission
    from skillc_runtime.world.query import QueryError

    path = _files.scene_path(scene)
    compiled = _mission.compiled(_library.find(library or _library.SHIPPED / "wiping"))
    state = _mission.loaded(path, compiled)
    try:
        if sparql is None:
            click.echo(_listing.listed(path, state, everything, as_json))
        else:
            click.echo(_listing.answer(path, sparql, state, as_json))
    except QueryError as error:
        click.echo(f"error: {error}", err=True)
        sys.exit(1)
