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
        renamed = _find_renamed(error)
        near = f"did you mean `{error.possibilities[0]}`?" if error.possibilities else ""
        hint = f"it is called `{renamed}` now" if renamed else near
        return f"there is no option `{error.option_name}`{hint and f'; {hint}'}"
    text = error.format_message().removesuffix(".")
    return text[:1].lower() + text[1:] if text[1:2].islower() else text


def _find_renamed(error: click.NoSuchOption) -> str | None:
    """Return how an option of earlier versions is called now, if the command has it."""
    from skillc_runtime.recording.run_spec import RENAMED

    word = RENAMED.get(error.option_name.lstrip("-").replace("-", "_"), "").replace("_", "-")
    known = error.ctx.command.get_params(error.ctx) if error.ctx is not None else []
    return next((option for each in known for option in each.opts if word and option == f"--{word}"), None)
