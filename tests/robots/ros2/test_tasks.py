"""The shipped wiping skill, as it is, through ROS 2: only the facts of the cell are others."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from robots import bodies
from robots.bodies import shipped_task
from robots.ros2 import scenes
from robots.ros2.running import LOOPBACK, robot
from robots.ros2.test_link import IN_ROS

pytestmark = pytest.mark.sim


def run(goal: str, scene: Path, folder: Path) -> tuple[int, dict[str, Any]]:
    """Run a goal; return the exit code and the result."""
    command = [sys.executable, "-m", "skillc", "run", "--goal", goal, "--library", "wiping", "--scene", str(scene)]
    options = ["--backend", "ros2", "--out", str(folder / "out"), "--no-film"]
    done = subprocess.run([*command, *options], cwd=folder, env={**os.environ, **LOOPBACK}, check=False, timeout=400)
    return done.returncode, json.loads((folder / "out" / "result.json").read_text("utf-8"))


@pytest.mark.long
def test_a_ur5e_drives_and_picks(tmp_path: Path) -> None:
    scene = scenes.whiteboard(tmp_path)
    with robot(scene, tmp_path, rate_hz=125, joint_names=IN_ROS) as there:
        code, result = run("lab:Wsg-1 contain lab:Eraser-1", scene, tmp_path)
        report = there.end()
    assert (code, result["status"]) == (0, "succeeded"), result.get("failure")
    assert report["holds"]["lab:Wsg-1"] == "lab:Eraser-1"
    assert (report["beyond_limits"], report["examples"]) == (0, [])


WAYS: Mapping[str, tuple[Callable[[Path], Path], Mapping[str, Any]]] = {
    "torques": (lambda folder: scenes.table(folder, 500.0), {"control": "effort", "rate_hz": 500}),
    "a law on the robot's side": (scenes.cartesian_table, {"control": "cartesian", "rate_hz": 250}),
}
"""Scenes of the iiwa at the table, and the options of the robots that are driven there."""


@pytest.mark.long
@pytest.mark.parametrize("way", sorted(WAYS))
def test_an_iiwa_wipes_a_table(way: str, tmp_path: Path) -> None:
    from robots.ros2.body import Ros2Body

    write, options = WAYS[way]
    figures = bodies.run(
        Ros2Body(options), replace(shipped_task("wiping", "clean_table"), scene=write(tmp_path)), tmp_path
    )
    print(figures)
    assert (figures.outcome, figures.violations) == ("succeeded", 0)
    assert figures.coverage == pytest.approx(1.0, abs=0.01)
    assert figures.rmse is not None
    assert figures.rmse < 0.25
