"""Check skills and scenes; nothing is written unless asked for.

Prints every problem with its place and its cure. Exit code 1 when there is an error.
"""

from __future__ import annotations

from pathlib import Path

import click

from skillc.cli.command import Command
from skillc.cli.diagnostics_output import FORMS, exit_code, print_diagnostics
from skillc.cli.options import PATH
from skillc.services.checking import STDIN, CheckRequest, CheckResult, StdinFile, check_sources, read_libraries


@click.command(cls=Command)
@click.argument("paths", nargs=-1, type=PATH)
@click.option("--scene", type=PATH, help="Check this scene against the library's vocabulary too.")
@click.option("--format", "form", type=click.Choice(FORMS), default="full", show_default=True)
@click.option("--fix", is_flag=True, help="Apply the fixes that are safe, and check again.")
@click.option("--unsafe-fixes", is_flag=True, help="Apply with --fix or --diff also those that are guesses.")
@click.option("--diff", is_flag=True, help="Show what --fix would change; write nothing.")
@click.option("--watch", is_flag=True, help="Check again whenever a file changes, until Ctrl-C.")
@click.option("--stdin-filename", type=PATH, help="Where the file that is read from `-` belongs.")
@click.option("--cache/--no-cache", default=True, show_default=True, help="Remember what was found in files.")
def command(
    paths: tuple[Path, ...],
    scene: Path | None,
    form: str,
    fix: bool,
    unsafe_fixes: bool,
    diff: bool,
    watch: bool,
    stdin_filename: Path | None,
    cache: bool,
) -> int:
    """Check the libraries or files at PATHS, or in the current folder. `-` is a file from the standard input."""
    from skillc.cli.console import read_stdin
    from skillc.services.library_files import find_scene

    from_stdin = STDIN in paths
    if stdin_filename and not from_stdin:
        raise click.UsageError("--stdin-filename says where `-` belongs, but `-` is not among the paths")
    if unsafe_fixes and not (fix or diff):
        raise click.UsageError("--unsafe-fixes goes with --fix or --diff")
    if watch and (from_stdin or fix or diff):
        raise click.UsageError("--watch goes neither with `-` nor with --fix or --diff")
    scene = scene and find_scene(scene)
    stdin = StdinFile(stdin_filename, read_stdin()) if from_stdin else None
    request = CheckRequest(paths or (Path(),), scene, stdin, cache)
    if watch:
        return _watch(request, form)
    if diff:
        return _show_fixes(request, unsafe_fixes)
    return _fix(request, unsafe_fixes, form) if fix else _show(check_sources(request, read_libraries(request)), form)


def _show(result: CheckResult, form: str) -> int:
    print_diagnostics(*result, form)
    return exit_code(result.diagnostics)


def _watch(request: CheckRequest, form: str) -> int:
    from skillc.cli.console import Terminal
    from skillc.services.watching import watch_sources

    try:
        watch_sources(request, lambda result: print_diagnostics(*result, form), Terminal())
    except KeyboardInterrupt:
        click.echo(err=True)
        return 0


def _show_fixes(request: CheckRequest, unsafe: bool) -> int:
    """Print what would change; the exit code is 1 if there is something, or errors would remain."""
    from skillc.services.fixing import find_fixes
    from skillc.services.reporting import count_of

    fixes = find_fixes(request, unsafe)
    click.echo(fixes.diff(), nl=False)
    click.echo(f"{count_of(fixes.count, 'problem')} can be fixed", err=True)
    return max(1 if fixes.count else 0, exit_code(fixes.remaining))


def _fix(request: CheckRequest, unsafe: bool, form: str) -> int:
    """Fix what can be fixed and print what remains; a fixed standard input goes to stdout."""
    from skillc.cli.console import Terminal
    from skillc.services.fixing import find_fixes, write_fixes
    from skillc.services.reporting import count_of

    fixes = find_fixes(request, unsafe)
    files = 0 if request.stdin else write_fixes(fixes)
    where = f" in {count_of(files, 'file')}" if files else ""
    click.echo(f"fixed {count_of(fixes.count, 'problem')}{where}", err=True)
    result = check_sources(request, read_libraries(request) if fixes.beside else fixes.libraries)
    if not request.stdin:
        return _show(result, form)
    click.echo(fixes.libraries[0].sources[0].text, nl=False)
    Terminal().show(*result)
    return exit_code(result.diagnostics)
