"""`if`: one of two branches."""

from __future__ import annotations

from typing import ClassVar

from skillc_model import tree
from skillc_runtime.execution.tree.context import TreeContext
from skillc_runtime.execution.tree.lexical_scope import LexicalScope
from skillc_runtime.execution.tree.locks import Holders
from skillc_runtime.execution.tree.node import RUNNING, SUCCESS, Node
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.world.eval.conditions import evaluate


class IfNode(Node):
    """Chooses a branch when it starts; succeeds if the condition is false and there is no `else`."""

    kind: ClassVar[str] = "if"
    __slots__ = ("_chosen", "frame", "node", "orelse", "then")

    def __init__(
        self, context: TreeContext, node: tree.If, then: Node, orelse: Node | None, scope: LexicalScope
    ) -> None:
        branches = (then,) if orelse is None else (then, orelse)
        super().__init__(context, node.source, branches, f"if {node.text}")
        self.node = node
        self.then = then
        self.orelse = orelse
        self.frame = scope.frame

    def foresee(self, freed: Holders) -> Status:
        branch = self._branch()
        return SUCCESS if branch is None else branch.dry_start(freed)

    def on_start(self) -> Status:
        self._chosen = self._branch()
        return self.succeed() if self._chosen is None else self.on_child_ended(self._chosen.start())

    def active_leaf(self) -> Node:
        return self if self._chosen is None else self._chosen.active_leaf()

    def remains_satisfied(self) -> bool:
        return (
            self.status is SUCCESS
            and self._branch() is self._chosen
            and (self._chosen is None or self._chosen.remains_satisfied())
        )

    def _branch(self) -> Node | None:
        return self.then if evaluate(self.node.condition, self.context.state, self.frame) else self.orelse

    def on_child_ended(self, status: Status) -> Status:
        if status is RUNNING or self._chosen is None:
            return status
        return self.succeed() if status is SUCCESS else self.fail(self._chosen.failure)
