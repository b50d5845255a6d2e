"""Compares what devices report with what the world model says: a fact that a device contradicts is withdrawn."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial
from math import dist

import msgspec

from skillc_runtime.devices.cell import Cell
from skillc_runtime.devices.gripper import Gripper
from skillc_runtime.motion.pose import Pose
from skillc_runtime.primitives.contradiction import suppose_around
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import pose, states_own_pose
from skillc_runtime.world.space.whereabouts import displacement_changes
from skillc_runtime.world.state.changes import RemoveRelation
from skillc_runtime.world.state.data_sheet import SheetError, number_of, sheet_of
from skillc_runtime.world.state.evidence import describe_evidence
from skillc_runtime.world.state.facts import RelationFact
from skillc_runtime.world.state.labels.labelled_text import format_fact
from skillc_runtime.world.state.labels.labelling import label_fact
from skillc_runtime.world.state.terms import ARRIVAL_TOLERANCE, AT, CONTAIN, END_EFFECTOR, MOBILE_ROBOT
from skillc_runtime.world.state.world_state import WorldState

ARRIVAL_TOLERANCE_M = 0.05
"""How far from its place a base may stand whose data sheet does not say so."""

Reading = Callable[[], "str | None"]
"""What a device says against a fact, as text; None while it does not contradict it."""


class Expected(msgspec.Struct, frozen=True):
    """A fact that a device can contradict, with what reads the device.

    Where `also_given` is false, what the scene says of it is not compared: a place need not be where a base stops.
    """

    fact: RelationFact
    reading: Reading
    also_given: bool


class FactMonitor:
    """Compares what the world model says with the devices that can tell; cheap while neither changes."""

    def __init__(self, cell: Cell) -> None:
        self._cell = cell
        self._seen: WorldState | None = None
        self._expected: tuple[Expected, ...] = ()

    def withdraw_contradicted(self) -> str | None:
        """Withdraw the facts that devices contradict; return them with what the devices say, None for none."""
        state = self._cell.world.snapshot()
        if state is not self._seen:
            self._seen, self._expected = state, tuple(_expected(self._cell, state))
        found = []
        for expected in self._expected:
            said = expected.reading()
            if said is not None and (expected.also_given or self._cell.world.deciding_write(expected.fact) is not None):
                found.append(self._withdraw(expected.fact, said, state))
        return "; ".join(found) or None

    def _withdraw(self, fact: RelationFact, said: str, state: WorldState) -> str:
        known = self._cell.world.deciding_write(fact)
        world, changes = self._cell.world, [RemoveRelation(fact.subject, fact.relation, fact.object)]
        lost = fact.relation == CONTAIN
        world.commit(displacement_changes(state, fact.object) if lost else changes, said, "reported")
        if lost:
            suppose_around(world, fact.object, state, said)
        return f"{said}, but the world model said `{format_fact(label_fact(fact, state))}` ({describe_evidence(known)})"


def _expected(cell: Cell, state: WorldState) -> Iterator[Expected]:
    relations = state.vocabulary.relations
    for gripper in sorted(state.instances(END_EFFECTOR)) if CONTAIN in relations else ():
        for thing in sorted(state.objects(gripper, CONTAIN)):
            with suppress(KeyError):
                reading = partial(_lost, cell.gripper(gripper), thing, state.vocabulary.short(gripper), state)
                yield Expected(RelationFact(gripper, CONTAIN, thing), reading, also_given=True)
    for robot in sorted(state.instances(MOBILE_ROBOT)) if AT in relations else ():
        for place in sorted(state.objects(robot, AT)):
            with suppress(KeyError, FrameError, SheetError):
                goal = pose(state, robot if states_own_pose(state, robot) else place)
                away = base_away_from(cell, robot, place, goal, state)
                yield Expected(RelationFact(robot, AT, place), away, also_given=False)


def _lost(gripper: Gripper, thing: str, name: str, state: WorldState) -> str | None:
    held = gripper.holding
    if held == thing:
        return None
    return f"{name} reports that it holds {state.vocabulary.short(held) if held else 'nothing'}"


def base_away_from(cell: Cell, robot: str, place: str, at: Pose, state: WorldState) -> Reading:
    """Return the facts that say where a robot's base stands when that is not `at`, its pose in the world at a place.

    SheetError for a robot without a sheet, KeyError for one without a base.
    """
    goal, short = at.position, state.vocabulary.short
    tolerance, base = _tolerance_m(state, robot), cell.base(robot)
    there: Pose | None = None
    off = 0.0

    def read() -> str | None:
        nonlocal there, off
        if not base.at_rest:
            return None
        if (here := base.pose) is not there:
            there, off = here, dist(here.position[:2], goal[:2])
        if off <= tolerance:
            return None
        return f"{short(robot)} reports that it stands {off:.2f} m away from {short(place)}"

    return read


def _tolerance_m(state: WorldState, robot: str) -> float:
    return number_of(state, sheet_of(state, robot).individual, ARRIVAL_TOLERANCE, default=ARRIVAL_TOLERANCE_M)
