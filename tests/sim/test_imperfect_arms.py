"""Tasks with imperfect arms: what the controllers make up for, and what a run says of it."""

import json
import os

import pytest
from click.testing import CliRunner

from skillc.cli.main import skillc

pytestmark = pytest.mark.sim

COUNT = int(os.environ.get("SKILLC_TRIALS", "1"))
"""How many seeds of each task."""


def try_task(task: str, reality: str) -> dict:
    """Return what the trials of a task say."""
    words = ["trials", task, "--reality", reality, "-n", str(COUNT), "--jobs", "1", "--json"]
    found = CliRunner().invoke(skillc, words)
    assert found.exit_code in (0, 3), found.output
    return json.loads(found.stdout)


@pytest.mark.parametrize("reality", ["wide:forceBias,torqueBias", "wide:jointFriction"])
def test_a_board_is_wiped_as_well_as_by_an_ideal_arm(reality: str) -> None:
    """The wrist is tared before it touches: 4 N along each axis are more than half of what it presses with."""
    assert try_task("clean_whiteboard", reality)["passed"] == COUNT


@pytest.mark.parametrize("task", ["clean_table", "clean_desk"])
def test_arms_that_take_torques_wipe_with_typical_imperfections(task: str) -> None:
    """Friction of several N m, 2 % of their weight and a delay of 6 ms; the mean force is off by less than 5 %."""
    for trial in try_task(task, "typical")["trials"]:
        assert trial["status"] == "succeeded", trial
        (work,) = (each["wiping"] for each in trial["works"])
        assert work["force_mean_n"] == pytest.approx(work["force_command_n"], rel=0.05)
        assert work["tilt_rms_deg"] < 3.0


def test_no_imperfection_costs_honesty() -> None:
    """With all of them together an arm may fail; it says so, and what is said to be clean is clean."""
    for trial in try_task("clean_whiteboard", "typical")["trials"]:
        assert trial["false_claims"] == [], trial
