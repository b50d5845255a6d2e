"""`if`: one of two branches."""

from __future__ import annotations

from typing import ClassVar

from skillc_compiler.library import tree
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.tree.context import Context
from skillc_runtime.tree.enclosing import Enclosing
from skillc_runtime.tree.node import RUNNING, SUCCESS, Node
from skillc_runtime.world.eval.conditions import evaluate


class IfNode(Node):
    """Chooses at start; a false condition without `else` succeeds."""

    kind: ClassVar[str] = "if"
    __slots__ = ("_chosen", "frame", "node", "orelse", "then")

    def __init__(self, context: Context, node: tree.If, then: Node, orelse: Node | None, enclosing: Enclosing) -> None:
        branches = (then,) if orelse is None else (then, orelse)
        super().__init__(context, node.source, branches, f"if {node.text}")
        self.node = node
        self.then = then
        self.orelse = orelse
        self.frame = enclosing.frame

    def begin(self) -> Status:
        self._chosen = self._branch()
        return self.end() if self._chosen is None else self.after(self._chosen.start())

    def lowest(self) -> Node:
        return self if self._chosen is None else self._chosen.lowest()

    def still(self) -> bool:
        return (
            self.status is SUCCESS and self._branch() is self._chosen and (self._chosen is None or self._chosen.still())
        )

    def _branch(self) -> Node | None:
        return self.then if evaluate(self.node.condition, self.context.state, self.frame) else self.orelse

    def after(self, status: Status) -> Status:
        if status is RUNNING or self._chosen is None:
            return status
        return self.end() if status is SUCCESS else self.fail(self._chosen.failure)
