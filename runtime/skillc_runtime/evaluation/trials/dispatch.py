"""Gives the seeds of a series to an executor, and takes each trial once, however often it was run."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from concurrent.futures import BrokenExecutor, CancelledError, Executor, Future
from functools import partial
from itertools import islice
from queue import SimpleQueue
from types import TracebackType
from typing import assert_never

from skillc_runtime.evaluation.trials import dask_worker
from skillc_runtime.evaluation.trials.hosting import (
    Case,
    Prepare,
    SeriesRefused,
    TrialAnswer,
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


class Dispatch:
    """Trials that an executor has; use it in a `with` statement, whose end gives up those that are running."""

    def __init__(self, executor: Executor, prepare: Prepare, limit_s: float = TRIAL_LIMIT_S) -> None:
        self._executor, self._order = executor, make_order(prepare, limit_s)
        self._given: dict[Case, Future[TrialAnswer]] = {}
        self._ended: SimpleQueue[Case] = SimpleQueue()

    def __len__(self) -> int:
        return len(self._given)

    def give(self, case: Case) -> None:
        """Give a case, which the executor does not have already, to it. ExecutorError if it takes no more."""
        try:
            future = self._executor.submit(run_trial, self._order, case)
        except (BrokenExecutor, RuntimeError) as error:
            raise ExecutorError(f"the executor takes no more trials: {error}") from error
        self._given[case] = future
        future.add_done_callback(partial(_note, self._ended, case))

    def take(self) -> tuple[Case, Tried]:
        """Wait for the next trial that ends; at least one must have been given. ExecutorError if it cannot be run."""
        case = self._ended.get()  # wait ends: executors end every future, also those that they give up
        return case, _read(case.seed, self._given.pop(case))

    def __enter__(self) -> Dispatch:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._order.cancel.cancel("the series has ended")
        for future in self._given.values():
            future.cancel()
        end_idle_children()


def run_on(
    executor: Executor, prepare: Prepare, seeds: Sequence[int], limit_s: float = TRIAL_LIMIT_S
) -> Generator[Tried, None, None]:
    """Yield the trial of each seed once, as they end.

    ExecutorError if a worker cannot run any, or the executor ends. Closing the iterator gives up what is running.
    """
    waiting = iter(dict.fromkeys(seeds))
    with Dispatch(executor, prepare, limit_s) as dispatch:
        while True:
            for seed in islice(waiting, MOST_GIVEN - len(dispatch)):
                dispatch.give(Case(seed))
            if not len(dispatch):
                return
            yield dispatch.take()[1]


def _note(ended: SimpleQueue[Case], case: Case, _future: Future[TrialAnswer]) -> None:
    ended.put_nowait(case)


def _read(seed: int, future: Future[TrialAnswer]) -> Tried:
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
        case SeriesRefused(why):
            raise ExecutorError(why)
        case _:
            assert_never(answer)
