"""Tell what is installed and what is missing.

Exit code 1 when something that every command needs is missing.
"""

from __future__ import annotations

import sys

import click


@click.command()
@click.option("--json", "as_json", is_flag=True, help="Print one JSON document.")
def command(as_json: bool) -> None:
    """Tell what is installed and what that means."""
    import json

    from skillc_runtime.commands import _findings

    found = _findings.findings()
    if as_json:
        rows = [{"name": f.name, "found": f.found, "version": f.version, "meaning": f.meaning} for f in found]
        click.echo(json.dumps(rows, indent=2))
    else:
        for finding in found:
            mark = "ok" if finding.found else "--"
            click.echo(f"{mark}  {finding.name:<22} {finding.version:<24} {finding.meaning}".rstrip())
    sys.exit(0 if all(f.found for f in found if f.required) else 1)
