"""Large scenes: a part is planned with first, and nothing is claimed of the whole that was not shown."""

from __future__ import annotations

import msgspec
import pytest

from planning.samples import CLEAN, CLEANED, DRIVE, LAB, PICK, WIPING, library
from skillc_model.conditions import Forall, Holds, Individual, Not, PropertyOf, Variable
from skillc_model.pddl.formulas import Negation, Universal, conjuncts
from skillc_model.pddl.preparing.complement import add_complements
from skillc_runtime.cancellation import Cancelled, CancelToken
from skillc_runtime.planning.abstraction.lower_bound import relax_scene
from skillc_runtime.planning.plan import GaveUp, Solved, Unsolvable
from skillc_runtime.planning.problem import backward
from skillc_runtime.planning.problem import initial_state as initial
from skillc_runtime.planning.problem.neighbourhood import AbstractionSize
from skillc_runtime.planning.problem.pose import pose_problem
from skillc_runtime.planning.reachability import explain_unreachable
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.search.grounding import Grounding
from skillc_runtime.planning.solve import solve
from world.lab import assign, fact, individual, iri

SMALL = AbstractionSize(10, 2)
CROWD = LAB.with_changes(
    [
        *(individual(f"place-{n}", "Location") for n in range(12)),
        *(individual(f"part-{n}", "Product") for n in range(12)),
        *(fact(f"place-{n}", "contain", f"part-{n}") for n in range(12)),
        *(assign(f"part-{n}", "weight", 0.1) for n in range(12)),
    ]
)
HEAVY = CROWD.with_changes([assign("eraser", "weight", 3.0)])


def test_a_part_of_the_scene_is_enough_and_nothing_left_out_could_make_the_plan_shorter() -> None:
    result = solve(WIPING, CROWD, CLEANED, (AStar(),), size=SMALL)
    assert isinstance(result, Solved)
    assert [step.skill for step in result.plan.steps] == ["Drive", "Pick", "Drive", "Clean"]
    assert result.optimal == "proven"
    far = [each for each in result.left_out if not each.harmless]
    assert len(far) == 1 and len(far[0].what) == 12 and "far from what the goal refers to" in far[0].why


def test_a_plan_that_may_not_be_the_shortest_is_labelled_and_with_a_proof_the_scene_is_widened() -> None:
    quick = msgspec.structs.replace(PICK, duration=PropertyOf(Variable("object"), iri("weight")))
    skills = library(DRIVE, quick, CLEAN)
    light = CROWD.with_changes(
        [
            *(individual(f"wiper-{n}", "Eraser") for n in range(8)),
            *(fact("dock", "contain", f"wiper-{n}") for n in range(8)),
            *(assign(f"wiper-{n}", "weight", 1.9) for n in range(7)),
            assign("wiper-7", "weight", 0.2),
        ]
    )
    narrow = solve(skills, light, CLEANED, (AStar(),), size=SMALL)
    assert isinstance(narrow, Solved) and narrow.optimal == "optimal for the filtered problem"
    proven = solve(skills, light, CLEANED, (AStar(),), size=AbstractionSize(10, 2, proves=True))
    assert isinstance(proven, Solved) and proven.optimal == "proven"
    assert proven.plan.duration_s == pytest.approx(0.2 + 12 + 40)
    assert narrow.at_least_s is not None
    assert narrow.at_least_s <= proven.plan.duration_s < narrow.plan.duration_s


def test_a_small_scene_is_widened_until_the_plan_is_proven() -> None:
    quick = msgspec.structs.replace(PICK, duration=PropertyOf(Variable("object"), iri("weight")))
    wipers = range(8)
    light = CROWD.with_changes(
        [
            *(individual(f"wiper-{n}", "Eraser") for n in wipers),
            *(fact("dock", "contain", f"wiper-{n}") for n in wipers),
            *(assign(f"wiper-{n}", "weight", 1.9 if n < 7 else 0.2) for n in wipers),
        ]
    )
    skills, things = library(DRIVE, quick, CLEAN), len(light.individuals)
    proven = solve(skills, light, CLEANED, (AStar(),), size=AbstractionSize(10, 2, things))
    assert isinstance(proven, Solved) and proven.optimal == "proven"
    assert proven.plan.duration_s == pytest.approx(0.2 + 12 + 40)
    larger = solve(skills, light, CLEANED, (AStar(),), size=AbstractionSize(10, 2, 1))
    assert isinstance(larger, Solved) and larger.optimal == "optimal for the filtered problem"


def test_an_abstract_object_has_the_facts_of_each_of_its_members(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(backward, "MAX_STEPS", 0)  # else the parts are not needed
    narrow = pose_problem(WIPING, HEAVY.with_changes([assign("board", "isClean", True)]), CLEANED, (), SMALL)
    assert narrow.narrowed and narrow.candidate_count == len(narrow.problem.objects) + len(
        next(each for each in narrow.left_out if not each.harmless).what
    )
    bound = relax_scene(narrow, CROWD)
    assert bound is not None
    (other,) = {each.name for each in bound.objects} & {each for each in bound.names if "location" in each}
    assert any(other in each.terms and "contain" in each.predicate for each in bound.init)


def test_that_a_large_scene_has_no_plan_is_proved_from_a_part_and_said_of_the_whole() -> None:
    result = solve(WIPING, HEAVY, CLEANED, (AStar(),), size=SMALL)
    assert isinstance(result, Unsolvable)
    assert "Pick needs light for t:eraser, which nothing fulfils" in result.why
    assert explain_unreachable(WIPING, HEAVY, CLEANED) is not None
    assert explain_unreachable(WIPING, CROWD, CLEANED) is None


def test_a_part_without_a_plan_is_widened() -> None:
    goal = Forall("x", iri("Eraser"), Not(Holds(Variable("x"), iri("containedIn"), Individual(iri("shelf")))))
    result = solve(WIPING, CROWD, goal, (AStar(),), size=AbstractionSize(1, 1))
    assert isinstance(result, Solved) and result.optimal == "proven"
    assert [step.skill for step in result.plan.steps] == ["Drive", "Pick"]


def test_a_condition_with_too_many_combinations_of_objects_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(initial, "MAX_VALUES", 10)
    monkeypatch.setattr(backward, "MAX_STEPS", 0)  # else the parts are not needed
    result = solve(WIPING, CROWD, CLEANED, (AStar(),))
    assert isinstance(result, GaveUp)
    assert result.why == "condition `light` of Pick would have to be evaluated for 13 objects"
    assert explain_unreachable(WIPING, CROWD, CLEANED) is None


def test_nothing_stands_in_where_nothing_was_left_out() -> None:
    assert relax_scene(pose_problem(WIPING, CROWD, CLEANED), CROWD) is None


def test_a_problem_that_is_too_large_is_given_up_in_time() -> None:
    problem = pose_problem(WIPING, CROWD, CLEANED).problem
    with pytest.raises(Cancelled):
        Grounding(problem, CancelToken(0.0)).explore()
    assert isinstance(AStar().plan(problem, CancelToken(0.0)), GaveUp)


def test_what_is_denied_of_all_things_gets_a_predicate_and_the_plan_stays() -> None:
    problem = pose_problem(WIPING, CROWD, CLEANED).problem
    said = add_complements(problem)
    denied = [each for each in conjuncts(problem.domain.action["pick"].precondition) if isinstance(each, Universal)]
    assert len(denied) == 1 and isinstance(denied[0].body, Negation)
    assert not any(
        isinstance(each, Universal) and isinstance(each.body, Negation)
        for each in conjuncts(said.domain.action["pick"].precondition)
    )
    gripper = next(name for name, individual_ in problem.names.items() if individual_ == iri("gripper"))
    empty = [each for each in said.init if each.predicate.startswith("not-") and gripper in each.terms]
    assert len(empty) == len(problem.domain.of_type(problem.objects, denied[0].variable.type))
    assert AStar().plan(said, CancelToken(20.0)) == AStar().plan(problem, CancelToken(20.0))


def test_a_scene_in_which_few_steps_are_possible_is_planned_with_whole() -> None:
    things = len(CROWD.individuals)
    sparse, dense = (AbstractionSize(2, 1, whole) for whole in (things - 1, things // 5))
    whole, part = (solve(WIPING, CROWD, CLEANED, (AStar(),), size=each) for each in (sparse, dense))
    assert isinstance(whole, Solved) and isinstance(part, Solved) and whole.plan == part.plan
    assert [each.why for each in whole.left_out if not each.harmless] == []
    assert any(not each.harmless for each in part.left_out)
