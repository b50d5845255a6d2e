"""Run the tests of libraries on the world model alone.

Prints each test, and what is not as it expects, with the calls that led there. Exit code 1 if a test fails.
"""

from __future__ import annotations

from pathlib import Path

import click
import msgspec

from skillc.cli.command import Command
from skillc.cli.options import PATH, json_option
from skillc.cli.struct_options import struct_options

EXAMPLES = """
skillc test
skillc test tasks.skill
skillc test "a_tray_*" --watch
skillc test --coverage --junit tests.xml
"""


class TestOptions(msgspec.Struct, frozen=True, kw_only=True):
    """Which tests are run, and how their results are reported."""

    wanted: tuple[str, ...]
    coverage: bool
    junit: Path | None
    watch: bool
    as_json: bool


@click.command(cls=Command, examples=EXAMPLES)
@click.argument("wanted", nargs=-1, metavar="[FILE|NAME]..")
@click.option(
    "--coverage", is_flag=True, help="Print what the tests run of the library, and the lines that they do not."
)
@click.option("--junit", type=PATH, metavar="FILE", help="Write the results to this file as JUnit XML.")
@click.option("--watch", is_flag=True, help="Run the tests again whenever a file changes, until interrupted.")
@json_option
@struct_options(TestOptions)
def command(asked: TestOptions) -> int:
    """Run the tests in FILEs, libraries or folders, by default of the library here, or those with a NAME.

    A NAME may have `*` for any letters. Skills act by what they declare, in milliseconds: nothing is simulated. The
    exit code is 1 if a test fails.
    """
    from skillc.cli.output.tests import run_and_print, watch_and_print

    if asked.watch and asked.as_json:
        raise click.UsageError("--watch cannot be used with --json")
    if not asked.watch:
        return run_and_print(asked.wanted, asked.coverage, asked.junit, asked.as_json)
    try:
        watch_and_print(asked.wanted, asked.coverage, asked.junit)
    except KeyboardInterrupt:
        click.echo(err=True)
        return 0
