"""A primitive that stands in for code still to be written, so that skills can be checked, planned and tried before."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.primitives.primitive import Primitive, Status

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell


class StandIn(Primitive):
    """Succeeds at once and moves nothing, whatever the parameters; the skill's posts are applied as ever."""

    def __init__(self, cell: Cell, **parameters: object) -> None:
        super().__init__(cell)

    def tick(self) -> Status:
        """Be done."""
        return Status.SUCCESS
