"""Leases: who alone may command a cell for some time."""

from __future__ import annotations

from http import HTTPStatus

from skillc.contract.cell import Lease, LeaseRequest
from skillc.server.access.leases import LeaseHeld
from skillc.server.access.roles import includes
from skillc.server.http.api_call import ApiCall
from skillc.server.problems import LEASE_HELD, ApiRefusal


async def show_lease(call: ApiCall) -> Lease:
    return call.server.leases.find(_name(call))


async def take_lease(call: ApiCall) -> Lease:
    wanted: LeaseRequest = call.body
    if wanted.takeover and not includes(call.client.role, "admin"):
        raise ApiRefusal(HTTPStatus.FORBIDDEN, "a takeover needs the role `admin`")
    try:
        return call.server.leases.take(_name(call), call.client.name, wanted.duration_s, wanted.takeover)
    except LeaseHeld as error:
        raise ApiRefusal(HTTPStatus.CONFLICT, str(error), kind=LEASE_HELD) from error


async def release_lease(call: ApiCall) -> None:
    try:
        call.server.leases.release(_name(call), call.client.name)
    except LeaseHeld as error:
        raise ApiRefusal(HTTPStatus.CONFLICT, str(error), kind=LEASE_HELD) from error


def _name(call: ApiCall) -> str:
    return call.server.find_cell(call.path["cell"]).settings.name
