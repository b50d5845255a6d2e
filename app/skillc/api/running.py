"""Starts tasks in simulation, each as an operation in a thread of its own, and runs them to their end."""

from __future__ import annotations

import atexit
import logging
import threading
import weakref
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager, nullcontext
from contextvars import copy_context
from functools import partial
from pathlib import Path
from typing import Any, Unpack

from msgspec import structs

from skillc.api.boundary import NoticeList, api_call
from skillc.api.operation import Operation
from skillc.api.operation_state import Monitor, OperationState
from skillc.api.run import Run
from skillc.errors import RequestError, ServiceError
from skillc.services.project.backends import require_backend
from skillc.services.recording.recordings import find_mcap
from skillc.services.reporting.files import check_writable
from skillc.services.run.running import RunOptions, find_planners, run_task
from skillc.services.tasks.loading import LoadedTask, check_request, fill_in, load_task
from skillc.values.arguments import read_pace
from skillc.values.keywords import read_keywords
from skillc.values.run_keywords import RunKeywords, StartKeywords
from skillc_runtime.execution import task_planning  # noqa: F401  those that plan are forks, which share it
from skillc_runtime.execution.pace import Pace
from skillc_runtime.recording.envelope import make_run_id
from skillc_runtime.recording.run_spec import RunSpec

Loading = Callable[[NoticeList], AbstractContextManager[LoadedTask]]
EXIT_S = 10.0
"""How long the end of the program waits for each operation to stop."""
_LIVE: weakref.WeakSet[OperationState] = weakref.WeakSet()
logging.getLogger("skillc").addHandler(logging.NullHandler())


def run(task: str | None = None, **settings: Unpack[RunKeywords]) -> Run:
    """Run a task, a goal or a skill call in simulation, and return how it ended; a failure is a result, not an error.

    `task`, `arguments`, `goal`, `scene`, `library` and `minimise` are as in `plan`; `call` is one of a skill such as
    `Wipe(surface: lab:Table-1)`. With `out` it is recorded in that folder, with a report, figures and, unless `film`
    is false, a film; `signals` adds the signals of its devices as `csv` or `parquet`, `gif` a film that repeats, with
    the `looks` of devices. `backend` is the name of one that is installed: `mujoco`, `kinematic`, which is faster,
    without physics, or that of a package; it comes before that of the task or its project; with `dry` its devices
    are looked at, and the task is simulated from there. Arms and bases have the share `speed`, above 0 to 1, of
    their speeds. `seed` determines how a simulation differs from the world model. The task fails when it takes
    longer than `deadline_s` s of the cell's time, a primitive or a wait when it takes longer than `step_deadline_s`
    s. Plans are reused unless `plan_cache` is false.

    An interrupt from the keyboard stops the task safely, and is raised again. Errors as of `start`.
    """
    operation = _start(task, settings, RunKeywords)
    return operation.wait()  # wait ends: with the run, which has a deadline, or by an interrupt


def start(task: str | None = None, **settings: Unpack[StartKeywords]) -> Operation:
    """Start a task, a goal or a skill call in simulation, and return the operation, which runs in its own thread.

    The parameters are those of `run`. `pace` is `fast`, `real`, or a factor of real time. With `step` it
    pauses before the first call of a skill, and this returns then; it also pauses before each SKILL or FILE:LINE of
    `breakpoints`, and with `confirm_steps` before each step.

    DiagnosticsError if the library, the scene, the goal or the call has errors, RequestError if what is named does not
    exist, SkillcError if the folder cannot be written to.
    """
    return _start(task, settings, StartKeywords)


def _start(task: str | None, settings: Mapping[str, Any], known: type) -> Operation:
    """Load and start what keyword arguments say; errors as of `start`."""
    with api_call():
        spec = fill_in(read_keywords(RunSpec, settings, known, task))
        check_request(spec)
        options = make_options(spec)

        @contextmanager
        def load(notes: NoticeList) -> Iterator[LoadedTask]:
            with load_task(spec, notes) as loaded:
                yield loaded

        operation = begin(load, options, spec.task or spec.goal or spec.call or "task")
    if spec.step:
        operation.wait_for_pause()
    return operation


def make_options(spec: RunSpec) -> RunOptions:
    """Return the options of a run in this process, which no other process watches. RequestError for wrong ones."""
    if spec.out is None and (spec.signals is not None or spec.gif):
        raise RequestError("`signals` and `gif` are files, which require `out`")
    if spec.backend is not None:
        require_backend(spec.backend)
    out = None if spec.out is None else str(Path(spec.out).absolute())
    options = RunOptions(structs.replace(spec, out=out), partial(find_planners, spec.plan_cache), tick_timeout_s=None)
    check_writable(options.out)
    return options


def begin_loaded(task: LoadedTask, options: RunOptions) -> Operation:
    """Start a task that is loaded; its world is its own."""
    return begin(lambda _notes: nullcontext(task), options, task.assignment.name)


def begin(load: Loading, options: RunOptions, name: str) -> Operation:
    """Start a thread that loads and runs a task, and return once it is loaded; the errors of loading are raised."""
    state = OperationState(make_run_id(name), name, Pace(read_pace(options.spec.pace)))
    loaded = threading.Event()
    context = copy_context()
    thread = threading.Thread(
        target=lambda: context.run(_work, load, options, state, loaded), name=f"skillc {state.id}", daemon=True
    )
    _LIVE.add(state)
    thread.start()
    try:
        loaded.wait()  # wait ends: with the end of the thread at the latest
    except KeyboardInterrupt:
        state.ask_to_stop("interrupted")
        raise
    if isinstance(state.error, ServiceError) and not state.events:
        raise state.error
    return Operation(state)


def _work(load: Loading, options: RunOptions, state: OperationState, loaded: threading.Event) -> None:
    """Load and run a task, in the thread of its operation."""
    notes, monitor = NoticeList(), Monitor(state)
    watched = structs.replace(options, run_id=state.id, recorders=(monitor.record,))
    result: Run | None = None
    error: BaseException | None = None
    try:
        with load(notes) as task:
            state.world = task.world
            loaded.set()
            ran = run_task(task, watched, monitor, notes)
            folder = watched.out if ran.written else None
            result = Run(ran.result, tuple(state.events), folder, tuple(notes.messages), find_mcap(folder))
    except BaseException as problem:  # noqa: BLE001 - the boundary of a thread: whoever waits gets the error
        error = problem
    state.end(result, error)
    loaded.set()


@atexit.register
def _stop_all() -> None:
    """Stop the operations that still run when the program ends, so that nothing is torn from under them."""
    running = [each for each in _LIVE if not each.over]
    for each in running:
        each.ask_to_stop("the program ends")
    for each in running:
        each.wait_until_over(EXIT_S)
