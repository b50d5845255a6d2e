"""What a call tells those who listen: its choice with the reasons, and what it met when it failed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from skillc_compiler.library.skills import Implementation, Skill
from skillc_compiler.library.tree import Call
from skillc_runtime.selection.describe import bindings_text
from skillc_runtime.selection.determined import determined
from skillc_runtime.selection.fit import fit
from skillc_runtime.selection.select import candidates
from skillc_runtime.trace.events import ImplementationChosen
from skillc_runtime.trace.failure import Rejected
from skillc_runtime.trace.reasons import Attempted, Untried
from skillc_runtime.tree.activation import Activation
from skillc_runtime.tree.context import Context
from skillc_runtime.world.eval.support import deciding_facts
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


def chosen(
    node: int,
    call: Call,
    activation: Activation,
    arguments: Mapping[str, Value],
    rejected: Sequence[Rejected],
    context: Context,
) -> ImplementationChosen:
    """Return the event that a call starts with an implementation."""
    implementation = activation.implementation
    ranked = candidates(context.library, call.skill, call.implementation)
    after = ranked[ranked.index(implementation) + 1 :]
    return ImplementationChosen(
        time=context.time,
        node=node,
        skill=call.skill,
        implementation=implementation.name,
        bindings=bindings_text(activation.frame, implementation.parameters, context.library.vocabulary),
        rejected=tuple(rejected),
        determined=determined(activation.fitted, arguments.keys(), context.state),
        untried=tuple(_untried(each, arguments, context.state) for each in after),
        fixed=call.implementation is not None,
        source=implementation.source,
    )


def _untried(implementation: Implementation, arguments: Mapping[str, Value], state: WorldState) -> Untried:
    try:
        fitted = fit(implementation, arguments, state)
        reason = fitted.reason if isinstance(fitted, Rejected) else ""
    except EvaluationError as error:
        reason = str(error)
    return Untried(implementation=implementation.name, source=implementation.source, reason=reason)


def attempted(
    skill: Skill, arguments: Mapping[str, Value], rejected: Sequence[Rejected], facts: tuple[str, ...], context: Context
) -> Attempted:
    """Return what a call that failed had."""
    shown = bindings_text(arguments, skill.parameters, context.library.vocabulary)
    unset = tuple(each.name for each in skill.parameters if each.direction == "infer" and each.name not in arguments)
    return Attempted(arguments=shown, unset=unset, rejected=tuple(rejected), facts=facts)


def facts_at_failure(
    tried: Sequence[Implementation], running: Activation | None, arguments: Mapping[str, Value], state: WorldState
) -> tuple[str, ...]:
    """Return the facts that the conditions of a call read: of the implementation that runs, else of all tried."""
    implementations = tried if running is None else (running.implementation,)
    conditions = [each.condition for one in implementations for each in (*one.pre, *one.hold)]
    conditions += [post.condition for post in (running.implementation.post if running is not None else ())]
    return deciding_facts(conditions, state, arguments if running is None else running.frame)
