"""When a candidate is given up, and which one is proposed."""

from __future__ import annotations

import pytest

from learning.runners import aim
from skillc.services.learning.figures import World
from skillc.services.learning.racing import SUCCEEDS, Verdict, estimate, find_front, judge

BOTH, BOUND = aim("time, force_rmse"), aim("time", "coverage == 100 %")


def worlds(*figures: tuple[float, float], coverage: float = 100.0, failures: tuple[str, ...] = ()) -> dict[int, World]:
    """Return trials with a time and a force error each, with seeds from 0 on."""
    return {
        seed: World(
            seed=seed,
            figures={"simulated_time": time, "force_rmse": rmse, "coverage": coverage},
            failures=failures,
        )
        for seed, (time, rmse) in enumerate(figures)
    }


GOOD = worlds((50, 2), (80, 3), (60, 2.5), (55, 2.1))
"""A candidate whose worlds differ more than candidates do."""


@pytest.mark.parametrize(
    ("tried", "verdict"),
    [
        (worlds((50, 2)), None),
        (worlds((51, 2.2), (81, 3.1)), None),  # two trials do not tell
        (worlds((51, 2.2), (81, 3.22), (61.2, 2.71)), "dominated"),  # always worse in the same world
        (worlds((51, 2.2), (81, 3.1), (61.2, 2.2)), None),  # once better
        (worlds((51, 1.9), (81, 2.8), (61.2, 2.4)), None),  # worse in one objective only
        (worlds((51, 2.2), (81, 3.1), (61.2, 2.8), (56, 2.2)), "measured"),
        (worlds((50, 2), failures=("failed: it slips",)), "infeasible"),
    ],
)
def test_a_candidate_is_tried_until_it_is_known(tried: dict[int, World], verdict: Verdict | None) -> None:
    assert judge(BOTH, tried, range(4), [GOOD]) == verdict


def test_a_constraint_that_one_trial_breaks_is_broken() -> None:
    mixed = worlds((50, 2)) | {1: worlds((0, 0), (50, 2), coverage=98.0)[1]}
    assert judge(BOUND, mixed, range(4), []) == "infeasible"
    assert BOUND.violations(mixed.values()) == {SUCCEEDS: 0.0, "coverage == 100 %": pytest.approx(0.02)}


def test_a_trial_without_the_objective_is_no_success() -> None:
    nothing = {0: World(seed=0, figures={})}
    assert BOUND.violations(nothing.values()) == {SUCCEEDS: 1.0, "coverage == 100 %": 1.0}
    assert BOUND.mean(nothing.values()) is None


def test_an_estimate_takes_the_difference_in_the_same_worlds() -> None:
    assert estimate(BOTH, worlds((45, 3)), [GOOD]) == pytest.approx((61.25 - 5.0, 2.4 + 1.0))
    assert estimate(BOTH, worlds((45, 3)), []) == (45.0, 3.0)


def test_the_front_has_what_no_other_one_dominates() -> None:
    assert find_front({0: (3.0, 1.0), 1: (1.0, 3.0), 2: (3.0, 3.0), 3: (1.0, 3.0), 4: (2.0, 2.0)}) == (1, 3, 4, 0)
    assert find_front({}) == ()
