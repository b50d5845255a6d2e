"""A time that every plan takes: by the critical path, and by how long single devices must be at work."""

from __future__ import annotations

import time
from collections.abc import Iterator

from skillc_compiler.library.pddl.devices import devices
from skillc_compiler.library.skills import SkillLibrary
from skillc_runtime.planning.plan import Planner, Solved
from skillc_runtime.planning.problem.pose import Posed
from skillc_runtime.planning.schedule import Schedule
from skillc_runtime.planning.search.device_work import price_device_work
from skillc_runtime.planning.search.h_max import critical_path_s

TOLERANCE_S = 1e-9
SHARE = 0.5
"""The critical path gets this share of the time, the devices what is left."""


def at_least_s(posed: Posed, schedule: Schedule, planner: Planner, deadline_s: float) -> float:
    """Return a time in seconds that every plan takes; looking for a better bound ends where a schedule meets it.

    Of a problem that leaves out what may make a difference, or whose durations are not known, nothing is known: 0.
    """
    if posed.narrowed or posed.restricted or posed.assumptions:
        return 0.0
    end, problem = time.monotonic() + deadline_s, posed.problem
    bound = critical_path_s(problem, SHARE * deadline_s)
    names = {iri: name for name, iri in problem.names.items()}
    for device, busy_s in _work_s(schedule, posed.library):
        if busy_s <= bound or schedule.makespan_s <= bound + TOLERANCE_S:
            break  # no device need work longer than it does here
        answer = planner.plan(price_device_work(problem, names[device]), max(end - time.monotonic(), 0.0))
        if isinstance(answer, Solved):
            bound = max(bound, answer.bound_s)
    return bound


def _work_s(schedule: Schedule, library: SkillLibrary) -> Iterator[tuple[str, float]]:
    """Yield the devices (IRIs) that a schedule locks and for how long, the busiest first."""
    locked, found = devices(library), dict[str, float]()
    for each in schedule.steps:
        for name in locked[each.step.skill]:
            if name in each.step.arguments:
                device = each.step.arguments[name]
                found[device] = found.get(device, 0.0) + each.duration_s
    yield from sorted(found.items(), key=lambda each: (-each[1], each[0]))
