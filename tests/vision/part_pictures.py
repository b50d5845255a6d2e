"""Pictures of a part that nothing rendered: its face as it is printed, seen by a camera in even light, with noise."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from skillc_runtime.backends.simulation.cameras.part_faces import TrueFace, draw_face
from skillc_runtime.motion.pose import Array, Pose, exp
from skillc_runtime.vision.inspected_surface import encode, square
from skillc_runtime.vision.lens import Lens, project
from skillc_runtime.vision.opencv import load_opencv
from skillc_runtime.vision.part_look import PartLook

LENS = Lens(640, 480, 800.0, 800.0, 319.5, 239.5)
COVER = PartLook("cover", (100, 199), (0.05, 0.06), 0.02, (150.0, 165.0, 185.0))
FLANGE = PartLook("flange", (200, 299), (0.05, 0.06), 0.02, (205.0, 170.0, 90.0))
TABLE = 0.15
"""What share of the light the table reflects around a part."""


def face_with(defect: str, look: PartLook = COVER, code: int = 117) -> TrueFace:
    """Return a face with a defect, or "" for none, by the first seed that gives it."""
    rate = 1.0 if defect else 0.0
    faces = (draw_face("part", look, code, rate, seed) for seed in range(50))
    return next(face for face in faces if face.defect == defect)


def look_down(turn: float = 0.4, tilt: float = 0.1, x: float = 0.0) -> Pose:
    """Return the pose of a face in the frame of a camera 40 cm above it, turned and tilted by rad, x beside it."""
    return Pose(np.array([x, 0.0, 0.4]), exp(np.array([tilt, 0.0, turn])) @ np.diag([1.0, -1.0, -1.0]))


def photograph(
    reflectance: Array, size: tuple[float, float], pose: Pose, light: float = 0.8, seed: int = 0,
    colour: tuple[float, float, float] = (1.0, 0.95, 0.9),
) -> NDArray[np.uint8]:  # fmt: skip
    """Return a picture of a face of a size in m at a pose, of its reflectance (m, n, 3), lowest row first."""
    cv2, (rows, columns) = load_opencv(), reflectance.shape[:2]
    corners = project(LENS, pose, square(1.0) * (*size, 0.0)).astype(np.float32)
    around = np.array([(0, rows), (columns, rows), (columns, 0), (0, 0)], dtype=np.float32) - 0.5
    turned = cv2.getPerspectiveTransform(around, corners)
    table = np.full((LENS.height, LENS.width, 3), TABLE, dtype=np.float32)
    seen = cv2.warpPerspective(
        reflectance.astype(np.float32), turned, (LENS.width, LENS.height), table, cv2.INTER_AREA, cv2.BORDER_TRANSPARENT
    )
    radiance = light * seen * np.array(colour)
    noise = np.random.default_rng(seed).normal(size=radiance.shape)
    return np.rint(encode(radiance + noise * np.sqrt(radiance / 1e4 + 1e-6))).astype(np.uint8)
