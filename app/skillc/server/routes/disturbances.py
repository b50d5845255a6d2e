"""Disturbances of simulated cells, to see what they do then: somebody pushes an arm, or moves a thing."""

from __future__ import annotations

from skillc.contract.cell import CellStatus
from skillc.contract.messages import Disturb
from skillc.server.http.api_call import ApiCall
from skillc.server.http.outcome import command_cell


async def disturb_cell(call: ApiCall) -> CellStatus:
    cell = call.server.find_cell(call.path["cell"])
    await command_cell(call, cell, Disturb(disturbance=call.body, who=call.client.name))
    return cell.status
