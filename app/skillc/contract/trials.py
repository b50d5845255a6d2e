"""Trials of a task, and trials that are run again."""

from __future__ import annotations

from typing import Annotated

import msgspec

from skillc_runtime.evaluation.trials.series import Series as Series
from skillc_runtime.evaluation.trials.trial import TRIAL_LIMIT_S as TRIAL_LIMIT_S
from skillc_runtime.evaluation.trials.trial import TrialDisturbance as TrialDisturbance


class TrialsRequest(
    msgspec.Struct,
    frozen=True,
    kw_only=True,
    tag_field="kind",
    tag="trials",
    omit_defaults=True,
    forbid_unknown_fields=True,
):
    """A task of a cell's library with arguments, to run `number` times from the cell's scene, with seeds from `seed`.

    `cell` may be left out if there is only one. `disturb` is what disturbs each trial; one may take `deadline_s` s of
    wall time.
    """

    cell: str | None = None
    task: str
    arguments: dict[str, str] = {}
    number: Annotated[int, msgspec.Meta(ge=1, le=1000)] = 50
    seed: Annotated[int, msgspec.Meta(ge=0, le=2**31)] = 0
    disturb: TrialDisturbance = "none"
    deadline_s: Annotated[float, msgspec.Meta(gt=0.0, le=TRIAL_LIMIT_S)] = TRIAL_LIMIT_S


class TrialReplayRequest(
    msgspec.Struct, frozen=True, kw_only=True, tag_field="kind", tag="trial-replay", forbid_unknown_fields=True
):
    """A trial to run again and record: that with a `seed` of the trials that the job `trials` has run."""

    trials: str
    seed: int
