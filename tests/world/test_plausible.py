"""Scenes that obey the axioms and are no place: each mistake with its line, and what is allowed beside it."""

from __future__ import annotations

from pathlib import Path

import pytest

from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import SHIPPED, find_library
from skillc_dsl.diagnostics import Diagnostic
from skillc_ontology import catalogue
from skillc_runtime.scene.documents import SceneError
from skillc_runtime.scene.load import load_scene

SHIPPED = compile_valid(find_library(SHIPPED / "wiping")).vocabulary
SCENE = catalogue.scene_path("iiwa_table").read_text(encoding="utf-8")


def problems(tmp_path: Path, text: str) -> tuple[Diagnostic, ...]:
    path = tmp_path / "scene.ttl"
    path.write_text(text, encoding="utf-8")
    try:
        load_scene(path, SHIPPED)
    except SceneError as error:
        return error.problems
    return ()


HAND = "skillc:hasGripper lab:Robotiq-1"


def turned(w: float) -> str:
    """Return a quaternion of which only the first part is not 0, as it is written before another fact."""
    return f"skiros:OrientationW {w!r} ; skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ; "


MISTAKES = [
    (
        '"pedestal" ; skiros:BaseFrameId "cell"',
        '"pedestal" ; skiros:BaseFrameId "cel"',
        "unknown-frame",
        "`cel`",
        "`cell`",
    ),
    ('"pedestal" ; skiros:BaseFrameId "cell"', '"pedestal" ; skiros:BaseFrameId "q"', "unknown-frame", "`q`", "map, "),
    ('skiros:FrameId "robotiq"', 'skiros:FrameId "cell"', "unknown-frame", "have this FrameId", "its own"),
    (
        '"cell" ; skiros:BaseFrameId "map"',
        '"cell" ; skiros:BaseFrameId "cell"',
        "frame-circle",
        "in its own frame",
        "`map`",
    ),
    (
        '"cell" ; skiros:BaseFrameId "map"',
        '"cell" ; skiros:BaseFrameId "pedestal"',
        "frame-circle",
        "lab:Cell and lab:Ped",
        "`map`",
    ),
    (
        '"cell" ; skiros:BaseFrameId "map"',
        '"cell" ; skiros:BaseFrameId "robot"',
        "frame-circle",
        "lab:Cell and lab:Rob",
        "`map`",
    ),
    (
        '"cell" ; skiros:BaseFrameId "map"',
        '"cell" ; skiros:BaseFrameId "robotiq"',
        "frame-circle",
        "lab:Cell and lab:Robotiq-1 and lab:Iiwa-1 and lab:Robot-1",
        "`map`",
    ),
    (HAND, turned(0.0) + HAND, "no-rotation", "(0, 0, 0, 0) of lab:Iiwa-1", "1.0"),
    (HAND, turned(0.7) + HAND, "no-rotation", "the length of the quaternion is 0.7 and not 1", "1.0"),
    (HAND, turned(1e200) + HAND, "no-rotation", "lab:Iiwa-1", "1.0"),
    ("SizeX 0.30", "SizeX -0.30", "wrong-data-type", "lab:Pedestal.skiros:SizeX = -0.3`: it is above 0", ""),
    ("offsetRange 0.02", "offsetRange -0.02", "wrong-data-type", "offsetRange = -0.02`: it is at least 0", ""),
    ("offsetRange 0.02", "offsetRange 3", "wrong-data-type", "it is at least 0 and at most 0.5", ""),
    ("tiltRange 0.087", "tiltRange 2", "wrong-data-type", "it is at least 0 and at most 0.8", ""),
    ("cleanThreshold 1.0", "cleanThreshold 99", "wrong-data-type", "it is at least 0 and at most 1", ""),
    ("stiffnessRange 0.3", "stiffnessRange 1", "wrong-data-type", "it is at least 0 and below 1", ""),
    (
        "skillc:hasSheet skillc:iiwa14-sheet ;",
        "",
        "missing-property",
        "lab:Iiwa-1 has no skillc:hasSheet",
        "skillc:hasSheet",
    ),
    ("PositionZ 0.715", 'PositionZ "NaN"^^<http://www.w3.org/2001/XMLSchema#double>', "wrong-data-type", "NaN", ""),
]


@pytest.mark.slow
@pytest.mark.parametrize(("old", "new", "name", "words", "cure"), MISTAKES)
def test_a_mistake_is_reported_at_its_line(
    tmp_path: Path, old: str, new: str, name: str, words: str, cure: str
) -> None:
    assert old in SCENE
    found = problems(tmp_path, SCENE.replace(old, new, 1))
    first = found[0]
    assert (first.name, first.span.path) == (name, str(tmp_path / "scene.ttl"))
    assert words in first.message and cure in first.help
    assert {each.name for each in found} == {name}


def test_the_place_is_that_of_the_statement(tmp_path: Path) -> None:
    line = SCENE[: SCENE.index("SizeZ 0.05")].count("\n") + 1
    (found,) = problems(tmp_path, SCENE.replace("SizeZ 0.05", "SizeZ -1"))
    assert found.span.line == line


@pytest.mark.parametrize(
    ("old", "new"),
    [(HAND, turned(0.995) + HAND), ("SizeX 0.30", "SizeX 1e-3"), ("PositionX 0.4", "PositionX -0.4")],
)
def test_what_is_merely_unusual_is_accepted(tmp_path: Path, old: str, new: str) -> None:
    assert old in SCENE
    assert problems(tmp_path, SCENE.replace(old, new, 1)) == ()


@pytest.mark.parametrize("text", ["", "# nothing yet\n", "@prefix lab: <http://example.org/lab#> .\n"])
def test_an_empty_scene_is_told(tmp_path: Path, text: str) -> None:
    (found,) = problems(tmp_path, text)
    assert (found.name, found.message) == ("empty-scene", "there is nothing in this scene")


@pytest.mark.parametrize("scene", catalogue.scene_names())
def test_the_shipped_scenes_are_plausible(scene: str) -> None:
    assert load_scene(catalogue.scene_path(scene), SHIPPED).individuals
