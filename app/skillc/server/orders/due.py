"""When the operations of an order are due."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from math import floor

from skillc.contract.order import OrderRequest

LATE_S = 60.0
"""An operation that could not be submitted this long after it was due is missed, in s."""


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
