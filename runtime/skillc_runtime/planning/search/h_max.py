"""The admissible estimate h-max: how dear the dearest part of the goal is when nothing once true is ever lost.

h(state) = max over parts p of the goal of cost(p);  cost(p) = 0 if p holds, else min over what makes p true of its own
cost + max over its conditions of their costs.  Bonet and Geffner, "Planning as heuristic search", 2001.
"""

from __future__ import annotations

import time
from collections import defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from heapq import heappop, heappush
from itertools import product

from skillc_model.pddl.formulas import Atom, Conjunction, Disjunction, Formula, Negation
from skillc_model.pddl.problem import Problem
from skillc_runtime.planning.search.grounding import GroundAction, Grounding, GroundingTimeout

MAX_CASES = 64
Literals = frozenset[int]


@dataclass(frozen=True, slots=True)
class RelaxedRule:
    """When all conditions hold, the results do too, at a cost."""

    conditions: Literals
    results: tuple[int, ...]
    units: int


class HMax:
    """h-max for one goal. A literal is twice its atom's number, plus one when negated."""

    def __init__(self, actions: Iterable[GroundAction], goal: Formula, numbers: Mapping[Atom, int]) -> None:
        self._atoms = len(numbers)
        self._goal_cases = list_cases(goal, numbers)
        self._rules = [rule for action in actions for rule in _rules(action, numbers)]
        self._waiting: dict[int, list[int]] = defaultdict(list)
        for index, rule in enumerate(self._rules):
            for literal in rule.conditions:
                self._waiting[literal].append(index)
        self._free = [index for index, rule in enumerate(self._rules) if not rule.conditions]

    def __call__(self, state: int) -> float:
        """Return a lower bound on the cost from a state (bit n: atom n) to the goal, infinity if unreachable."""
        costs = self._costs(state)
        return min(
            (max((costs[each] for each in case), default=0.0) for case in self._goal_cases), default=float("inf")
        )

    def _costs(self, state: int) -> list[float]:
        costs = [float("inf")] * (2 * self._atoms)
        missing = [len(rule.conditions) for rule in self._rules]
        queue: list[tuple[float, int]] = []
        for atom in range(self._atoms):
            literal = 2 * atom + (not state >> atom & 1)
            costs[literal] = 0.0
            queue.append((0.0, literal))
        for index in self._free:
            self._fire(self._rules[index], 0.0, costs, queue)
        while queue:
            cost, literal = heappop(queue)
            if cost > costs[literal]:
                continue
            for index in self._waiting.get(literal, ()):
                missing[index] -= 1
                if not missing[index]:
                    self._fire(self._rules[index], cost, costs, queue)
        return costs

    def _fire(self, rule: RelaxedRule, start: float, costs: list[float], queue: list[tuple[float, int]]) -> None:
        cost = start + rule.units
        for result in rule.results:
            if cost < costs[result]:
                costs[result] = cost
                heappush(queue, (cost, result))


def list_cases(formula: Formula, numbers: Mapping[Atom, int]) -> tuple[Literals, ...]:
    """Return sets of literals of which one is contained in any state where the formula holds; () if it never can."""
    match formula:
        case Atom():
            return (frozenset({2 * numbers[formula]}),) if formula in numbers else ()
        case Negation(body):
            return (
                (frozenset({2 * numbers[body] + 1}),) if isinstance(body, Atom) and body in numbers else (frozenset(),)
            )
        case Disjunction(parts):
            found = tuple(dict.fromkeys(case for part in parts for case in list_cases(part, numbers)))
            return found if len(found) <= MAX_CASES else (frozenset(),)
        case Conjunction(parts):
            sets = [list_cases(part, numbers) for part in parts]
            while _count(sets) > MAX_CASES:
                sets.remove(max(sets, key=len))
            return tuple(frozenset().union(*combination) for combination in product(*sets))
        case _:
            raise AssertionError(f"{formula} is not ground")


def _count(sets: list[tuple[Literals, ...]]) -> int:
    count = 1
    for each in sets:
        count *= len(each)
    return count


def _rules(action: GroundAction, numbers: Mapping[Atom, int]) -> Iterable[RelaxedRule]:
    by_condition: dict[Formula, list[int]] = defaultdict(list)
    for effect in action.effects:
        if effect.atom in numbers:
            by_condition[effect.condition].append(2 * numbers[effect.atom] + (not effect.positive))
    for condition, results in by_condition.items():
        for conditions in list_cases(Conjunction((action.precondition, condition)), numbers):
            yield RelaxedRule(conditions, tuple(results), action.units)


def critical_path_s(problem: Problem, deadline_s: float) -> float:
    """Return a time in seconds that every plan takes: infinity where there is none, 0 where looking takes too long.

    An atom can be true when the longest of the conditions of an action has become so, and the action is over: the
    estimate h-max with durations for costs. Haslum and Geffner, "Heuristic planning with time and resources", 2001.
    """
    grounding = Grounding(problem, time.monotonic() + deadline_s)
    try:
        actions, goal = grounding.actions, grounding.goal()
    except GroundingTimeout:
        return 0.0
    atoms = sorted(grounding.reachable, key=lambda each: (each.predicate, each.terms))
    numbers = {atom: number for number, atom in enumerate(atoms)}
    start = sum(1 << numbers[atom] for atom in grounding.init)
    return HMax(actions, goal, numbers)(start) / float(problem.domain.scale)
