"""How a camera projects points: a pinhole with the distortion of a lens."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import msgspec
import numpy as np

from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.vision.opencv import load_opencv


class Lens(msgspec.Struct, frozen=True):
    """The intrinsic parameters of a camera, as calibrations of OpenCV and `sensor_msgs/CameraInfo` state them.

    Width and height of its images in pixels, focal lengths and principal point in pixels. distortion: k1, k2, p1, p2
    and so on of OpenCV (`plumb_bob`). The frame of the camera has z forward, x to the right, y down in the image.
    """

    width: int
    height: int
    fx: float
    fy: float
    cx: float
    cy: float
    distortion: tuple[float, ...] = ()

    @property
    def matrix(self) -> Array:
        """The camera matrix (3, 3)."""
        return np.array([[self.fx, 0.0, self.cx], [0.0, self.fy, self.cy], [0.0, 0.0, 1.0]])

    @property
    def coefficients(self) -> Array:
        """The distortion (n,), n >= 4."""
        return np.array(self.distortion or (0.0,) * 4)


def read_calibration(file: str | Path) -> Lens:
    """Return the lens of a calibration file of ROS, YAML or JSON; FileNotFoundError, or ValueError if it is none.

    It has `image_width`, `image_height`, `camera_matrix` and `distortion_coefficients`, as `camera_calibration` writes.
    """
    cv2, text = load_opencv(), Path(file).read_text("utf-8")
    try:
        read = cv2.FileStorage(text, cv2.FILE_STORAGE_READ | cv2.FILE_STORAGE_MEMORY)
        width, height = (int(read.getNode(name).real()) for name in ("image_width", "image_height"))
        matrix, distortion = (_numbers(read.getNode(name)) for name in ("camera_matrix", "distortion_coefficients"))
    except (SystemError, cv2.error) as error:
        raise ValueError(f"{file} is no calibration in YAML or JSON") from error
    if len(matrix) != 9 or width < 1 or height < 1:
        raise ValueError(f"{file} has no image_width, image_height and camera_matrix, as calibrations of ROS have")
    return Lens(width, height, matrix[0], matrix[4], matrix[2], matrix[5], distortion)


def _numbers(node: Any) -> tuple[float, ...]:
    data = node.getNode("data")
    return tuple(data.at(number).real() for number in range(data.size()))


def rotation_vector(pose: Pose) -> Any:
    """Return the rotation of a pose as the vector (3,) in rad of OpenCV."""
    return load_opencv().Rodrigues(np.ascontiguousarray(pose.rotation))[0].ravel()


def project(lens: Lens, frame: Pose, points: Array) -> Array:
    """Return the pixels (n, 2), column and row, of points (n, 3) in m of a frame, which is given in that of the camera.

    The centre of the first pixel is (0, 0). Points behind the camera are at nan.
    """
    cv2 = load_opencv()
    pixels, _ = cv2.projectPoints(
        np.ascontiguousarray(points, dtype=float),
        rotation_vector(frame),
        frame.position,
        lens.matrix,
        lens.coefficients,
    )
    found = np.asarray(pixels, dtype=float).reshape(-1, 2)
    found[(points @ frame.rotation[2] + frame.position[2]) <= 0] = np.nan
    return found
