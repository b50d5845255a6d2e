"""Orders: what is submitted at a time, once or again and again, and how far an order is."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Literal, TypeAlias

import msgspec

from skillc.contract.operation import OperationRequest

Instant: TypeAlias = Annotated[datetime, msgspec.Meta(tz=True)]
"""A date and time with its offset from UTC, as of RFC 3339."""
Missed: TypeAlias = Literal["run-once", "skip"]

MAX_EVERY_S = 366 * 86_400.0
MAX_COUNT = 1_000_000


class OrderRequest(msgspec.Struct, frozen=True, omit_defaults=True, forbid_unknown_fields=True):
    """An operation that is submitted `at` a time, or from then on again `every_s` s, `count` times or `until` a time.

    One is missed if it could not be submitted within 60 s after it was due, because the server or the cell was off,
    another client had the lease, or the operation before had not ended. Of those that were missed the last one is
    submitted as soon as that is possible, or none (`skip`).
    """

    request: OperationRequest
    at: Instant
    every_s: Annotated[float, msgspec.Meta(ge=1.0, le=MAX_EVERY_S)] | None = None
    until: Instant | None = None
    count: Annotated[int, msgspec.Meta(ge=1, le=MAX_COUNT)] | None = None
    missed: Missed = "run-once"


class Order(msgspec.Struct, frozen=True):
    """An order of `owner`, and how far it is: `next_at` is when its next operation is due, null if there is none.

    `operation` is the last one that was submitted; `reason` says why the last one that was due was not.
    """

    id: str
    cell: str
    owner: str
    order: OrderRequest
    next_at: datetime | None
    operation: str | None = None
    reason: str = ""
