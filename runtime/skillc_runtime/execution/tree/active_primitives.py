"""The primitives of a run that a pause concerns: those that run, and scoped ones that are not released yet."""

from __future__ import annotations

from msgspec.structs import replace

from skillc_runtime.devices.prompts import Prompt
from skillc_runtime.primitives.primitive import Primitive
from skillc_runtime.world.state.python_calls import foreign_code


class ActivePrimitives:
    """The active primitives of a run, in the order in which they were started."""

    def __init__(self) -> None:
        self._started: tuple[Primitive, ...] = ()
        self._nodes: dict[Primitive, int] = {}

    @property
    def prompts(self) -> tuple[Prompt, ...]:
        """What they ask operators, with the numbers of their nodes."""
        found: tuple[Prompt, ...] = ()
        for each in self._started:
            if each.prompt is not None:
                found = (*found, replace(each.prompt, id=self._nodes[each]))
        return found

    @property
    def only_ask(self) -> bool:
        """Whether all that goes on is that operators are asked."""
        return bool(self._started) and all(each.prompt is not None for each in self._started)

    def answer(self, node: int, choice: str) -> None:
        """Give the primitive of a node what an operator has chosen."""
        for primitive in self._started:
            if self._nodes[primitive] == node:
                with foreign_code:
                    primitive.answer(choice)

    @property
    def is_pressing(self) -> bool:
        """Whether one of them presses a tool on something."""
        with foreign_code:
            return any(primitive.is_pressing for primitive in self._started)

    def add(self, primitive: Primitive, node: int) -> None:
        """Add a primitive that was started by the node with this number."""
        self._started = (*self._started, primitive)
        self._nodes[primitive] = node

    def discard(self, primitive: Primitive) -> None:
        """Remove a primitive, if it is there, that has ended or was released."""
        self._started = tuple(each for each in self._started if each is not primitive)
        self._nodes.pop(primitive, None)

    def pause(self) -> None:
        """Pause all, the last started first."""
        for primitive in reversed(self._started):
            with foreign_code:
                primitive.pause()

    def withdraw(self) -> None:
        """Withdraw all, the last started first."""
        for primitive in reversed(self._started):
            with foreign_code:
                primitive.withdraw()

    def approach(self) -> Primitive | None:
        """Let each approach once those started before it have; return the first that has not yet, None if all have."""
        with foreign_code:
            return next((primitive for primitive in self._started if not primitive.approach()), None)

    def resume(self) -> None:
        """Resume all, in the order in which they were started."""
        for primitive in self._started:
            with foreign_code:
                primitive.resume()
