"""Runs trials in parallel processes: each takes the next seed when it is free, and all end with their parent."""

from __future__ import annotations

import os
import signal
import threading
import traceback
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from multiprocessing import get_context, parent_process
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from pathlib import Path
from typing import Protocol, TypeAlias, cast

from skillc_runtime.evaluation.trials.trial import Trial


class Runner(Protocol):
    """Runs the trial of one seed."""

    def run(self, seed: int) -> Trial:
        """Run the trial."""
        ...


Prepare: TypeAlias = Callable[[], Runner]
"""Makes the runner in the worker process; it is pickled."""


class Worker:
    """A worker process and the seed that it runs."""

    def __init__(self, prepare: Prepare) -> None:
        context = get_context("spawn")
        self.connection, remote = context.Pipe()
        self._process: BaseProcess = context.Process(target=_serve, args=(prepare, remote), daemon=True)
        self._process.start()
        remote.close()
        self._seed = 0

    def assign(self, seed: int) -> None:
        """Start the trial of a seed."""
        self._seed = seed
        self.connection.send(seed)

    def receive(self) -> tuple[Trial, bool]:
        """Return the finished trial, and whether the process still runs."""
        try:
            return cast(Trial, self.connection.recv()), True
        except EOFError:
            self._process.join()
            reason = f"its process ended with {_describe_exit(self._process.exitcode)}"
            return Trial(seed=self._seed, status="crashed", reason=reason), False

    def terminate(self) -> None:
        """End the process."""
        self._process.terminate()
        self._process.join()
        self.connection.close()


def run_in_processes(prepare: Prepare, seeds: Sequence[int], jobs: int) -> Iterator[Trial]:
    """Yield the trials of all seeds as they finish, `jobs` at a time; a process that dies fails only one trial.

    Closing the iterator ends all processes.
    """
    left = deque(seeds)
    workers: dict[Connection, Worker] = {}
    try:
        while left or workers:
            while left and len(workers) < jobs:
                worker = Worker(prepare)
                workers[worker.connection] = worker
                worker.assign(left.popleft())
            for connection in wait(list(workers)):
                trial, alive = workers[cast(Connection, connection)].receive()
                if alive and left:
                    workers[cast(Connection, connection)].assign(left.popleft())
                else:
                    workers.pop(cast(Connection, connection)).terminate()
                yield trial
    finally:
        for worker in workers.values():
            worker.terminate()


def _serve(prepare: Prepare, connection: Connection) -> None:
    """Run the seeds that arrive on a connection, until it is closed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()
    runner: Runner | None = None
    while True:
        try:
            seed = connection.recv()
        except EOFError:
            return
        try:
            runner = runner or prepare()
            trial = runner.run(seed)
        except Exception as error:  # noqa: BLE001  the process's boundary: the other trials go on
            trial = Trial(seed=seed, status="crashed", reason=_describe_error(error))
        connection.send(trial)


def _end_with_parent() -> None:
    parent = parent_process()
    assert parent is not None
    parent.join()
    os._exit(1)


def _describe_error(error: Exception) -> str:
    place = traceback.extract_tb(error.__traceback__)[-1]
    return f"{type(error).__name__}: {error} ({Path(place.filename).name}:{place.lineno})"


def _describe_exit(code: int | None) -> str:
    return f"signal {-code}" if code is not None and code < 0 else f"code {code}"
