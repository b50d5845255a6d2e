"""Finds where a surface is in an image, from where it is believed to be: by its markers, or else by its edges."""

from __future__ import annotations

from typing import Literal

import msgspec
import numpy as np

from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.vision.edges import align_edges
from skillc_runtime.vision.inspected_surface import InspectedSurface, marker_centres, square
from skillc_runtime.vision.lens import Lens, project, rotation_vector
from skillc_runtime.vision.markers import Image, find_markers
from skillc_runtime.vision.opencv import load_opencv

LEAST_MARKERS = 2
"""One marker alone tells the rotation of a surface ten times its size too badly."""

GREATEST_ERROR_PX = 2.0
"""A pose that leaves markers or edges this far away, root mean square, is not that of the surface."""

OUTLIER_PX = 1.5
"""A marker this far from where the others have it has been moved."""

FARTHEST_M, FARTHEST_RAD = 0.1, 0.2
"""How far a surface may be from where it is believed to be."""


class NotLocated(RuntimeError):
    """An image does not show where the surface is; the message says why."""


class LocatedSurface(msgspec.Struct, frozen=True):
    """The pose of a surface in the frame of the camera, what showed it, and the error that is left, RMS in pixels."""

    pose: Pose
    by: Literal["markers", "edges"]
    error_px: float
    markers: tuple[int, ...] = ()


def locate_surface(image: Image, lens: Lens, surface: InspectedSurface, believed: Pose) -> LocatedSurface:
    """Return where a surface is in the frame of the camera that took an image (h, w, 3); NotLocated if it is not seen.

    believed: the pose of the surface in the frame of the camera, to a few cm.
    """
    found = {} if surface.markers is None else find_markers(image, surface.markers)
    if len(found) >= LEAST_MARKERS:
        located = _fit_markers(found, lens, surface, believed)
    else:
        aligned = align_edges(image, lens, surface, believed)
        if aligned is None:
            raise NotLocated(f"{len(found)} of its markers are seen, and its edges do not stand out enough")
        located = LocatedSurface(aligned[0], "edges", aligned[1])
    if located.error_px > GREATEST_ERROR_PX:
        raise NotLocated(f"its {located.by} do not fit its size: they are {located.error_px:.1f} pixels off")
    away = located.pose @ believed.inverse()
    moved = float(np.linalg.norm(located.pose.position - believed.position))
    turned = float(np.linalg.norm(rotation_vector(away)))
    if moved > FARTHEST_M or turned > FARTHEST_RAD:
        where = f"{1e3 * moved:.0f} mm and {np.degrees(turned):.0f} degrees from where it is believed to be"
        raise NotLocated(f"it would be {where}; is the pose of the camera or of the surface wrong?")
    return located


def find_surface(image: Image, lens: Lens, surface: InspectedSurface) -> Pose:
    """Return where a surface is in the frame of the camera by its markers alone; NotLocated if fewer than two are seen.

    Its plane follows from homography (Collins & Bartoli, IPPE, 2014), to begin `locate_surface` with.
    """
    found = {} if surface.markers is None else find_markers(image, surface.markers)
    if surface.markers is None or len(found) < LEAST_MARKERS:
        raise NotLocated(f"{len(found)} of its markers are seen, and {LEAST_MARKERS} have to be")
    cv2, centres, corners = load_opencv(), marker_centres(surface), square(surface.markers.side_m)
    points = np.concatenate([centres[number] + corners for number in found])
    _, turned, moved = cv2.solvePnP(
        points, np.concatenate(list(found.values())), lens.matrix, lens.coefficients, flags=cv2.SOLVEPNP_IPPE
    )
    return Pose(np.asarray(moved, dtype=float).ravel(), np.asarray(cv2.Rodrigues(turned)[0], dtype=float))


def _fit_markers(found: dict[int, Array], lens: Lens, surface: InspectedSurface, believed: Pose) -> LocatedSurface:
    """Return the pose that fits the markers, without the one that fits worst if it was moved."""
    pose, errors = _fit(found, lens, surface, believed)
    worst = max(errors, key=lambda number: errors[number])
    if len(found) > LEAST_MARKERS and errors[worst] > OUTLIER_PX:
        found = {number: at for number, at in found.items() if number != worst}
        pose, errors = _fit(found, lens, surface, believed)
    rms = float(np.sqrt(np.mean(np.square(list(errors.values())))))
    return LocatedSurface(pose, "markers", rms, tuple(sorted(found)))


def _fit(
    found: dict[int, Array], lens: Lens, surface: InspectedSurface, believed: Pose
) -> tuple[Pose, dict[int, float]]:
    """Return the pose of least squared error, Levenberg-Marquardt, and the RMS error in pixels of each marker."""
    assert surface.markers is not None
    cv2 = load_opencv()
    centres, corners = marker_centres(surface), square(surface.markers.side_m)
    points = np.concatenate([centres[number] + corners for number in found])
    pixels = np.concatenate(list(found.values()))
    _, turned, moved = cv2.solvePnP(
        points, pixels, lens.matrix, lens.coefficients,
        rotation_vector(believed).reshape(3, 1).copy(), believed.position.reshape(3, 1).copy(),
        useExtrinsicGuess=True, flags=cv2.SOLVEPNP_ITERATIVE,
    )  # fmt: skip
    pose = Pose(np.asarray(moved, dtype=float).ravel(), np.asarray(cv2.Rodrigues(turned)[0], dtype=float))
    away = np.square(project(lens, pose, points) - pixels).sum(axis=1).reshape(-1, 4)
    return pose, dict(zip(found, np.sqrt(away.mean(axis=1)).tolist(), strict=True))
