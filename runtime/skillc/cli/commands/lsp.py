"""Serve editors: problems, completion, hover, renaming and more, over stdin and stdout.

Speaks the Language Server Protocol. Editors start it themselves; editors/README.md tells how.
"""

from __future__ import annotations

from importlib.util import find_spec

import click

from skillc.cli.command import Command


@click.command(cls=Command)
@click.option("--stdio", is_flag=True, help="Accepted because editors pass it; there is no other way.")
def command(stdio: bool) -> int:
    """Start the language server."""
    if find_spec("pygls") is None:
        raise click.UsageError("the language server needs pygls: pip install 'skillc[editor]'")
    from skillc.lsp.server import serve

    return 0 if serve() else 1
