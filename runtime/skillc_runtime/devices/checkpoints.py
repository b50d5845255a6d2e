"""The interface of a cell whose state can be saved, so that it is built again as it was."""

from __future__ import annotations

from typing import Protocol


class CheckpointError(ValueError):
    """The saved state of a cell cannot be read."""


class Checkpoints(Protocol):
    """Saves the state of a cell; what it returns is for `BackendStart.saved` of the same back end."""

    def save(self) -> bytes:
        """Return the true state of the cell, from which it can be built again with everything at rest."""
        ...

    def save_reported(self) -> bytes:
        """Return only what devices report of themselves, from which a twin of the cell is built."""
        ...
