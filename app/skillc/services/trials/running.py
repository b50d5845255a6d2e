"""Runs a task many times with different seeds; trials recorded in a folder are not run again."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import AbstractContextManager, closing, contextmanager, nullcontext
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import TypeAlias

from msgspec import structs

from skillc.errors import RequestError, ServiceError
from skillc.services.project.project import DEFAULT_BACKEND
from skillc.services.reporting.files import writing_to
from skillc.services.reporting.reporter import Reporter
from skillc.services.run.real_devices import require_reality
from skillc.services.scene.stores import load_world
from skillc.services.tasks.assignments import bind_task
from skillc.services.tasks.loading import find_task_in_scene
from skillc_model import codec
from skillc_model.skills import SkillLibrary, Task
from skillc_runtime.evaluation.trials import identity, page
from skillc_runtime.evaluation.trials.content import Experiment, prepare_runner, read_folders
from skillc_runtime.evaluation.trials.dispatch import ExecutorError, run_on
from skillc_runtime.evaluation.trials.hosting import Tried
from skillc_runtime.evaluation.trials.journal import Heading, JournalError, TrialJournal, find_missing_seeds
from skillc_runtime.evaluation.trials.judging import judge_series
from skillc_runtime.evaluation.trials.series import Series
from skillc_runtime.evaluation.trials.trial import TRIAL_LIMIT_S, Trial, TrialDisturbance
from skillc_runtime.evaluation.trials.trial_cell import is_without_effect
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.world_state import WorldState

PAGE = "trials.html"
StartMonitor: TypeAlias = Callable[[str, int], AbstractContextManager[Callable[[Trial], None]]]
"""Takes a task's name and the number of trials already done; the value of the context is called with each trial."""
OpenExecutor: TypeAlias = Callable[[], AbstractContextManager[Executor]]
"""Starts, or connects to, what runs the trials; it is left at the end of the context."""


@dataclass(frozen=True, slots=True)
class TrialRequest:
    """The task of the trials, their disturbance and seeds, what makes the executor, and the folder to write.

    `limit_s` is the time that one trial may take, in s of wall-clock time. `arguments` are the values of the task's
    parameters, as they are written in a call. `reality` is how far devices are from what they should be, as the scene
    says if it is None.
    """

    reference: str
    disturbance: TrialDisturbance
    seeds: Sequence[int]
    executor: OpenExecutor
    out: Path | None
    limit_s: float = TRIAL_LIMIT_S
    arguments: Mapping[str, str] = field(default_factory=dict)
    reality: str | None = None


def run_trials(request: TrialRequest, watch: StartMonitor, reporter: Reporter) -> Series:
    """Run the trials that are not recorded yet; return all of them, judged. Ctrl-C ends the running ones.

    RequestError, DiagnosticsError or ServiceError if the library, the scene or the folder cannot be used, or if the
    executor cannot run trials.
    """
    library, task, scene, _ = find_task_in_scene(request.reference, DEFAULT_BACKEND)
    state = load_world(scene, library.vocabulary, reporter)
    require_effect(request.disturbance, state)
    if request.reality is not None:
        require_reality(request.reality, state)
    library, name = bind_trial_task(task, library, state, request.arguments)
    experiment = make_experiment(library, name, scene, state, request.disturbance, request.reality)
    heading = _heading(experiment, library)
    with nullcontext() if request.out is None else _journal(request.out, heading) as journal:
        known = () if journal is None else journal.trials
        done = {trial.seed: trial for trial in known if trial.seed in request.seeds}
        took_s: list[float] = []
        with watch(experiment.task, len(done)) as show:
            for tried in _record(_until_interrupted(_run_missing(request, experiment, done), reporter), journal):
                done[tried.trial.seed] = tried.trial
                took_s += () if tried.took_s is None else (tried.took_s,)
                show(tried.trial)
    return judge_series(experiment.task, request.disturbance, len(request.seeds), tuple(done.values()), took_s)


def require_effect(disturbance: TrialDisturbance, state: WorldState) -> None:
    """RequestError for a disturbance that changes nothing in a scene; ServiceError if it cannot be simulated."""
    try:
        without_effect = is_without_effect(disturbance, state)
    except (SheetError, FrameError) as error:
        raise ServiceError(f"the scene cannot be simulated: {error}") from error
    if without_effect:
        affected = "surface, fixture or person" if disturbance == "missing" else "surface or fixture"
        raise RequestError(f"the disturbance `{disturbance}` changes nothing here: the scene has no {affected}")


def bind_trial_task(
    task: Task, library: SkillLibrary, state: WorldState, arguments: Mapping[str, str]
) -> tuple[SkillLibrary, str]:
    """Return a library with a task that has its arguments, and the name of that; `state` is the world of the scene.

    DiagnosticsError or RequestError if the arguments have errors.
    """
    task = bind_task(task, library, state, arguments)
    return structs.replace(library, tasks={**library.tasks, task.name: task}), task.name


def write_page(result: Series, out: Path) -> None:
    """Write the HTML page of a series into its folder. ServiceError if it cannot be written."""
    with writing_to(out):
        (out / PAGE).write_text(page.render_page(result), encoding="utf-8")


def make_experiment(
    library: SkillLibrary,
    task: str,
    scene: Path,
    state: WorldState,
    disturbance: TrialDisturbance = "none",
    reality: str | None = None,
) -> Experiment:
    """Return what trials of a task run; `state` is the world of the scene. ServiceError if a file cannot be read."""
    try:
        return Experiment(
            library=codec.dumps(library),
            task=task,
            disturbance=disturbance,
            scene_name=scene.name,
            scene=scene.read_bytes(),
            folders=read_folders(state),
            reality=reality,
        )
    except OSError as error:
        raise ServiceError(f"{error.filename} cannot be read: {error.strerror}") from error


def _run_missing(
    request: TrialRequest, experiment: Experiment, done: Mapping[int, Trial]
) -> Generator[Tried, None, None]:
    if left := find_missing_seeds(request.seeds, done.values()):
        with (
            request.executor() as executor,
            closing(run_on(executor, partial(prepare_runner, experiment), left, request.limit_s)) as trials,
        ):
            yield from trials


def _heading(experiment: Experiment, library: SkillLibrary) -> Heading:
    return Heading(
        task=experiment.task,
        disturbance=experiment.disturbance,
        skillc=identity.identify_skillc(),
        library=f"{library.name} of {experiment.library_digest}",
        scene=f"{experiment.scene_name} of {experiment.scene_digest}{_describe_reality(experiment)}",
    )


def _describe_reality(experiment: Experiment) -> str:
    return "" if experiment.reality is None else f" with reality {experiment.reality}"


def _record(trials: Iterator[Tried], journal: TrialJournal | None) -> Iterator[Tried]:
    """Yield trials; those with a journal are in it when they are yielded."""
    for tried in trials:
        if journal is not None:
            journal.add(tried.trial)
        yield tried


def _until_interrupted(trials: Generator[Tried, None, None], reporter: Reporter) -> Iterator[Tried]:
    """Yield trials; on Ctrl-C end the running ones and report it. ServiceError if the executor cannot run any."""
    try:
        yield from trials
    except KeyboardInterrupt:
        trials.close()
        reporter.say("interrupted; with --out, the same command continues with the remaining trials")
    except ExecutorError as error:
        raise ServiceError(f"no more trials can be run: {error}") from error


@contextmanager
def _journal(out: Path, heading: Heading) -> Iterator[TrialJournal]:
    with writing_to(out):
        try:
            journal = TrialJournal(out, heading)
        except JournalError as error:
            raise ServiceError(str(error)) from error
        with journal:
            yield journal
