"""The admissible heuristic h-max: the cost of the most expensive part of the goal, with deletions ignored.

h(state) = max over parts p of the goal of cost(p);  cost(p) = 0 if p holds, else the minimum over the actions that make
p true of the action's cost + the maximum cost of its conditions.  Bonet and Geffner, "Planning as heuristic search",
2001.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping
from heapq import heappop, heappush
from itertools import product

import msgspec

from skillc_model.pddl.formulas import Atom, Conjunction, Disjunction, Formula, Negation
from skillc_model.pddl.problem import Problem
from skillc_runtime.cancellation import Cancelled, CancelToken
from skillc_runtime.planning.search.ground_actions import GroundAction
from skillc_runtime.planning.search.grounding import Grounding

MAX_CASES = 64
Literals = frozenset[int]


class RelaxedRule(msgspec.Struct, frozen=True):
    """If all conditions hold, an action, by its index, can make the results true at a cost in units."""

    conditions: Literals
    results: tuple[int, ...]
    units: int
    action: int


class HMax:
    """h-max for one goal. A literal is twice the number of its atom, plus one if negated."""

    def __init__(self, actions: Iterable[GroundAction], goal: Formula, numbers: Mapping[Atom, int]) -> None:
        self._atoms = len(numbers)
        self._goal_cases = list_cases(goal, numbers)
        self._rules = list_rules(actions, numbers)
        self._rules_by_condition: dict[int, list[int]] = defaultdict(list)
        for index, rule in enumerate(self._rules):
            for literal in rule.conditions:
                self._rules_by_condition[literal].append(index)
        self._free = [index for index, rule in enumerate(self._rules) if not rule.conditions]

    def __call__(self, state: int) -> float:
        """Return a lower bound in units on the cost from a state (bit n: atom n) to the goal, maybe infinity."""
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
            for index in self._rules_by_condition.get(literal, ()):
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
    """Return sets of literals, one of which holds in every state where the formula holds; () if it never can."""
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
            while _product_size(sets) > MAX_CASES:
                sets.remove(max(sets, key=len))
            return tuple(frozenset().union(*combination) for combination in product(*sets))
        case _:
            raise AssertionError(f"{formula} is not ground")


def _product_size(sets: list[tuple[Literals, ...]]) -> int:
    count = 1
    for each in sets:
        count *= len(each)
    return count


def list_rules(actions: Iterable[GroundAction], numbers: Mapping[Atom, int]) -> list[RelaxedRule]:
    """Return what actions can make true, and false, in states whose atoms have these numbers."""
    found: list[RelaxedRule] = []
    for index, action in enumerate(actions):
        by_condition: dict[Formula, list[int]] = defaultdict(list)
        for effect in action.effects:
            if effect.atom in numbers:
                by_condition[effect.condition].append(2 * numbers[effect.atom] + (not effect.positive))
        for condition, results in by_condition.items():
            cases = list_cases(Conjunction((action.precondition, condition)), numbers)
            found += (RelaxedRule(each, tuple(results), action.units, index) for each in cases)
    return found


def critical_path_s(problem: Problem, cancel: CancelToken) -> float:
    """Return a lower bound in s on the makespan of any plan: infinity if there is none, 0 if it was cancelled.

    This is h-max with durations as costs: an atom can be true when the last condition of an action has become true and
    the action has ended. Haslum and Geffner, "Heuristic planning with time and resources", 2001.
    """
    grounding = Grounding(problem, cancel)
    try:
        actions, goal = grounding.actions, grounding.goal()
    except Cancelled:
        return 0.0
    atoms = sorted(grounding.reachable, key=lambda each: (each.predicate, each.terms))
    numbers = {atom: number for number, atom in enumerate(atoms)}
    start = sum(1 << numbers[atom] for atom in grounding.init)
    return HMax(actions, goal, numbers)(start) / float(problem.domain.scale)
