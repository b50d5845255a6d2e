"""A run of a few recorded ticks, without a cell, in a process of its own: `run_to_end.py FOLDER TIMEOUT HOW`."""

from __future__ import annotations

import ctypes
import os
import re
import signal
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from skillc.services.reporting.reporter import SilentReporter
from skillc.services.run.recorded_run import RecordedRun, RecordingOptions, recorded_run
from skillc_dsl.position import Position
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.motion.arrays import OutVector
from skillc_runtime.motion.numerics.compiled import LISTENERS, compiled
from skillc_runtime.recording.events import FORMAT, ImplementationChosen, NodeStarted, TaskEnded, TaskStarted

FOR_EVER_S = 10**9
HERE = Position("play.skill", 3, 1)


def raise_error(error: BaseException) -> None:
    raise error


def finish(run: RecordedRun) -> None:
    """End as a run ends that nothing disturbs."""
    run.publisher(TaskEnded(time=0.2, task="play", status="succeeded", verified=True))
    run.watchdog.disarm()


def finish_and(then: Callable[[], object]) -> Callable[[RecordedRun], object]:
    """End the run, and do something while the report would be written."""
    return lambda run: (finish(run), then())


def be_suspended(run: RecordedRun) -> None:
    """Be suspended for longer than a tick may take, and go on."""
    this = os.getpid()
    if os.fork() == 0:
        for number, after_s in ((signal.SIGSTOP, 0.2), (signal.SIGCONT, 2.0 * float(sys.argv[2]))):
            time.sleep(after_s)
            os.kill(this, number)
        os._exit(0)
    for _ in range(50):
        time.sleep(0.01)
        run.watchdog.count_tick(0.2)
    os.wait()
    finish(run)


def compile_slowly(run: RecordedRun) -> None:
    """Compile a function, and be in the middle of it for longer than a tick may take."""
    run.watchdog.count_tick(0.2)

    def double(out: OutVector, factor: float) -> None:
        out[0] = factor * out[0]

    LISTENERS.append(lambda change: rest() if change > 0 else None)
    compiled(double)(np.ones(1), 2.0)
    run.watchdog.count_tick(0.2)
    finish(run)


def rest(*_: object) -> None:
    """Do nothing for longer than a tick may take."""
    time.sleep(2.0 * float(sys.argv[2]))


WAYS: dict[str, Callable[[RecordedRun], object]] = {
    "finish": finish,
    "sleep": lambda _: time.sleep(FOR_EVER_S),
    "lock": lambda _: ctypes.PyDLL(None).sleep(FOR_EVER_S),
    "match": lambda _: re.fullmatch(r"(a+)+b", "a" * 64),
    "ignore": lambda _: (signal.signal(signal.SIGQUIT, signal.SIG_IGN), time.sleep(FOR_EVER_S)),
    "leave": lambda _: os._exit(0),
    "kill": lambda _: os.kill(os.getpid(), signal.SIGKILL),
    "crash": lambda _: ctypes.string_at(0),
    "hang up": lambda _: os.kill(os.getpid(), signal.SIGHUP),
    "exit": lambda _: sys.exit(),
    "error": lambda _: raise_error(ValueError("what was expected is missing")),
    "interrupt": lambda _: raise_error(KeyboardInterrupt()),
    "suspend": be_suspended,
    "compile": compile_slowly,
    "report": finish_and(rest),
    "die in the report": finish_and(lambda: os.kill(os.getpid(), signal.SIGKILL)),
}


def main(folder: Path, timeout_s: float, how: str) -> None:
    options = RecordingOptions(folder, timeout_s, prints_json=True)
    with recorded_run(TaskResult(task="play", status="interrupted", seed=7), options, SilentReporter()) as run:
        run.publisher(TaskStarted(time=0.0, format=FORMAT, task="play", library="plays"))
        for number, name in enumerate(("Outer", "Act"), 1):
            run.publisher(
                NodeStarted(time=0.1, node=number, parent=number - 1, kind="call", name=f"{name}[way]", source=HERE)
            )
            run.publisher(
                ImplementationChosen(time=0.1, node=number, skill=name, implementation="way", bindings={}, source=HERE)
            )
        run.watchdog.count_tick(0.2)
        WAYS[how](run)


if __name__ == "__main__":
    main(Path(sys.argv[1]), float(sys.argv[2]), sys.argv[3])
