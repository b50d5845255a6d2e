"""What a shell offers for the arguments of commands; nothing where the project here cannot be read."""

from __future__ import annotations

import click
from click.shell_completion import CompletionItem


def complete_task(_context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the tasks whose names begin so, with what they do."""
    from skillc.errors import ServiceError
    from skillc.services.tasks.listing import list_tasks

    try:
        tasks = list_tasks()
    except (ServiceError, OSError):
        return []
    return [CompletionItem(each.name, help=each.doc or each.aim) for each in tasks if each.name.startswith(begun)]


def complete_diagnostic(_context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the diagnostics whose names begin so."""
    from skillc_compiler.manual import page_names

    return [CompletionItem(each) for each in sorted(page_names()) if each.startswith(begun)]


def complete_scene(_context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the shipped scenes whose names begin so, and let the shell add files."""
    from skillc_ontology import catalogue

    shipped = [
        CompletionItem(name, help="a shipped scene") for name in catalogue.scene_names() if name.startswith(begun)
    ]
    return [*shipped, CompletionItem(begun, type="file")]


def complete_template(_context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the templates of projects whose names begin so, with what they contain."""
    from skillc.services.scaffolding.project_templates import TEMPLATES

    return [CompletionItem(each.name, help=each.summary) for each in TEMPLATES if each.name.startswith(begun)]


def complete_device(context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the shipped robots, grippers or tools whose names begin so."""
    from skillc.services.scaffolding.additions import FOLDERS
    from skillc_ontology import catalogue

    folder = FOLDERS.get(context.params.get("kind") or "")
    found = sorted(path.stem for path in (catalogue.ROOT / folder).glob("*.xml")) if folder else []
    return [CompletionItem(name) for name in found if name.startswith(begun)]
