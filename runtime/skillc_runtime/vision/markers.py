"""Finds the markers of a surface in an image, and draws them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from skillc_runtime.motion.pose import Array
from skillc_runtime.vision.inspected_surface import MODULES, Markers, linear
from skillc_runtime.vision.opencv import load_opencv

Image = NDArray[np.uint8]

WINDOW = 3
"""Half of the window in pixels in which a corner is refined."""

ENOUGH = (3, 30, 0.01)
"""Iterations and pixels at which the refinement ends, in the form of OpenCV."""


def find_markers(image: Image, markers: Markers) -> dict[int, Array]:
    """Return the corners (4, 2) in pixels, column and row, of those of the four markers that an image (h, w, 3) shows.

    Keys are 0 to 3, in the order of the markers. A marker that is seen twice counts as not seen.
    """
    found = [(number - markers.first, at) for number, at in detect_markers(image, _dictionary())]
    numbers = [number for number, _ in found]
    return {number: at for number, at in found if 0 <= number < 4 and numbers.count(number) == 1}


def detect_markers(image: Image, dictionary: Any) -> list[tuple[int, Array]]:
    """Return number and corners (4, 2) in pixels, column and row, of each marker of a dictionary of OpenCV."""
    cv2 = load_opencv()
    detector = cv2.aruco.ArucoDetector(dictionary, cv2.aruco.DetectorParameters())
    corners, found, _ = detector.detectMarkers(cv2.cvtColor(image, cv2.COLOR_RGB2GRAY))
    # Corners are refined in light: encoded values would move each edge into the black.
    grey = linear(image).mean(axis=2).astype(np.float32)
    corners = [cv2.cornerSubPix(grey, each.reshape(4, 1, 2), (WINDOW, WINDOW), (-1, -1), ENOUGH) for each in corners]
    numbers = [] if found is None else np.asarray(found).ravel().tolist()
    return [(number, np.asarray(at, dtype=float).reshape(4, 2)) for number, at in zip(numbers, corners, strict=True)]


def draw_marker(number: int, pixels_per_module: int) -> Image:
    """Return a marker (n, n) with its white rim, 0 or 255."""
    drawn = load_opencv().aruco.generateImageMarker(_dictionary(), number, MODULES * pixels_per_module)
    return np.pad(np.asarray(drawn, dtype=np.uint8), pixels_per_module, constant_values=255)


def _dictionary() -> Any:
    aruco = load_opencv().aruco
    return aruco.getPredefinedDictionary(aruco.DICT_4X4_50)
