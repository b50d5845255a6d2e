"""The shipped wiping skill, as it is, through ROS 2: only the facts of the cell are others."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from robots.ros2 import scenes
from robots.ros2.running import LOOPBACK, robot
from robots.ros2.test_link import IN_ROS

pytestmark = [pytest.mark.sim, pytest.mark.long]


def run(goal: str, scene: Path, folder: Path) -> tuple[int, dict[str, Any]]:
    """Run a goal; return the exit code and the result."""
    command = [sys.executable, "-m", "skillc", "run", "--goal", goal, "--library", "wiping", "--scene", str(scene)]
    options = ["--backend", "ros2", "--out", str(folder / "out"), "--no-film"]
    done = subprocess.run([*command, *options], cwd=folder, env={**os.environ, **LOOPBACK}, check=False, timeout=400)
    return done.returncode, json.loads((folder / "out" / "result.json").read_text("utf-8"))


def test_a_ur5e_drives_and_picks(tmp_path: Path) -> None:
    scene = scenes.whiteboard(tmp_path)
    with robot(scene, tmp_path, rate_hz=125, joint_names=IN_ROS) as there:
        code, result = run("lab:Wsg-1 contain lab:Eraser-1", scene, tmp_path)
        report = there.end()
    assert (code, result["status"]) == (0, "succeeded"), result.get("failure")
    assert report["holds"]["lab:Wsg-1"] == "lab:Eraser-1"
    assert (report["beyond_limits"], report["examples"]) == (0, [])
