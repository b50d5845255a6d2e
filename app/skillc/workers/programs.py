"""What processes of workers do. They alone import what that needs, so that the server starts sooner."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

from skillc.contract.jobs import Job, JobRefused
from skillc.contract.run_jobs import RunJob

Program: TypeAlias = Callable[[Any], bytes | JobRefused]
"""Answers a job for an encoded snapshot, as JSON; for None it answers that it is ready."""


def do_job(request: tuple[Job, bytes] | None) -> bytes | JobRefused:
    """Answer a job."""
    from skillc.workers.answering import answer_job

    return answer_job(request)


def read_run(request: tuple[RunJob, bytes] | None) -> bytes | JobRefused:
    """Answer a job that reads a recorded run."""
    from skillc.workers.run_reading import answer_run_job

    return answer_run_job(request)
