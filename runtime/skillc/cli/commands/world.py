"""Show, search, query, compare, draw or edit a scene or a stored world.

By default lists the individuals with their types, relations and properties.

Exit code 1 if the scene has errors, the store cannot be used, the query is not valid SPARQL or an edit is refused.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from skillc.cli.command import Command
from skillc.cli.options import PATH, json_option, store_options

if TYPE_CHECKING:
    from skillc.services.scenes import OpenScene


@click.command(cls=Command)
@click.argument("scene", required=False, type=PATH)
@click.option("--query", "sparql", help="Answer a SPARQL query; the prefixes of the vocabulary are declared.")
@click.option("--search", "words", help="List individuals whose names, labels, classes or texts contain these words.")
@click.option("--show", "names", multiple=True, help="Show all facts about an individual, including derived ones.")
@click.option("--diff", "other", type=PATH, help="Show the differences between this scene and another one.")
@click.option("--graph", type=click.Path(path_type=Path, dir_okay=False), help="Draw the scene as an SVG file.")
@click.option(
    "--edit", "edits", multiple=True, help="Change the file: add 'SUBJECT PREDICATE VALUE', or remove 'not ..'."
)
@click.option(
    "--library",
    type=PATH,
    help="The library whose terms the scene uses; by default the one beside it, else the shipped one.",
)
@store_options
@click.option("--all", "everything", is_flag=True, help="Also list the shipped data sheets and postures.")
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
    """Show SCENE, a Turtle file or the name of a shipped scene, or the world that a store holds.

    A query sees only the statements of the scene, the data sheets and the vocabulary, without inference. To include
    subclasses, ask for `?x a/rdfs:subClassOf* skillc:CompliantArm`. (Conditions of the skill language include
    subclasses and sub-relations.)

    Either all edits are applied or none, and only if the scene is valid afterwards. The value of a functional relation
    or property is replaced. `not SUBJECT PREDICATE VALUE` removes a statement, `not INDIVIDUAL` all statements about an
    individual. The rest of the file is not changed.
    """
    from skillc.cli.console import Terminal
    from skillc.services import scenes
    from skillc.services.stores import StoreChoice

    choice = StoreChoice(store, reset)
    if sum(map(bool, (sparql is not None, words is not None, names, other, graph, edits))) > 1:
        raise click.UsageError("--query, --search, --show, --diff, --graph and --edit cannot be combined")
    if edits and store:
        raise click.UsageError("--edit changes a scene file and cannot be used with --store")
    with scenes.open_scene(scene, library, choice, everything, Terminal()) as opened:
        if edits:
            click.echo(scenes.edit_scene(opened, edits), err=True)
        elif graph:
            scenes.draw_scene(opened, graph)
            click.echo(graph)
        else:
            click.echo(_format_view(opened, sparql, other, names, words, as_json))


def _format_view(
    opened: OpenScene, sparql: str | None, other: Path | None, names: tuple[str, ...], words: str | None, as_json: bool
) -> str:
    """Return the answer to a query, the differences from another scene, or individuals: the named or the found ones."""
    from skillc.cli import scene_output
    from skillc.cli.console import Terminal
    from skillc.services import scenes

    if sparql is not None:
        return scene_output.format_answer(scenes.query_scene(opened, sparql), as_json)
    if other is not None:
        return scene_output.format_diff(scenes.compare_scenes(opened, other, Terminal()), as_json)
    if names:
        return scene_output.format_individuals(scenes.describe_individuals(opened, names), opened, as_json)
    return scene_output.format_elements(scenes.find_individuals(opened, words), opened, as_json)
