"""Check a recorded run.

Checks that each event is possible after those before it, and runs a simulated task again from its recorded inputs.

Exit code 1 if an event is impossible, or another one when the run is repeated.
"""

from __future__ import annotations

from pathlib import Path

import click

from skillc.cli.command import Command
from skillc.cli.options import PATH, json_option

EXAMPLES = """
skillc replay out --check
skillc replay recording.mcap --check --library ./skills
"""


@click.command(cls=Command, examples=EXAMPLES)
@click.argument("run", metavar="RUN_DIR", type=PATH)
@click.option("--check", is_flag=True, required=True, help="Check the events, and run again from the recorded inputs.")
@click.option("--library", type=PATH, help="The library of the run; by default the one in the recording.")
@json_option
def command(run: Path, check: bool, library: Path | None, as_json: bool) -> int:
    """Check the run that `skillc run --out RUN_DIR` recorded, or one in an MCAP file.

    The events must be possible with the library of the run: the order of states and nodes, the names of skills,
    implementations and parameters, and the conditions of skills. Then a simulated run is repeated from its scene, its
    seed, and the recorded requests and plans; its events must be the same but for wall times.
    """
    import sys

    from skillc.cli.console import Terminal, page_of, print_json, print_lines
    from skillc.cli.replay_output import format_check
    from skillc.services.replaying.check import check_run

    assert check, "it is required"
    found = check_run(run, library, Terminal())
    if as_json:
        print_json(found)
    else:
        print_lines(format_check(found, page_of(sys.stdout)))
    return 0 if found.ok else 1
