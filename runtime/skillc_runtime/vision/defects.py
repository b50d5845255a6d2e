"""Tells which spots of the face of a part look otherwise than those of a good one."""

from __future__ import annotations

import msgspec
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.motion.pose import Array
from skillc_runtime.vision.inspected_surface import linear
from skillc_runtime.vision.label_pose import NotDecided, SeenLabel
from skillc_runtime.vision.labels import LABEL_MODULES
from skillc_runtime.vision.lens import Lens, project
from skillc_runtime.vision.markers import Image
from skillc_runtime.vision.part_look import PAPER, PartLook
from skillc_runtime.vision.rectify import SATURATED, Spots, rectify, spot_centres

SPOT_M = 0.001
"""The edge of a spot."""

EDGE_M, PLATE_M = 0.002, 0.001
"""Spots nearer than this to the edge of the face, or to the label, are not judged."""

BRIGHTNESS_ERROR, COLOUR_ERROR = 0.35, 0.22
"""Logarithms of brightness and of colour by which a spot that looks otherwise is darker or differs from a good one."""

ERROR_SHARE = 0.25
"""By which share these may be wrong: it gives the error of an area."""

SHADE = 0.7
"""A face this much darker than its label lets expect, as a logarithm, has another colour."""

LEAST_LIGHT = 0.02
"""The white of a label that reflects less than this is too dark to tell colours."""

ROUNDS, SCALE = 6, 0.1
"""Rounds of weighing, and the error of the logarithm of brightness from which on a spot counts less."""


class FaceDefects(msgspec.Struct, frozen=True):
    """Which spots (rows, columns) look otherwise, their area in m2, the least and the most of it; the share seen."""

    mask: NDArray[np.bool_]
    area_m2: float
    least_m2: float
    most_m2: float
    seen_share: float


def find_defects(image: Image, lens: Lens, label: SeenLabel, hidden: NDArray[np.bool_] | None) -> FaceDefects:
    """Return what differs on a face from the colour of its kind, in the light that the white rim of its label shows.

    NotDecided if the label is too dark or too bright to tell the light.
    """
    look = label.look
    x, y = (spot_centres(length, max(2, round(length / SPOT_M))) for length in look.size)
    spots = rectify(image, lens, label.pose, x, y, hidden)
    white = _white_of(image, lens, label)
    face = _judged(x, y, look)
    seen = spots.usable & face
    brightness, colour = _differences(spots, seen, white * linear(look.colour))
    seen &= brightness < BRIGHTNESS_ERROR  # what is brighter mirrors a lamp
    spot_m2 = float((x[1] - x[0]) * (y[1] - y[0]))

    def area(share: float) -> float:
        return spot_m2 * float((seen & _differs(brightness, colour, share)).sum())

    mask = seen & _differs(brightness, colour, 1.0)
    seen_share = float(seen.sum() / max(1, face.sum()))
    return FaceDefects(mask, area(1.0), area(1.0 + ERROR_SHARE), area(1.0 - ERROR_SHARE), seen_share)


def _differs(brightness: Array, colour: Array, share: float) -> NDArray[np.bool_]:
    return np.asarray((brightness < -share * BRIGHTNESS_ERROR) | (colour > share * COLOUR_ERROR))


def _judged(x: Array, y: Array, look: PartLook) -> NDArray[np.bool_]:
    """Return which spots (rows, columns) are on the face and beside its label."""
    across, up = np.meshgrid(np.abs(x), np.abs(y))
    inside = (across < look.size[0] / 2 - EDGE_M) & (up < look.size[1] / 2 - EDGE_M)
    beside = np.maximum(across, up) > look.plate_m / 2 + PLATE_M
    return np.asarray(inside & beside)


def _white_of(image: Image, lens: Lens, label: SeenLabel) -> Array:
    """Return the light (3,) of what reflects all of it, by the white rim of a label; NotDecided if it tells nothing."""
    side = label.look.label_m
    middle, steps = side * (LABEL_MODULES + 1) / LABEL_MODULES / 2, np.linspace(-side / 2, side / 2, 12)
    ends = [(at, sign * middle, 0.0) for sign in (-1, 1) for at in steps]
    points = np.array([*ends, *((b, a, c) for a, b, c in ends)])
    at = np.rint(project(lens, label.pose, points)).astype(int).clip(0, (lens.width - 1, lens.height - 1))
    values = image[at[:, 1], at[:, 0]]
    if float((values >= SATURATED).any(axis=1).mean()) > 0.5:
        raise NotDecided(f"the white of the label {label.code} is too bright: it does not tell the light")
    light = np.median(linear(values), axis=0)
    if float(light.mean()) < LEAST_LIGHT:
        raise NotDecided(
            f"it is too dark: the white of the label {label.code} has only {np.median(values):.0f} of 255 in the image"
        )
    return np.asarray(light / linear(PAPER))


def _differences(spots: Spots, seen: NDArray[np.bool_], good: Array) -> tuple[Array, Array]:
    """Return how far the logarithms of brightness and of colour (rows, columns) of spots are from those of a good face.

    good (3,): the light that a good face reflects where its label is. Light changes evenly over a face: a plane is
    fitted to the logarithm of brightness with Cauchy weights, which is 0 in the middle but for `SHADE`.
    """
    ratio = np.log(np.maximum(spots.light, 1e-5) / np.maximum(good, 1e-5))
    level = ratio.mean(axis=2)
    colour = np.abs(ratio - level[..., None]).max(axis=2)
    terms = np.stack(
        [np.ones(level.shape), *np.meshgrid(spots.x / np.ptp(spots.x), spots.y / np.ptp(spots.y))], axis=-1
    )
    A, b = terms[seen], level[seen]
    weights, plane = np.ones(len(b)), np.zeros(3)
    rough = np.diag([1e-9, 1e-2, 1e-2]) * max(1, len(b))
    for _ in range(ROUNDS if len(b) else 0):
        plane = np.linalg.solve(A.T @ (weights[:, None] * A) + rough, A.T @ (weights * b))
        weights = 1.0 / (1.0 + ((b - A @ plane) / SCALE) ** 2)
    if plane[0] < -SHADE:
        return level, colour
    return level - terms @ plane, colour
