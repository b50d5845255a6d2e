"""Prints the list of tasks."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from itertools import groupby

from skillc.cli.console import page_of, print_lines
from skillc.cli.layout import TableCell
from skillc.services.tasks.listing import TaskEntry

_ORIGINS = {"dependency": "a dependency", "shipped": "shipped with skillc"}


def print_tasks(tasks: Sequence[TaskEntry]) -> None:
    """Print the tasks, library by library; the default task of the project is marked with an asterisk."""
    page = page_of(sys.stdout)
    longest = max(len(_signature(each)) for each in tasks)
    for (library, origin), members in groupby(tasks, key=lambda each: (each.library, each.origin)):
        title = library if origin == "project" else f"{library}, {_ORIGINS[origin]}"
        rows = [(TableCell(f"{_mark(each)} {_signature(each):{longest}}", "name"), _describe(each)) for each in members]
        print_lines([page.paint(title, "strong"), *page.columns(rows)])


def _mark(task: TaskEntry) -> str:
    return "*" if task.is_default else " "


def _describe(task: TaskEntry) -> str:
    return f"{task.doc or task.aim} ({task.scene or 'no scene'})"


def _signature(task: TaskEntry) -> str:
    """Return the name of a task with those of its parameters."""
    names = ", ".join(each.partition(":")[0] for each in task.parameters)
    return f"{task.name}({names})" if names else task.name
