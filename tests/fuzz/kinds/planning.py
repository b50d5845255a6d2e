"""Random planning domains: what planners claim against trying every step in the world model."""

from __future__ import annotations

from pathlib import Path
from random import Random

import msgspec

from fuzz.kinds._domains import Domains
from oracle.forced import TooManyStates, cheapest, seconds
from skillc_model.conditions import Condition
from skillc_model.skills import SkillLibrary
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.makespan.minimise import minimise_makespan
from skillc_runtime.planning.makespan.simulation import simulate_schedule
from skillc_runtime.planning.plan import GaveUp, Plan, Planner, PlanResult, Solved, Unsolvable
from skillc_runtime.planning.planners import find_planners
from skillc_runtime.planning.problem.pose import GoalError, pose_problem
from skillc_runtime.planning.schedule import Planners, Scheduled
from skillc_runtime.planning.solve import solve
from skillc_runtime.planning.validation import apply_step, check_goal_reached
from skillc_runtime.world.state.world_state import WorldState

SECONDS = 30.0
MOST_STATES = 50
DEADLINE_S = 20.0
SLACK_S = 1e-9


def run_case(random: Random, folder: Path) -> None:
    """No plan is claimed to be the cheapest that is not, none denied that exists, and every plan works."""
    domains = Domains(random)
    text, library, state = domains.domain()
    (folder / "input.skill").write_text(text, "utf-8")
    (folder / "scene.txt").write_text("\n".join(map(repr, _facts(state))), "utf-8")
    goal = domains.goal(library, state)
    (folder / "goal.txt").write_text(repr(goal), "utf-8")
    try:
        posed = pose_problem(library, state, goal)
    except GoalError:
        return  # the goal reads what no planner can follow, and the answer says so
    excluded = {each.skill for each in posed.problem.domain.excluded}
    skills = {name: each for name, each in library.skills.items() if name not in excluded}
    known = msgspec.structs.replace(library, skills=skills)
    planner = random.choice(find_planners().for_work)
    answer = solve(library, state, goal, (planner,), CancelToken(DEADLINE_S))
    if posed.restricted:
        _check_part(answer, known, state, goal)
        return
    least_s = _least_s(library, state, goal)
    _check(answer, library, state, goal, least_s)
    if random.random() < 0.1:
        _check_schedule(library, state, goal, planner, least_s)


def _least_s(library: SkillLibrary, state: WorldState, goal: Condition) -> float | None:
    """Return what the cheapest plan costs, None where there is none, a negative number where it is not known."""
    try:
        return cheapest(library, state, goal, MOST_STATES)
    except TooManyStates:
        return -1.0


def _check_part(answer: PlanResult, known: SkillLibrary, state: WorldState, goal: Condition) -> None:
    """Nothing is claimed of a library of which only the `known` skills can be planned with, unless nothing is to do."""
    least_s = _least_s(known, state, goal)
    match answer:
        case Solved(plan=plan):
            assert not plan.steps or (answer.optimal != "proven" and answer.at_least_s is None), answer
            _check(answer, known, state, goal, least_s)
        case Unsolvable():
            raise AssertionError(f"a skill that was left out might help: {answer}")
        case GaveUp(why=why):
            assert least_s is None or least_s < 0.0, f"{why} (the cheapest takes {least_s} s)"


def _check(
    answer: PlanResult, library: SkillLibrary, state: WorldState, goal: Condition, least_s: float | None
) -> None:
    """`least_s` is what the cheapest plan costs, None where there is none, negative where it is not known."""
    match answer:
        case Solved(plan=plan):
            work_s = _work_s(plan, library, state, goal)
            assert abs(work_s - plan.duration_s) < SLACK_S, f"{plan} takes {work_s} s"
            assert least_s is not None, f"there is a plan: {plan}"
            if least_s >= 0.0:
                assert work_s >= least_s - SLACK_S, f"the oracle found no better plan than {least_s}: {plan}"
                assert (answer.at_least_s or 0.0) <= least_s + SLACK_S, f"{least_s} s is less than the bound: {answer}"
                assert answer.optimal != "proven" or work_s <= least_s + SLACK_S, f"{least_s} s is less: {answer}"
        case Unsolvable():
            assert least_s is None or least_s < 0.0, f"there is a plan of {least_s} s: {answer}"
        case GaveUp(why=why):
            raise AssertionError(f"{why} (the cheapest takes {least_s} s)")


def _check_schedule(
    library: SkillLibrary, state: WorldState, goal: Condition, planner: Planner, least_s: float | None
) -> None:
    answer = minimise_makespan(library, state, goal, Planners((planner,), None), CancelToken(DEADLINE_S))
    if isinstance(answer, Scheduled):
        simulate_schedule(answer.schedule, library, state, goal)
        _work_s(answer.plan, library, state, goal)
        assert answer.schedule.makespan_s <= answer.plan.duration_s + SLACK_S
        assert (answer.at_least_s or 0.0) <= answer.schedule.makespan_s + SLACK_S
    else:
        _check(answer, library, state, goal, least_s)


def _work_s(plan: Plan, library: SkillLibrary, start: WorldState, goal: Condition) -> float:
    state, work = start, 0.0
    for step in plan.steps:
        work += float(seconds(step, library, state, start))
        state = apply_step(step, library, state)
    check_goal_reached(goal, state)
    return work


def _facts(state: WorldState) -> list[object]:
    return [
        *((each, sorted(state.types(each))) for each in sorted(state.individuals)),
        *((relation, sorted(state.pairs(relation))) for relation in state.facts),
        *((property_, sorted(table.items())) for property_, table in state.stored.items()),
    ]
