"""Learns parameters of a task: runs it with the defaults, searches, confirms the best one, and writes its text."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, closing, contextmanager
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import TypeAlias

from msgspec import structs

from skillc.contract.learning import LearnSpec
from skillc.errors import RequestError, ServiceError
from skillc.services.check.fixing import FileChange, unified_diff
from skillc.services.learning import result as results
from skillc.services.learning.evidence import write_evidence
from skillc.services.learning.expressions import check_expressions, read_expressions
from skillc.services.learning.figures import Figures, measured_figures
from skillc.services.learning.parameters import choose_learnable, find_learnable
from skillc.services.learning.racing import Aim
from skillc.services.learning.recorded_run import RunOrder, record_run
from skillc.services.learning.result import DEFAULTS, Learned
from skillc.services.learning.samplers import require_sampler
from skillc.services.learning.search import Search, list_settings, try_fresh
from skillc.services.learning.study import Basis, Candidate, Study, StudySetup
from skillc.services.learning.text import LearnedValue, change_texts, require_own
from skillc.services.library.files import LibraryFiles
from skillc.services.project.project import DEFAULT_BACKEND
from skillc.services.recording.recordings import RECORDING, read_envelopes
from skillc.services.reporting.files import rewrite_file, write_file
from skillc.services.reporting.reporter import Reporter
from skillc.services.run.real_devices import require_reality
from skillc.services.scene.stores import load_world
from skillc.services.tasks.listing import split_reference
from skillc.services.tasks.loading import find_task_in_scene
from skillc.services.trials.running import OpenExecutor, bind_trial_task, make_experiment
from skillc_model.skills import SkillLibrary
from skillc_runtime.evaluation.trials import identity
from skillc_runtime.evaluation.trials.content import Experiment, prepare_runner
from skillc_runtime.evaluation.trials.dispatch import Dispatch, ExecutorError

RUNS = "runs"
CHANGES = "learned.diff"


@dataclass(frozen=True, slots=True)
class LearnOrder:
    """For which task, `LIBRARY:NAME` with arguments, something is learned, what, in which folder, and where it runs.

    `parallel` is how many trials run at the same time. The trials begin from `scene`, by default that of the task.
    """

    reference: str
    spec: LearnSpec
    out: Path
    executor: OpenExecutor
    parallel: int
    arguments: Mapping[str, str] = field(default_factory=dict)
    scene: Path | None = None


@dataclass(frozen=True, slots=True)
class Progress:
    """How far it is: candidates and trials that are done, and the objectives of the front and of the defaults."""

    done: int
    wanted: int
    trials: int
    front: tuple[tuple[float, ...], ...]
    defaults: tuple[float, ...] | None
    fresh: int = 0


StartMonitor: TypeAlias = Callable[[str], AbstractContextManager[Callable[[Progress], None]]]
"""Takes a task's name; the value of the context is called after each trial."""


@dataclass(frozen=True, slots=True)
class _Subject:
    """The task that is learned for, as it is tried."""

    files: LibraryFiles
    library: SkillLibrary
    experiment: Experiment
    scene: Path
    context: str


def learn(request: LearnOrder, watch: StartMonitor, reporter: Reporter) -> Learned:
    """Learn, or go on with the study of the folder; Ctrl-C ends the running trials, and what is known is returned.

    RequestError, DiagnosticsError or ServiceError if the task, the expressions, the parameters or the folder cannot be
    used, if the executor cannot run trials, or if what was learned cannot be written.
    """
    subject = _find_subject(request, reporter)
    with _open_study(request, subject, reporter) as (study, aim):
        is_whole = _search(request, subject, study, aim, watch, reporter)
        learned, changes = _conclude(request, subject, study, aim, is_whole)
    if request.spec.apply and is_whole:
        learned = _apply(request, learned, changes, reporter)
    write_file(request.out / CHANGES, learned.diff)
    return learned


def learn_further(request: LearnOrder, candidates: int, reporter: Reporter) -> Progress:
    """Go on with the study of the folder until so many candidates are tried, and conclude nothing.

    Errors as of `learn`.
    """
    subject = _find_subject(request, reporter)
    some = replace(request, spec=structs.replace(request.spec, candidates=candidates, fresh=0))
    with _open_study(request, subject, reporter) as (study, aim):
        _search(some, subject, study, aim, watch_nothing, reporter)
        return _measure_progress(request, study, aim)


@contextmanager
def watch_nothing(_task: str) -> Iterator[Callable[[Progress], None]]:
    """Watch a search that nobody wants to know of before its end."""
    yield lambda state: None


@contextmanager
def _open_study(request: LearnOrder, subject: _Subject, reporter: Reporter) -> Iterator[tuple[Study, Aim]]:
    """Open the study of the folder, which is begun if there is none, with what is wanted in it."""
    with closing(Study(request.out, _make_heading(request, subject))) as study:
        if study.basis is None:
            _begin(request, subject, study, reporter)
        assert study.basis is not None
        figures = Figures({name: frozenset(units) for name, units in study.basis.units.items()})
        aim = Aim(*read_expressions(*request.spec.expressions, figures))
        study.use_sampler(request.spec.sampler, request.spec.candidates, request.spec.seed)
        yield study, aim


def _find_subject(request: LearnOrder, reporter: Reporter) -> _Subject:
    """Return what is learned for; RequestError or DiagnosticsError if that cannot be."""
    check_expressions(*request.spec.expressions)
    require_sampler(request.spec.sampler)
    files, _ = split_reference(request.reference)
    library, task, scene, _ = find_task_in_scene(request.reference, DEFAULT_BACKEND)
    scene = request.scene or scene
    state = load_world(scene, library.vocabulary, reporter)
    if request.spec.reality is not None:
        require_reality(request.spec.reality, state)
    library, name = bind_trial_task(task, library, state, request.arguments)
    experiment = make_experiment(library, name, scene, state, "none", request.spec.reality)
    reality = "" if request.spec.reality is None else f" with reality {request.spec.reality}"
    return _Subject(files, library, experiment, scene, f"{scene.name}{reality}")


def _make_heading(request: LearnOrder, subject: _Subject) -> StudySetup:
    experiment, (minimise, subject_to) = subject.experiment, request.spec.expressions
    return StudySetup(
        task=experiment.task,
        skillc=identity.identify_skillc(),
        library=f"{subject.library.name} of {experiment.library_digest}",
        scene=f"{subject.context} of {experiment.scene_digest}",
        minimise=minimise,
        subject_to=subject_to,
        parameters=", ".join(request.spec.names),
        trials=request.spec.trials,
        seed=request.spec.seed,
    )


def _begin(request: LearnOrder, subject: _Subject, study: Study, reporter: Reporter) -> None:
    """Run the task once with the defaults, which shows what can be learned and what is measured."""
    folder = request.out / RUNS / "defaults"
    trial = record_run(_order(request, subject), folder, request.spec.deadline_s)
    events = (each.event for each in read_envelopes(folder / RECORDING, reporter))
    found = find_learnable(subject.library, subject.files, events)
    learnable = choose_learnable(found, request.spec.names, subject.files)
    figures = measured_figures(trial)
    objectives, _ = read_expressions(*request.spec.expressions, figures)
    units = {name: tuple(sorted(units)) for name, units in figures.units.items()}
    study.create(Basis(learnable=learnable, units=units), len(objectives))


def _search(
    request: LearnOrder, subject: _Subject, study: Study, aim: Aim, watch: StartMonitor, reporter: Reporter
) -> bool:
    """Run what is missing; return whether all of it is done."""
    seeds = tuple(range(request.spec.seed, request.spec.seed + request.spec.trials))
    search = Search(study, aim, seeds, request.spec.candidates, request.parallel)
    prepare = partial(prepare_runner, subject.experiment)
    with watch(subject.experiment.task) as show, _until_interrupted(reporter) as ended, request.executor() as executor:
        show(_measure_progress(request, study, aim))
        with closing(search.run(executor, prepare, request.spec.deadline_s)) as steps:
            for _ in steps:
                show(_measure_progress(request, study, aim))
        chosen = results.choose(study.candidates, aim, request.spec.take)
        numbers = () if chosen is None else (DEFAULTS, chosen)
        with Dispatch(executor, prepare, request.spec.deadline_s) as dispatch:
            for _ in try_fresh(study, numbers, _fresh_seeds(request), request.parallel, dispatch):
                show(_measure_progress(request, study, aim))
        ended.append(True)
    return bool(ended)


def _fresh_seeds(request: LearnOrder) -> tuple[int, ...]:
    first = request.spec.seed + request.spec.trials
    return tuple(range(first, first + request.spec.fresh))


def _measure_progress(request: LearnOrder, study: Study, aim: Aim) -> Progress:
    means = {number: aim.mean(each.worlds.values()) for number, each in study.candidates.items()}
    front = (means[number] for number in results.list_front(study.candidates, aim))
    return Progress(
        done=sum(each.verdict is not None for each in study.candidates.values()),
        wanted=request.spec.candidates,
        trials=sum(len(each.worlds) for each in study.candidates.values()),
        front=tuple(each for each in front if each is not None),
        defaults=means.get(DEFAULTS),
        fresh=sum(map(len, study.fresh.values())),
    )


def _conclude(
    request: LearnOrder, subject: _Subject, study: Study, aim: Aim, is_whole: bool
) -> tuple[Learned, tuple[FileChange, ...]]:
    """Return the result, with the change of the texts, and the run of the best candidate recorded if all is done."""
    assert study.basis is not None
    chosen = results.choose(study.candidates, aim, request.spec.take)
    known = study.fresh.get(DEFAULTS, {}), study.fresh.get(-1 if chosen is None else chosen, {})
    learned = Learned(
        task=subject.experiment.task,
        scene=subject.context,
        minimise=tuple(each.text for each in aim.objectives),
        subject_to=tuple(each.text for each in aim.constraints),
        parameters=study.basis.learnable,
        seeds=tuple(range(request.spec.seed, request.spec.seed + request.spec.trials)),
        wanted=request.spec.candidates,
        candidates=results.describe_candidates(study.candidates, study.basis.learnable, aim),
        front=results.list_front(study.candidates, aim),
        chosen=chosen,
        importances={each.text: study.compute_importances(index) for index, each in enumerate(aim.objectives)},
        fresh=results.compare_fresh(aim, *known),
        complete=is_whole,
        recordings={"defaults": str(request.out / RUNS / "defaults")},
    )
    if chosen is None:
        return learned, ()
    candidate = study.candidates[chosen]
    changes = _write_changes(subject, learned, candidate)
    diff = "".join(unified_diff(each.before, each.after, each.shown) for each in changes)
    learned = structs.replace(learned, diff=diff)
    return (_record_best(request, subject, study, learned, candidate) if is_whole else learned), changes


def _write_changes(subject: _Subject, learned: Learned, candidate: Candidate) -> tuple[FileChange, ...]:
    values = [LearnedValue(of, value) for of, value in zip(learned.parameters, candidate.values, strict=True)]
    evidence = write_evidence(learned, candidate.number, subject.context)
    return change_texts(subject.files, subject.library, values, evidence)


def _record_best(
    request: LearnOrder, subject: _Subject, study: Study, learned: Learned, candidate: Candidate
) -> Learned:
    """Record the run of a candidate with the first seed, unless it is there."""
    folder = request.out / RUNS / f"candidate-{candidate.number}"
    if not (folder / RECORDING).is_file():
        order = structs.replace(_order(request, subject), settings=list_settings(study, candidate))
        record_run(order, folder, request.spec.deadline_s)
    return structs.replace(learned, recordings={**learned.recordings, "learned": str(folder)})


def _order(request: LearnOrder, subject: _Subject) -> RunOrder:
    return RunOrder(
        experiment=subject.experiment,
        scene=str(subject.scene),
        arguments=dict(request.arguments),
        seed=request.spec.seed,
    )


def _apply(request: LearnOrder, learned: Learned, changes: tuple[FileChange, ...], reporter: Reporter) -> Learned:
    """Write the changed texts."""
    if learned.chosen is None:
        raise RequestError("nothing better than the defaults was found: there is nothing to apply")
    if not learned.is_confirmed and request.spec.take is None:
        raise RequestError(
            "fewer fresh trials meet all constraints than with the defaults: it is not applied; "
            f"--take {learned.chosen} applies it nonetheless"
        )
    require_own(changes)
    for each in changes:
        rewrite_file(each.path, each.before, each.after)
        reporter.say(f"wrote {each.shown}")
    return structs.replace(learned, applied=True)


@contextmanager
def _until_interrupted(reporter: Reporter) -> Iterator[list[bool]]:
    """End what runs on Ctrl-C, and report it. ServiceError if the executor cannot run trials."""
    try:
        yield []
    except KeyboardInterrupt:
        reporter.say("interrupted; the same command goes on from here")
    except ExecutorError as error:
        raise ServiceError(f"no more trials can be run: {error}") from error
