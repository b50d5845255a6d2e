"""What a cell of a test needs to be its own back-end."""

from __future__ import annotations

from typing import Self

from skillc_runtime.devices.backend import DeviceStop


class NoStops:
    """Devices that never stop by themselves; implements `DeviceStops`."""

    report: DeviceStop | None = None

    def clear(self) -> None:
        """Do nothing."""


class OwnBackend:
    """The members of `Backend` that are the same for every cell that a test moves through time by itself."""

    broken: str | None = None
    stops = NoStops()

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
