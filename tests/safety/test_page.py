"""The workspace that the page on safety shows is one."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from simulation.cells import ARM, vocabulary
from skillc_ontology import catalogue
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel

PAGE = Path(__file__).parents[2] / "docs/safety.md"


def test_the_scene_of_the_page_limits_the_arm(tmp_path: Path) -> None:
    facts, _ = re.findall(r"^```turtle\n(.*?)^```$", PAGE.read_text("utf-8"), re.MULTILINE | re.DOTALL)
    scene = tmp_path / "scene.ttl"
    scene.write_text(catalogue.scene_path("iiwa_table").read_text("utf-8") + facts, "utf-8")
    there = SimulatedCell(WorldModel(load_scene(scene, vocabulary())))
    arm = there.arm(ARM["iiwa_table"])
    space = arm._safety.limits.workspace
    assert space is not None
    assert space.size == pytest.approx([1.2, 1.6, 1.0])
    assert space.outside(there.arms[ARM["iiwa_table"]].state().tool.position) == 0
    assert space.outside(np.array([0.0, 0.0, 5.0])) > 3.0
