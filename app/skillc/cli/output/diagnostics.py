"""Prints diagnostics in the formats of `--format` and `--json`; nothing heavy is imported here."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping, Sequence

import click

from skillc.cli.console import has_colours, page_width, print_remark
from skillc.services.reporting.reporter import format_count
from skillc_dsl.diagnostics import Diagnostic, Severity
from skillc_dsl.source import Source

FORMS = ("full", "concise", "github", "sarif")
JSON = "json"


def print_diagnostics(diagnostics: Sequence[Diagnostic], texts: Mapping[str, Source], form: str) -> None:
    """Print the diagnostics in a format of FORMS or as JSON to stdout, and a summary to stderr."""
    click.echo(render_diagnostics(diagnostics, texts, form), nl=False, color=True)
    if form == "full" and diagnostics:
        print_remark("")
    print_remark(summarise(diagnostics))


def exit_code(diagnostics: Iterable[Diagnostic]) -> int:
    """Return 1 if there is an error among the diagnostics, else 0."""
    return 1 if any(each.severity == "error" for each in diagnostics) else 0


def render_diagnostics(diagnostics: Sequence[Diagnostic], texts: Mapping[str, Source], form: str) -> str:
    """Return the diagnostics in a format of FORMS, or as JSON."""
    match form:
        case "concise":
            from skillc_dsl.rendering.concise import render as concise

            return concise(diagnostics, texts)
        case _ if form == JSON:
            from skillc_dsl.rendering.json import render as as_json

            return as_json(diagnostics, texts)
        case "github":
            from skillc_dsl.rendering.github import render as github

            return github(diagnostics, texts)
        case "sarif":
            return _sarif(diagnostics, texts)
        case _:
            from skillc_dsl.rendering.full import render as full

            return full(diagnostics, texts, colour=has_colours(sys.stdout), width=page_width(sys.stdout))


def summarise(found: Sequence[Diagnostic]) -> str:
    """Return how many problems there are in how many files, and how many of them `--fix` can fix."""
    if not found:
        return "no problems"
    severities: tuple[Severity, ...] = ("error", "warning", "note")
    counts = [(sum(each.severity == severity for each in found), severity) for severity in severities]
    problems = ", ".join(format_count(count, word) for count, word in counts if count)
    files = format_count(len({each.span.path for each in found}), "file")
    fixes = [each.fix for each in found if each.fix is not None]
    safe = sum(fix.safe for fix in fixes)
    ways = ((safe, "can be fixed with --fix"), (len(fixes) - safe, "guessed with --fix --unsafe-fixes"))
    fixable = ", ".join(f"{count} {how}" for count, how in ways if count)
    return f"{problems} in {files}" + (f"; {fixable}" if fixable else "")


def _sarif(diagnostics: Sequence[Diagnostic], texts: Mapping[str, Source]) -> str:
    from importlib.metadata import version

    from skillc_compiler.manual import load_pages
    from skillc_dsl.rendering.sarif import SarifRule, render

    rules = {page.name: SarifRule(page.name, page.title, page.prose or page.title) for page in load_pages().values()}
    return render(diagnostics, texts, rules, version("skillc"))
