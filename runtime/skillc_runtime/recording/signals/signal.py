"""What a signal is, and where samples go: files now, any other recording with one more `SignalSink`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, Protocol, TypeAlias

import msgspec

if TYPE_CHECKING:
    from skillc_runtime.motion.pose import Array

Origin: TypeAlias = Literal["truth", "sensor", "estimate", "command"]
"""What only the simulator knows; what a sensor says; what is computed from sensors; what is asked for."""


class Signal(msgspec.Struct, frozen=True, kw_only=True):
    """A column of samples: `DEVICE/ORIGIN/QUANTITY_UNIT`, with its unit and the frame of its axes, empty for none.

    `device` is the IRI of the device or the thing, empty for the clock.
    """

    column: str
    device: str
    origin: Origin
    unit: str
    frame: str
    description: str


CLOCK = Signal(column="time_s", device="", origin="truth", unit="s", frame="", description="time of the cell's clock")


class SignalSink(Protocol):
    """Takes samples."""

    def write(self, row: Array) -> None:
        """Take one sample (n,) of all signals, which the caller changes afterwards; NaN where a value is not known."""
        ...

    def close(self) -> None:
        """Complete what was written; idempotent."""
        ...
