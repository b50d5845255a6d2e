"""Show what a scene, or the world in a store, says, or query it.

Lists its individuals with types, relations and properties, or answers a SPARQL query.

Exit code 1 when the scene has errors, the store cannot be used or the query is not SPARQL.
"""

from __future__ import annotations

import sys
from pathlib import Path

import click

from skillc_runtime.commands import _keeping


@click.command()
@click.argument("scene", required=False, type=click.Path(path_type=Path))
@click.option("--query", "sparql", help="A SPARQL query; the vocabulary's prefixes need no declaration.")
@click.option(
    "--library",
    type=click.Path(path_type=Path),
    help="Whose terms the scene uses, if not the shipped ones.",
)
@_keeping.options
@click.option("--all", "everything", is_flag=True, help="List the shipped data sheets and postures too.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON document.")
def command(
    scene: Path | None,
    sparql: str | None,
    library: Path | None,
    store: str | None,
    reset: bool,
    everything: bool,
    as_json: bool,
) -> None:
    """Show what SCENE, a Turtle file or the name of a shipped scene, says, or what became of it in a store.

    A query sees what is written in the scene, the data sheets and the vocabulary, and nothing that follows from it:
    to include subclasses ask for `?x a/rdfs:subClassOf* skillc:CompliantArm`. Conditions of the language include
    subclasses and sub-relations by themselves.
    """
    from skillc_runtime.commands import _files, _library, _listing, _mission
    from skillc_runtime.world.documents import Document
    from skillc_runtime.world.query import QueryError

    keeping = _keeping.keeping(store, reset)
    if scene is None and store is None:
        raise click.UsageError("say which SCENE, or --store for the world in a store")
    path = None if scene is None else _files.scene_path(scene)
    compiled = _mission.compiled(_library.find(library or _library.SHIPPED / "wiping"))
    state = _mission.world_for(keeping, path, compiled).snapshot()
    own = Document.read(path) if path and not store else _listing.kept(str(store), state)
    try:
        if sparql is None:
            click.echo(_listing.listed(own, state, everything, as_json))
        else:
            click.echo(_listing.answer(own, sparql, state, as_json))
    except QueryError as error:
        click.echo(f"error: {error}", err=True)
        sys.exit(1)
