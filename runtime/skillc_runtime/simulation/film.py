"""A film of a run: its postures are kept as they happen, pictures are drawn afterwards."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.motion.pose import Array
from skillc_runtime.simulation.cell import SimulatedCell
from skillc_runtime.simulation.facts import ArmFacts
from skillc_runtime.simulation.names import part
from skillc_runtime.simulation.rendering import Picture, Renderer

FRAMES_PER_S = 12
SPEED_UP = 4
"""How much faster than the run the film is."""

WIDTH, HEIGHT = 480, 360
AZIMUTH_DEG, ELEVATION_DEG, DISTANCE_M = 50.0, -20.0, 2.2
"""A camera looks over its robot's right shoulder: the azimuth counts from where the arm's base points."""


class FilmError(RuntimeError):
    """The film cannot be written here; the message says what is missing."""


@dataclass(frozen=True, slots=True)
class Watched:
    """An arm that a camera stays with: the body of its base, and where that points, in the body's axes."""

    body: int
    forward: Array


class Film:
    """Takes what moves every so often; each arm has a camera that stays with it, their pictures are side by side."""

    def __init__(self, cell: SimulatedCell) -> None:
        self._cell = cell
        self._frames: list[tuple[Array, Array, Array]] = []
        self._arms = tuple(_watched(cell, arm) for arm in cell.facts.arms)

    def sample(self) -> None:
        """Take a frame if it is time for one."""
        if self._cell.now * FRAMES_PER_S / SPEED_UP >= len(self._frames):
            data = self._cell.data
            self._frames.append((data.qpos.copy(), data.mocap_pos.copy(), data.mocap_quat.copy()))

    def write(self, path: Path) -> Path:
        """Draw all frames and write them as MP4, whole or not at all.

        FilmError or RenderingError where that is not possible, OSError where the path cannot be written.
        """
        if not self._frames:
            raise FilmError("the run ended before anything moved")
        try:
            import av
        except ImportError as error:
            raise FilmError("films need PyAV: pip install 'skillc[video]'") from error
        partial = path.with_suffix(".part")
        try:
            with av.open(str(partial), "w", format="mp4") as container:
                stream: Any = container.add_stream("libx264", rate=FRAMES_PER_S)
                stream.width, stream.height, stream.pix_fmt = WIDTH * len(self._arms), HEIGHT, "yuv420p"
                for picture in self.pictures():
                    frame = av.VideoFrame.from_ndarray(np.ascontiguousarray(picture), format="rgb24")
                    container.mux(stream.encode(frame))
                container.mux(stream.encode())
            return partial.replace(path)
        finally:
            partial.unlink(missing_ok=True)

    def pictures(self) -> Iterator[Picture]:
        """Draw the frames, one after the other, each (HEIGHT, WIDTH times the number of arms, 3)."""
        model, data = self._cell.model, mujoco.MjData(self._cell.model)
        renderer = Renderer(model, WIDTH, HEIGHT)
        try:
            for data.qpos[:], data.mocap_pos[:], data.mocap_quat[:] in self._frames:
                mujoco.mj_forward(model, data)
                yield np.concatenate([_picture(renderer, data, arm) for arm in self._arms], axis=1)
        finally:
            renderer.close()


def _watched(cell: SimulatedCell, arm: ArmFacts) -> Watched:
    model, own = cell.model, part(cell.facts.names[arm.individual], "")
    joint = next(each for each in range(model.njnt) if model.joint(each).name.startswith(own))
    body = int(model.body_parentid[model.jnt_bodyid[joint]])
    return Watched(body, cell.data.xmat[body].reshape(3, 3).T @ arm.base.rotation[:, 0])


def _picture(renderer: Renderer, data: Any, arm: Watched) -> Picture:
    focus = data.xpos[arm.body] + np.array([0.0, 0.0, 0.2])
    azimuth = _heading_deg(data.xmat[arm.body].reshape(3, 3) @ arm.forward) + AZIMUTH_DEG
    renderer.look_at(focus, DISTANCE_M, azimuth, ELEVATION_DEG)
    return renderer.picture(data)


def _heading_deg(direction: Array) -> float:
    """Return the angle of a direction (3,) about the vertical, from the world's x axis."""
    return float(np.degrees(np.arctan2(direction[1], direction[0])))
