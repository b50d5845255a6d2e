"""A film of a run: its postures are kept as they happen, pictures are drawn afterwards."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.motion.pose import Array
from skillc_runtime.simulation.cell import SimulatedCell
from skillc_runtime.simulation.rendering import Picture, Renderer

FRAMES_PER_S = 12
SPEED_UP = 4
"""How much faster than the run the film is."""

WIDTH, HEIGHT = 480, 360
AZIMUTH_DEG, ELEVATION_DEG, DISTANCE_M = 50.0, -20.0, 2.2
"""The camera looks over the robot's right shoulder: the azimuth counts from where the first arm's base points."""


class FilmError(RuntimeError):
    """The film cannot be written here; the message says what is missing."""


class Film:
    """Takes what moves every so often; the camera stays with the first arm."""

    def __init__(self, cell: SimulatedCell) -> None:
        self._cell = cell
        self._frames: list[tuple[Array, Array, Array]] = []
        arm = cell.data.xmat[self._arm_body()].reshape(3, 3)
        self._forward = arm.T @ cell.facts.arms[0].base.rotation[:, 0]

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
                stream.width, stream.height, stream.pix_fmt = WIDTH, HEIGHT, "yuv420p"
                for picture in self.pictures():
                    frame = av.VideoFrame.from_ndarray(np.ascontiguousarray(picture), format="rgb24")
                    container.mux(stream.encode(frame))
                container.mux(stream.encode())
            return partial.replace(path)
        finally:
            partial.unlink(missing_ok=True)

    def pictures(self) -> Iterator[Picture]:
        """Draw the frames, one after the other."""
        model, data = self._cell.model, mujoco.MjData(self._cell.model)
        renderer = Renderer(model, WIDTH, HEIGHT)
        arm = self._arm_body()
        try:
            for data.qpos[:], data.mocap_pos[:], data.mocap_quat[:] in self._frames:
                mujoco.mj_forward(model, data)
                focus = data.xpos[arm] + np.array([0.0, 0.0, 0.2])
                azimuth = _heading_deg(data.xmat[arm].reshape(3, 3) @ self._forward) + AZIMUTH_DEG
                renderer.look_at(focus, DISTANCE_M, azimuth, ELEVATION_DEG)
                yield renderer.picture(data)
        finally:
            renderer.close()

    def _arm_body(self) -> int:
        """Return the body of the first arm's base."""
        first = self._cell.model.body_parentid
        joint = self._cell.model.jnt_bodyid[0]
        return int(first[joint])


def _heading_deg(direction: Array) -> float:
    """Return the angle of a direction (3,) about the vertical, from the world's x axis."""
    return float(np.degrees(np.arctan2(direction[1], direction[0])))
