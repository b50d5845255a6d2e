"""Turns the results and errors of services into messages and exit codes."""

from __future__ import annotations

import os
from typing import Any

import click

from skillc.cli.console import Terminal
from skillc.cli.options import restore_variable
from skillc.services.errors import DiagnosticsError, RequestError, ServiceError
from skillc_ontology import catalogue


class Command(click.Command):
    """A click command whose function returns the exit code, or None for 0, and may raise errors of services."""

    def invoke(self, ctx: click.Context) -> Any:
        """Run the function and exit with its code; ontology folders that a project adds are removed again."""
        before = os.environ.get(catalogue.VARIABLE)
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
        finally:
            restore_variable(catalogue.VARIABLE, before)
        ctx.exit(code or 0)
