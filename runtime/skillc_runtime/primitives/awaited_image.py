"""Waits until the inspection camera has what is there now."""

from __future__ import annotations

from skillc_runtime.devices.cell import Cell
from skillc_runtime.devices.device_map import NoSuchDevice
from skillc_runtime.primitives.primitive import SkillFailure
from skillc_runtime.world.state.labels.labelled import LabelledQuantity

WAIT_S = 5.0


class AwaitedImage:
    """What an inspection needs first: an image that was taken after the arm has come to rest."""

    def __init__(self, cell: Cell) -> None:
        """Ask for it; SkillFailure if there is no camera that inspects."""
        self._cell, self._since = cell, cell.now
        try:
            cell.camera().request()
        except NoSuchDevice as error:
            raise SkillFailure(str(error)) from error

    @property
    def is_there(self) -> bool:
        """Whether it has come; SkillFailure if it takes too long."""
        waits_for = self._cell.camera().waits_for
        if waits_for and self._cell.now - self._since > WAIT_S:
            raise SkillFailure(f"no new {waits_for} has come for {{waited}}", waited=LabelledQuantity(WAIT_S, "s"))
        return not waits_for
