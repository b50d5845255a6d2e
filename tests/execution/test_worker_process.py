"""Worker processes: they share nothing that could be destroyed, and nobody waits for one for ever."""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
import threading
import warnings
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import pytest

from skillc_runtime.execution.worker_process import Died, Raised, ReportingFunction, Returned, WorkerProcess
from skillc_runtime.platforms.processes import StartMethod
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, RemoveIndividual, RemoveRelation
from skillc_runtime.world.state.world_state import WorldState
from waiting import LONG_S
from world.lab import VOCABULARY, iri


def zeros(count: int) -> bytes:
    return bytes(count)


def ignore_termination(ready: Path) -> None:
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    ready.touch()
    signal.pause()


def interrupt(_request: None) -> str:
    os.kill(os.getpid(), signal.SIGINT)
    os.kill(os.getpid(), signal.SIGHUP)
    return "still here"


def divide(number: int) -> float:
    if number == 1:
        os._exit(7)
    return 1.0 / number


def answer(worker: WorkerProcess, request: object) -> object:
    worker.ask(request)
    return worker.wait(LONG_S)


@pytest.fixture(params=["fork", "spawn"])
def start(request: pytest.FixtureRequest) -> StartMethod:
    return request.param


@pytest.mark.parametrize("start", ["fork", "spawn", "thread"])
def test_results_of_any_size_arrive_whole(start: StartMethod) -> None:
    worker = WorkerProcess(zeros, start)
    assert worker.poll() is None
    assert [answer(worker, count) for count in (3_000_000, 0)] == [Returned(bytes(3_000_000)), Returned(b"")]
    assert worker.poll() == Returned(b"")
    worker.kill()


def test_an_exception_fails_one_request_and_a_death_all_that_follow(start: StartMethod) -> None:
    worker = WorkerProcess(divide, start)
    raised = answer(worker, 0)
    assert isinstance(raised, Raised) and raised.why.startswith("ZeroDivisionError: ")
    assert answer(worker, 2) == Returned(0.5)
    assert [answer(worker, 1) for _ in range(2)] == [Died("its process ended with code 7")] * 2


def test_a_thread_reports_exceptions_too_and_one_that_is_killed_is_left_behind() -> None:
    worker = WorkerProcess(divide, "thread")
    raised = answer(worker, 0)
    assert isinstance(raised, Raised) and raised.why.startswith("ZeroDivisionError: ")
    assert answer(worker, 2) == Returned(0.5)
    worker.kill()
    waiting = threading.Event()
    blocked = WorkerProcess(lambda _: waiting.wait(LONG_S), "thread")
    assert blocked.poll() is None
    blocked.ask(None)
    blocked.kill()
    assert blocked.poll() == Died("it was killed")
    waiting.set()


def test_signals_of_the_terminal_are_left_to_the_parent(start: StartMethod) -> None:
    worker = WorkerProcess(interrupt, start)
    assert answer(worker, None) == Returned("still here")
    worker.kill()


def count_up(most: int, report: Callable[[object], None]) -> int:
    for number in range(most):
        report(number)
    return most


@pytest.mark.slow
@pytest.mark.parametrize("start", ["fork", "spawn", "thread"])
def test_a_function_reports_how_far_it_is_and_never_waits_for_who_does_not_read(start: StartMethod) -> None:
    worker = WorkerProcess(ReportingFunction(count_up), start)
    assert worker.report is None
    assert answer(worker, 20_000) == Returned(20_000), "more than the connection holds"
    assert worker.report is not None and 0 <= worker.report < 20_000
    worker.ask(1)
    assert worker.report is None, "that was another request"
    assert worker.wait(LONG_S) == Returned(1) and worker.report == 0
    worker.kill()


def test_a_worker_that_ignores_the_request_to_end_is_killed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("skillc_runtime.execution.worker_process.CLEANUP_S", 0.2)
    worker = WorkerProcess(ignore_termination)
    worker.ask(tmp_path / "ready")
    while not (tmp_path / "ready").exists():
        assert worker.wait(0.01) is None
    worker.kill()
    assert worker.poll() == Died("it was killed")
    with suppress(ChildProcessError):  # a busy machine ends it later than CLEANUP_S
        os.waitpid(worker.pid, 0)
    with pytest.raises(ProcessLookupError):
        os.kill(worker.pid, 0)


def test_a_result_that_is_already_there_is_not_lost_by_a_kill() -> None:
    worker = WorkerProcess(zeros)
    assert answer(worker, 5) == Returned(bytes(5))
    worker.kill()
    assert worker.poll() == Returned(bytes(5))
    worker.ask(6)
    assert worker.poll() == Died("it was killed")


def test_what_cannot_be_sent_back_is_said() -> None:
    worker = WorkerProcess(lambda _: threading.Lock())
    result = answer(worker, None)
    assert isinstance(result, Raised) and "cannot pickle" in result.why
    worker.kill()


def test_a_fork_beside_other_threads_works_without_a_warning() -> None:
    release, results = threading.Event(), []
    other = threading.Thread(target=release.wait)
    other.start()

    def run() -> None:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            worker = WorkerProcess(zeros, "fork")
            results.append(answer(worker, 3))
            worker.kill()

    from_thread = threading.Thread(target=run)
    from_thread.start()
    from_thread.join(LONG_S)
    release.set()
    other.join(LONG_S)
    assert results == [Returned(bytes(3))]


SHARING = """
import atexit, gc, sys
from skillc_runtime.execution.worker_process import WorkerProcess

class Cycle:
    def __init__(self):
        self.me = self
    def __del__(self):
        print("collected", flush=True)

def work(_):
    gc.collect()
    print("in the worker")
    return 1

gc.disable()
Cycle()
atexit.register(print, "at exit")
buffered = open(sys.argv[1], "w")
buffered.write("from the parent\\n")
print("before the worker")
worker = WorkerProcess(work, "fork")
worker.ask(None)
print(worker.wait(300.0))
worker.kill()
buffered.close()
"""


def test_a_fork_writes_and_destroys_nothing_of_its_parent(tmp_path: Path) -> None:
    command = (sys.executable, "-c", SHARING, str(tmp_path / "file"))
    said = subprocess.run(command, capture_output=True, text=True, timeout=LONG_S)
    assert said.stderr == ""
    assert sorted(said.stdout.splitlines()) == sorted(
        ["before the worker", "in the worker", "Returned(value=1)", "at exit", "collected"]
    )
    assert (tmp_path / "file").read_text() == "from the parent\n"


def facts(state: WorldState) -> tuple[object, ...]:
    links = {iri: sorted(index.pairs()) for iri, index in state.facts.items()}
    classes = {iri: sorted(types) for iri, types in state.direct.items()}
    return links, classes, sorted(state.individuals)


def test_a_world_that_was_sent_to_a_worker_changes_like_the_original() -> None:
    changes: list[list[Change]] = [
        [AddIndividual(iri(name), (iri("Location"),)) for name in ("hall", "room")],
        [AddRelation(iri("hall"), iri("contain"), iri("room"))],
        [RemoveRelation(iri("hall"), iri("contain"), iri("room"))],
        [RemoveIndividual(iri("hall"))],
    ]
    state, sent = WorldState.empty(VOCABULARY), pickle.loads(pickle.dumps(WorldState.empty(VOCABULARY)))
    for each in changes:
        state, sent = state.with_changes(each), pickle.loads(pickle.dumps(sent.with_changes(each)))
        assert facts(sent) == facts(state)
    assert iri("hall") not in dict(sent.direct.items())
