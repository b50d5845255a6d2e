"""From a library's nodes to nodes that run, grounded in the frame of the body they stand in."""

from __future__ import annotations

from dataclasses import replace
from typing import assert_never

from skillc_compiler.library import tree
from skillc_runtime.tree.branch import IfNode
from skillc_runtime.tree.call import CallNode
from skillc_runtime.tree.context import Context
from skillc_runtime.tree.decorators import InvertNode, OnceNode, TimeoutNode, TryNode
from skillc_runtime.tree.enclosing import Enclosing, Frame
from skillc_runtime.tree.leaves import ApplyNode, CheckNode, WaitNode, WaitUntilNode
from skillc_runtime.tree.loops import ForEachNode, RepeatNode, RetryNode, WhileNode
from skillc_runtime.tree.node import Node
from skillc_runtime.tree.parallel import ParallelAll, ParallelAny, ParallelLead, ParallelNode, ParallelRace
from skillc_runtime.tree.scope import WithNode
from skillc_runtime.tree.selector import ReactiveSelectorNode, SelectorNode
from skillc_runtime.tree.sequence import ReactiveSequenceNode, SequenceNode
from skillc_runtime.tree.undo import Undo

_PARALLEL: dict[str, type[ParallelNode]] = {
    "all": ParallelAll,
    "any": ParallelAny,
    "race": ParallelRace,
    "lead": ParallelLead,
}


def build(node: tree.Node, context: Context, enclosing: Enclosing) -> Node:
    """Return the node that runs `node`; the bodies of calls are built when they start."""
    match node:
        case tree.Sequence() | tree.Selector() | tree.Parallel():
            return _several(node, context, enclosing)
        case tree.Retry() | tree.Repeat() | tree.While() | tree.ForEach():
            return _loop(node, context, enclosing)
        case tree.Timeout() | tree.Try() | tree.Invert() | tree.Once():
            return _decorator(node, context, enclosing)
        case tree.Wait():
            return WaitNode(context, node, enclosing)
        case tree.WaitUntil():
            return WaitUntilNode(context, node, enclosing)
        case tree.Check():
            return CheckNode(context, node, enclosing)
        case tree.Apply():
            return ApplyNode(context, node, enclosing)
        case tree.If(then=then, orelse=orelse):
            otherwise = build(orelse, context, enclosing) if orelse is not None else None
            return IfNode(context, node, build(then, context, enclosing), otherwise, enclosing)
        case tree.Call():
            return CallNode(context, node, enclosing, build)
        case tree.With(call=call, child=child):
            inner = replace(enclosing, undo=Undo())
            scoped = CallNode(context, call, inner, build)
            return WithNode(context, node, scoped, build(child, context, inner), inner.undo)
        case _:
            assert_never(node)


def _several(node: tree.Sequence | tree.Selector | tree.Parallel, context: Context, enclosing: Enclosing) -> Node:
    children = tuple(build(child, context, enclosing) for child in node.children)
    match node:
        case tree.Sequence(reactive=reactive):
            return (ReactiveSequenceNode if reactive else SequenceNode)(context, node.source, children)
        case tree.Selector(reactive=reactive):
            return (ReactiveSelectorNode if reactive else SelectorNode)(context, node.source, children)
        case tree.Parallel(policy=policy):
            return _PARALLEL[policy](context, node.source, children)
        case _:
            assert_never(node)


def _loop(node: tree.Retry | tree.Repeat | tree.While | tree.ForEach, context: Context, enclosing: Enclosing) -> Node:
    match node:
        case tree.Retry(child=child):
            return RetryNode(context, node, build(child, context, enclosing))
        case tree.Repeat(child=child):
            return RepeatNode(context, node, build(child, context, enclosing))
        case tree.While(child=child):
            return WhileNode(context, node, build(child, context, enclosing), enclosing)
        case tree.ForEach(child=child):
            inner: Frame = {}
            return ForEachNode(context, node, build(child, context, replace(enclosing, frame=inner)), enclosing, inner)
        case _:
            assert_never(node)


def _decorator(node: tree.Timeout | tree.Try | tree.Invert | tree.Once, context: Context, enclosing: Enclosing) -> Node:
    match node:
        case tree.Timeout(child=child):
            return TimeoutNode(context, node, build(child, context, enclosing), enclosing)
        case tree.Try(child=child):
            return TryNode(context, node, build(child, context, enclosing))
        case tree.Invert(child=child):
            return InvertNode(context, node, build(child, context, enclosing))
        case tree.Once(child=child):
            return OnceNode(context, node, build(child, context, enclosing))
        case _:
            assert_never(node)
