"""The side of the run: starts the watchdog process, counts ticks, and says when the run has ended."""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import msgspec

from skillc.errors import ServiceError
from skillc.services.watchdog import ending
from skillc.services.watchdog.ending import DESCRIPTION, RunDescription
from skillc_ontology import catalogue
from skillc_runtime.motion.numerics.compiled import LISTENERS
from skillc_runtime.platforms.watchdog import IS_WATCHED, exiting_at_sigquit, start_watchdog
from skillc_runtime.platforms.watchdog_program import SharedState


@contextmanager
def watching_compilation(changed: Callable[[int], None]) -> Iterator[None]:
    """Call `changed` with 1 whenever a function begins to be compiled or loaded, and with -1 when that ends."""
    LISTENERS.append(changed)
    try:
        yield
    finally:
        LISTENERS.remove(changed)


TICK_TIMEOUT_S = 30.0
"""How long a tick may take by default, in s of wall time."""

CLOSE_S = 5.0
"""How long the watchdog may take to end once the run has ended."""


@contextmanager
def watching(folder: Path, run: RunDescription, state: SharedState) -> Iterator[None]:
    """Watch this process, which carries out a run, in a `with` statement; `state`, in `folder`, counts its ticks.

    If a tick takes longer than the run's time-out, or if this process dies, the watchdog ends this process with exit
    code 3, writes the end of the run, and removes `folder`, which is for the use of both. Functions may be compiled for
    as long as it takes. A time-out of 0 lets ticks take any time. ServiceError if the watchdog cannot be started.
    On Windows nobody watches.
    """
    if not IS_WATCHED:
        yield
        return
    process = _start(folder, run)
    try:
        with exiting_at_sigquit(), watching_compilation(state.add_busy):
            yield
    finally:
        _dismiss(process)


def _start(folder: Path, run: RunDescription) -> subprocess.Popen[bytes]:
    paths = os.pathsep.join(str(Path(path).absolute()) for path in sys.path if path)
    try:
        (folder / DESCRIPTION).write_bytes(msgspec.json.encode(run))
        environment = {**catalogue.make_environment(), "PYTHONPATH": paths}
        return start_watchdog(folder, run.timeout_s, ending.__name__, not run.prints_json, environment)
    except OSError as error:
        raise ServiceError(f"the watchdog process cannot be started: {error.strerror or error}") from error


def _dismiss(process: subprocess.Popen[bytes]) -> None:
    """Tell the watchdog that the run has ended, and wait for its end."""
    assert process.stdin is not None, "started with a pipe"
    with contextlib.suppress(OSError):
        process.stdin.write(b"e")
        process.stdin.close()
    try:
        process.wait(CLOSE_S)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait(CLOSE_S)
