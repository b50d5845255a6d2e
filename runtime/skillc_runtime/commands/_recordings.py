"""From the folder of a run to its story, or to an explanation and exit code 1."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import NoReturn

import click

from skillc_runtime.commands._paths import look
from skillc_runtime.recording.history import read_story
from skillc_runtime.recording.reader import TraceError, TraceReader
from skillc_runtime.recording.story import Story

NAME = "events.jsonl"


def told(run: Path) -> Story:
    """Read what happened in a run, given by its folder or its file of events; exit when that is not possible."""
    path = run / NAME if look(run).kind == "folder" else run
    found = look(path)
    if found.kind == "missing":
        _refuse(_missing(run))
    if found.kind != "file":
        _refuse(f"{path} {found.is_what}")
    reader = TraceReader(path)
    try:
        story = read_story(reader)
    except TraceError as error:
        _refuse(str(error))
    except OSError as error:
        _refuse(f"{path} cannot be read: {error.strerror or error}")
    if story is None:
        _refuse(f"{path} has nothing of a task: the run ended before it began")
    if reader.cut_short:
        click.echo(f"note: the last line of {path} is cut short; what is told ends at {story.last:.1f} s", err=True)
    return story


def _missing(run: Path) -> str:
    if look(run).kind != "folder":
        return f"there is no {run}; `skillc run TASK --out DIR` records a run in DIR, unless it is refused"
    others = sorted(str(each.parent) for each in run.glob(f"*/{NAME}"))
    if others:
        return f"{run} has no {NAME}; there are recordings in {', '.join(others)}"
    return f"{run} has no {NAME}: `skillc run TASK --out DIR` writes it, unless the task is refused before it starts"


def _refuse(message: str) -> NoReturn:
    click.echo(f"error: {message}", err=True)
    sys.exit(1)
