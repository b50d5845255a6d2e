"""What a cell of a test needs to be its own back-end."""

from __future__ import annotations

from typing import Self

from skillc_runtime.devices.backend import NO_STOPS
from skillc_runtime.devices.capabilities import NO_CAPABILITIES, BackendCapabilities


class OwnBackend:
    """The members of `Backend` that are the same for every cell that a test moves through time by itself."""

    capabilities: BackendCapabilities = NO_CAPABILITIES
    broken: str | None = None
    stops = NO_STOPS

    @property
    def cell(self) -> Self:
        """The cell as skills see it."""
        return self

    @property
    def clock(self) -> Self:
        """The clock of the cell."""
        return self

    def close(self) -> None:
        """Do nothing: there are no threads."""
