"""The options of every command about what it prints: `--quiet`, `--verbose` and `--color`."""

from __future__ import annotations

from typing import Any, Literal, NamedTuple

import click

Color = Literal["auto", "always", "never"]
_KEY = "skillc.cli.settings"


class OutputSettings(NamedTuple):
    """How much a command prints, and whether in colours."""

    quiet: bool = False
    verbose: bool = False
    color: Color = "auto"


def output_settings() -> OutputSettings:
    """Return the settings of the command that runs, or the defaults outside of commands."""
    context = click.get_current_context(silent=True)
    found: OutputSettings = context.meta.get(_KEY, OutputSettings()) if context is not None else OutputSettings()
    return found


def _set(context: click.Context, option: click.Parameter, value: Any) -> None:
    """Keep the value of an option that is given; the same options may also stand before the command's name."""
    if not value:
        return
    assert option.name is not None
    settings: OutputSettings = context.meta.get(_KEY, OutputSettings())._replace(**{option.name: value})
    if settings.quiet and settings.verbose:
        raise click.UsageError("--quiet and --verbose cannot be combined")
    context.meta[_KEY] = settings


class GroupedOption(click.Option):
    """An option in a section of the help."""

    def __init__(self, *arguments: Any, group: str = "Options", **options: Any) -> None:
        super().__init__(*arguments, **options)
        self.group = group


def output_options() -> list[click.Option]:
    """Return `--quiet`, `--verbose` and `--color`, which need no parameters of the command's function."""
    common: dict[str, Any] = {"expose_value": False, "is_eager": True, "callback": _set, "group": "Output"}
    return [
        GroupedOption(["-q", "--quiet"], is_flag=True, help="Print only results, warnings and errors.", **common),
        GroupedOption(["-v", "--verbose"], is_flag=True, help="Print more details.", **common),
        GroupedOption(
            ["--color"],
            type=click.Choice(("auto", "always", "never")),
            help="Use colours; by default if the output is a terminal.",
            **common,
        ),
    ]
