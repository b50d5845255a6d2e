"""Runs cases in worker processes: a case that fails, hangs or kills its process is kept with its input."""

from __future__ import annotations

import multiprocessing
import resource
import shutil
import signal
import time
import traceback
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from pathlib import Path
from random import Random
from types import FrameType

from fuzz.kinds import load_kind, seconds_of

WALL_FACTOR = 12
"""The wall-clock limit of a case is this many times its processor time: the machine may be busy."""

MEMORY_BYTES = 8 << 30
_FORKED = multiprocessing.get_context("fork")


class Hang(BaseException):
    """A case took longer than it may; no `except Exception` of the product swallows it."""


@dataclass(frozen=True)
class Plan:
    """What to run: cases of a kind, from number `first` on, on how many processes and until when (`time.monotonic`)."""

    kind: str
    seed: int
    first: int
    cases: int
    jobs: int
    deadline: float
    out: Path

    def folder(self, index: int) -> Path:
        """Return where the input of a case is written."""
        return self.out / f"{self.kind}-{self.seed}-{index}"


@dataclass(frozen=True)
class Finding:
    """A case in which the product broke a promise, and how; its input is in `folder`."""

    index: int
    problem: str
    folder: Path


@dataclass
class Result:
    """How many cases ran, and what was found."""

    cases: int = 0
    findings: list[Finding] = field(default_factory=list)


@dataclass
class _Worker:
    process: BaseProcess
    pipe: Connection
    lane: int
    index: int
    since: float


def run(plan: Plan, on_progress: Callable[[Result], None]) -> Result:
    """Run the cases of a plan until they are done or its deadline has passed."""
    result, kind = Result(), load_kind(plan.kind)
    limit_s = WALL_FACTOR * seconds_of(kind)
    workers = [_start(plan, lane, plan.first + lane) for lane in range(plan.jobs)]
    try:
        while workers:
            ready = wait([worker.pipe for worker in workers], timeout=1.0)
            for worker in list(workers):
                if worker.pipe in ready:
                    following = _receive(worker, plan, result)
                elif time.monotonic() - worker.since > limit_s:
                    following = _lost(worker, plan, result, f"no answer in {limit_s:g} s")
                else:
                    continue
                workers.remove(worker)
                workers += [following] if following else []
                on_progress(result)
    finally:
        for worker in workers:
            _kill(worker)
    return result


def run_case(name: str, seed: int, index: int, folder: Path) -> str | None:
    """Run one case and return what is wrong, None if nothing is; input is kept only where something is."""
    kind = load_kind(name)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    try:
        with _TimeLimit(seconds_of(kind)):
            kind.run_case(Random(f"{name}:{seed}:{index}"), folder)
    except (Exception, Hang, RecursionError):  # noqa: BLE001  whatever it raises is the finding
        problem = traceback.format_exc()
        (folder / "problem.txt").write_text(problem, "utf-8", errors="backslashreplace")
        return problem
    shutil.rmtree(folder, ignore_errors=True)
    return None


class _TimeLimit:
    """Raises Hang in the main thread after so many seconds of processor time."""

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds

    def __enter__(self) -> None:
        signal.signal(signal.SIGPROF, self._stop)
        signal.setitimer(signal.ITIMER_PROF, self._seconds)

    def __exit__(self, *_: object) -> None:
        signal.setitimer(signal.ITIMER_PROF, 0)

    def _stop(self, _signal: int, _frame: FrameType | None) -> None:
        raise Hang(f"more than {self._seconds:g} s")


def _start(plan: Plan, lane: int, index: int) -> _Worker:
    ours, theirs = _FORKED.Pipe()
    process = _FORKED.Process(target=_work, args=(plan, index, theirs), daemon=False)
    process.start()
    theirs.close()
    return _Worker(process, ours, lane, index, time.monotonic())


def _work(plan: Plan, index: int, pipe: Connection) -> None:
    """Run every `jobs`-th case from `index` on; report after each what was wrong."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
    for each in _indices(plan, index):
        pipe.send((each, run_case(plan.kind, plan.seed, each, plan.folder(each))))
    pipe.send(None)


def _indices(plan: Plan, index: int) -> Iterator[int]:
    for each in range(index, plan.first + plan.cases, plan.jobs):
        if time.monotonic() > plan.deadline:
            return
        yield each


def _receive(worker: _Worker, plan: Plan, result: Result) -> _Worker | None:
    """Receive what a worker reports; return the worker that goes on, None when its lane is done."""
    try:
        said = worker.pipe.recv()
    except EOFError:
        worker.process.join()
        return _lost(worker, plan, result, f"the process died, exit code {worker.process.exitcode}")
    if said is None:
        worker.process.join()
        return None
    index, problem = said
    result.cases += 1
    if problem is not None:
        result.findings.append(Finding(index, problem, plan.folder(index)))
    worker.index, worker.since = index + plan.jobs, time.monotonic()
    return worker


def _lost(worker: _Worker, plan: Plan, result: Result, problem: str) -> _Worker | None:
    """Keep the case that a worker was lost with; return the worker that goes on after it."""
    _kill(worker)
    folder = plan.folder(worker.index)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "problem.txt").write_text(problem, "utf-8")
    result.cases += 1
    result.findings.append(Finding(worker.index, problem, folder))
    following = worker.index + plan.jobs
    return _start(plan, worker.lane, following) if following < plan.first + plan.cases else None


def _kill(worker: _Worker) -> None:
    worker.process.kill()
    worker.process.join()
