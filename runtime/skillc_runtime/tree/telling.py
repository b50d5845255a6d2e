"""What a call tells those who listen: its choice with the reasons, and what it met when it failed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from skillc_compiler.library.skills import Implementation, Skill
from skillc_runtime.selection.describe import bindings_text
from skillc_runtime.selection.determined import determined
from skillc_runtime.trace.events import ImplementationChosen
from skillc_runtime.trace.failure import Rejected
from skillc_runtime.trace.reasons import Attempted
from skillc_runtime.tree.activation import Activation
from skillc_runtime.tree.context import Context
from skillc_runtime.world.state import WorldState
from skillc_runtime.world.support import facts_of
from skillc_runtime.world.values import Value


def chosen(
    node: int,
    skill: Skill,
    activation: Activation,
    arguments: Mapping[str, Value],
    rejected: Sequence[Rejected],
    context: Context,
) -> ImplementationChosen:
    """Return the event that a call starts with an implementation."""
    implementation = activation.implementation
    return ImplementationChosen(
        time=context.time,
        node=node,
        skill=skill.name,
        implementation=implementation.name,
        bindings=bindings_text(activation.frame, implementation.parameters, context.library.vocabulary),
        rejected=tuple(rejected),
        determined=determined(activation.fitted, arguments.keys(), context.state),
        source=implementation.source,
    )


def attempted(
    skill: Skill, arguments: Mapping[str, Value], rejected: Sequence[Rejected], facts: tuple[str, ...], context: Context
) -> Attempted:
    """Return what a call that failed had."""
    shown = bindings_text(arguments, skill.parameters, context.library.vocabulary)
    return Attempted(arguments=shown, rejected=tuple(rejected), facts=facts)


def facts_at_failure(
    tried: Sequence[Implementation], running: Activation | None, arguments: Mapping[str, Value], state: WorldState
) -> tuple[str, ...]:
    """Return the facts that the conditions of a call read: of the implementation that runs, else of all tried."""
    implementations = tried if running is None else (running.implementation,)
    conditions = [each.condition for one in implementations for each in (*one.pre, *one.hold)]
    conditions += [post.condition for post in (running.implementation.post if running is not None else ())]
    return facts_of(conditions, state, arguments if running is None else running.frame)
