"""Runs a plan in the world model before anything moves: no planner is trusted."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

from skillc_model.conditions import Condition
from skillc_model.pddl.costs import ASSUMED_SECONDS, duration_of
from skillc_model.skills import Implementation, Parameter, Requirement, SkillLibrary
from skillc_rdf.vocabulary.types import ClassType
from skillc_runtime.planning.plan import Plan, Step
from skillc_runtime.planning.problem.initial_state import evaluate_duration_s
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.effects import changes_of
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.eval.expressions import Bindings, value_of
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.model import WorldError, WorldModel
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


class PlanError(ValueError):
    """A plan that does not work; the message names the step and the condition that fails."""


def validate(plan: Plan, library: SkillLibrary, state: WorldState, goal: Condition) -> WorldState:
    """Return the world after the plan.

    PlanError when a step's type, precondition or hold condition fails, none of its implementations fits, its effects
    break an axiom, a postcondition does not hold after it, or the goal does not hold in the end.
    """
    for number, step in enumerate(plan.steps, start=1):
        try:
            state = apply_step(step, library, state)
        except PlanError as reason:
            raise PlanError(f"step {number}, {step.skill}: {reason}") from reason
    return check_goal_reached(goal, state)


def check_goal_reached(goal: Condition, state: WorldState) -> WorldState:
    """Return the world itself where the goal holds in it; PlanError where it does not, with the facts."""
    try:
        holds = evaluate(goal, state, {})
    except EvaluationError as reason:
        raise PlanError(f"the goal cannot be decided after the plan: {reason}") from reason
    if not holds:
        raise PlanError(f"the goal does not hold after the plan: {explain(goal, state, {}, state.vocabulary)}")
    return state


def apply_step(step: Step, library: SkillLibrary, state: WorldState) -> WorldState:
    """Return the world after one step; PlanError when it cannot start or its effects break an axiom or each other."""
    try:
        find_startable_implementations(step, library, state)
        return check_stated_posts(step, library, apply_effects(step, library, state))
    except (EvaluationError, WorldError) as reason:
        raise PlanError(str(reason)) from reason


def check_stated_posts(step: Step, library: SkillLibrary, after: WorldState) -> WorldState:
    """Return the world after a step where all is true that its skill states; PlanError where it is not.

    What is measured has no effect in the world model and is not looked at.
    """
    bindings = bind_parameters(step, library, after)
    for post in library.skills[step.skill].post:
        if post.effects and not evaluate(post.condition, after, bindings):
            why = explain(post.condition, after, bindings, after.vocabulary)
            raise PlanError(f"`{post.text}` would not hold in the end: {why}")
    return after


def apply_effects(step: Step, library: SkillLibrary, state: WorldState) -> WorldState:
    """Return the world with a step's effects, whether it could start or not; EvaluationError, WorldError."""
    return WorldModel(state).commit(compute_effects(step, library, state)).after


def compute_effects(step: Step, library: SkillLibrary, state: WorldState) -> tuple[Change, ...]:
    """Return the changes that a step's posts stand for; EvaluationError when one cannot be computed."""
    skill = library.skills[step.skill]
    effects = [effect for post in skill.post for effect in post.effects]
    return changes_of(effects, state, bind_parameters(step, library, state))


def compute_step_duration_s(step: Step, library: SkillLibrary, state: WorldState, before: WorldState) -> Fraction:
    """Return how long a step that starts in `state` is expected to last, in seconds.

    The first implementation that fits is taken. What the duration reads is taken from the world `before` the plan, as
    planners do. PlanError when the step cannot start.
    """
    try:
        implementation = find_startable_implementations(step, library, state)[0]
        duration = duration_of(library.skills[step.skill], implementation)
        if duration is None:
            return ASSUMED_SECONDS
        seconds = evaluate_duration_s(duration, before, _bindings(implementation.parameters, step, before))
    except EvaluationError as reason:
        raise PlanError(str(reason)) from reason
    return seconds if isinstance(seconds, Fraction) else ASSUMED_SECONDS


def compute_work_s(plan: Plan, library: SkillLibrary, state: WorldState) -> float:
    """Return the time that all steps of a plan take together, in seconds; PlanError when it does not work."""
    before, work = state, Fraction(0)
    for step in plan.steps:
        work += compute_step_duration_s(step, library, state, before)
        state = apply_step(step, library, state)
    return float(work)


def bind_parameters(step: Step, library: SkillLibrary, state: WorldState) -> Bindings:
    """Return what the skill's parameters stand for in a step: what the planner bound, defaults, or None."""
    return _bindings(library.skills[step.skill].parameters, step, state)


def find_startable_implementations(step: Step, library: SkillLibrary, state: WorldState) -> tuple[Implementation, ...]:
    """Return the implementations with which a step can start; PlanError when it cannot, EvaluationError."""
    skill = library.skills.get(step.skill)
    if skill is None:
        raise PlanError("there is no such skill")
    bindings = _bindings(skill.parameters, step, state)
    for problem in _problems(skill.parameters, (*skill.pre, *skill.hold), bindings, state):
        raise PlanError(problem)
    found: list[Implementation] = []
    refusals: list[str] = []
    for implementation in library.implementations_of(skill.name):
        misfit = next(_implementation_problems(implementation, step, state), None)
        if misfit is None:
            found.append(implementation)
        else:
            refusals.append(f"{implementation.name}: {misfit}")
    if not found:
        raise PlanError("no implementation fits: " + "; ".join(refusals))
    return tuple(found)


def filter_held_implementations(
    step: Step, begun: Sequence[Implementation], library: SkillLibrary, state: WorldState
) -> tuple[Implementation, ...]:
    """Return those implementations of which all hold conditions hold; PlanError when there is none, EvaluationError."""
    skill = library.skills[step.skill]
    for lost in _problems((), skill.hold, _bindings(skill.parameters, step, state), state):
        raise PlanError(lost)
    losses = {each.name: next(_losses(each, step, state), None) for each in begun}
    held = tuple(each for each in begun if losses[each.name] is None)
    if not held:
        raise PlanError("; ".join(f"{name}: {loss}" for name, loss in losses.items()))
    return held


def _losses(implementation: Implementation, step: Step, state: WorldState) -> Iterator[str]:
    yield from _problems((), implementation.hold, _bindings(implementation.parameters, step, state), state)


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
