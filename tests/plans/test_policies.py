"""Policies: one branch an outcome, each of which reaches the goal, in few plans, or no claim that it does."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path
from random import Random

import pytest
from msgspec.structs import replace

from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_library
from skillc_compiler.goals.parsing import parse_goal
from skillc_model.conditions import Condition
from skillc_model.skills import SkillLibrary
from skillc_runtime.planning import policy
from skillc_runtime.planning.plan import GaveUp, Plan, Solved, Step, Unsolvable
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.solve import solve
from skillc_runtime.planning.validation import PlanError, apply_step, find_possible_outcomes, validate
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, SetProperty
from skillc_runtime.world.state.world_state import WorldState

LAB, OWN, SKIROS = (
    "http://example.org/lab#",
    "https://w3id.org/skillc/library/looks#",
    "http://rvmi.aau.dk/ontologies/skiros.owl#",
)
KEEP = "lab:{0} has isFull and (lab:{0}.isFull == true implies lab:store contain lab:{0})"


@cache
def library() -> SkillLibrary:
    return compile_valid(find_library(Path(__file__).with_name("looks")))


def without(*skills: str) -> SkillLibrary:
    """Return the library in which nothing is planned with some skills."""
    left_out = {name: replace(library().skills[name], planned=False) for name in skills}
    return replace(library(), skills={**library().skills, **left_out})


def world(*chests: str, **values: bool) -> WorldState:
    """Return a world with chests on a table, and properties of the first chest."""
    changes = [AddIndividual(LAB + "table", (OWN + "Table",)), AddIndividual(LAB + "store", (SKIROS + "Location",))]
    for each in chests:
        changes += [AddIndividual(LAB + each, (OWN + "Chest",)), SetProperty(LAB + each, OWN + "isBroken", False)]
        changes.append(AddRelation(LAB + "table", SKIROS + "contain", LAB + each))
    changes += [SetProperty(LAB + chests[0], OWN + name, value) for name, value in values.items()]
    return WorldState.empty(library().vocabulary).with_changes(changes)


def goal(text: str, state: WorldState) -> Condition:
    individuals = {each: sorted(state.types(each)) for each in state.individuals}
    outcome = parse_goal(
        text, library().vocabulary, individuals, {**state.vocabulary.prefixes, "lab": LAB}, home=(OWN, SKIROS)
    )
    assert outcome.value is not None, outcome.diagnostics
    return outcome.value


def plan_for(text: str, state: WorldState, of: SkillLibrary | None = None) -> Solved | Unsolvable | GaveUp:
    return solve(of or library(), state, goal(text, state), (AStar(),))


def write(plan: Plan | None) -> Iterator[str]:
    """Yield the steps of a policy, and its branches in brackets."""
    if plan is None:
        yield "?"
        return
    yield from (f"{each.skill} {each.arguments['chest'].removeprefix(LAB)}" for each in plan.steps)
    for each in plan.branches:
        yield f"{each.outcome}[{' '.join(write(each.plan))}]"


def test_there_is_a_branch_for_each_outcome() -> None:
    found = plan_for(KEEP.format("a"), world("a"), without("Shake"))
    assert isinstance(found, Solved)
    assert " ".join(write(found.plan)) == "Open a full[Take a] empty[]"
    assert [each.likely for each in found.plan.branches] == [0.25, 0.75]
    assert (found.plan.duration_s, found.plan.worst_s, found.at_least_s) == (10.75, 13.0, 10.0)
    assert found.optimal == "best found", "what suits it takes less"


def test_a_step_of_which_an_outcome_leads_nowhere_is_left_out() -> None:
    found = plan_for(KEEP.format("a") + " and lab:a.isBroken == false", world("a"))
    assert isinstance(found, Solved)
    assert " ".join(write(found.plan)) == "Open a full[Take a] empty[]", "shaking is faster, but may break it"
    answer = plan_for(KEEP.format("a") + " and lab:a.isBroken == false", world("a"), without("Open"))
    assert isinstance(answer, GaveUp) and f"after Shake({LAB}a, {LAB}table) -> broken: " in answer.why


def test_what_is_known_is_not_unlearned() -> None:
    known = world("a", isFull=True)
    found = plan_for(KEEP.format("a"), known)
    assert isinstance(found, Solved) and " ".join(write(found.plan)) == "Take a" and found.optimal == "proven"
    look = Step("Open", {"chest": LAB + "a", "at": LAB + "table"})
    assert [each.label for each in find_possible_outcomes(look, library(), known)] == ["full"]
    with pytest.raises(PlanError, match="something else is known"):
        apply_step(look.with_outcome("empty"), library(), known)
    opened = plan_for("lab:a.isOpen == true", known)
    assert isinstance(opened, Solved) and not opened.plan.branches, "nothing is left to be found out"


def test_no_branch_comes_back_to_where_it_was() -> None:
    text = "lab:a.isPermitted == true"
    answer = plan_for(text, world("a", isPermitted=False))
    assert isinstance(answer, GaveUp) and f"after Request({LAB}a) -> refused: it would come back" in answer.why


def test_the_same_world_is_planned_for_once(monkeypatch: pytest.MonkeyPatch) -> None:
    state, asked = world("a", "b"), list[object]()
    plain = policy._Expansion._plan_line
    monkeypatch.setattr(
        policy._Expansion, "_plan_line", lambda self, here, *more: asked.append(here) or plain(self, here, *more)
    )
    found = plan_for("lab:a has isFull and lab:b has isFull", state, without("Shake"))
    assert isinstance(found, Solved) and len(asked) == len(set(asked)) == 3
    assert found.plan.count == 3 and not any(found.plan.list_open())


def test_too_many_branches_are_planned_when_they_come(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(policy, "MOST_PLANS", 2)
    monkeypatch.setattr(policy, "RARE", 0.2)
    text = " and ".join(KEEP.format(each) for each in "abc")
    found = plan_for(text, world(*"abc"), without("Shake"))
    assert isinstance(found, Solved) and found.optimal == "best found"
    left_open = [[each.outcome for each in looks] for looks in found.plan.list_open()]
    assert left_open and all(each[-1] == "full" for each in left_open), "the likely outcomes are planned"
    validate(found.plan, library(), world(*"abc"), goal(text, world(*"abc")))


def test_a_policy_that_forgets_an_outcome_does_not_work() -> None:
    state = world("a")
    aim, found = goal(KEEP.format("a"), state), plan_for(KEEP.format("a"), state, without("Shake"))
    assert isinstance(found, Solved)
    validate(found.plan, library(), state, aim)
    with pytest.raises(PlanError, match="how it goes on if Open ends with `empty`"):
        validate(replace(found.plan, branches=found.plan.branches[:1]), library(), state, aim)
    idle = tuple(replace(each, plan=Plan((), 0.0)) for each in found.plan.branches)
    with pytest.raises(PlanError, match="the goal does not hold"):
        validate(replace(found.plan, branches=idle), library(), state, aim)


@pytest.mark.parametrize("seed", range(12))
def test_policies_reach_random_goals_whatever_comes(seed: int) -> None:
    rng, state = Random(seed), world("a", "b", **({"isFull": True} if seed % 4 == 0 else {}))
    parts = [
        KEEP,
        "lab:{0}.isOpen == true",
        "lab:store contain lab:{0}",
        "lab:{0} has isFull",
    ]
    text = " and ".join(f"({rng.choice(parts).format(rng.choice('ab'))})" for _ in range(2))
    found = plan_for(text, state)
    assert isinstance(found, Solved), text
    for _ in range(10):
        assert evaluate(goal(text, state), follow(found.plan, state, rng), {}), text


def follow(plan: Plan, state: WorldState, rng: Random) -> WorldState:
    """Return the world after a policy of which anything may come."""
    for step in plan.steps[: -1 if plan.branches else None]:
        state = apply_step(step, library(), state)
    if not plan.branches:
        return state
    outcome = rng.choice(find_possible_outcomes(plan.steps[-1], library(), state)).label
    branch = plan.find_branch(outcome)
    assert branch is not None
    return follow(branch, apply_step(plan.steps[-1].with_outcome(outcome), library(), state), rng)
