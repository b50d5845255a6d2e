"""Encodes changes as JSON for a journal or a log, and decodes them."""

from __future__ import annotations

from collections.abc import Callable
from typing import get_args

import msgspec
from msgspec.structs import asdict, astuple

from skillc_runtime.store.literals import MAX_INTEGER
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.vectors import format_vector, is_vector, parse_vector

KINDS: dict[str, Callable[..., Change]] = {kind.__name__: kind for kind in get_args(Change)}


def encode_changes(changes: tuple[Change, ...]) -> str:
    """Return changes as one line of JSON: for each change a list of its class name and its fields."""
    listed = [[type(each).__name__, *_fields(each)] for each in changes]
    return msgspec.json.encode(listed, enc_hook=_vector_text).decode()


def decode_changes(text: str) -> tuple[Change, ...]:
    """Return the changes in a line of JSON; ValueError when it is invalid."""
    try:
        return tuple(_change(*each) for each in msgspec.json.decode(text, type=list[list[object]]))
    except (msgspec.DecodeError, KeyError, TypeError, RecursionError) as error:
        raise ValueError(f"these are not changes of a world: {error}") from error


def _fields(change: Change) -> list[object]:
    return list(astuple(change))


def _change(kind: object = "", *values: object) -> Change:
    change = KINDS[str(kind)](*map(_value, values))
    for name, value in asdict(change).items():
        if not _fits(name, value):
            raise TypeError(f"the {name} of a change of the kind {kind} is invalid")
    return change


def _fits(field: str, value: object) -> bool:
    """Whether a value is one that this field of a change can have."""
    if field == "types":
        return isinstance(value, tuple) and all(isinstance(each, str) for each in value)
    return _is_value(value) if field == "value" else isinstance(value, str)


def _is_value(value: object) -> bool:
    match value:
        case tuple():
            return all(map(_is_value, value))
        case int():
            return abs(value) < MAX_INTEGER
        case _:
            return isinstance(value, float | str) or is_vector(value)


def _vector_text(value: object) -> dict[str, str]:
    """Return a vector for JSON; TypeError for values that no change has."""
    if is_vector(value):
        return {"vector": format_vector(value)}
    raise TypeError(f"{type(value).__name__} cannot be written to a journal")


def _value(written: object) -> object:
    match written:
        case list():
            return tuple(map(_value, written))
        case {"vector": str(text)}:
            return parse_vector(text)
        case _:
            return written
