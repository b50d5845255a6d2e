"""The forces of hands and the trails of what they work with, for each frame of a film."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from skillc_runtime.devices.ground_truth import GroundTruth, Recording
from skillc_runtime.film.annotations import ForceArrow
from skillc_runtime.film.frames import FRAMES_PER_S, Frame
from skillc_runtime.motion.pose import Array, rotation_from_quaternion

LEAST_N = 0.5
"""A smaller force has no arrow."""

LONGEST_M, FULL_N = 0.28, 10.0
"""The greatest force of a film has an arrow of this length, unless it is smaller than `FULL_N`."""

TRAIL_S, TRAIL_POINTS = 2.5, 90
"""Length of a trail in s of the film, and the most points of it."""

SMOOTHED = 2
"""Number of frames on each side over which a force that was sampled is averaged."""


class ForceMarks:
    """Arrows and trails of the hands in frames; those of a tool come from its recording, others from the frames.

    Forces are those of the simulation: of a tool's working face along its normal, of other hands of all contacts.
    """

    def __init__(self, frames: Sequence[Frame], truth: GroundTruth, speed_up: int) -> None:
        self._frames, self._step_s = frames, speed_up / FRAMES_PER_S
        tools = {mark.tool for frame in frames for mark in frame.hands.values() if mark.tool is not None}
        self._recordings = {tool: found for tool in tools if (found := _recording(truth, tool)) is not None}
        forces = [force for at in range(len(frames)) for force, _ in self._forces(at)]
        greatest = max((float(np.linalg.norm(each)) for each in forces), default=0.0)
        self._m_per_n = LONGEST_M / max(greatest, FULL_N)

    def arrows(self, at: int) -> tuple[ForceArrow, ...]:
        """Return the arrows of a frame, by its index: each ends where the force acts."""
        return tuple(
            ForceArrow(place - self._m_per_n * force, place, f"{np.linalg.norm(force):.0f} N")
            for force, place in self._forces(at)
        )

    def greatest_n(self, at: int) -> float | None:
        """Return the greatest force in a frame in N, None if no hand presses."""
        return max((float(np.linalg.norm(force)) for force, _ in self._forces(at)), default=None)

    def trails(self, at: int) -> tuple[Array, ...]:
        """Return where each hand, or the face of its tool, was lately: points (n, 3) in m."""
        found = (self._trail(at, arm) for arm in self._frames[at].hands)
        return tuple(each for each in found if len(each) > 1)

    def _forces(self, at: int) -> list[tuple[Array, Array]]:
        """Return the forces (3,) in N in a frame, and the points (3,) in m where they act."""
        found = (self._force(at, arm) for arm in self._frames[at].hands)
        return [each for each in found if each is not None and np.linalg.norm(each[0]) >= LEAST_N]

    def _force(self, at: int, arm: str) -> tuple[Array, Array] | None:
        mark, time = self._frames[at].hands[arm], self._frames[at].time
        if mark.tool in self._recordings:
            rows = self._recordings[mark.tool].between(time - self._step_s / 2, time + self._step_s / 2)
            if not rows.time.size:
                return None
            middle = rows.time.size // 2
            normal = rotation_from_quaternion(rows.quaternion[middle])[:, 2]
            return float(rows.force.mean()) * normal, rows.position[middle]
        near = self._frames[max(0, at - SMOOTHED) : at + SMOOTHED + 1]
        known = [
            force for each in near if (force := each.hands[arm].force) is not None and each.hands[arm].tool == mark.tool
        ]
        return (np.mean(known, axis=0), mark.position) if known else None

    def _trail(self, at: int, arm: str) -> Array:
        mark, now = self._frames[at].hands[arm], self._frames[at].time
        since = now - TRAIL_S * FRAMES_PER_S * self._step_s
        if mark.tool in self._recordings:
            points = self._recordings[mark.tool].between(since, now).position
            return points[:: max(1, len(points) // TRAIL_POINTS)]
        frames = [each for each in self._frames[: at + 1] if each.time >= since and each.hands[arm].tool == mark.tool]
        return np.array([each.hands[arm].position for each in frames]).reshape(-1, 3)


def _recording(truth: GroundTruth, tool: str) -> Recording | None:
    """Return the recording of a held thing, None if it is no tool."""
    try:
        return truth.recording(tool)
    except KeyError:
        return None
