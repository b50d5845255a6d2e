"""`with`: the scoped skill is undone when the body ends for any reason."""

from __future__ import annotations

from typing import ClassVar

from skillc_model import tree
from skillc_runtime.execution.tree.context import TreeContext
from skillc_runtime.execution.tree.locks import Holders
from skillc_runtime.execution.tree.node import RUNNING, SUCCESS, Node
from skillc_runtime.execution.tree.nodes.sequence import foresee_steps
from skillc_runtime.execution.tree.undo_stack import UndoStack
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.failure import Failure


class WithNode(Node):
    """Runs the scoped call, then the body, then undoes the scoped skills of both, the last first."""

    kind: ClassVar[str] = "with"
    __slots__ = ("_current", "body", "call", "undo")

    def __init__(self, context: TreeContext, node: tree.With, call: Node, body: Node, undo: UndoStack) -> None:
        super().__init__(context, node.source, (call, body), f"with {call.name}")
        self.call = call
        self.body = body
        self.undo = undo

    def foresee(self, freed: Holders) -> Status:
        return foresee_steps(self.children, freed)

    def on_start(self) -> Status:
        self._current = self.call
        return self.on_child_ended(self.call.start())

    def active_leaf(self) -> Node:
        return self._current.active_leaf()

    def stop(self, reason: str) -> None:
        super().stop(reason)
        self._note(self.undo.unwind())

    def remains_satisfied(self) -> bool:
        return self.status is SUCCESS and self.body.remains_satisfied()

    def on_child_ended(self, status: Status) -> Status:
        if status is SUCCESS and self._current is self.call:
            self._current = self.body
            status = self.body.start()
        if status is RUNNING:
            return RUNNING
        problems = self.undo.unwind()
        self._note(problems)
        if status is SUCCESS and problems:
            message = f"{self.call.name} could not be undone: {'; '.join(problems)}"
            return self.fail(Failure(kind="error", message=message, source=self.source))
        return self.succeed() if status is SUCCESS else self.fail(self._current.failure)

    def _note(self, problems: tuple[str, ...]) -> None:
        for problem in problems:
            self.context.note(f"{self.call.name} could not be undone: {problem}", self.id, self.source)
