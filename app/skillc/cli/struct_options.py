"""Makes the options of a command from the fields of a struct, which its function gets whole."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from functools import wraps
from pathlib import Path
from typing import Any, NamedTuple

import click
import msgspec
from msgspec import inspect

from skillc.cli.options import PATH, Function, grouped_option

UNITS = {"_s": "SECONDS", "_mb": "MB"}
"""What ends the name of a field with a unit, which its option leaves out, and what stands for its value."""


class Documented(NamedTuple):
    """A field of a struct with its documentation, its type without `None`, and what a help shows of it."""

    field: msgspec.structs.FieldInfo
    text: str
    type: inspect.Type
    section: str
    metavar: str


def struct_options(
    struct: type[msgspec.Struct],
    without: Collection[str] = (),
    types: Mapping[str, click.ParamType[Any]] | None = None,
    complete: Mapping[str, Callable[..., Any]] | None = None,
) -> Callable[[Function], Function]:
    """Return what adds an option for each documented field, and gives the command's function the struct first.

    `without` are fields that have no option. `types` are the types of options, and `complete` what a shell offers for
    them, where the type of the field does not say it. Arguments and options that have the name of another field of the
    struct become its value too. A field with a unit, `deadline_s`, is the option `--deadline`.
    """
    documented = [each for each in documented_fields(struct) if each.field.name not in without]
    parameters = {parameter_name(each.name): each.name for each in msgspec.structs.fields(struct)}

    def decorate(function: Function) -> Function:
        @wraps(function)
        def collect(**given: Any) -> Any:
            values = {field: given.pop(name) for name, field in parameters.items() if name in given}
            return function(struct(**values), **given)

        decorated: Any = collect
        for each in reversed(documented):
            name = each.field.name
            option = _make_option(each, (types or {}).get(name), (complete or {}).get(name))
            decorated = option(decorated)
        return decorated  # type: ignore[no-any-return]

    return decorate


def documented_fields(struct: type[msgspec.Struct]) -> list[Documented]:
    """Return the fields of a struct that are documented, in their order."""
    found = []
    for field in msgspec.structs.fields(struct):
        match inspect.type_info(field.type):
            case inspect.Metadata(
                type=kind,
                extra_json_schema={"description": str(text)},
                extra={"section": str(section), "metavar": str(metavar)},
            ):
                found.append(Documented(field, text, _without_none(kind), section, metavar))
    return found


def parameter_name(field: str) -> str:
    """Return the name of a field as that of a parameter of a command: without its unit."""
    return next((field.removesuffix(unit) for unit in UNITS if field.endswith(unit)), field)


def _without_none(kind: inspect.Type) -> inspect.Type:
    """Return the type of a value that may be None, and any other as it is."""
    types = kind.types if isinstance(kind, inspect.UnionType) else (kind,)
    return next(each for each in types if not isinstance(each, inspect.NoneType))


def _make_option(
    about: Documented, given: click.ParamType[Any] | None, complete: Callable[..., Any] | None
) -> Callable[[Any], Any]:
    """Return what adds the option of a field."""
    name, default = about.field.name, about.field.default
    parameter = parameter_name(name)
    flag = f"--{parameter.replace('_', '-')}"
    settings: dict[str, Any] = {"default": default, "help": about.text, "shell_complete": complete}
    if isinstance(about.type, inspect.BoolType):
        shown = f"{flag}/--no-{flag.removeprefix('--')}" if default else flag
        return grouped_option(about.section, shown, parameter, is_flag=True, **settings)
    unit = next((shown for end, shown in UNITS.items() if name.endswith(end)), None)
    settings |= {"type": given or _click_type(about.type), "metavar": about.metavar or unit}
    if isinstance(about.type, inspect.VarTupleType):
        settings |= {"default": (), "multiple": True, "help": f"{about.text} Can be repeated."}
    elif default is not None:
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
