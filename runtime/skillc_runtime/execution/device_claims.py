"""Which task run holds which devices of a cell: several run side by side on different ones."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import assert_never

import msgspec

from skillc_model import tree
from skillc_model.conditions import Individual
from skillc_model.skills import Compound, Declared, Implementation, Primitive, SkillLibrary
from skillc_model.traversal import find_calls
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.execution.selection.python_targets import PrimitiveError, import_primitive
from skillc_runtime.execution.tree.locks import Conflict, DeviceLocks, Holders, LockingCall, LockTable, User
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

    Runs that wait for devices form a queue, in the order that was given last. `table` has what their skills lock.
    """

    def __init__(self) -> None:
        self.table = LockTable()
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

    def find_holder(self, run: str, device: str) -> str | None:
        """Return the run, other than `run`, that holds a device."""
        busy = _find_conflict(run, frozenset({device}), self._held, held=True)
        return None if busy is None else busy.run

    def wait_for(self, run: str, devices: frozenset[str] | None) -> DevicesBusy | None:
        """Give devices to a run that begins, or return for what it waits, and then it holds none.

        It gets them if no other run holds one, and none that comes before it waits for one that it does not hold.
        """
        busy = _find_conflict(run, devices, self._held, held=True) or self._find_earlier(run, devices)
        if busy:
            self._give_back(run)
            self._wanted[run] = devices
            return busy
        self._wanted.pop(run, None)
        return self.claim(run, devices)

    def devices_of(self, run: str) -> frozenset[str] | None:
        """Return what a run holds; empty if nothing."""
        return self._held.get(run, frozenset())

    def withdraw(self, run: str) -> None:
        """Let a run wait for nothing any more; it keeps what it holds."""
        self._wanted.pop(run, None)

    def remove(self, run: str) -> None:
        """Give back all that a run holds; it waits for nothing, and has no place any more."""
        self._give_back(run)
        for each in (self._wanted, self._places):
            each.pop(run, None)

    def _give_back(self, run: str) -> None:
        if run in self._held:
            del self._held[run]
            self.table.changes += 1

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
    """The locks of a run, which claims each device that it did not know it would need when a skill locks it.

    What is no device is only locked, and given back when the skill ends.
    """

    def __init__(self, claims: DeviceClaims, run: str, is_device: Callable[[str], bool]) -> None:
        super().__init__(claims.table, run)
        self._claims, self._is_device = claims, is_device

    def acquire(
        self, individuals: Iterable[str], holder: LockingCall, enclosing: tuple[object, ...]
    ) -> Conflict | None:
        wanted = tuple(individuals)
        conflict = super().acquire(wanted, holder, enclosing)
        if conflict is None:
            self._claims.claim(self.run, frozenset(filter(self._is_device, wanted)))
        return conflict

    def find_users(
        self, individual: str, enclosing: tuple[object, ...], freed: Holders = frozenset()
    ) -> Sequence[User]:
        other = self._claims.find_holder(self.run, individual)
        return [User(None, other)] if other is not None else super().find_users(individual, enclosing, freed)

    @property
    def outermost(self) -> tuple[object, ...]:
        return (self.run,)


def find_claim(body: tree.Node, library: SkillLibrary, state: WorldState) -> frozenset[str] | None:
    """Return the devices of all robots that the calls of a body name; None, the whole cell, if a call may use others.

    A call that names no device may use any, unless its skill only asks people: see `Primitive.uses_devices`.
    """
    robots = set[str]()
    for call in find_calls(body):
        named = [value.iri for value in call.arguments.values() if isinstance(value, Individual)]
        devices = [each for each in named if is_device(each, state)]
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


def is_device(individual: str, state: WorldState) -> bool:
    return any(state.is_a(individual, cls) for cls in (ROBOT, ARM_DEVICE, END_EFFECTOR))


def _find_robot(device: str, state: WorldState) -> str:
    """Return the outermost device that a device is part of."""
    holders = [each for each in state.subjects(HAS_A, device) if is_device(each, state)]
    return _find_robot(min(holders), state) if holders else device


def _find_parts(device: str, state: WorldState) -> Iterator[str]:
    yield device
    for part in state.objects(device, HAS_A):
        yield from _find_parts(part, state)
