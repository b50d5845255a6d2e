"""What Dask says beyond a `concurrent.futures.Executor`; it is asked only where it is loaded already."""

from __future__ import annotations

import sys
from typing import Any


def is_wanted() -> bool:
    """Whether the result of the task in this thread is still wanted; True where this is no worker of Dask.

    A client that cancels a task, or that is gone, does not end it: the worker only notes it.
    """
    module: Any = sys.modules.get("distributed.worker")
    key = None if module is None else getattr(module.thread_state, "key", None)
    if key is None:
        return True
    worker = module.get_worker()
    task = worker.state.tasks.get(key)
    return task is not None and task.state != "cancelled" and worker.status.name not in ("closing", "closed", "failed")


def has_lost_workers(error: BaseException) -> bool:
    """Whether an error of a task says that one worker after the other ended while it had the task."""
    module: Any = sys.modules.get("distributed.scheduler")
    return module is not None and isinstance(error, module.KilledWorker)
