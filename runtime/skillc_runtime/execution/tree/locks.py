"""Locks on devices that a running skill uses exclusively."""

from __future__ import annotations

from collections.abc import Iterable


class DeviceLocks:
    """The holders of each device; runs that share devices share one object.

    A holder is the node of a call. It may lock devices that are free or held by an enclosing call, so that skills nest.
    """

    def __init__(self) -> None:
        self._holders: dict[str, list[object]] = {}

    def acquire(self, devices: Iterable[str], holder: object, enclosing: tuple[object, ...]) -> str | None:
        """Lock all devices or none; return a device that another call than `enclosing` holds, or None on success."""
        wanted = tuple(dict.fromkeys(devices))
        for device in wanted:
            holders = self._holders.get(device)
            if holders and holders[-1] not in enclosing:
                return device
        for device in wanted:
            self._holders.setdefault(device, []).append(holder)
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
