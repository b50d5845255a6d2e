"""Explain the choices and failures of a recorded run.

Without a question, prints an overview of the steps and, if the run failed, the chain of causes.

Exit code 1 if there is no readable recording, 2 if the question is about something that is not in it.
"""

from __future__ import annotations

from pathlib import Path

import click

from skillc.cli.command import Command
from skillc.cli.options import PATH, json_option


@click.command(cls=Command)
@click.argument("run", metavar="RUN", type=PATH)
@click.argument("question", required=False)
@json_option
def command(run: Path, question: str | None, as_json: bool) -> None:
    """Explain the run that `skillc run --out RUN` recorded: a folder, or an MCAP file.

    QUESTION is the number of a step (`2`, or `2.1` for a call inside it), the name of a skill or an implementation
    (`Pick`), or a parameter (`gripper`, `Pick.gripper`, `2.gripper`). The origin of a parameter is followed through
    every call to the expression, the default or the fact in the scene, with its line. Without QUESTION, print an
    overview.
    """
    from skillc.cli.console import Terminal, print_json, print_text
    from skillc.services.recording.recordings import answer_question, read_run
    from skillc.services.recording.story_text import format_answer, format_overview

    story = read_run(run, Terminal())
    answer = answer_question(story, question) if question is not None else None
    if as_json:
        print_json(answer or story)
    else:
        print_text(format_overview(story, str(run)) if answer is None else format_answer(answer))
