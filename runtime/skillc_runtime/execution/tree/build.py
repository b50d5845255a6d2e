"""Builds runtime nodes from the nodes of the compiled library, with the values of the enclosing scope."""

from __future__ import annotations

from typing import assert_never

from msgspec.structs import replace

from skillc_model import tree
from skillc_runtime.execution.tree.calls.call_node import CallNode
from skillc_runtime.execution.tree.context import TreeContext
from skillc_runtime.execution.tree.lexical_scope import Frame, LexicalScope
from skillc_runtime.execution.tree.node import Node
from skillc_runtime.execution.tree.nodes.decorators import InvertNode, OnceNode, TimeoutNode, TryNode
from skillc_runtime.execution.tree.nodes.if_node import IfNode
from skillc_runtime.execution.tree.nodes.leaf_nodes import ApplyNode, CheckNode, WaitNode, WaitUntilNode
from skillc_runtime.execution.tree.nodes.loop_nodes import ForEachNode, RepeatNode, RetryNode, WhileNode
from skillc_runtime.execution.tree.nodes.parallel import (
    ParallelAll,
    ParallelAny,
    ParallelLead,
    ParallelNode,
    ParallelRace,
)
from skillc_runtime.execution.tree.nodes.selector import ReactiveSelectorNode, SelectorNode
from skillc_runtime.execution.tree.nodes.sequence import ReactiveSequenceNode, SequenceNode
from skillc_runtime.execution.tree.nodes.with_node import WithNode
from skillc_runtime.execution.tree.undo_stack import UndoStack

_PARALLEL: dict[str, type[ParallelNode]] = {
    "all": ParallelAll,
    "any": ParallelAny,
    "race": ParallelRace,
    "lead": ParallelLead,
}


def build_node(node: tree.Node, context: TreeContext, scope: LexicalScope) -> Node:
    """Return the runtime node for `node`; the body of a call is built when the call starts."""
    match node:
        case tree.Sequence() | tree.Selector() | tree.Parallel():
            return _build_composite(node, context, scope)
        case tree.Retry() | tree.Repeat() | tree.While() | tree.ForEach():
            return _build_loop(node, context, scope)
        case tree.Timeout() | tree.Try() | tree.Invert() | tree.Once():
            return _build_decorator(node, context, scope)
        case tree.Wait():
            return WaitNode(context, node, scope)
        case tree.WaitUntil():
            return WaitUntilNode(context, node, scope)
        case tree.Check():
            return CheckNode(context, node, scope)
        case tree.Apply():
            return ApplyNode(context, node, scope)
        case tree.If(then=then, orelse=orelse):
            otherwise = build_node(orelse, context, scope) if orelse is not None else None
            return IfNode(context, node, build_node(then, context, scope), otherwise, scope)
        case tree.Call():
            return CallNode(context, node, scope, build_node)
        case tree.With(call=call, child=child):
            inner = replace(scope, undo=UndoStack())
            scoped = CallNode(context, call, inner, build_node)
            return WithNode(context, node, scoped, build_node(child, context, inner), inner.undo)
        case _:
            assert_never(node)


def _build_composite(
    node: tree.Sequence | tree.Selector | tree.Parallel, context: TreeContext, scope: LexicalScope
) -> Node:
    children = tuple(build_node(child, context, scope) for child in node.children)
    match node:
        case tree.Sequence(reactive=reactive):
            return (ReactiveSequenceNode if reactive else SequenceNode)(context, node.source, children)
        case tree.Selector(reactive=reactive):
            return (ReactiveSelectorNode if reactive else SelectorNode)(context, node.source, children)
        case tree.Parallel(policy=policy):
            return _PARALLEL[policy](context, node.source, children)
        case _:
            assert_never(node)


def _build_loop(
    node: tree.Retry | tree.Repeat | tree.While | tree.ForEach, context: TreeContext, scope: LexicalScope
) -> Node:
    match node:
        case tree.Retry(child=child):
            return RetryNode(context, node, build_node(child, context, scope))
        case tree.Repeat(child=child):
            return RepeatNode(context, node, build_node(child, context, scope))
        case tree.While(child=child):
            return WhileNode(context, node, build_node(child, context, scope), scope)
        case tree.ForEach(child=child):
            inner: Frame = {}
            return ForEachNode(context, node, build_node(child, context, replace(scope, frame=inner)), scope, inner)
        case _:
            assert_never(node)


def _build_decorator(
    node: tree.Timeout | tree.Try | tree.Invert | tree.Once, context: TreeContext, scope: LexicalScope
) -> Node:
    match node:
        case tree.Timeout(child=child):
            return TimeoutNode(context, node, build_node(child, context, scope), scope)
        case tree.Try(child=child):
            return TryNode(context, node, build_node(child, context, scope))
        case tree.Invert(child=child):
            return InvertNode(context, node, build_node(child, context, scope))
        case tree.Once(child=child):
            return OnceNode(context, node, build_node(child, context, scope))
        case _:
            assert_never(node)
