"""Runs a task many times with different seeds; trials recorded in a folder are not run again."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import TypeAlias

from msgspec import structs

from skillc.errors import RequestError, ServiceError
from skillc.services.assignments import bind_task
from skillc.services.files import writing_to
from skillc.services.reporting import Reporter
from skillc.services.stores import load_world
from skillc.services.task_loading import find_task_in_scene
from skillc_model import codec
from skillc_model.skills import SkillLibrary, Task
from skillc_runtime.evaluation.trials import identity, page
from skillc_runtime.evaluation.trials.experiment import Experiment, TrialRunner
from skillc_runtime.evaluation.trials.journal import Heading, JournalError, TrialJournal, find_missing_seeds
from skillc_runtime.evaluation.trials.judging import judge_series
from skillc_runtime.evaluation.trials.series import Series
from skillc_runtime.evaluation.trials.trial import TRIAL_LIMIT_S, Disturbance, Trial
from skillc_runtime.evaluation.trials.trial_cell import is_without_effect
from skillc_runtime.evaluation.trials.workers import PreparationError, run_in_processes
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.world_state import WorldState

PAGE = "trials.html"
StartMonitor: TypeAlias = Callable[[str, int], AbstractContextManager[Callable[[Trial], None]]]
"""Takes a task's name and the number of trials already done; the value of the context is called with each trial."""


@dataclass(frozen=True, slots=True)
class TrialRequest:
    """The task of the trials, their disturbance and seeds, the number of parallel `jobs`, and the folder to write.

    `limit_s` is the time that one trial may take, in s of wall-clock time. `arguments` are the values of the task's
    parameters, as they are written in a call.
    """

    reference: str
    disturbance: Disturbance
    seeds: Sequence[int]
    jobs: int
    out: Path | None
    limit_s: float = TRIAL_LIMIT_S
    arguments: Mapping[str, str] = field(default_factory=dict)


def run_trials(request: TrialRequest, watch: StartMonitor, reporter: Reporter) -> Series:
    """Run the trials that are not recorded yet; return all of them, judged. Ctrl-C ends the running ones.

    RequestError, DiagnosticsError or ServiceError if the library, the scene or the folder cannot be used, or if no
    process can run trials.
    """
    library, task, scene = find_task_in_scene(request.reference)
    state = load_world(scene, library.vocabulary, reporter)
    require_effect(request.disturbance, state)
    experiment = make_experiment(task, library, scene, state, request.arguments, request.disturbance)
    trials = _run(request, experiment, _heading(experiment, library), watch, reporter)
    return judge_series(experiment.task, request.disturbance, len(request.seeds), trials)


def require_effect(disturbance: Disturbance, state: WorldState) -> None:
    """RequestError for a disturbance that changes nothing in a scene; ServiceError if it cannot be simulated."""
    try:
        without_effect = is_without_effect(disturbance, state)
    except (SheetError, FrameError) as error:
        raise ServiceError(f"the scene cannot be simulated: {error}") from error
    if without_effect:
        affected = "surface, fixture or person" if disturbance == "missing" else "surface or fixture"
        raise RequestError(f"the disturbance `{disturbance}` changes nothing here: the scene has no {affected}")


def make_experiment(
    task: Task,
    library: SkillLibrary,
    scene: Path,
    state: WorldState,
    arguments: Mapping[str, str],
    disturbance: Disturbance,
) -> Experiment:
    """Return what trials of a task with arguments run, in the file of a scene, whose world is `state`.

    DiagnosticsError or RequestError if the arguments have errors.
    """
    task = bind_task(task, library, state, arguments)
    library = structs.replace(library, tasks={**library.tasks, task.name: task})
    return Experiment(codec.dumps(library), task.name, scene, disturbance)


def write_page(result: Series, out: Path) -> None:
    """Write the HTML page of a series into its folder. ServiceError if it cannot be written."""
    with writing_to(out):
        (out / PAGE).write_text(page.render_page(result), encoding="utf-8")


def _run(
    request: TrialRequest, experiment: Experiment, heading: Heading, watch: StartMonitor, reporter: Reporter
) -> tuple[Trial, ...]:
    with nullcontext() if request.out is None else _journal(request.out, heading) as journal:
        known = () if journal is None else journal.trials
        done = {trial.seed: trial for trial in known if trial.seed in request.seeds}
        left = find_missing_seeds(request.seeds, known)
        trials = run_in_processes(partial(TrialRunner, experiment), left, request.jobs, request.limit_s)
        with watch(experiment.task, len(done)) as show:
            for trial in _record(_until_interrupted(trials, reporter), journal):
                done[trial.seed] = trial
                show(trial)
    return tuple(done.values())


def _heading(experiment: Experiment, library: SkillLibrary) -> Heading:
    return Heading(
        task=experiment.task,
        disturbance=experiment.disturbance,
        skillc=identity.identify_skillc(),
        library=f"{library.name} of {library.hash[: identity.DIGITS]}",
        scene=identity.identify_file(experiment.scene),
    )


def _record(trials: Iterator[Trial], journal: TrialJournal | None) -> Iterator[Trial]:
    """Yield trials; those with a journal are in it when they are yielded."""
    for trial in trials:
        if journal is not None:
            journal.add(trial)
        yield trial


def _until_interrupted(trials: Iterator[Trial], reporter: Reporter) -> Iterator[Trial]:
    """Yield trials; on Ctrl-C end the running ones and report it. ServiceError if no process can run any."""
    try:
        yield from trials
    except KeyboardInterrupt:
        reporter.say("interrupted; with --out, the same command continues with the remaining trials")
    except PreparationError as error:
        raise ServiceError(f"no process can run the trials: {error}") from error


@contextmanager
def _journal(out: Path, heading: Heading) -> Iterator[TrialJournal]:
    with writing_to(out):
        try:
            journal = TrialJournal(out, heading)
        except JournalError as error:
            raise ServiceError(str(error)) from error
        with journal:
            yield journal
