"""The nodes that a body has once it is built, with their numbers, before any of them starts."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from skillc_dsl.position import Position
from skillc_model import tree
from skillc_model.skills import SkillLibrary
from skillc_runtime.execution.tree.build import build_node
from skillc_runtime.execution.tree.calls.call_node import CallNode
from skillc_runtime.execution.tree.context import TreeContext
from skillc_runtime.execution.tree.lexical_scope import LexicalScope
from skillc_runtime.execution.tree.node import Node
from skillc_runtime.execution.tree.undo_stack import UndoStack


@dataclass(frozen=True, slots=True)
class OutlinedNode:
    """A node with the number of its parent, 0 for the root of a body. `call` is what a node of this kind calls."""

    id: int
    parent: int
    kind: str
    name: str
    source: Position
    call: tree.Call | None


class _Numbering(TreeContext):
    """Numbers nodes that are built, and never started: without a cell, a clock or a world."""

    def __init__(self, library: SkillLibrary, ids: int) -> None:
        self.library, self.last_id = library, ids


def outline_body(body: tree.Node, library: SkillLibrary, nodes_before: int = 0) -> tuple[OutlinedNode, ...]:
    """Return the nodes of a body in the order of the tree, numbered from `nodes_before` + 1 as a run numbers them.

    The root has the highest number. The bodies of calls are built when these start, so they are not among them.
    """
    root = build_node(body, _Numbering(library, nodes_before), LexicalScope(UndoStack()))
    return tuple(_list_nodes(root, 0))


def _list_nodes(node: Node, parent: int) -> Iterator[OutlinedNode]:
    call = node.node if isinstance(node, CallNode) else None
    yield OutlinedNode(node.id, parent, node.kind, node.name, node.source, call)
    for child in node.children:
        yield from _list_nodes(child, node.id)
