"""Show, search, query, compare, draw or export a scene or a stored world.

By default lists the individuals with their types, relations and properties.

Exit code 1 if the scene has errors, the store cannot be used or the query is not valid SPARQL.
"""

from __future__ import annotations

import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click
import msgspec

from skillc.cli.command import Command
from skillc.cli.completions import complete_scene
from skillc.cli.options import PATH, json_option, store_options
from skillc.cli.server_access import cell_options, refuse_options
from skillc.cli.server_completions import complete_individual
from skillc.cli.server_connection import asks_cell
from skillc.cli.struct_options import struct_options

if TYPE_CHECKING:
    from skillc.services.views.open_scenes import OpenScene

FORMATS = ("turtle", "rdfxml", "jsonld", "ntriples", "trig")


class WorldOptions(msgspec.Struct, frozen=True, kw_only=True):
    """What is asked of a world: at most one of these but for `output`, the file of `form`; nothing for all of it."""

    sparql: str | None
    words: str | None
    names: tuple[str, ...]
    other: Path | None
    graph: Path | None
    form: str | None
    output: Path | None
    history: bool


@click.command(cls=Command)
@click.argument("scene", required=False, type=PATH, shell_complete=complete_scene)
@click.option(
    "--query", "sparql", metavar="SPARQL", help="Answer a SPARQL query; the prefixes of the vocabulary are declared."
)
@click.option(
    "--search",
    "words",
    metavar="WORDS",
    help="List individuals whose names, labels, classes or texts contain these words.",
)
@click.option(
    "--show",
    "names",
    metavar="INDIVIDUAL",
    multiple=True,
    shell_complete=complete_individual,
    help="Show all facts about an individual, including derived ones.",
)
@click.option("--diff", "other", type=PATH, help="Show the differences between this scene and another one.")
@click.option("--graph", type=click.Path(path_type=Path, dir_okay=False), help="Draw the scene as an SVG file.")
@click.option("--export", "form", type=click.Choice(FORMATS), help="Write the scene in an RDF format.")
@click.option("-o", "--output", type=click.Path(path_type=Path, dir_okay=False), help="The file to export to.")
@click.option("--edit", "edits", multiple=True, hidden=True)
@click.option(
    "--library",
    type=PATH,
    help="The library whose terms the scene uses; by default the one beside it, else the shipped one.",
)
@store_options
@click.option("--all", "everything", is_flag=True, help="Also list the shipped data sheets and postures.")
@click.option("--history", is_flag=True, help="List who has written what to the world of a cell, the last first.")
@cell_options
@json_option
@struct_options(WorldOptions)
def command(
    asked: WorldOptions,
    scene: Path | None,
    edits: tuple[str, ...],
    library: Path | None,
    store: str | None,
    reset: bool,
    everything: bool,
    as_json: bool,
) -> None:
    """Show SCENE, a file or the name of a shipped scene, or the world that a store holds.

    A scene is Turtle, RDF/XML, JSON-LD, N-Triples or TriG; its content determines the format. `--export` writes it in
    one of them, without the facts of data sheets, which are part of every world (with `--all`, with them).

    In a project, SCENE may be left out if the manifest names one, and is also looked up in the project's folder.

    A query sees only the statements of the scene, the data sheets and the vocabulary, and the descriptions of the
    library's skills, without inference. To include subclasses, ask for `?x a/rdfs:subClassOf* skillc:CompliantArm`.
    (Conditions of the skill language include subclasses and sub-relations.) `?robot skiros:hasSkill :Wipe` finds the
    robots whose hardware can wipe.

    With --cell or --server it shows the world of a cell that runs, with how each fact is known. --query, --search,
    --show, --graph and --export are answered there.

    `skillc scene` writes scenes.
    """
    if edits:
        words = " ".join(map(shlex.quote, edits))
        raise click.UsageError(f"`world` only reads; write `skillc scene edit {scene or 'SCENE'} {words}`")
    _refuse_contradictions(asked)
    if asks_cell():
        all_ = everything and not asked.form
        refuse_options(diff=asked.other, library=library, store=store, reset=reset, all=all_)
        if scene is not None:
            raise click.UsageError("SCENE cannot be named with a cell of a server")
        _ask_cell(asked, everything, as_json)
        return
    if asked.history:
        raise click.UsageError("--history requires --cell or --server")
    from skillc.cli.console import Terminal
    from skillc.services.scene.stores import StoreChoice
    from skillc.services.views.open_scenes import open_scene

    with open_scene(scene, library, StoreChoice(store, reset), everything, Terminal()) as opened:
        _answer(opened, asked, everything, as_json)


def _refuse_contradictions(asked: WorldOptions) -> None:
    """Raise UsageError if several things are asked at once."""
    kinds = (asked.sparql is not None, asked.words is not None, asked.names, asked.other, asked.graph, asked.form)
    if sum(map(bool, (*kinds, asked.history))) > 1:
        raise click.UsageError("--query, --search, --show, --diff, --graph, --export and --history cannot be combined")
    if asked.output and not asked.form:
        raise click.UsageError("--output requires --export FORMAT")


def _ask_cell(asked: WorldOptions, everything: bool, as_json: bool) -> None:
    from skillc.cli import cell_questions

    if asked.graph or asked.form:
        cell_questions.export_world(asked.form or "graph", everything, asked.graph or asked.output)
    else:
        cell_questions.show_world(asked.sparql, asked.names, asked.words, asked.history, as_json)


def _answer(opened: OpenScene, asked: WorldOptions, everything: bool, as_json: bool) -> None:
    """Answer a question about a scene."""
    from skillc.cli.console import print_result, print_text
    from skillc.services.views import scenes

    if asked.graph:
        scenes.draw_scene(opened, asked.graph)
        click.echo(asked.graph)
    elif asked.form:
        _export(opened, asked.form, asked.output, everything)
    else:
        view = _format_view(opened, asked, as_json)
        (print_result if as_json or asked.sparql is not None else print_text)(view)


def _export(opened: OpenScene, form: str, output: Path | None, everything: bool) -> None:
    """Write a scene in an RDF format to a file, whose path is printed, or to the standard output."""
    from skillc.services.views import scene_export

    if output is None:
        click.echo(scene_export.export_scene(opened, form, everything), nl=False)
    else:
        scene_export.write_export(opened, form, output, everything)
        click.echo(output)


def _format_view(opened: OpenScene, asked: WorldOptions, as_json: bool) -> str:
    """Return the answer to a query, the differences from another scene, or individuals: the named or the found ones."""
    from skillc.cli.console import Terminal, page_of
    from skillc.cli.output import scene as scene_output
    from skillc.services.views import scenes

    if asked.sparql is not None:
        return scene_output.format_answer(scenes.query_scene(opened, asked.sparql), as_json, page_of(sys.stdout))
    if asked.other is not None:
        return scene_output.format_diff(scenes.compare_scenes(opened, asked.other, Terminal()), as_json)
    if asked.names:
        return scene_output.format_individuals(scenes.describe_individuals(opened, asked.names), opened, as_json)
    return scene_output.format_elements(scenes.find_individuals(opened, asked.words), opened, as_json)
