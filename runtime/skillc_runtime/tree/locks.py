"""Devices that one running skill has for itself."""

from __future__ import annotations

from collections.abc import Iterable


class Locks:
    """Who holds which device; runs that share devices share one object.

    A holder is the node of a call. It may take what is free and what a call around it holds, so that skills nest.
    """

    def __init__(self) -> None:
        self._holders: dict[str, list[object]] = {}

    def take(self, devices: Iterable[str], holder: object, around: tuple[object, ...]) -> str | None:
        """Take all devices or none; return a device that somebody else holds, None on success."""
        wanted = tuple(dict.fromkeys(devices))
        for device in wanted:
            holders = self._holders.get(device)
            if holders and holders[-1] not in around:
                return device
        for device in wanted:
            self._holders.setdefault(device, []).append(holder)
        return None

    def give_back(self, holder: object) -> None:
        """Give back everything the holder has; nothing happens when it has nothing."""
        for device in [device for device, holders in self._holders.items() if holder in holders]:
            self._holders[device].remove(holder)
            if not self._holders[device]:
                del self._holders[device]

    @property
    def held(self) -> frozenset[str]:
        """The devices somebody holds."""
        return frozenset(self._holders)
