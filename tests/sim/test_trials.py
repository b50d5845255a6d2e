"""Trials in simulation: every arm meets the targets, recovers from a push, and gives up safely without a surface."""

from __future__ import annotations

import json
import os
from typing import Any

import pytest
from click.testing import CliRunner

from skillc.cli.main import skillc

pytestmark = pytest.mark.sim

COUNT = int(os.environ.get("SKILLC_TRIALS", "1"))
"""How many seeds of each task."""


def tried(task: str, seed: int, disturbance: str) -> dict[str, Any]:
    words = f"trials {task} -n {COUNT} --seed {seed} --disturb {disturbance} --json"
    told: dict[str, Any] = json.loads(CliRunner().invoke(skillc, words.split()).stdout)
    assert told["done"] == COUNT
    return told


@pytest.mark.parametrize("task", ["clean_whiteboard", "clean_table", "clean_desk"])
def test_the_targets_are_met(task: str) -> None:
    assert tried(task, 8000, "none")["failed"] == []


def test_a_push_of_a_person_leaves_nothing_unwiped() -> None:
    assert tried("clean_table", 7001, "push")["failed"] == []


def test_a_missing_surface_is_said_and_everything_rests() -> None:
    told = tried("clean_table", 7001, "missing")
    assert told["failed"] == []
    assert all("nothing to push against" in trial["reason"] and trial["at_rest"] for trial in told["trials"])
