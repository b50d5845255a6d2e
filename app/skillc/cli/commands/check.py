"""Check skills and scenes for errors.

Prints each problem with its location and, where there is one, a fix. Exit code 1 if there is an error.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click
import msgspec

from skillc.cli.command import Command
from skillc.cli.completions import complete_scene
from skillc.cli.console import print_remark
from skillc.cli.options import BACKEND, PATH, json_option
from skillc.cli.output.diagnostics import FORMS, JSON, exit_code, print_diagnostics
from skillc.cli.progress.slow_notice import notice_if_slow
from skillc.cli.serving import require_ros2
from skillc.cli.struct_options import struct_options
from skillc.services.check.checking import (
    STDIN,
    CheckRequest,
    CheckResult,
    StdinFile,
    check_paths,
    check_sources,
    read_libraries,
)

EXAMPLES = """
skillc check
skillc check --fix
skillc check parts.skill --scene cell.ttl
skillc check --format github
skillc check --scene cell.ttl --connect
"""


class FormChoice(click.Choice[str]):
    """A format of diagnostics; JSON has an option of its own, as in all commands."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Return the format; fail with what exists for another one."""
        if value == JSON:
            self.fail("`json` is no format: write `--json`", param, ctx)
        return super().convert(value, param, ctx)


class CheckOptions(msgspec.Struct, frozen=True, kw_only=True):
    """What is to be checked, and what is to be done about it."""

    paths: tuple[Path, ...]
    scene: Path | None
    form: str
    backend: str | None
    fix: bool
    unsafe_fixes: bool
    diff: bool
    watch: bool
    stdin_filename: Path | None
    cache: bool
    connect: bool
    as_json: bool


@click.command(cls=Command, examples=EXAMPLES)
@click.argument("paths", nargs=-1, type=PATH)
@click.option(
    "--scene", type=PATH, shell_complete=complete_scene, help="Check in this scene only, not in those of tasks."
)
@click.option(
    "--format", "form", type=FormChoice(FORMS), default="full", show_default=True, help="The format of diagnostics."
)
@click.option(
    "--backend",
    type=BACKEND,
    metavar="NAME",
    help="Check tasks for this back end, by default that of the project; `symbolic` asks for no bodies.",
)
@click.option("--fix", is_flag=True, help="Apply safe fixes, then check again.")
@click.option(
    "--unsafe-fixes", is_flag=True, help="Include unsafe fixes, which may change meaning, in --fix and --diff."
)
@click.option("--diff", is_flag=True, help="Show what --fix would change, without writing files.")
@click.option("--watch", is_flag=True, help="Check again whenever a file changes, until interrupted.")
@click.option("--stdin-filename", type=PATH, help="The path of the file that is read from `-`.")
@click.option("--cache/--no-cache", default=True, show_default=True, help="Reuse the results of unchanged files.")
@click.option(
    "--connect", is_flag=True, help="Compare the facts of --scene with the topics and services that ROS 2 has now."
)
@json_option
@struct_options(CheckOptions)
def command(asked: CheckOptions) -> int:
    """Check the libraries or files at PATHS, by default the project or folder here; `-` reads a file from stdin.

    Prints each problem with its place and, where there is one, a fix. Tasks are also checked in their scenes, or in
    the one of --scene.
    """
    _refuse_contradictions(asked)
    if asked.connect:
        return _check_connection(asked.scene)
    request, form = _make_request(asked), JSON if asked.as_json else asked.form
    if asked.watch:
        return _watch(request, form)
    with notice_if_slow("checking .."):
        if asked.diff:
            return _show_fixes(request, asked.unsafe_fixes)
        return _fix(request, asked.unsafe_fixes, form) if asked.fix else _show(check_paths(request), form)


def _refuse_contradictions(asked: CheckOptions) -> None:
    """Raise UsageError if options do not belong together."""
    if asked.stdin_filename and STDIN not in asked.paths:
        raise click.UsageError("--stdin-filename names the file of `-`, but `-` is not among the paths")
    if asked.unsafe_fixes and not (asked.fix or asked.diff):
        raise click.UsageError("--unsafe-fixes requires --fix or --diff")
    if asked.as_json and (asked.diff or asked.form != "full"):
        raise click.UsageError("--json cannot be used with --format or --diff")
    if asked.connect and (asked.scene is None or asked.as_json or asked.diff or asked.fix or asked.watch):
        raise click.UsageError("--connect requires --scene, and cannot be used with --json, --diff, --fix or --watch")
    if asked.watch and (STDIN in asked.paths or asked.fix or asked.diff):
        raise click.UsageError("--watch cannot be used with `-`, --fix or --diff")


def _check_connection(scene: Path | None) -> int:
    """Print where a scene and ROS 2 contradict each other; nothing is moved."""
    from skillc.cli.console import Terminal
    from skillc.services.library.files import find_scene
    from skillc.services.run.ros2_graph import find_contradictions

    assert scene is not None, "it was required"
    require_ros2("--connect")
    with notice_if_slow("looking at ROS 2 .."):
        found = find_contradictions(find_scene(scene), Terminal())
    for each in found:
        click.echo(each)
    print_remark("the scene and ROS 2 contradict each other" if found else "ROS 2 has what the scene names")
    return 1 if found else 0


def _make_request(asked: CheckOptions) -> CheckRequest:
    from skillc.cli.console import read_stdin
    from skillc.services.library.files import find_scene

    scene = asked.scene and find_scene(asked.scene)
    stdin = StdinFile(asked.stdin_filename, read_stdin()) if STDIN in asked.paths else None
    return CheckRequest(asked.paths or (Path(),), scene, stdin, asked.cache, asked.backend)


def _show(result: CheckResult, form: str) -> int:
    print_diagnostics(*result, form)
    return exit_code(result.diagnostics)


def _watch(request: CheckRequest, form: str) -> int:
    from skillc.cli.console import Terminal
    from skillc.services.check.watching import watch_sources

    try:
        watch_sources(request, lambda result: print_diagnostics(*result, form), Terminal())
    except KeyboardInterrupt:
        click.echo(err=True)
        return 0


def _show_fixes(request: CheckRequest, unsafe: bool) -> int:
    """Print what would change; return 1 if something would, or if errors would remain."""
    from skillc.services.check.fixing import find_fixes
    from skillc.services.reporting.reporter import format_count

    fixes = find_fixes(request, unsafe)
    click.echo(fixes.diff(), nl=False)
    print_remark(f"{format_count(fixes.count, 'problem')} can be fixed")
    return max(1 if fixes.count else 0, exit_code(fixes.remaining))


def _fix(request: CheckRequest, unsafe: bool, form: str) -> int:
    """Apply the fixes and print the remaining problems; a fixed standard input is printed to stdout."""
    from skillc.cli.console import Terminal
    from skillc.services.check.fixing import find_fixes, write_fixes
    from skillc.services.reporting.reporter import format_count

    fixes = find_fixes(request, unsafe)
    files = 0 if request.stdin else write_fixes(fixes)
    where = f" in {format_count(files, 'file')}" if files else ""
    print_remark(f"fixed {format_count(fixes.count, 'problem')}{where}")
    result = check_sources(request, read_libraries(request) if fixes.beside else fixes.libraries)
    if not request.stdin:
        return _show(result, form)
    click.echo(fixes.libraries[0].sources[0].text, nl=False)
    Terminal().show(*result)
    return exit_code(result.diagnostics)
