"""The printed PDDL in the hands of another tool: unified-planning reads it, simulates it, and judges plans."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import cache
from itertools import product
from typing import Any

from unified_planning.engines import (
    CompilationKind,
    SequentialPlanValidator,
    TimeTriggeredPlanValidator,
    UPSequentialSimulator,
)
from unified_planning.engines.compilers import QuantifiersRemover
from unified_planning.io import PDDLReader
from unified_planning.plans import ActionInstance, SequentialPlan, TimeTriggeredPlan
from unified_planning.shortcuts import get_environment

from skillc_model.conditions import And
from skillc_model.pddl.domain import Action, RelationMeaning
from skillc_model.pddl.problem import Problem
from skillc_model.pddl.text import format_domain, format_problem, format_temporal_domain, format_temporal_problem
from skillc_model.skills import SkillLibrary
from skillc_runtime.planning.plan import Plan, Step
from skillc_runtime.planning.problem.initial_state import InitialState
from skillc_runtime.planning.problem.pose import PosedProblem
from skillc_runtime.planning.validation import PlanError, validate
from skillc_runtime.world.state.world_state import WorldState

get_environment().credits_stream = None
GAP_S = 0.01
"""Between the steps of a timed plan: an effect holds after the moment at which it happens."""


def classical(problem: Problem) -> Any:
    """Return the problem as unified-planning reads it from the classical domain."""
    return _read(format_domain(problem.domain), format_problem(problem))


def temporal(problem: Problem) -> Any:
    """Return the problem as unified-planning reads it from the temporal domain."""
    return _read(format_temporal_domain(problem.domain), format_temporal_problem(problem))


def takes(posed: PosedProblem, plan: Plan) -> bool:
    """Whether its validator accepts the steps as a plan for the classical problem."""
    problem = classical(posed.problem)
    steps = SequentialPlan([instance(problem, posed.problem, step) for step in plan.steps])
    return bool(SequentialPlanValidator().validate(problem, steps))


def takes_in_time(posed: PosedProblem, plan: Plan) -> bool:
    """Whether its validator accepts the steps, one after the other, as a plan for the temporal problem."""
    problem = temporal(posed.problem)
    timed, now = [], 0.0
    for step in plan.steps:
        made = instance(problem, posed.problem, step)
        seconds = made.action.duration.lower.constant_value()
        timed.append((_fraction(now), made, _fraction(seconds)))
        now += float(seconds) + GAP_S
    return bool(TimeTriggeredPlanValidator().validate(problem, TimeTriggeredPlan(timed)))


def instance(problem: Any, posed: Problem, step: Step) -> ActionInstance:
    """Return a step as an action of the problem."""
    names = {iri: name for name, iri in posed.names.items()}
    (action,) = [each for each in posed.domain.actions if (each.skill, each.outcome) == (step.skill, step.outcome)]
    arguments = [problem.object(names[step.arguments[bound]]) for bound in action.binds]
    return ActionInstance(
        problem.action(action.name), tuple(map(problem.environment.expression_manager.ObjectExp, arguments))
    )


def disagreements(posed: PosedProblem, state: WorldState, depth: int = 2) -> tuple[list[str], int]:
    """Return where simulating the problem and the world model differ within so many steps, and the steps tried."""
    problem = classical(posed.problem)
    simulator = UPSequentialSimulator(problem, error_on_failed_checks=False)
    todo = [(simulator.get_initial_state(), state, depth)]
    wrong, tried, seen = [], 0, set()
    while todo:
        simulated, world, left = todo.pop()
        facts, found = _facts(posed, _initial(posed, world)), _facts(posed, _true(problem, simulated))
        if found != facts:
            wrong.append(f"after some steps: {sorted(found ^ facts)}")
        if facts in seen or not left:
            continue
        seen.add(facts)
        for step in _steps(posed.problem):
            tried += 1
            made = instance(problem, posed.problem, step)
            after = _after(step, posed.library, world)
            if simulator.is_applicable(simulated, made.action, made.actual_parameters) != (after is not None):
                wrong.append(f"{step} {'works' if after else 'fails'} in the world model only")
            elif after is not None:
                todo.append((simulator.apply(simulated, made.action, made.actual_parameters), after, left - 1))
    return wrong, tried


def _after(step: Step, library: SkillLibrary, world: WorldState) -> WorldState | None:
    try:
        return validate(Plan((step,), 0.0), library, world, And(()))
    except PlanError:
        return None


def _steps(problem: Problem) -> Iterator[Step]:
    """Yield every step with every choice of objects of the right types."""
    for action in problem.domain.actions:
        if action.skill is not None:
            yield from _instances(action, problem)


def _instances(action: Action, problem: Problem) -> Iterator[Step]:
    assert action.skill is not None
    ranges = [problem.domain.of_type(problem.objects, each.type) for each in action.parameters]
    for chosen in product(*ranges):
        iris = (problem.names[name] for name in chosen)
        yield Step(action.skill, dict(zip(action.binds, iris, strict=True)), outcome=action.outcome)


def _facts(posed: PosedProblem, facts: Iterator[tuple[str, ...]]) -> frozenset[tuple[str, ...]]:
    """Return those facts that skills change; the sides of a symmetric relation in order, as either says the same."""
    relations = posed.library.vocabulary.relations
    found = set()
    for name, *terms in facts:
        predicate = posed.problem.domain.predicate[name]
        meaning = predicate.meaning
        symmetric = isinstance(meaning, RelationMeaning) and relations[meaning.relation].symmetric
        if predicate.changes:
            found.add((name, *(sorted(terms) if symmetric else terms)))
    return frozenset(found)


def _initial(posed: PosedProblem, world: WorldState) -> Iterator[tuple[str, ...]]:
    problem = posed.problem
    for each in InitialState(problem.domain, world, problem.objects, problem.names).atoms():
        yield each.predicate, *each.terms


def _true(problem: Any, simulated: Any) -> Iterator[tuple[str, ...]]:
    for fluent in (each for each in problem.fluents if each.type.is_bool_type()):
        for objects in product(*(list(problem.objects(each.type)) for each in fluent.signature)):
            if simulated.get_value(fluent(*objects)).is_true():
                yield fluent.name, *(each.name for each in objects)


def _fraction(seconds: Any) -> Fraction:
    return Fraction(seconds).limit_denominator(1000)


@cache
def _read(domain: str, problem: str) -> Any:
    """Return a problem in which quantifiers are expanded: the simulator is slow at nested ones."""
    read = _reader().parse_problem_string(domain, problem)
    return QuantifiersRemover().compile(read, CompilationKind.QUANTIFIERS_REMOVING).problem


@cache
def _reader() -> PDDLReader:
    """Return a reader; making one takes as long as reading a small problem."""
    return PDDLReader()
