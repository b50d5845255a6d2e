"""Samples of a run from which the pictures of a film are made: postures, forces, what is wiped, what is believed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skillc_runtime.devices.drawing import Posture
from skillc_runtime.film.annotations import Annotations, SceneAnnotator
from skillc_runtime.film.filmed_cell import FilmedCell
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.terms import ARM_DEVICE, HAS_GRIPPER, SURFACE

FRAMES_PER_S = 25
LEAST_SPEED_UP, LONGEST_S = 2, 10.0
"""A film is twice as fast as the run, or 4, 8, 16 .. times, so that it is not longer than `LONGEST_S`."""

FULL_DOSE_S = 1.0
"""A cell of a surface on which a tool worked for this time is fully worked."""

LEAST_SHADE, FULL_SHADE = 150, 255
"""How a cell looks where a tool worked for a moment, and where it worked for `FULL_DOSE_S`; 0 is where none did."""

Shades = NDArray[np.uint8]


@dataclass(frozen=True, slots=True)
class HandMark:
    """A hand at one instant: its tool centre point (3,) in m, and the force (3,) in N with which it presses.

    Both in the world; the force is None where it is not computed. `tool` is the IRI of the held tool, if it is one.
    """

    position: Array
    force: Array | None
    tool: str | None


@dataclass(frozen=True, slots=True)
class Frame:
    """One sample: its time in s, the posture, ghosts and names, the hands of arms and the shades of surfaces by IRI."""

    time: float
    posture: Posture
    annotations: Annotations
    hands: Mapping[str, HandMark]
    shades: Mapping[str, Shades]


class FrameSampler:
    """Samples frames at equal intervals, which double whenever there would be too many; `speed_up` is how many times.

    So a run of any length makes a film of limited length, at a speed that is known at its end.
    """

    def __init__(self, cell: FilmedCell) -> None:
        self._clock, self._drawing, self._truth = cell.clock, cell.drawing, cell.truth
        self._annotator = SceneAnnotator(cell)
        state = cell.world.snapshot()
        grippers = {arm: sorted(state.objects(arm, HAS_GRIPPER)) for arm in sorted(state.instances(ARM_DEVICE))}
        self._hands = {arm: found[0] for arm, found in grippers.items() if found}
        self._surfaces = [each for each in sorted(state.instances(SURFACE)) if self._truth.is_present(each)]
        self._seconds = dict.fromkeys(self._surfaces, 0.0)
        self._shades: dict[str, Shades] = {}
        self._began_s = self._clock.now
        self.speed_up = LEAST_SPEED_UP
        self.frames: list[Frame] = []

    def sample(self) -> None:
        """Sample a frame if one is due."""
        due = (self._clock.now - self._began_s) * FRAMES_PER_S
        if due < len(self.frames) * self.speed_up:
            return
        if len(self.frames) == int(LONGEST_S * FRAMES_PER_S):
            self.frames, self.speed_up = self.frames[::2], 2 * self.speed_up
            if due < len(self.frames) * self.speed_up:
                return
        hands = {arm: self._mark(gripper) for arm, gripper in self._hands.items()}
        shades = {each: self._shade(each) for each in self._surfaces}
        self.frames.append(
            Frame(self._clock.now, self._drawing.posture(), self._annotator.sample(), hands, shades),
        )

    def _mark(self, gripper: str) -> HandMark:
        truth = self._truth
        return HandMark(truth.hand(gripper).position, truth.contact_force(gripper), truth.carried_by(gripper))

    def _shade(self, surface: str) -> Shades:
        """Return the shades of a surface; the same array as before while nothing is worked on it."""
        dose = self._truth.coverage(surface).dose
        seconds = float(dose.sum())
        if surface not in self._shades or seconds != self._seconds[surface]:
            self._seconds[surface], self._shades[surface] = seconds, shade(dose)
        return self._shades[surface]


def shade(dose: Array) -> Shades:
    """Return the shade of each cell of a surface on which tools worked for `dose` s (rows, columns)."""
    worked = LEAST_SHADE + (FULL_SHADE - LEAST_SHADE) * np.minimum(dose / FULL_DOSE_S, 1.0)
    return np.where(dose > 0, worked, 0.0).astype(np.uint8)
