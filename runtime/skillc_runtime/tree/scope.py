"""`with`: what the scoped skill set up is undone when the body ends, however it ends."""

from __future__ import annotations

from typing import ClassVar

from skillc_compiler.library import tree
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.failure import Failure
from skillc_runtime.tree.context import Context
from skillc_runtime.tree.node import RUNNING, SUCCESS, Node
from skillc_runtime.tree.undo import Undo


class WithNode(Node):
    """Runs the scoped call, then the body, then undoes all that scoped skills set up in either, the last first."""

    kind: ClassVar[str] = "with"
    __slots__ = ("_current", "body", "call", "undo")

    def __init__(self, context: Context, node: tree.With, call: Node, body: Node, undo: Undo) -> None:
        super().__init__(context, node.source, (call, body), f"with {call.name}")
        self.call = call
        self.body = body
        self.undo = undo

    def begin(self) -> Status:
        self._current = self.call
        return self.after(self.call.start())

    def lowest(self) -> Node:
        return self._current.lowest()

    def stop(self, reason: str) -> None:
        super().stop(reason)
        self._note(self.undo.unwind())

    def still(self) -> bool:
        return self.status is SUCCESS and self.body.still()

    def after(self, status: Status) -> Status:
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
        return self.end() if status is SUCCESS else self.fail(self._current.failure)

    def _note(self, problems: tuple[str, ...]) -> None:
        for problem in problems:
            self.context.note(f"{self.call.name} could not be undone: {problem}", self.id, self.source)
