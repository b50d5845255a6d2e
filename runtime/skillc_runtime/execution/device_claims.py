"""Which task run holds which devices of a cell: several run side by side on different ones."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from skillc_model import tree
from skillc_model.conditions import Individual
from skillc_model.traversal import find_calls
from skillc_runtime.execution.tree.locks import DeviceLocks
from skillc_runtime.world.state.terms import ARM_DEVICE, END_EFFECTOR, HAS_A, ROBOT
from skillc_runtime.world.state.world_state import WorldState


class DeviceClaims:
    """The devices, by IRI, that each task run holds until its end; None stands for the whole cell."""

    def __init__(self) -> None:
        self._held: dict[str, frozenset[str] | None] = {}

    def claim(self, run: str, devices: frozenset[str] | None) -> str | None:
        """Give devices to a run, or none of them if another run holds one; return that run, None on success."""
        for other, held in self._held.items():
            if other != run and (devices is None or held is None or not held.isdisjoint(devices)):
                return other
        own = self._held.get(run, frozenset())
        self._held[run] = None if own is None or devices is None else own | devices
        return None

    def devices_of(self, run: str) -> frozenset[str] | None:
        """Return what a run holds; empty if nothing."""
        return self._held.get(run, frozenset())

    def release(self, run: str) -> None:
        """Give back all that a run holds."""
        self._held.pop(run, None)


class ClaimedLocks(DeviceLocks):
    """The locks of a run, which claims each device that it did not know it would need when a skill locks it."""

    def __init__(self, claims: DeviceClaims, run: str) -> None:
        super().__init__()
        self._claims, self._run = claims, run

    def acquire(self, devices: Iterable[str], holder: object, enclosing: tuple[object, ...]) -> str | None:
        """Lock all devices or none; return a device that another call or run holds, or None on success."""
        wanted = tuple(devices)
        for device in wanted:
            if self._claims.claim(self._run, frozenset({device})) is not None:
                return device
        return super().acquire(wanted, holder, enclosing)


def find_claim(body: tree.Node, state: WorldState) -> frozenset[str] | None:
    """Return the devices of all robots that the calls of a body name; None, the whole cell, if a call names none."""
    robots = set[str]()
    for call in find_calls(body):
        named = [value.iri for value in call.arguments.values() if isinstance(value, Individual)]
        devices = [each for each in named if _is_device(each, state)]
        if not devices:
            return None
        robots |= {_find_robot(each, state) for each in devices}
    return frozenset(part for robot in robots for part in _find_parts(robot, state))


def _is_device(individual: str, state: WorldState) -> bool:
    return any(state.is_a(individual, cls) for cls in (ROBOT, ARM_DEVICE, END_EFFECTOR))


def _find_robot(device: str, state: WorldState) -> str:
    """Return the outermost device that a device is part of."""
    holders = [each for each in state.subjects(HAS_A, device) if _is_device(each, state)]
    return _find_robot(min(holders), state) if holders else device


def _find_parts(device: str, state: WorldState) -> Iterator[str]:
    yield device
    for part in state.objects(device, HAS_A):
        yield from _find_parts(part, state)
