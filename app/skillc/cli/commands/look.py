"""Inspect a picture: which parts it shows and whether they are good, or how clean a surface is.

Exit code 3 if the picture shows no part, or does not decide.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from skillc.cli.command import Command
from skillc.cli.options import PATH, json_option

if TYPE_CHECKING:
    from skillc.services.views.picture_look import SeenPart

FILE = click.Path(path_type=Path, dir_okay=False)


@click.command(cls=Command)
@click.argument("picture", type=FILE)
@click.argument("thing")
@click.option("--scene", type=PATH, help="The scene that says what the thing is; by default that of the project.")
@click.option(
    "--calibration", type=FILE, help="The lens, as ROS calibrates cameras; by default that of the scene's camera."
)
@click.option("-o", "--output", type=FILE, help="Draw what is seen over a copy of the picture.")
@json_option
def command(
    picture: Path, thing: str, scene: Path | None, calibration: Path | None, output: Path | None, as_json: bool
) -> int:
    """Inspect PICTURE, a PNG or JPEG file: THING is a surface with markers, or a part of the size of those in it.

    Of parts, all are found whose labels have codes of the kinds in the scene, wherever they lie. It needs OpenCV:
    `pip install 'skillc[vision]'`.
    """
    import msgspec

    from skillc.cli.console import Terminal, print_result
    from skillc.services.scene.stores import StoreChoice
    from skillc.services.views.open_scenes import open_scene
    from skillc.services.views.picture_look import SeenSurface, look_at

    with open_scene(scene, None, StoreChoice(None, False), False, Terminal()) as opened:
        seen = look_at(picture, opened, thing, calibration, output)
    if as_json:
        print_result(msgspec.json.format(msgspec.json.encode(seen)).decode())
    elif isinstance(seen, SeenSurface):
        click.echo(
            f"{seen.surface}: {100 * seen.clean:.1f} % clean, {100 * seen.dirty:.1f} % dirty, {100 * seen.seen:.1f} % "
            f"seen; located by {seen.located_by} to {seen.error_px:.2f} pixels"
        )
    elif not seen:
        click.echo("no label is seen")
    else:
        click.echo("\n".join(map(_describe, seen)))
    return 0 if isinstance(seen, SeenSurface) or (seen and not any(each.undecided for each in seen)) else 3


def _describe(part: SeenPart) -> str:
    """Return what a picture shows of a part, in a line."""
    defect = f", {part.defect_mm2:.0f} mm2 look otherwise" if part.grade == "scrap" else ""
    return part.undecided or f"{part.code}  {part.kind}  {part.grade}, confidence {part.confidence:.2f}{defect}"
