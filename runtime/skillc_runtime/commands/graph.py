"""Draw a skill's behaviour trees or a task.

SVG opens in every browser; Mermaid goes into Markdown. Exit code 1 when the library has errors.
"""

from __future__ import annotations

import sys
from pathlib import Path

import click


@click.command()
@click.argument("path", type=click.Path(path_type=Path))
@click.argument("name")
@click.option("--format", "form", type=click.Choice(["svg", "mermaid"]), help="SVG, unless the output ends in .mmd.")
@click.option("-o", "--output", type=click.Path(path_type=Path, dir_okay=False), help="The file, instead of stdout.")
def command(path: Path, name: str, form: str | None, output: Path | None) -> None:
    """Draw the skill or the task NAME of the library at PATH."""
    from skillc_compiler.picture import mermaid, svg
    from skillc_compiler.picture.find import drawable, picture_of
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
    wanted = form or ("mermaid" if output and output.suffix in {".mmd", ".mermaid"} else "svg")
    text = mermaid.draw(box) if wanted == "mermaid" else svg.document(box)
    if output is None:
        click.echo(text, nl=False)
        return
    try:
        output.parent.mkdir(parents=True, exist_ok=True)
        output.write_text(text, encoding="utf-8")
    except OSError as error:
        raise click.UsageError(f"cannot write {output}: {error.strerror}") from error
