"""Runs a plan in the world model before anything moves: no planner is trusted."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.library.conditions import Condition
from skillc_compiler.library.skills import Implementation, Parameter, Post, Requirement, SkillLibrary
from skillc_compiler.library.vocabulary import ClassType
from skillc_runtime.planning.plan import Plan, Step
from skillc_runtime.world.conditions import evaluate
from skillc_runtime.world.effects import changes_of
from skillc_runtime.world.explain import explain
from skillc_runtime.world.expressions import EvaluationError, value_of
from skillc_runtime.world.model import WorldError, WorldModel
from skillc_runtime.world.state import WorldState
from skillc_runtime.world.values import Value


class PlanError(ValueError):
    """A plan that does not work; the message names the step and the condition that fails."""


def validate(plan: Plan, library: SkillLibrary, state: WorldState, goal: Condition) -> WorldState:
    """Return the world after the plan.

    PlanError when a step's type, precondition or hold condition fails, none of its implementations fits, its effects
    break an axiom, or the goal does not hold in the end.
    """
    for number, step in enumerate(plan.steps, start=1):
        try:
            state = _after(step, library, state)
        except (EvaluationError, WorldError, _StepError) as reason:
            raise PlanError(f"step {number}, {step.skill}: {reason}") from reason
    try:
        reached = evaluate(goal, state, {})
    except EvaluationError as reason:
        raise PlanError(f"the goal cannot be decided after the plan: {reason}") from reason
    if not reached:
        raise PlanError(f"the goal does not hold after the plan: {explain(goal, state, {}, state.vocabulary)}")
    return state


class _StepError(Exception):
    """What is wrong with a step."""


def _after(step: Step, library: SkillLibrary, state: WorldState) -> WorldState:
    skill = library.skills.get(step.skill)
    if skill is None:
        raise _StepError("there is no such skill")
    bindings = _bindings(skill.parameters, step, state)
    for problem in _problems(skill.parameters, (*skill.pre, *skill.hold), bindings, state):
        raise _StepError(problem)
    refusals: list[str] = []
    for implementation in library.implementations_of(skill.name):
        problems = list(_implementation_problems(implementation, step, state))
        if not problems:
            return _applied(skill.post, bindings, state)
        refusals.append(f"{implementation.name}: {problems[0]}")
    raise _StepError("no implementation fits: " + "; ".join(refusals))


def _implementation_problems(implementation: Implementation, step: Step, state: WorldState) -> Iterator[str]:
    bindings = _bindings(implementation.parameters, step, state)
    conditions = (*implementation.pre, *implementation.hold)
    yield from _problems(implementation.parameters, conditions, bindings, state)


def _bindings(parameters: tuple[Parameter, ...], step: Step, state: WorldState) -> dict[str, Value | None]:
    bindings: dict[str, Value | None] = dict(step.arguments)
    for parameter in parameters:
        if parameter.name not in bindings:
            default = parameter.default
            bindings[parameter.name] = None if default is None else value_of(default, state, bindings)
    return bindings


def _problems(
    parameters: tuple[Parameter, ...],
    requirements: tuple[Requirement, ...],
    bindings: dict[str, Value | None],
    state: WorldState,
) -> Iterator[str]:
    short = state.vocabulary.short
    for parameter in parameters:
        value, type_ = bindings[parameter.name], parameter.type
        if value is None and parameter.direction in ("in", "infer"):
            yield f"`{parameter.name}` is not bound"
            return
        if isinstance(type_, ClassType) and isinstance(value, str) and not state.is_a(value, type_.iri):
            yield f"`{parameter.name}` is {short(value)}, which is no {short(type_.iri)}"
            return
    for requirement in requirements:
        if not evaluate(requirement.condition, state, bindings):
            why = explain(requirement.condition, state, bindings, state.vocabulary)
            yield f"`{requirement.text}` does not hold: {why}"
            return


def _applied(posts: tuple[Post, ...], bindings: dict[str, Value | None], state: WorldState) -> WorldState:
    effects = [effect for post in posts for effect in post.effects]
    return WorldModel(state).commit(changes_of(effects, state, bindings)).after
