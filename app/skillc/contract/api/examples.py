"""Examples for the OpenAPI document: bodies of requests by endpoint, and values of the parameters of paths."""

from __future__ import annotations

from datetime import UTC, datetime

import msgspec

from skillc.contract import commands
from skillc.contract.access import NewToken
from skillc.contract.api import endpoints
from skillc.contract.cell import LeaseRequest, PaceSetting
from skillc.contract.operation import OperationRequest, StopReason
from skillc.contract.order import OrderRequest
from skillc.contract.rehearsal import RehearsalRequest
from skillc.contract.source import SourceChange
from skillc.contract.world import WorldEdit, WorldPlacement, WorldQuery
from skillc_runtime.devices.disturbances import PushArm

_TASK, _SURFACE, _STOP = "clean", {"surface": "lab:Table-1"}, StopReason("a person is in the cell")

EXAMPLES: dict[str, msgspec.Struct] = {
    endpoints.SET_PACE.name: PaceSetting(1.0),
    endpoints.STOP_CELL.name: _STOP,
    endpoints.DISTURB_CELL.name: PushArm("lab:Arm-1", (0.0, 20.0, 0.0)),
    endpoints.TAKE_LEASE.name: LeaseRequest(600.0),
    endpoints.SUBMIT_OPERATION.name: OperationRequest(task=_TASK, arguments=_SURFACE),
    endpoints.GIVE_COMMAND.name: commands.PauseRun("somebody looks at it"),
    endpoints.STOP_OPERATION.name: _STOP,
    endpoints.ADD_ORDER.name: OrderRequest(
        OperationRequest(task=_TASK, arguments=_SURFACE), datetime(2026, 1, 31, 18, tzinfo=UTC), every_s=86_400.0
    ),
    endpoints.QUERY_WORLD.name: WorldQuery("SELECT ?thing WHERE { lab:Table-1 skiros:contain ?thing }"),
    endpoints.EDIT_WORLD.name: WorldEdit(("lab:Table-1 wiping:isClean false",), "it was spilled on"),
    endpoints.PLACE_THING.name: WorldPlacement("lab:Table-1", (0.6, 0.0, 0.4, 1.0, 0.0, 0.0, 0.0), "it was moved"),
    endpoints.ADD_JOB.name: RehearsalRequest(cell="cell", task=_TASK, arguments=_SURFACE),
    endpoints.CHANGE_LIBRARY_SOURCE.name: SourceChange("## Nothing yet.\n", 64 * "0"),
    endpoints.ADD_TOKEN.name: NewToken("line-3", "operate"),
}
OPERATION = "clean-20260131T120000Z-1f0c9a"
PATH_EXAMPLES = {"cell": "cell", "operation": OPERATION, "file": "report.html", "library": "wiping"}
