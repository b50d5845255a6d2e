"""Lists the things of a scene with their poses in the world, and draws them: from above, and rendered."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from math import degrees
from pathlib import Path

import numpy as np

from skillc.contract.world import PlacedThing
from skillc.services.project.backends import make_backend
from skillc.services.reporting.files import writing_to
from skillc.services.views.open_scenes import OpenScene
from skillc.services.views.top_view import Outline, draw_top_view
from skillc_runtime.film.camera import CameraView
from skillc_runtime.film.framing import posed
from skillc_runtime.film.picture_files import write_picture
from skillc_runtime.film.props import make_props
from skillc_runtime.film.rendering import Renderer, RenderingError
from skillc_runtime.film.workshop import workshop_model
from skillc_runtime.motion.pose import angles_from_rotation
from skillc_runtime.world.space.bodies import read_body
from skillc_runtime.world.space.bounding_boxes import bounding_box
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import pose, size, states_own_pose
from skillc_runtime.world.space.shape.outlines import convex_hull, outline_points
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import (
    BASE_FRAME_ID,
    ON,
    SIZE,
    SURFACE,
    TRANSFORMATION_POSE,
    WORKSPACE,
)
from skillc_runtime.world.state.world_state import WorldState

WIDTH, HEIGHT = 1200, 900
AZIMUTH_DEG, ELEVATION_DEG = 130.0, -30.0
"""The camera looks at the scene from its front left."""

DRAWN_BY = "kinematic"
"""The backend whose cell is exactly as the facts say."""

AWAY = 1.4
"""The distance of the camera from the middle of the scene, as a multiple of the scene's diagonal."""


@dataclass(frozen=True, slots=True)
class DrawnScene:
    """The files that were written, and why there is no rendered picture among them, None if there is."""

    files: tuple[Path, ...]
    not_rendered: str | None


def list_placed(scene: OpenScene) -> tuple[PlacedThing, ...]:
    """Return the things of a scene that have a pose of their own or a size, sorted by name."""
    state = scene.state
    found = (each for each in sorted(scene.individuals) if states_own_pose(state, each) or _size(state, each))
    return tuple(_placed(state, each) for each in found)


def draw_pictures(scene: OpenScene, folder: Path) -> DrawnScene:
    """Draw a scene into a folder: from above as SVG, and as PNG if there is a GL library and a cell can be simulated.

    ServiceError if the folder cannot be written to.
    """
    stem = Path(_title(scene)).stem
    svg, png = folder / f"{stem}.svg", folder / f"{stem}.png"
    with writing_to(folder):
        folder.mkdir(parents=True, exist_ok=True)
        svg.write_text(draw_from_above(scene), encoding="utf-8")
        try:
            _render(scene, png)
        except (RenderingError, SheetError, FrameError) as error:
            png.unlink(missing_ok=True)
            return DrawnScene((svg,), str(error))
    return DrawnScene((svg, png), None)


def draw_from_above(scene: OpenScene) -> str:
    """Return the view of a scene from above, an SVG document."""
    return draw_top_view(_outlines(scene), _title(scene))


def _title(scene: OpenScene) -> str:
    return scene.path.name if scene.path else scene.document.path


def _placed(state: WorldState, thing: str) -> PlacedThing:
    short = state.vocabulary.short
    support, base = min(state.objects(thing, ON), default=None), state.value(thing, BASE_FRAME_ID)
    stated = f"in {base}" if base is not None else f"on {short(support)}" if support else "with its carrier"
    classes = tuple(map(short, sorted(state.types(thing))))
    try:
        at = pose(state, thing)
    except FrameError as error:
        return PlacedThing(short(thing), classes, stated, (), (), _size(state, thing), str(error))
    angles = tuple(round(degrees(each), 3) + 0.0 for each in angles_from_rotation(at.rotation))
    position = tuple(round(each, 6) + 0.0 for each in at.position.tolist())
    return PlacedThing(short(thing), classes, stated, position, angles, _size(state, thing))


def _size(state: WorldState, thing: str) -> tuple[float, ...]:
    numbers = [value for name in SIZE if isinstance(value := state.value(thing, name), int | float)]
    return tuple(map(float, numbers)) if len(numbers) == len(SIZE) else ()


def _outlines(scene: OpenScene) -> list[Outline]:
    """Return what is drawn from above: all things with a known pose, but no poses on things and no workspaces."""
    state, found = scene.state, list[Outline]()
    for each in sorted(scene.individuals):
        if any(state.is_a(each, cls) for cls in (TRANSFORMATION_POSE, WORKSPACE)):
            continue
        if not states_own_pose(state, each) and not _size(state, each):
            continue
        with suppress(FrameError):
            box = bounding_box(state, each)
            polygon = convex_hull(outline_points(state, each, pose(state, each))[:, :2])
            found.append(Outline(state.vocabulary.short(each), polygon, _colour(state, each), box.corners[:, 2].max()))
    return found


def _colour(state: WorldState, thing: str) -> str:
    with suppress(SheetError, FrameError):
        body = read_body(state, thing)
        if body is not None:
            return "#" + "".join(f"{round(255 * part):02x}" for part in body.colour[:3])
    return "#9fb4c7"


def _render(scene: OpenScene, png: Path) -> None:
    """Render the scene as it is believed to be, from a corner above it."""
    state = scene.state
    cell = make_backend(DRAWN_BY, WorldModel(state), 0)
    drawing = cell.capabilities.drawing
    assert drawing is not None, "a simulation can be drawn"
    surfaces = (each for each in sorted(state.instances(SURFACE)) if _size(state, each))
    props = tuple(prop for each in surfaces for prop in make_props(pose(state, each), size(state, each)))
    model = workshop_model(drawing)
    renderer = Renderer(model, WIDTH, HEIGHT, props)
    try:
        write_picture(png, renderer.picture(posed(model, drawing.posture()), _camera(scene)))
    finally:
        renderer.close()
        cell.close()


def _camera(scene: OpenScene) -> CameraView:
    points = [np.zeros((1, 3))]
    for each in sorted(scene.individuals):
        with suppress(FrameError):
            points.append(outline_points(scene.state, each, pose(scene.state, each)))
    every = np.vstack(points[1:] or points)
    low, high = every.min(axis=0), every.max(axis=0)
    return CameraView((low + high) / 2, float(AWAY * np.linalg.norm(high - low) + 0.5), AZIMUTH_DEG, ELEVATION_DEG)
