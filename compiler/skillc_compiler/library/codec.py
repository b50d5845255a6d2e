"""A library as JSON and back."""

from __future__ import annotations

import msgspec

from skillc_compiler.library.skills import SkillLibrary

FORMAT = 1


class LibraryError(ValueError):
    """A text that is not a library this version can load; the message says where and what to do."""


def dumps(library: SkillLibrary) -> bytes:
    """Return the library as indented UTF-8 JSON, the same bytes for equal libraries."""
    return msgspec.json.format(msgspec.json.encode(library, order="sorted"), indent=1) + b"\n"


def loads(text: bytes, name: str) -> SkillLibrary:
    """Read a library. `name` is what an error calls the text; LibraryError for anything but a whole library."""
    try:
        library = msgspec.json.decode(text, type=SkillLibrary)
    except msgspec.DecodeError as error:
        raise LibraryError(f"{name} is not a compiled library ({error}); make it anew with `skillc compile`") from error
    if library.format != FORMAT:
        raise LibraryError(
            f"{name} has format {library.format}, this skillc reads {FORMAT}; make it anew with `skillc compile`"
        )
    return library
