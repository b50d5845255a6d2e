"""Types of values in requests, with their limits; the OpenAPI document states them."""

from __future__ import annotations

from typing import Annotated, TypeAlias

import msgspec

Why: TypeAlias = Annotated[str, msgspec.Meta(min_length=1, max_length=500, pattern=r"\S")]
"""Why a person changes the world."""
Name: TypeAlias = Annotated[str, msgspec.Meta(min_length=1, max_length=64, pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]*$")]
