"""Show what is installed and what is missing.

Exit code 1 if something that every command needs is missing.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import click

from skillc.cli.command import Command
from skillc.cli.layout import Row, TableCell
from skillc.cli.options import json_option

if TYPE_CHECKING:
    from skillc.services.reporting.environment import Finding


@click.command(cls=Command)
@json_option
def command(as_json: bool) -> int:
    """Show which programs and packages are installed, and what works without the missing ones."""
    import json

    from skillc.cli.console import page_of, print_lines
    from skillc.services.reporting.environment import diagnose_environment

    found = diagnose_environment()
    if as_json:
        rows = [{"name": f.name, "found": f.found, "version": f.version, "meaning": f.meaning} for f in found]
        click.echo(json.dumps(rows, indent=2))
    else:
        print_lines(page_of(sys.stdout).columns([_row(each) for each in found]))
    return 0 if all(f.found for f in found if f.required) else 1


def _row(finding: Finding) -> Row:
    mark = TableCell("ok", "good") if finding.found else TableCell("--", "bad" if finding.required else "warning")
    return mark, finding.name, finding.version, finding.meaning
