"""Inspects what a picture file shows: a surface with markers, or parts with labels."""

from __future__ import annotations

from pathlib import Path

import msgspec

from skillc.errors import RequestError, ServiceError
from skillc.services.reporting.files import writing_to
from skillc.services.views.open_scenes import OpenScene
from skillc_runtime.motion.dirt_map import format_dirt_map
from skillc_runtime.vision.classify_part import classify_parts
from skillc_runtime.vision.inspect_image import inspect_image
from skillc_runtime.vision.label_pose import NotDecided
from skillc_runtime.vision.lens import Lens, read_calibration
from skillc_runtime.vision.locate import NotLocated, find_surface
from skillc_runtime.vision.markers import Image
from skillc_runtime.vision.picture import draw_cells, draw_parts, read_image, write_image
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.image_facts import MARKER_SIZE, read_inspected, read_lens
from skillc_runtime.world.space.part_looks import read_looks
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of
from skillc_runtime.world.state.names import NoSuchName, resolve_individual
from skillc_runtime.world.state.terms import IMAGE_SHEET, INSPECTION_CAMERA, MANIPULATABLE


class SeenSurface(msgspec.Struct, frozen=True):
    """What a picture shows of a surface: shares of its cells, what showed where it is, and the error left in pixels.

    `dirt_map` is the map of its cells, as scenes state it.
    """

    surface: str
    clean: float
    dirty: float
    seen: float
    located_by: str
    error_px: float
    dirt_map: str


class SeenPart(msgspec.Struct, frozen=True):
    """What a picture shows of a part; `undecided` says why it does not tell what it is."""

    code: int | None = None
    kind: str = ""
    grade: str = ""
    confidence: float = 0.0
    defect_mm2: float = 0.0
    undecided: str = ""


def look_at(
    file: Path, scene: OpenScene, thing: str, calibration: Path | None, output: Path | None
) -> SeenSurface | tuple[SeenPart, ...]:
    """Return what a picture file shows of a surface, or of parts of the size of a thing, and draw it over a copy.

    The lens is that of a calibration, else of the first camera of the scene that takes images. RequestError if a file,
    the thing or a lens is missing; ServiceError if the picture does not show the surface, or cannot be written.
    """
    try:
        individual = resolve_individual(thing, scene.state)
        image, lens = read_image(file), read_calibration(calibration) if calibration else _lens_of(scene)
        if scene.state.value(individual, MARKER_SIZE) is not None:
            return _look_at_surface(image, lens, scene, individual, output)
        if not scene.state.is_a(individual, MANIPULATABLE):
            short = scene.vocabulary.short(individual)
            raise RequestError(f"{short} is no part, and no surface with markers: state its skillc:markerSize")
        return _look_at_parts(image, lens, scene, individual, output)
    except OSError as error:
        raise RequestError(f"cannot read {error.filename}: {error.strerror}") from error
    except (NoSuchName, SheetError, FrameError, ValueError, ModuleNotFoundError) as error:
        raise RequestError(str(error)) from error


def _lens_of(scene: OpenScene) -> Lens:
    sheets = (sheet_of(scene.state, each) for each in sorted(scene.state.instances(INSPECTION_CAMERA)))
    lens = next((read_lens(each) for each in sheets if each.individual in scene.state.instances(IMAGE_SHEET)), None)
    if lens is None:
        raise RequestError("the scene has no camera that takes images: write --calibration FILE")
    return lens


def _look_at_surface(image: Image, lens: Lens, scene: OpenScene, surface: str, output: Path | None) -> SeenSurface:
    inspected, name = read_inspected(scene.state, surface), scene.vocabulary.short(surface)
    try:
        seen = inspect_image(image, lens, inspected, find_surface(image, lens, inspected))
    except NotLocated as error:
        raise ServiceError(f"the picture does not show where {name} is: {error}") from error
    _write(output, draw_cells(image, lens, seen))
    shares = seen.clean_share, seen.dirty_share, seen.seen_share
    return SeenSurface(name, *shares, seen.located.by, seen.located.error_px, format_dirt_map(seen.dirt_map))


def _look_at_parts(image: Image, lens: Lens, scene: OpenScene, part: str, output: Path | None) -> tuple[SeenPart, ...]:
    looks = read_looks(scene.state, part)
    if not looks:
        raise RequestError("the scene has no skillc:PartKind, which says how parts look")
    found, short = classify_parts(image, lens, looks), scene.vocabulary.short
    _write(output, draw_parts(image, lens, [each for each in found if not isinstance(each, NotDecided)]))
    return tuple(
        SeenPart(undecided=str(each))
        if isinstance(each, NotDecided)
        else SeenPart(
            each.code, short(each.kind), "good" if each.good else "scrap", each.confidence, 1e6 * each.defect_m2
        )
        for each in found
    )


def _write(output: Path | None, drawn: Image) -> None:
    if output is not None:
        with writing_to(output):
            write_image(drawn, output)
