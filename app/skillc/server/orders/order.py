"""Orders as data, and when the operations of an order are due."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from math import floor
from typing import Annotated, Literal, TypeAlias

import msgspec

from skillc.contract.operation import OperationRequest

Instant: TypeAlias = Annotated[datetime, msgspec.Meta(tz=True)]
"""A date and time with its offset from UTC, as of RFC 3339."""
Missed: TypeAlias = Literal["run-once", "skip"]

MAX_EVERY_S = 366 * 86_400.0
MAX_COUNT = 1_000_000
LATE_S = 60.0
"""An operation that could not be submitted this long after it was due is missed, in s."""


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


@dataclass(frozen=True, slots=True)
class Due:
    """The operation `number` of an order, counted from 0, is due since `late_s` s."""

    number: int
    late_s: float

    @property
    def is_missed(self) -> bool:
        """Whether it could not be submitted in time."""
        return self.late_s > LATE_S


def find_due(order: OrderRequest, first: int, now: datetime) -> Due | None:
    """Return the last operation of an order that is due, from number `first` on; None if there is none."""
    passed_s = (now - order.at).total_seconds()
    if passed_s < 0.0:
        return None
    last = int(min(_find_last(order), floor(passed_s / order.every_s) if order.every_s else 0))
    return Due(last, passed_s - last * (order.every_s or 0.0)) if last >= first else None


def find_time(order: OrderRequest, number: int) -> datetime | None:
    """Return when an operation of an order is due, in UTC; None if the order has none of this number."""
    if number > _find_last(order):
        return None
    return (order.at + timedelta(seconds=number * (order.every_s or 0.0))).astimezone(UTC)


def _find_last(order: OrderRequest) -> float:
    """Return the number of the last operation of an order; inf if it has no end, -1 if it has no operation."""
    if order.every_s is None:
        return 0
    by_count = float("inf") if order.count is None else order.count - 1
    if order.until is None:
        return by_count
    return min(by_count, floor((order.until - order.at).total_seconds() / order.every_s))
