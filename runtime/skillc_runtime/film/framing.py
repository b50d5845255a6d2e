"""Where the cameras of a film stand: one that has all the work in view, and one close to a hand."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.devices.drawing import Posture
from skillc_runtime.film.camera import CameraView, blend_views, choose_view
from skillc_runtime.film.frames import Frame
from skillc_runtime.motion.pose import Array

STATES = 12
"""Number of frames from which a view is chosen."""

LINK_M = 0.08
"""Free space around the frames of links, which are within the arm."""

AROUND_M = 0.07
"""How far around a hand a camera should see what it does."""

NEAR_M = 1.0
"""A thing is in view if it is at most this far from a link."""

MOVED_M = 0.02
"""An arm moves in a shot if one of its links does by this much."""

SHORTEST_SHOT = 12
"""Number of frames for which robots must stand in one place for the camera to stand still."""

HAND_M = 0.26
"""Half of the height of the view of a hand."""


def find_shots(bases: Sequence[Array]) -> list[range]:
    """Return the frames between which the positions of mobile bases, one array a frame, do not change.

    A camera stands still in a shot. The first frame is in one, and so is the last.
    """
    moved = [0, *(at for at in range(1, len(bases)) if not np.array_equal(bases[at - 1], bases[at])), len(bases)]
    still = [range(start, stop) for start, stop in pairwise(moved)]
    return [each for each in still if len(each) >= SHORTEST_SHOT or each.start == 0 or each.stop == len(bases)]


class Framing:
    """Chooses views of the drawn model of a run, once its frames are known.

    The camera of a film stands still while the robots stand in one place, and moves slowly while one drives.
    """

    def __init__(
        self, model: Any, prefixes: Sequence[str], frames: Sequence[Frame], corners: Mapping[str, Array], aspect: float
    ) -> None:
        """Choose views of pictures with an `aspect`, their width by their height.

        `prefixes` begin the names of the parts of each device; `corners` (n, 3) in m are those of the surfaces that
        were worked on.
        """
        self._model, self._frames, self._corners, self._aspect = model, frames, corners, aspect
        self._bases = [each for each in range(model.nbody) if model.body_mocapid[each] >= 0]
        self._links = [
            [each for each in range(model.nbody) if model.body(each).name.startswith(prefix)] for prefix in prefixes
        ]

    def work_views(self) -> Iterator[CameraView]:
        """Yield the view for each frame."""
        shots, views = find_shots([each.posture.base_positions for each in self._frames]), list[CameraView]()
        for shot in shots:
            views.append(self._shot_view(shot, views[-1] if views else None))
        for at in range(len(self._frames)):
            after = next((number for number, shot in enumerate(shots) if at < shot.stop), len(shots) - 1)
            if at >= shots[after].start or after == 0:
                yield views[after]
                continue
            began, ended = shots[after - 1].stop - 1, shots[after].start
            share = (at - began) / (ended - began)
            yield blend_views(views[after - 1], views[after], share * share * (3 - 2 * share))

    def _shot_view(self, shot: range, before: CameraView | None) -> CameraView:
        """Return the view of a shot: of robots that move, and of what they are near or work on."""
        chosen = [self._frames[at] for at in np.linspace(shot.start, shot.stop - 1, STATES).astype(int)]
        states = [posed(self._model, each.posture) for each in chosen]
        links = self._find_moving_links(states)
        corners = [at for each, at in self._corners.items() if self._is_worked(each, shot)]
        hands = [_around_hands(data.xpos[links], frame) for data, frame in zip(states, chosen, strict=True)]
        targets = [np.concatenate([at, *corners]) if number % 3 == 2 else at for number, at in enumerate(hands)]
        points = [self._points(data, frame, links) for data, frame in zip(states, chosen, strict=True)]
        every, normals = np.concatenate([*points, *corners]), [_normal(each) for each in corners]
        return choose_view(self._model, states, targets, every, self._aspect, before, normals)

    def _find_moving_links(self, states: Sequence[Any]) -> list[int]:
        """Return the links of the devices that move between states; those of all if none does."""
        moving = [
            links
            for links in self._links
            if np.ptp([data.xpos[links] for data in states], axis=0).max(initial=0.0) > MOVED_M
        ]
        return [link for links in moving or self._links for link in links]

    def _is_worked(self, surface: str, shot: range) -> bool:
        first, last = self._frames[shot.start].shades[surface], self._frames[shot.stop - 1].shades[surface]
        return not np.array_equal(first, last)

    def hand_view(self, at: int, arm: str) -> CameraView:
        """Return a close view of the hand of an arm in a frame, by its index."""
        frame = self._frames[at]
        hand = frame.hands[arm].position
        around = hand + HAND_M * np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-0.5, 1)])
        return choose_view(self._model, [posed(self._model, frame.posture)], [_around(hand)], around, self._aspect)

    def _points(self, data: Any, frame: Frame, bodies: list[int]) -> Array:
        """Return the points (n, 3) of a state that are to be in view: links, space around them, and what is near."""
        links = data.xpos[bodies]
        spread = [links + LINK_M * direction for direction in (*np.eye(3), *-np.eye(3))]
        named = np.array([tag.point for tag in frame.annotations.tags]).reshape(-1, 3)
        return np.concatenate([*spread, _find_near(links, np.concatenate([named, data.xpos[self._bases]]), NEAR_M)])


def _find_near(links: Array, points: Array, distance_m: float) -> Array:
    """Return those of the points (m, 3) that are at most at a distance in m from a link (n, 3)."""
    return points[[np.linalg.norm(links - each, axis=1).min() < distance_m for each in points]]


def _normal(corners: Array) -> Array:
    """Return the normal (3,) of a surface with corners (4, 3) at (-x, -y), (-x, y), (x, -y), (x, y)."""
    across = np.cross(corners[2] - corners[0], corners[1] - corners[0])
    return np.asarray(across / np.linalg.norm(across))


def _around_hands(links: Array, frame: Frame) -> Array:
    """Return points (n, 3) at and around the hands of a frame that belong to links (m, 3)."""
    hands = np.array([each.position for each in frame.hands.values()]).reshape(-1, 3)
    return np.array([_around(each) for each in _find_near(links, hands, HAND_M)]).reshape(-1, 3)


def _around(hand: Array) -> Array:
    """Return points (n, 3) at and around a hand, all of which a camera should see."""
    return hand + AROUND_M * np.concatenate([np.zeros((1, 3)), np.eye(3), -np.eye(3)])


def posed(model: Any, posture: Posture) -> Any:
    """Return the `mujoco.MjData` of a model in a posture, with the places of all parts."""
    data = mujoco.MjData(model)
    apply_posture(model, data, posture)
    return data


def apply_posture(model: Any, data: Any, posture: Posture) -> None:
    """Put a model into a posture."""
    data.qpos[:] = posture.joints
    data.mocap_pos[:], data.mocap_quat[:] = posture.base_positions, posture.base_quaternions
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_camlight(model, data)
