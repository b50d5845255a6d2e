"""Jobs: work for a cell that takes its time, of whatever kind, with its progress, its log and its result."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

import msgspec

from skillc.contract.api.problem import ProblemDetails
from skillc.contract.learning import LearnRequest, LearnResult
from skillc.contract.plan import PlanPreview, PlanRequest
from skillc.contract.rehearsal import RehearsalRequest
from skillc.contract.trials import Series, TrialReplayRequest, TrialsRequest
from skillc_runtime.evaluation.report.result import TaskResult as TaskResult


class ReportRequest(
    msgspec.Struct, frozen=True, kw_only=True, tag_field="kind", tag="report", forbid_unknown_fields=True
):
    """An operation that has ended, to make a report of: without a `film` it takes a fraction of the time."""

    operation: str
    film: bool = True


JobRequest: TypeAlias = (
    PlanRequest | RehearsalRequest | TrialsRequest | TrialReplayRequest | ReportRequest | LearnRequest
)
"""What a job is to do; `kind` says which it is."""
JobState: TypeAlias = Literal["waiting", "running", "ended", "failed", "cancelled", "interrupted"]
ONGOING: tuple[JobState, ...] = ("waiting", "running")
"""The states from which a job goes on by itself."""
FILM, RECORDING = "film.mp4", "recording.mcap"
"""The names of the film and of the recording that a job has left."""
FILE_TYPES = {
    ".diff": "text/x-diff; charset=utf-8",
    ".html": "text/html; charset=utf-8",
    ".json": "application/json",
    ".mcap": "application/octet-stream",
    ".mp4": "video/mp4",
    ".png": "image/png",
    ".svg": "image/svg+xml",
}
"""The media types of the files that jobs leave, by how their names end."""


class Job(msgspec.Struct, frozen=True, kw_only=True):
    """A job: what is requested by whom, in which cell, and how far it is: `done` of `wanted` parts, `failed` of these.

    `reason` is why it is in its state, empty if that is clear; `problem` says more of one that has failed, as a refusal
    of a request does. One is `interrupted` if the server has ended before. `files` are the names of what it has left.
    """

    id: str
    cell: str
    owner: str
    request: JobRequest
    state: JobState = "waiting"
    reason: str = ""
    problem: ProblemDetails | None = None
    done: int = 0
    failed: int = 0
    wanted: int = 1
    files: tuple[str, ...] = ()


class JobEvent(msgspec.Struct, frozen=True, kw_only=True):
    """A line of the log of a job: its state and how much was done at a time, in ns since 1970, and what happened.

    `sequence` counts from 1.
    """

    sequence: int
    wall_time_ns: int
    state: JobState
    done: int
    message: str


class PlanResult(msgspec.Struct, frozen=True, tag_field="kind", tag="plan"):
    """The result of a plan."""

    plan: PlanPreview


class RunResult(msgspec.Struct, frozen=True, tag_field="kind", tag="run"):
    """The result of what was run in simulation: a rehearsal, a trial again, an operation for its report."""

    run: TaskResult


class TrialsResult(msgspec.Struct, frozen=True, tag_field="kind", tag="trials"):
    """The result of trials: those that are done, judged."""

    series: Series


JobOutcome: TypeAlias = PlanResult | RunResult | TrialsResult | LearnResult


class JobResult(msgspec.Struct, frozen=True):
    """The result of the job with an id."""

    job: str
    outcome: JobOutcome


class JobPage(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Which jobs: those of a cell, or of all."""

    cell: str | None = None


class JobEventPage(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Which lines of a log: those after a number. If there are none yet, they are waited for, `wait_s` s at most."""

    after: Annotated[int, msgspec.Meta(ge=0, le=2**63 - 1)] = 0
    wait_s: Annotated[float, msgspec.Meta(ge=0.0, le=20.0)] = 0.0


class JobChanged(msgspec.Struct, frozen=True, kw_only=True, tag="job"):
    """A job is begun, or has got further; or it was `removed`, and how it was before."""

    job: Job
    removed: bool = False
