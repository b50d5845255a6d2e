"""What keeps the world model from telling where something is."""

from __future__ import annotations

from skillc_runtime.world.foreign import Unknown


class FrameError(ValueError):
    """A pose that the world model does not hold; the message says of what and why."""


class Unplaced(FrameError, Unknown):
    """Nothing is wrong, but not enough is said to tell where a thing is, or how large."""


class MissingFact(Unplaced):
    """A number that `individual` lacks: its `property`, an IRI."""

    def __init__(self, message: str, individual: str, property_: str) -> None:
        super().__init__(message)
        self.individual, self.property = individual, property_
