"""Options that several commands share; nothing heavy is imported here."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click
from click.shell_completion import CompletionItem

from skillc.cli.settings import GroupedOption
from skillc_ontology import catalogue

if TYPE_CHECKING:
    from skillc_runtime.execution.pace import Pace

Function = TypeVar("Function", bound=Callable[..., Any])
PATH = click.Path(path_type=Path)
FOLDER = click.Path(path_type=Path, file_okay=False)
FOLDER.name = "folder"
EXISTING_FOLDER = click.Path(path_type=Path, file_okay=False, exists=True)
EXISTING_FOLDER.name = "folder"
WORLD, PLANNING, EXECUTION, OUTPUT = "World", "Planning", "Execution", "Output"
"""Sections of the help in which the options of a command are."""
WITH_ONTOLOGY = ("check", "compile", "doc", "graph", "plan", "run", "world")
"""The commands that read libraries or scenes."""


class BackendType(click.ParamType[str]):
    """The name of a back end that is installed."""

    name = "name"

    def convert(self, value: str, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Return the name; a usage error with those that there are for another one."""
        from skillc.errors import RequestError
        from skillc.services.project.backends import require_backend

        try:
            return require_backend(value)
        except RequestError as error:
            self.fail(str(error), param, ctx)

    def shell_complete(self, ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        """Return the names that begin so."""
        from skillc.services.project.backends import list_backends

        return [CompletionItem(each) for each in list_backends() if each.startswith(incomplete)]


BACKEND = BackendType()


class ShareType(click.ParamType[float]):
    """A share above 0 and at most 1, in per cent or as a number."""

    name = "share"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """Return the share."""
        number, sign, rest = str(value).partition("%")
        try:
            share = float(number) / (100.0 if sign else 1.0)
        except ValueError:
            share = 0.0
        if rest or not 0.0 < share <= 1.0:
            self.fail(f"`{value}` is not a share above 0% and at most 100%; write it as 10% or 0.1", param, ctx)
        return share


SHARE = ShareType()


def grouped_option(group: str, *names: str, **settings: Any) -> Callable[[Function], Function]:
    """Return a decorator that adds an option in the section `group` of the help."""
    return click.option(*names, cls=GroupedOption, group=group, **settings)


def task_arguments(complete: Callable[..., list[CompletionItem]] | None = None) -> Callable[[Function], Function]:
    """Return what adds the values of a task's parameters, `NAME=VALUE ..`, as the mapping `arguments`."""
    return click.argument(
        "arguments", nargs=-1, metavar="[NAME=VALUE]..", callback=_parse_arguments, shell_complete=complete
    )


def _parse_arguments(context: click.Context, _parameter: click.Parameter, texts: tuple[str, ...]) -> dict[str, str]:
    """Return the values by name; UsageError for a text without `=`, and for a name that is given twice."""
    arguments: dict[str, str] = {}
    for text in texts:
        name, equal, value = text.partition("=")
        if not equal or not name.strip() or not value.strip():
            form = "write NAME=VALUE, such as tray=lab:Tray-1"
            takes_more = any(each.name == "beside" for each in context.command.params)
            other = f", or `--beside {text}` for another task" if takes_more else ""
            raise click.UsageError(f"`{text}` is no argument of a task; {form}{other}")
        if name.strip() in arguments:
            raise click.UsageError(f"the argument `{name.strip()}` is given twice")
        arguments[name.strip()] = value.strip()
    return arguments


def json_option(function: Function) -> Function:
    """Add `--json`, as `as_json`."""
    return click.option("--json", "as_json", is_flag=True, help="Print the result as JSON.")(function)


def store_options(function: Function) -> Function:
    """Add `--store` and `--reset`."""
    function = grouped_option(WORLD, "--reset", is_flag=True, help="Empty the store and load the scene into it again.")(
        function
    )
    help_ = "Keep the world in a folder or on a SPARQL server; the first use loads the scene into it."
    return grouped_option(WORLD, "--store", metavar="FOLDER|URL", help=help_)(function)


def pace_option(function: Function) -> Function:
    """Add `--pace` of a replay."""
    return click.option(
        "--pace",
        default="real",
        show_default=True,
        metavar="fast|real|N",
        callback=_parse_pace,
        help="Let time pass as in the run, N times as fast, or not at all.",
    )(function)


def add_ontology_option(command: click.Command) -> click.Command:
    """Add `--ontology` to a command, once."""
    if not any(parameter.name == "ontology" for parameter in command.params):
        command.params.append(
            GroupedOption(
                ["--ontology"],
                group=WORLD,
                multiple=True,
                type=EXISTING_FOLDER,
                expose_value=False,
                callback=_set_folders,
                help=f"A folder of further ontologies. Can be repeated; {catalogue.VARIABLE} can list more.",
            )
        )
    return command


def _parse_pace(_context: click.Context, _option: click.Parameter, value: str) -> Pace:
    from skillc_runtime.execution.pace import Pace, parse_pace

    try:
        return Pace(parse_pace(value))
    except ValueError as error:
        raise click.BadParameter(str(error)) from error


def _set_folders(context: click.Context, _option: click.Parameter, value: tuple[Path, ...]) -> tuple[Path, ...]:
    """Put the folders first in the environment variable while the command runs."""
    before = os.environ.get(catalogue.VARIABLE)
    if value:
        os.environ[catalogue.VARIABLE] = os.pathsep.join([*map(str, value), *([before] if before else [])])
        context.call_on_close(lambda: restore_variable(catalogue.VARIABLE, before))
    return value


def restore_variable(name: str, before: str | None) -> None:
    """Give an environment variable its former value, None if it had none."""
    if before is None:
        os.environ.pop(name, None)
    else:
        os.environ[name] = before
