"""Starts tasks in simulation, each as an operation in a thread of its own, and runs them to their end."""

from __future__ import annotations

import atexit
import logging
import threading
import weakref
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from contextvars import copy_context
from dataclasses import replace
from pathlib import Path
from typing import Any

from skillc.api.boundary import NoticeList, api_call
from skillc.api.operation import Operation
from skillc.api.operation_state import Monitor, OperationState
from skillc.api.planning import Minimise, make_request
from skillc.api.run import Run
from skillc.errors import RequestError, ServiceError
from skillc.services.backends import BackendName, require_backend
from skillc.services.files import check_writable
from skillc.services.planning import prepare_planners, with_minimal_makespan
from skillc.services.recordings import find_mcap
from skillc.services.run_result import PRIMITIVE_LOOKS
from skillc.services.running import RunOptions, run_task
from skillc.services.signal_files import SignalFormat
from skillc.services.task_loading import LoadedTask, load_task
from skillc.values.arguments import AnyPath, optional_path, optional_seconds, read_pace, require_choice, require_count
from skillc_runtime.execution.pace import Pace
from skillc_runtime.recording.envelope import make_run_id

Loading = Callable[[NoticeList], AbstractContextManager[LoadedTask]]
EXIT_S = 10.0
"""How long the end of the program waits for each operation to stop."""
_LIVE: weakref.WeakSet[OperationState] = weakref.WeakSet()
logging.getLogger("skillc").addHandler(logging.NullHandler())


def run(
    task: str | None = None,
    *,
    arguments: Mapping[str, Any] | None = None,
    goal: str | None = None,
    skill: str | None = None,
    scene: AnyPath | None = None,
    library: AnyPath | None = None,
    out: AnyPath | None = None,
    signals: SignalFormat | None = None,
    film: bool = True,
    gif: bool = False,
    seed: int = 0,
    backend: BackendName = "mujoco",
    minimise: Minimise = "work",
    deadline_s: float | None = None,
    step_deadline_s: float | None = None,
    looks: str = PRIMITIVE_LOOKS,
) -> Run:
    """Run a task, a goal or a skill call in simulation, and return how it ended; a failure is a result, not an error.

    `task`, `arguments`, `goal`, `scene`, `library` and `minimise` are as in `plan`; `skill` is a call such as
    `Wipe(surface: lab:Table-1)`. With `out` it is recorded in that folder, with a report, figures and, unless `film`
    is false, a film; `signals` adds the signals of its devices as `csv` or `parquet`, `gif` a film that repeats.
    `backend` is the name of one that is installed: `mujoco`, `kinematic`, which is faster, without physics, or that of
    a package. `seed` determines how a simulation differs from the world model. The task fails when it takes longer than
    `deadline_s` s of the cell's time, a primitive or a wait when it takes longer than `step_deadline_s` s.

    An interrupt from the keyboard stops the task safely, and is raised again. Errors as of `start`.
    """
    operation = start(
        task,
        arguments=arguments,
        goal=goal,
        skill=skill,
        scene=scene,
        library=library,
        out=out,
        signals=signals,
        film=film,
        gif=gif,
        seed=seed,
        backend=backend,
        minimise=minimise,
        deadline_s=deadline_s,
        step_deadline_s=step_deadline_s,
        looks=looks,
    )
    return operation.wait()  # wait ends: with the run, which has a deadline, or by an interrupt


def start(
    task: str | None = None,
    *,
    arguments: Mapping[str, Any] | None = None,
    goal: str | None = None,
    skill: str | None = None,
    scene: AnyPath | None = None,
    library: AnyPath | None = None,
    out: AnyPath | None = None,
    signals: SignalFormat | None = None,
    film: bool = True,
    gif: bool = False,
    seed: int = 0,
    backend: BackendName = "mujoco",
    minimise: Minimise = "work",
    deadline_s: float | None = None,
    step_deadline_s: float | None = None,
    looks: str = PRIMITIVE_LOOKS,
    pace: float | str = "fast",
    step: bool = False,
    pause_at: Sequence[str] = (),
) -> Operation:
    """Start a task, a goal or a skill call in simulation, and return the operation, which runs in its own thread.

    The parameters are those of `run`. `pace` is `fast`, `real`, or a factor of real time. With `step` it
    pauses before the first call of a skill, and this returns then; it also pauses before each SKILL or FILE:LINE of
    `pause_at`.

    DiagnosticsError if the library, the scene, the goal or the call has errors, RequestError if what is named does not
    exist, SkillcError if the folder cannot be written to.
    """
    with api_call():
        request = make_request(task, goal, skill, scene, library, arguments)
        request.check()
        options = make_options(out, seed, backend, deadline_s)
        if options.out is None and (signals is not None or gif):
            raise RequestError("`signals` and `gif` are files, which require `out`")
        if signals is not None:
            require_choice(signals, SignalFormat, "`signals`")
        step_limit_s = optional_seconds(step_deadline_s, "`step_deadline_s`")
        options = replace(
            options,
            step_deadline_s=step_limit_s,
            looks=looks,
            step=step,
            pause_at=tuple(pause_at),
            signals=signals,
            film=film,
            gif=gif,
        )

        @contextmanager
        def load(notes: NoticeList) -> Iterator[LoadedTask]:
            with load_task(request, notes) as loaded:
                yield with_minimal_makespan(loaded) if minimise == "makespan" else loaded

        require_choice(minimise, Minimise, "`minimise`")
        operation = begin(load, options, pace, task or goal or skill or "task")
        if step:
            operation.wait_for_pause()
        return operation


def make_options(
    out: AnyPath | None,
    seed: int,
    backend: BackendName,
    deadline_s: float | None,
) -> RunOptions:
    """Return the options of a run in this process, which no other process watches. RequestError for wrong ones."""
    folder = optional_path(out, "`out`")
    options = RunOptions(
        out=None if folder is None else Path(folder).absolute(),
        seed=require_count(seed, "the seed", 0),
        planners=prepare_planners(True),
        tick_timeout_s=None,
        deadline_s=optional_seconds(deadline_s, "`deadline_s`"),
        backend=require_backend(backend),
    )
    check_writable(options.out)
    return options


def begin_loaded(task: LoadedTask, options: RunOptions, pace: float | str) -> Operation:
    """Start a task that is loaded; its world is its own."""
    return begin(lambda _notes: nullcontext(task), options, pace, task.assignment.name)


def begin(load: Loading, options: RunOptions, pace: float | str, name: str) -> Operation:
    """Start a thread that loads and runs a task, and return once it is loaded; the errors of loading are raised."""
    state = OperationState(make_run_id(name), name, Pace(read_pace(pace)))
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
    watched = replace(options, run_id=state.id, recorders=(monitor.record,))
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
