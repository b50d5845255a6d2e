"""What a shell offers for the arguments of commands; nothing where the project here cannot be read."""

from __future__ import annotations

import click
from click.shell_completion import CompletionItem


def complete_task(_context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the tasks whose names begin so, with what they do."""
    from skillc.services.errors import ServiceError
    from skillc.services.task_list import list_tasks

    try:
        tasks = list_tasks()
    except (ServiceError, OSError):
        return []
    return [CompletionItem(each.name, help=each.doc or each.aim) for each in tasks if each.name.startswith(begun)]


def complete_diagnostic(_context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the diagnostics whose names begin so."""
    from skillc_compiler.manual import page_names

    return [CompletionItem(each) for each in sorted(page_names()) if each.startswith(begun)]
