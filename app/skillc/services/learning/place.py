"""Where the trials of learning run, and how many at the same time."""

from __future__ import annotations

import os

from skillc.services.reporting.reporter import Reporter
from skillc.services.trials.executors import choose_executor
from skillc.services.trials.running import OpenExecutor

ON_WORKERS = 8
"""How many trials a scheduler has at the same time, unless it is said."""


def choose_place(jobs: int | None, scheduler: str | None, reporter: Reporter) -> tuple[OpenExecutor, int]:
    """Return what runs trials, and how many at the same time: `jobs` processes here, or trials on workers.

    RequestError as of `choose_executor`.
    """
    if scheduler is not None:
        return choose_executor(None, scheduler, 1, reporter), jobs or ON_WORKERS
    parallel = jobs or os.cpu_count() or 1
    return choose_executor(parallel, None, parallel, reporter), parallel
