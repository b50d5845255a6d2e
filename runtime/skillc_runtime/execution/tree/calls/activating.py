"""How an implementation starts for a call: its locks, its lets and its body."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import TypeAlias, assert_never

from skillc_model import tree
from skillc_model.skills import Compound, Declared, Implementation, Skill
from skillc_model.skills import Primitive as PythonBody
from skillc_runtime.execution.selection.binding import BoundImplementation
from skillc_runtime.execution.selection.python_targets import PrimitiveError, import_matching_primitive
from skillc_runtime.execution.tree.calls.activation import Activation, posts_hold
from skillc_runtime.execution.tree.calls.call_decision import bind_call
from skillc_runtime.execution.tree.calls.declared_run import DeclaredRun
from skillc_runtime.execution.tree.context import TreeContext
from skillc_runtime.execution.tree.lexical_scope import Frame, LexicalScope
from skillc_runtime.execution.tree.locks import Holders, LockingCall
from skillc_runtime.execution.tree.node import Node
from skillc_runtime.execution.tree.nodes.primitive_node import PrimitiveNode
from skillc_runtime.execution.tree.stand_ins import find_true_outcome
from skillc_runtime.primitives.primitive import Primitive, Status
from skillc_runtime.recording.failure import Rejection, Stage
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.state.python_calls import FOREIGN_ERRORS
from skillc_runtime.world.state.values import Value

BuildNode: TypeAlias = Callable[[tree.Node, TreeContext, LexicalScope], Node]


def bind_unlocked(
    context: TreeContext,
    skill: Skill,
    implementation: Implementation,
    arguments: Mapping[str, Value],
    holder: object,
    scope: LexicalScope,
    freed: Holders = frozenset(),
) -> BoundImplementation | Rejection:
    """Bind an implementation; `infer any` takes the first choice of which nothing would be locked by others, if any.

    The calls `freed` lock nothing. EvaluationError if a default, a condition or a hold cannot be evaluated.
    """

    def is_locked(bindings: Mapping[str, Value]) -> bool:
        used = find_used(skill, bindings)
        return context.locks.find_conflict(used, holder, scope.calls, freed) is not None

    bound = bind_call(implementation, arguments, context.state, scope.failures)
    if isinstance(bound, Rejection) or not bound.others or not is_locked(bound.bindings):
        return bound
    free = next((each for each in bound.others if not is_locked({**bound.bindings, **each})), None)
    return bound if free is None else bind_call(implementation, {**arguments, **free}, context.state, scope.failures)


def activate(
    context: TreeContext,
    skill: Skill,
    bound: BoundImplementation,
    holder: LockingCall,
    scope: LexicalScope,
    build: BuildNode,
) -> Activation | Rejection:
    """Acquire the locks, compute the lets and build the body; a rejection leaves nothing locked.

    Raises EvaluationError if a let cannot be evaluated.
    """
    conflict = context.locks.acquire(find_used(skill, bound.bindings), holder, scope.calls)
    if conflict is not None:
        individual, user = context.library.vocabulary.short(conflict.individual), conflict.user
        return _reject(bound.implementation, "lock", f"{individual} is in use by {user.describe(context.locks.run)}")
    try:
        body = _build_body(context, skill, bound, holder, scope, build)
    except PrimitiveError as error:
        context.locks.release(holder)
        return _reject(bound.implementation, "start", str(error))
    except FOREIGN_ERRORS:
        context.locks.release(holder)
        raise
    return Activation(context, skill, bound, holder, body, context.cell.world.ledger.count)


def foresee_implementation(
    context: TreeContext,
    skill: Skill,
    implementation: Implementation,
    arguments: Mapping[str, Value],
    holder: object,
    scope: LexicalScope,
    build: BuildNode,
    freed: Holders,
) -> Status | None:
    """Return how a call would begin with an implementation if the calls `freed` held no locks; nothing is started.

    None if the next one would be tried, or if others use what it needs.
    """
    try:
        bound = bind_unlocked(context, skill, implementation, arguments, holder, scope, freed)
        if isinstance(bound, Rejection):
            return None
        if context.locks.find_conflict(find_used(skill, bound.bindings), holder, scope.calls, freed) is not None:
            return None
        status = _build_body(context, skill, bound, holder, scope, build).dry_start(freed)
        if status is Status.SUCCESS and not posts_hold(bound.implementation, context.state, bound.bindings):
            status = Status.FAILURE
    except FOREIGN_ERRORS:  # the other implementations would be tried
        return None
    return None if status is Status.FAILURE and skill.fallback else status


def find_used(skill: Skill, bindings: Mapping[str, Value]) -> list[str]:
    """Return the individuals that a skill uses, as far as they are bound."""
    return [str(bindings[name]) for name in skill.uses if name in bindings]


def _build_body(
    context: TreeContext,
    skill: Skill,
    bound: BoundImplementation,
    holder: object,
    scope: LexicalScope,
    build: BuildNode,
) -> Node:
    """Compute the lets and build the body; nothing starts."""
    implementation, frame = bound.implementation, bound.bindings
    for let in implementation.lets:
        frame[let.name] = value_of(let.value, context.state, frame)
    match implementation.body:
        case Compound(node=node):
            calls, writes = (*scope.calls, holder), context.cell.world.ledger.count
            inside = LexicalScope(
                scope.undo, frame, implementation, calls, writes_at_start=writes, lets_read=context.state
            )
            return build(node, context, inside)
        case PythonBody(python=python):
            cls = import_matching_primitive(python, implementation.parameters)
            names = [p.name for p in implementation.parameters if p.direction != "out"]
            make = partial(cls, context.run_cell, **{name: frame.get(name) for name in names})
            undo, told = scope.undo if skill.scoped else None, partial(_tell_outcomes, make, context, skill, frame)
            return PrimitiveNode(context, implementation.source, python.partition(":")[2], told, undo)
        case Declared():
            claim = partial(DeclaredRun, context, skill, implementation, frame)
            undo, told = scope.undo if skill.scoped else None, partial(_tell_outcomes, claim, context, skill, frame)
            return PrimitiveNode(context, implementation.source, skill.name, told, undo)
        case _:
            assert_never(implementation.body)


def _tell_outcomes(make: Callable[[], Primitive], context: TreeContext, skill: Skill, frame: Frame) -> Primitive:
    """Return a new primitive that knows what may come of its skill."""
    primitive, state = make(), context.state
    possible = (each for each in skill.outcomes if evaluate(each.find_possibility(skill.senses), state, frame))
    primitive.outcomes = tuple(each.label for each in possible)
    true = find_true_outcome(skill.outcomes, state, frame)
    primitive.true_outcome = true if true in primitive.outcomes else ""
    return primitive


def _reject(implementation: Implementation, stage: Stage, reason: str) -> Rejection:
    return Rejection(implementation=implementation.name, stage=stage, reason=reason, source=implementation.source)
