"""Format skill files."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from skillc.cli.command import Command
from skillc.cli.console import print_error, print_remark
from skillc.cli.options import PATH

if TYPE_CHECKING:
    from skillc.services.check.formatting import FormattedFile

STDIN = Path("-")


@click.command(cls=Command)
@click.argument("paths", nargs=-1, type=PATH)
@click.option("--check", is_flag=True, help="List unformatted files without writing them; exit with 1 if any.")
@click.option("--diff", is_flag=True, help="Show what would change, without writing files.")
@click.option("--stdin-filename", type=PATH, help="The name of the text that is read from `-`, for messages.")
def command(paths: tuple[Path, ...], check: bool, diff: bool, stdin_filename: Path | None) -> int:
    """Format the skill files at PATHS (files or folders), by default in the current folder. `-` reads from stdin and
    prints to stdout.

    There are no style options. Comments are kept. A file is written only if its meaning stays the same. Files with
    syntax errors are not changed; the errors are printed, with exit code 1.
    """
    from skillc.cli.console import read_stdin
    from skillc.services.check.formatting import format_files, format_text

    if stdin_filename and paths != (STDIN,):
        raise click.UsageError("--stdin-filename requires `-` as the only path")
    if STDIN in paths and len(paths) > 1:
        raise click.UsageError("`-` must be the only path")
    if STDIN in paths:
        files = [format_text(stdin_filename or Path("stdin.skill"), read_stdin())]
    else:
        files = list(format_files(paths or (Path(),)))
    if diff:
        click.echo("".join(file.diff() for file in files), nl=False)
    if check:
        return _show_unformatted(files)
    return _show_problems(files) if diff else _write(files)


def _write(files: Sequence[FormattedFile]) -> int:
    """Write each file that changes, and print why others could not be formatted."""
    from skillc.errors import ServiceError
    from skillc.services.reporting.reporter import format_count

    failed = _show_problems(files)
    for file in files:
        if file.path is None and not file.problems:
            click.echo(file.text, nl=False)
    changed = [file for file in files if file.path is not None and file.changes]
    for file in changed:
        try:
            file.write()
        except ServiceError as error:
            print_error(str(error))
            failed = error.exit_code
        else:
            print_remark(f"formatted {file.source.path}")
    if not changed and not failed and files[0].path is not None:
        print_remark(f"{format_count(len(files), 'file')} already formatted")
    return failed


def _show_problems(files: Sequence[FormattedFile]) -> int:
    """Print on stderr why files cannot be formatted."""
    from skillc.cli.console import Terminal
    from skillc.cli.output.diagnostics import exit_code

    problems = [problem for file in files for problem in file.problems]
    Terminal().show(problems, {file.source.path: file.source for file in files})
    return exit_code(problems)


def _show_unformatted(files: Sequence[FormattedFile]) -> int:
    """List the unformatted files, and print why others cannot be formatted."""
    from skillc.cli.output.diagnostics import render_diagnostics
    from skillc.services.reporting.reporter import format_count
    from skillc_dsl.formatting.formatter import check_layout

    warnings = [warning for file in files if (warning := check_layout(file.source)) is not None]
    click.echo(render_diagnostics(warnings, {}, "concise"), nl=False)
    failed = _show_problems(files)
    if warnings:
        print_remark(f"{format_count(len(warnings), 'file')} not formatted; run `skillc fmt`")
    return 1 if warnings or failed else 0
