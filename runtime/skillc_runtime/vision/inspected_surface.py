"""What is known of a surface before somebody looks at it: its size, its look, and the markers beside its corners."""

from __future__ import annotations

from typing import TypeAlias

import msgspec
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.motion.pose import Array

Rgb: TypeAlias = tuple[float, float, float]
"""Red, green and blue from 0 to 255 of a colour in white light, encoded as sRGB."""

MODULES = 6
"""Modules along the edge of a marker of `DICT_4X4_50`, with its black border; around it is a white rim of one."""

CORNERS = ((-1, 1), (1, 1), (1, -1), (-1, -1))
"""The signs of x and y at the corners of a square, in the order of ArUco: clockwise from the upper left one."""


class SurfaceLook(msgspec.Struct, frozen=True):
    """The colours of a clean surface, of dirt as thick as it gets, and of the white of the markers."""

    clean: Rgb = (246.0, 250.0, 252.0)
    dirt: Rgb = (171.0, 160.0, 140.0)
    paper: Rgb = (243.0, 243.0, 243.0)


class Markers(msgspec.Struct, frozen=True):
    """Four ArUco markers of `DICT_4X4_50` beside the corners of a surface, flat in its plane.

    The marker `first` is beside the corner with the least x and the greatest y, the others follow clockwise, seen from
    outside. Their black squares have the edge `side_m`; the white rim of each touches the edge of the surface along y,
    and ends where the surface ends along y.
    """

    side_m: float
    first: int = 0

    @property
    def plate_m(self) -> float:
        """The edge in m of a marker with its rim."""
        return self.side_m * (MODULES + 2) / MODULES


class InspectedSurface(msgspec.Struct, frozen=True):
    """A rectangle of size (2,) in m; its frame is at its centre, z points out.

    The light is known by the white of its markers. Without markers, white: what an image shows of white paper there,
    which was measured once for a camera of fixed exposure in a light that stays the same.
    """

    size: Array
    look: SurfaceLook = SurfaceLook()
    markers: Markers | None = None
    white: Rgb | None = None

    @property
    def corners(self) -> Array:
        """Its corners (4, 3) in m in its frame, clockwise from the one with the least x and the greatest y."""
        return np.array([(x * self.size[0] / 2, y * self.size[1] / 2, 0.0) for x, y in CORNERS])


def marker_centres(surface: InspectedSurface) -> Array:
    """Return the centres (4, 3) in m of the markers of a surface in its frame; (0, 3) without markers."""
    if surface.markers is None:
        return np.empty((0, 3))
    half = surface.markers.plate_m / 2
    x, y = surface.size[0] / 2 + half, surface.size[1] / 2 - half
    return np.array([(right * x, up * y, 0.0) for right, up in CORNERS])


def square(side_m: float) -> Array:
    """Return the corners (4, 3) in m of a square around 0 in the order of ArUco."""
    return np.array([(x * side_m / 2, y * side_m / 2, 0.0) for x, y in CORNERS])


def linear(encoded: Array | NDArray[np.uint8] | Rgb) -> Array:
    """Return the light, from 0 to 1, of values of sRGB from 0 to 255 (IEC 61966-2-1)."""
    if isinstance(encoded, np.ndarray) and encoded.dtype == np.uint8:
        return np.asarray(_LIGHT[encoded])
    share = np.asarray(encoded, dtype=float) / 255.0
    return np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4)


_LIGHT = linear(np.arange(256.0))
"""The light of each value of a pixel."""


def encode(light: Array) -> Array:
    """Return values of sRGB from 0 to 255 of light from 0 to 1; what is beyond is cut off."""
    kept = np.clip(light, 0.0, 1.0)
    return np.asarray(255.0 * np.where(kept <= 0.0031308, 12.92 * kept, 1.055 * kept ** (1 / 2.4) - 0.055))
