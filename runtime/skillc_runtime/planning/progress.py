"""How far a planner is while it searches: for displays only, since it depends on the speed of the machine."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeAlias

import msgspec

REPORT_S = 0.2
"""The time between two reports of a planner, in s of wall time."""


class PlanningProgress(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """A `planner` plans with a number of `individuals`, which are only a part of the scene if they are `narrowed`.

    Of plans with these, it has found one that takes `best_s` (in s; None for none yet) and proved that any takes at
    least `at_least_s`. If it `costs`, these are what plans cost, not seconds. `states` is how many it has evaluated.
    """

    planner: str
    individuals: int = 0
    narrowed: bool = False
    best_s: float | None = None
    at_least_s: float = 0.0
    states: int = 0
    costs: bool = False


ReportProgress: TypeAlias = Callable[[PlanningProgress], None]


def ignore_progress(progress: PlanningProgress) -> None:
    """Do nothing with a report."""


def reporting_costs(report: ReportProgress) -> ReportProgress:
    """Return what passes reports on as those of a search whose durations are costs."""
    return lambda progress: report(msgspec.structs.replace(progress, costs=True))


class Metronome:
    """Says when the next report is due, so that reporting costs nothing."""

    def __init__(self) -> None:
        self._next = time.monotonic() + REPORT_S

    @property
    def is_due(self) -> bool:
        """Whether REPORT_S have passed since this was true last."""
        now = time.monotonic()
        if now < self._next:
            return False
        self._next = now + REPORT_S
        return True


def describe_progress(progress: PlanningProgress) -> str:
    """Describe how far a planner is, in one line."""
    part = "part of the scene, " if progress.narrowed else ""
    known = [f"{part}{progress.individuals} individuals"] if progress.individuals else []
    if progress.states:
        known.append(f"{progress.states} states")
    best, least = progress.best_s, progress.at_least_s
    if best is None:
        known.append("no plan yet")
    else:
        known.append(f"a plan of cost {best:g}" if progress.costs else f"a plan of {best:g} s")
    if least:
        known.append(f"any costs {least:g} or more" if progress.costs else f"any takes at least {least:g} s")
    return f"{progress.planner}: {', '.join(known)}"
