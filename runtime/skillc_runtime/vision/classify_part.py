"""Classifies a part in one image: reads its label, and tells a good face from one with a defect."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import msgspec
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.motion.pose import Pose
from skillc_runtime.vision.cell_map import standard_normal
from skillc_runtime.vision.defects import FaceDefects, find_defects
from skillc_runtime.vision.label_pose import NotDecided, SeenLabel, locate_label
from skillc_runtime.vision.labels import find_labels
from skillc_runtime.vision.lens import Lens
from skillc_runtime.vision.markers import Image
from skillc_runtime.vision.part_look import PartLook

LEAST_SEEN: Final = 0.9
"""Which share of the face beside its label must be seen for a part to be good."""

LEAST_CONFIDENCE: Final = 0.9
"""A picture that is less sure than this does not decide."""

LEAST_ERROR_M2: Final = 1e-6
"""The least error of the area of a defect: a spot."""


class ClassifiedPart(msgspec.Struct, frozen=True):
    """What an image shows of a part.

    code: of its label, and the kind that has it. confidence: the probability that `good` is right, from the errors of
    colours and areas. defect_m2: the area that looks otherwise than a good face. seen_share: of the face beside its
    label. pose: of the middle of the face, which has a size (2,) in m, in the frame of the camera, z out of it. mask
    (rows, columns): the spots of 1 mm that look otherwise.
    """

    code: int
    kind: str
    good: bool
    confidence: float
    defect_m2: float
    seen_share: float
    pose: Pose
    size: tuple[float, float]
    mask: NDArray[np.bool_]


def classify_part(
    image: Image, lens: Lens, looks: Sequence[PartLook], believed: Pose, hidden: NDArray[np.bool_] | None = None
) -> ClassifiedPart:
    """Return what an image (h, w, 3) of sRGB shows of the part whose face is believed to be at a pose.

    looks: the kinds that it may be of. believed: the pose of the middle of its face, z out of it, in the frame of the
    camera (z forward, x right, y down), to a few cm. hidden (h, w): pixels that are known to show something else.

    Raises ValueError if the image has another size than the lens states, ModuleNotFoundError without OpenCV, NotDecided
    with the reason if the image shows no label, or too little to decide.
    """
    _check_size(image, lens)
    return _judge(image, lens, locate_label(image, lens, looks, believed, hidden), hidden)


def classify_parts(image: Image, lens: Lens, looks: Sequence[PartLook]) -> list[ClassifiedPart | NotDecided]:
    """Return what an image shows of each part with a label in it, wherever it lies, from left to right.

    In place of what is not decided stands the reason. Errors else as of `classify_part`.
    """
    _check_size(image, lens)
    found: list[ClassifiedPart | NotDecided] = []
    for code, corners in sorted(find_labels(image), key=lambda each: float(each[1][:, 0].mean())):
        try:
            found.append(_judge(image, lens, SeenLabel.of(code, corners, lens, looks), None))
        except NotDecided as reason:
            found.append(reason)
    return found


def _check_size(image: Image, lens: Lens) -> None:
    if image.shape != (lens.height, lens.width, 3) or image.dtype != np.uint8:
        raise ValueError(
            f"an image of {lens.width} x {lens.height} pixels in 8 bit colour is expected, not {image.shape}"
        )


def _judge(image: Image, lens: Lens, label: SeenLabel, hidden: NDArray[np.bool_] | None) -> ClassifiedPart:
    look, found = label.look, find_defects(image, lens, label, hidden)
    good, confidence = _decide(found, look.tolerated_m2)
    if good and found.seen_share < LEAST_SEEN:
        raise NotDecided(
            f"{100 * found.seen_share:.0f} % of the face of label {label.code} is seen, without a defect; the rest is "
            "hidden or glaring"
        )
    if confidence < LEAST_CONFIDENCE:
        raise NotDecided(
            f"{1e6 * found.area_m2:.1f} mm2 on the face of label {label.code} look otherwise, which is too near to the "
            f"{1e6 * look.tolerated_m2:.1f} mm2 that are tolerated"
        )
    return ClassifiedPart(
        label.code, look.kind, good, confidence, found.area_m2, found.seen_share, label.pose, look.size, found.mask
    )


def _decide(found: FaceDefects, tolerated_m2: float) -> tuple[bool, float]:
    """Return whether a face is good, and the probability that this is right."""
    error = max(
        LEAST_ERROR_M2, (found.most_m2 - found.least_m2) / 2, float(np.sqrt(found.area_m2 * LEAST_ERROR_M2)) / 2
    )
    away = np.array([abs(found.area_m2 - tolerated_m2) / error])
    return found.area_m2 <= tolerated_m2, float(standard_normal(away)[0])
