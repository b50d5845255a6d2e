"""Check skills and scenes; nothing is written unless asked for.

Prints every problem with its place and its cure. Exit code 1 when there is an error.
"""

from __future__ import annotations

import sys
from pathlib import Path

import click

from skillc_runtime.commands._telling import FORMS

PATH = click.Path(path_type=Path)


@click.command()
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
) -> None:
    """Check the libraries or files at PATHS, or in the current folder. `-` is a file from the standard input."""
    from skillc_runtime.commands import _check_runs, _files

    from_stdin = Path("-") in paths
    if stdin_filename and not from_stdin:
        raise click.UsageError("--stdin-filename says where `-` belongs, but `-` is not among the paths")
    if unsafe_fixes and not (fix or diff):
        raise click.UsageError("--unsafe-fixes goes with --fix or --diff")
    if watch and (from_stdin or fix or diff):
        raise click.UsageError("--watch goes neither with `-` nor with --fix or --diff")
    scene = scene and _files.scene_path(scene)
    job = _check_runs.Job(paths or (Path(),), scene, form, stdin_filename, cache)
    if watch:
        from skillc_runtime.commands import _watching

        sys.exit(_watching.run(job))
    if diff:
        sys.exit(_check_runs.show_fixes(job, unsafe_fixes))
    sys.exit(_check_runs.fix(job, unsafe_fixes) if fix else _check_runs.check(job))
