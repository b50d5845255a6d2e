"""All kinds of work that a report knows, and what each measures; `work_figures.py` has their figures.

A kind is recognised by what was done in a run: activities of primitives, samples of devices, ground truth. A new kind
is a module that finds and measures it, an entry in `KINDS`, a module with its figure, and an entry in `FIGURES` there.
The two lists are apart because a run without a report draws nothing, and what draws takes long to import.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeAlias

from skillc_runtime.evaluation.report.drives import measure_drives
from skillc_runtime.evaluation.report.grasps import measure_grasp
from skillc_runtime.evaluation.report.guidances import find_free_periods, measure_guidance
from skillc_runtime.evaluation.report.pushes import PushRecord, find_pushes, measure_push
from skillc_runtime.evaluation.report.run_record import RunRecord
from skillc_runtime.evaluation.report.searches import find_searches, measure_search
from skillc_runtime.evaluation.report.work_result import WorkResult

WorkKind: TypeAlias = Callable[[RunRecord], Iterator[WorkResult]]
"""A kind of work: yields the numbers of each piece of it in a run."""


def measure_work(record: RunRecord) -> tuple[WorkResult, ...]:
    """Return the numbers of all work in a run."""
    return tuple(result for measure in KINDS for result in measure(record))


def find_other_pushes(record: RunRecord) -> Iterator[PushRecord]:
    """Yield the pushes besides those on surfaces that were wiped, whose numbers say more."""
    wiped = {each.surface for each in record.wipings}
    yield from (push for push in find_pushes(record) if not wiped.intersection(push.on))


KINDS: tuple[WorkKind, ...] = (
    lambda record: (measure_push(each, record) for each in find_other_pushes(record)),
    lambda record: (measure_search(each, record) for each in find_searches(record)),
    lambda record: (measure_guidance(each, record) for each in find_free_periods(record)),
    lambda record: (measure_grasp(each, record) for each in record.handlings),
    measure_drives,
)
"""What measures each kind of work, in the order of the report; `TaskResult.wipings` has the numbers of wiping."""
