"""Draw the behaviour trees of a skill, or a task and its plan.

The output is SVG for browsers, Mermaid for Markdown, or text for terminals.

Exit code 1 if the library has errors, 3 if no plan is found.
"""

from __future__ import annotations

import shutil
import sys
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

import click
from msgspec import structs

from skillc.cli.command import Command
from skillc.cli.console import print_error
from skillc.cli.options import PATH

if TYPE_CHECKING:
    from skillc_compiler.emit.picture.boxes import PictureBox

FILE = click.Path(path_type=Path, dir_okay=False)
FORMATS = ("svg", "mermaid", "text")
_SUFFIXES = MappingProxyType({".mmd": "mermaid", ".mermaid": "mermaid", ".txt": "text"})


@click.command(cls=Command)
@click.argument("path", type=PATH)
@click.argument("name")
@click.option("--plan", "with_plan", is_flag=True, help="Plan for the goal of the task, and draw the plan too.")
@click.option(
    "--format",
    "form",
    type=click.Choice(FORMATS),
    help="Output format; by default from the ending of the output file, else text in a terminal and SVG elsewhere.",
)
@click.option("-o", "--output", type=FILE, help="The file to write; by default stdout.")
def command(path: Path, name: str, with_plan: bool, form: str | None, output: Path | None) -> int:
    """Draw the skill or the task NAME of the library at PATH."""
    from skillc.cli.console import Terminal
    from skillc.services.planning.plan_picture import draw_plan
    from skillc.services.views.pictures import draw_declaration
    from skillc_compiler.emit.picture.boxes import PictureBox

    box = draw_declaration(path, name)
    if with_plan:
        plan = draw_plan(path, name, Terminal())
        if not isinstance(plan, PictureBox):
            print_error(plan.message)
            return 3
        box = structs.replace(box, children=(*box.children, plan))
    text = _draw(box, form or _choose_format(output))
    if output is None:
        click.echo(text, nl=False)
        return 0
    try:
        output.parent.mkdir(parents=True, exist_ok=True)
        output.write_text(text, encoding="utf-8")
    except OSError as error:
        raise click.UsageError(f"cannot write {output}: {error.strerror}") from error
    return 0


def _choose_format(output: Path | None) -> str:
    if output is None:
        return "text" if sys.stdout.isatty() else "svg"
    return _SUFFIXES.get(output.suffix, "svg")


def _draw(box: PictureBox, form: str) -> str:
    from skillc_compiler.emit.picture import mermaid, svg, text

    match form:
        case "mermaid":
            return mermaid.draw(box)
        case "text":
            return text.draw(box, shutil.get_terminal_size().columns)
        case _:
            return svg.draw_document(box)
