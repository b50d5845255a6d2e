"""From understood nodes to the library's tree."""

from __future__ import annotations

from collections.abc import Sequence
from typing import assert_never

from skillc_compiler.logic.rounds import count_rounds
from skillc_compiler.program.typed import TypedNode, position
from skillc_dsl import syntax as s
from skillc_model import tree as t
from skillc_model.conditions import Condition, Expression
from skillc_model.rewriting import fold


def node(step: TypedNode) -> t.Node:
    """Return the tree node that a step stands for."""
    written = step.written
    source = position(written.span)
    match written:
        case s.Block():
            return _block(step, written)
        case s.Counted() | s.Timeout() | s.While() | s.For() | s.With():
            return _around(step, written)
        case s.If(text=text, orelse=orelse):
            otherwise = None if orelse is None else _together(step.orelse, step)
            return t.If(_condition(step), text, _together(step.children, step), otherwise, source)
        case s.Wait():
            return t.Wait(_value(step), source)
        case s.WaitUntil(text=text):
            return t.WaitUntil(_condition(step), text, source)
        case s.CheckNode(text=text):
            return t.Check(_condition(step), text, source)
        case s.ApplyPosts(labels=labels):
            return t.Apply(tuple(label.text for label in labels), source)
        case s.CallSkill():
            return _call(step)
        case _:
            assert_never(written)


def _around(step: TypedNode, written: s.Counted | s.Timeout | s.While | s.For | s.With) -> t.Node:
    source = position(written.span)
    child = _together(step.children, step)
    match written:
        case s.Counted(kind="retry", count=count):
            return t.Retry(count_rounds(count), child, source)
        case s.Counted(count=count):
            return t.Repeat(count_rounds(count), child, source)
        case s.Timeout():
            return t.Timeout(_value(step), child, source)
        case s.While(text=text, limit=limit):
            return t.While(_condition(step), text, count_rounds(limit), child, source)
        case s.For(variable=variable):
            return t.ForEach(variable.text, _value(step), child, source)
        case s.With():
            return t.With(_call(step), child, source)
        case _:
            assert_never(written)


def _block(step: TypedNode, written: s.Block) -> t.Node:
    source = position(written.span)
    match written.kind:
        case "seq" | "reactive seq":
            return t.Sequence(_nodes(step), written.kind == "reactive seq", source)
        case "sel" | "reactive sel":
            return t.Selector(_nodes(step), written.kind == "reactive sel", source)
        case "par all":
            return t.Parallel("all", _nodes(step), source)
        case "par any":
            return t.Parallel("any", _nodes(step), source)
        case "par race":
            return t.Parallel("race", _nodes(step), source)
        case "par lead":
            return t.Parallel("lead", _nodes(step), source)
        case "try":
            return t.Try(_together(step.children, step), source)
        case "invert":
            return t.Invert(_together(step.children, step), source)
        case "once":
            return t.Once(_together(step.children, step), source)
        case _:
            assert_never(written.kind)


def _nodes(step: TypedNode) -> tuple[t.Node, ...]:
    return tuple(node(child) for child in step.children)


def _together(children: Sequence[TypedNode], of: TypedNode) -> t.Node:
    """Return the one child, or several as a sequence."""
    if len(children) == 1:
        return node(children[0])
    return t.Sequence(tuple(node(child) for child in children), False, position(of.written.span))


def _call(step: TypedNode) -> t.Call:
    call = step.call
    assert call is not None and call.skill is not None, "calls of unknown skills are left out with their implementation"
    return t.Call(
        skill=call.skill.name,
        implementation=call.implementation,
        arguments={argument.name.text: fold(argument.value.meaning) for argument in call.arguments},
        out=call.out.text if call.out else None,
        source=position(call.written.span),
    )


def _value(step: TypedNode) -> Expression:
    return fold(step.values[0].meaning)


def _condition(step: TypedNode) -> Condition:
    return fold(step.clauses[0].meaning)
