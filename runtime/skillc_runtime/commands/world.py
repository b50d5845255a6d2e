"""Show, search, query, compare, draw or edit what a scene, or the world in a store, says.

Lists its individuals with types, relations and properties unless asked for something else.

Exit code 1 when the scene has errors, the store cannot be used, the query is not SPARQL or an edit cannot be made.
"""

from __future__ import annotations

import sys
from pathlib import Path

import click

from skillc_runtime.commands import _keeping

PATH = click.Path(path_type=Path)


@click.command()
@click.argument("scene", required=False, type=PATH)
@click.option("--query", "sparql", help="A SPARQL query; the vocabulary's prefixes need no declaration.")
@click.option("--search", "words", help="List the individuals in whose names, labels, classes or texts words occur.")
@click.option("--show", "names", multiple=True, help="Show all there is to know of an individual.")
@click.option("--diff", "other", type=PATH, help="Show what this scene says and another does not, and the converse.")
@click.option("--graph", type=click.Path(path_type=Path, dir_okay=False), help="Draw the scene into an SVG file.")
@click.option("--edit", "edits", multiple=True, help="Change the file: 'SUBJECT PREDICATE VALUE', or 'not ..'.")
@click.option("--library", type=PATH, help="Whose terms the scene uses; else that beside it, or the shipped one.")
@_keeping.options
@click.option("--all", "everything", is_flag=True, help="List the shipped data sheets and postures too.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON document.")
def command(
    scene: Path | None,
    sparql: str | None,
    words: str | None,
    names: tuple[str, ...],
    other: Path | None,
    graph: Path | None,
    edits: tuple[str, ...],
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

    All edits are made or none, and only if the scene is in order afterwards. What can have one value only is replaced;
    `not SUBJECT PREDICATE VALUE` takes a statement away, `not INDIVIDUAL` everything about it. The rest of the file
    stays as it is written.
    """
    from skillc_runtime.commands import _asked_of_world as asked

    keeping = _keeping.keeping(store, reset)
    if scene is None and store is None:
        raise click.UsageError("say which SCENE, or --store for the world in a store")
    if sum(map(bool, (sparql is not None, words is not None, names, other, graph, edits))) > 1:
        raise click.UsageError("--query, --search, --show, --diff, --graph and --edit are asked one at a time")
    if edits and store:
        raise click.UsageError("--edit changes the file of a scene; leave --store out")
    world = asked.open_world(scene, library, keeping, everything)
    try:
        if edits:
            click.echo(asked.edit(world, edits), err=True)
        elif graph:
            click.echo(asked.draw(world, graph))
        elif sparql is not None:
            click.echo(asked.answer(world, sparql, as_json))
        elif other is not None:
            click.echo(asked.compare(world, other, as_json))
        elif names:
            click.echo(asked.show(world, names, as_json))
        else:
            click.echo(asked.listed(world, words, as_json))
    except asked.NoAnswer as error:
        click.echo(f"error: {error}", err=True)
        sys.exit(1)
