"""Makes the requests of a client from what a program asks for; RequestError for a value that cannot be meant."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import datetime
from typing import Any

from skillc.contract.operation import OperationRequest
from skillc.contract.order import Missed, OrderRequest
from skillc.errors import RequestError
from skillc.values.arguments import (
    optional_seconds,
    require_choice,
)
from skillc.values.keywords import read_keywords
from skillc.values.run_keywords import OrderKeywords


def describe_operation(task: str | None, settings: Mapping[str, Any], known: type) -> OperationRequest:
    """Return a request for exactly one of a task, a goal and a skill call, as keyword arguments say."""
    request = read_keywords(OperationRequest, settings, known, task)
    if [request.task, request.goal, request.call].count(None) != 2:
        raise RequestError("name exactly one of a task, a goal and a skill call")
    return request


def describe_order(request: OperationRequest, at: datetime, times: OrderKeywords) -> OrderRequest:
    """Return a request to submit something at a time, once or repeatedly."""
    until, missed = times.get("until"), times.get("missed", "run-once")
    if at.tzinfo is None or (until is not None and until.tzinfo is None):
        raise RequestError("`at` and `until` need their offset from UTC, such as `datetime.now(UTC)` has")
    choice, every_s = require_choice(missed, Missed, "`missed`"), optional_seconds(times.get("every_s"), "`every_s`")
    return OrderRequest(request, at, every_s, until, times.get("count"), choice)
