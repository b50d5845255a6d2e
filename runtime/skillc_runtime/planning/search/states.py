"""Searches states: numbers in which bit n is set if atom n is true, and ground actions as operators on them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import TypeAlias, assert_never

import msgspec

from skillc_model.pddl.formulas import Atom, Conjunction, Disjunction, Equal, Existential, Formula, Negation, Universal
from skillc_runtime.planning.search.ground_actions import GroundAction
from skillc_runtime.planning.search.grounding import Grounding

Test: TypeAlias = Callable[[int], bool]


class Operator(msgspec.Struct, frozen=True):
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


class SearchTask(msgspec.Struct, frozen=True):
    """The ground actions of a problem, the number of each atom, the first state, the operators and the goal."""

    actions: tuple[GroundAction, ...]
    numbers: Mapping[Atom, int]
    start: int
    operators: tuple[Operator, ...]
    wanted: Formula
    goal: Test


def make_task(grounding: Grounding) -> SearchTask | None:
    """Return what is to be searched; None if the goal cannot be reached even if nothing were ever undone. Cancelled."""
    actions, goal = grounding.actions, grounding.goal()
    if not grounding.is_possible(goal):
        return None
    numbers = {atom: number for number, atom in enumerate(sorted(grounding.reachable, key=_sort_key))}
    return SearchTask(
        actions=actions,
        numbers=numbers,
        start=sum(1 << numbers[atom] for atom in grounding.init),
        operators=tuple(_make_operator(action, numbers) for action in actions),
        wanted=goal,
        goal=_compile_test(goal, numbers),
    )


def trace_back(state: int, parents: Mapping[int, tuple[int, int]]) -> tuple[int, ...]:
    """Return the operators that lead to a state, by index; `parents` are the state before it and the operator."""
    return tuple(_trace(state, parents))[::-1]


def _trace(state: int, parents: Mapping[int, tuple[int, int]]) -> Iterator[int]:
    while state in parents:
        state, index = parents[state]
        yield index


def _make_operator(action: GroundAction, numbers: Mapping[Atom, int]) -> Operator:
    effects = []
    for effect in action.effects:
        if effect.atom in numbers:
            bit = 1 << numbers[effect.atom]
            condition = None if effect.condition == Conjunction(()) else _compile_test(effect.condition, numbers)
            effects.append((condition, bit if effect.positive else 0, 0 if effect.positive else bit))
    return Operator(_compile_test(action.precondition, numbers), tuple(effects), action.units)


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
            return _compile_conjunction(parts, numbers)
        case Disjunction(parts):
            tests = tuple(_compile_test(part, numbers) for part in parts)
            return lambda state: any(test(state) for test in tests)
        case Equal() | Existential() | Universal():
            raise AssertionError(f"{formula} is not ground")
        case _:
            assert_never(formula)


def _compile_conjunction(parts: Iterable[Formula], numbers: Mapping[Atom, int]) -> Test:
    """Return a conjunction as a test that compares all atoms in it at once."""
    needed = denied = 0
    tests: list[Test] = []
    for part in parts:
        match part:
            case Atom() if part in numbers:
                needed |= 1 << numbers[part]
            case Negation(Atom() as atom):
                denied |= 1 << numbers[atom] if atom in numbers else 0
            case _:
                tests.append(_compile_test(part, numbers))
    if not tests:
        return lambda state: state & needed == needed and not state & denied
    return lambda state: state & needed == needed and not state & denied and all(test(state) for test in tests)


def _sort_key(atom: Atom) -> tuple[str, tuple[str, ...]]:
    return atom.predicate, atom.terms
