"""Finds the label of a part in an image, and from it where the face of the part is."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.vision.inspected_surface import square
from skillc_runtime.vision.labels import find_labels
from skillc_runtime.vision.lens import Lens, project
from skillc_runtime.vision.markers import Image
from skillc_runtime.vision.opencv import load_opencv
from skillc_runtime.vision.part_look import PartLook

FARTHEST_M = 0.05
"""How far a part may be from where it is believed to be."""

GREATEST_ERROR_PX = 2.0
"""A label whose corners are this far from those of a square of its size, root mean square, is bent or misread."""

DARK_LIGHT = 0.02
"""Images in which 99 of 100 pixels reflect less than this are too dark to see a label."""


class NotDecided(RuntimeError):
    """An image does not show what a part is; the message says why."""


class SeenLabel(msgspec.Struct, frozen=True):
    """A label that was read, the look of its kind, and the pose of the face in the frame of the camera."""

    code: int
    look: PartLook
    pose: Pose

    @classmethod
    def of(
        cls, code: int, corners: Array, lens: Lens, looks: Sequence[PartLook], near: Pose | None = None
    ) -> SeenLabel:
        """Return a label with corners (4, 2) in pixels; NotDecided if no kind has its code, or it fits no pose.

        near: which of the two poses that look nearly the same is taken; without it, the one that fits better.
        """
        look = next((each for each in looks if each.codes[0] <= code <= each.codes[1]), None)
        if look is None:
            raise NotDecided(f"no kind of parts has the code {code} of the label that is seen")
        pose, error = _fit(corners, lens, look.label_m, near)
        if error > GREATEST_ERROR_PX:
            raise NotDecided(f"the label {code} is no square of its size: its corners are {error:.1f} pixels off")
        return cls(code, look, pose)


def locate_label(
    image: Image, lens: Lens, looks: Sequence[PartLook], believed: Pose, hidden: NDArray[np.bool_] | None = None
) -> SeenLabel:
    """Return the label nearest to where a face is believed to be in the frame of the camera; NotDecided if none is."""
    unknown: NotDecided | None = None
    near: list[tuple[float, SeenLabel]] = []
    for code, corners in find_labels(image):
        try:
            label = SeenLabel.of(code, corners, lens, looks, believed)
        except NotDecided as reason:
            unknown = reason
            continue
        away = float(np.linalg.norm(label.pose.position - believed.position))
        if away <= FARTHEST_M:
            near.append((away, label))
    if near:
        return min(near, key=lambda each: each[0])[1]
    raise unknown or NotDecided(_why_none(image, lens, believed, hidden))


def _why_none(image: Image, lens: Lens, believed: Pose, hidden: NDArray[np.bool_] | None) -> str:
    """Return why no label is seen where a face is believed to be."""
    column, row = project(lens, believed, np.zeros((1, 3)))[0]
    if not (0 <= column < lens.width and 0 <= row < lens.height):
        return "the part is believed to be out of the view of the camera"
    if hidden is not None and hidden[int(row), int(column)]:
        return "something that is known to be there hides the label from the camera"
    brightest = float(np.percentile(image, 99.0))
    if (brightest / 255.0) ** 2.2 < DARK_LIGHT:
        return f"the image is too dark: all but 1 % of its values are at most {brightest:.0f} of 255"
    return f"no label is seen within {100 * FARTHEST_M:.0f} cm of where the part is believed to be"


def _fit(corners: Array, lens: Lens, side_m: float, near: Pose | None) -> tuple[Pose, float]:
    """Return the pose of a square with corners (4, 2), and the RMS error in pixels (Collins & Bartoli, IPPE, 2014).

    A small square looks nearly the same from two sides: of poses that fit about as well, that which is turned like
    `near` is taken.
    """
    cv2, points = load_opencv(), square(side_m)
    _, turned, moved, _ = cv2.solvePnPGeneric(
        points, corners, lens.matrix, lens.coefficients, flags=cv2.SOLVEPNP_IPPE_SQUARE
    )
    poses = [
        Pose(np.asarray(to, dtype=float).ravel(), np.asarray(cv2.Rodrigues(by)[0], dtype=float))
        for by, to in zip(turned, moved, strict=True)
    ]
    errors = [float(np.sqrt(np.mean(np.sum((project(lens, each, points) - corners) ** 2, axis=1)))) for each in poses]
    fitting = [(pose, error) for pose, error in zip(poses, errors, strict=True) if error < 2 * min(errors) + 0.3]
    if near is None:
        return min(fitting, key=lambda each: each[1])
    normal = near.rotation[:, 2]
    return max(fitting, key=lambda each: float(each[0].rotation[:, 2] @ normal))
