"""Runs trials for an executor, in its worker: each in a process beside it, which may die without taking it along."""

from __future__ import annotations

import pickle
import socket
import tempfile
import threading
import time
import zlib
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from tempfile import TemporaryDirectory
from typing import NamedTuple, Protocol, TypeAlias, assert_never

from skillc_runtime.cancellation import CancelToken
from skillc_runtime.evaluation.trials import dask_worker
from skillc_runtime.evaluation.trials.identity import identify_skillc
from skillc_runtime.evaluation.trials.settings import Setting
from skillc_runtime.evaluation.trials.trial import Trial
from skillc_runtime.execution.worker_process import Died, Raised, Returned, WorkerProcess, WorkerResult

ATTEMPTS = 3
"""How often a process may die of the same trial, or of its preparation."""
PREPARATION_LIMIT_S = 600.0
"""How long the preparation in a process may take: imports, loading the scene, planning."""
IDLE_S = 30.0
"""How long a process that is prepared waits for another trial, in s."""
LOOK_S = 0.1
"""How often it is looked whether a trial is still wanted, in s."""


class Runner(Protocol):
    """Runs the trial of one seed, with settings if it is asked for such."""

    def run(self, seed: int, *settings: Setting) -> Trial:
        """Run the trial."""
        ...


class Case(NamedTuple):
    """What one trial is asked for: its seed, and the settings with which it is run."""

    seed: int
    settings: tuple[Setting, ...] = ()


Prepare: TypeAlias = Callable[[], Runner]
"""Makes the runner in the process of trials; it is pickled."""


@dataclass(frozen=True, slots=True)
class TrialOrder:
    """What the trials of a series have in common: the program, and the skillc with which alone they are to be run.

    A trial may take `limit_s` of wall time. `cancel` ends those in processes of this one; a copy on another machine
    is not cancelled with it.
    """

    program: bytes
    skillc: str
    limit_s: float
    cancel: CancelToken


@dataclass(frozen=True, slots=True)
class Tried:
    """A trial, and how long it took of wall time, in s; None if nobody knows."""

    trial: Trial
    took_s: float | None


@dataclass(frozen=True, slots=True)
class SeriesRefused:
    """A worker runs no trials of this series; `why` is a sentence about it."""

    why: str


TrialAnswer: TypeAlias = Tried | SeriesRefused


def make_order(prepare: Prepare, limit_s: float) -> TrialOrder:
    """Return the order of a series."""
    return TrialOrder(zlib.compress(pickle.dumps(prepare)), identify_skillc(), limit_s, CancelToken())


def run_trial(order: TrialOrder, case: Case) -> TrialAnswer:
    """Run the trial of a case; this is what workers of executors call.

    A trial that raises an exception, takes too long, or of which ATTEMPTS processes die has crashed.
    """
    if identify_skillc() != order.skillc:
        return SeriesRefused(
            f"{_here()} has skillc {identify_skillc()}, here it is {order.skillc}; install the same on both"
        )
    for attempt in range(1, ATTEMPTS + 1):
        child = _take_child(order)
        if isinstance(child, SeriesRefused):
            return child
        began = time.monotonic()
        result = child.answer(case, order, order.limit_s)
        took_s = time.monotonic() - began
        match result:
            case Returned(Trial() as trial):
                _keep(child, order)
                return Tried(trial, took_s)
            case Raised(why):
                _keep(child, order)
                return Tried(_crashed(case.seed, why), took_s)
            case Died(why) if attempt == ATTEMPTS:
                return Tried(_crashed(case.seed, f"{why}, in {ATTEMPTS} of {ATTEMPTS} attempts"), took_s)
            case Died():
                pass
            case _ if _is_wanted(order):
                return Tried(_crashed(case.seed, f"it took longer than {order.limit_s:g} s"), took_s)
            case _:
                break
    return SeriesRefused("nobody wants the trial")


class _Child:
    """A process for the trials of a program; the files that it leaves behind are removed with it."""

    def __init__(self, program: bytes) -> None:
        self.program = program
        self._files = TemporaryDirectory(prefix="skillc-trials-")
        with _starting:
            self._process = WorkerProcess(_Server(program, self._files.name))

    def answer(self, request: Case | None, order: TrialOrder, limit_s: float) -> WorkerResult | None:
        """Return the result of a request; None, and the process is ended, if it takes too long or nobody wants it."""
        limit = CancelToken(limit_s)
        self._process.ask(request)
        while (result := self._process.wait(min(LOOK_S, limit.remaining_s))) is None:
            if limit.reason is not None or not _is_wanted(order):
                break
        if result is None or isinstance(result, Died):
            self.end()
        return result

    def end(self) -> None:
        """End the process."""
        self._process.kill()
        self._files.cleanup()


@dataclass(slots=True)
class _Server:
    """Prepares for the request None, and then runs the trial of each case that is requested."""

    program: bytes
    files: str
    _runner: Runner | None = field(default=None, init=False)

    def __call__(self, case: Case | None) -> Trial | None:
        if self._runner is None:
            tempfile.tempdir = self.files
            prepare: Prepare = pickle.loads(zlib.decompress(self.program))
            self._runner = prepare()
        return None if case is None else self._runner.run(case.seed, *case.settings)


_starting = threading.Lock()
"""One process is started at a time."""
_idle: list[tuple[_Child, threading.Timer]] = []
"""The processes that are prepared and wait, with what ends them when they have waited for long."""


def end_idle_children() -> None:
    """End the processes that wait for trials in this process."""
    while (child := _pop_idle()) is not None:
        child.end()


def _take_child(order: TrialOrder) -> _Child | SeriesRefused:
    """Return a process that is prepared."""
    while (child := _pop_idle()) is not None:
        if child.program == order.program:
            return child
        child.end()
    for attempt in range(1, ATTEMPTS + 1):
        child = _Child(order.program)
        match child.answer(None, order, PREPARATION_LIMIT_S):
            case Returned():
                return child
            case Raised(why):
                child.end()
                return SeriesRefused(f"{_here()} cannot run the trials: {why}")
            case Died(why) if attempt == ATTEMPTS:
                return SeriesRefused(f"{_here()} cannot run the trials: {why}")
            case Died():
                pass
            case None:
                return SeriesRefused(f"{_here()} cannot run the trials: it took longer than {PREPARATION_LIMIT_S:g} s")
            case other:
                assert_never(other)
    raise AssertionError("the last attempt returns")


def _keep(child: _Child, order: TrialOrder) -> None:
    """Keep a process for another trial, for a while."""
    if order.cancel.reason is not None:
        child.end()
        return
    timer = threading.Timer(IDLE_S, _end_idle, (child,))
    timer.daemon = True
    _idle.append((child, timer))
    timer.start()


def _pop_idle() -> _Child | None:
    try:
        child, timer = _idle.pop()
    except IndexError:
        return None
    timer.cancel()
    return child


def _end_idle(child: _Child) -> None:
    for each in tuple(_idle):
        if each[0] is child:
            with suppress(ValueError):  # it has been taken meanwhile
                _idle.remove(each)
                child.end()


def _is_wanted(order: TrialOrder) -> bool:
    return order.cancel.reason is None and dask_worker.is_wanted()


def _crashed(seed: int, why: str) -> Trial:
    return Trial(seed=seed, status="crashed", reason=why)


def _here() -> str:
    return f"the worker on {socket.gethostname()}"
