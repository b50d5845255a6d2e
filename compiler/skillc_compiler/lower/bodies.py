"""From typed nodes to the behaviour tree of the library."""

from __future__ import annotations

from collections.abc import Sequence
from typing import assert_never

from skillc_compiler.program.typed import TypedNode
from skillc_dsl import syntax as s
from skillc_model import tree as t
from skillc_model.conditions import Condition, Expression, Literal
from skillc_model.rewriting import fold


def lower_node(node: TypedNode) -> t.Node:
    """Return the tree node of a typed node."""
    written = node.written
    source = written.span.start
    match written:
        case s.Block():
            return _lower_block(node, written)
        case s.Decorator():
            return _lower_decorator(node, written)
        case s.While(text=text):
            return t.While(_condition(node), text, _rounds(_value(node)), _lower_as_one(node.children, node), source)
        case s.For(variable=variable):
            return t.ForEach(variable.text, _value(node), _lower_as_one(node.children, node), source)
        case s.With():
            return t.With(_lower_call(node), _lower_as_one(node.children, node), source)
        case s.If(text=text, orelse=orelse):
            otherwise = None if orelse is None else _lower_as_one(node.orelse, node)
            return t.If(_condition(node), text, _lower_as_one(node.children, node), otherwise, source)
        case s.Wait() | s.WaitUntil() | s.CheckNode() | s.Fail() | s.ApplyPosts():
            return _lower_leaf(node, written)
        case s.CallSkill():
            return _lower_call(node)
        case s.OnFailure(why=why):
            handler = _lower_as_one(node.orelse, node)
            return t.OnFailure(lower_node(node.children[0]), None if why is None else why.text, handler, source)
        case s.Finally():
            return t.Finally(lower_node(node.children[0]), _lower_as_one(node.orelse, node), source)
        case _:
            assert_never(written)


def _lower_leaf(node: TypedNode, written: s.Wait | s.WaitUntil | s.CheckNode | s.Fail | s.ApplyPosts) -> t.Node:
    source = written.span.start
    match written:
        case s.Wait():
            return t.Wait(_value(node), source)
        case s.WaitUntil(text=text):
            return t.WaitUntil(_condition(node), text, source)
        case s.CheckNode(text=text):
            return t.Check(_condition(node), text, source)
        case s.Fail():
            return t.Fail(_value(node), source)
        case s.ApplyPosts(labels=labels):
            return t.Apply(tuple(label.text for label in labels), source)
        case _:
            assert_never(written)


def _lower_decorator(node: TypedNode, written: s.Decorator) -> t.Node:
    """Return the node with a number of rounds, or an expression of it or in seconds, for each slot."""
    values = {slot.field: fold(value.meaning) for slot, value in zip(written.row.slots, node.values, strict=True)}
    counts = {slot.field for slot in written.row.slots if slot.kind == "count"}
    slots = {name: _rounds(value) if name in counts else value for name, value in values.items()}
    child, source = _lower_as_one(node.children, node), written.span.start
    return t.DECORATORS[written.kind](**slots, child=child, source=source)


def _rounds(value: Expression) -> int | Expression:
    """Return a number of rounds, or the expression of one that is not known before a run."""
    return int(value.value) if isinstance(value, Literal) and isinstance(value.value, int) else value


def _lower_block(node: TypedNode, written: s.Block) -> t.Node:
    source = written.span.start
    match written.kind:
        case "seq" | "reactive seq":
            return t.Sequence(_lower_all(node), written.kind == "reactive seq", source)
        case "sel" | "reactive sel":
            return t.Selector(_lower_all(node), written.kind == "reactive sel", source)
        case "par all":
            return t.Parallel("all", _lower_all(node), source)
        case "par any":
            return t.Parallel("any", _lower_all(node), source)
        case "par race":
            return t.Parallel("race", _lower_all(node), source)
        case "par lead":
            return t.Parallel("lead", _lower_all(node), source)
        case _:
            assert_never(written.kind)


def _lower_all(node: TypedNode) -> tuple[t.Node, ...]:
    return tuple(lower_node(child) for child in node.children)


def _lower_as_one(children: Sequence[TypedNode], of: TypedNode) -> t.Node:
    """Return the only child, or several children as a sequence."""
    if len(children) == 1:
        return lower_node(children[0])
    return t.Sequence(tuple(lower_node(child) for child in children), False, of.written.span.start)


def _lower_call(node: TypedNode) -> t.Call:
    call = node.call
    assert call is not None and call.skill is not None, "calls of unknown skills are left out with their implementation"
    return t.Call(
        skill=call.skill.name,
        implementation=call.implementation,
        arguments={argument.name.text: fold(argument.value.meaning) for argument in call.values},
        out=call.out.text if call.out else None,
        source=call.written.span.start,
    )


def _value(node: TypedNode) -> Expression:
    return fold(node.values[0].meaning)


def _condition(node: TypedNode) -> Condition:
    return fold(node.conditions[0].meaning)
