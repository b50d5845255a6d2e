"""Pictures of a simulated cell, drawn off screen where a GL library is installed."""

from __future__ import annotations

import ctypes.util
import os
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

Picture = NDArray[np.uint8]

SAMPLES = 2
"""Samples a pixel: where a processor draws, each costs as much as a picture."""

PLATFORMS = {"EGL": "egl", "OSMesa": "osmesa"}
"""GL libraries that draw without a screen, and what PyOpenGL calls them."""


class RenderingError(RuntimeError):
    """There is no GL library that draws off screen; the message says how to get one."""


def check_rendering() -> str:
    """Draw one picture and return the name of the GL library that did; RenderingError where none can."""
    renderer = Renderer(mujoco.MjModel.from_xml_string("<mujoco/>"), 16, 16)
    renderer.close()
    return renderer.library


class Renderer:
    """Draws a model's states, width x height pixels, from a camera that looks at a point.

    RenderingError when there is no GL library.
    """

    def __init__(self, model: Any, width: int, height: int) -> None:
        self._model, self._size = model, (height, width)
        self.library, context = _context(width, height)
        self._context = context
        self._context.make_current()
        model.vis.quality.offsamples = SAMPLES
        model.vis.global_.offwidth, model.vis.global_.offheight = width, height
        self._gl = mujoco.MjrContext(model, mujoco.mjtFontScale.mjFONTSCALE_100)
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, self._gl)
        self._scene = mujoco.MjvScene(model, maxgeom=2000)
        for costly in (mujoco.mjtRndFlag.mjRND_SHADOW, mujoco.mjtRndFlag.mjRND_REFLECTION):
            self._scene.flags[costly] = False
        self.camera = mujoco.MjvCamera()

    def look_at(self, point: NDArray[np.float64], distance: float, azimuth_deg: float, elevation_deg: float) -> None:
        """Place the camera `distance` m from a point (3,) of the world."""
        self.camera.lookat[:] = point
        self.camera.distance, self.camera.azimuth, self.camera.elevation = distance, azimuth_deg, elevation_deg

    def picture(self, data: Any) -> Picture:
        """Return the picture (height, width, 3) of a state."""
        everything = mujoco.mjtCatBit.mjCAT_ALL
        mujoco.mjv_updateScene(self._model, data, mujoco.MjvOption(), None, self.camera, everything, self._scene)
        viewport = mujoco.MjrRect(0, 0, self._size[1], self._size[0])
        mujoco.mjr_render(viewport, self._scene, self._gl)
        pixels = np.empty((*self._size, 3), dtype=np.uint8)
        mujoco.mjr_readPixels(pixels, None, viewport, self._gl)
        return pixels[::-1]

    def close(self) -> None:
        """Give the GL resources back."""
        self._gl.free()
        self._context.free()


def _context(width: int, height: int) -> tuple[str, Any]:
    """Return the first GL context that can be made, with its library's name."""
    reasons = []
    for library, platform in PLATFORMS.items():
        if ctypes.util.find_library(library) is None:
            continue
        if os.environ.setdefault("PYOPENGL_PLATFORM", platform) != platform:
            continue
        try:
            return library, _made(library, width, height)
        except (ImportError, AttributeError, RuntimeError) as error:
            reasons.append(f"{library}: {error}")
    tried = f" ({'; '.join(reasons)})" if reasons else ""
    raise RenderingError(f"no GL library draws off screen{tried}; on Debian: apt install libegl1 libgl1-mesa-dri")


def _made(library: str, width: int, height: int) -> Any:
    if library == "EGL":
        from mujoco.egl import GLContext
    else:
        from mujoco.osmesa import GLContext
    return GLContext(width, height)
