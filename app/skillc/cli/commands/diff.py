"""Compare two recorded runs.

Compares settings, requests, plans, choices, outcomes, measures, times and signals.

Exit code 0 whether they differ or not, 1 if there is no readable recording.
"""

from __future__ import annotations

from pathlib import Path

import click

from skillc.cli.command import Command
from skillc.cli.options import PATH, json_option

EXAMPLES = """
skillc diff monday tuesday
skillc diff seed0 seed1 --json
"""


@click.command(cls=Command, examples=EXAMPLES)
@click.argument("run", metavar="RUN_DIR", type=PATH)
@click.argument("other", metavar="RUN_DIR", type=PATH)
@json_option
def command(run: Path, other: Path, as_json: bool) -> None:
    """Show in what two runs differ that `skillc run --out RUN_DIR` recorded.

    The differences are in the order in which one may cause another: settings, requests, plan, choices, outcomes,
    measures, times, signals. Of times and signals the text has the largest differences, --json has all.
    """
    import sys

    from skillc.cli.console import Terminal, page_of, print_json, print_lines, print_remark
    from skillc.cli.output.diff import format_diff
    from skillc.services.run_diff.compare import compare_runs
    from skillc.services.run_diff.recorded import read_recorded_run

    terminal = Terminal()
    diff = compare_runs(read_recorded_run(run, terminal), read_recorded_run(other, terminal))
    if as_json:
        print_json(diff)
        return
    print_lines(format_diff(diff, page_of(sys.stdout)))
    for note in diff.notes:
        print_remark(note)
