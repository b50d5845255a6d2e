"""Apply the fixes of diagnostics, or move a project to the newest edition of the language."""

from __future__ import annotations

from pathlib import Path

import click

from skillc.cli.command import Command
from skillc.cli.console import print_error, print_remark
from skillc.cli.options import PATH
from skillc.cli.output.diagnostics import exit_code, print_diagnostics

EXAMPLES = """
skillc fix
skillc fix --edition
skillc fix --edition --diff
"""


@click.command(cls=Command, examples=EXAMPLES)
@click.argument("path", type=PATH, default=Path())
@click.option("--edition", is_flag=True, help="Move the project to the newest edition of the language.")
@click.option("--diff", is_flag=True, help="Show what would change, without writing files.")
def command(path: Path, edition: bool, diff: bool) -> int:
    """Apply the safe fixes of `skillc check` to the library or file at PATH, by default the project or folder here.

    With --edition names are written as the newest edition has them, and skillc.toml names it. The library means the
    same then; where it would not compile, nothing is changed.
    """
    return _move(path, diff) if edition else _fix(path, diff)


def _fix(path: Path, diff: bool) -> int:
    from skillc.services.check.checking import CheckRequest, check_paths
    from skillc.services.check.fixing import find_fixes, write_fixes
    from skillc.services.reporting.reporter import format_count

    request = CheckRequest((path,))
    fixes = find_fixes(request, unsafe=False)
    if diff:
        click.echo(fixes.diff(), nl=False)
        print_remark(f"{format_count(fixes.count, 'problem')} can be fixed")
        return 0
    files = write_fixes(fixes)
    print_remark(f"fixed {format_count(fixes.count, 'problem')} in {format_count(files, 'file')}")
    result = check_paths(request)
    print_diagnostics(*result, "full")
    return exit_code(result.diagnostics)


def _move(path: Path, diff: bool) -> int:
    from skillc.services.check.edition_moves import find_edition_move
    from skillc.services.check.fixing import unified_diff
    from skillc.services.reporting.files import rewrite_file
    from skillc_dsl.editions import NEWEST

    move = find_edition_move(path)
    if move.problems:
        print_diagnostics(move.problems, move.texts, "full")
        print_error(f"nothing was changed: the library does not compile in edition {move.failed}")
        return 1
    if not move.changes:
        print_remark(f"the project is of the newest edition, {NEWEST}; nothing was changed")
        return 0
    for change in move.changes:
        if diff:
            click.echo(unified_diff(change.before, change.after, change.shown), nl=False)
        else:
            rewrite_file(change.path, change.before, change.after)
    for edit in () if diff else move.edits:
        click.echo(f"{edit.span.path}:{edit.span.line}: {edit.message}")
    print_remark(f"edition {move.before} {'would become' if diff else 'is now'} {NEWEST}")
    return 0
