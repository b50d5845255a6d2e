"""Creates the events of calls and of the world model: selections with reasons, failures, changes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from skillc_model.skills import Implementation, Primitive, Skill
from skillc_model.tree import Call
from skillc_runtime.execution.selection.binding import bind_implementation
from skillc_runtime.execution.selection.binding_reasons import explain_bindings
from skillc_runtime.execution.selection.python_targets import import_primitive
from skillc_runtime.execution.selection.select import ranked_implementations
from skillc_runtime.execution.tree.calls.activation import Activation
from skillc_runtime.execution.tree.calls.argument_origins import EnclosingBody, explain_arguments
from skillc_runtime.execution.tree.context import TreeContext
from skillc_runtime.primitives.primitive import Phase
from skillc_runtime.recording.events import ImplementationChosen, WorldChanged
from skillc_runtime.recording.failure import Rejection
from skillc_runtime.recording.reasons import FailedCallContext, Highlight, UntriedImplementation
from skillc_runtime.world.eval.deciding_facts import deciding_facts
from skillc_runtime.world.state.labels.labelled import LabelledFact, LabelledIri, LabelledValue
from skillc_runtime.world.state.labels.labelling import label_bindings, label_change
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.transactions import ChangeEvent
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


def make_choice_event(
    node: int,
    call: Call,
    activation: Activation,
    arguments: Mapping[str, Value],
    rejected: Sequence[Rejection],
    body: EnclosingBody,
    context: TreeContext,
) -> ImplementationChosen:
    """Return the event for a call in a body that starts an implementation."""
    implementation = activation.implementation
    ranked = ranked_implementations(context.library, call.skill, call.implementation)
    after = ranked[ranked.index(implementation) + 1 :]
    bindings = label_bindings(activation.frame, implementation.parameters, context.library.vocabulary)
    own = implementation.body
    primitive = import_primitive(own.python) if isinstance(own, Primitive) else None
    return ImplementationChosen(
        time=context.time,
        node=node,
        skill=call.skill,
        implementation=implementation.name,
        bindings=bindings,
        rejected=tuple(rejected),
        determined=explain_bindings(activation.bound, arguments.keys(), context.state),
        untried=tuple(_make_untried(each, arguments, context.state) for each in after),
        fixed=call.implementation is not None,
        activity=primitive.activity if primitive else "",
        highlights=_highlights(primitive.highlights, bindings) if primitive else (),
        expressions=explain_arguments(call, implementation, bindings, activation.frame, body),
        out=call.out or "",
        source=implementation.source,
    )


def _highlights(
    declared: Sequence[tuple[Phase, str, str]], bindings: Mapping[str, LabelledValue]
) -> tuple[Highlight, ...]:
    """Return the highlights of the individuals that a primitive is bound to."""
    found = ((when, bindings.get(parameter), word) for when, parameter, word in declared)
    return tuple(Highlight(when, what, word) for when, what, word in found if isinstance(what, LabelledIri))


def _make_untried(
    implementation: Implementation, arguments: Mapping[str, Value], state: WorldState
) -> UntriedImplementation:
    try:
        bound = bind_implementation(implementation, arguments, state)
        reason = bound.reason if isinstance(bound, Rejection) else ""
    except EvaluationError as error:
        reason = str(error)
    return UntriedImplementation(implementation=implementation.name, source=implementation.source, reason=reason)


def make_failure_context(
    skill: Skill,
    arguments: Mapping[str, Value],
    rejected: Sequence[Rejection],
    facts: tuple[LabelledFact, ...],
    context: TreeContext,
) -> FailedCallContext:
    """Return the arguments, unset parameters, rejections and facts of a call that failed."""
    values = label_bindings(arguments, skill.parameters, context.library.vocabulary)
    unset = tuple(each.name for each in skill.parameters if each.direction == "infer" and each.name not in arguments)
    return FailedCallContext(arguments=values, unset=unset, rejected=tuple(rejected), facts=facts)


def label_outputs(activation: Activation, context: TreeContext) -> dict[str, LabelledValue]:
    """Return what a call that has succeeded returns, by parameter name."""
    outputs = tuple(each for each in activation.implementation.parameters if each.direction == "out")
    return label_bindings(activation.frame, outputs, context.library.vocabulary)


def collect_facts_at_failure(
    tried: Sequence[Implementation], running: Activation | None, arguments: Mapping[str, Value], state: WorldState
) -> tuple[LabelledFact, ...]:
    """Return the facts read by the conditions of a call: of the running implementation, else of all tried ones."""
    implementations = tried if running is None else (running.implementation,)
    conditions = [each.condition for one in implementations for each in (*one.pre, *one.hold)]
    if running is not None:
        conditions += [each.condition for each in running.implementation.post]
        conditions += [each.condition for each in running.skill.outcomes]
    return deciding_facts(conditions, state, arguments if running is None else running.frame)


def make_change_event(event: ChangeEvent, time: float) -> WorldChanged:
    """Return the event for a change of the world model; `time` is that of the cell's clock in s."""
    changes = tuple(label_change(change, event.after.vocabulary) for change in event.changes)
    return WorldChanged(time=time, origin=event.origin, changes=changes, known=event.evidence)
