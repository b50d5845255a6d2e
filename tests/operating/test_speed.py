"""A run with a share of the speeds takes longer, and names that share where a failure may come from it."""

from __future__ import annotations

import json
from typing import Any

import pytest
from click.testing import CliRunner

from skillc.cli.main import skillc


def run(*options: str) -> dict[str, Any]:
    given = ("run", "contact:press_button", "--backend", "kinematic", "--json", *options)
    result = CliRunner().invoke(skillc, given, catch_exceptions=False)
    told: dict[str, Any] = json.loads(result.stdout)
    return told


@pytest.mark.slow
def test_a_slower_run_takes_longer_and_presses_as_hard() -> None:
    usual, slower = run(), run("--speed", "25 %")
    assert (usual["status"], slower["status"], slower["speed"]) == ("succeeded", "succeeded", 0.25)
    assert slower["sim_time_s"] > 2.0 * usual["sim_time_s"]
    forces = [each["works"][0]["force_greatest_n"] for each in (usual, slower)]
    assert forces[1] == pytest.approx(forces[0], rel=0.2)


@pytest.mark.slow
def test_what_fails_for_want_of_time_says_that_the_run_was_slow() -> None:
    late = run("--speed", "10%", "--step-deadline", "2")
    assert late["status"] == "failed"
    assert "the deadline of each step; the run has 10 % of the speeds, which may be why" in late["failure"]


@pytest.mark.parametrize("share", ["0", "150%", "fast", "10%%", "-1"])
def test_a_speed_is_a_share_of_all(share: str) -> None:
    result = CliRunner().invoke(skillc, ["run", "contact:press_button", "--speed", share])
    assert result.exit_code == 2
    assert f"`{share}` is not a share above 0% and at most 100%; write it as 10% or 0.1" in " ".join(
        result.stderr.split()
    )


def test_nobody_could_confirm_steps_without_a_terminal() -> None:
    result = CliRunner().invoke(skillc, ["run", "contact:press_button", "--confirm-steps"])
    assert result.exit_code == 2
    assert "--confirm-steps requires a terminal that shows the run and takes keys" in " ".join(result.stderr.split())
