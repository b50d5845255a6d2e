"""The devices of a cell by IRI; one that the cell does not have is named with those that it has."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeVar

Device = TypeVar("Device")


class NoSuchDevice(KeyError):
    """A device that a cell does not have; the message says which ones it has."""

    def __str__(self) -> str:
        return str(self.args[0])


class DeviceMap(dict[str, Device]):
    """The devices of one kind by IRI; NoSuchDevice for any other. `names` are the short names of individuals."""

    def __init__(self, kind: str, devices: Mapping[str, Device], names: Mapping[str, str]) -> None:
        super().__init__(devices)
        self._kind, self._names = kind, names

    def __missing__(self, individual: str) -> Device:
        there = ", ".join(self._names.get(each, each) for each in sorted(self)) or "none"
        raise NoSuchDevice(f"the cell has no {self._kind} {self._names.get(individual, individual)}; it has {there}")
