"""Orders: operations that are submitted at a time, once or again and again."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from functools import partial
from http import HTTPStatus

from msgspec import structs

from skillc.cells.database import transaction
from skillc.contract.order import Order, OrderRequest
from skillc.server.asking import ask_about
from skillc.server.http.api_call import ApiCall
from skillc.server.http.outcome import sign_request
from skillc.server.idempotency import KeyReused
from skillc.server.orders.due import LATE_S
from skillc.server.orders.store import TooManyOrders
from skillc.server.problems import KEY_REUSED, ApiRefusal
from skillc.server.routes.world import QUERY_S
from skillc.workers.questions import check_operation
from skillc_runtime.recording.envelope import make_run_id

LAST = datetime(2200, 1, 1, tzinfo=UTC)
"""Orders do not begin after this."""


async def add_order(call: ApiCall) -> Order:
    cell = call.server.find_cell(call.path["cell"]).settings.name
    wanted = structs.replace(call.body, request=sign_request(call.body.request, call.client))
    name = make_run_id(wanted.request.task or "order")
    _check(wanted, call.server.clock())
    request = wanted.request
    await ask_about(call, partial(check_operation, request, request.breakpoints), type(None), QUERY_S)
    try:
        with transaction(call.server.state.database):
            if call.key is not None and (first := _claim(call, cell, call.key, name)) != name:
                return _find(call, first)
            call.server.orders.add(name, cell, call.client.name, wanted)
    except TooManyOrders as error:
        raise ApiRefusal(HTTPStatus.TOO_MANY_REQUESTS, str(error)) from error
    return _find(call, name)


async def list_orders(call: ApiCall) -> tuple[Order, ...]:
    return call.server.orders.list(call.server.find_cell(call.path["cell"]).settings.name)


async def remove_order(call: ApiCall) -> None:
    call.server.orders.remove(_find(call, call.path["order"]).id)


def _find(call: ApiCall, name: str) -> Order:
    if (found := call.server.orders.find(name)) is None:
        raise ApiRefusal(HTTPStatus.NOT_FOUND, f"there is no order `{name}`")
    return found


def _claim(call: ApiCall, cell: str, key: str, name: str) -> str:
    try:
        return call.server.keys.claim(call.client.name, key, b"\0".join((b"order", cell.encode(), call.content)), name)
    except KeyReused as error:
        raise ApiRefusal(HTTPStatus.UNPROCESSABLE_ENTITY, str(error), kind=KEY_REUSED) from error


def _check(wanted: OrderRequest, now: datetime) -> None:
    """Raise ApiRefusal for an order that cannot be one at this time, whatever its operation is."""
    request = wanted.request
    if request.continues:
        raise _refuse("an order cannot continue an operation")
    if [request.task, request.goal, request.call].count(None) != 2:
        raise _refuse("name exactly one of a task, a goal and a skill call")
    if not now - timedelta(seconds=LATE_S) <= wanted.at <= LAST:
        raise _refuse(f"{wanted.at.isoformat()} is past, or after {LAST.year}; it is {now.isoformat()}")
    if wanted.every_s is None and (wanted.until is not None or wanted.count is not None):
        raise _refuse("`until` and `count` need `every_s`")
    if wanted.until is not None and wanted.until < wanted.at:
        raise _refuse("`until` is before `at`")


def _refuse(detail: str) -> ApiRefusal:
    return ApiRefusal(HTTPStatus.UNPROCESSABLE_ENTITY, detail)
