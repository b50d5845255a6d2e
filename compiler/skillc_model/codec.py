"""Reads and writes a compiled library as JSON."""

from __future__ import annotations

import msgspec

from skillc_model.skills import FORMAT, SkillLibrary

COMPILE_AGAIN = "compile the library again with `skillc compile`"


class LibraryError(ValueError):
    """The text is not a library that this version can load; the message says where and what to do."""


class _Header(msgspec.Struct):
    """The field that every version of the format has."""

    format: int


def dumps(library: SkillLibrary) -> bytes:
    """Return the library as indented UTF-8 JSON, the same bytes for equal libraries."""
    return msgspec.json.format(msgspec.json.encode(library, order="sorted"), indent=1) + b"\n"


def loads(text: bytes, name: str) -> SkillLibrary:
    """Return the library in a JSON text, called `name` in errors; LibraryError if it is not a complete library."""
    try:
        found = msgspec.json.decode(text, type=_Header).format
        if found != FORMAT:
            raise LibraryError(f"{name} has format {found}, this skillc reads {FORMAT}; {COMPILE_AGAIN}")
        return msgspec.json.decode(text, type=SkillLibrary)
    except msgspec.DecodeError as error:
        raise LibraryError(f"{name} is not a compiled library ({error}); {COMPILE_AGAIN}") from error
