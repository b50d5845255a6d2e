"""Makes the options of a command from the fields of a struct, which its function gets whole."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from functools import wraps
from pathlib import Path
from typing import Any

import click
import msgspec
from msgspec import inspect

from skillc.cli.options import PATH, Function, grouped_option
from skillc_runtime.recording.documented import DocumentedField, documented_fields

UNITS = {"_s": "SECONDS", "_mb": "MB"}
"""What ends the name of a field with a unit, which its option leaves out, and what stands for its value."""
PATHS: Mapping[str, click.ParamType[Any]] = {"PATH": click.Path(), "FOLDER": click.Path(file_okay=False)}
"""The types of options that are paths as text, by what stands for their values."""


def struct_options(
    struct: type[msgspec.Struct],
    only: Collection[str] | None = None,
    without: Collection[str] = (),
    types: Mapping[str, click.ParamType[Any]] | None = None,
    complete: Mapping[str, Callable[..., Any]] | None = None,
) -> Callable[[Function], Function]:
    """Return what adds an option for each documented field, and gives the command's function the struct first.

    `only` are the fields that have one, all if None, but for those `without`. `types` are the types of options, and
    `complete` what a shell offers for them, where the type of the field does not say it. Arguments and options that
    have the name of another field of the struct become its value too. A field with a unit, `deadline_s`, is the option
    `--deadline`.
    """
    fields = [each for each in documented_fields(struct) if each.section and each.name not in without]
    chosen = [each for each in fields if only is None or each.name in only]
    parameters = {parameter_name(each.name): each.name for each in msgspec.structs.fields(struct)}

    def decorate(function: Function) -> Function:
        @wraps(function)
        def collect(**given: Any) -> Any:
            values = {field: given.pop(name) for name, field in parameters.items() if name in given}
            return function(struct(**values), **given)

        decorated: Any = collect
        for each in reversed(chosen):
            option = _make_option(each, (types or {}).get(each.name), (complete or {}).get(each.name))
            decorated = option(decorated)
        return decorated  # type: ignore[no-any-return]

    return decorate


def parameter_name(field: str) -> str:
    """Return the name of a field as that of a parameter of a command: without its unit."""
    return next((field.removesuffix(unit) for unit in UNITS if field.endswith(unit)), field)


def _make_option(
    about: DocumentedField, given: click.ParamType[Any] | None, complete: Callable[..., Any] | None
) -> Callable[[Any], Any]:
    """Return what adds the option of a field."""
    parameter = parameter_name(about.name)
    flag = f"--{parameter.replace('_', '-')}"
    settings: dict[str, Any] = {"default": about.default, "help": about.text, "shell_complete": complete}
    if isinstance(about.type, inspect.BoolType):
        shown = f"{flag}/--no-{flag.removeprefix('--')}" if about.default else flag
        return grouped_option(about.section, shown, parameter, is_flag=True, **settings)
    unit = next((shown for end, shown in UNITS.items() if about.name.endswith(end)), None)
    settings |= {"type": given or PATHS.get(about.metavar) or _click_type(about.type), "metavar": about.metavar or unit}
    if isinstance(about.type, inspect.VarTupleType):
        settings |= {"default": (), "multiple": True, "help": f"{about.text} Can be repeated."}
    elif about.default is not None:
        settings["show_default"] = True
    return grouped_option(about.section, flag, parameter, **settings)


def _click_type(kind: inspect.Type) -> Any:
    """Return the type of an option with the limits of the type of a field."""
    match kind:
        case inspect.StrType() | inspect.VarTupleType():
            return str
        case inspect.IntType(ge=least, le=most):
            return click.IntRange(least, most) if (least, most) != (None, None) else int
        case inspect.FloatType(gt=above, ge=least, lt=below, le=most):
            bottom, top = above if least is None else least, below if most is None else most
            return click.FloatRange(bottom, top, min_open=above is not None, max_open=below is not None)
        case inspect.LiteralType(values=values):
            return click.Choice(values)
        case inspect.CustomType(cls=cls) if issubclass(cls, Path):
            return PATH
        case _:
            raise TypeError(f"a field of type {kind} needs the type of its option")
