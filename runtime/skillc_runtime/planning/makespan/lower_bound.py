"""A lower bound of the makespan of all plans: the critical path, and how long each device must work."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction

from msgspec import structs

from skillc_model.pddl.devices import locked_parameters
from skillc_model.pddl.domain import Action, FixedCost
from skillc_model.pddl.formulas import Equal, Negation, conjunction
from skillc_model.pddl.names import make_unique
from skillc_model.pddl.problem import Problem
from skillc_model.skills import SkillLibrary
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.plan import Planner, Solved
from skillc_runtime.planning.problem.pose import PosedProblem
from skillc_runtime.planning.schedule import Schedule
from skillc_runtime.planning.search.h_max import critical_path_s

TOLERANCE_S = 1e-9
CRITICAL_PATH_SHARE = 0.5
"""The share of the time for the critical path; the rest is for the devices."""


def makespan_lower_bound_s(posed: PosedProblem, schedule: Schedule, planner: Planner, cancel: CancelToken) -> float:
    """Return a time in s that every plan takes at least; the search for a better bound stops if `schedule` meets it.

    0 for a problem that leaves out something that may matter, or whose durations are estimates.
    """
    if is_bound_unknown(posed):
        return 0.0
    problem = posed.problem
    bound = critical_path_s(problem, cancel.share(CRITICAL_PATH_SHARE))
    names = {iri: name for name, iri in problem.names.items()}
    for device, busy_s in _work_by_device_s(schedule, posed.library):
        if busy_s <= bound or schedule.makespan_s <= bound + TOLERANCE_S:
            break  # no device has to work longer than it does in this schedule
        answer = planner.plan(price_device_work(problem, names[device]), cancel)
        if isinstance(answer, Solved):
            bound = max(bound, answer.bound_s)
    return bound


def is_bound_unknown(posed: PosedProblem) -> bool:
    """Whether a bound for a problem is none for all plans: something may be missing, or durations are estimates."""
    return bool(posed.narrowed or posed.restricted or posed.assumptions)


def _work_by_device_s(schedule: Schedule, library: SkillLibrary) -> Iterator[tuple[str, float]]:
    """Yield the devices (IRIs) that a schedule locks with the time in s, the busiest first."""
    locked, found = locked_parameters(library), dict[str, float]()
    for each in schedule.steps:
        for name in locked[each.step.skill]:
            if name in each.step.arguments:
                device = each.step.arguments[name]
                found[device] = found.get(device, 0.0) + each.duration_s
    yield from sorted(found.items(), key=lambda each: (-each[1], each[0]))


def price_device_work(problem: Problem, device: str) -> Problem:
    """Return the problem in which only actions that lock the device (the name of an object) have a cost.

    No two of them run in parallel, so the cost of its cheapest plan is a lower bound on the makespan of any plan.
    """
    taken = {*problem.domain.names, *problem.domain.action, *problem.domain.predicate}
    actions = tuple(each for action in problem.domain.actions for each in _split_by_device(action, device, taken))
    return structs.replace(problem, domain=replace(problem.domain, actions=actions, constants=problem.objects))


def _split_by_device(action: Action, device: str, taken: set[str]) -> Iterator[Action]:
    """Yield the action for other devices without cost, and for each device parameter the action with this device."""
    others = (Negation(Equal(each, device)) for each in action.uses)
    yield structs.replace(action, precondition=conjunction((action.precondition, *others)), cost=FixedCost(Fraction(0)))
    for each in action.uses:
        here = conjunction((action.precondition, Equal(each, device)))
        name = make_unique(f"{action.name}-busy", taken)
        taken.add(name)
        yield structs.replace(action, name=name, precondition=here)
