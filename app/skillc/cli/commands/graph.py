"""Draw the behaviour trees of a skill, or a task and its plan.

The output is SVG for browsers or Mermaid for Markdown.

Exit code 1 if the library has errors, 3 if no plan is found.
"""

from __future__ import annotations

from pathlib import Path

import click
from msgspec import structs

from skillc.cli.command import Command
from skillc.cli.console import print_error
from skillc.cli.options import PATH

FILE = click.Path(path_type=Path, dir_okay=False)


@click.command(cls=Command)
@click.argument("path", type=PATH)
@click.argument("name")
@click.option("--plan", "with_plan", is_flag=True, help="Plan for the goal of the task, and draw the plan too.")
@click.option(
    "--format",
    "form",
    type=click.Choice(["svg", "mermaid"]),
    help="Output format; by default from the ending of the output file, else SVG.",
)
@click.option("-o", "--output", type=FILE, help="The file to write; by default stdout.")
def command(path: Path, name: str, with_plan: bool, form: str | None, output: Path | None) -> int:
    """Draw the skill or the task NAME of the library at PATH."""
    from skillc.cli.console import Terminal
    from skillc.services.pictures import draw_declaration, draw_plan
    from skillc_compiler.emit.picture import mermaid, svg
    from skillc_compiler.emit.picture.boxes import PictureBox

    box = draw_declaration(path, name)
    if with_plan:
        plan = draw_plan(path, name, Terminal())
        if not isinstance(plan, PictureBox):
            print_error(plan.message)
            return 3
        box = structs.replace(box, children=(*box.children, plan))
    wanted = form or ("mermaid" if output and output.suffix in {".mmd", ".mermaid"} else "svg")
    text = mermaid.draw(box) if wanted == "mermaid" else svg.draw_document(box)
    if output is None:
        click.echo(text, nl=False)
        return 0
    try:
        output.parent.mkdir(parents=True, exist_ok=True)
        output.write_text(text, encoding="utf-8")
    except OSError as error:
        raise click.UsageError(f"cannot write {output}: {error.strerror}") from error
    return 0
