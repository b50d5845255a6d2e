"""Builds runtime nodes from the nodes of the compiled library, with the values of the enclosing scope."""

from __future__ import annotations

from collections.abc import Callable
from typing import assert_never

from msgspec.structs import replace

from skillc_model import tree
from skillc_runtime.execution.tree.calls.call_node import CallNode
from skillc_runtime.execution.tree.context import TreeContext
from skillc_runtime.execution.tree.lexical_scope import Frame, LexicalScope
from skillc_runtime.execution.tree.node import Node
from skillc_runtime.execution.tree.nodes.decorators import DECORATORS
from skillc_runtime.execution.tree.nodes.if_node import IfNode
from skillc_runtime.execution.tree.nodes.leaf_nodes import ApplyNode, CheckNode, FailNode, WaitNode, WaitUntilNode
from skillc_runtime.execution.tree.nodes.loop_nodes import ForEachNode, WhileNode
from skillc_runtime.execution.tree.nodes.parallel import (
    ParallelAll,
    ParallelAny,
    ParallelInOrder,
    ParallelLead,
    ParallelNode,
    ParallelRace,
)
from skillc_runtime.execution.tree.nodes.selector import OnFailureNode, ReactiveSelectorNode, SelectorNode
from skillc_runtime.execution.tree.nodes.sequence import FinallyNode, ReactiveSequenceNode, SequenceNode
from skillc_runtime.execution.tree.nodes.with_node import WithNode
from skillc_runtime.execution.tree.undo_stack import UndoStack

_PARALLEL: dict[str, type[ParallelNode]] = {
    "all": ParallelAll,
    "any": ParallelAny,
    "race": ParallelRace,
    "lead": ParallelLead,
}

_LEAVES: dict[type[tree.Node], Callable[..., Node]] = {
    tree.Wait: WaitNode,
    tree.WaitUntil: WaitUntilNode,
    tree.Check: CheckNode,
    tree.Fail: FailNode,
    tree.Apply: ApplyNode,
}


def build_node(node: tree.Node, context: TreeContext, scope: LexicalScope) -> Node:
    """Return the runtime node for `node`; the body of a call is built when the call starts."""
    match node:
        case tree.Sequence() | tree.Selector() | tree.Parallel():
            return _build_composite(node, context, scope)
        case tree.While(child=child):
            return WhileNode(context, node, build_node(child, context, scope), scope)
        case tree.ForEach(child=child):
            frame: Frame = {}
            return ForEachNode(context, node, build_node(child, context, replace(scope, frame=frame)), scope, frame)
        case tree.Wait() | tree.WaitUntil() | tree.Check() | tree.Fail() | tree.Apply():
            return _LEAVES[type(node)](context, node, scope)
        case tree.If(then=then, orelse=orelse):
            otherwise = build_node(orelse, context, scope) if orelse is not None else None
            return IfNode(context, node, build_node(then, context, scope), otherwise, scope)
        case tree.OnFailure(child=child, handler=handler):
            pair = (build_node(child, context, scope), build_node(handler, context, scope))
            return OnFailureNode(context, node, pair, scope)
        case tree.Finally(child=child, last=last):
            return FinallyNode(context, node.source, tuple(build_node(each, context, scope) for each in (child, last)))
        case tree.Call():
            return CallNode(context, node, scope, build_node)
        case tree.With(call=call, child=child):
            inner = replace(scope, undo=UndoStack())
            scoped = CallNode(context, call, inner, build_node)
            return WithNode(context, node, scoped, build_node(child, context, inner), inner.undo)
        case _:
            return DECORATORS[type(node)](context, node, build_node(node.child, context, scope), scope)


def _build_composite(
    node: tree.Sequence | tree.Selector | tree.Parallel, context: TreeContext, scope: LexicalScope
) -> Node:
    children = tuple(build_node(child, context, scope) for child in node.children)
    match node:
        case tree.Sequence(reactive=reactive):
            return (ReactiveSequenceNode if reactive else SequenceNode)(context, node.source, children)
        case tree.Selector(reactive=reactive):
            return (ReactiveSelectorNode if reactive else SelectorNode)(context, node.source, children)
        case tree.Parallel(after=after) if after:
            return ParallelInOrder(context, node.source, children, after)
        case tree.Parallel(policy=policy):
            return _PARALLEL[policy](context, node.source, children)
        case _:
            assert_never(node)
