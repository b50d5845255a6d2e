"""Holes and patches of a scene that do not lie on their surface, or not along it, are told; those that do are not."""

from __future__ import annotations

import pytest

from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import SHIPPED, find_library
from skillc_ontology import catalogue
from skillc_runtime.scene.documents import Document
from skillc_runtime.scene.load import read_with_sheets

VOCABULARY = compile_valid(find_library(SHIPPED / "wiping")).vocabulary
SCENE = catalogue.scene_path("iiwa_outlet").read_text(encoding="utf-8")
STRAIGHT = "PositionX 0.02"
PATCH = "skillc:hasPatch lab:Outlet-1 ; skillc:hasHole lab:Label-1"


def with_outlet(old: str, new: str, relation: str = "skillc:hasHole lab:Outlet-1, lab:Label-1") -> list[str]:
    """Return what is wrong where the outlet, 5 cm by 6 cm on a table of 30 cm by 40 cm, is written in another way."""
    before, outlet = SCENE.split("lab:Outlet-1 a skillc:Area", 1)
    assert old in outlet and "skillc:hasHole lab:Outlet-1, lab:Label-1" in before
    before = before.replace("skillc:hasHole lab:Outlet-1, lab:Label-1", relation)
    text = f"{before}lab:Outlet-1 a skillc:Area{outlet.replace(old, new, 1)}"
    return [
        f"{each.name}: {each.message} ({each.help})"
        for each in read_with_sheets(Document("s.ttl", text), VOCABULARY).problems
    ]


def turned(w: float, x: float, y: float, z: float) -> str:
    rest = f"skiros:OrientationX {x} ; skiros:OrientationY {y} ; skiros:OrientationZ {z}"
    return f"{STRAIGHT} ; skiros:OrientationW {w} ; {rest}"


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (
            "PositionX 0.02",
            "PositionX 0.2",
            "area-beside-surface: lab:Outlet-1 lies beside lab:Table-1: 0.2 m along its x",
        ),
        ("PositionY -0.03", "PositionY -3", "reaches 0.15 m along x and 0.2 m along y"),
        (STRAIGHT, turned(0.9239, 0, 0, 0.3827), "turned-area: lab:Outlet-1 is turned by 45 degrees on lab:Table-1"),
        (STRAIGHT, turned(0.9659, 0, 0, 0.2588), "the rectangle around it, 0.0733 m by 0.077 m"),
        (
            STRAIGHT,
            turned(0.7071, 0.7071, 0, 0),
            "turned-area: lab:Outlet-1 is tilted by 90 degrees out of lab:Table-1",
        ),
        (STRAIGHT, turned(0, 1, 0, 0), "tilted by 180 degrees"),
    ],
)
def test_a_hole_that_does_not_lie_along_its_surface_is_told(old: str, new: str, words: str) -> None:
    (told,) = with_outlet(old, new)
    assert words in told


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("PositionX 0.02", "PositionX 0.16"),
        (STRAIGHT, turned(0.7071, 0, 0, 0.7071)),
        (STRAIGHT, turned(0, 0, 0, 1)),
        (STRAIGHT, turned(0.99998, 0, 0, 0.006)),
    ],
    ids=["over the edge", "a quarter", "half", "rounded"],
)
def test_a_hole_that_lies_along_its_surface_is_accepted(old: str, new: str) -> None:
    assert with_outlet(old, new) == []


def test_a_patch_may_be_turned_and_must_lie_on_its_surface() -> None:
    assert with_outlet(STRAIGHT, turned(0.9239, 0, 0, 0.3827), PATCH) == []
    (told,) = with_outlet("PositionX 0.02", "PositionX 0.2", PATCH)
    assert told.startswith("area-beside-surface")


def test_the_size_of_a_rim_has_bounds() -> None:
    (told,) = with_outlet("SizeZ 0.015", "SizeZ 0.015 ; skillc:margin 3")
    assert "it is at least 0 and at most 0.5" in told


def test_it_is_told_where_the_area_says_so() -> None:
    text = SCENE.replace("PositionX -0.12", "PositionX 12", 1)
    assert text != SCENE
    (told,) = read_with_sheets(Document("s.ttl", text), VOCABULARY).problems
    assert text.splitlines()[told.span.line - 1].lstrip().startswith("skiros:PositionX 12")
