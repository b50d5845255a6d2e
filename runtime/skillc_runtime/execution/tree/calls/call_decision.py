"""What a call would run: its arguments, and whether an implementation can be bound. Nothing here has side effects."""

from __future__ import annotations

from collections.abc import Mapping

from skillc_model import tree
from skillc_model.conditions import Variable
from skillc_model.skills import Implementation
from skillc_runtime.execution.selection.binding import BoundImplementation, bind_implementation, check_requirements
from skillc_runtime.execution.tree.lexical_scope import CallFailures, Frame, LexicalScope
from skillc_runtime.recording.failure import Rejection
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


def evaluate_arguments(call: tree.Call, scope: LexicalScope, state: WorldState) -> Frame:
    """Evaluate the arguments; an argument that is an unset optional parameter of the enclosing skill is omitted."""
    frame = scope.frame
    unset = {
        name
        for name, value in call.arguments.items()
        if isinstance(value, Variable) and value.name not in frame and scope.is_optional(value.name)
    }
    given = {name: value for name, value in call.arguments.items() if name not in unset}
    return {name: value_of(value, state, frame) for name, value in given.items()}


def bind_call(
    implementation: Implementation, arguments: Mapping[str, Value], state: WorldState, failures: CallFailures | None
) -> BoundImplementation | Rejection:
    """Bind an implementation unless it would only repeat a failure, or a precondition or hold is false.

    EvaluationError if a default, a condition or a hold cannot be evaluated.
    """
    repeated = _reject_repeated(implementation, arguments, state, failures)
    if repeated is not None:
        return repeated
    bound = bind_implementation(implementation, arguments, state)
    if isinstance(bound, Rejection):
        return bound
    return check_requirements(implementation, implementation.hold, "hold", bound.bindings, state) or bound


def _reject_repeated(
    implementation: Implementation, arguments: Mapping[str, Value], state: WorldState, failures: CallFailures | None
) -> Rejection | None:
    """Reject an implementation that failed in an earlier attempt and can only fail again."""
    name = implementation.name
    earlier = failures and failures.find_repeated(implementation.skill, arguments, name, state)
    if not earlier:
        return None
    reason = f"it has failed, and nothing that it depends on has changed since: {earlier.message}"
    return Rejection(implementation=name, stage="run", reason=reason, source=implementation.source, failure=earlier)
