"""Resolving bodies: the expressions, conditions and calls of nodes, and the scope after each node."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import assert_never

from msgspec import structs
from msgspec.structs import replace

from skillc_compiler.program.typed import TypedNode
from skillc_compiler.program.types import INT, TEXT, UNKNOWN, ListOf, Measure
from skillc_compiler.resolve.aggregates import resolve_every
from skillc_compiler.resolve.calls import resolve_call
from skillc_compiler.resolve.conditions import resolve_condition
from skillc_compiler.resolve.references import ExpectedType
from skillc_compiler.resolve.scope import FileContext, LocalName, Scope
from skillc_compiler.resolve.texts import resolve_message
from skillc_compiler.resolve.values import resolve_value
from skillc_dsl import syntax as s
from skillc_dsl.descriptions.rows import SlotKind
from skillc_dsl.units import TIME

SECONDS = ExpectedType(Measure(TIME))
EXPECTED: Mapping[SlotKind, ExpectedType] = {"count": ExpectedType(INT), "time": SECONDS}
"""What is expected in each kind of slot of a decorator."""


def resolve_node(context: FileContext, scope: Scope, written: s.Node) -> tuple[TypedNode, Scope]:
    """Return the typed node, and the scope after it."""
    match written:
        case s.Block():
            return _block(context, scope, written)
        case s.Decorator(children=children):
            slots = zip(written.slots, written.row.slots, strict=True)
            values = tuple(resolve_value(context, scope, value, EXPECTED[slot.kind]) for value, slot in slots)
            inner, after = _resolve_sequence(context, scope, children)
            return TypedNode(written, values, children=inner), after
        case s.Wait() | s.WaitUntil() | s.CheckNode() | s.Fail() | s.ApplyPosts():
            return _leaf(context, scope, written), scope
        case s.OnFailure() | s.Finally():
            return _ending(context, scope, written)
        case s.If():
            return _if(context, scope, written)
        case s.While(condition=condition, children=children):
            guard = resolve_condition(context, scope, condition)
            limit = resolve_value(context, scope, written.limit, EXPECTED["count"])
            inner, after = _resolve_sequence(context, scope, children)
            return TypedNode(written, (limit,), (guard,), children=inner), _merge_scopes(scope, after)
        case s.For():
            return _for(context, scope, written)
        case s.CallSkill():
            typed, after = resolve_call(context, scope, written)
            return TypedNode(written, call=typed), after
        case s.With(call=opening, children=children):
            typed, opened = resolve_call(context, scope, opening)
            inner, after = _resolve_sequence(context, opened, children)
            return TypedNode(written, call=typed, children=inner), after
        case _:
            assert_never(written)


def _leaf(
    context: FileContext, scope: Scope, written: s.Wait | s.WaitUntil | s.CheckNode | s.Fail | s.ApplyPosts
) -> TypedNode:
    match written:
        case s.Wait(time=time):
            return TypedNode(written, (resolve_value(context, scope, time, SECONDS),))
        case s.WaitUntil(condition=condition) | s.CheckNode(condition=condition):
            return TypedNode(written, conditions=(resolve_condition(context, scope, condition),))
        case s.Fail(message=message):
            return TypedNode(written, (resolve_message(context, scope, message, resolve_value),))
        case s.ApplyPosts():
            return TypedNode(written)
        case _:
            assert_never(written)


def _resolve_sequence(
    context: FileContext, scope: Scope, nodes: Sequence[s.Node]
) -> tuple[tuple[TypedNode, ...], Scope]:
    steps = []
    for node in nodes:
        typed, scope = resolve_node(context, scope, node)
        steps.append(typed)
    return tuple(steps), scope


def _block(context: FileContext, scope: Scope, written: s.Block) -> tuple[TypedNode, Scope]:
    if written.kind in ("seq", "reactive seq"):
        inner, after = _resolve_sequence(context, scope, written.children)
        return TypedNode(written, children=inner), after
    apart = [resolve_node(context, scope, child) for child in written.children]
    children = tuple(typed for typed, _ in apart)
    return TypedNode(written, children=children), _merge_scopes(scope, *(after for _, after in apart))


def _if(context: FileContext, scope: Scope, written: s.If) -> tuple[TypedNode, Scope]:
    guard = resolve_condition(context, scope, written.condition)
    then, after_then = _resolve_sequence(context, scope, written.then)
    otherwise, after_else = _resolve_sequence(context, scope, written.orelse or ())
    return TypedNode(written, conditions=(guard,), children=then, orelse=otherwise), _merge_scopes(
        after_then, after_else
    )


def _ending(context: FileContext, scope: Scope, written: s.OnFailure | s.Finally) -> tuple[TypedNode, Scope]:
    block, after = resolve_node(context, scope, written.node)
    if isinstance(written, s.Finally):
        last, done = _resolve_sequence(context, after, written.last)
        return TypedNode(written, children=(block,), orelse=last), done
    inner = scope
    if written.why is not None:
        why = LocalName(TEXT, "failure", written.why.span)
        inner = context.bind(scope, written.why, why)
    handler, handled = _resolve_sequence(context, inner, written.handler)
    names = {n: v for n, v in handled.variables.items() if n in scope.variables or n not in inner.variables}
    whole = TypedNode(written, children=(block,), orelse=handler)
    return whole, _merge_scopes(scope, after, replace(handled, variables=names))


def _for(context: FileContext, scope: Scope, written: s.For) -> tuple[TypedNode, Scope]:
    if isinstance(written.items, s.Every):
        items = resolve_every(context, scope, written.variable, written.items, resolve_value)
    else:
        items = resolve_value(context, scope, written.items, ExpectedType(ListOf(UNKNOWN)))
    element = items.type.element if isinstance(items.type, ListOf) else UNKNOWN
    bound = context.bind(scope, written.variable, LocalName(element, "loop variable", written.variable.span))
    inner, after = _resolve_sequence(context, bound, written.children)
    left = replace(after, variables={n: v for n, v in after.variables.items() if n != written.variable.text})
    return TypedNode(written, (items,), children=inner), _merge_scopes(scope, left)


def assume_outputs_assigned(scope: Scope) -> Scope:
    """Return the scope of a body, in which outputs may be read; the analysis proves whether they have a value."""
    return replace(scope, variables={name: structs.replace(v, is_assigned=True) for name, v in scope.variables.items()})


def _merge_scopes(*scopes: Scope) -> Scope:
    """Return a scope with the names of all."""
    merged = {name: variable for scope in reversed(scopes) for name, variable in scope.variables.items()}
    return replace(scopes[0], variables=merged)
