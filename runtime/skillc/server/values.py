"""Types of values in requests, with their limits; the OpenAPI document states them."""

from __future__ import annotations

from typing import Annotated, TypeAlias

import msgspec

Reason: TypeAlias = Annotated[str, msgspec.Meta(max_length=500, description="Why, for the history.")]
Name: TypeAlias = Annotated[str, msgspec.Meta(min_length=1, max_length=64, pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]*$")]
