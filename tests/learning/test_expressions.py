"""Objectives and constraints as they are written: arithmetic over figures, with their units."""

from __future__ import annotations

import pytest

from skillc.errors import RequestError
from skillc.services.learning.expressions import check_expressions, read_expressions
from skillc.services.learning.figures import Figures, measured_figures, read_world
from trials.runners import GOOD, good, wiping

TASK = Figures(
    {
        "coverage": frozenset({"%"}),
        "contact_lost": frozenset({"%"}),
        "first_impact": frozenset({"x F"}),
        "force_rmse": frozenset({"% of F"}),
        "simulated_time": frozenset({"s"}),
        "peak_force": frozenset({"N"}),
    }
)
VALUES = {"coverage": 99.0, "contact_lost": 0.0, "first_impact": 3.0, "force_rmse": 4.0, "simulated_time": 50.0}


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("time", 50.0),
        ("simulated_time / 10 s + 2 * rmse", 13.0),
        ("100 % - coverage", 1.0),
        ("-coverage", -99.0),
        ("max(force_rmse, 2 * impact)", 6.0),
        ("abs(coverage - 100)", 1.0),
        ("1e1 * impact", 30.0),
        ("peak_force", None),
        ("time / contact_lost", None),
    ],
)
def test_an_objective_is_computed(text: str, value: float | None) -> None:
    (objective,), _ = read_expressions(text, "", TASK)
    assert objective.compute(VALUES) == value


@pytest.mark.parametrize(
    ("text", "violation"),
    [
        ("coverage == 100 %", 0.01),
        ("coverage == 99 %", 0.0),
        ("contact_lost == 0", 0.0),
        ("impact <= 2 x F", 0.5),
        ("impact <= 3", 0.0),
        ("coverage >= 98", 0.0),
        ("coverage > 99", 1e-9),
        ("contact_lost < 1 %", 0.0),
        ("time >= 100 s", 0.5),
        ("peak_force <= 3 N", None),
    ],
)
def test_a_constraint_is_missed_by_a_share(text: str, violation: float | None) -> None:
    _, (constraint,) = read_expressions("time", text, TASK)
    assert constraint.violation(VALUES) == pytest.approx(violation)


def test_commas_are_between_expressions_and_within_parentheses() -> None:
    objectives, constraints = read_expressions("time,max(rmse, 2), ", "coverage == 100 %, max(impact, 1) <= 2", TASK)
    assert [each.text for each in objectives] == ["time", "max(rmse, 2)"]
    assert [each.text for each in constraints] == ["coverage == 100 %", "max(impact, 1) <= 2"]


@pytest.mark.parametrize(
    ("minimise", "subject_to", "why"),
    [
        ("", "", "nothing is to be minimised; the figures are `contact_lost`, `coverage`"),
        ("depth", "", "there is no figure `depth`; the figures are `contact_lost`"),
        ("coverge", "", "did you mean `coverage`?"),
        ("time, 3", "", "`3` has no figure"),
        ("time", "3 <= 4", "`3 <= 4` has no figure"),
        ("time", "coverage", "`coverage` is no constraint: compare two expressions"),
        ("time", "1 < coverage < 2", "is no constraint"),
        ("time", "coverage == 100 s", "`100 s` in `coverage == 100 s`: its figures are in %"),
        ("max(time, 3", "", "has an opening parenthesis without a closing one"),
        ("time +", "", "`time +` in `time +` is no expression over figures"),
        ("time ** 2", "", "`time ** 2` in `time ** 2` cannot be computed"),
        ("__import__('os')", "", "there is no figure `__import__`"),
        ("time.real", "", "cannot be computed"),
        ("abs(time, 2)", "", "`abs` in `abs(time, 2)` takes one value"),
        ("max(time)", "", "`max` in `max(time)` takes two values or more"),
    ],
)
def test_what_cannot_be_computed_is_named(minimise: str, subject_to: str, why: str) -> None:
    with pytest.raises(RequestError) as error:
        read_expressions(minimise, subject_to, TASK)
    assert why in str(error.value)


def test_a_name_of_several_figures_has_to_be_whole() -> None:
    both = Figures({"held_force": frozenset({"N"}), "peak_force": frozenset({"N"})})
    with pytest.raises(RequestError, match="`force` may be `held_force` or `peak_force`"):
        read_expressions("force", "", both)
    check_expressions("force", "")  # the task may measure one of them only
    with pytest.raises(RequestError, match="there is no figure `farce_rmse`; did you mean `force_rmse"):
        check_expressions("farce_rmse", "")


def test_a_trial_has_the_worst_figure_of_its_things() -> None:
    trial = good(3, wiping("lab:Table-1", coverage=0.9), wiping("lab:Table-2", force_rmse_n=2.0))
    world = read_world(trial)
    assert (world.seed, world.figures["coverage"], world.figures["force_rmse"]) == (3, 90.0, 20.0)
    assert world.figures["simulated_time"] == 40.0
    assert world.failures == ()
    assert set(measured_figures(trial).units) == set(world.figures)


@pytest.mark.parametrize("kind", GOOD)
def test_figures_of_each_kind_of_work_can_be_named(kind: str) -> None:
    names = measured_figures(good(0, GOOD[kind])).units
    assert {"simulated_time", "peak_force"} < set(names)
    for name in names:
        check_expressions(name, f"{name} <= 1")
