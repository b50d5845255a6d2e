"""Show what is installed and what is missing.

Exit code 1 if something that every command needs is missing.
"""

from __future__ import annotations

import click

from skillc.cli.command import Command
from skillc.cli.options import json_option


@click.command(cls=Command)
@json_option
def command(as_json: bool) -> int:
    """Show which programs and packages are installed, and what works without the missing ones."""
    import json

    from skillc.services.environment import diagnose_environment

    found = diagnose_environment()
    if as_json:
        rows = [{"name": f.name, "found": f.found, "version": f.version, "meaning": f.meaning} for f in found]
        click.echo(json.dumps(rows, indent=2))
    else:
        for finding in found:
            mark = "ok" if finding.found else "--"
            click.echo(f"{mark}  {finding.name:<22} {finding.version:<24} {finding.meaning}".rstrip())
    return 0 if all(f.found for f in found if f.required) else 1
