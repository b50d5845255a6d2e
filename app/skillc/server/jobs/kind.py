"""What a kind of job is, and a job of one that can be done."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from skillc.contract.access import Role
from skillc.contract.job import Job, JobOutcome
from skillc.server.http.api_call import ApiCall
from skillc.server.jobs.running import JobRun, LaneName

CHECK_S = 20.0
"""How long checking a request may take, in s."""


@dataclass(frozen=True, slots=True)
class PreparedJob:
    """A job that can be done: in a cell, for an encoded snapshot of it, by `run`, in so many parts."""

    cell: str
    snapshot: bytes
    run: JobRun
    wanted: int = 1


Prepare: TypeAlias = Callable[[ApiCall, Any], Awaitable[PreparedJob]]
"""Makes a job of a request as the cell is now; ApiRefusal if it cannot be one."""


@dataclass(frozen=True, slots=True)
class JobKind:
    """A kind of job, by the type of its requests; clients with a role may have such jobs done.

    `summarise` makes the outcome of the parts that are done, if there are parts.
    """

    request: type
    prepare: Prepare
    lane: LaneName
    role: Role = "operate"
    summarise: Callable[[Job, Sequence[bytes]], JobOutcome] | None = None
