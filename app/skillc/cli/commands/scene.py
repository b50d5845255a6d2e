"""Write a scene: create it, add, move, remove and import things, edit facts; show it with a picture.

Comments, order and layout of the rest of the file stay as they are.

Exit code 1 if the scene has errors or would have errors; then the file is not changed.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from skillc.cli.command import Command, Group
from skillc.cli.completions import complete_scene
from skillc.cli.console import print_remark
from skillc.cli.options import FOLDER, PATH, add_ontology_option, json_option
from skillc.cli.server_access import cell_options, refuse_options
from skillc.cli.server_connection import asks_cell

if TYPE_CHECKING:
    from skillc.services.scene.things import PoseRequest
    from skillc_runtime.world.state.world_state import WorldState

Function = TypeVar("Function", bound=Callable[..., Any])


class NumberText(click.ParamType[str]):
    """A finite number, as it was typed."""

    name = "number"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Return the text of a number; fail for anything else."""
        try:
            finite = abs(float(value)) < float("inf")
        except ValueError:
            finite = False
        if not finite:
            self.fail(f"{value!r} is not a number", param, ctx)
        return str(value)


NUMBER = NumberText()
FACES = ("top", "bottom", "front", "back", "left", "right")


def pose_options(function: Function) -> Function:
    """Add the options that say where a thing is and how it is turned, as one argument `pose`."""
    options = (
        click.option("--on", metavar="THING", help="What the thing stands on; the height follows from the sizes."),
        click.option("--at", nargs=2, type=NUMBER, metavar="X Y", help="Where on it, in m, along its axes."),
        click.option("--at-z", type=NUMBER, metavar="Z", help="The same along z: on the top, a gap below the thing."),
        click.option("--corner", "anchor", flag_value="corner", help="Count --at from the corner with the least x, y."),
        click.option("--centre", "anchor", flag_value="centre", help="Count --at from the centre (the default)."),
        click.option("--face", type=click.Choice(FACES), help="On which face of it, instead of the top."),
        click.option("--board", type=NUMBER, metavar="N", help="On which board of a shelf, from the bottom, 1 and up."),
        click.option("--position", nargs=3, type=NUMBER, metavar="X Y Z", help="A position in m, in a frame."),
        click.option("--frame", metavar="FRAME", help="The frame of --position; `map`, the world, by default."),
        click.option("--roll", type=NUMBER, metavar="DEG", help="The turn about x, in degrees, first of the three."),
        click.option("--pitch", type=NUMBER, metavar="DEG", help="The turn about y, in degrees, second of the three."),
        click.option("--yaw", type=NUMBER, metavar="DEG", help="The turn about z, in degrees, last of the three."),
    )
    for option in reversed(options):
        function = option(function)
    return function


def _pose(given: dict[str, Any]) -> PoseRequest:
    from skillc.services.scene.things import PoseRequest

    at, at_z = given["at"] or (), given["at_z"]
    if at_z is not None:
        at = (*(at or ("0", "0")), at_z)
    angles = (given["roll"], given["pitch"], given["yaw"])
    position = given["position"] or ()
    return PoseRequest(
        given["on"], at, given["anchor"], given["face"], position, given["frame"], angles, given["board"]
    )


@contextmanager
def _opened(scene: Path, library: Path | None) -> Iterator[tuple[Path, WorldState]]:
    """Load a scene file to be edited: yield its path and its world."""
    from skillc.cli.console import Terminal
    from skillc.services.scene.stores import StoreChoice
    from skillc.services.views.open_scenes import open_scene

    with open_scene(scene, library, StoreChoice(None, False), False, Terminal()) as opened:
        assert opened.path is not None
        yield opened.path, opened.state


def _refuse_cell(context: click.Context, _option: click.Parameter, value: str | None) -> None:
    if value is not None:
        raise click.UsageError(
            f"`skillc scene {context.info_name}` writes a file, which no cell that runs reads again; "
            "`skillc scene edit --cell NAME --why TEXT EDIT...` changes the world of a cell"
        )


def file_only(function: Function) -> Function:
    """Refuse the options of a cell, with what can be done instead."""
    for name in ("--cell", "--server"):
        function = click.option(name, hidden=True, expose_value=False, is_eager=True, callback=_refuse_cell)(function)
    return function


LIBRARY = click.option(
    "--library", type=PATH, help="The library whose terms the scene uses; by default the one beside it, else shipped."
)


@click.group(cls=Group, context_settings={"help_option_names": ["-h", "--help"]})
def command() -> None:
    """Write scenes: Turtle files that say what there is in a cell, where it is, and how large it is."""


@command.command(cls=Command)
@click.argument("scene", type=PATH, shell_complete=complete_scene)
@click.option("--arm", metavar="CLASS", help="Start with an arm of this class on a pedestal, with its gripper.")
@file_only
def new(scene: Path, arm: str | None) -> None:
    """Create the file SCENE: a workstation, and an arm if one is named."""
    from skillc.services.scaffolding.new_scene import create_scene

    create_scene(scene, arm)
    print_remark(f"{scene}: created")


@command.command(cls=Command)
@click.argument("scene", type=PATH, shell_complete=complete_scene)
@click.argument("name")
@click.argument("cls", metavar="CLASS")
@click.option("--size", nargs=3, type=NUMBER, metavar="X Y Z", help="The extent along its own axes, in m.")
@click.option("--weight", type=NUMBER, metavar="KG", help="The mass in kg.")
@click.option("--shape", metavar="SHAPE", help="The shape within its size, such as cylinder; else that of its class.")
@click.option("--label", metavar="TEXT", help="A text for people.")
@click.option("--in", "inside", metavar="PLACE", help="The place that contains it; by default that of what it is on.")
@click.option("--slots", nargs=2, type=int, metavar="NX NY", help="The numbers of slots in a rack, along x and y.")
@click.option(
    "--sheet", metavar="NAME", help="The data sheet of a device or tool; by default the shipped one for its class."
)
@pose_options
@LIBRARY
@file_only
def add(scene: Path, name: str, cls: str, library: Path | None, **given: Any) -> None:
    """Add a thing NAME of a CLASS at the end of SCENE.

    Without a prefix, NAME is in the namespace of the scene's other things, and CLASS any class of that name.
    """
    from skillc.services.scene.things import ThingRequest, add_thing

    thing = ThingRequest(
        name,
        cls,
        given["label"],
        given["size"] or (),
        given["weight"],
        given["shape"],
        given["inside"],
        given["slots"] or (),
        given["sheet"],
    )
    with _opened(scene, library) as (path, state):
        print_remark(f"{scene}: {add_thing(path, state, thing, _pose(given))}")


@command.command(cls=Command)
@click.argument("scene", type=PATH, shell_complete=complete_scene)
@click.argument("name")
@pose_options
@LIBRARY
@file_only
def move(scene: Path, name: str, library: Path | None, **given: Any) -> None:
    """Move the thing NAME of SCENE. What is not stated stays as it is written."""
    from skillc.services.scene.things import move_thing

    with _opened(scene, library) as (path, state):
        print_remark(f"{scene}: {move_thing(path, state, name, _pose(given))} moved")


@command.command(cls=Command)
@click.argument("scene", type=PATH, shell_complete=complete_scene)
@click.argument("names", nargs=-1, required=True)
@LIBRARY
@file_only
def remove(scene: Path, names: tuple[str, ...], library: Path | None) -> None:
    """Remove things, and all statements about them, from SCENE."""
    from skillc.services.scene.things import remove_things

    with _opened(scene, library) as (path, state):
        print_remark(f"{scene}: {', '.join(remove_things(path, state, names))} removed")


@command.command(cls=Command)
@click.argument("scene", required=False, shell_complete=complete_scene)
@click.argument("edits", nargs=-1, metavar="EDIT...")
@LIBRARY
@click.option("--why", metavar="TEXT", help="With a cell: why, for its history.")
@cell_options
def edit(scene: str | None, edits: tuple[str, ...], library: Path | None, why: str | None) -> None:
    """Change facts of SCENE: 'lab:Cup-1.Weight == 120 g', 'lab:Tray-1 contain lab:Cup-1'.

    Either all edits are applied or none, and only if the scene is valid then, even if it was not before. The value of a
    functional relation or property is replaced. 'not' before a fact removes it, 'not INDIVIDUAL' all facts about an
    individual, and 'lab:Cup-2 is Cup' adds one. Statements of Turtle, 'SUBJECT PREDICATE VALUE', are taken, too.

    With --cell or --server and without SCENE, the world of a cell that runs is changed in one transaction. --why is
    recorded, and who you are.
    """
    from skillc.cli import cell_questions
    from skillc.cli.console import Terminal
    from skillc.services.scene.editing import edit_file
    from skillc.services.views.open_scenes import read_to_mend

    if asks_cell():
        refuse_options(library=library)
        cell_questions.edit_world((scene, *edits) if scene else (), why)
        return
    if scene is None or not edits:
        raise click.UsageError("name SCENE, and what to change in it")
    if why is not None:
        raise click.UsageError("--why requires --cell or --server")
    print_remark(edit_file(*read_to_mend(Path(scene), library, Terminal()), edits))


@command.command("import", cls=Command)
@click.argument("scene", type=PATH, shell_complete=complete_scene)
@click.argument("source", metavar="FILE", type=PATH)
@pose_options
@LIBRARY
@file_only
def import_(scene: Path, source: Path, library: Path | None, **given: Any) -> None:
    """Add the solids of an MJCF, URDF or SDF FILE to SCENE, as fixed things.

    The origin of the file is at --position in --frame, turned by --roll, --pitch and --yaw. What is not understood is
    listed.
    """
    from skillc.services.scenery.writing import import_scenery

    with _opened(scene, library) as (path, state):
        found = import_scenery(path, state, source, _pose(given))
    solids = f"{len(found.solids)} solid{'s' * (len(found.solids) != 1)}"
    print_remark(f"{scene}: {solids} added from {source} ({found.format})")
    for note in found.notes:
        print_remark(f"  {note}")


@command.command(cls=Command)
@click.argument("scene", required=False, type=PATH, shell_complete=complete_scene)
@click.option("--out", type=FOLDER, default="out/scene", show_default=True, help="The folder for the pictures.")
@LIBRARY
@cell_options
@json_option
def show(scene: Path | None, out: Path, library: Path | None, as_json: bool) -> None:
    """List the things of SCENE with their poses in the world, and draw them.

    The view from above is an SVG file. A PNG picture is rendered as well if there is a GL library.

    With --cell or --server and without SCENE, these are the things of a cell that runs, where they are believed to be;
    the view from above is drawn.
    """
    if asks_cell():
        from skillc.cli import cell_questions

        refuse_options(library=library)
        if scene is not None:
            raise click.UsageError("SCENE cannot be named with a cell of a server")
        cell_questions.show_things(out, as_json)
        return
    if scene is None:
        raise click.UsageError("name SCENE, or --cell")
    from skillc.cli.console import Terminal, page_of, print_result
    from skillc.cli.output.scene import format_placed
    from skillc.services.scene.stores import StoreChoice
    from skillc.services.views import scene_show
    from skillc.services.views.open_scenes import open_scene

    with open_scene(scene, library, StoreChoice(None, False), False, Terminal()) as opened:
        print_result(format_placed(scene_show.list_placed(opened), as_json, page_of(sys.stdout)))
        drawn = scene_show.draw_pictures(opened, out)
    for each in drawn.files:
        print_remark(str(each))
    if drawn.not_rendered is not None:
        print_remark(f"no PNG: {drawn.not_rendered}")


for _command in (add, move, remove, edit, import_, show):
    add_ontology_option(_command)
