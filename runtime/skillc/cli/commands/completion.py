"""Print the script with which bash, zsh or fish complete commands."""

from __future__ import annotations

import click
from click.shell_completion import get_completion_class

from skillc.cli.command import Command

SHELLS = ("bash", "zsh", "fish")
VARIABLE = "_SKILLC_COMPLETE"
"""The variable of the environment in which click looks for what a shell asks."""


@click.command(cls=Command)
@click.argument("shell", type=click.Choice(SHELLS))
def command(shell: str) -> None:
    """Print the completion script of SHELL.

    Put `eval "$(skillc completion bash)"` into ~/.bashrc (bash 4.4 or newer), the same with zsh into ~/.zshrc, or
    `skillc completion fish | source` into ~/.config/fish/config.fish.
    """
    from skillc.cli.main import skillc

    script = get_completion_class(shell)
    assert script is not None, "click knows all of these shells"
    click.echo(script(skillc, {}, "skillc", VARIABLE).source())
