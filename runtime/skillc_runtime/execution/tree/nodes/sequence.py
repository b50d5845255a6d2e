"""Sequences: run the children in order until one fails, with memory or reactively."""

from __future__ import annotations

from typing import ClassVar

from skillc_runtime.execution.tree.active_path import ActivePath
from skillc_runtime.execution.tree.locks import Holders
from skillc_runtime.execution.tree.node import RUNNING, SUCCESS, Node
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.world.state.python_calls import FOREIGN_ERRORS


def foresee_steps(children: tuple[Node, ...], freed: Holders) -> Status:
    """Return how children that run one after the other would begin: as the first that would not succeed at once."""
    for child in children:
        status = child.dry_start(freed)
        if status is not SUCCESS:
            return status
    return SUCCESS


class SequenceNode(Node):
    """A sequence with memory: a child that succeeded is not ticked again."""

    kind: ClassVar[str] = "seq"
    __slots__ = ("_current", "_index")

    def foresee(self, freed: Holders) -> Status:
        return foresee_steps(self.children, freed)

    def on_start(self) -> Status:
        self._index = -1
        return self.on_child_ended(SUCCESS)

    def active_leaf(self) -> Node:
        return self._current.active_leaf()

    def remains_satisfied(self) -> bool:
        return self.status is SUCCESS and all(child.remains_satisfied() for child in self.children)

    def on_child_ended(self, status: Status) -> Status:
        while status is SUCCESS:
            self._index += 1
            if self._index == len(self.children):
                return self.succeed()
            self._current = self.children[self._index]
            status = self._current.start()
        return RUNNING if status is RUNNING else self.fail(self._current.failure)


class FinallyNode(Node):
    """Runs a block, then what is done at the end; ends as the block did, unless it is halted before that."""

    kind: ClassVar[str] = "finally"
    __slots__ = ("_current",)

    def foresee(self, freed: Holders) -> Status:
        block, last = (child.dry_start(freed) for child in self.children)
        return RUNNING if block is SUCCESS and last is RUNNING else block

    def on_start(self) -> Status:
        self._current = self.children[0]
        return self.on_child_ended(self._current.start())

    def active_leaf(self) -> Node:
        return self._current.active_leaf()

    def remains_satisfied(self) -> bool:
        return self.status is SUCCESS and self.children[0].remains_satisfied()

    def on_child_ended(self, status: Status) -> Status:
        block, last = self.children
        if status is not RUNNING and self._current is block:
            self._current = last
            status = last.start()
        if status is RUNNING:
            return RUNNING
        if last.failure is not None:
            self.context.note(f"at the end: {last.failure.message}", last.id, last.source)
        return self.succeed() if block.status is SUCCESS else self.fail(block.failure)


class ReactiveSequenceNode(Node):
    """Looks in each tick whether the results of all children before the one that runs are still valid.

    The first whose result is not runs again, after the child that ran was halted; those after it then start afresh.
    """

    kind: ClassVar[str] = "reactive seq"
    __slots__ = ("_active", "_done", "_path")

    def foresee(self, freed: Holders) -> Status:
        return foresee_steps(self.children, freed)

    def on_start(self) -> Status:
        self._done = [False] * len(self.children)
        return self._continue_with(self._start_child(0))

    def tick(self) -> Status:
        try:
            earlier = self._find_outdated(0, self._active)
            if earlier == self._active:
                return self._continue_with(self._path.tick())
            self._path.top.halt(f"{self.children[earlier].name}, which comes before it, runs again")
            self.context.refresh_state()
            return self._continue_with(self._start_child(earlier))
        except FOREIGN_ERRORS as error:  # a node is the boundary: it reports, halts and fails
            return self.fail_with_error(error)

    def remains_satisfied(self) -> bool:
        return self.status is SUCCESS and all(child.remains_satisfied() for child in self.children)

    def _start_child(self, index: int) -> Status:
        self._active, self._path, self._done[index] = index, ActivePath(self.children[index]), False
        return self._path.start()

    def _continue_with(self, status: Status) -> Status:
        """Continue after the active child was started or ticked."""
        while status is SUCCESS:
            self._done[self._active] = True
            following = self._find_outdated(self._active + 1, len(self.children))
            if following == len(self.children):
                return self.succeed()
            status = self._start_child(following)
        return RUNNING if status is RUNNING else self.fail(self._path.top.failure)

    def _find_outdated(self, first: int, end: int) -> int:
        """Return the first child from `first` on that has no valid result; `end` if all before that have one."""
        outdated = (
            index for index in range(first, end) if not (self._done[index] and self.children[index].remains_satisfied())
        )
        return next(outdated, end)
