"""Turns the results and errors of services into messages and exit codes, and formats the help of commands."""

from __future__ import annotations

import sys
from typing import Any

import click

from skillc.cli.console import Terminal, print_error
from skillc.cli.settings import GroupedOption, output_options
from skillc.errors import ServiceError
from skillc.extras import naming_extras
from skillc_ontology import catalogue

OPTIONS, OUTPUT = "Options", "Output"
"""The first and the last section of options in each help text."""


class Command(click.Command):
    """A click command whose function returns the exit code, or None for 0, and may raise errors of services.

    It has the options about what is printed. `examples` are command lines that its help shows.
    """

    def __init__(self, *arguments: Any, examples: str = "", **options: Any) -> None:
        super().__init__(*arguments, **options)
        self.examples = examples
        self.params += output_options()

    def invoke(self, ctx: click.Context) -> Any:
        """Run the function and exit with its code; folders that a project adds to paths are removed again."""
        modules = sys.path[:]
        try:
            with catalogue.folder_scope(), naming_extras():
                code = super().invoke(ctx)
        except ServiceError as error:
            if error.diagnostics:
                Terminal().show(error.diagnostics, error.texts)
            else:
                print_error(str(error))
            code = error.exit_code
        finally:
            sys.path[:] = modules
        ctx.exit(code or 0)

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the options in their sections."""
        write_options(self, ctx, formatter)

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the examples."""
        if self.examples:
            with formatter.section("Examples"):
                for line in self.examples.strip().split("\n"):
                    formatter.write(f"{'':{formatter.current_indent}}{line.strip()}\n")


class Group(click.Group):
    """A group of commands that prints its help if no command is named, and names the nearest one to an unknown one."""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self.params += output_options()

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Parse the arguments; without any, print the help and exit."""
        if not args and not ctx.resilient_parsing:
            click.echo(ctx.get_help())
            ctx.exit()
        return super().parse_args(ctx, args)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command; for an unknown name, fail with the nearest one, or with the names of all commands."""
        names = self.list_commands(ctx)
        if args and not args[0].startswith("-") and args[0] not in names:
            from difflib import get_close_matches

            near = get_close_matches(args[0], names, n=1)
            hint = f"did you mean `{near[0]}`?" if near else f"the commands are {', '.join(names)}"
            ctx.fail(f"there is no command `{args[0]}`; {hint}")
        return super().resolve_command(ctx, args)

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the commands, then the options in their sections."""
        self.format_commands(ctx, formatter)
        write_options(self, ctx, formatter)


def write_options(command: click.Command, ctx: click.Context, formatter: click.HelpFormatter) -> None:
    """Write the options of a command in their sections: first those of its own, then those of all commands."""
    sections: dict[str, list[tuple[str, str]]] = {}
    for parameter in command.get_params(ctx):
        record = parameter.get_help_record(ctx)
        if record is not None and isinstance(parameter, click.Option):
            group = parameter.group if isinstance(parameter, GroupedOption) else OPTIONS
            common = "--json" in parameter.opts or "--help" in parameter.opts
            sections.setdefault(OUTPUT if common else group, []).append(record)
    for name in sorted(sections, key=lambda name: (name == OUTPUT, name != OPTIONS)):
        with formatter.section(name if name == OPTIONS else f"{name} options"):
            formatter.write_dl(sections[name])
