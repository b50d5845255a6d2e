"""What a running tree is made of: outcomes, nodes with their memory, and the leaves that a test provides."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, NamedTuple
from xml.etree.ElementTree import Element

Blackboard = dict[str, object]


class Outcome(NamedTuple):
    """How a node ended in a tick; None in place of it means that it still runs."""

    ok: bool
    hold: bool = False


class Stage:
    """What the leaves of a tree do: overridden by the test."""

    now = 0.0

    def action(self, path: tuple[str, ...], values: Blackboard) -> Callable[[], Outcome | None]:
        """Start an action; the function returned advances it by a tick."""
        raise NotImplementedError

    def found(self, path: tuple[str, ...]) -> Blackboard:
        """Return what the action that ended last under this path puts out."""
        return {}

    def halt(self, path: tuple[str, ...], values: Blackboard) -> None:
        """Halt an action that runs, by the values that it was started with."""

    def undo(self, path: tuple[str, ...], values: Blackboard) -> None:
        """Undo what a scoped skill set up."""

    def holds(self, path: tuple[str, ...], source: str, values: Blackboard) -> bool:
        """Say whether a condition holds."""
        raise NotImplementedError


@dataclass
class Node:
    """A node of an instantiated tree."""

    element: Element
    children: list[Node]
    board: Blackboard
    player: Any
    running: bool = False
    state: Blackboard = field(default_factory=dict)

    def tick(self) -> Outcome | None:
        """Advance the node; its memory is lost once it has ended."""
        if not self.running:
            self.state.clear()
        outcome = self.player.ticked(self)
        self.running = outcome is None
        if outcome is not None:
            self.player.script(self.element.get("_onSuccess" if outcome.ok else "_onFailure"), self.board)
        return outcome

    def halt(self) -> None:
        """Stop what runs below."""
        if self.running:
            self.running = False
            for child in self.children:
                child.halt()
            self.player.halted(self)
