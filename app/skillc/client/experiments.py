"""What is worked out for a cell of a server: the client waits for the end, and ends what nobody waits for any more."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from http import HTTPStatus
from typing import TypeVar

from skillc.client.connection import Connection, describe_problem
from skillc.client.errors import RefusedError, UnavailableError
from skillc.client.retries import Retries
from skillc.contract.api.endpoints import (
    ADD_JOB,
    CANCEL_JOB,
    LIST_JOB_EVENTS,
    SHOW_JOB,
    SHOW_JOB_RESULT,
)
from skillc.contract.job import ONGOING, Job, JobEventPage, JobRequest, PlanResult, RunResult, TrialsResult
from skillc.contract.learning import LearnResult

Outcome = TypeVar("Outcome", PlanResult, RunResult, TrialsResult, LearnResult)
WAIT_S = 5.0


async def run_job(
    connection: Connection, request: JobRequest, kind: type[Outcome], watch: Callable[[Job], None] | None = None
) -> tuple[Job, Outcome]:
    """Begin a job; return it once it has ended, with its outcome, of a kind. `watch` is called with each progress.

    If this is cancelled, the job is. RefusedError, with what is wrong, if it fails or somebody cancels it.
    """
    job = await connection.call(ADD_JOB, body=request)
    try:
        job = await follow_job(connection, job, watch)
    except asyncio.CancelledError:
        await connection.call(CANCEL_JOB, job.id)
        raise
    if job.problem is not None:
        raise describe_problem(job.problem)
    if job.state != "ended":
        raise RefusedError(f"{job.id} was {job.state}: {job.reason}", HTTPStatus.CONFLICT)
    outcome = (await connection.call(SHOW_JOB_RESULT, job.id)).outcome
    assert isinstance(outcome, kind), "such requests have such outcomes"
    return job, outcome


async def follow_job(connection: Connection, job: Job, watch: Callable[[Job], None] | None = None) -> Job:
    """Return a job once it goes on no more; `watch` is called with each progress. The server may be away meanwhile."""
    retries, page = Retries(), JobEventPage(wait_s=WAIT_S)
    while job.state in ONGOING:
        try:
            events = await connection.call(LIST_JOB_EVENTS, job.id, query=page)
            job = await connection.call(SHOW_JOB, job.id) if events else job
        except UnavailableError as error:
            await retries.wait(error)
            continue
        retries.succeeded()
        if events:
            page = JobEventPage(events[-1].sequence, WAIT_S)
            if watch is not None:
                watch(job)
    return job
