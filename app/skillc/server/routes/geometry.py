"""What a cell looks like: shapes, where the world model has things, and where tools have really worked."""

from __future__ import annotations

import msgspec

from skillc.contract.geometry import CellModel, Coverage, Poses
from skillc.contract.messages import TakeCoverage, TakeGeometry
from skillc.server.asking import ask_about
from skillc.server.http.api_call import ApiCall
from skillc.server.http.outcome import raise_refused
from skillc.workers import questions

POSES_S = 10.0
"""How long the computation of all poses may take."""


async def show_model(call: ApiCall) -> CellModel:
    answer = await call.server.find_cell(call.path["cell"]).request(TakeGeometry())
    return msgspec.msgpack.decode(raise_refused(answer), type=CellModel)


async def list_poses(call: ApiCall) -> Poses:
    return await ask_about(call, questions.list_poses, Poses, POSES_S)


async def show_coverage(call: ApiCall) -> Coverage:
    answer = await call.server.find_cell(call.path["cell"]).request(TakeCoverage())
    return msgspec.msgpack.decode(raise_refused(answer), type=Coverage)
