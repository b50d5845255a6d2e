"""Gives the seeds of a series to an executor, and takes each trial once, however often it was run."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from concurrent.futures import BrokenExecutor, CancelledError, Executor, Future
from functools import partial
from itertools import islice
from queue import SimpleQueue
from typing import assert_never

from skillc_runtime.evaluation.trials import dask_worker
from skillc_runtime.evaluation.trials.hosting import (
    Answer,
    Prepare,
    Refused,
    TrialOrder,
    Tried,
    end_idle_children,
    make_order,
    run_trial,
)
from skillc_runtime.evaluation.trials.trial import TRIAL_LIMIT_S, Trial

MOST_GIVEN = 1024
"""How many seeds an executor has at the same time: enough for all its workers, few enough for its memory."""


class ExecutorError(Exception):
    """The executor cannot run the trials; the message says why."""


def run_on(
    executor: Executor, prepare: Prepare, seeds: Sequence[int], limit_s: float = TRIAL_LIMIT_S
) -> Generator[Tried, None, None]:
    """Yield the trial of each seed once, as they end.

    ExecutorError if a worker cannot run any, or the executor ends. Closing the iterator gives up what is running.
    """
    order, waiting = make_order(prepare, limit_s), iter(dict.fromkeys(seeds))
    given: dict[int, Future[Answer]] = {}
    ended: SimpleQueue[int] = SimpleQueue()
    try:
        while True:
            for seed in islice(waiting, MOST_GIVEN - len(given)):
                given[seed] = _submit(executor, order, seed)
                given[seed].add_done_callback(partial(_note, ended, seed))
            if not given:
                return
            seed = ended.get()  # wait ends: executors end every future, also those that they give up
            yield _read(seed, given.pop(seed))
    finally:
        order.cancel.cancel("the series has ended")
        for future in given.values():
            future.cancel()
        end_idle_children()


def _submit(executor: Executor, order: TrialOrder, seed: int) -> Future[Answer]:
    try:
        return executor.submit(run_trial, order, seed)
    except (BrokenExecutor, RuntimeError) as error:
        raise ExecutorError(f"the executor takes no more trials: {error}") from error


def _note(ended: SimpleQueue[int], seed: int, _future: Future[Answer]) -> None:
    ended.put_nowait(seed)


def _read(seed: int, future: Future[Answer]) -> Tried:
    """Return the trial of a future that has ended."""
    try:
        answer = future.result(0)
    except CancelledError as error:
        raise ExecutorError("the executor has given the trials up") from error
    except BrokenExecutor as error:
        raise ExecutorError(f"the executor has broken: {error}") from error
    except Exception as error:
        if dask_worker.has_lost_workers(error):
            return Tried(Trial(seed=seed, status="crashed", reason=f"its workers ended: {error}"), None)
        raise ExecutorError(f"a worker cannot run them: {type(error).__name__}: {error}") from error
    match answer:
        case Tried():
            return answer
        case Refused(why):
            raise ExecutorError(why)
        case _:
            assert_never(answer)
