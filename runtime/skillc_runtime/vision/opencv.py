"""OpenCV, which the extra `vision` installs."""

from __future__ import annotations

from importlib.util import find_spec
from typing import Any

INSTALL = "pip install 'skillc[vision]'"


def has_opencv() -> bool:
    """Whether OpenCV is installed."""
    return find_spec("cv2") is not None


def load_opencv() -> Any:
    """Return the module `cv2`; ModuleNotFoundError that says how to install it."""
    try:
        import cv2
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(f"images need OpenCV (cv2): {INSTALL}", name="cv2") from error
    return cv2
