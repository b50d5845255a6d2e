"""A library as JSON and back."""

from __future__ import annotations

import msgspec

from skillc_model.skills import FORMAT, SkillLibrary

COMPILE_AGAIN = "make it anew with `skillc compile`"


class LibraryError(ValueError):
    """A text that is not a library this version can load; the message says where and what to do."""


class _Header(msgspec.Struct):
    """What every format of a library has."""

    format: int


def dumps(library: SkillLibrary) -> bytes:
    """Return the library as indented UTF-8 JSON, the same bytes for equal libraries."""
    return msgspec.json.format(msgspec.json.encode(library, order="sorted"), indent=1) + b"\n"


def loads(text: bytes, name: str) -> SkillLibrary:
    """Read a library. `name` is what an error calls the text; LibraryError for anything but a whole library."""
    try:
        found = msgspec.json.decode(text, type=_Header).format
        if found != FORMAT:
            raise LibraryError(f"{name} has format {found}, this skillc reads {FORMAT}; {COMPILE_AGAIN}")
        return msgspec.json.decode(text, type=SkillLibrary)
    except msgspec.DecodeError as error:
        raise LibraryError(f"{name} is not a compiled library ({error}); {COMPILE_AGAIN}") from error
