"""Show, search, query, compare, draw or edit what a scene, or the world in a store, says.

Lists its individuals with types, relations and properties unless asked for something else.

Exit code 1 when the scene has errors, the store cannot be used, the query is not SPARQL or an edit cannot be made.
"""

from __future__ import annotations

from pathlib import Path

import click

from skillc.cli.command import Command
from skillc.cli.options import PATH, json_option, store_options


@click.command(cls=Command)
@click.argument("scene", required=False, type=PATH)
@click.option("--query", "sparql", help="A SPARQL query; the vocabulary's prefixes need no declaration.")
@click.option("--search", "words", help="List the individuals in whose names, labels, classes or texts words occur.")
@click.option("--show", "names", multiple=True, help="Show all there is to know of an individual.")
@click.option("--diff", "other", type=PATH, help="Show what this scene says and another does not, and the converse.")
@click.option("--graph", type=click.Path(path_type=Path, dir_okay=False), help="Draw the scene into an SVG file.")
@click.option("--edit", "edits", multiple=True, help="Change the file: 'SUBJECT PREDICATE VALUE', or 'not ..'.")
@click.option("--library", type=PATH, help="Whose terms the scene uses; else that beside it, or the shipped one.")
@store_options
@click.option("--all", "everything", is_flag=True, help="List the shipped data sheets and postures too.")
@json_option
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
    from skillc.cli import scene_output
    from skillc.cli.console import Terminal
    from skillc.services import scenes
    from skillc.services.stores import StoreChoice

    choice = StoreChoice(store, reset)
    if sum(map(bool, (sparql is not None, words is not None, names, other, graph, edits))) > 1:
        raise click.UsageError("--query, --search, --show, --diff, --graph and --edit are asked one at a time")
    if edits and store:
        raise click.UsageError("--edit changes the file of a scene; leave --store out")
    with scenes.open_scene(scene, library, choice, everything, Terminal()) as opened:
        if edits:
            click.echo(scenes.edit_scene(opened, edits), err=True)
        elif graph:
            scenes.draw_scene(opened, graph)
            click.echo(graph)
        elif sparql is not None:
            click.echo(scene_output.format_answer(scenes.query_scene(opened, sparql), as_json))
        elif other is not None:
            click.echo(scene_output.format_diff(scenes.compare_scenes(opened, other, Terminal()), as_json))
        elif names:
            found = scenes.describe_individuals(opened, names)
            click.echo(scene_output.format_individuals(found, opened, as_json))
        else:
            click.echo(scene_output.format_elements(scenes.find_individuals(opened, words), opened, as_json))
