"""The model that images are rendered from: a cell with dirt on its surfaces, markers, lamps and a camera."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.backends.simulation.cameras.image_camera_spec import ImageCameraSpec, PrintedPart
from skillc_runtime.backends.simulation.cameras.light_drawn import DrawnLight
from skillc_runtime.backends.simulation.cameras.part_faces import TrueFace
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.motion.pose import Array, Pose, quaternion_from_rotation
from skillc_runtime.vision.inspected_surface import InspectedSurface, SurfaceLook, linear, marker_centres
from skillc_runtime.vision.markers import draw_marker

CAMERA = "photo/camera"
FLIP = np.diag([1.0, -1.0, -1.0])
"""The axes of an optical frame in that of a camera of MuJoCo, which looks along -z with y up."""

ABOVE_M = 0.0004
"""How far sheets lie above the surface: enough for the depths of the picture."""

GRID_M = 0.01
"""Edge of the squares of a sheet: light is computed at their corners."""

MODULE_PIXELS, INK = 16, 0.04
"""Pixels of a module of a marker, and what share of the light its black reflects."""


def dirt_texture(surface: str) -> str:
    """Return the name of the texture of a surface's dirt, by the surface's name in the model."""
    return f"photo/dirt/{surface}"


def face_texture(part: str) -> str:
    """Return the name of the texture of a part's face, by the part's name in the model."""
    return f"photo/face/{part}"


def add_sheets(spec: Any, names: dict[str, str], true: dict[str, Pose], camera: ImageCameraSpec, pixels: int) -> None:
    """Lay a sheet with a texture, `pixels` a cell of 1 cm, on each marked surface, and markers beside it.

    names, true: the name and the true pose in the world of each surface by IRI.
    """
    for individual, surface in camera.surfaces.items():
        name, pose = names[individual], true[individual]
        columns, rows = (max(1, round(each / 0.01)) * pixels for each in surface.size)
        clean = np.broadcast_to(linear(surface.look.clean), (rows, columns, 3))
        _add_sheet(spec, dirt_texture(name), pose, surface.size, to_pixels(clean))
        _add_markers(spec, name, pose, surface)


def _add_markers(spec: Any, name: str, pose: Pose, surface: InspectedSurface) -> None:
    assert surface.markers is not None
    side = np.full(2, surface.markers.plate_m)
    for number, centre in enumerate(marker_centres(surface)):
        drawn = draw_marker(surface.markers.first + number, MODULE_PIXELS)[::-1] > 0
        shades = linear(surface.look.paper) * np.where(drawn, 1.0, INK)[:, :, None]
        _add_sheet(spec, f"photo/marker/{name}/{number}", pose @ Pose(centre, np.eye(3)), side, to_pixels(shades))


def to_pixels(light: Array) -> NDArray[np.uint8]:
    """Return the pixels of a texture of the light (m, n, 3) from 0 to 1 that it reflects."""
    return np.rint(255.0 * np.clip(light, 0.0, 1.0)).astype(np.uint8)


def amounts_to_pixels(amount: Array, look: SurfaceLook) -> NDArray[np.uint8]:
    """Return the pixels (m, n, 3) of a texture of amounts of dirt (m, n), lowest row first."""
    clean, dirt = linear(look.clean), linear(look.dirt)
    return to_pixels(clean + amount[..., None] * (dirt - clean))


def add_faces(
    spec: Any, faces: Mapping[str, TrueFace], names: Mapping[str, str], parts: Mapping[str, PrintedPart]
) -> None:
    """Lay sheets with the faces of parts, all by IRI, on their upper sides; they move with the parts."""
    for part, face in faces.items():
        look, top = parts[part].look, Pose(np.array([0.0, 0.0, parts[part].height_m / 2]), np.eye(3))
        block = spec.body(part_name(names[part], "block"))
        _add_sheet(spec, face_texture(names[part]), top, np.array(look.size), to_pixels(face.reflectance), block)


def _add_sheet(
    spec: Any, name: str, pose: Pose, size: Array, pixels: NDArray[np.uint8], parent: Any | None = None
) -> None:
    """Add a flat mesh of size (2,) in m with a texture (rows, columns, 3), lowest row first, without contacts.

    parent: the body in whose frame its pose is; the world unless stated.
    """
    texture = spec.add_texture(name=name, type=mujoco.mjtTexture.mjTEXTURE_2D)
    texture.height, texture.width, texture.nchannel = *pixels.shape[:2], 3
    texture.data = pixels.tobytes()
    material = spec.add_material(name=name, specular=0.0, shininess=0.5)
    material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = name
    columns, rows = (max(1, round(float(each) / GRID_M)) for each in size)
    u, v = np.meshgrid(np.linspace(0.0, 1.0, columns + 1), np.linspace(0.0, 1.0, rows + 1))
    corner = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    right, up = corner + 1, corner + columns + 1
    faces = np.concatenate([np.stack([corner, right, up + 1], 1), np.stack([corner, up + 1, up], 1)])
    vertices = np.stack([(u - 0.5) * size[0], (v - 0.5) * size[1], np.zeros_like(u)], axis=-1)
    mesh = spec.add_mesh(name=name)
    mesh.uservert, mesh.userface = vertices.ravel().tolist(), faces.ravel().tolist()
    mesh.usertexcoord = np.stack([u, v], axis=-1).ravel().tolist()
    mesh.usernormal = np.tile([0.0, 0.0, 1.0], u.size).tolist()
    mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
    place = pose @ Pose(np.array([0.0, 0.0, ABOVE_M]), np.eye(3))
    carrier = spec.worldbody if parent is None else parent
    geom = carrier.add_geom(name=name, type=mujoco.mjtGeom.mjGEOM_MESH, meshname=name, material=name)
    geom.pos, geom.quat = place.position, quaternion_from_rotation(place.rotation)
    geom.contype = geom.conaffinity = 0
    geom.mass = 0.0


def light_up(spec: Any, drawn: DrawnLight, ring: float, middle: Array, mirroring: list[str]) -> None:
    """Replace all light by one that was drawn and a lamp at the camera, `ring` times as bright as all other light.

    middle (3,) in m of the world: what is looked at. mirroring: materials that mirror the light.
    """
    light = drawn.dimmed(1.0 + ring)
    own = ring / (1.0 + ring)
    for each in list(spec.lights):
        spec.delete(each)
    head = spec.visual.headlight
    head.ambient, head.diffuse, head.specular = [light.ambient] * 3, [own] * 3, [own] * 3
    far = spec.worldbody.add_light(type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL, castshadow=True)
    far.dir, far.diffuse, far.specular = light.direction, [light.far] * 3, [light.far] * 3
    far.pos = middle - 2.0 * light.direction
    lamp = spec.worldbody.add_light(type=mujoco.mjtLightType.mjLIGHT_POINT, castshadow=False)
    lamp.pos, lamp.dir = middle + light.lamp, -light.lamp
    # Light falls off with the square of the distance; above the middle it is as bright as stated.
    away = float(light.lamp @ light.lamp)
    lamp.attenuation = [0.0, 0.0, 1.0 / away]
    lamp.diffuse, lamp.specular = [light.near] * 3, [light.near] * 3
    for each in (far, lamp):
        each.ambient = [0.0] * 3
    for name in mirroring:
        material = spec.material(name)
        material.specular, material.shininess = light.shine, 0.6


def add_camera(spec: Any, camera: ImageCameraSpec, true: Pose, flange: str | None) -> None:
    """Add the camera at its true pose in the world, or on the site `flange` of an arm."""
    half = camera.lens.height / 2 / camera.lens.fy
    site = None if flange is None else spec.site(flange)
    body = spec.worldbody if site is None else site.parent
    placed = true if site is None else Pose.of(site.pos, site.quat) @ true
    added = body.add_camera(name=CAMERA, fovy=float(2 * np.degrees(np.arctan(half))))
    added.pos, added.quat = placed.position, quaternion_from_rotation(placed.rotation @ FLIP)
