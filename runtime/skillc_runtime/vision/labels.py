"""Finds the labels of parts in an image, and draws them: AprilTags, which code a number."""

from __future__ import annotations

from typing import Any

import numpy as np

from skillc_runtime.motion.pose import Array
from skillc_runtime.vision.markers import Image, detect_markers
from skillc_runtime.vision.opencv import load_opencv

LABEL_MODULES = 8
"""Modules along the edge of a label of `DICT_APRILTAG_36h11`, with its black border; its white rim is one wide."""


def plate_m(side_m: float) -> float:
    """Return the edge in m of a label with its rim, of the edge of its black square."""
    return side_m * (LABEL_MODULES + 2) / LABEL_MODULES


def find_labels(image: Image) -> list[tuple[int, Array]]:
    """Return code and corners (4, 2) in pixels, column and row, of each label that an image (h, w, 3) shows."""
    return detect_markers(image, _family())


def draw_label(code: int, pixels_per_module: int) -> Image:
    """Return a label (n, n) with its white rim, 0 or 255."""
    drawn = load_opencv().aruco.generateImageMarker(_family(), code, LABEL_MODULES * pixels_per_module)
    return np.pad(np.asarray(drawn, dtype=np.uint8), pixels_per_module, constant_values=255)


def _family() -> Any:
    aruco = load_opencv().aruco
    return aruco.getPredefinedDictionary(aruco.DICT_APRILTAG_36h11)
