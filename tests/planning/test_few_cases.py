"""Conditions as few cases mean what they meant."""

from __future__ import annotations

from itertools import combinations, product
from random import Random

import pytest

from skillc_model.pddl.formulas import Atom, Conjunction, Disjunction, Formula, Negation, conjunction, disjunction
from skillc_model.pddl.preparing.cases import count_cases, write_few_cases

FACTS = [Atom("held", (name,)) for name in "abcdef"]


def is_true(formula: Formula, true: set[Atom]) -> bool:
    match formula:
        case Atom():
            return formula in true
        case Negation(body):
            return not is_true(body, true)
        case Conjunction(parts):
            return all(is_true(part, true) for part in parts)
        case Disjunction(parts):
            return any(is_true(part, true) for part in parts)
    raise AssertionError(formula)


def draw(random: Random, depth: int) -> Formula:
    if depth == 0:
        fact = random.choice(FACTS)
        return random.choice((fact, Negation(fact)))
    parts = [draw(random, depth - 1) for _ in range(random.randint(2, 4))]
    return random.choice((conjunction, disjunction))(parts)


def assert_same(one: Formula, other: Formula) -> None:
    for chosen in product((False, True), repeat=len(FACTS)):
        true = {fact for fact, holds in zip(FACTS, chosen, strict=True) if holds}
        assert is_true(one, true) == is_true(other, true), true


def test_fewer_than_three_of_six_is_that_four_are_false() -> None:
    denied = (disjunction(map(Negation, some)) for some in combinations(FACTS, 3))
    fewer = conjunction(denied)
    few = write_few_cases(fewer)
    assert (count_cases(fewer), count_cases(few)) == (3**20, 15)
    assert_same(fewer, few)


@pytest.mark.parametrize("seed", range(12))
def test_few_cases_mean_the_same(seed: int) -> None:
    formula = conjunction(draw(Random(seed * 10 + part), 3) for part in range(3))
    few = write_few_cases(formula)
    assert count_cases(few) <= count_cases(formula)
    assert_same(formula, few)
