"""Turns the results and errors of services into messages and exit codes."""

from __future__ import annotations

from typing import Any

import click

from skillc.cli.console import Terminal
from skillc.services.errors import DiagnosticsError, RequestError, ServiceError


class Command(click.Command):
    """A click command whose function returns the exit code, or None for 0, and may raise errors of services."""

    def invoke(self, ctx: click.Context) -> Any:
        """Run the function and exit with its code."""
        try:
            code = super().invoke(ctx)
        except RequestError as error:
            raise click.UsageError(str(error), ctx) from error
        except DiagnosticsError as error:
            Terminal().show(error.diagnostics, error.texts)
            code = error.exit_code
        except ServiceError as error:
            click.echo(f"error: {error}", err=True)
            code = error.exit_code
        ctx.exit(code or 0)
