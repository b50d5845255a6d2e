"""The planners and the scheduler that solve problems."""

from __future__ import annotations

import msgspec

from skillc_runtime.planning.plan import Planner
from skillc_runtime.planning.schedule import Scheduler

DEADLINE_S = 30.0
"""How long planners search unless something else is asked for, in s of wall time."""


class Planners(msgspec.Struct, frozen=True):
    """The planners that minimise work, the strongest first, and the scheduler that minimises the makespan, if any."""

    for_work: tuple[Planner, ...]
    for_makespan: Scheduler | None
