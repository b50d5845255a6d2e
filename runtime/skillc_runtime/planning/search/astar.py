"""The built-in planner: A* over the ground problem. It solves small scenes optimally and needs no external program."""

from __future__ import annotations

from collections.abc import Callable
from heapq import heappop, heappush
from itertools import count

import msgspec

from skillc_model.pddl.problem import Problem
from skillc_runtime.cancellation import Cancelled, CancelToken
from skillc_runtime.planning.plan import GaveUp, PlanResult, Solved, Unsolvable
from skillc_runtime.planning.plan_text import cost_plan
from skillc_runtime.planning.progress import Metronome, PlanningProgress, ReportProgress, ignore_progress
from skillc_runtime.planning.search.grounding import Grounding
from skillc_runtime.planning.search.h_max import HMax
from skillc_runtime.planning.search.states import SearchTask, make_task, trace_back
from skillc_runtime.planning.search.symmetry import Symmetry, find_symmetry


class AStar:
    """A* with the admissible heuristic h-max."""

    name = "built-in A*"

    def __init__(self, advice: str = "") -> None:
        """`advice` is appended to the reason when the planner gives up."""
        self._advice = f"; {advice}" if advice else ""

    def plan(self, problem: Problem, cancel: CancelToken, report: ReportProgress = ignore_progress) -> PlanResult:
        """Solve a problem before `cancel` ends the search; the plan is proven to be the shortest."""
        grounding = Grounding(problem, cancel)
        try:
            task = make_task(grounding)
        except Cancelled as why:
            return self._gave_up(f"{why} before it knew all actions")
        if task is None:
            return Unsolvable("the goal cannot be reached even if nothing were ever undone")
        scale = float(problem.domain.scale)

        def report_search(states: int, bound: float) -> None:
            report(PlanningProgress(planner=self.name, states=states, at_least_s=bound / scale))

        found = _search(task, find_symmetry(problem, task.numbers), cancel, report_search)
        if isinstance(found, _Exhausted):
            return Unsolvable("no sequence of skills reaches the goal")
        if isinstance(found, _Stopped):
            return self._gave_up(f"{found.why} after {found.states} states")
        answer = cost_plan(problem, (task.actions[index].words for index in found))
        if answer.exact:
            return Solved(answer.plan, "proven", self.name)
        return Solved(
            answer.plan, "optimal for approximate durations", self.name, at_least_s=answer.at_least_s(problem)
        )

    def _gave_up(self, why: str) -> GaveUp:
        return GaveUp(f"the built-in planner gave up: {why}{self._advice}")


class _Exhausted(msgspec.Struct, frozen=True):
    """All reachable states were expanded without reaching the goal."""


class _Stopped(msgspec.Struct, frozen=True):
    """The search was ended after `states` were expanded."""

    why: str
    states: int


def _search(
    task: SearchTask, symmetry: Symmetry | None, cancel: CancelToken, report: Callable[[int, float], None]
) -> tuple[int, ...] | _Exhausted | _Stopped:
    """Return the operators of a cheapest plan. The heuristic is consistent, so no state is expanded twice.

    Of states that differ only in which of interchangeable objects is which, the first that is expanded stands for all.
    `report` is called with the number of expanded states and a lower bound on the cost of any plan.
    """
    heuristic = HMax(task.actions, task.wanted, task.numbers)
    tie_breaker, metronome = count(), Metronome()
    canonical = symmetry.canonical if symmetry is not None else _itself
    first = canonical(task.start)
    costs = {first: 0}
    parents: dict[int, tuple[int, int]] = {}
    closed: set[int] = set()
    queue = [(heuristic(task.start), next(tie_breaker), task.start, first)]
    while queue:
        bound, _, state, key = heappop(queue)
        if key in closed:
            continue
        if task.goal(state):
            return trace_back(state, parents)
        if (why := cancel.reason) is not None:
            return _Stopped(why, len(closed))
        closed.add(key)
        if metronome.is_due:
            report(len(closed), bound)
        for index, operator in enumerate(task.operators):
            if not operator.applies(state):
                continue
            after, cost = operator.after(state), costs[key] + operator.units
            other = canonical(after)
            if other in closed or cost >= costs.get(other, cost + 1):
                continue
            estimate = heuristic(after)
            if estimate < float("inf"):
                costs[other], parents[after] = cost, (state, index)
                heappush(queue, (cost + estimate, next(tie_breaker), after, other))
    return _Exhausted()


def _itself(state: int) -> int:
    return state
