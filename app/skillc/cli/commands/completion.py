"""Print the script with which bash, zsh or fish complete commands."""

from __future__ import annotations

import click
from click.shell_completion import FishComplete, ShellComplete, ZshComplete

from skillc.cli.bash_completion import BashCompletion
from skillc.cli.command import Command

SHELLS: dict[str, type[ShellComplete]] = {"bash": BashCompletion, "zsh": ZshComplete, "fish": FishComplete}


@click.command(cls=Command)
@click.argument("shell", type=click.Choice(tuple(SHELLS)))
def command(shell: str) -> None:
    """Print the completion script of SHELL.

    Put `eval "$(skillc completion bash)"` into ~/.bashrc (bash 4.4 or newer), the same with zsh into ~/.zshrc, or
    `skillc completion fish | source` into ~/.config/fish/config.fish.
    """
    from skillc.cli.main import VARIABLE, skillc

    click.echo(SHELLS[shell](skillc, {}, "skillc", VARIABLE).source())
