"""Finds some plan quickly: greedy best-first search by the cost of relaxed plans, helpful actions first.

The relaxed plan of a state reaches the goal with deletions ignored; its actions that apply are helpful. States are
evaluated when they are expanded. Hoffmann and Nebel, "The FF planning system", 2001; the supporters are those of h-add,
Bonet and Geffner, "Planning as heuristic search", 2001; Helmert, "The Fast Downward planning system", 2006.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from heapq import heappop, heappush
from itertools import count

from skillc_model.pddl.problem import Problem
from skillc_runtime.cancellation import Cancelled, CancelToken
from skillc_runtime.planning.plan import GaveUp, PlanResult, Solved, Unsolvable
from skillc_runtime.planning.plan_text import cost_plan
from skillc_runtime.planning.progress import ReportProgress, ignore_progress
from skillc_runtime.planning.search.grounding import Grounding
from skillc_runtime.planning.search.h_max import list_cases, list_rules
from skillc_runtime.planning.search.states import SearchTask, make_task, trace_back


class GreedySearch:
    """Greedy best-first search; the first plan that it finds is the answer."""

    name = "greedy search"

    def plan(self, problem: Problem, cancel: CancelToken, report: ReportProgress = ignore_progress) -> PlanResult:
        """Solve a problem before `cancel` ends the search; nothing is proved of the plan."""
        try:
            task = make_task(Grounding(problem, cancel))
            found = None if task is None else _search(task, cancel)
        except Cancelled as why:
            return GaveUp(f"the greedy search gave up: {why}")
        if task is None or found is None:
            return Unsolvable("no sequence of skills reaches the goal")
        answer = cost_plan(problem, (task.actions[index].words for index in found))
        return Solved(answer.plan, "best found", self.name)


def _search(task: SearchTask, cancel: CancelToken) -> tuple[int, ...] | None:
    """Return the operators of a plan, None if there is none. Cancelled."""
    heuristic, order = RelaxedPlans(task), count()
    parents: dict[int, tuple[int, int]] = {}
    known = {task.start}
    helpful = [(0.0, next(order), task.start)]
    others: list[tuple[float, int, int]] = []
    while helpful or others:
        cancel.check()
        if helpful:
            _, _, state = heappop(helpful)
            if task.goal(state):
                return trace_back(state, parents)
            cost, operators = heuristic.evaluate(state)
            if cost == float("inf"):
                continue
            heappush(others, (cost, next(order), state))
        else:
            cost, _, state = heappop(others)
            operators = tuple(range(len(task.operators)))
        for index in operators:
            operator = task.operators[index]
            if not operator.applies(state):
                continue
            after = operator.after(state)
            if after not in known:
                known.add(after)
                parents[after] = state, index
                heappush(helpful, (cost, next(order), after))
    return None


class RelaxedPlans:
    """Relaxed plans for the goal of a task. A literal is twice the number of its atom, plus one if negated."""

    def __init__(self, task: SearchTask) -> None:
        self._cases = list_cases(task.wanted, task.numbers)
        self._rules = list_rules(task.actions, task.numbers)
        self._masks = [_masks(each.conditions) for each in self._rules]
        self._rules_by_condition: dict[int, list[int]] = defaultdict(list)
        for index, rule in enumerate(self._rules):
            for literal in rule.conditions:
                self._rules_by_condition[literal].append(index)

    def evaluate(self, state: int) -> tuple[float, tuple[int, ...]]:
        """Return the cost of a relaxed plan from a state, infinite if there is none, and its actions by index."""
        costs, makers = self._explore(state)
        cases = [[each for each in case if not _is_true(each, state)] for case in self._cases]
        cases = [case for case in cases if all(each in costs for each in case)]
        if not cases:
            return float("inf"), ()
        open_ = min(cases, key=lambda case: sum(costs[each] for each in case))
        rules: set[int] = set()
        seen = set(open_)
        while open_:
            maker = makers.get(open_.pop())
            if maker is None:
                continue
            rules.add(maker)
            new = self._rules[maker].conditions - seen
            seen |= new
            open_ += new
        actions = {self._rules[each].action: self._rules[each].units + 1.0 for each in rules}
        return sum(actions.values()), tuple(sorted(actions))

    def _explore(self, state: int) -> tuple[dict[int, float], dict[int, int]]:
        """Return the h-add of literals that can become true, in units plus 1 an action, and the rule that makes each.

        Those that are true cost nothing and are left out, as are rules that make only these true.
        """
        missing = [(needed & ~state).bit_count() + (denied & state).bit_count() for needed, denied in self._masks]
        sums = [0.0] * len(missing)
        costs, makers = dict[int, float](), dict[int, int]()
        queue: list[tuple[float, int]] = []

        def fire(index: int) -> None:
            rule = self._rules[index]
            cost = rule.units + 1.0 + sums[index]
            for result in rule.results:
                if cost < costs.get(result, float("inf")) and not _is_true(result, state):
                    costs[result], makers[result] = cost, index
                    heappush(queue, (cost, result))

        for index, left in enumerate(missing):
            if not left:
                fire(index)
        done: set[int] = set()
        while queue:
            cost, literal = heappop(queue)
            if literal in done:
                continue
            done.add(literal)
            for index in self._rules_by_condition.get(literal, ()):
                missing[index] -= 1
                sums[index] += cost
                if not missing[index]:
                    fire(index)
        return costs, makers


def _is_true(literal: int, state: int) -> bool:
    return bool(state >> (literal >> 1) & 1) != bool(literal & 1)


def _masks(literals: Iterable[int]) -> tuple[int, int]:
    """Return the atoms that have to be true, and those that have to be false, as bits."""
    needed = denied = 0
    for each in literals:
        if each & 1:
            denied |= 1 << (each >> 1)
        else:
            needed |= 1 << (each >> 1)
    return needed, denied
