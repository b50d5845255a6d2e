"""Running many trials for the command line: progress on stderr, what is done kept, everything ended on Ctrl-C."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import TracebackType

import click
import msgspec
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from skillc_compiler.library import codec
from skillc_compiler.library.skills import SkillLibrary
from skillc_runtime.commands import _mission
from skillc_runtime.commands._console import console
from skillc_runtime.evaluation.trials import identity, page
from skillc_runtime.evaluation.trials.experiment import Experiment, TrialRunner
from skillc_runtime.evaluation.trials.journal import Heading, Journal, JournalError, missing
from skillc_runtime.evaluation.trials.series import Series, judge_series
from skillc_runtime.evaluation.trials.trial import Disturbance, Trial
from skillc_runtime.evaluation.trials.verdict import find_misses
from skillc_runtime.evaluation.trials.workers import run_all

PAGE = "trials.html"


@dataclass(frozen=True, slots=True)
class Wanted:
    """Which trials are wanted: of which task, disturbed by what, with which seeds, so many at a time, kept where."""

    reference: str
    disturbance: Disturbance
    seeds: Sequence[int]
    jobs: int
    out: Path | None
    quiet: bool


def tried(wanted: Wanted) -> Series:
    """Run the trials that are wanted and not kept already; return all of them, judged.

    Exits with what is wrong with the library, the scene or the folder.
    """
    library, task, scene = _mission.in_scene(wanted.reference)
    _mission.loaded(scene, library)
    experiment = Experiment(codec.dumps(library), task.name, scene, wanted.disturbance)
    trials = _all(wanted, experiment, _heading(experiment, library))
    return judge_series(task.name, wanted.disturbance, len(wanted.seeds), trials)


def write_page(result: Series, out: Path) -> None:
    """Write the page of a series into its folder; exit with code 1 where that cannot be done."""
    with _writing(out):
        (out / PAGE).write_text(page.render(result), encoding="utf-8")


def as_json(result: Series) -> str:
    """Return a series as one JSON object."""
    return msgspec.json.format(msgspec.json.encode(result), indent=2).decode()


def _all(wanted: Wanted, experiment: Experiment, heading: Heading) -> tuple[Trial, ...]:
    with ExitStack() as stack:
        journal = None if wanted.out is None else stack.enter_context(_journal(wanted.out, heading))
        kept = () if journal is None else journal.trials
        done = {trial.seed: trial for trial in kept if trial.seed in wanted.seeds}
        told = stack.enter_context(Told(experiment.task, wanted, len(done)))
        left = missing(wanted.seeds, kept)
        for trial in _until_interrupted(run_all(partial(TrialRunner, experiment), left, wanted.jobs)):
            done[trial.seed] = trial
            if journal is not None:
                journal.add(trial)
            told(trial)
    return tuple(done.values())


def _heading(experiment: Experiment, library: SkillLibrary) -> Heading:
    return Heading(
        task=experiment.task,
        disturbance=experiment.disturbance,
        skillc=identity.skillc_identity(),
        library=f"{library.name} of {library.hash[: identity.DIGITS]}",
        scene=identity.file_identity(experiment.scene),
    )


def _until_interrupted(trials: Iterator[Trial]) -> Iterator[Trial]:
    """Yield trials; on Ctrl-C end what runs and say so."""
    try:
        yield from trials
    except KeyboardInterrupt:
        click.echo("interrupted; what is kept with --out is not run again by the same command", err=True)


class Told:
    """Tells of each trial that is done: a bar on a terminal, a line elsewhere, nothing when it shall be quiet."""

    def __init__(self, task: str, wanted: Wanted, done: int) -> None:
        self._console = console(stderr=True, quiet=wanted.quiet)
        self._disturbance, self._count, self._done = wanted.disturbance, len(wanted.seeds), done
        columns = (
            TextColumn("{task.description}", markup=False),
            BarColumn(),
            MofNCompleteColumn(),
            TimeRemainingColumn(),
        )
        self._bar = Progress(*columns, console=self._console, disable=wanted.quiet or not sys.stderr.isatty())
        self._row = self._bar.add_task(task, total=self._count, completed=done)

    def __enter__(self) -> Told:
        self._bar.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._bar.stop()

    def __call__(self, trial: Trial) -> None:
        """Tell of a trial; on a terminal the good ones only move the bar."""
        self._done += 1
        self._bar.advance(self._row)
        why = find_misses(trial, self._disturbance)
        if why or self._bar.disable:
            line = f"seed {trial.seed}: {'; '.join(why) or 'as it should be'} ({self._done} of {self._count})"
            self._console.print(line, soft_wrap=True)


@contextmanager
def _journal(out: Path, heading: Heading) -> Iterator[Journal]:
    with _writing(out):
        try:
            journal = Journal(out, heading)
        except JournalError as error:
            click.echo(f"error: {error}", err=True)
            sys.exit(1)
        with journal:
            yield journal


@contextmanager
def _writing(directory: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        click.echo(f"error: cannot write to {directory}: {error.strerror or error}", err=True)
        sys.exit(1)
