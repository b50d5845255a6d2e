"""Learning: parameters of skills from trials of a task."""

from __future__ import annotations

from collections.abc import Mapping
from concurrent.futures import Executor
from contextlib import nullcontext
from pathlib import Path
from typing import Any, Unpack

from skillc.api.boundary import NoticeList, api_call
from skillc.contract.learning import LearnSpec
from skillc.services.learning.coordinator import LearnOrder, watch_nothing
from skillc.services.learning.coordinator import learn as learn_from_trials
from skillc.services.learning.page import write_page
from skillc.services.learning.place import ON_WORKERS, choose_place
from skillc.services.learning.result import Learned as Learned
from skillc.services.tasks.listing import require_task
from skillc.services.trials.running import OpenExecutor
from skillc.values.arguments import AnyPath, optional_path, optional_text, read_arguments, require_count, wrong_type
from skillc.values.keywords import read_keywords
from skillc.values.run_keywords import LearnKeywords


def learn(
    task: str | None = None,
    *,
    arguments: Mapping[str, Any] | None = None,
    out: AnyPath | None = None,
    jobs: int | None = None,
    executor: Executor | None = None,
    **settings: Unpack[LearnKeywords],
) -> Learned:
    """Learn parameters with a range from trials of a task, and return what was found; nothing better is a result, too.

    `minimise` are the objectives, expressions over the figures of trials, `subject_to` what every trial has to meet.
    `candidates` are tried, each in `trials` worlds with the seeds from `seed` on; `jobs` trials run at the same time,
    here or on an `executor`, which is not shut down. The best one is compared with the defaults in `fresh` worlds. With
    `apply`, it is written into the library.

    The study is in the folder `out`, by default `learning/TASK`; the same call goes on with it, also after an interrupt
    from the keyboard, which ends what runs. Errors as of `start`.
    """
    with api_call():
        spec = read_keywords(LearnSpec, settings, LearnKeywords)
        chosen = require_task(optional_text(task, "the task"))
        folder = optional_path(out, "`out`") or Path("learning") / chosen.rpartition(":")[2]
        place = _choose_place(None if jobs is None else require_count(jobs, "`jobs`", 1), executor)
        request = LearnOrder(chosen, spec, folder, *place, read_arguments(arguments))
        learned = learn_from_trials(request, watch_nothing, NoticeList())
        write_page(learned, folder)
        return learned


def _choose_place(jobs: int | None, executor: Executor | None) -> tuple[OpenExecutor, int]:
    if executor is None:
        return choose_place(jobs, None, NoticeList())
    if not isinstance(executor, Executor):
        raise wrong_type(executor, "`executor`", "a concurrent.futures.Executor")
    return (lambda: nullcontext(executor)), jobs or ON_WORKERS
