"""The primitives of a run that a pause concerns: those that run, and scoped ones that are not released yet."""

from __future__ import annotations

from skillc_runtime.primitives.primitive import Primitive
from skillc_runtime.world.state.python_calls import foreign_code


class ActivePrimitives:
    """The active primitives of a run, in the order in which they were started."""

    def __init__(self) -> None:
        self._started: tuple[Primitive, ...] = ()

    @property
    def is_pressing(self) -> bool:
        """Whether one of them presses a tool on something."""
        return any(primitive.activity == "press" for primitive in self._started)

    def add(self, primitive: Primitive) -> None:
        """Add a primitive that was started."""
        self._started = (*self._started, primitive)

    def discard(self, primitive: Primitive) -> None:
        """Remove a primitive, if it is there, that has ended or was released."""
        self._started = tuple(each for each in self._started if each is not primitive)

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
