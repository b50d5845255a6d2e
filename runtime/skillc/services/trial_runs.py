"""Running a task many times in realities that differ; trials that were run before are taken from a folder."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TypeAlias

from skillc.services.errors import ServiceError
from skillc.services.files import writing_to
from skillc.services.reporting import Reporter
from skillc.services.stores import load_world
from skillc.services.task_loading import find_task_in_scene
from skillc_model import codec
from skillc_model.skills import SkillLibrary
from skillc_runtime.evaluation.trials import identity, page
from skillc_runtime.evaluation.trials.experiment import Experiment, TrialRunner
from skillc_runtime.evaluation.trials.journal import Heading, JournalError, TrialJournal, find_missing_seeds
from skillc_runtime.evaluation.trials.series import Series, judge_series
from skillc_runtime.evaluation.trials.trial import Disturbance, Trial
from skillc_runtime.evaluation.trials.workers import run_in_processes

PAGE = "trials.html"
Watch: TypeAlias = Callable[[str, int], AbstractContextManager[Callable[[Trial], None]]]
"""Watches trials of a task, so many of which are done: calls what the context returns with each one."""


@dataclass(frozen=True, slots=True)
class TrialRequest:
    """Trials: of which task, disturbed by what, with which seeds, so many at a time, kept in which folder."""

    reference: str
    disturbance: Disturbance
    seeds: Sequence[int]
    jobs: int
    out: Path | None


def run_trials(request: TrialRequest, watch: Watch, reporter: Reporter) -> Series:
    """Run the trials that were not run before; return all of them, judged. Ctrl-C ends what runs.

    RequestError, DiagnosticsError or ServiceError for what is wrong with the library, the scene or the folder.
    """
    library, task, scene = find_task_in_scene(request.reference)
    load_world(scene, library.vocabulary, reporter)
    experiment = Experiment(codec.dumps(library), task.name, scene, request.disturbance)
    trials = _run(request, experiment, _heading(experiment, library), watch, reporter)
    return judge_series(task.name, request.disturbance, len(request.seeds), trials)


def write_page(result: Series, out: Path) -> None:
    """Write the page of a series into its folder. ServiceError where that cannot be done."""
    with writing_to(out):
        (out / PAGE).write_text(page.render_page(result), encoding="utf-8")


def _run(
    request: TrialRequest, experiment: Experiment, heading: Heading, watch: Watch, reporter: Reporter
) -> tuple[Trial, ...]:
    with nullcontext() if request.out is None else _journal(request.out, heading) as journal:
        known = () if journal is None else journal.trials
        done = {trial.seed: trial for trial in known if trial.seed in request.seeds}
        left = find_missing_seeds(request.seeds, known)
        trials = run_in_processes(partial(TrialRunner, experiment), left, request.jobs)
        with watch(experiment.task, len(done)) as show:
            for trial in _until_interrupted(trials, reporter):
                done[trial.seed] = trial
                if journal is not None:
                    journal.add(trial)
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


def _until_interrupted(trials: Iterator[Trial], reporter: Reporter) -> Iterator[Trial]:
    """Yield trials; on Ctrl-C end what runs and report it."""
    try:
        yield from trials
    except KeyboardInterrupt:
        reporter.say("interrupted; what is kept with --out is not run again by the same command")


@contextmanager
def _journal(out: Path, heading: Heading) -> Iterator[TrialJournal]:
    with writing_to(out):
        try:
            journal = TrialJournal(out, heading)
        except JournalError as error:
            raise ServiceError(str(error)) from error
        with journal:
            yield journal
