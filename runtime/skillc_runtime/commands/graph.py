"""Draw a skill's behaviour trees, a task or its plan.

SVG opens in every browser; Mermaid goes into Markdown.

Exit code 1 when the library has errors, 3 when there is no plan.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import click

FILE = click.Path(path_type=Path, dir_okay=False)


@click.command()
@click.argument("path", type=click.Path(path_type=Path))
@click.argument("name")
@click.option("--plan", "with_plan", is_flag=True, help="Plan for the goal of a task, and draw the steps too.")
@click.option("--format", "form", type=click.Choice(["svg", "mermaid"]), help="SVG, unless the output ends in .mmd.")
@click.option("-o", "--output", type=FILE, help="The file to write; without, it is printed.")
def command(path: Path, name: str, with_plan: bool, form: str | None, output: Path | None) -> None:
    """Draw the skill or the task NAME of the library at PATH."""
    from skillc_compiler.emit.picture import mermaid, svg
    from skillc_compiler.emit.picture.find import drawable, picture_of
    from skillc_compiler.resolve.files import read
    from skillc_dsl.diagnostics import did_you_mean
    from skillc_runtime.commands import _library, _telling

    library = _library.find(path)
    outcome = _library.compile_library(library)
    if not outcome.ok:
        _telling.tell(outcome.diagnostics, _library.texts(library))
        sys.exit(1)
    files = read(library.sources, library.shelf, library.name).value
    box = picture_of(name, files)
    if box is None:
        hint = did_you_mean(name, drawable(files)) or "it has none"
        raise click.UsageError(f"there is no skill or task `{name}` in {library.name}: {hint}")
    if with_plan:
        from skillc_runtime.commands._planned import NoPlan, planned

        try:
            box = replace(box, children=(*box.children, planned(path, name)))
        except NoPlan as reason:
            click.echo(str(reason), err=True)
            sys.exit(3)
    wanted = form or ("mermaid" if output and output.suffix in {".mmd", ".mermaid"} else "svg")
    _put(mermaid.draw(box) if wanted == "mermaid" else svg.document(box), output)


def _put(text: str, output: Path | None) -> None:
    if output is None:
        click.echo(text, nl=False)
        return
    try:
        output.parent.mkdir(parents=True, exist_ok=True)
        output.write_text(text, encoding="utf-8")
    except OSError as error:
        raise click.UsageError(f"cannot write {output}: {error.strerror}") from error
