"""Executes plans in the world model before anything moves, since no planner is trusted."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

from skillc_model.conditions import Condition
from skillc_model.pddl.costs import ASSUMED_SECONDS, find_duration
from skillc_model.skills import Implementation, Outcome, Parameter, Post, Requirement, SkillLibrary
from skillc_rdf.vocabulary.types import ClassType
from skillc_runtime.planning.foresight import foresee
from skillc_runtime.planning.plan import Plan, Step
from skillc_runtime.planning.problem.initial_state import evaluate_duration_s
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.effects import changes_of, find_unmet
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.eval.expressions import Bindings, value_of
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.model import WorldError, WorldModel
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


class PlanError(ValueError):
    """A plan that does not work; the message names the step and the failing condition."""


def validate(plan: Plan, library: SkillLibrary, state: WorldState, goal: Condition) -> WorldState:
    """Return the world after the plan.

    PlanError if the type of an argument, a precondition or a hold condition of a step fails, if none of its
    implementations can start, if its effects violate an axiom, if a postcondition does not hold after it, or if the
    goal does not hold at the end. Of a policy all of that is checked for each branch that is planned, and that it has a
    branch for each outcome; the world is that before its last step.
    """
    library, state = foresee(library, state, goal)
    if not plan.branches:
        return check_goal_reached(goal, follow_plan(plan, library, state)[-1])
    *before, look = plan.steps
    world = follow_plan(Plan(tuple(before), 0.0), library, state)[-1]
    branches = {each.outcome: each.plan for each in plan.branches}
    for outcome in find_possible_outcomes(look, library, world):
        if outcome.label not in branches:
            raise PlanError(f"it does not say how it goes on if {look.skill} ends with `{outcome.label}`")
        after = follow_plan(Plan((look.with_outcome(outcome.label),), 0.0), library, world)[-1]
        branch = branches[outcome.label]
        if branch is not None:
            validate(branch, library, after, goal)
    return world


def follow_plan(plan: Plan, library: SkillLibrary, state: WorldState) -> tuple[WorldState, ...]:
    """Return the world before a plan and after each step; PlanError, which names the step, if one does not work."""
    worlds = [state]
    for number, step in enumerate(plan.steps, start=1):
        try:
            worlds.append(apply_step(step, library, worlds[-1]))
        except PlanError as reason:
            raise PlanError(f"step {number}, {step.skill}: {reason}") from reason
    return tuple(worlds)


def check_goal_reached(goal: Condition, state: WorldState) -> WorldState:
    """Return the world if the goal holds in it; else PlanError, with the facts."""
    try:
        holds = evaluate(goal, state, {})
    except EvaluationError as reason:
        raise PlanError(f"the goal cannot be decided after the plan: {reason}") from reason
    if not holds:
        raise PlanError(f"the goal does not hold after the plan: {explain(goal, state, {}, state.vocabulary)}")
    return state


def apply_step(step: Step, library: SkillLibrary, state: WorldState) -> WorldState:
    """Return the world after one step; PlanError if it cannot start or its effects are inconsistent."""
    try:
        find_startable_implementations(step, library, state)
        if step.outcome and step.outcome not in [each.label for each in find_possible_outcomes(step, library, state)]:
            raise PlanError(f"it cannot end with `{step.outcome}`, since something else is known")
        return check_stated_posts(step, library, apply_effects(step, library, state), state)
    except (EvaluationError, WorldError) as reason:
        raise PlanError(str(reason)) from reason


def check_stated_posts(step: Step, library: SkillLibrary, after: WorldState, before: WorldState) -> WorldState:
    """Return the world after a step if all postconditions of its skill hold in it; else PlanError.

    Postconditions that are only measured have no effects in the world model and are not checked.
    """
    bindings = bind_parameters(step, library, after)
    for result in _results(step, library):
        if result.effects and not evaluate(result.condition, after, bindings):
            why = explain(result.condition, after, bindings, after.vocabulary)
            raise PlanError(f"`{result.text}` would not hold in the end: {why}")
        unmet = find_unmet(result.effects, after, bindings, before)
        if unmet is not None:
            why = explain(unmet[0], after, unmet[1], after.vocabulary)
            raise PlanError(f"`{result.text}` would not hold in the end: {why}")
    return after


def _results(step: Step, library: SkillLibrary) -> tuple[Post | Outcome, ...]:
    """Return the postconditions of a step and the outcome that comes of it, if it has one."""
    skill = library.skills[step.skill]
    outcome = skill.find_outcome(step.outcome)
    return (*skill.post, *(() if outcome is None else (outcome,)))


def find_possible_outcomes(step: Step, library: SkillLibrary, state: WorldState) -> tuple[Outcome, ...]:
    """Return the outcomes that may come of a step: what is known is not unlearned. EvaluationError if that is open."""
    skill, bindings = library.skills[step.skill], bind_parameters(step, library, state)
    return tuple(each for each in skill.outcomes if evaluate(each.find_possibility(skill.senses), state, bindings))


def apply_effects(step: Step, library: SkillLibrary, state: WorldState) -> WorldState:
    """Return the world with a step's effects, whether or not it can start; EvaluationError, WorldError."""
    return WorldModel(state).commit(compute_effects(step, library, state)).after


def compute_effects(step: Step, library: SkillLibrary, state: WorldState) -> tuple[Change, ...]:
    """Return the changes that a step's postconditions, and its outcome, describe.

    EvaluationError if one cannot be computed.
    """
    effects = [effect for each in _results(step, library) for effect in each.effects]
    return changes_of(effects, state, bind_parameters(step, library, state))


def compute_step_duration_s(step: Step, library: SkillLibrary, state: WorldState, before: WorldState) -> Fraction:
    """Return the expected duration in s of a step that starts in `state`, with the first implementation that can start.

    The duration is evaluated in the world `before` the plan, as planners do. PlanError if the step cannot start.
    """
    try:
        implementation = find_startable_implementations(step, library, state)[0]
        duration = find_duration(library.skills[step.skill], implementation)
        if duration is None:
            return ASSUMED_SECONDS
        seconds = evaluate_duration_s(duration, before, bind_in(implementation.parameters, step, before))
    except EvaluationError as reason:
        raise PlanError(str(reason)) from reason
    return seconds if isinstance(seconds, Fraction) else ASSUMED_SECONDS


def compute_work_s(plan: Plan, library: SkillLibrary, state: WorldState) -> float:
    """Return the sum of the durations of all steps of a plan in s; PlanError if the plan does not work."""
    before, work = state, Fraction(0)
    for step in plan.steps:
        work += compute_step_duration_s(step, library, state, before)
        state = apply_step(step, library, state)
    return float(work)


def bind_parameters(step: Step, library: SkillLibrary, state: WorldState) -> Bindings:
    """Return the values of the skill's parameters in a step: those that the planner bound, defaults, or None."""
    return bind_in(library.skills[step.skill].parameters, step, state)


def find_startable_implementations(step: Step, library: SkillLibrary, state: WorldState) -> tuple[Implementation, ...]:
    """Return the implementations with which a step can start; PlanError if there is none, EvaluationError."""
    skill = library.skills.get(step.skill)
    if skill is None:
        raise PlanError("there is no such skill")
    bindings = bind_in(skill.parameters, step, state)
    for problem in _find_problems(skill.parameters, (*skill.pre, *skill.hold), bindings, state):
        raise PlanError(problem)
    found: list[Implementation] = []
    refusals: list[str] = []
    for implementation in library.implementations_of(skill.name):
        refusal = next(_find_implementation_problems(implementation, step, state), None)
        if refusal is None:
            found.append(implementation)
        else:
            refusals.append(f"{implementation.name}: {refusal}")
    if not found:
        raise PlanError("no implementation fits: " + "; ".join(refusals))
    return tuple(found)


def filter_held_implementations(
    step: Step, begun: Sequence[Implementation], library: SkillLibrary, state: WorldState
) -> tuple[Implementation, ...]:
    """Return the implementations whose hold conditions all hold; PlanError if there is none, EvaluationError."""
    skill = library.skills[step.skill]
    for problem in _find_problems((), skill.hold, bind_in(skill.parameters, step, state), state):
        raise PlanError(problem)
    broken = {each.name: next(_find_broken_holds(each, step, state), None) for each in begun}
    held = tuple(each for each in begun if broken[each.name] is None)
    if not held:
        raise PlanError("; ".join(f"{name}: {problem}" for name, problem in broken.items()))
    return held


def _find_broken_holds(implementation: Implementation, step: Step, state: WorldState) -> Iterator[str]:
    yield from _find_problems((), implementation.hold, bind_in(implementation.parameters, step, state), state)


def _find_implementation_problems(implementation: Implementation, step: Step, state: WorldState) -> Iterator[str]:
    bindings = bind_in(implementation.parameters, step, state)
    conditions = (*implementation.pre, *implementation.hold)
    yield from _find_problems(implementation.parameters, conditions, bindings, state)


def bind_in(parameters: tuple[Parameter, ...], step: Step, state: WorldState) -> dict[str, Value | None]:
    """Return the values of parameters, of a skill or of an implementation, in a step; EvaluationError of a default."""
    bindings: dict[str, Value | None] = dict(step.arguments)
    for parameter in parameters:
        if parameter.name not in bindings:
            default = parameter.default
            bindings[parameter.name] = None if default is None else value_of(default, state, bindings)
    return bindings


def _find_problems(
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
            yield f"`{parameter.name}` is {short(value)}, which is not a {short(type_.iri)}"
            return
    for requirement in requirements:
        if not evaluate(requirement.condition, state, bindings):
            why = explain(requirement.condition, state, bindings, state.vocabulary)
            yield f"`{requirement.text}` does not hold: {why}"
            return
