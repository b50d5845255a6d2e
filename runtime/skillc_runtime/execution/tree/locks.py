"""Locks on devices that a running skill uses exclusively."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeAlias

Holders: TypeAlias = frozenset[object]
"""Calls that may hold locks."""


class DeviceLocks:
    """The holders of each device; runs that share devices share one object.

    A holder is the node of a call. It may lock devices that are free or held by an enclosing call, so that skills nest.
    """

    def __init__(self) -> None:
        self._holders: dict[str, list[object]] = {}

    def acquire(self, devices: Iterable[str], holder: object, enclosing: tuple[object, ...]) -> str | None:
        """Lock all devices or none; return a device that another call than `enclosing` holds, or None on success."""
        wanted = tuple(dict.fromkeys(devices))
        conflict = self.find_conflict(wanted, enclosing)
        if conflict is None:
            for device in wanted:
                self._holders.setdefault(device, []).append(holder)
        return conflict

    def find_conflict(
        self, devices: Iterable[str], enclosing: tuple[object, ...], freed: Holders = frozenset()
    ) -> str | None:
        """Return a device that another call would hold if the calls `freed` held none; nothing is locked."""
        for device in devices:
            holders = [holder for holder in self._holders.get(device, ()) if holder not in freed]
            if holders and holders[-1] not in enclosing:
                return device
        return None

    def release(self, holder: object) -> None:
        """Release all devices that the holder has locked."""
        for device in [device for device, holders in self._holders.items() if holder in holders]:
            self._holders[device].remove(holder)
            if not self._holders[device]:
                del self._holders[device]

    @property
    def held(self) -> frozenset[str]:
        """The devices that are locked."""
        return frozenset(self._holders)
