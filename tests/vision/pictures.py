"""Pictures of a surface that nothing rendered: dirt, markers, light, noise and an obstacle, computed with numpy."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from skillc_runtime.motion.pose import Array, Pose, exp
from skillc_runtime.vision.inspected_surface import (
    InspectedSurface,
    Markers,
    SurfaceLook,
    encode,
    linear,
    marker_centres,
)
from skillc_runtime.vision.lens import Lens
from skillc_runtime.vision.markers import draw_marker
from skillc_runtime.vision.opencv import load_opencv

PIXEL_M = 0.0005
"""Edge of a pixel of the texture, around the surface too."""

BORDER_M = 0.12
LENS = Lens(640, 480, 820.0, 818.0, 322.0, 238.0)
SURFACE = InspectedSurface(np.array([0.4, 0.3]), SurfaceLook(), Markers(0.036))
TABLE_RGB = (120.0, 96.0, 70.0)


@dataclass(frozen=True)
class Lighting:
    """Light of a picture: exposure, colour, slopes along x and y, a bright spot and a shadow in m of the surface."""

    exposure: float = 0.7
    colour: tuple[float, float, float] = (1.0, 1.0, 1.0)
    slope: tuple[float, float] = (0.0, 0.0)
    falloff: float = 0.0
    glare: tuple[float, float, float, float] | None = None
    shadow: tuple[float, float, float, float] | None = None


@dataclass(frozen=True)
class Photo:
    """A picture, the true amount of dirt of each cell (rows, columns), which are hidden, and the believed pose."""

    image: NDArray[np.uint8]
    amounts: Array
    believed: Pose
    true: Pose


def look_down(away_m: float = 0.8, tilt: tuple[float, float, float] = (0.35, 0.1, 0.15)) -> Pose:
    """Return the pose of a surface in the frame of a camera that looks at its middle, turned by a vector in rad."""
    facing = np.diag([1.0, -1.0, -1.0])
    return Pose(np.array([0.01, -0.005, away_m]), exp(np.array(tilt)) @ facing)


def texture_of(surface: InspectedSurface, amount: Array) -> Array:
    """Return the reflectance (m, n, 3) of the surface and what is around it, lowest row first."""
    border = round(BORDER_M / PIXEL_M)
    grain = np.random.default_rng(5).normal(0.0, 0.03, (amount.shape[0] + 2 * border, amount.shape[1] + 2 * border, 1))
    texture = linear(TABLE_RGB) * (1.0 + grain)
    look = surface.look
    inside = linear(look.clean) + amount[..., None] * (linear(look.dirt) - linear(look.clean))
    texture[border:-border, border:-border] = inside
    if surface.markers is not None:
        for number, centre in enumerate(marker_centres(surface)):
            _paste(texture, draw_marker(surface.markers.first + number, 12), centre, surface.markers.plate_m, look)
    return texture


def _paste(texture: Array, marker: NDArray[np.uint8], centre: Array, side_m: float, look: SurfaceLook) -> None:
    count = round(side_m / PIXEL_M)
    picked = (np.arange(count) * len(marker)) // count
    printed = linear(look.paper) * np.where(marker[picked][:, picked] > 0, 1.0, 0.04)[::-1, :, None]
    rows, columns = texture.shape[:2]
    left = round(centre[0] / PIXEL_M + columns / 2 - count / 2)
    low = round(centre[1] / PIXEL_M + rows / 2 - count / 2)
    texture[low : low + count, left : left + count] = printed


def light_at(x: Array, y: Array, light: Lighting) -> tuple[Array, Array]:
    """Return the light that falls on points, and the reflection of a lamp there, each of the shape of x."""
    bright = light.exposure * np.exp(light.slope[0] * x + light.slope[1] * y - light.falloff * (x**2 + y**2))
    if light.shadow is not None:
        sx, sy, width, depth = light.shadow
        bright = bright * np.where((np.abs(x - sx) < width) & (y > sy), 1.0 - depth, 1.0)
    glare = np.zeros_like(x)
    if light.glare is not None:
        gx, gy, size, strength = light.glare
        glare = strength * np.exp(-((x - gx) ** 2 + (y - gy) ** 2) / (2 * size**2))
    return bright, glare


def take_photo(
    surface: InspectedSurface,
    amount: Array,
    light: Lighting = Lighting(),
    seed: int = 0,
    pose: Pose | None = None,
    arm: tuple[float, float, float, float] | None = None,
    error: tuple[float, float] = (0.008, 0.02),
) -> Photo:
    """Return a picture of amounts of dirt (m, n), lowest row first, in pixels of 0.5 mm.

    arm: columns and rows between which a metal arm is in the way. error: of the believed pose, in m and rad.
    """
    rng = np.random.default_rng(seed)
    true = look_down() if pose is None else pose
    texture = texture_of(surface, amount)
    fine = 2
    ways = _rays(fine) @ true.rotation.astype(np.float32)  # in the frame of the surface
    origin = true.inverse().position.astype(np.float32)
    reach = -origin[2] / ways[..., 2]
    x, y = origin[0] + ways[..., 0] * reach, origin[1] + ways[..., 1] * reach
    at = [x / PIXEL_M + texture.shape[1] / 2 - 0.5, y / PIXEL_M + texture.shape[0] / 2 - 0.5]
    wall = tuple(linear((90.0, 90.0, 90.0)).tolist())
    seen = load_opencv().remap(texture.astype(np.float32), at[0], at[1], 1, borderMode=0, borderValue=wall)
    bright, glare = light_at(x, y, light)
    radiance = bright[..., None] * seen + glare[..., None]
    radiance = radiance.reshape(LENS.height, fine, LENS.width, fine, 3).mean(axis=(1, 3)) * np.array(light.colour)
    if arm is not None:
        left, right, top, bottom = (round(each) for each in arm)
        radiance[top:bottom, left:right] = 0.45 * light.exposure * np.linspace(0.3, 1.0, right - left)[None, :, None]
    # Photon noise and the noise of reading, of a sensor that is full at 10,000 electrons.
    noisy = radiance + rng.normal(size=radiance.shape) * np.sqrt(np.maximum(radiance, 0) / 1e4 + 2e-6)
    image = np.rint(encode(noisy)).astype(np.uint8)
    moved = Pose(
        true.position + rng.uniform(-error[0], error[0], 3), exp(rng.uniform(-error[1], error[1], 3)) @ true.rotation
    )
    return Photo(image, cell_amounts(surface, amount), moved, true)


@cache
def _rays(fine: int) -> Array:
    """Return the rays (rows, columns, 3) of a camera through `fine` x `fine` points of each pixel."""
    columns, rows = (np.arange(each * fine, dtype=np.float32) for each in (LENS.width, LENS.height))
    x = ((columns + 0.5) / fine - 0.5 - LENS.cx) / LENS.fx
    y = ((rows + 0.5) / fine - 0.5 - LENS.cy) / LENS.fy
    return np.stack([*np.meshgrid(x, y), np.ones((len(y), len(x)))], axis=-1).astype(np.float32)


def cell_amounts(surface: InspectedSurface, amount: Array) -> Array:
    """Return the mean amount of dirt in each cell of 1 cm, lowest row first."""
    rows, columns = (round(each / 0.01) for each in surface.size[::-1])
    per = amount.shape[0] // rows
    return np.asarray(amount.reshape(rows, per, columns, per).mean(axis=(1, 3)))


def draw_dirt(surface: InspectedSurface, seed: int, share: float = 0.3) -> Array:
    """Return random amounts of dirt (m, n): blots with soft edges, of different thickness, on about a share."""
    rng = np.random.default_rng(seed)
    rows, columns = (round(each / PIXEL_M) for each in surface.size[::-1])
    y, x = np.mgrid[:rows, :columns] * PIXEL_M
    amount, area = np.zeros((rows, columns)), 0.0
    while area < share:
        cx, cy = rng.uniform(0, surface.size[0]), rng.uniform(0, surface.size[1])
        a, b, turn = rng.uniform(0.012, 0.07), rng.uniform(0.012, 0.05), rng.uniform(0, np.pi)
        u, v = np.cos(turn) * (x - cx) + np.sin(turn) * (y - cy), -np.sin(turn) * (x - cx) + np.cos(turn) * (y - cy)
        away = np.sqrt((u / a) ** 2 + (v / b) ** 2)
        amount = np.maximum(amount, rng.uniform(0.6, 1.0) * np.clip((1.0 - away) / 0.12, 0.0, 1.0))
        area = float((amount > 0.1).mean())
    return amount
