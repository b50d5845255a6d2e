"""Renders pictures of a simulated cell off screen, with a GL library."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Literal, TypeAlias

import mujoco
import numpy as np
from numpy.typing import NDArray
from PIL import Image

from skillc_runtime.film.annotations import NO_ANNOTATIONS, Annotations
from skillc_runtime.film.camera import CameraView, Projection
from skillc_runtime.film.labels import draw_labels
from skillc_runtime.film.props import Prop
from skillc_runtime.film.windows import (
    DrawnGeoms,
    Spheres,
    Window,
    find_changes,
    find_window,
    join_spheres,
    list_geoms,
)
from skillc_runtime.motion.pose import Array
from skillc_runtime.platforms.gl import RenderingError as RenderingError
from skillc_runtime.platforms.gl import make_gl_context
from skillc_runtime.world.space.shape.solids import Kind

Picture = NDArray[np.uint8]


@dataclass(frozen=True, slots=True)
class Quality:
    """What a picture may cost.

    It is rendered `scale` times larger and reduced: edges become smooth, faster than with multisampling.
    `shadow_pixels`: edge of the shadow map; 0 for no shadows. `faces`: into how many round shapes are cut around.
    """

    scale: float
    shadow_pixels: int
    faces: int


STILL = Quality(2.0, 4096, 40)
FilmQuality: TypeAlias = Literal["draft", "standard", "fine"]
FILM_QUALITIES: dict[FilmQuality, Quality] = {
    "draft": Quality(1.0, 0, 20),
    "standard": Quality(1.25, 1024, 24),
    "fine": Quality(2.0, 4096, 40),
}

SHADOW_REACH = 1.3
"""How far there are shadows around the point in view, relative to the camera's distance.

Near the edge of the map that is towards the light a floor is in its own shadow; that edge is behind the camera.
"""

STEEP = -0.3
"""The vertical component of the direction of a light is at most this where shadows are short."""

MOST_GEOMS = 2500
GEOMS: dict[Kind, Any] = {
    "box": mujoco.mjtGeom.mjGEOM_BOX,
    "cylinder": mujoco.mjtGeom.mjGEOM_CYLINDER,
    "sphere": mujoco.mjtGeom.mjGEOM_SPHERE,
    "capsule": mujoco.mjtGeom.mjGEOM_CAPSULE,
    "hull": mujoco.mjtGeom.mjGEOM_BOX,
}
"""How a solid is drawn; the hull of a mesh as its box."""

TRAIL_RGBA, TRAIL_PIXELS = (0.05, 0.35, 0.75), 3.0


def check_rendering() -> str:
    """Render one picture and return the name of the GL library; RenderingError if there is none."""
    renderer = Renderer(mujoco.MjModel.from_xml_string("<mujoco/>"), 16, 16)
    renderer.close()
    return renderer.library


class Renderer:
    """Renders states of a model, with props, to pictures of width x height pixels.

    While the camera stands still, only what can differ from the last picture is rendered.
    Raises RenderingError if there is no GL library.
    """

    def __init__(
        self, model: Any, width: int, height: int, props: Sequence[Prop] = (), quality: Quality = STILL
    ) -> None:
        self._model, self._size, self._props = model, (width, height), tuple(props)
        self._scale = quality.scale
        rendered = round(quality.scale * width), round(quality.scale * height)
        self.library, self._context = make_gl_context(*rendered)
        self._context.make_current()
        _set_quality(model, rendered, quality)
        self._gl = mujoco.MjrContext(model, mujoco.mjtFontScale.mjFONTSCALE_100)
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, self._gl)
        self._scene = mujoco.MjvScene(model, maxgeom=MOST_GEOMS)
        self._scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = quality.shadow_pixels > 0
        self._scene.flags[mujoco.mjtRndFlag.mjRND_REFLECTION] = False
        self._scene.flags[mujoco.mjtRndFlag.mjRND_HAZE] = True
        self._camera, self._option = mujoco.MjvCamera(), mujoco.MjvOption()
        self._option.sitegroup[:] = 0  # sites are not shown
        self._painted: set[int] = set()
        self._last: tuple[CameraView, DrawnGeoms] | None = None
        self._pixels = np.zeros((rendered[1], rendered[0], 3), dtype=np.uint8)
        """The last picture without labels, as GL has it: the lowest row first."""

    def picture(self, data: Any, view: CameraView, annotations: Annotations = NO_ANNOTATIONS) -> Picture:
        """Return the picture (height, width, 3) of a state."""
        self._set_scene(data, view, annotations)
        height, width, _ = self._pixels.shape
        projection = Projection(view, self._model.vis.global_.fovy, width, height)
        window = self._find_window(data, view, projection)
        if window is not None:
            self._render(window)
        image = Image.fromarray(self._pixels[::-1])
        draw_labels(image, annotations, projection, self._scale)
        return np.asarray(
            image.resize(self._size, Image.Resampling.BOX if self._scale == 2 else Image.Resampling.BILINEAR)
        )

    def _find_window(self, data: Any, view: CameraView, projection: Projection) -> Window | None:
        """Return the window of what can differ from the last picture, with shadows; None if nothing does."""
        geoms, last, painted = list_geoms(self._model, self._scene), self._last, self._painted
        self._last, self._painted = (view, geoms), set()
        lights = [each for each in self._scene.lights[: self._scene.nlight] if each.castshadow]
        if last is None or not view.is_same(last[0]) or not all(map(_is_steep, lights)):
            return Window(0, 0, projection.width, projection.height)
        moved = find_changes(last[1], geoms)
        shadows = [moved.on_floor(np.array(each.dir, dtype=float)) for each in lights]
        sheets = [each for each in range(self._model.ngeom) if self._texture_of(each) in painted]
        around = Spheres(data.geom_xpos[sheets], self._model.geom_rbound[sheets])
        return find_window(join_spheres([moved, *shadows, around]), view, projection)

    def _texture_of(self, geom: int) -> int:
        material = self._model.geom_matid[geom]
        return -1 if material < 0 else int(self._model.mat_texid[material, mujoco.mjtTextureRole.mjTEXROLE_RGB])

    def _render(self, window: Window) -> None:
        """Render a window of the picture: through the part of the camera's opening that it is seen through."""
        height, width, _ = self._pixels.shape
        cameras = self._scene.camera
        kept = [(each.frustum_center, each.frustum_bottom, each.frustum_top) for each in cameras]
        for each in cameras:
            low, pixel = each.frustum_bottom, (each.frustum_top - each.frustum_bottom) / height
            each.frustum_center += pixel * (window.left + window.right - width) / 2
            each.frustum_bottom, each.frustum_top = low + pixel * window.bottom, low + pixel * window.top
        part = np.empty((window.top - window.bottom, window.right - window.left, 3), dtype=np.uint8)
        area = mujoco.MjrRect(window.left, window.bottom, part.shape[1], part.shape[0])
        mujoco.mjr_render(area, self._scene, self._gl)
        mujoco.mjr_readPixels(part, None, area, self._gl)
        self._pixels[window.pixels] = part
        for each, (centre, bottom, top) in zip(cameras, kept, strict=True):
            each.frustum_center, each.frustum_bottom, each.frustum_top = centre, bottom, top

    def paint(self, texture: int, colours: NDArray[np.uint8]) -> None:
        """Replace the colours (rows along y, columns along x, 3) of a texture on a box, by its id."""
        start = int(self._model.tex_adr[texture])
        self._model.tex_data[start : start + colours.size] = colours[::-1].ravel()
        mujoco.mjr_uploadTexture(self._model, self._gl, texture)
        self._painted.add(texture)

    def close(self) -> None:
        """Release the GL resources."""
        self._gl.free()
        self._context.free()

    def _set_scene(self, data: Any, view: CameraView, annotations: Annotations) -> None:
        self._gl.shadowClip = SHADOW_REACH * view.distance
        self._camera.lookat[:] = view.point
        self._camera.distance = view.distance
        self._camera.azimuth, self._camera.elevation = view.azimuth_deg, view.elevation_deg
        everything = mujoco.mjtCatBit.mjCAT_ALL
        mujoco.mjv_updateScene(self._model, data, self._option, None, self._camera, everything, self._scene)
        for light in self._scene.lights[: self._scene.nlight]:
            if not light.headlight:
                light.dir[:] = _turned(light.dir, view.azimuth_deg)
                light.pos[:] = view.point - self._gl.shadowClip * light.dir
        for prop in (*self._props, *annotations.ghosts):
            self._add(prop)
        for trail in annotations.trails:
            self._add_trail(trail)

    def _add(self, prop: Prop) -> None:
        half = prop.size / 2
        if prop.kind == "capsule":
            half = np.array([half[0], half[1], half[2] - half[0]])
        self._init_geom(GEOMS[prop.kind], half, prop.pose.position, prop.pose.rotation, prop.rgba)

    def _add_trail(self, points: Array) -> None:
        """Draw a line through points (n, 3), the fainter the farther from the last one."""
        for number, (start, end) in enumerate(pairwise(points), 1):
            if self._scene.ngeom < MOST_GEOMS:
                rgba = (*TRAIL_RGBA, number / len(points))
                geom = self._init_geom(mujoco.mjtGeom.mjGEOM_LINE, np.zeros(3), start, np.eye(3), rgba)
                mujoco.mjv_connector(geom, mujoco.mjtGeom.mjGEOM_LINE, TRAIL_PIXELS * self._scale, start, end)

    def _init_geom(self, kind: Any, half: Array, position: Array, rotation: Array, rgba: tuple[float, ...]) -> Any:
        geom = self._scene.geoms[self._scene.ngeom]
        mujoco.mjv_initGeom(geom, kind, half, position, rotation.ravel(), np.array(rgba, dtype=np.float32))
        geom.specular, geom.shininess = 0.1, 0.2
        self._scene.ngeom += 1
        return geom


def _is_steep(light: Any) -> bool:
    """Whether the shadows in a light are on the floor, not far from what casts them."""
    return bool(light.type == mujoco.mjtLightType.mjLIGHT_DIRECTIONAL and light.dir[2] < STEEP)


def _set_quality(model: Any, rendered: tuple[int, int], quality: Quality) -> None:
    settings = model.vis.quality
    settings.offsamples, settings.shadowsize = 0, quality.shadow_pixels
    settings.numslices, settings.numstacks = quality.faces, quality.faces // 2
    model.vis.global_.offwidth, model.vis.global_.offheight = rendered


def _turned(direction: Array, azimuth_deg: float) -> Array:
    """Return a direction (3,) turned about the vertical."""
    angle = np.radians(azimuth_deg)
    x, y, z = direction
    return np.array([x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle), z])
