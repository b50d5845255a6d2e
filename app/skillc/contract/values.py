"""Types of values in requests, with their limits; the OpenAPI document states them."""

from __future__ import annotations

import re
from typing import Annotated, TypeAlias

import msgspec

MAX_BODY_BYTES = 2**20
_NAME, _WORDS = r"^[A-Za-z0-9][A-Za-z0-9_.-]*$", r"\S"
Why: TypeAlias = Annotated[str, msgspec.Meta(min_length=1, max_length=500, extra_json_schema={"pattern": _WORDS})]
"""Why a person changes the world; `check_why` says if there are no words in it."""
Name: TypeAlias = Annotated[str, msgspec.Meta(min_length=1, max_length=64, extra_json_schema={"pattern": _NAME})]
"""The name of a token; `check_name` says what is wrong with one."""


class CheckedBody(msgspec.Struct, frozen=True):
    """A body of a request with more limits than types can state."""

    def check(self) -> None:
        """Raise ValueError, whose message says what is to be written, if this is outside them."""
        raise NotImplementedError


def check_name(name: str) -> None:
    """Raise ValueError if a name is not written as names are."""
    if not re.fullmatch(_NAME, name):
        raise ValueError("a name has letters, digits, `_`, `.` and `-`, and begins with a letter or a digit")


def check_why(why: str) -> None:
    """Raise ValueError if a reason is blank."""
    if not re.search(_WORDS, why):
        raise ValueError("say why: the reason is blank")
