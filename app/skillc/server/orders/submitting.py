"""Submits the operations of orders when they are due."""

from __future__ import annotations

import asyncio
import sqlite3
from datetime import datetime
from http import HTTPStatus

from msgspec import structs

from skillc.cells.database import DatabaseError
from skillc.contract.messages import Refused, Submit
from skillc.contract.order import Order
from skillc.server.access.leases import LeaseHeld
from skillc.server.access.roles import includes
from skillc.server.context import ServerContext
from skillc.server.log import log
from skillc.server.orders.due import Due, find_due
from skillc.server.supervisor import CellSupervisor

LOOK_S = 0.5
"""How often the clock is looked at, in s: it may jump, so nobody waits for a time."""


async def keep_submitting(server: ServerContext, cell: CellSupervisor) -> None:
    """Submit what is due for a cell, until this is cancelled."""
    while True:
        try:
            await submit_due(server, cell, server.clock())
        except (DatabaseError, sqlite3.Error) as error:
            log("orders", cell=cell.settings.name, reason=str(error))
        await asyncio.sleep(LOOK_S)


async def submit_due(server: ServerContext, cell: CellSupervisor, now: datetime) -> None:
    """Submit for each order for a cell the last operation that is due, if that is possible now.

    Its id is made of the order and its number, so that it is submitted once also if the server ends before that is
    noted. An order never goes back: a clock that is set back repeats nothing.
    """
    for order, first in server.orders.list_open(cell.settings.name):
        removed = server.orders.find(order.id) is None  # while an earlier one was submitted
        if not removed and (due := find_due(order.order, first, now)) is not None:
            await _submit(server, cell, order, due)


async def _submit(server: ServerContext, cell: CellSupervisor, order: Order, due: Due) -> None:
    operation = f"{order.id}-{due.number + 1}"
    if server.has_operation(operation):
        server.orders.pass_on(order, due.number, operation, "")
    elif due.is_missed and order.order.missed == "skip":
        _refuse(server, order, due, f"missed: {order.reason or 'the server was off'}")
    elif (refused := _find_refusal(server, order)) is not None:
        _refuse(server, order, due, refused)
    elif (obstacle := _find_obstacle(server, cell, order)) is not None:
        server.orders.wait(order, obstacle)
    else:
        request = structs.replace(order.order.request, owner=order.owner)
        answer = await cell.request(Submit(operation=operation, request=request))
        _note(server, order, due, operation, answer)


def _note(server: ServerContext, order: Order, due: Due, operation: str, answer: Refused | bytes) -> None:
    if not isinstance(answer, Refused):
        server.orders.pass_on(order, due.number, operation, "")
        server.audit.add(order.owner, "", f"order {order.id}", HTTPStatus.CREATED, "")
    elif answer.kind in ("off", "busy"):
        server.orders.wait(order, answer.describe())
    else:
        _refuse(server, order, due, answer.describe())


def _refuse(server: ServerContext, order: Order, due: Due, reason: str) -> None:
    server.orders.pass_on(order, due.number, None, reason)
    server.audit.add(order.owner, "", f"order {order.id}", HTTPStatus.CONFLICT, reason)


def _find_refusal(server: ServerContext, order: Order) -> str | None:
    """Return why the owner of an order may submit nothing any more."""
    role = next((each.role for each in server.state.tokens.list() if each.name == order.owner), None)
    if role is None:
        return f"the token `{order.owner}` is revoked"
    return None if includes(role, "operate") else f"`{order.owner}` has the role `{role}`, and `operate` is needed"


def _find_obstacle(server: ServerContext, cell: CellSupervisor, order: Order) -> str | None:
    """Return for what an operation that is due has to wait."""
    if not cell.ready:
        return f"{cell.settings.name} is off: {cell.status.reason}"
    if order.operation in cell.operations:
        return f"{order.operation} has not ended"
    try:
        server.leases.check(cell.settings.name, order.owner)
    except LeaseHeld as error:
        return str(error)
    return None
