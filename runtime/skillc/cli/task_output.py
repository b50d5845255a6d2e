"""Prints the list of tasks."""

from __future__ import annotations

import sys
import textwrap
from collections.abc import Iterator, Sequence
from itertools import groupby

import click

from skillc.cli.console import has_colours, page_width
from skillc.services.task_list import TaskEntry

_ORIGINS = {"dependency": "a dependency", "shipped": "shipped with skillc"}
_WIDEST = 100
"""The width of the list where the output has none, in cells."""


def print_tasks(tasks: Sequence[TaskEntry]) -> None:
    """Print the tasks, library by library; the default task of the project is marked with an asterisk."""
    width = page_width(sys.stdout) or _WIDEST
    longest = max(len(each.name) for each in tasks)
    for (library, origin), members in groupby(tasks, key=lambda each: (each.library, each.origin)):
        click.secho(
            library if origin == "project" else f"{library}, {_ORIGINS[origin]}",
            bold=True,
            color=has_colours(sys.stdout),
        )
        for each in members:
            for line in _lines(each, longest, width):
                click.echo(line)


def _lines(task: TaskEntry, longest: int, width: int) -> Iterator[str]:
    """Yield the lines of a task: its name, then what it does and its scene, with a hanging indent."""
    text = f"{task.doc or task.aim} ({task.scene or 'no scene'})"
    first, *rest = textwrap.wrap(text, max(width - longest - 4, 24), break_on_hyphens=False)
    yield f"{'*' if task.is_default else ' '} {task.name:{longest}}  {first}"
    yield from (f"{'':{longest + 4}}{line}" for line in rest)
