"""Reads keyword arguments as the fields of a struct."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeVar

import msgspec
from msgspec import inspect

from skillc.values.arguments import (
    optional_seconds,
    read_arguments,
    read_pace,
    require_count,
    require_flag,
    require_one_of,
    require_path,
    require_text,
    wrong_type,
)
from skillc_runtime.recording.documented import DocumentedField, documented_fields
from skillc_runtime.recording.run_spec import RENAMED

S = TypeVar("S", bound=msgspec.Struct)


def read_keywords(struct: type[S], keywords: Mapping[str, Any], known: type, task: str | None = None) -> S:
    """Return a struct with the values of keyword arguments, of a `task` if one is named.

    `known` is the typed dictionary that has them. TypeError for any other, RequestError for a value that cannot be
    meant.
    """
    names = {*known.__required_keys__, *known.__optional_keys__}  # type: ignore[attr-defined]
    for name in keywords.keys() - names:
        now = RENAMED.get(name, "")
        raise TypeError(f"there is no keyword `{name}`" + (f"; it is called `{now}` now" if now in names else ""))
    fields = {each.name: each for each in documented_fields(struct)}
    values = {name: _read(fields[name], value) for name, value in keywords.items() if name in fields}
    return struct(**values) if task is None else struct(task=require_text(task, "the task"), **values)


def _read(field: DocumentedField, value: Any) -> object:
    """Return the value of a field that a keyword argument means."""
    what = f"`{field.name}`"
    if value is None and field.default is None:
        return None
    if field.is_path:
        return str(require_path(value, what))
    match field.type:
        case inspect.StrType():
            return require_text(value, what)
        case inspect.BoolType():
            return require_flag(value, what)
        case inspect.IntType(ge=least, le=most):
            return require_count(value, what, least, most)
        case inspect.FloatType():
            return optional_seconds(value, what)
        case inspect.LiteralType(values=values):
            return require_one_of(value, values, what)
        case inspect.VarTupleType():
            return read_texts(value, what)
        case inspect.DictType():
            return read_arguments(value)
        case inspect.UnionType():
            read_pace(value)
            return value
        case _:
            raise AssertionError(f"keywords have no values of type {field.type}")


def read_texts(value: object, what: str) -> tuple[str, ...]:
    """Return texts; RequestError for anything but a sequence of them."""
    if isinstance(value, str) or not isinstance(value, Sequence):
        raise wrong_type(value, what, "a sequence of texts")
    return tuple(require_text(each, what) for each in value)
