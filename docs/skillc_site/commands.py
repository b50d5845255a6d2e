"""The reference of the command line, made from the click commands themselves."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape
from inspect import cleandoc

import click

from skillc.cli.main import skillc

INTRODUCTION = """\
# The command line

This page is made from the code; `skillc COMMAND --help` prints the same. Exit codes: 0 success, 1 the input has
errors, 2 the command line is wrong, 3 a task failed (with `run --strict` also: its success is not verified), 70
internal error of skillc, 130 interrupted (143 by SIGTERM, 129 by SIGHUP), 141 the output was closed.
"""


def command_page() -> str:
    """Return the page as Markdown."""
    context = click.Context(skillc, info_name="skillc")
    return INTRODUCTION + "".join(_describe(skillc, context, 2))


def _describe(group: click.Group, context: click.Context, level: int) -> Iterator[str]:
    for name in group.list_commands(context):
        command = group.get_command(context, name)
        if command is None or command.hidden:
            continue
        inner = click.Context(command, info_name=name, parent=context)
        yield f"\n{'#' * level} {inner.command_path}\n\n"
        yield f"```text\n{inner.command_path} {' '.join(command.collect_usage_pieces(inner))}\n```\n\n"
        yield f"{_prose(command.help or '')}\n"
        yield from _options(command, inner)
        yield from _examples(getattr(command, "examples", ""))
        if isinstance(command, click.Group):
            yield from _describe(command, inner, level + 1)


def _options(command: click.Command, context: click.Context) -> Iterator[str]:
    records = [each.get_help_record(context) for each in command.get_params(context)]
    rows = [record for record in records if record and record[1]]
    if rows:
        yield "\n| option | meaning |\n|---|---|\n"
        yield from (f"| <code>{_code(option)}</code> | {_escape(_cell(meaning))} |\n" for option, meaning in rows)


def _examples(text: str) -> Iterator[str]:
    if text:
        yield "\n```console\n" + "\n".join(line.strip() for line in text.strip().split("\n")) + "\n```\n"


def _prose(text: str) -> str:
    """Return a help text as Markdown: click marks what it does not fill with a line of a backspace."""
    paragraphs = cleandoc(text.partition("\f")[0]).split("\n\n")
    return "\n\n".join(_paragraph(each) for each in paragraphs)


def _paragraph(text: str) -> str:
    if text.startswith("\b"):
        return f"```text\n{text.lstrip(chr(8)).strip(chr(10))}\n```"
    return _escape(text)


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|")


def _code(text: str) -> str:
    """Return the content of a code element in a table: a table has no escape for the bar within backticks."""
    return escape(" ".join(text.split())).replace("|", "&#124;").replace("_", "&#95;").replace("*", "&#42;")


def _escape(text: str) -> str:
    """Keep what would be HTML or emphasis outside of code as it is."""
    parts = text.split("`")
    parts[::2] = [part.replace("<", "&lt;").replace("*", "\\*").replace("_", "\\_") for part in parts[::2]]
    return "`".join(parts)
