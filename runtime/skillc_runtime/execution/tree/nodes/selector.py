"""Selectors: run the children in order until one succeeds, with memory or reactively."""

from __future__ import annotations

from typing import ClassVar

from skillc_model import tree
from skillc_runtime.execution.tree.active_path import ActivePath
from skillc_runtime.execution.tree.context import TreeContext
from skillc_runtime.execution.tree.lexical_scope import LexicalScope
from skillc_runtime.execution.tree.locks import Holders
from skillc_runtime.execution.tree.node import FAILURE, RUNNING, SUCCESS, Node
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.failure import Failure


def combine_failures(node: Node) -> Failure:
    """Return the failure of a node whose children have all failed: its cause is that of the first that was tried."""
    failures = (child.failure for child in node.children if child.failure is not None)
    causes = tuple(sorted(failures, key=lambda each: each.is_unmet_need))
    message = causes[0].message if causes else "every alternative failed"
    return Failure(kind="body", message=message, source=node.source, causes=causes)


def foresee_alternatives(children: tuple[Node, ...], freed: Holders) -> Status:
    """Return how children that are tried in order would begin: as the first that would not fail at once."""
    for child in children:
        status = child.dry_start(freed)
        if status is not FAILURE:
            return status
    return FAILURE


class SelectorNode(Node):
    """A selector with memory: a child that failed is not tried again."""

    kind: ClassVar[str] = "sel"
    __slots__ = ("_current", "_index")

    def foresee(self, freed: Holders) -> Status:
        return foresee_alternatives(self.children, freed)

    def on_start(self) -> Status:
        self._index = -1
        return self.on_child_ended(FAILURE)

    def active_leaf(self) -> Node:
        return self._current.active_leaf()

    def remains_satisfied(self) -> bool:
        return self.status is SUCCESS and self._current.remains_satisfied()

    def on_child_ended(self, status: Status) -> Status:
        while status is FAILURE:
            self._index += 1
            if self._index == len(self.children):
                return self.fail(combine_failures(self))
            self._current = self.children[self._index]
            status = self._current.start()
        return RUNNING if status is RUNNING else self.succeed()


class OnFailureNode(Node):
    """Runs a block, and another one if it fails, which can read why."""

    kind: ClassVar[str] = "on failure"
    __slots__ = ("_current", "frame", "node", "skill")

    def __init__(
        self, context: TreeContext, node: tree.OnFailure, children: tuple[Node, Node], scope: LexicalScope
    ) -> None:
        super().__init__(context, node.source, children)
        self.node = node
        self.frame, self.skill = scope.frame, scope.skill

    def foresee(self, freed: Holders) -> Status:
        status = self.children[0].dry_start(freed)
        return RUNNING if status is FAILURE else status  # what is done then may read why

    def on_start(self) -> Status:
        self._current = self.children[0]
        return self.on_child_ended(self._current.start())

    def active_leaf(self) -> Node:
        return self._current.active_leaf()

    def remains_satisfied(self) -> bool:
        return self.status is SUCCESS and self._current.remains_satisfied()

    def on_child_ended(self, status: Status) -> Status:
        block, handler = self.children
        if status is FAILURE and self._current is block:
            self._tell(block.failure)
            self._current = handler
            status = handler.start()
        if status is not FAILURE:
            return RUNNING if status is RUNNING else self.succeed()
        causes = tuple(each.failure for each in (handler, block) if each.failure is not None)
        message = causes[0].message if causes else f"{self.name} failed"
        return self.fail(Failure(kind="body", message=message, source=self.source, causes=causes))

    def _tell(self, failure: Failure | None) -> None:
        """Give the block that follows the reason, as texts; a node that is in no call fails its own skill."""
        if failure is not None and self.node.why is not None:
            source = "" if failure.source is None else str(failure.source)
            told = (failure.message, failure.kind, failure.message, failure.skill or self.skill, source)
            self.frame.update(zip(tree.name_failure(self.node.why), told, strict=True))


class ReactiveSelectorNode(Node):
    """Looks in each tick whether a child before the one that runs could start, and lets the first such one take over.

    The child that runs is halted before the other starts. A child that failed although it could start takes over only
    after a tick in which it could not: else one that can only fail would halt what comes after it in each tick.
    """

    kind: ClassVar[str] = "reactive sel"
    __slots__ = ("_active", "_failed", "_path")

    def foresee(self, freed: Holders) -> Status:
        return foresee_alternatives(self.children, freed)

    def on_start(self) -> Status:
        self._failed: set[int] = set()
        return self._continue_with(self._start_child(0))

    def tick(self) -> Status:
        earlier = self._find_earlier() if self._active > 0 else None
        if earlier is not None:
            self._path.top.halt(f"{self.children[earlier].name}, which comes before it, can run")
            self.context.refresh_state()
            return self._continue_with(self._start_child(earlier))
        return self._continue_with(self._path.tick())

    def remains_satisfied(self) -> bool:
        return self.status is SUCCESS and self.children[self._active].remains_satisfied()

    def _find_earlier(self) -> int | None:
        """Return the first child before the one that runs that is to take over, if any."""
        freed = frozenset(self._path.top.descendants())
        for index in range(self._active):
            if self.children[index].dry_start(freed) is FAILURE:
                self._failed.discard(index)
            elif index not in self._failed:
                return index
        return None

    def _start_child(self, index: int) -> Status:
        self._active, self._path = index, ActivePath(self.children[index])
        return self._path.start()

    def _continue_with(self, status: Status) -> Status:
        """Continue after the active child was started or ticked."""
        while status is FAILURE:
            if self._path.top.dry_start(frozenset()) is not FAILURE:
                self._failed.add(self._active)
            if self._active + 1 == len(self.children):
                return self.fail(combine_failures(self))
            status = self._start_child(self._active + 1)
        return RUNNING if status is RUNNING else self.succeed()
