"""Records what links, hands and bases of a simulated cell touch, and how hard: ground truth, never seen by skills."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.backends.simulation.contacts import Contacts
from skillc_runtime.backends.simulation.machine_code import find_counts, find_geoms
from skillc_runtime.backends.simulation.model.contact_bits import HANDLE, LINK
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.backends.simulation.steps import OnMemory
from skillc_runtime.devices.ground_truth import Touching
from skillc_runtime.motion.arrays import Integers, OutVector
from skillc_runtime.motion.numerics.compiled import bind, compiled
from skillc_runtime.motion.numerics.program import Rows
from skillc_runtime.motion.pose import Array

SAME_TOUCH_S, LEAST_N = 0.1, 0.5
"""A shorter interruption does not end a contact; a contact with a smaller force does not count."""

FLOOR = "the floor"

NO_GEOMS = np.zeros((0, 2), dtype=np.int64)


@dataclass(slots=True)
class OngoingTouch:
    """A contact between two parts that may go on; times in s, its greatest force in N, None if it is not known."""

    start_s: float
    end_s: float
    peak_force_n: float | None


COUNT, TOUCHED = range(2)
"""Entries of `ContactWatch.last`: contacts at the last look, 1 if something counted."""


class ContactWatch(msgspec.Struct, frozen=True):
    """counts (1, 1): the number of contacts in the lower 32 bits; last (2,): see above.

    geoms (n, m): as of `find_geoms`, a row for each contact; seen (n, 2): those of the last look.
    """

    counts: Integers
    last: OutVector
    geoms: Integers
    seen: Integers


@compiled
def wants_look(watch: ContactWatch, now: float) -> int:
    """Return 1 if there are contacts, and they count, or are others than at the last look."""
    last, count, geoms, seen = watch.last, int(watch.counts[0, 0] & 0xFFFFFFFF), watch.geoms, watch.seen
    if count == 0:
        last[COUNT], last[TOUCHED] = 0.0, 0.0
        return 0
    if last[TOUCHED] != 0.0 or last[COUNT] != count or count > seen.shape[0]:
        return 1
    for row in range(count):
        if geoms[row, 0] != seen[row, 0] or geoms[row, 1] != seen[row, 1]:
            return 1
    return 0


class TouchRecorder(OnMemory):
    """Watches the solid parts of robots in a model and what their grippers hold.

    What fingers may grasp or press does not count, nor contact within one hand. `held` returns, by gripper, what it
    holds; both are IRIs.
    """

    is_fixed = False

    def __init__(
        self, scene: SceneSpec, model: Any, contacts: Contacts, held: Callable[[], Sequence[tuple[str, str]]]
    ) -> None:
        self._model, self._present, self._names, self._held = model, contacts, scene.names, held
        self._last, self._counted = np.zeros(2), contacts.data
        self._compare_with(NO_GEOMS)
        super().__init__(self._compute)
        grippers = [arm.gripper.individual for arm in scene.arms if arm.gripper is not None]
        self._grippers = {scene.names[each] for each in grippers}
        self._robots = {scene.names[arm.individual] for arm in scene.arms} | self._grippers
        tools = {scene.names[tool.individual] for tool in scene.tools}
        self._parts = [_part(model, geom) for geom in range(model.ngeom)]
        solid, owners = np.flatnonzero(model.geom_contype & LINK).tolist(), self._robots | tools
        self._watched = frozenset(geom for geom in solid if self._parts[geom][0] in owners)
        self._found: defaultdict[tuple[str, str], list[OngoingTouch]] = defaultdict(list)

    @property
    def touchings(self) -> tuple[Touching, ...]:
        """All contacts so far in order of their start."""
        found = [
            Touching(part, other, touch.start_s, touch.end_s, touch.peak_force_n)
            for (part, other), touches in self._found.items()
            for touch in touches
        ]
        return tuple(sorted(found, key=lambda each: (each.start_s, each.part, each.other)))

    @property
    def rows(self) -> Rows | None:
        """What tells whether contacts may have changed, of the physics that is stepped now."""
        self._follow()
        return super().rows

    def step(self, now: float) -> bool:
        """Look at the contacts of the step that begins at `now` s, if they may have changed."""
        self._follow()
        return super().step(now)

    def act(self, events: int, now: float) -> bool:
        """Look at the contacts of the step that begins at `now` s, once their forces are computed."""
        geoms = self._present.geoms
        touched = not self._watched.isdisjoint(geoms.ravel().tolist()) and self._measure(now)
        self._last[:] = len(geoms), touched
        here = find_geoms(self._present.data)
        moved = here.ctypes.data != self._memory.geoms.ctypes.data
        if moved:
            self._compare_with(here)
        self._memory.seen[: len(geoms)] = here[: len(geoms), :2]
        return moved

    def add(self, part: str, other: str, now: float, force_n: float | None) -> None:
        """Add a contact of two parts at `now` s with a force in N, None if it is not known."""
        touches = self._found[part, other]
        if not touches or now - touches[-1].end_s > SAME_TOUCH_S:
            touches.append(OngoingTouch(now, now, force_n))
        touches[-1].end_s = now
        if force_n is not None:
            touches[-1].peak_force_n = max(touches[-1].peak_force_n or 0.0, force_n)

    def _follow(self) -> None:
        """Watch contacts where they are computed now."""
        if self._counted is not self._present.data:
            self._counted, self._last[COUNT] = self._present.data, 0.0
            self._compare_with(NO_GEOMS)

    def _compare_with(self, geoms: NDArray[np.int64]) -> None:
        """Compare from now on the geoms of contacts, which are in this memory."""
        seen = np.zeros((len(geoms), 2), dtype=np.int64)
        self._memory = ContactWatch(find_counts(self._counted), self._last, geoms, seen)
        self._compute = bind(wants_look, self._memory)

    def _measure(self, now: float) -> bool:
        """Add the present contacts with their forces; tell whether there are any."""
        forces: defaultdict[tuple[str, str], Array] = defaultdict(lambda: np.zeros(3))
        for index, pair in self._contacts():
            forces[pair] += self._present.force(index)
        felt = {pair: float(np.linalg.norm(force)) for pair, force in forces.items()}
        for (part, other), force_n in felt.items():
            if force_n >= LEAST_N:
                self.add(part, other, now, force_n)
        return bool(felt)

    def _contacts(self) -> Iterator[tuple[int, tuple[str, str]]]:
        """Yield each contact that counts, with the robot's part and what it touches."""
        holders = {self._names[thing]: self._names[gripper] for gripper, thing in self._held()}
        for index, (one, other) in enumerate(self._present.geoms.tolist()):
            hands = [holders.get(self._parts[geom][0], self._parts[geom][0]) for geom in (one, other)]
            part, thing = (one, other) if self._is_robot(one, hands[0]) else (other, one)
            if self._is_robot(part, hands[part != one]) and hands[0] != hands[1] and not self._is_grasp(part, thing):
                yield index, (_describe(*self._parts[part]), self._describe_other(thing))

    def _is_robot(self, geom: int, hand: str) -> bool:
        """Whether a geom is a solid part of a robot or of what it holds; `hand` is the owner, or who holds that."""
        return hand in self._robots and bool(self._model.geom_contype[geom] & LINK)

    def _is_grasp(self, part: int, thing: int) -> bool:
        """Whether fingers touch what they may grasp or press."""
        return self._parts[part][0] in self._grippers and bool(self._model.geom_contype[thing] & HANDLE)

    def _describe_other(self, geom: int) -> str:
        owner, part = self._parts[geom]
        return _describe(owner, part) if owner in self._robots else owner


def _part(model: Any, geom: int) -> tuple[str, str]:
    """Return the owner of a geom and the name of its body there."""
    body = model.body(model.geom_bodyid[geom]).name
    owner, _, part = body.partition("/")
    return (FLOOR, "") if body == "world" else (owner, part)


def _describe(owner: str, part: str) -> str:
    return f"{owner} {part}" if part else owner
