"""Which heuristics a translated task gets, and that what they prove is true."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from planning.samples import DRIVE, LAB, PICK, library, post, skill
from skillc_model.conditions import And, Anything, Holds, Individual, Not, Variable
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.fast_downward import solver as fast_downward
from skillc_runtime.planning.fast_downward.heuristics import (
    BLIND,
    H_MAX,
    LM_CUT,
    MERGE_AND_SHRINK,
    PATTERNS,
    SHORT_H_MAX,
    SHORT_LM_CUT,
    Heuristic,
    TaskFeatures,
    choose_heuristics,
    read_task_features,
)
from skillc_runtime.planning.fast_downward.solver import FastDownward, Programs, find_fast_downward
from skillc_runtime.planning.plan import GaveUp, Solved
from skillc_runtime.planning.problem.pose import pose_problem
from skillc_runtime.planning.solve import solve
from world.lab import holds, iri, parameter

AT = iri("at")
pytestmark = pytest.mark.skipif(find_fast_downward() is None, reason="the planner is an extra")
DOMAIN = """
(define (domain d) (:requirements :adl :derived-predicates)
  (:predicates (wet) (clean) (done))
  (:derived (done) {derived})
  (:action wash :parameters () :precondition (not (wet)) :effect {effect})
  (:action dry :parameters () :precondition {read} :effect (not (wet)))
)
"""
PROBLEM = "(define (problem p) (:domain d) (:init) (:goal (and (clean) (not (wet)))))"
DERIVED, PLAIN = "(or (wet) (clean))", "(and (wet) (clean))"
CONDITIONAL, SIMPLE = "(and (wet) (when (not (clean)) (clean)) (when (clean) (not (clean))))", "(and (wet) (clean))"


@pytest.mark.parametrize(
    ("effect", "read", "expected"),
    [
        (SIMPLE, "(wet)", (SHORT_LM_CUT, PATTERNS, LM_CUT, BLIND)),
        (CONDITIONAL, "(wet)", (SHORT_H_MAX, MERGE_AND_SHRINK, H_MAX, BLIND)),
        (SIMPLE, "(not (done))", (BLIND,)),
        (CONDITIONAL, "(not (done))", (BLIND,)),
    ],
)
def test_a_task_gets_the_heuristics_that_are_lower_bounds_for_it(
    effect: str, read: str, expected: tuple[Heuristic, ...], tmp_path: Path
) -> None:
    programs = find_fast_downward()
    assert programs is not None
    text = DOMAIN.format(derived=DERIVED, effect=effect, read=f"(or {read} (clean))")
    (tmp_path / "domain.pddl").write_text(text)
    (tmp_path / "problem.pddl").write_text(PROBLEM)
    subprocess.run(
        [*programs.translate, "--sas-file", "task.sas", "domain.pddl", "problem.pddl"], cwd=tmp_path, check=True
    )
    assert choose_heuristics(read_task_features(tmp_path / "task.sas")) == expected
    for each in expected:
        with (tmp_path / "task.sas").open() as task:
            search = [programs.search, "--search", f"astar({each.text})"]
            done = subprocess.run(search, cwd=tmp_path, stdin=task, capture_output=True, check=False)
        assert done.returncode == 0, done.stdout[-500:]


JUMP = skill(
    "Jump", (parameter("robot", "Robot"), parameter("to", "Location")), (), (post(holds("robot", "at", "to")),), 1.5
)


def test_what_a_step_replaces_without_knowing_it_is_planned_for_and_proved() -> None:
    programs = find_fast_downward()
    assert programs is not None
    goal = Holds(Individual(iri("robot")), iri("at"), Individual(iri("wall")))
    problem = pose_problem(library(JUMP), LAB, goal).problem
    answer = FastDownward(programs).plan(problem, CancelToken(20.0))
    assert isinstance(answer, Solved) and answer.optimal == "proven" and answer.plan.duration_s == 1.5


LIFT = skill("Lift", (parameter("robot", "Robot"),), (), (post(Not(Holds(Variable("robot"), AT, Anything()))),), 2.5)


def test_an_optimum_is_proved_where_effects_depend_on_what_holds(monkeypatch: pytest.MonkeyPatch) -> None:
    programs, needs = find_fast_downward(), []
    assert programs is not None
    monkeypatch.setattr(
        fast_downward, "read_task_features", lambda task: needs.append(read_task_features(task)) or needs[-1]
    )
    gone = Not(Holds(Individual(iri("robot")), AT, Individual(iri("dock"))))
    picked = Holds(Individual(iri("gripper")), iri("contain"), Individual(iri("eraser")))
    goal = And((gone, picked))
    answer = solve(library(DRIVE, PICK, LIFT), LAB, goal, (FastDownward(programs),))
    assert isinstance(answer, Solved) and answer.optimal == "proven"
    assert [each.skill for each in answer.plan.steps] == ["Drive", "Pick"]
    assert needs == [TaskFeatures(conditional_effects=True, axioms=False)]


@pytest.mark.parametrize(("failing", "proved"), [("lmcut", True), ("lmcut ipdb blind", False)])
def test_where_a_search_fails_the_next_heuristic_gets_its_turn(failing: str, proved: bool, tmp_path: Path) -> None:
    programs = find_fast_downward()
    assert programs is not None
    cases = "\n".join(f'*"astar({each}("*) exit 34;;' for each in failing.split())
    search = tmp_path / "search"
    search.write_text(f'#!/bin/sh\ncase "$*" in\n{cases}\nesac\nexec {programs.search} "$@"\n')
    search.chmod(0o755)
    goal = Holds(Individual(iri("robot")), iri("at"), Individual(iri("wall")))
    problem = pose_problem(library(JUMP), LAB, goal).problem
    answer = FastDownward(Programs(programs.translate, str(search), ("false",))).plan(problem, CancelToken(20.0))
    if proved:
        assert isinstance(answer, Solved) and answer.optimal == "proven"
    else:
        assert isinstance(answer, GaveUp) and "its heuristic does not support" in answer.why
