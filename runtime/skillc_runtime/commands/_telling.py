"""Showing diagnostics on the terminal and to machines; nothing heavy is imported here."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TextIO

import click

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.encoding import decode, read_file
from skillc_dsl.source import Source

FORMS = ("full", "concise", "json", "sarif", "github")


def show(diagnostics: Sequence[Diagnostic], texts: Mapping[str, Source], form: str) -> int:
    """Print the diagnostics in a form, with a summary on stderr, and return the exit code: 1 with errors."""
    click.echo(rendered(diagnostics, texts, form), nl=False, color=True)
    click.echo(("\n" if form == "full" and diagnostics else "") + summary(diagnostics), err=True)
    return exit_code(diagnostics)


def exit_code(diagnostics: Iterable[Diagnostic]) -> int:
    """Return 1 if there is an error among the diagnostics."""
    return 1 if any(each.severity == "error" for each in diagnostics) else 0


def in_order(diagnostics: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Return each of the diagnostics once, in order of place."""
    return tuple(sorted(set(diagnostics), key=lambda each: (each.span, each.name)))


def tell(diagnostics: Sequence[Diagnostic], texts: Mapping[str, Source]) -> None:
    """Print diagnostics in full on stderr, for commands whose output is something else."""
    click.echo(_full(diagnostics, texts, sys.stderr), err=True, nl=False, color=True)


def rendered(diagnostics: Sequence[Diagnostic], texts: Mapping[str, Source], form: str) -> str:
    """Return the diagnostics in one of the forms."""
    match form:
        case "concise":
            from skillc_dsl.rendering.concise import render as concise

            return concise(diagnostics, texts)
        case "json":
            from skillc_dsl.rendering.json import render as as_json

            return as_json(diagnostics, texts)
        case "github":
            from skillc_dsl.rendering.github import render as github

            return github(diagnostics, texts)
        case "sarif":
            return _sarif(diagnostics, texts)
        case _:
            return _full(diagnostics, texts, sys.stdout)


def summary(diagnostics: Iterable[Diagnostic]) -> str:
    """Return how many problems there are in how many files, and how many of them `--fix` can cure."""
    found = tuple(diagnostics)
    if not found:
        return "no problems"
    errors = sum(each.severity == "error" for each in found)
    counts = ((errors, "error"), (len(found) - errors, "warning"))
    told = ", ".join(counted(count, word) for count, word in counts if count)
    files = counted(len({each.span.path for each in found}), "file")
    fixes = [each.fix for each in found if each.fix is not None]
    safe = sum(fix.safe for fix in fixes)
    cures = ((safe, "can be fixed with --fix"), (len(fixes) - safe, "guessed with --fix --unsafe-fixes"))
    cured = ", ".join(f"{count} {how}" for count, how in cures if count)
    return f"{told} in {files}" + (f"; {cured}" if cured else "")


def counted(count: int, word: str) -> str:
    """Return a number of things in words."""
    return f"{count} {word}{'s' * (count != 1)}"


def with_texts(diagnostics: Iterable[Diagnostic], known: Mapping[str, Source]) -> dict[str, Source]:
    """Return the texts of all files that diagnostics speak of, from `known` or from the disk, where there is one."""
    spans = (span for each in diagnostics for span in (each.span, *(label.span for label in each.labels)))
    found = {path: known.get(path) or _text(path) for path in sorted({span.path for span in spans})}
    return {path: source for path, source in found.items() if source is not None}


def coloured(stream: TextIO) -> bool:
    """Whether to use colours: on a terminal that has some, unless NO_COLOR is set; anywhere if FORCE_COLOR is."""
    if os.environ.get("NO_COLOR"):
        return False
    return bool(os.environ.get("FORCE_COLOR")) or (stream.isatty() and os.environ.get("TERM") != "dumb")


def page_width(stream: TextIO) -> int | None:
    """Return the cells from edge to edge of a terminal, or what COLUMNS says; None where there is no edge."""
    if not stream.isatty() and not os.environ.get("COLUMNS", "").isdigit():
        return None
    return max(shutil.get_terminal_size().columns, 40)


def _full(diagnostics: Iterable[Diagnostic], texts: Mapping[str, Source], stream: TextIO) -> str:
    from skillc_dsl.rendering.full import render as full

    return full(diagnostics, texts, colour=coloured(stream), width=page_width(stream))


def _sarif(diagnostics: Sequence[Diagnostic], texts: Mapping[str, Source]) -> str:
    from importlib.metadata import version

    from skillc_compiler.manual import pages
    from skillc_dsl.rendering.sarif import SarifRule, render

    rules = {page.name: SarifRule(page.name, page.title, page.prose) for page in pages().values()}
    return render(diagnostics, texts, rules, version("skillc"))


def _text(path: str) -> Source | None:
    try:
        return decode(path, read_file(Path(path)))
    except (OSError, ValueError):
        return None
