"""Pictures name things, and show where they are believed to be if they really are elsewhere."""

from __future__ import annotations

import numpy as np
import pytest

from backends.kinematic_runs import library
from skillc.services.library.files import SHIPPED
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.film.annotations import SceneAnnotator
from skillc_runtime.film.camera import CameraView
from skillc_runtime.film.filmed_cell import find_filmed
from skillc_runtime.film.props import Prop
from skillc_runtime.film.rendering import Renderer, RenderingError, check_rendering
from skillc_runtime.motion.pose import Pose
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import BASE_FRAME_ID

PART_B = "http://example.org/lab#Part-B"


def cell() -> KinematicCell:
    return KinematicCell(WorldModel(load_scene(SHIPPED / "sorting" / "panda.ttl", library("sorting").vocabulary)))


def annotate(sorting: KinematicCell) -> SceneAnnotator:
    filmed = find_filmed(sorting)
    assert filmed is not None
    return SceneAnnotator(filmed)


def push(sorting: KinematicCell, away_m: float) -> None:
    sorting.data.qpos[int(sorting.model.joint("lab:Part-B/free").qposadr[0])] += away_m
    sorting.advance(0.01)


def test_parts_and_boxes_are_named_and_furniture_is_not() -> None:
    tags = {each.text: each.point for each in annotate(cell()).sample().tags}
    assert tags.keys() == {"Part A", "Part B", "Box A", "Box B"}
    assert tags["Part B"] == pytest.approx((0.5, -0.2, 0.682), abs=1e-3)


def test_there_is_a_ghost_of_a_part_that_is_elsewhere_and_of_no_other() -> None:
    sorting = cell()
    annotator = annotate(sorting)
    push(sorting, 0.004)
    assert annotator.sample().ghosts == ()
    push(sorting, 0.03)
    (ghost,) = annotator.sample().ghosts
    assert (ghost.kind, ghost.rgba[3] < 1.0) == ("cylinder", True)
    assert ghost.pose.position == pytest.approx((0.5, -0.2, 0.635), abs=1e-6)
    assert ghost.size == pytest.approx((0.035, 0.035, 0.07))


def test_a_part_whose_place_is_not_known_has_no_ghost() -> None:
    sorting = cell()
    annotator = annotate(sorting)
    sorting.world.commit([SetProperty(PART_B, BASE_FRAME_ID, "nowhere")], "test", "assumed")
    assert annotator.sample().ghosts == ()


def test_a_ghost_and_a_name_change_the_picture() -> None:
    try:
        check_rendering()
    except RenderingError as error:
        pytest.skip(str(error))
    sorting = cell()
    annotator = annotate(sorting)
    push(sorting, 0.05)
    renderer = Renderer(sorting.model, 160, 120)
    view = CameraView(np.array([0.5, -0.2, 0.63]), 0.5, 50.0, -30.0)
    plain, shown = renderer.picture(sorting.data, view), renderer.picture(sorting.data, view, annotator.sample())
    renderer.close()
    assert np.any(plain != shown)


def test_every_kind_of_solid_is_drawn() -> None:
    try:
        check_rendering()
    except RenderingError as error:
        pytest.skip(str(error))
    sorting = cell()
    view = CameraView(np.array([0.0, 0.0, 2.0]), 1.0, 50.0, -30.0)
    pictures = []
    for kind in (None, "box", "cylinder", "sphere", "capsule", "hull"):
        props = () if kind is None else (Prop(Pose.of((0.0, 0.0, 2.0)), np.array([0.1, 0.1, 0.3]), (1, 0, 0, 1), kind),)
        renderer = Renderer(sorting.model, 80, 60, props)
        pictures.append(renderer.picture(sorting.data, view))
        renderer.close()
    assert all(np.any(each != pictures[0]) for each in pictures[1:])
