"""Writes conditions as few cases: a planner that takes each case as an action of its own sees no case twice.

`not (a and b and c)` for each three of four facts has 3 ** 4 combinations, of which six are enough: two are false.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from math import prod
from typing import TypeAlias

from skillc_model.pddl.formulas import (
    Conjunction,
    Disjunction,
    Existential,
    Formula,
    Universal,
    conjunction,
    conjuncts,
    disjunction,
)

Case: TypeAlias = frozenset[Formula]
"""Literals that all hold in a case."""
MOST_CASES = 64
"""The most combinations of the disjuncts of a condition that are left as they are."""
MOST_FOUND = 1000
"""The most cases that are looked for."""


def count_cases(formula: Formula) -> int:
    """Return how many combinations of disjuncts a formula has."""
    match formula:
        case Conjunction(parts):
            return prod(map(count_cases, parts))
        case Disjunction(parts):
            return sum(map(count_cases, parts))
        case Existential(body=body) | Universal(body=body):
            return count_cases(body)
        case _:
            return 1


def write_few_cases(formula: Formula) -> Formula:
    """Return an equivalent formula whose disjunctions are written out, where they have many cases and few matter."""
    several = [each for each in conjuncts(formula) if isinstance(each, Disjunction)]
    before = prod(map(count_cases, several))
    cases = _find_cases(several) if before > MOST_CASES else None
    if cases is None or len(cases) >= before:
        return formula
    others = (each for each in conjuncts(formula) if not isinstance(each, Disjunction))
    return conjunction((*others, disjunction(conjunction(sorted(each, key=repr)) for each in cases)))


def _find_cases(parts: Iterable[Formula]) -> list[Case] | None:
    """Return the cases in which all parts hold, none of which contains another; None if there are too many."""
    found: list[Case] = [frozenset()]
    for part in parts:
        more = _cases_of(part)
        if more is None or len(found) * len(more) > MOST_FOUND * MOST_CASES:
            return None
        found = _least(one | other for one in found for other in more)
        if len(found) > MOST_FOUND:
            return None
    return found


def _cases_of(formula: Formula) -> list[Case] | None:
    match formula:
        case Conjunction(parts):
            return _find_cases(parts)
        case Disjunction(parts):
            inner = [_cases_of(each) for each in parts]
            return _least(case for each in inner for case in each or ()) if None not in inner else None
        case Existential() | Universal():
            return None
        case _:
            return [frozenset((formula,))]


def _least(cases: Iterable[Case]) -> list[Case]:
    """Return the cases that contain no other one, the shortest ones first."""
    return [*_without_larger(sorted(set(cases), key=lambda each: (len(each), sorted(map(repr, each)))))]


def _without_larger(cases: Iterable[Case]) -> Iterator[Case]:
    kept: list[Case] = []
    for case in cases:
        if not any(other <= case for other in kept):
            kept.append(case)
            yield case
