"""Activities of a schedule: when none is needed twice, and which facts are one timeline."""

from __future__ import annotations

from fractions import Fraction

import pytest

from skillc_model.pddl.formulas import Atom
from skillc_runtime.planning.cp_sat.activities import Activities, find_groups
from skillc_runtime.planning.cp_sat.task import Activity, AllOf, AnyOf
from skillc_runtime.planning.plan import Step

CUT = Activity(3, AllOf(()), (1,), ())
DRILL = Activity(2, 1, (2,), ())
"""Drilling needs what is cut: fact 1; it makes fact 2."""


def activities(*all_: Activity, true: tuple[int, ...] = ()) -> Activities:
    return Activities(all_, tuple(Step(f"S{number}", {}) for number in range(len(all_))), true, 2, (), Fraction(1))


@pytest.mark.parametrize(
    ("others", "true", "once"),
    [
        ((), (), True),
        ((Activity(1, AnyOf((-3, 1)), (3,), ()),), (), True),  # only what does it needs that it is not done yet
        ((Activity(1, AllOf(()), (-1,), ()),), (), False),  # somebody takes away what drilling needs
        ((Activity(1, -3, (4,), ()), Activity(1, AllOf(()), (3,), ())), (), False),
        ((Activity(1, AllOf(()), (1, 3), ()),), (), False),  # it makes fact 1 again, and need not wait for drilling
        ((Activity(1, AllOf(()), (5,), ()), Activity(1, AllOf(()), (5, 6), ())), (), True),  # nobody needs 5
        ((), (1,), False),
    ],
)
def test_no_activity_is_needed_twice_where_nothing_is_undone(
    others: tuple[Activity, ...], true: tuple[int, ...], once: bool
) -> None:
    assert activities(CUT, DRILL, *others, true=true).at_most_once is once


def at(robot: str, place: str) -> Atom:
    return Atom("at", (robot, place))


FACTS = {at("carl", "a"): 1, at("carl", "b"): 2, at("dora", "a"): 3, at("dora", "b"): 4}
GO, BACK = Activity(5, 1, (-1, 2), (0,)), Activity(5, AllOf((2, -4)), (-2, 1), (0,))


def test_the_places_of_a_robot_are_one_timeline() -> None:
    assert find_groups(FACTS, (GO, BACK), (1,)) == ((1, 2),), "of dora nothing is known to hold"
    assert find_groups(FACTS, (GO, BACK), (1, 2)) == (), "carl is at two places"
    assert find_groups(FACTS, (GO, BACK, Activity(1, 1, (-1,), ())), (1,)) == (), "he may be nowhere"
    assert find_groups(FACTS, (GO, BACK, Activity(1, AllOf(()), (-1, 2), ())), (1,)) == (), "he may have been elsewhere"
