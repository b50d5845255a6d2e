"""Renders pictures of a simulated cell off screen, with a GL library."""

from __future__ import annotations

import ctypes.util
import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import mujoco
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.film.annotations import Annotations, NameTag
from skillc_runtime.film.props import Prop
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.space.solids import Kind

Picture = NDArray[np.uint8]
Quality: TypeAlias = Literal["film", "still"]
"""A still has shadows and smooth edges, each of which takes as long as a picture of a film without a GPU."""

SAMPLES = {"film": 2, "still": 8}
"""Samples per pixel."""

LIGHT_FROM = (-0.35, 0.5, -1.0)
"""Direction of the light, which is directional so that moving robots are lit equally everywhere."""

SUN, HEADLIGHT = 0.45, (0.4, 0.33)
"""Brightness of the light; ambient and diffuse brightness of the light at the camera."""

SHADOW_M, SHADOW_PIXELS = 1.5, 8192
"""Distance from the centre of a still up to which there are shadows, and pixels of the shadow map."""

MOST_GEOMS = 2000
NO_ANNOTATIONS = Annotations()
GEOMS: dict[Kind, Any] = {
    "box": mujoco.mjtGeom.mjGEOM_BOX,
    "cylinder": mujoco.mjtGeom.mjGEOM_CYLINDER,
    "sphere": mujoco.mjtGeom.mjGEOM_SPHERE,
    "capsule": mujoco.mjtGeom.mjGEOM_CAPSULE,
    "hull": mujoco.mjtGeom.mjGEOM_BOX,
}
"""How a solid is drawn; the hull of a mesh as its box."""

PLATFORMS = {"EGL": "egl", "OSMesa": "osmesa"}
"""GL libraries that render off screen, and their names in PyOpenGL."""


class RenderingError(RuntimeError):
    """There is no GL library that renders off screen; the message says how to install one."""


@dataclass(frozen=True, slots=True)
class CameraView:
    """A camera that looks at a point (3,) in m of the world from `distance` m."""

    point: Array
    distance: float
    azimuth_deg: float
    elevation_deg: float


def check_rendering() -> str:
    """Render one picture and return the name of the GL library; RenderingError if there is none."""
    renderer = Renderer(mujoco.MjModel.from_xml_string("<mujoco/>"), 16, 16)
    renderer.close()
    return renderer.library


class Renderer:
    """Renders states of a model, with props, to pictures of width x height pixels.

    Raises RenderingError if there is no GL library.
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
        self._option.sitegroup[:] = 0  # sites are not shown

    def picture(self, data: Any, views: Sequence[CameraView], annotations: Annotations = NO_ANNOTATIONS) -> Picture:
        """Return the picture (height, width, 3) of a state: views side by side, equally wide."""
        height, width = self._size
        each = width // len(views)
        for number, view in enumerate(views):
            self._draw(data, view, mujoco.MjrRect(number * each, 0, each, height), annotations)
        pixels = np.empty((height, width, 3), dtype=np.uint8)
        mujoco.mjr_readPixels(pixels, None, mujoco.MjrRect(0, 0, width, height), self._gl)
        return pixels[::-1]

    def close(self) -> None:
        """Release the GL resources."""
        self._gl.free()
        self._context.free()

    def _draw(self, data: Any, view: CameraView, where: Any, annotations: Annotations) -> None:
        self._camera.lookat[:] = view.point
        self._camera.distance = view.distance
        self._camera.azimuth, self._camera.elevation = view.azimuth_deg, view.elevation_deg
        everything = mujoco.mjtCatBit.mjCAT_ALL
        mujoco.mjv_updateScene(self._model, data, self._option, None, self._camera, everything, self._scene)
        for light in self._scene.lights[: self._scene.nlight]:
            _set_light(light)
        for prop in (*self._props, *annotations.ghosts):
            self._add(prop)
        for tag in annotations.tags:
            self._write(tag)
        mujoco.mjr_render(where, self._scene, self._gl)

    def _add(self, prop: Prop) -> None:
        geom = self._scene.geoms[self._scene.ngeom]
        half = prop.size / 2
        if prop.kind == "capsule":
            half = np.array([half[0], half[1], half[2] - half[0]])
        rgba = np.array(prop.rgba, dtype=np.float32)
        mujoco.mjv_initGeom(geom, GEOMS[prop.kind], half, prop.pose.position, prop.pose.rotation.ravel(), rgba)
        self._scene.ngeom += 1

    def _write(self, tag: NameTag) -> None:
        geom = self._scene.geoms[self._scene.ngeom]
        black = np.array((0.0, 0.0, 0.0, 1.0), dtype=np.float32)
        mujoco.mjv_initGeom(geom, mujoco.mjtGeom.mjGEOM_LABEL, np.zeros(3), tag.point, np.eye(3).ravel(), black)
        geom.label = tag.text
        self._scene.ngeom += 1


def _set_light(light: Any) -> None:
    """Make a light directional, and let the light at the camera brighten only dark parts."""
    if light.headlight:
        light.ambient[:], light.diffuse[:] = HEADLIGHT
        return
    light.type = mujoco.mjtLightType.mjLIGHT_DIRECTIONAL
    light.dir[:] = np.array(LIGHT_FROM) / np.linalg.norm(LIGHT_FROM)
    light.diffuse[:] = SUN


def _context(width: int, height: int) -> tuple[str, Any]:
    """Return the first GL context that can be created, with the name of its library."""
    reasons = []
    for library, platform in PLATFORMS.items():
        if ctypes.util.find_library(library) is None:
            continue
        if os.environ.setdefault("PYOPENGL_PLATFORM", platform) != platform:
            continue
        try:
            return library, _create_context(library, width, height)
        except (ImportError, AttributeError, RuntimeError) as error:
            reasons.append(f"{library}: {error}")
    tried = f" ({'; '.join(reasons)})" if reasons else ""
    raise RenderingError(f"no GL library draws off screen{tried}; on Debian: apt install libegl1 libgl1-mesa-dri")


def _create_context(library: str, width: int, height: int) -> Any:
    if library == "EGL":
        from mujoco.egl import GLContext
    else:
        from mujoco.osmesa import GLContext
    return GLContext(width, height)
