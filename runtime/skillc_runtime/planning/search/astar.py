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

        found = _search(task, cancel, report_search)
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
    task: SearchTask, cancel: CancelToken, report: Callable[[int, float], None]
) -> tuple[int, ...] | _Exhausted | _Stopped:
    """Return the operators of a cheapest plan. The heuristic is consistent, so no state is expanded twice.

    `report` is called with the number of expanded states and a lower bound on the cost of any plan.
    """
    heuristic = HMax(task.actions, task.wanted, task.numbers)
    tie_breaker, metronome = count(), Metronome()
    costs = {task.start: 0}
    parents: dict[int, tuple[int, int]] = {}
    closed: set[int] = set()
    queue = [(heuristic(task.start), next(tie_breaker), task.start)]
    while queue:
        bound, _, state = heappop(queue)
        if state in closed:
            continue
        if task.goal(state):
            return trace_back(state, parents)
        if (why := cancel.reason) is not None:
            return _Stopped(why, len(closed))
        closed.add(state)
        if metronome.is_due:
            report(len(closed), bound)
        for index, operator in enumerate(task.operators):
            if not operator.applies(state):
                continue
            after, cost = operator.after(state), costs[state] + operator.units
            if after in closed or cost >= costs.get(after, cost + 1):
                continue
            estimate = heuristic(after)
            if estimate < float("inf"):
                costs[after], parents[after] = cost, (state, index)
                heappush(queue, (cost + estimate, next(tie_breaker), after))
    return _Exhausted()
