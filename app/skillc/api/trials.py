"""Trials: a task is run many times with different seeds, and judged."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Any

import msgspec

from skillc.api.boundary import (
    AnyPath,
    NoticeList,
    api_call,
    optional_path,
    optional_seconds,
    optional_text,
    read_arguments,
    require_choice,
    require_count,
)
from skillc.api.frames import make_frame, make_table
from skillc.services.task_list import require_task
from skillc.services.trial_runs import TrialRequest, run_trials, write_page
from skillc_runtime.evaluation.trials.series import Series, Spread
from skillc_runtime.evaluation.trials.trial import Disturbance, Trial
from skillc_runtime.evaluation.trials.workers import TRIAL_LIMIT_S

if TYPE_CHECKING:
    from collections.abc import Callable

    import pandas as pd

SPREAD_COLUMNS = ("metric", "subject", "unit", "target", "least", "median", "greatest", "met")


@dataclass(frozen=True, slots=True)
class Trials:
    """The trials of a task, judged; notebooks show the spread of each metric."""

    series: Series

    @property
    def passed(self) -> int:
        """How many trials met all criteria."""
        return self.series.passed

    @property
    def is_good(self) -> bool:
        """Whether all trials passed and all medians meet their targets."""
        return self.series.is_good

    @property
    def trials(self) -> tuple[Trial, ...]:
        """The trials, in the order of their seeds."""
        return self.series.trials

    @property
    def spreads(self) -> tuple[Spread, ...]:
        """The spread of each metric of each thing over the trials."""
        return self.series.spreads

    def to_dict(self) -> dict[str, Any]:
        """Return them as plain data, as `skillc trials --json` prints them."""
        value: dict[str, Any] = msgspec.to_builtins(self.series)
        return value

    def to_frame(self) -> pd.DataFrame:
        """Return a pandas frame with a row for each trial. SkillcError if pandas is not installed."""
        return make_frame([msgspec.structs.asdict(each) for each in self.trials])

    def _repr_html_(self) -> str:
        series = self.series
        rows = [[getattr(each, name) for name in SPREAD_COLUMNS] for each in self.spreads]
        head = f"<p><b>{escape(series.task)}</b>: {series.passed} of {series.wanted} trials passed</p>"
        return f"{head}{make_table(SPREAD_COLUMNS, rows) if rows else ''}"


def trials(
    task: str | None = None,
    number: int = 50,
    *,
    arguments: Mapping[str, Any] | None = None,
    seed: int = 0,
    disturb: Disturbance = "none",
    jobs: int | None = None,
    out: AnyPath | None = None,
    deadline_s: float = TRIAL_LIMIT_S,
) -> Trials:
    """Run a task with `number` successive seeds, from `seed` on, each in a process of its own, and judge the runs.

    `jobs` run at the same time, by default one for each core; one may take `deadline_s` s of wall time. `disturb` is
    what disturbs each. With `out` they are recorded in that folder, and those that are there are not run again. An
    interrupt from the keyboard ends those that run, and the others are judged.

    Errors as of `start`.
    """
    with api_call():
        count = require_count(number, "the number of trials", 1)
        folder = optional_path(out, "`out`")
        request = TrialRequest(
            require_task(optional_text(task, "the task")),
            require_choice(disturb, Disturbance, "`disturb`"),
            range(require_count(seed, "the seed", 0), seed + count),
            min(count, require_count(jobs or os.cpu_count() or 1, "`jobs`", 1)),
            folder,
            optional_seconds(deadline_s, "`deadline_s`") or TRIAL_LIMIT_S,
            read_arguments(arguments),
        )
        series = run_trials(request, _ignore_progress, NoticeList())
        if folder is not None:
            write_page(series, folder)
        return Trials(series)


@contextmanager
def _ignore_progress(_task: str, _done: int) -> Iterator[Callable[[Trial], None]]:
    yield lambda trial: None
