"""Trials in processes beside each other: each takes the next seed when it is free, and all end with their parent."""

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
        """Run it."""
        ...


Prepare: TypeAlias = Callable[[], Runner]
"""Makes what runs trials, in the process that runs them; it goes there by pickling."""


class Worker:
    """One process and the seed that it has."""

    def __init__(self, prepare: Prepare) -> None:
        context = get_context("spawn")
        self.line, there = context.Pipe()
        self._process: BaseProcess = context.Process(target=_serve, args=(prepare, there), daemon=True)
        self._process.start()
        there.close()
        self._seed = 0

    def give(self, seed: int) -> None:
        """Let it run a seed."""
        self._seed = seed
        self.line.send(seed)

    def take(self) -> tuple[Trial, bool]:
        """Return the trial that is done, and whether the process lives on."""
        try:
            return cast(Trial, self.line.recv()), True
        except EOFError:
            self._process.join()
            reason = f"its process ended with {_words(self._process.exitcode)}"
            return Trial(seed=self._seed, status="crashed", reason=reason), False

    def end(self) -> None:
        """End the process."""
        self._process.terminate()
        self._process.join()
        self.line.close()


def run_all(prepare: Prepare, seeds: Sequence[int], jobs: int) -> Iterator[Trial]:
    """Yield the trials of all seeds as they are done, `jobs` at a time; a process that dies fails one trial only.

    Closing the iterator ends all processes.
    """
    left = deque(seeds)
    workers: dict[Connection, Worker] = {}
    try:
        while left or workers:
            while left and len(workers) < jobs:
                worker = Worker(prepare)
                workers[worker.line] = worker
                worker.give(left.popleft())
            for line in wait(list(workers)):
                trial, alive = workers[cast(Connection, line)].take()
                if alive and left:
                    workers[cast(Connection, line)].give(left.popleft())
                else:
                    workers.pop(cast(Connection, line)).end()
                yield trial
    finally:
        for worker in workers.values():
            worker.end()


def _serve(prepare: Prepare, line: Connection) -> None:
    """Run the seeds that come along a line, until it ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()
    runner: Runner | None = None
    while True:
        try:
            seed = line.recv()
        except EOFError:
            return
        try:
            runner = runner or prepare()
            trial = runner.run(seed)
        except Exception as error:  # noqa: BLE001  the process's boundary: the other trials go on
            trial = Trial(seed=seed, status="crashed", reason=_told(error))
        line.send(trial)


def _end_with_parent() -> None:
    parent = parent_process()
    assert parent is not None
    parent.join()
    os._exit(1)


def _told(error: Exception) -> str:
    place = traceback.extract_tb(error.__traceback__)[-1]
    return f"{type(error).__name__}: {error} ({Path(place.filename).name}:{place.lineno})"


def _words(code: int | None) -> str:
    return f"signal {-code}" if code is not None and code < 0 else f"code {code}"
