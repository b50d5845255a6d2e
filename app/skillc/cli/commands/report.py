"""Make the report of a recorded run.

Runs the task again from its recorded scene, seed, requests and plans, and writes report, figures and film.

Exit code 1 if the run cannot be repeated.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click
from msgspec import structs

from skillc.cli.command import Command
from skillc.cli.options import PATH, json_option
from skillc.cli.run_options import run_options
from skillc.cli.struct_options import PATHS

if TYPE_CHECKING:
    from skillc_runtime.recording.run_spec import RunSpec

EXAMPLES = """
skillc report out
skillc report recording.mcap --out report --no-film
"""


@click.command(cls=Command, examples=EXAMPLES)
@click.argument("run", metavar="RUN_DIR", type=PATH)
@click.option("--out", type=PATHS["FOLDER"], metavar="FOLDER", help="Write to this folder; by default to RUN_DIR.")
@click.option("--library", type=PATHS["PATH"], help="The library of the run; by default the one in the recording.")
@run_options(only=("film", "film_quality", "looks", "gif"))
@json_option
def command(spec: RunSpec, run: Path, as_json: bool) -> int:
    """Write report.html, result.json, figures, film and stills of a recorded run, as `skillc run --out` does.

    Figures and film need more than a recording has, so the task is run again from the recorded inputs; if an event is
    another one then, there is no report.
    """
    from skillc.cli.console import Terminal, print_json
    from skillc.cli.progress.film import FilmProgress
    from skillc.cli.progress.run_output import print_results
    from skillc.services.replaying.report import report_recorded
    from skillc.services.reporting.files import check_writable

    if spec.out is None and not run.is_dir():
        raise click.UsageError(f"{run} is no folder: name the folder of the report with --out")
    folder = Path(spec.out or run)
    library = None if spec.library is None else Path(spec.library)
    check_writable(folder)
    terminal = Terminal()
    made = report_recorded(run, library, structs.replace(spec, out=str(folder)), terminal, FilmProgress(as_json))
    if as_json:
        print_json(made.result)
    else:
        print_results([made.result], folder if made.written else None)
    return 0 if made.written else 1
