"""Series of trials, and trials that are run again."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

import msgspec

from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.evaluation.trials.series import Series as Series
from skillc_runtime.evaluation.trials.trial import TRIAL_LIMIT_S as TRIAL_LIMIT_S
from skillc_runtime.evaluation.trials.trial import Disturbance

TrialDisturbance: TypeAlias = Disturbance


class TrialsRequest(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True, forbid_unknown_fields=True):
    """A task of the cell's library with arguments, to run `number` times from the cell's scene, with seeds from `seed`.

    `disturb` is what disturbs each trial; one may take `deadline_s` s of wall time.
    """

    task: str
    arguments: dict[str, str] = {}
    number: Annotated[int, msgspec.Meta(ge=1, le=1000)] = 50
    seed: Annotated[int, msgspec.Meta(ge=0, le=2**31)] = 0
    disturb: Disturbance = "none"
    deadline_s: Annotated[float, msgspec.Meta(gt=0.0, le=TRIAL_LIMIT_S)] = TRIAL_LIMIT_S


SeriesState: TypeAlias = Literal["waiting", "going on", "ended", "interrupted"]


class TrialSeries(msgspec.Struct, frozen=True, kw_only=True):
    """Trials of a task from the scene of a cell: how many are `done`, and how many of these met all criteria.

    `interrupted`: the server has ended before. `reason` is why no more were done.
    """

    id: str
    cell: str
    request: TrialsRequest
    state: SeriesState
    reason: str = ""
    done: int = 0
    passed: int = 0


class TrialReplay(msgspec.Struct, frozen=True, kw_only=True):
    """A trial of a series that is run again. `recording` is whether it has one; `reason` is why it has no `result`."""

    series: str
    seed: int
    state: Literal["going on", "ended"] = "going on"
    reason: str = ""
    result: TaskResult | None = None
    recording: bool = False
