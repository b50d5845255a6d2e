"""The postures in which arms bring their tools to poses, as a plan was looked at before anything moved."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import degrees

import msgspec

from skillc_runtime.motion.arrays import Array, np
from skillc_runtime.motion.pose import Pose, log
from skillc_runtime.primitives.known_limits import CORRECTION_M

TURNED_RAD = 0.2
"""How far a tool may be turned from where it was planned to be, in rad."""


class PlannedPosture(msgspec.Struct, frozen=True, eq=False):
    """The joints `q` (nv,) in rad with which an arm was planned to bring its tool to a pose in the world."""

    arm: str
    tool: Pose
    q: Array


class PlannedPostures:
    """Knows the postures of a plan, each for a pose of the tool; each arm takes them in their order.

    Where a thing turns out to be elsewhere there is none: from there on another posture may be better.
    """

    def __init__(self, postures: Sequence[PlannedPosture], tell: Callable[[str, str], None]) -> None:
        """Take the postures of a plan; `tell` gets an arm and what it does, as a clause, where it takes another one."""
        self._planned = dict[str, list[PlannedPosture]]()
        for each in postures:
            self._planned.setdefault(each.arm, []).append(each)
        self._next = dict.fromkeys(self._planned, 0)
        self.tell = tell

    def find(self, arm: str, tool: Pose) -> Array | None:
        """Return the joints (nv,) in rad with which an arm was planned to bring its tool about to a pose in the world.

        That is the nearest of those after the last that was found, else of those before it. None if the tool was not
        planned to go there, which is told, or if nothing was planned for the arm.
        """
        planned, ahead = self._planned.get(arm, []), self._next.get(arm, 0)
        if not planned:
            return None
        far = [_measure_distance(each.tool, tool) for each in planned]
        near = [number for number, (away_m, turn) in enumerate(far) if away_m <= CORRECTION_M and turn <= TURNED_RAD]
        if not near:
            away_m, turn = min(far)
            far_away = f"{away_m:.2f} m and {degrees(turn):.0f} degrees from where it was planned to go"
            self.tell(arm, f"goes where nobody had looked, {far_away}, in the posture nearest to home")
            return None
        best = min(near, key=lambda number: (number < ahead, round(far[number][0], 3), number))
        self._next[arm] = best + 1
        return planned[best].q.copy()


def _measure_distance(one: Pose, other: Pose) -> tuple[float, float]:
    """Return how far a pose is from another, in m, and how far turned, in rad."""
    away_m = float(np.linalg.norm(one.position - other.position))
    return away_m, float(np.linalg.norm(log(one.rotation.T @ other.rotation)))


def find_planned(planned: Sequence[PlannedPosture], arm: str, tool: Pose) -> Array | None:
    """Return the joints (nv,) in rad with which an arm was planned to bring its tool nearest to a pose in the world.

    None if it was not planned to go near there.
    """
    own = [each for each in planned if each.arm == arm]
    far = [_measure_distance(each.tool, tool) for each in own]
    near = [number for number, (away_m, turn) in enumerate(far) if away_m <= CORRECTION_M and turn <= TURNED_RAD]
    return own[min(near, key=lambda number: far[number])].q if near else None
