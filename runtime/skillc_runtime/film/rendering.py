"""Pictures of a simulated cell, drawn off screen where a GL library is installed."""

from __future__ import annotations

import ctypes.util
import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import mujoco
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.film.props import Prop
from skillc_runtime.motion.pose import Array

Picture = NDArray[np.uint8]
Quality: TypeAlias = Literal["film", "still"]
"""A still has shadows and smooth edges; where a processor draws, each costs as much as a picture of a film."""

SAMPLES = {"film": 2, "still": 8}
"""Samples a pixel."""

LIGHT_FROM = (-0.35, 0.5, -1.0)
"""Where the light shines: it is as far as the sun, so that whatever drives about is lit alike."""

SUN, HEADLIGHT = 0.45, (0.4, 0.33)
"""How bright the light is; how much the camera's brightens everything, and what faces it."""

SHADOW_M, SHADOW_PIXELS = 1.5, 8192
"""How far from the middle of a still shadows reach, and how many pixels the map of them has."""

MOST_GEOMS = 2000
PLATFORMS = {"EGL": "egl", "OSMesa": "osmesa"}
"""GL libraries that draw without a screen, and what PyOpenGL calls them."""


class RenderingError(RuntimeError):
    """There is no GL library that draws off screen; the message says how to get one."""


@dataclass(frozen=True, slots=True)
class CameraView:
    """A camera that looks at a point (3,) of the world from `distance` m."""

    point: Array
    distance: float
    azimuth_deg: float
    elevation_deg: float


def check_rendering() -> str:
    """Draw one picture and return the name of the GL library that did; RenderingError where none can."""
    renderer = Renderer(mujoco.MjModel.from_xml_string("<mujoco/>"), 16, 16)
    renderer.close()
    return renderer.library


class Renderer:
    """Draws a model's states, width x height pixels, and some props that the model does not have.

    RenderingError when there is no GL library.
    """

    def __init__(
        self, model: Any, width: int, height: int, props: Sequence[Prop] = (), quality: Quality = "film"
    ) -> None:
        self._model, self._size, self._props = model, (height, width), tuple(props)
        self.library, context = _context(width, height)
        self._context = context
        self._context.make_current()
        model.vis.quality.offsamples = SAMPLES[quality]
        model.vis.global_.offwidth, model.vis.global_.offheight = width, height
        model.vis.quality.shadowsize = SHADOW_PIXELS
        model.vis.map.shadowclip = SHADOW_M / model.stat.extent
        self._gl = mujoco.MjrContext(model, mujoco.mjtFontScale.mjFONTSCALE_100)
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, self._gl)
        self._scene = mujoco.MjvScene(model, maxgeom=MOST_GEOMS)
        self._scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = quality == "still"
        self._scene.flags[mujoco.mjtRndFlag.mjRND_REFLECTION] = False
        self._camera, self._option = mujoco.MjvCamera(), mujoco.MjvOption()
        self._option.sitegroup[:] = 0  # places that only programs need

    def picture(self, data: Any, views: Sequence[CameraView]) -> Picture:
        """Return the picture (height, width, 3) of a state: views side by side, equally wide."""
        height, width = self._size
        each = width // len(views)
        for number, view in enumerate(views):
            self._draw(data, view, mujoco.MjrRect(number * each, 0, each, height))
        pixels = np.empty((height, width, 3), dtype=np.uint8)
        mujoco.mjr_readPixels(pixels, None, mujoco.MjrRect(0, 0, width, height), self._gl)
        return pixels[::-1]

    def close(self) -> None:
        """Give the GL resources back."""
        self._gl.free()
        self._context.free()

    def _draw(self, data: Any, view: CameraView, where: Any) -> None:
        self._camera.lookat[:] = view.point
        self._camera.distance = view.distance
        self._camera.azimuth, self._camera.elevation = view.azimuth_deg, view.elevation_deg
        everything = mujoco.mjtCatBit.mjCAT_ALL
        mujoco.mjv_updateScene(self._model, data, self._option, None, self._camera, everything, self._scene)
        for light in self._scene.lights[: self._scene.nlight]:
            _shine(light)
        for prop in self._props:
            self._add(prop)
        mujoco.mjr_render(where, self._scene, self._gl)

    def _add(self, prop: Prop) -> None:
        geom = self._scene.geoms[self._scene.ngeom]
        rgba = np.array(prop.rgba, dtype=np.float32)
        box = mujoco.mjtGeom.mjGEOM_BOX
        mujoco.mjv_initGeom(geom, box, prop.size / 2, prop.pose.position, prop.pose.rotation.ravel(), rgba)
        self._scene.ngeom += 1


def _shine(light: Any) -> None:
    """Make the sun of a lamp, and let the light from the camera only brighten what the sun leaves dark."""
    if light.headlight:
        light.ambient[:], light.diffuse[:] = HEADLIGHT
        return
    light.type = mujoco.mjtLightType.mjLIGHT_DIRECTIONAL
    light.dir[:] = np.array(LIGHT_FROM) / np.linalg.norm(LIGHT_FROM)
    light.diffuse[:] = SUN


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
