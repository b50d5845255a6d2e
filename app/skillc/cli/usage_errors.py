"""Prints mistakes in a command line: what is wrong, what was probably meant, and how the command is used."""

from __future__ import annotations

import click

from skillc.cli.console import print_error


def print_click_error(error: click.ClickException) -> None:
    """Print an error to stderr; one in the options of a command with the usage of that."""
    context = getattr(error, "ctx", None)
    if context is None:
        print_error(_format_message(error))
        return
    with context.scope(cleanup=False):
        print_error(_format_message(error))
    click.echo(f"\n{context.get_usage()}\nFor more information, try `{context.command_path} --help`.", err=True)


def _format_message(error: click.ClickException) -> str:
    """Return the message of an error without capital letter and full stop, as all messages of skillc are written."""
    if isinstance(error, click.NoSuchOption):
        hint = f"; did you mean `{error.possibilities[0]}`?" if error.possibilities else ""
        return f"there is no option `{error.option_name}`{hint}"
    text = error.format_message().removesuffix(".")
    return text[:1].lower() + text[1:] if text[1:2].islower() else text
