"""What a cell looks like: shapes, where the world model has things, and where tools have really worked."""

from __future__ import annotations

from http import HTTPStatus

import msgspec

from skillc.contract.geometry import CellModel, SurfaceCoverage
from skillc.contract.jobs import ListPoses
from skillc.contract.messages import TakeCoverage, TakeGeometry
from skillc.contract.sample import PoseNumbers
from skillc.server.asking import ask_about
from skillc.server.endpoint import ApiCall, ApiEndpoint
from skillc.server.outcome import UNAVAILABLE, raise_refused

POSES_S = 10.0
"""How long the computation of all poses may take."""
Poses = dict[str, PoseNumbers]
Coverage = dict[str, SurfaceCoverage]


async def show_model(call: ApiCall) -> CellModel:
    answer = await call.server.find_cell(call.path["cell"]).request(TakeGeometry())
    return msgspec.msgpack.decode(raise_refused(answer), type=CellModel)


async def list_poses(call: ApiCall) -> Poses:
    return await ask_about(call, ListPoses(), Poses, POSES_S)


async def show_coverage(call: ApiCall) -> Coverage:
    answer = await call.server.find_cell(call.path["cell"]).request(TakeCoverage())
    return msgspec.msgpack.decode(raise_refused(answer), type=Coverage)


REFUSALS = (HTTPStatus.NOT_FOUND, HTTPStatus.CONFLICT, *UNAVAILABLE)
ENDPOINTS = (
    ApiEndpoint(
        "GET", "/cells/{cell}/model", "view", "Show the shapes and joints of a simulated cell, as they really are",
        show_model, CellModel, refusals=REFUSALS,
    ),
    ApiEndpoint(
        "GET", "/cells/{cell}/poses", "view", "List where the world of a cell has individuals, by IRI", list_poses,
        Poses, refusals=REFUSALS,
    ),
    ApiEndpoint(
        "GET", "/cells/{cell}/coverage", "view", "Show where tools have really worked on surfaces",
        show_coverage, Coverage, refusals=REFUSALS,
    ),
)  # fmt: skip
