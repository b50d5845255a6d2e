"""Which task run holds which devices of a cell: several run side by side on different ones."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import assert_never

import msgspec

from skillc_model import tree
from skillc_model.conditions import Individual
from skillc_model.skills import Compound, Declared, Implementation, Primitive, SkillLibrary
from skillc_model.traversal import find_calls
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.execution.selection.python_targets import PrimitiveError, import_primitive
from skillc_runtime.execution.tree.locks import DeviceLocks, Holders
from skillc_runtime.world.state.terms import ARM_DEVICE, END_EFFECTOR, HAS_A, ROBOT
from skillc_runtime.world.state.world_state import WorldState


class DevicesBusy(msgspec.Struct, frozen=True):
    """A run cannot have `devices`, None for the whole cell: `run` holds them, or waits for them and comes first."""

    run: str
    devices: frozenset[str] | None
    held: bool

    def describe(self, vocabulary: Vocabulary) -> str:
        """Return for what is waited."""
        names = ["the whole cell"] if self.devices is None else sorted(map(vocabulary.short, self.devices))
        return f"waits for {', '.join(names)}, {f'which {self.run} holds' if self.held else f'after {self.run}'}"


class DeviceClaims:
    """The devices, by IRI, that each task run holds until its end; None stands for the whole cell.

    Runs that wait for devices form a queue, in the order that was given last.
    """

    def __init__(self) -> None:
        self._held: dict[str, frozenset[str] | None] = {}
        self._wanted: dict[str, frozenset[str] | None] = {}
        self._places: dict[str, int] = {}

    def order(self, runs: Sequence[str]) -> None:
        """Give all runs their places in the queue, the first one first; one that is new waits for nothing yet."""
        self._places = {run: place for place, run in enumerate(runs)}

    def claim(self, run: str, devices: frozenset[str] | None) -> DevicesBusy | None:
        """Give devices to a run that goes on, or none of them, and return why, if another run holds one."""
        if (busy := _find_conflict(run, devices, self._held, held=True)) is None:
            own = self._held.get(run, frozenset())
            self._held[run] = None if own is None or devices is None else own | devices
        return busy

    def is_held_by_other(self, run: str, device: str) -> bool:
        """Whether another run than `run` holds a device."""
        return _find_conflict(run, frozenset({device}), self._held, held=True) is not None

    def wait_for(self, run: str, devices: frozenset[str] | None) -> DevicesBusy | None:
        """Give devices to a run that begins, or return for what it waits, and then it holds none.

        It gets them if no other run holds one, and none that comes before it waits for one that it does not hold.
        """
        busy = _find_conflict(run, devices, self._held, held=True) or self._find_earlier(run, devices)
        self._held.pop(run, None) if busy else self._wanted.pop(run, None)
        if busy:
            self._wanted[run] = devices
            return busy
        return self.claim(run, devices)

    def devices_of(self, run: str) -> frozenset[str] | None:
        """Return what a run holds; empty if nothing."""
        return self._held.get(run, frozenset())

    def withdraw(self, run: str) -> None:
        """Let a run wait for nothing any more; it keeps what it holds."""
        self._wanted.pop(run, None)

    def remove(self, run: str) -> None:
        """Give back all that a run holds; it waits for nothing, and has no place any more."""
        for each in (self._held, self._wanted, self._places):
            each.pop(run, None)

    def _find_earlier(self, run: str, devices: frozenset[str] | None) -> DevicesBusy | None:
        own, place = self.devices_of(run), self._places[run]
        missing = frozenset() if own is None else devices if devices is None else devices - own
        earlier = {each: wanted for each, wanted in self._wanted.items() if self._places[each] < place}
        return _find_conflict(run, missing, earlier, held=False)


def _find_conflict(
    run: str, devices: frozenset[str] | None, claims: Mapping[str, frozenset[str] | None], held: bool
) -> DevicesBusy | None:
    for other, claimed in claims.items():
        shared = claimed if devices is None else devices if claimed is None else devices & claimed
        if other != run and (shared is None or shared):
            return DevicesBusy(other, shared, held)
    return None


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

    def find_conflict(
        self, devices: Iterable[str], enclosing: tuple[object, ...], freed: Holders = frozenset()
    ) -> str | None:
        """Return a device that another call or run would hold if the calls `freed` held none; claim nothing."""
        wanted = tuple(devices)
        for device in wanted:
            if self._claims.is_held_by_other(self._run, device):
                return device
        return super().find_conflict(wanted, enclosing, freed)


def find_claim(body: tree.Node, library: SkillLibrary, state: WorldState) -> frozenset[str] | None:
    """Return the devices of all robots that the calls of a body name; None, the whole cell, if a call may use others.

    A call that names no device may use any, unless its skill only asks people: see `Primitive.uses_devices`.
    """
    robots = set[str]()
    for call in find_calls(body):
        named = [value.iri for value in call.arguments.values() if isinstance(value, Individual)]
        devices = [each for each in named if _is_device(each, state)]
        if not devices and not _only_asks(call.skill, library, frozenset()):
            return None
        robots |= {_find_robot(each, state) for each in devices}
    return frozenset(part for robot in robots for part in _find_parts(robot, state))


def _only_asks(skill: str, library: SkillLibrary, callers: frozenset[str]) -> bool:
    """Whether a skill, called by `callers`, neither uses devices nor changes the world, however it is implemented."""
    return skill in callers or (
        not library.skills[skill].uses
        and all(_may_go_on_beside(each, library, callers | {skill}) for each in library.implementations_of(skill))
    )


def _may_go_on_beside(implementation: Implementation, library: SkillLibrary, callers: frozenset[str]) -> bool:
    if any(post.effects and not post.sensed for post in implementation.post):
        return False
    match implementation.body:
        case Compound(node=node):
            return all(_only_asks(call.skill, library, callers) for call in find_calls(node))
        case Primitive(python=python):
            try:
                return not import_primitive(python).uses_devices
            except PrimitiveError:
                return False
        case Declared():
            return False
        case _:
            assert_never(implementation.body)


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
