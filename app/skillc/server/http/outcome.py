"""Gives commands of clients to cells, and turns what a cell answers into what the API answers.

A body that does not fit its type is 422. What fits, but cannot be done with the library and the world that the cell has
now, such as a task that it does not have, is 409.
"""

from __future__ import annotations

from http import HTTPStatus
from typing import assert_never

from msgspec import structs

from skillc.contract.cell import CellStatus
from skillc.contract.messages import Message, Refused
from skillc.contract.operation import OperationRequest
from skillc.server.access.leases import LeaseHeld
from skillc.server.access.tokens import Client
from skillc.server.http.api_call import ApiCall
from skillc.server.problems import LEASE_HELD, ApiRefusal
from skillc.server.supervisor import CellSupervisor


def check_lease(call: ApiCall, cell: CellSupervisor) -> None:
    """Raise ApiRefusal if another client has the lease of a cell."""
    try:
        call.server.leases.check(cell.settings.name, call.client.name)
    except LeaseHeld as error:
        raise ApiRefusal(HTTPStatus.CONFLICT, str(error), kind=LEASE_HELD) from error


def sign_request(request: OperationRequest, client: Client) -> OperationRequest:
    """Return a request with who makes it; what an agent asks for has to be approved."""
    return structs.replace(request, owner=client.name, approve=request.approve or client.agent)


async def command_cell(call: ApiCall, cell: CellSupervisor, message: Message) -> None:
    """Give a command of a client to a cell, and wait until it is done and durable; ApiRefusal if it is refused."""
    check_lease(call, cell)
    raise_refused(await cell.request(message))


async def command_named_cell(call: ApiCall, message: Message) -> CellStatus:
    """Do so with the cell that a request is about; return its status."""
    cell = call.server.find_cell(call.path["cell"])
    await command_cell(call, cell, message)
    return cell.status


def raise_refused(answer: Refused | bytes) -> bytes:
    """Return what a cell has answered; ApiRefusal if it has refused a request."""
    if isinstance(answer, Refused):
        raise ApiRefusal(_find_status(answer), answer.describe(), answer.allowed or None, answer.diagnosis)
    return answer


def _find_status(refused: Refused) -> HTTPStatus:
    match refused.kind:
        case "invalid" | "state":
            return HTTPStatus.CONFLICT
        case "busy":
            return HTTPStatus.TOO_MANY_REQUESTS
        case "off":
            return HTTPStatus.SERVICE_UNAVAILABLE
        case _:
            assert_never(refused.kind)
