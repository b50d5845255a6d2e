"""Brings what an image shows of a surface into the frame of the surface: its light, in a grid of spots."""

from __future__ import annotations

import msgspec
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.vision.inspected_surface import linear
from skillc_runtime.vision.lens import Lens, project
from skillc_runtime.vision.markers import Image
from skillc_runtime.vision.opencv import load_opencv

SATURATED, BLACK = 252, 3
"""Values of a pixel from which on its light is not known, and below which it is too dark."""

MARGIN_PX = 6
"""How much wider what hides a surface is taken: for errors of its pose, blur, and the light that its edges mirror."""

SAMPLES = 3
"""Samples of a spot along each edge."""


class Spots(msgspec.Struct, frozen=True):
    """A grid of spots: centres x (n,) and y (m,) in m, their mean light (m, n, 3) from 0 to 1, and which are usable."""

    x: Array
    y: Array
    light: Array
    usable: NDArray[np.bool_]


def spot_centres(length_m: float, count: int) -> Array:
    """Return the centres (count,) in m of equal parts of a length around 0."""
    return np.asarray((np.arange(count) + 0.5) * (length_m / count) - length_m / 2)


def rectify(
    image: Image, lens: Lens, surface: Pose, x: Array, y: Array, hidden: NDArray[np.bool_] | None = None
) -> Spots:
    """Return the light of the spots around x (n,) and y (m,), evenly spaced in m, of a surface at its pose.

    surface: its pose in the frame of the camera. A spot is not usable where it is outside of the image (h, w, 3),
    `hidden` (h, w), seen from behind, too bright or too dark.
    """
    cv2 = load_opencv()
    fine_x, fine_y = (
        spot_centres(len(each) * (each[1] - each[0]), SAMPLES * len(each)) + each.mean() for each in (x, y)
    )
    at = _pixels(lens, surface, fine_x, fine_y)
    to = [np.ascontiguousarray(np.nan_to_num(at[..., axis], nan=-9.0), dtype=np.float32) for axis in (0, 1)]
    light = cv2.remap(linear(image).astype(np.float32), *to, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    bad = ((image >= SATURATED).any(axis=2) | (image <= BLACK).all(axis=2)).astype(np.uint8)
    if hidden is not None:
        bad |= cv2.dilate(hidden.astype(np.uint8), np.ones((2 * MARGIN_PX + 1,) * 2, dtype=np.uint8))
    good = cv2.remap(bad, *to, cv2.INTER_NEAREST, borderMode=cv2.BORDER_CONSTANT, borderValue=1) == 0
    good &= np.isfinite(at).all(axis=2)
    if surface.rotation[:, 2] @ surface.position >= 0:
        good[:] = False
    return Spots(x, y, _bin(light), _bin(good.astype(float)[..., None])[..., 0] > 0.99)


def _pixels(lens: Lens, surface: Pose, x: Array, y: Array) -> Array:
    """Return the pixels (m, n, 2) of the points of a grid; nan outside of an image."""
    grid = np.stack([*np.meshgrid(x, y), np.zeros((len(y), len(x)))], axis=-1)
    at = project(lens, surface, grid.reshape(-1, 3)).reshape(len(y), len(x), 2)
    with np.errstate(invalid="ignore"):
        outside = ~((at >= 0) & (at <= (lens.width - 1, lens.height - 1))).all(axis=2)
    at[outside] = np.nan
    return at


def _bin(values: Array) -> Array:
    """Return the means of SAMPLES x SAMPLES neighbours of values (m, n, k)."""
    rows, columns, depth = values.shape
    parts = values.reshape(rows // SAMPLES, SAMPLES, columns // SAMPLES, SAMPLES, depth)
    return np.asarray(parts.mean(axis=(1, 3)), dtype=float)
