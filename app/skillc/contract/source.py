"""The texts of a library: which there are, what they say, and changes."""

from __future__ import annotations

from typing import Annotated

import msgspec

from skillc.contract.values import MAX_BODY_BYTES


class SourceInfo(msgspec.Struct, frozen=True):
    """A text of a library, by the path that places in events and diagnostics have; `editable` if it is its own."""

    path: str
    editable: bool


class SourceText(msgspec.Struct, frozen=True):
    """A text; `hash` is that of the file, by which a change says what it is based on."""

    path: str
    editable: bool
    hash: str
    text: str


class SourcePath(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Which text, by its path in the library."""

    path: Annotated[str, msgspec.Meta(min_length=1, max_length=500)]


class SourceChange(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A new text, in the place of the one whose file has the hash `base_hash`."""

    text: Annotated[str, msgspec.Meta(max_length=MAX_BODY_BYTES)]
    base_hash: Annotated[str, msgspec.Meta(pattern="^[0-9a-f]{64}$")]


class LanguageHello(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The first message of a client, as JSON: its token, and the library whose texts it edits.

    A page has the cookie of a session instead of a token.
    """

    library: Annotated[str, msgspec.Meta(max_length=200)]
    token: Annotated[str, msgspec.Meta(max_length=200)] | None = None
