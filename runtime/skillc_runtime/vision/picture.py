"""Reads images from files, and draws maps of cells over them."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np

from skillc_runtime.motion.dirt_map import CLEAN, DIRTY, UNSEEN
from skillc_runtime.vision.cell_map import CellMap
from skillc_runtime.vision.classify_part import ClassifiedPart
from skillc_runtime.vision.inspected_surface import square
from skillc_runtime.vision.lens import Lens, project
from skillc_runtime.vision.markers import Image
from skillc_runtime.vision.opencv import load_opencv

COLOURS = {UNSEEN: (130, 130, 130), CLEAN: (60, 170, 90), DIRTY: (210, 60, 40)}
"""Red, green and blue of the outlines of cells."""

INSET = 0.12
"""Share of a cell that is left free at each edge."""


def read_image(file: str | Path) -> Image:
    """Return the picture (h, w, 3), red, green and blue, of a file; FileNotFoundError, or ValueError if it has none."""
    cv2 = load_opencv()
    data = np.fromfile(file, dtype=np.uint8)
    decoded = cv2.imdecode(data, cv2.IMREAD_COLOR) if data.size else None
    if decoded is None:
        raise ValueError(f"{file} is not an image that OpenCV reads, such as PNG or JPEG")
    return np.asarray(cv2.cvtColor(decoded, cv2.COLOR_BGR2RGB))


def write_image(image: Image, file: str | Path) -> None:
    """Write a picture (h, w, 3), red, green and blue, in the format of the file's ending; ValueError if unknown."""
    cv2 = load_opencv()
    if not cv2.haveImageWriter(str(file)):
        raise ValueError(f"{file} has no ending of a format that OpenCV writes, such as .png")
    Path(file).write_bytes(cv2.imencode(Path(file).suffix, cv2.cvtColor(image, cv2.COLOR_RGB2BGR))[1].tobytes())


def draw_cells(image: Image, lens: Lens, seen: CellMap) -> Image:
    """Return an image (h, w, 3) with the outline of each cell: green if clean, red if dirty, grey if not seen."""
    cv2, drawn = load_opencv(), np.array(image)
    half = (0.5 - INSET) * np.array([np.ptp(seen.x) / (len(seen.x) - 1), np.ptp(seen.y) / (len(seen.y) - 1)])
    around = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]) * (*half, 0.0)
    for row, y in enumerate(seen.y):
        for column, x in enumerate(seen.x):
            corners = project(lens, seen.located.pose, around + np.array([x, y, 0.0]))
            if np.isfinite(corners).all():
                at = np.rint(16 * corners).astype(np.int32).reshape(-1, 1, 2)
                cv2.polylines(drawn, [at], True, COLOURS[int(seen.state[row, column])], 1, cv2.LINE_AA, 4)
    return drawn


def draw_parts(image: Image, lens: Lens, parts: Iterable[ClassifiedPart]) -> Image:
    """Return an image (h, w, 3) with the outline of each face, green if good, else red as the spots of its defect."""
    cv2, drawn = load_opencv(), np.array(image)
    for each in parts:
        colour = COLOURS[CLEAN if each.good else DIRTY]
        corners = np.rint(16 * project(lens, each.pose, square(1.0) * (*each.size, 0.0))).astype(np.int32)
        cv2.polylines(drawn, [corners.reshape(-1, 1, 2)], True, colour, 2, cv2.LINE_AA, 4)
        rows, columns = np.nonzero(each.mask)
        x, y = ((at + 0.5) / count - 0.5 for at, count in ((columns, each.mask.shape[1]), (rows, each.mask.shape[0])))
        spots = np.stack([x * each.size[0], y * each.size[1], np.zeros(len(x))], axis=1)
        for column, row in np.rint(project(lens, each.pose, spots)).astype(int) if len(spots) and not each.good else ():
            cv2.circle(drawn, (int(column), int(row)), 1, colour, -1)
    return drawn
