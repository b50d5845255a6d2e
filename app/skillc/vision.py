"""What images show: which cells of a flat surface are clean, dirty, or not seen; and which parts are good."""

from skillc_runtime.motion.dirt_map import CLEAN, DIRTY, UNSEEN
from skillc_runtime.vision.cell_map import CellMap
from skillc_runtime.vision.classify_part import ClassifiedPart, classify_part, classify_parts
from skillc_runtime.vision.inspect_image import inspect_image
from skillc_runtime.vision.inspected_surface import InspectedSurface, Markers, SurfaceLook
from skillc_runtime.vision.label_pose import NotDecided
from skillc_runtime.vision.lens import Lens, read_calibration
from skillc_runtime.vision.locate import LocatedSurface, NotLocated, find_surface
from skillc_runtime.vision.part_look import PartLook
from skillc_runtime.vision.picture import draw_cells, draw_parts, read_image, write_image

__all__ = [
    "CLEAN",
    "DIRTY",
    "UNSEEN",
    "CellMap",
    "ClassifiedPart",
    "InspectedSurface",
    "Lens",
    "LocatedSurface",
    "Markers",
    "NotDecided",
    "NotLocated",
    "PartLook",
    "SurfaceLook",
    "classify_part",
    "classify_parts",
    "draw_cells",
    "draw_parts",
    "find_surface",
    "inspect_image",
    "read_calibration",
    "read_image",
    "write_image",
]
