"""Trials: a task is run many times with different seeds, and judged."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from concurrent.futures import Executor
from contextlib import contextmanager, nullcontext
from typing import TYPE_CHECKING, Any, TypedDict, Unpack

from skillc.api.boundary import NoticeList, api_call
from skillc.errors import RequestError
from skillc.services.tasks.listing import require_task
from skillc.services.trials.executors import choose_executor
from skillc.services.trials.running import OpenExecutor, TrialRequest, run_trials, write_page
from skillc.values.arguments import (
    AnyPath,
    optional_path,
    optional_seconds,
    optional_text,
    read_arguments,
    require_choice,
    require_count,
    wrong_type,
)
from skillc.values.trials import Trials
from skillc_runtime.evaluation.trials.trial import TRIAL_LIMIT_S, Trial, TrialDisturbance

if TYPE_CHECKING:
    from collections.abc import Callable


class TrialPlace(TypedDict, total=False):
    """Where trials run: in how many processes here, or on which executor."""

    jobs: int | None
    executor: Executor | None


def trials(
    task: str | None = None,
    number: int = 50,
    *,
    arguments: Mapping[str, Any] | None = None,
    seed: int = 0,
    disturb: TrialDisturbance = "none",
    out: AnyPath | None = None,
    deadline_s: float = TRIAL_LIMIT_S,
    **place: Unpack[TrialPlace],
) -> Trials:
    """Run a task with `number` successive seeds, from `seed` on, each in a process of its own, and judge the runs.

    `jobs` run at the same time, by default one for each core; or the workers of an `executor` run them, such as those
    of `distributed.Client.get_executor()`. They have the skillc that is here, and the executor is not shut down.

    A trial may take `deadline_s` s of wall time. `disturb` is what disturbs each. With `out` they are recorded in that
    folder, and those that are there are not run again. An interrupt from the keyboard ends those that run, and the
    others are judged.

    Errors as of `start`.
    """
    with api_call():
        count = require_count(number, "the number of trials", 1)
        folder = optional_path(out, "`out`")
        request = TrialRequest(
            require_task(optional_text(task, "the task")),
            require_choice(disturb, TrialDisturbance, "`disturb`"),
            range(require_count(seed, "the seed", 0), seed + count),
            _choose_executor(count, **place),
            folder,
            optional_seconds(deadline_s, "`deadline_s`") or TRIAL_LIMIT_S,
            read_arguments(arguments),
        )
        series = run_trials(request, _ignore_progress, NoticeList())
        if folder is not None:
            write_page(series, folder)
        return Trials(series)


def _choose_executor(number: int, jobs: int | None = None, executor: Executor | None = None) -> OpenExecutor:
    if executor is None:
        return choose_executor(None if jobs is None else require_count(jobs, "`jobs`", 1), None, number, NoticeList())
    if jobs is not None:
        raise RequestError("either `jobs` or `executor` says where the trials run, not both")
    if not isinstance(executor, Executor):
        raise wrong_type(executor, "`executor`", "a concurrent.futures.Executor")
    return lambda: nullcontext(executor)


@contextmanager
def _ignore_progress(_task: str, _done: int) -> Iterator[Callable[[Trial], None]]:
    yield lambda trial: None
