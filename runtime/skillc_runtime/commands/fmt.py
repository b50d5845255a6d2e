"""Lay out skill files in the one way there is."""

from __future__ import annotations

import sys
from pathlib import Path

import click

PATH = click.Path(path_type=Path)


@click.command()
@click.argument("paths", nargs=-1, type=PATH)
@click.option("--check", is_flag=True, help="Write nothing; list the files that are not formatted, and exit with 1.")
@click.option("--diff", is_flag=True, help="Write nothing; show what would change.")
@click.option("--stdin-filename", type=PATH, help="What the text that is read from `-` is called in messages.")
def command(paths: tuple[Path, ...], check: bool, diff: bool, stdin_filename: Path | None) -> None:
    """Format the skill files at PATHS, files or folders, or in the current folder. `-` is the standard input, which is
    printed formatted.

    There are no options of style. Comments stay, and so does the meaning, which is compared before a file is written. A
    file with syntax errors is left as it is and they are shown; exit code 1.
    """
    from skillc_runtime.commands import _formatting

    if stdin_filename and paths != (Path("-"),):
        raise click.UsageError("--stdin-filename names the text of `-`, which must be the only path")
    if Path("-") in paths and len(paths) > 1:
        raise click.UsageError("`-` must be the only path")
    if Path("-") in paths:
        layouts = [_formatting.of_stdin(stdin_filename or Path("stdin.skill"))]
    else:
        layouts = list(_formatting.of_files(paths or (Path(),)))
    if diff:
        _formatting.show_diffs(layouts)
    if check:
        sys.exit(_formatting.show_unformatted(layouts))
    sys.exit(_formatting.show_problems(layouts) if diff else _formatting.write(layouts))
