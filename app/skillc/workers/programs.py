"""What processes of workers do. They alone import what that needs, so that the server starts sooner."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

from skillc.contract.diagnosis import WorkRefused
from skillc.contract.runs.run_questions import RunQuestion
from skillc.workers.questions import Work
from skillc_runtime.platforms.memory import limit_memory

MEMORY_BYTES = 4 * 2**30
"""The largest address space of a worker."""


Program: TypeAlias = Callable[[Any], bytes | WorkRefused]
"""Does work for an encoded snapshot, or answers a question about runs, as JSON; for None it says that it is ready."""


def do_work(request: tuple[Work, bytes] | None) -> bytes | WorkRefused:
    """Do work in this process, whose memory is limited from now on."""
    from skillc.workers.answering import answer_work

    limit_memory(MEMORY_BYTES)
    return answer_work(request)


def read_run(request: tuple[RunQuestion, bytes] | None) -> bytes | WorkRefused:
    """Answer a question about recorded runs in this process, whose memory is limited from now on."""
    from skillc.workers.run_reading import answer_run_question

    limit_memory(MEMORY_BYTES)
    return answer_run_question(request)
