"""Rehearsals: what an operation does in a simulated twin of a cell."""

from __future__ import annotations

from typing import Annotated, Literal

import msgspec

from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.recording.documented import documented
from skillc_runtime.recording.run_spec import EXECUTION, PLANNING, TaskRequest


class RehearsalRequest(TaskRequest, frozen=True, kw_only=True):
    """A task of the cell's library with arguments, a goal, or a call of a skill, to try in a simulated twin.

    It is filmed with `film`, and recorded with `record`.
    """

    seed: Annotated[
        Annotated[int, msgspec.Meta(ge=0, le=2**31)],
        documented("Determines how the twin differs from what is known.", EXECUTION, metavar="N"),
    ] = 0
    deadline_s: Annotated[
        Annotated[float, msgspec.Meta(gt=0.0, le=3600.0)],
        documented("Let the task fail if it has not ended after these seconds of the twin's time.", EXECUTION),
    ] = 600.0
    geometry: Annotated[
        bool, documented("Look whether the arms can carry out a plan, before anything moves.", PLANNING)
    ] = True
    film: bool = False
    record: bool = False


class Rehearsal(msgspec.Struct, frozen=True, kw_only=True):
    """A rehearsal of a request in a twin of a cell, as the cell was when it was requested.

    `result` is null until it has ended, and then if the request could not be carried out: `reason` says why. `film`
    and `recording` are whether there is one.
    """

    id: str
    cell: str
    request: RehearsalRequest
    state: Literal["going on", "ended"] = "going on"
    reason: str = ""
    result: TaskResult | None = None
    film: bool = False
    recording: bool = False
