"""What processes of workers do. They alone import what that needs, so that the server starts sooner."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

from skillc.contract.jobs import JobRefused
from skillc.contract.runs.run_jobs import RunJob
from skillc_runtime.platforms.memory import limit_memory

Program: TypeAlias = Callable[[Any], bytes | JobRefused]
"""Answers a job for an encoded snapshot, as JSON; for None it answers that it is ready."""

MEMORY_BYTES = 4 * 2**30
"""The largest address space of a worker."""


def do_job(request: tuple[Any, bytes] | None) -> bytes | JobRefused:
    """Answer a job in this process, whose memory is limited from now on."""
    from skillc.workers.answering import answer_job

    limit_memory(MEMORY_BYTES)
    return answer_job(request)


def read_run(request: tuple[RunJob, bytes] | None) -> bytes | JobRefused:
    """Answer a job that reads a recorded run in this process, whose memory is limited from now on."""
    from skillc.workers.run_reading import answer_run_job

    limit_memory(MEMORY_BYTES)
    return answer_run_job(request)
