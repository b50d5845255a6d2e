"""Start the language server.

It speaks the Language Server Protocol over stdin and stdout. Editors start it; editors/README.md describes how.
"""

from __future__ import annotations

import click

from skillc.cli.command import Command


@click.command(cls=Command)
@click.option("--stdio", is_flag=True, help="Use stdin and stdout; this is the default and the only transport.")
def command(stdio: bool) -> int:
    """Start the language server, which gives editors diagnostics, completion, hover and renaming.

    It speaks the Language Server Protocol over stdin and stdout, and is started by editors.
    """
    from skillc.lsp.server import serve

    return 0 if serve() else 1
