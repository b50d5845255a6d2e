"""The tree of a run: all nodes of its bodies, also those that have not started, numbered as in its events."""

from __future__ import annotations

import msgspec

from skillc_dsl.position import Position


class TreeNode(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """A node of a tree; the events about it have its `id`. `parent` is 0 for the root of an attempt.

    `attempt` counts plans from 1. A call has a `skill`, with the `arguments` that a planner or the text has given it by
    name, and once it has started the `implementation` that it chose.
    """

    id: int
    parent: int
    attempt: int
    kind: str
    label: str
    source: Position
    skill: str = ""
    implementation: str = ""
    arguments: dict[str, str] = {}


class OperationTree(msgspec.Struct, frozen=True):
    """The nodes of a run after its event `sequence`, each after its parent; later events start and end them."""

    sequence: int
    nodes: tuple[TreeNode, ...]
