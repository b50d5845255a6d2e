"""The look of pictures: floor, lights, horizon and materials of a workshop, on a model that is only drawn."""

from __future__ import annotations

import colorsys
from collections.abc import Iterable, Mapping
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.devices.drawing import Drawing
from skillc_runtime.motion.pose import Array

SLAB_M, SLAB_PIXELS = 1.0, 256
"""Edge of a slab of the floor in m, and of its picture in pixels."""

FLOOR_GREY, FLOOR_GRAIN, JOINT_GREY = 172, 3.0, 148
"""Brightness of the floor, how much it varies, and of the joints between slabs."""

HORIZON, ZENITH = (0.84, 0.87, 0.89), (0.62, 0.69, 0.75)

KEY_FROM, KEY, KEY_SPECULAR = (0.55, -0.5, -1.0), 0.52, 0.25
"""Direction and brightness of the light that casts shadows. Lights turn with the camera, which looks along x here."""

FILL_FROM, FILL = (0.3, 0.8, -0.4), 0.15
"""Direction and brightness of the light on the other side, which casts none."""

AMBIENT, CAMERA_LIGHT = 0.42, 0.18
"""Brightness everywhere, and of a light at the camera."""

METAL, PAINT, RUBBER = (0.6, 0.7), (0.25, 0.4), (0.05, 0.1)
"""Strength and sharpness of the highlights of a material."""

GREY, DARK = 0.12, 0.35
"""A colour of less saturation is grey; a grey of less brightness is that of rubber, another one that of metal."""

THICKER = 1.012
"""Cylinders of devices are drawn thicker by this factor, because faces of equal place would flicker."""

HORIZON_M = 60.0
"""Distance up to which the floor is drawn."""

SHEET_M = 0.0001
"""Thickness of the sheet on a surface whose colours change."""

SURFACE_TEXTURE = "workshop/surface/"
"""Prefix of the name of the texture of a surface; its geom's name follows."""


def workshop_model(drawing: Drawing, spec: Any | None = None, textures: Mapping[str, tuple[int, int]] = {}) -> Any:
    """Return the `mujoco.MjModel` to draw a cell, with the same joints as its own.

    spec: its description, if it was changed. textures: rows and columns of a texture, which `paint` sets, for some
    surfaces by IRI.
    """
    described = drawing.describe_model() if spec is None else spec
    _set_surroundings(described)
    _set_floor(described)
    for surface, (rows, columns) in textures.items():
        _add_texture(described, drawing.surfaces[surface], rows, columns)
    _set_materials(described)
    _thicken(described, tuple(drawing.prefixes.values()))
    model = described.compile()
    model.vis.map.zfar = HORIZON_M / model.stat.extent
    return model


def find_texture(model: Any, drawing: Drawing, surface: str) -> int:
    """Return the id of the texture of a surface, by IRI."""
    return int(model.texture(SURFACE_TEXTURE + drawing.surfaces[surface]).id)


def _set_surroundings(spec: Any) -> None:
    sky = next(each for each in spec.textures if each.type == mujoco.mjtTexture.mjTEXTURE_SKYBOX)
    sky.rgb1, sky.rgb2 = HORIZON, ZENITH
    spec.visual.rgba.haze = [*HORIZON, 1.0]
    spec.visual.headlight.ambient, spec.visual.headlight.diffuse = [AMBIENT] * 3, [CAMERA_LIGHT] * 3
    spec.visual.headlight.specular = [0.05] * 3
    for light in list(spec.lights):
        spec.delete(light)
    for direction, brightness, specular, shadows in (
        (KEY_FROM, KEY, KEY_SPECULAR, True),
        (FILL_FROM, FILL, 0.0, False),
    ):
        light = spec.worldbody.add_light(type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL, castshadow=shadows)
        light.dir, light.ambient = np.array(direction) / np.linalg.norm(direction), [0.0] * 3
        light.diffuse, light.specular = [brightness] * 3, [specular] * 3


def _set_floor(spec: Any) -> None:
    """Let the floor reach the horizon, and lay it with slabs of concrete."""
    _add_image(spec, "workshop/floor", _concrete())
    material = spec.add_material(name="workshop/floor", texuniform=True, texrepeat=[1 / SLAB_M, 1 / SLAB_M])
    material.specular, material.shininess = RUBBER
    material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = "workshop/floor"
    floor = spec.geom("floor")
    floor.size[:2], floor.material, floor.rgba = 0.0, "workshop/floor", [1.0] * 4


def _concrete() -> NDArray[np.uint8]:
    """Return the picture (n, n, 3) of a slab, which continues at its edges; the same one each time."""
    rng = np.random.default_rng(7)
    grey = np.full((SLAB_PIXELS, SLAB_PIXELS), float(FLOOR_GREY))
    for cells, strength in ((4, 1.0), (16, 0.7), (SLAB_PIXELS, 0.6)):
        grey += strength * FLOOR_GRAIN * _smooth(rng.uniform(-1.0, 1.0, (cells, cells)))
    grey[[0, -1]] = grey[:, [0, -1]] = JOINT_GREY
    return np.repeat(grey[:, :, np.newaxis], 3, axis=2).astype(np.uint8)


def _smooth(values: Array) -> Array:
    """Interpolate values (n, n) on a torus to the pixels of a slab."""
    at = np.arange(SLAB_PIXELS) * len(values) / SLAB_PIXELS
    low, share = at.astype(int), (at % 1.0)
    high = (low + 1) % len(values)
    rows = values[low] * (1 - share)[:, np.newaxis] + values[high] * share[:, np.newaxis]
    return np.asarray(rows[:, low] * (1 - share) + rows[:, high] * share)


def _add_texture(spec: Any, geom: str, rows: int, columns: int) -> None:
    """Lay a thin sheet with a white texture on a box."""
    name = SURFACE_TEXTURE + geom
    _add_image(spec, name, np.full((rows, columns, 3), 255, dtype=np.uint8))
    material = spec.add_material(name=name)
    material.specular, material.shininess = PAINT
    material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = name
    box = spec.geom(geom)
    sheet = box.parent.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, material=name, contype=0, conaffinity=0, mass=0)
    sheet.size = [*box.size[:2], SHEET_M / 2]
    sheet.pos, sheet.quat = box.pos + np.array([0.0, 0.0, box.size[2] + SHEET_M / 2]), box.quat


def _add_image(spec: Any, name: str, image: NDArray[np.uint8]) -> None:
    rows, columns, channels = image.shape
    texture = spec.add_texture(name=name, type=mujoco.mjtTexture.mjTEXTURE_2D, width=columns, height=rows)
    texture.nchannel, texture.data = channels, image.tobytes()


def _set_materials(spec: Any) -> None:
    """Make grey parts metal, coloured ones painted, dark ones rubber, whether they have a material or only a colour."""
    for kind, (specular, shininess) in {"metal": METAL, "paint": PAINT, "rubber": RUBBER}.items():
        spec.add_material(name=f"workshop/{kind}", specular=specular, shininess=shininess)
    for material in spec.materials:
        if not material.name.startswith("workshop/"):
            material.specular, material.shininess = _finish(material.rgba)
    for geom in spec.geoms:
        if not geom.material:
            geom.material = f"workshop/{_kind(geom.rgba)}"


def _thicken(spec: Any, prefixes: tuple[str, ...]) -> None:
    for geom in spec.geoms:
        if geom.type == mujoco.mjtGeom.mjGEOM_CYLINDER and geom.parent.name.startswith(prefixes):
            geom.size[0] *= THICKER


def _finish(rgba: Iterable[float]) -> tuple[float, float]:
    return {"metal": METAL, "paint": PAINT, "rubber": RUBBER}[_kind(rgba)]


def _kind(rgba: Iterable[float]) -> str:
    red, green, blue, _ = rgba
    _, saturation, value = colorsys.rgb_to_hsv(red, green, blue)
    if value < DARK:
        return "rubber"
    return "metal" if saturation < GREY else "paint"
