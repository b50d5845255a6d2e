"""Rehearsals: what an operation does in a simulated twin of a cell."""

from __future__ import annotations

from typing import Annotated, Literal

import msgspec

from skillc_runtime.evaluation.report.result import TaskResult


class RehearsalRequest(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True, forbid_unknown_fields=True):
    """A task of the cell's library with arguments, a goal, or a call of a skill, to try in a simulated twin.

    `seed` determines how the reality of the twin differs from the facts. `deadline_s` is in the twin's time. It is
    filmed with `film`, and recorded with `record`.
    """

    task: str | None = None
    goal: str | None = None
    call: str | None = None
    arguments: dict[str, str] = {}
    seed: Annotated[int, msgspec.Meta(ge=0, le=2**31)] = 0
    deadline_s: Annotated[float, msgspec.Meta(gt=0.0, le=3600.0)] = 600.0
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
