"""Runs trials in parallel processes: each takes the next seed when it is free, and all end with their parent."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from typing import Protocol, TypeAlias

from skillc_runtime.cancellation import CancelToken
from skillc_runtime.evaluation.trials.trial import TRIAL_LIMIT_S, Trial
from skillc_runtime.execution.worker_process import Died, Returned, WorkerProcess, WorkerResult, wait_for_any

PREPARATION_LIMIT_S = 600.0
"""How long the preparation in a process may take: imports, loading the scene, planning."""

MAX_FAILED_STARTS = 3
"""How many preparations may fail in a row."""


class Runner(Protocol):
    """Runs the trial of one seed."""

    def run(self, seed: int) -> Trial:
        """Run the trial."""
        ...


Prepare: TypeAlias = Callable[[], Runner]
"""Makes the runner in the worker process."""


class PreparationError(Exception):
    """No process can run trials; the message is the reason of the last one."""


def run_in_processes(
    prepare: Prepare, seeds: Sequence[int], jobs: int, limit_s: float = TRIAL_LIMIT_S
) -> Iterator[Trial]:
    """Yield the trials of all seeds as they finish, `jobs` at a time.

    A trial that raises an exception, whose process dies, or that takes longer than `limit_s` is crashed; the others go
    on in another process. PreparationError if no process can be prepared. Closing the iterator ends all processes.
    """
    pool = _Pool(prepare, seeds, jobs, limit_s)
    try:
        while pool.has_work:
            pool.start_workers()
            yield from pool.collect()
    finally:
        pool.close()


class _Pool:
    """The workers, and the seeds that none of them has been given."""

    def __init__(self, prepare: Prepare, seeds: Sequence[int], jobs: int, limit_s: float) -> None:
        self._prepare, self._jobs, self._limit_s = prepare, jobs, limit_s
        self._left = deque(seeds)
        self._workers: list[_Worker] = []
        self._failed_starts, self._why = 0, ""

    @property
    def has_work(self) -> bool:
        """Whether there are seeds without a trial."""
        return bool(self._left) or any(each.seed is not None for each in self._workers)

    def start_workers(self) -> None:
        """Start as many workers as are useful, unless too many have failed in a row."""
        if self._failed_starts >= MAX_FAILED_STARTS:
            if not self._workers:
                raise PreparationError(self._why)
            return
        prepared = sum(each.seed is not None for each in self._workers)
        while len(self._workers) < min(self._jobs, prepared + len(self._left)):
            self._workers.append(_Worker(self._prepare))

    def collect(self) -> Iterator[Trial]:
        """Wait for results; yield the trials that have ended, and give their workers the next seeds."""
        wait_for_any([each.process for each in self._workers], min(each.left_s for each in self._workers))
        for worker in tuple(self._workers):
            if (result := worker.check()) is None:
                continue
            if worker.seed is not None:
                yield _make_trial(worker.seed, result)
            elif isinstance(result, Returned):
                self._failed_starts = 0
            else:
                self._failed_starts, self._why = self._failed_starts + 1, result.why
                self._remove(worker)
                continue
            self._continue(worker, result)

    def close(self) -> None:
        """End all workers."""
        for each in self._workers:
            each.process.kill()

    def _continue(self, worker: _Worker, result: WorkerResult) -> None:
        """Give a worker the next seed; end it if it has died, or if there is none."""
        if self._left and not isinstance(result, Died):
            worker.assign(self._left.popleft(), self._limit_s)
        else:
            self._remove(worker)

    def _remove(self, worker: _Worker) -> None:
        worker.process.kill()
        self._workers.remove(worker)


class _Worker:
    """A process, and the seed that it runs; None while it prepares."""

    def __init__(self, prepare: Prepare) -> None:
        self.process = WorkerProcess(_Server(prepare))
        self.seed: int | None = None
        self._ask(None, PREPARATION_LIMIT_S)

    def assign(self, seed: int, limit_s: float) -> None:
        """Start the trial of a seed."""
        self.seed = seed
        self._ask(seed, limit_s)

    @property
    def left_s(self) -> float:
        """The time that is left for what the process does, in s."""
        return self._deadline.remaining_s

    def check(self) -> WorkerResult | None:
        """Return the result, if there is one or the time is up."""
        result = self.process.poll()
        if result is None and self.left_s <= 0.0:
            self.process.kill()
            return Died(f"it took longer than {self._limit_s:g} s")
        return result

    def _ask(self, request: int | None, limit_s: float) -> None:
        self._limit_s, self._deadline = limit_s, CancelToken(limit_s)
        self.process.ask(request)


class _Server:
    """Prepares for the request None, and then runs the trial of each seed that is requested."""

    def __init__(self, prepare: Prepare) -> None:
        self._prepare = prepare
        self._runner: Runner | None = None

    def __call__(self, seed: int | None) -> Trial | None:
        self._runner = self._runner or self._prepare()
        return None if seed is None else self._runner.run(seed)


def _make_trial(seed: int, result: WorkerResult) -> Trial:
    if not isinstance(result, Returned):
        return Trial(seed=seed, status="crashed", reason=result.why)
    trial: Trial = result.value
    return trial
