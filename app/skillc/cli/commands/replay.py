"""Show a recorded run again, or check it.

Shows the run in the terminal as it was. --check checks that each event is possible after those before it, and runs a
simulated task again from its recorded inputs.

Exit code 1 if with --check an event is impossible, or another one when the run is repeated.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from skillc.cli.command import Command
from skillc.cli.options import PATH, json_option, pace_option

if TYPE_CHECKING:
    from skillc_runtime.execution.pace import Pace

EXAMPLES = """
skillc replay out --pace 4
skillc replay out --check
skillc replay recording.mcap --check --library ./skills
"""


@click.command(cls=Command, examples=EXAMPLES)
@click.argument("run", metavar="RUN_DIR", type=PATH)
@pace_option
@click.option("--check", is_flag=True, help="Check the events, and run again from the recorded inputs.")
@click.option(
    "--library",
    type=PATH,
    help="The library for --check; by default the recorded one, or the project here if the library has Python code.",
)
@json_option
def command(run: Path, pace: Pace, check: bool, library: Path | None, as_json: bool) -> int:
    """Show the run that `skillc run --out RUN_DIR` recorded, or one in an MCAP file, as it was; nothing is computed.

    Keys pause the replay, go to the next call, and change its pace, as those of `skillc run` do.

    With --check, the events must be possible with the library of the run: the order of states and nodes, the names of
    skills, implementations and parameters, and the conditions of skills. Then a simulated run is repeated from its
    scene, its seed, and the recorded requests and plans; its events must be the same but for wall times.
    """
    import sys

    from skillc.cli.console import Terminal, page_of, print_json, print_lines
    from skillc.cli.output.replay import format_check

    if not check:
        if library is not None:
            raise click.UsageError("--library is for --check")
        return _play(run, pace, as_json)
    from skillc.services.replaying.check import check_run

    found = check_run(run, library, Terminal())
    if as_json:
        print_json(found)
    else:
        print_lines(format_check(found, page_of(sys.stdout)))
    return 0 if found.ok else 1


def _play(run: Path, pace: Pace, as_json: bool) -> int:
    """Show a run, and print its result."""
    from skillc.cli.console import Terminal, print_json
    from skillc.cli.progress.replayed import play
    from skillc.cli.progress.run_output import print_results
    from skillc.services.recording.recordings import find_recording, read_envelopes, read_result

    path = find_recording(run)
    events = read_envelopes(path, Terminal())
    result = read_result(path, events)
    if as_json:
        print_json(result)
        return 0
    play(result.task, events, pace)
    print_results([result], None)
    return 0
