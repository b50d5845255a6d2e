"""A film of a run, and stills: postures are stored during the run, pictures are rendered afterwards."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.devices.simulation import Drawing, Posture, Simulation
from skillc_runtime.film.annotations import Annotations, SceneAnnotator
from skillc_runtime.film.picture_files import FilmError, write_film, write_picture
from skillc_runtime.film.props import make_props
from skillc_runtime.film.rendering import CameraView, Picture, Quality, Renderer
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.space.frames import pose, size
from skillc_runtime.world.state.terms import ARM_DEVICE, HAS_GRIPPER, SURFACE
from skillc_runtime.world.state.world_state import WorldState

FILM = "film.mp4"
FRAMES_PER_S = 12
SPEED_UP = 4
"""Speed of the film relative to the run."""

WIDTH, HEIGHT = 720, 360
"""Size in pixels of the picture of one arm: a view of the arm and one of its hand."""

STILL_WIDTH, STILL_HEIGHT = 960, 720
AZIMUTH_DEG, ELEVATION_DEG, DISTANCE_M = 50.0, -20.0, 2.0
"""The camera looks over the robot's right shoulder; the azimuth is relative to the x axis of the arm's base."""

AHEAD_M, ABOVE_M = 0.25, 0.25
"""Distance of the point that the camera looks at in front of an arm's base and above it."""

CLOSE_DEG, CLOSE_M, CLOSER_M = -28.0, 0.75, 0.6
"""Elevation of the camera of a hand, and its distance in films and in stills."""

REACH_M = 0.15
"""Distance of the point that the camera of a hand looks at from the palm."""


@dataclass(frozen=True, slots=True)
class CameraTarget:
    """An arm that cameras follow: the bodies of its base and its hand, and the forward direction (3,) of the base."""

    body: int
    hand: int
    forward: Array


@dataclass(frozen=True, slots=True)
class Moment:
    """A moment of a run, in s, to show in a still, and the arm, by IRI, that it shows."""

    title: str
    time: float
    arm: str


@dataclass(frozen=True, slots=True)
class Still:
    """A still: its title and the name of its file."""

    title: str
    file: str


@dataclass(frozen=True, slots=True)
class FilmFiles:
    """The names of the written files: a film and stills."""

    film: str
    stills: tuple[Still, ...]


class Film:
    """Samples frames of a run and renders them.

    One camera follows each arm, and one its hand; all are shown side by side.
    """

    def __init__(self, simulation: Simulation, drawn: mujoco.MjModel | None = None) -> None:
        """Film a cell; `drawn` is the model to render, with the same joints, if it is not that of the cell."""
        self._clock, self._drawing = simulation.clock, simulation.drawing
        self._drawn = self._drawing.model if drawn is None else drawn
        self._frames: list[tuple[Posture, Annotations]] = []
        self._annotator = SceneAnnotator(simulation)
        state, truth = simulation.cell.world.snapshot(), simulation.ground_truth
        self._arms = {arm: _camera_target(self._drawing, state, arm) for arm in sorted(state.instances(ARM_DEVICE))}
        present = filter(truth.is_present, sorted(state.instances(SURFACE)))
        self._props = tuple(
            prop for each in present for prop in make_props(truth.surface_pose(each), size(state, each))
        )

    def sample(self) -> None:
        """Sample a frame if one is due."""
        if self._clock.now * FRAMES_PER_S / SPEED_UP >= len(self._frames):
            self._frames.append((self._drawing.posture(), self._annotator.sample()))

    def write(self, directory: Path, moments: Sequence[Moment] = ()) -> FilmFiles:
        """Render all frames to film.mp4, and stills of some moments to PNG.

        Each file is written completely or not at all.

        Raises FilmError or RenderingError if that is not possible, OSError if the folder cannot be written to.
        """
        if not self._arms:
            raise FilmError("there is no arm in the scene for a camera to stay with")
        if not self._frames:
            raise FilmError("the run ended before anything moved")
        write_film(directory / FILM, self.pictures(), WIDTH * len(self._arms), HEIGHT, FRAMES_PER_S)
        stills = tuple(Still(each.title, f"{number}-{_slug(each.title)}.png") for number, each in enumerate(moments, 1))
        for still, picture in zip(stills, self.stills(moments), strict=True):
            write_picture(directory / still.file, picture)
        return FilmFiles(FILM, stills)

    def pictures(self) -> Iterator[Picture]:
        """Render the frames, each (HEIGHT, WIDTH times the number of arms, 3)."""
        with self._renderer(WIDTH, HEIGHT, "film") as (renderer, data):
            for posture, annotations in self._frames:
                self._show(data, posture)
                ghosts = replace(annotations, tags=())
                pictures = [
                    renderer.picture(data, (_arm_view(data, arm), _hand_view(data, arm)), ghosts)
                    for arm in self._arms.values()
                ]
                yield np.concatenate(pictures, axis=1)

    def stills(self, moments: Sequence[Moment]) -> Iterator[Picture]:
        """Render close views of some moments, each (STILL_HEIGHT, STILL_WIDTH, 3)."""
        if not moments:
            return
        with self._renderer(STILL_WIDTH, STILL_HEIGHT, "still") as (renderer, data):
            for moment in moments:
                at = min(round(moment.time * FRAMES_PER_S / SPEED_UP), len(self._frames) - 1)
                posture, annotations = self._frames[at]
                self._show(data, posture)
                yield renderer.picture(data, (_hand_view(data, self._arms[moment.arm], CLOSER_M),), annotations)

    @contextmanager
    def _renderer(self, width: int, height: int, quality: Quality) -> Iterator[tuple[Renderer, Any]]:
        renderer = Renderer(self._drawn, width, height, self._props, quality)
        try:
            yield renderer, mujoco.MjData(self._drawn)
        finally:
            renderer.close()

    def _show(self, data: Any, frame: Posture) -> None:
        _apply_posture(data, frame)
        mujoco.mj_forward(self._drawn, data)


def _camera_target(drawing: Drawing, state: WorldState, arm: str) -> CameraTarget:
    model, own, grippers = drawing.model, drawing.prefixes[arm], sorted(state.objects(arm, HAS_GRIPPER))
    joint = next(each for each in range(model.njnt) if model.joint(each).name.startswith(own))
    body = int(model.body_parentid[model.jnt_bodyid[joint]])
    hand = int(model.site(f"{own}flange").bodyid[0])
    if grippers:
        hand = int(model.body(f"{drawing.prefixes[grippers[0]]}palm").id)
    return CameraTarget(body, hand, _rotation(drawing, body).T @ pose(state, arm).rotation[:, 0])


def _apply_posture(data: Any, posture: Posture) -> None:
    data.qpos[:] = posture.joints
    data.mocap_pos[:], data.mocap_quat[:] = posture.base_positions, posture.base_quaternions


def _rotation(drawing: Drawing, body: int) -> Array:
    """Return the present rotation (3, 3) of a body in the world."""
    data = mujoco.MjData(drawing.model)
    _apply_posture(data, drawing.posture())
    mujoco.mj_kinematics(drawing.model, data)
    return np.asarray(data.xmat[body].reshape(3, 3))


def _arm_view(data: Any, arm: CameraTarget) -> CameraView:
    """Return the view of an arm."""
    forward = _forward(data, arm)
    focus = data.xpos[arm.body] + AHEAD_M * forward + np.array([0.0, 0.0, ABOVE_M])
    return CameraView(focus, DISTANCE_M, _heading_deg(forward) + AZIMUTH_DEG, ELEVATION_DEG)


def _hand_view(data: Any, arm: CameraTarget, distance: float = CLOSE_M) -> CameraView:
    """Return the view of the hand of an arm."""
    focus = data.xpos[arm.hand] + REACH_M * data.xmat[arm.hand].reshape(3, 3)[:, 2]
    return CameraView(focus, distance, _heading_deg(_forward(data, arm)) + AZIMUTH_DEG, CLOSE_DEG)


def _forward(data: Any, arm: CameraTarget) -> Array:
    return np.asarray(data.xmat[arm.body].reshape(3, 3) @ arm.forward)


def _heading_deg(direction: Array) -> float:
    """Return the angle of a direction (3,) about the vertical, from the world's x axis."""
    return float(np.degrees(np.arctan2(direction[1], direction[0])))


def _slug(title: str) -> str:
    """Return a title as a part of a file's name."""
    return re.sub(r"[^A-Za-z0-9]+", "-", title).strip("-").lower()
