"""Explain a diagnostic, with a bad and a good example.

Without a name, lists all diagnostics by family. Exit code 2 if there is no diagnostic of that name.
"""

from __future__ import annotations

import json

import click
from msgspec import structs

from skillc.cli.command import Command
from skillc.cli.completions import complete_diagnostic


@click.command(cls=Command)
@click.argument("name", required=False, shell_complete=complete_diagnostic)
@click.option("--json", "as_json", is_flag=True, help="Print the page, or all pages, as JSON.")
def command(name: str | None, as_json: bool) -> None:
    """Explain the diagnostic NAME, such as `unknown-class`; without NAME, list all diagnostics."""
    from skillc.cli.output.manual_pages import format_contents, format_page
    from skillc_compiler.manual import load_page, load_pages, page_names
    from skillc_dsl.spelling import did_you_mean

    if name is not None and name not in page_names():
        hint = did_you_mean(name, page_names()) or "`skillc explain` lists all diagnostics"
        raise click.UsageError(f"there is no diagnostic `{name}`; {hint}")
    if as_json:
        data = structs.asdict(load_page(name)) if name else [structs.asdict(each) for each in load_pages().values()]
        click.echo(json.dumps(data, indent=2, ensure_ascii=False))
    else:
        click.echo(format_page(load_page(name)) if name else format_contents(load_pages()), nl=False, color=True)
