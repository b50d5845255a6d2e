"""Takes images of a model: renders them off screen, and exposes a sensor with noise."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.backends.simulation.cameras.image_camera_spec import ImageCameraSpec
from skillc_runtime.backends.simulation.cameras.photo_model import CAMERA, FLIP
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.platforms.gl import make_gl_context
from skillc_runtime.vision.inspected_surface import encode

FINER = 2
"""Pixels along each edge of a pixel that are rendered."""

SHADOW_PIXELS, MOST_GEOMS = 2048, 4000

FULL_SHARE = 0.7
"""The exposure lets the darkest of the bright parts of an image fill this share of a pixel."""


def set_offscreen(model: Any, lens_size: tuple[int, int]) -> None:
    """Let a model be rendered at the size of the images of a camera, width x height pixels."""
    model.vis.global_.offwidth, model.vis.global_.offheight = (FINER * each for each in lens_size)
    model.vis.quality.offsamples, model.vis.quality.shadowsize = 0, SHADOW_PIXELS


def require_rendering(size: tuple[int, int]) -> None:
    """RenderingError where nothing renders images of a size, width x height pixels."""
    _, context = make_gl_context(*(FINER * each for each in size))
    context.free()


def render(model: Any, data: Any, size: tuple[int, int]) -> Array:
    """Return the light (height, width, 3) from 0 to 1 that the camera sees; RenderingError without a GL library."""
    with _renderer(model, data, size) as draw:
        fine = draw(False)
    return np.asarray(np.add.reduce(_parts(fine), dtype=np.uint16) / (FINER**2 * 255.0))


def find_pixels_of(
    model: Any, data: Any, size: tuple[int, int], camera: Pose, is_wanted: Callable[[str], bool]
) -> NDArray[np.bool_]:
    """Return which pixels (height, width) show a body with a wanted name, from a pose of the camera in the world."""
    wanted = np.array([is_wanted(model.body(each).name) for each in range(model.nbody)])
    number = model.camera(CAMERA).id
    kept = data.cam_xpos[number].copy(), data.cam_xmat[number].copy()
    data.cam_xpos[number], data.cam_xmat[number] = camera.position, (camera.rotation @ FLIP).ravel()
    with _renderer(model, data, size) as draw:
        geoms = draw(True)
    data.cam_xpos[number], data.cam_xmat[number] = kept
    is_shown = np.append(wanted[model.geom_bodyid], False)  # what no geom shows has the last number
    return np.asarray(np.logical_or.reduce([is_shown[part] for part in _parts(geoms)]))


def _parts(fine: NDArray[Any]) -> list[NDArray[Any]]:
    """Return the parts of each pixel of an image (FINER h, FINER w, ..), which are as many images (h, w, ..)."""
    return [fine[row::FINER, column::FINER] for row in range(FINER) for column in range(FINER)]


@contextmanager
def _renderer(model: Any, data: Any, size: tuple[int, int]) -> Iterator[Callable[[bool], NDArray[Any]]]:
    """Yield what draws an image (FINER h, FINER w, 3); with True numbers (FINER h, FINER w) of geoms, -1 for none."""
    width, height = (FINER * each for each in size)
    _, context = make_gl_context(width, height)
    context.make_current()
    gl = mujoco.MjrContext(model, mujoco.mjtFontScale.mjFONTSCALE_100)
    mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, gl)
    scene, option, view = mujoco.MjvScene(model, maxgeom=MOST_GEOMS), mujoco.MjvOption(), mujoco.MjvCamera()
    option.sitegroup[:] = 0
    view.type, view.fixedcamid = mujoco.mjtCamera.mjCAMERA_FIXED, model.camera(CAMERA).id
    area = mujoco.MjrRect(0, 0, width, height)

    def draw(as_numbers: bool) -> NDArray[Any]:
        scene.flags[mujoco.mjtRndFlag.mjRND_SEGMENT] = as_numbers
        scene.flags[mujoco.mjtRndFlag.mjRND_IDCOLOR] = as_numbers
        scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = not as_numbers
        scene.flags[mujoco.mjtRndFlag.mjRND_HAZE] = scene.flags[mujoco.mjtRndFlag.mjRND_REFLECTION] = False
        mujoco.mjv_updateScene(model, data, option, None, view, mujoco.mjtCatBit.mjCAT_ALL, scene)
        mujoco.mjr_render(area, scene, gl)
        pixels = np.empty((height, width, 3), dtype=np.uint8)
        mujoco.mjr_readPixels(pixels, None, area, gl)
        return (_read_geoms(pixels, scene) if as_numbers else pixels)[::-1]

    try:
        yield draw
    finally:
        gl.free()
        context.free()


def _read_geoms(pixels: NDArray[np.uint8], scene: Any) -> NDArray[np.int32]:
    """Return the numbers (h, w) of the geoms that pixels (h, w, 3) show in the colours of a scene, -1 for none."""
    red, green, blue = (pixels[..., channel].astype(np.int32) for channel in range(3))
    numbers = red + (green << 8) + (blue << 16)
    geoms = np.full(scene.ngeom + 1, -1, dtype=np.int32)
    for each in scene.geoms[: scene.ngeom]:
        if each.objtype == mujoco.mjtObj.mjOBJ_GEOM:
            geoms[each.segid + 1] = each.objid
    return geoms[np.where(numbers <= scene.ngeom, numbers, 0)]


def expose(light: Array, colour: Array, camera: ImageCameraSpec, rng: np.random.Generator) -> NDArray[np.uint8]:
    """Return the image (h, w, 3), as sRGB, of light (h, w, 3) of a colour (3,), exposed for its bright parts.

    The variance of the electrons of a pixel is their number plus that of reading (EMVA 1288, linear model).
    """
    tinted = light * colour
    gain = FULL_SHARE / max(float(np.quantile(tinted, 1.0 - camera.bright_share)), 1e-3)
    electrons = np.clip(gain * tinted, 0.0, 1.5) * camera.full_well
    noisy = electrons + rng.normal(size=light.shape) * np.sqrt(electrons + camera.read_noise**2)
    return np.rint(encode(noisy / camera.full_well)).astype(np.uint8)
