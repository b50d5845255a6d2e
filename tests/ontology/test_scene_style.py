"""Shipped scenes are written as a person would write them: turns are angles in degrees."""

from __future__ import annotations

from pathlib import Path

import pytest

from skillc_ontology import catalogue

SCENES = [catalogue.scene_path(name) for name in catalogue.scene_names()]


@pytest.mark.parametrize("scene", SCENES, ids=lambda path: path.stem)
def test_turns_are_angles_in_degrees(scene: Path) -> None:
    text = scene.read_text("utf-8")
    assert "skiros:PositionX" in text or "skillc:on" in text
    assert "Orientation" not in text
