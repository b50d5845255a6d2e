"""The built-in planner: A* over the ground problem. It solves small scenes optimally and needs no external program."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from heapq import heappop, heappush
from itertools import count
from typing import TypeAlias, assert_never

import msgspec

from skillc_model.pddl.formulas import Atom, Conjunction, Disjunction, Equal, Existential, Formula, Negation, Universal
from skillc_model.pddl.problem import Problem
from skillc_runtime.cancellation import Cancelled, CancelToken
from skillc_runtime.planning.plan import GaveUp, PlanResult, Solved, Unsolvable
from skillc_runtime.planning.plan_text import cost_plan
from skillc_runtime.planning.progress import Metronome, PlanningProgress, ReportProgress, ignore_progress
from skillc_runtime.planning.search.grounding import GroundAction, Grounding
from skillc_runtime.planning.search.h_max import HMax

Test: TypeAlias = Callable[[int], bool]


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
            actions, goal = grounding.actions, grounding.goal()
        except Cancelled as why:
            return self._gave_up(f"{why} before it knew all actions")
        if not grounding.is_possible(goal):
            return Unsolvable("the goal cannot be reached even if nothing were ever undone")
        numbers = {atom: number for number, atom in enumerate(sorted(grounding.reachable, key=_sort_key))}
        task = _Task(
            start=sum(1 << numbers[atom] for atom in grounding.init),
            operators=tuple(_make_operator(action, numbers) for action in actions),
            goal=_compile_test(goal, numbers),
            heuristic=HMax(actions, goal, numbers),
        )
        scale = float(problem.domain.scale)

        def report_search(states: int, bound: float) -> None:
            report(PlanningProgress(planner=self.name, states=states, at_least_s=bound / scale))

        found = _search(task, cancel, report_search)
        if isinstance(found, _Exhausted):
            return Unsolvable("no sequence of skills reaches the goal")
        if isinstance(found, _Stopped):
            return self._gave_up(f"{found.why} after {found.states} states")
        answer = cost_plan(problem, (actions[index].words for index in found))
        if answer.exact:
            return Solved(answer.plan, "proven", self.name)
        return Solved(
            answer.plan, "optimal for approximate durations", self.name, at_least_s=answer.at_least_s(problem)
        )

    def _gave_up(self, why: str) -> GaveUp:
        return GaveUp(f"the built-in planner gave up: {why}{self._advice}")


class _Operator(msgspec.Struct, frozen=True):
    """An action on states, in which bit n is set if atom n is true."""

    applies: Test
    effects: tuple[tuple[Test | None, int, int], ...]
    units: int

    def after(self, state: int) -> int:
        """Return the next state; an atom that is both deleted and added is true."""
        deleted = added = 0
        for condition, adds, deletes in self.effects:
            if condition is None or condition(state):
                added |= adds
                deleted |= deletes
        return state & ~deleted | added


class _Task(msgspec.Struct, frozen=True):
    start: int
    operators: tuple[_Operator, ...]
    goal: Test
    heuristic: HMax


class _Exhausted(msgspec.Struct, frozen=True):
    """All reachable states were expanded without reaching the goal."""


class _Stopped(msgspec.Struct, frozen=True):
    """The search was ended after `states` were expanded."""

    why: str
    states: int


def _search(
    task: _Task, cancel: CancelToken, report: Callable[[int, float], None]
) -> tuple[int, ...] | _Exhausted | _Stopped:
    """Return the operators of a cheapest plan. The heuristic is consistent, so no state is expanded twice.

    `report` is called with the number of expanded states and a lower bound on the cost of any plan.
    """
    tie_breaker, metronome = count(), Metronome()
    costs = {task.start: 0}
    parents: dict[int, tuple[int, int]] = {}
    closed: set[int] = set()
    queue = [(task.heuristic(task.start), next(tie_breaker), task.start)]
    while queue:
        bound, _, state = heappop(queue)
        if state in closed:
            continue
        if task.goal(state):
            return tuple(_trace_back(state, parents))[::-1]
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
            estimate = task.heuristic(after)
            if estimate < float("inf"):
                costs[after], parents[after] = cost, (state, index)
                heappush(queue, (cost + estimate, next(tie_breaker), after))
    return _Exhausted()


def _trace_back(state: int, parents: Mapping[int, tuple[int, int]]) -> Iterator[int]:
    while state in parents:
        state, index = parents[state]
        yield index


def _make_operator(action: GroundAction, numbers: Mapping[Atom, int]) -> _Operator:
    effects = []
    for effect in action.effects:
        if effect.atom in numbers:
            bit = 1 << numbers[effect.atom]
            condition = None if effect.condition == Conjunction(()) else _compile_test(effect.condition, numbers)
            effects.append((condition, bit if effect.positive else 0, 0 if effect.positive else bit))
    return _Operator(_compile_test(action.precondition, numbers), tuple(effects), action.units)


def _compile_test(formula: Formula, numbers: Mapping[Atom, int]) -> Test:
    """Return a ground formula as a test on states; unreachable atoms are false."""
    match formula:
        case Atom():
            bit = 1 << numbers[formula] if formula in numbers else 0
            return lambda state: bool(state & bit)
        case Negation(body):
            inner = _compile_test(body, numbers)
            return lambda state: not inner(state)
        case Conjunction(parts):
            tests = tuple(_compile_test(part, numbers) for part in parts)
            return lambda state: all(test(state) for test in tests)
        case Disjunction(parts):
            tests = tuple(_compile_test(part, numbers) for part in parts)
            return lambda state: any(test(state) for test in tests)
        case Equal() | Existential() | Universal():
            raise AssertionError(f"{formula} is not ground")
        case _:
            assert_never(formula)


def _sort_key(atom: Atom) -> tuple[str, tuple[str, ...]]:
    return atom.predicate, atom.terms
