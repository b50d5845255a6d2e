"""Inspects a surface in one image: finds it, rectifies it, tells dirt from clean, and judges its cells."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from skillc_runtime.motion.pose import Pose
from skillc_runtime.vision.cell_map import SPOTS, CellMap, count_cells, judge_cells
from skillc_runtime.vision.dirt import find_dirt
from skillc_runtime.vision.inspected_surface import InspectedSurface, linear
from skillc_runtime.vision.lens import Lens
from skillc_runtime.vision.light import Whites, sample_whites
from skillc_runtime.vision.locate import LocatedSurface, NotLocated, locate_surface
from skillc_runtime.vision.markers import Image
from skillc_runtime.vision.rectify import rectify, spot_centres

LEAST_WHITES = 6
"""Points of white paper that must be seen to tell the light."""


def inspect_image(
    image: Image, lens: Lens, surface: InspectedSurface, believed: Pose, hidden: NDArray[np.bool_] | None = None
) -> CellMap:
    """Return which cells of 1 cm of a surface are dirty, clean, or not seen in an image (h, w, 3) of sRGB.

    believed: the pose of the surface in the frame of the camera (z forward, x right, y down), to a few cm. hidden
    (h, w): pixels that are known to show something else, for example the arm where it is believed to be.

    Raises ValueError if the image has another size than the lens states, ModuleNotFoundError without OpenCV, NotLocated
    if the image does not show where the surface is, or nothing white in it tells the light.
    """
    if image.shape != (lens.height, lens.width, 3) or image.dtype != np.uint8:
        raise ValueError(
            f"an image of {lens.width} x {lens.height} pixels in 8 bit colour is expected, not {image.shape}"
        )
    located = locate_surface(image, lens, surface, believed)
    whites = _find_whites(image, lens, surface, located, hidden)
    columns, rows = count_cells(surface.size)
    x, y = (
        spot_centres(float(length), SPOTS * count) for length, count in zip(surface.size, (columns, rows), strict=True)
    )
    spots = rectify(image, lens, located.pose, x, y, hidden)
    dirt = find_dirt(spots, surface.look, whites)
    centres = spot_centres(float(surface.size[0]), columns), spot_centres(float(surface.size[1]), rows)
    return judge_cells(dirt, spots.usable, centres, located)


def _find_whites(
    image: Image, lens: Lens, surface: InspectedSurface, located: LocatedSurface, hidden: NDArray[np.bool_] | None
) -> Whites:
    """Return the light on the markers that are seen, or the one that is stated; NotLocated if there is neither."""
    if located.markers:
        whites = sample_whites(image, lens, surface, located, hidden)
        if len(whites.places) >= LEAST_WHITES:
            return whites
    if surface.white is None:
        raise NotLocated("the white of its markers, which tells the light, is not seen, and no white is stated")
    corners = surface.corners[:, :2]
    light = linear(surface.white) / linear(surface.look.paper)
    return Whites(corners, np.tile(light, (len(corners), 1)), np.arange(len(corners)))
