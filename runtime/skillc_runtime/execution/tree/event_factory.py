"""The events of a call: the selected implementation with the reasons, and the context of a failure."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from skillc_compiler.library.skills import Implementation, Skill
from skillc_compiler.library.tree import Call
from skillc_runtime.execution.selection.binding import bind_implementation
from skillc_runtime.execution.selection.binding_reasons import explain_bindings
from skillc_runtime.execution.selection.formatting import format_bindings
from skillc_runtime.execution.selection.select import ranked_implementations
from skillc_runtime.execution.tree.activation import Activation
from skillc_runtime.execution.tree.context import TreeContext
from skillc_runtime.trace.events import ImplementationChosen
from skillc_runtime.trace.failure import Rejected
from skillc_runtime.trace.reasons import Attempted, Untried
from skillc_runtime.world.expressions import EvaluationError
from skillc_runtime.world.state import WorldState
from skillc_runtime.world.support import facts_of
from skillc_runtime.world.values import Value


def make_implementation_chosen(
    node: int,
    call: Call,
    activation: Activation,
    arguments: Mapping[str, Value],
    rejected: Sequence[Rejected],
    context: TreeContext,
) -> ImplementationChosen:
    """Return the event that a call starts an implementation."""
    implementation = activation.implementation
    ranked = ranked_implementations(context.library, call.skill, call.implementation)
    after = ranked[ranked.index(implementation) + 1 :]
    return ImplementationChosen(
        time=context.time,
        node=node,
        skill=call.skill,
        implementation=implementation.name,
        bindings=format_bindings(activation.frame, implementation.parameters, context.library.vocabulary),
        rejected=tuple(rejected),
        determined=explain_bindings(activation.bound, arguments.keys(), context.state),
        untried=tuple(_make_untried(each, arguments, context.state) for each in after),
        fixed=call.implementation is not None,
        source=implementation.source,
    )


def _make_untried(implementation: Implementation, arguments: Mapping[str, Value], state: WorldState) -> Untried:
    try:
        bound = bind_implementation(implementation, arguments, state)
        reason = bound.reason if isinstance(bound, Rejected) else ""
    except EvaluationError as error:
        reason = str(error)
    return Untried(implementation=implementation.name, source=implementation.source, reason=reason)


def make_attempted(
    skill: Skill,
    arguments: Mapping[str, Value],
    rejected: Sequence[Rejected],
    facts: tuple[str, ...],
    context: TreeContext,
) -> Attempted:
    """Return the arguments, unset parameters, rejections and facts of a call that failed."""
    shown = format_bindings(arguments, skill.parameters, context.library.vocabulary)
    unset = tuple(each.name for each in skill.parameters if each.direction == "infer" and each.name not in arguments)
    return Attempted(arguments=shown, unset=unset, rejected=tuple(rejected), facts=facts)


def collect_facts_at_failure(
    tried: Sequence[Implementation], running: Activation | None, arguments: Mapping[str, Value], state: WorldState
) -> tuple[str, ...]:
    """Return the facts that the conditions of a call read: of the running implementation, else of all tried."""
    implementations = tried if running is None else (running.implementation,)
    conditions = [each.condition for one in implementations for each in (*one.pre, *one.hold)]
    conditions += [post.condition for post in (running.implementation.post if running is not None else ())]
    return facts_of(conditions, state, arguments if running is None else running.frame)
