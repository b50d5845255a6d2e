"""A scene that is told to move its arm by speed wipes as well as it does by position."""

from __future__ import annotations

import json
import os
import shutil
from pathlib import Path

import pytest
from click.testing import CliRunner

from skillc.cli.main import skillc
from skillc_ontology import catalogue

pytestmark = pytest.mark.sim

COUNT = int(os.environ.get("SKILLC_TRIALS", "1"))
"""How many seeds."""

TASK = """\
use wiping
import "wiping/tasks.skill"
prefix lab: <http://example.org/lab#>

task clean_by_speed {
    scene "cell.ttl"
    goal  lab:Whiteboard-1.isClean == true
}
"""
BY_SPEED = 'lab:Ur5e-1 skiros:CompliantController "forward_dynamics_velocity"'


def test_the_targets_are_met(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("tasks.skill").write_text(TASK)
    shutil.copy(catalogue.scene_path("ur5e_whiteboard"), "cell.ttl")
    told = CliRunner().invoke(skillc, ["scene", "edit", "cell.ttl", BY_SPEED])
    assert told.exit_code == 0, told.output
    assert '"forward_dynamics_velocity"' in Path("cell.ttl").read_text()
    words = f"trials tasks.skill:clean_by_speed -n {COUNT} --seed 8000 --jobs 1 --json"
    tried = json.loads(CliRunner().invoke(skillc, words.split()).stdout)
    assert tried["done"] == COUNT
    assert tried["failed"] == []
