"""Disturbances of simulated cells, to see what they do then: somebody pushes an arm, or moves a thing."""

from __future__ import annotations

from http import HTTPStatus

from skillc.contract.cell import CellStatus
from skillc.contract.messages import Disturb
from skillc.server.endpoint import ApiCall, ApiEndpoint
from skillc.server.outcome import UNAVAILABLE, command_cell
from skillc_runtime.devices.disturbances import Disturbance


async def disturb_cell(call: ApiCall) -> CellStatus:
    cell = call.server.find_cell(call.path["cell"])
    await command_cell(call, cell, Disturb(disturbance=call.body, who=call.client.name))
    return cell.status


ENDPOINTS = (
    ApiEndpoint(
        "POST",
        "/cells/{cell}/disturbances",
        "operate",
        "Let something happen to a simulated cell that no skill does",
        disturb_cell,
        CellStatus,
        body=Disturbance,
        refusals=(HTTPStatus.NOT_FOUND, HTTPStatus.CONFLICT, *UNAVAILABLE),
    ),
)
