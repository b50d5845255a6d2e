"""Explain a recorded run: why this implementation, why this object, why did it fail.

Without a question an overview of the steps and, of a run that failed, what led there.

Exit code 1 when there is no recording that can be read, 2 for a question about something that is not in it.
"""

from __future__ import annotations

import sys
from pathlib import Path

import click


@click.command()
@click.argument("run", metavar="RUN_DIR", type=click.Path(path_type=Path))
@click.argument("question", required=False)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON document.")
def command(run: Path, question: str | None, as_json: bool) -> None:
    """Explain what `skillc run --out RUN_DIR` recorded.

    QUESTION is the number of a step (`2`, and `2.1` for a call inside it), the name of a skill or of an implementation
    (`Pick`), or a parameter (`gripper`, `Pick.gripper`, `2.gripper`).
    """
    from skillc_runtime.commands import _recordings, _why
    from skillc_runtime.recording.question import QuestionError, find_answer

    story = _recordings.told(run)
    try:
        answer = find_answer(story, question) if question is not None else None
    except QuestionError as error:
        raise click.UsageError(str(error)) from error
    if as_json:
        click.echo(_why.as_json(answer or story))
    else:
        click.echo(_why.overview(story, str(run)) if answer is None else _why.explanation(answer))
    sys.exit(0)
