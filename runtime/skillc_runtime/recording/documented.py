"""Documents a field of a struct once, for JSON Schema, the command line, keyword arguments and forms."""

from __future__ import annotations

from typing import NamedTuple

import msgspec
from msgspec import inspect

PATHS = ("PATH", "FOLDER")
"""What stands for the value of a field that is a path."""


class DocumentedField(NamedTuple):
    """A field of a struct: its documentation, its type without `None`, and what a help shows of it.

    It has no `section` if it is not an option of commands, but an argument.
    """

    name: str
    default: object
    text: str
    type: inspect.Type
    section: str
    metavar: str

    @property
    def is_path(self) -> bool:
        """Whether its value is a path, as text."""
        return self.metavar in PATHS


def documented(text: str, section: str = "Options", metavar: str = "") -> msgspec.Meta:
    """Return what annotates a field: its documentation, where a help lists it, and what stands there for its value."""
    return msgspec.Meta(description=text, extra={"section": section, "metavar": metavar})


def documented_fields(struct: type[msgspec.Struct]) -> list[DocumentedField]:
    """Return the fields of a struct that are documented, in their order."""
    found = []
    for field in msgspec.structs.fields(struct):
        match inspect.type_info(field.type):
            case inspect.Metadata(
                type=kind,
                extra_json_schema={"description": str(text)},
                extra={"section": str(section), "metavar": str(metavar)},
            ):
                found.append(DocumentedField(field.name, field.default, text, _without_none(kind), section, metavar))
    return found


def _without_none(kind: inspect.Type) -> inspect.Type:
    """Return the type of a value that may be None, and any other as it is."""
    if not isinstance(kind, inspect.UnionType):
        return kind
    types = tuple(each for each in kind.types if not isinstance(each, inspect.NoneType))
    return types[0] if len(types) == 1 else inspect.UnionType(types)
