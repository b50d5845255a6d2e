"""`skillc run` refuses a task whose things cannot be handled before anything moves, and warns of other things."""

from __future__ import annotations

import json
from pathlib import Path
from random import Random

import pytest
from click.testing import CliRunner, Result

from cell_checks.random_cells import SPOILED, random_cell
from skillc.cli.main import skillc
from skillc.services.cell_checks import checks

SKILLS = """
prefix lab: <http://example.org/lab#>
import "handling.skill"
import "motion.skill"

task handle {
    scene "cell.ttl"
    do Pick(arm: lab:Iiwa-1, object: lab:PART)
}

task stand {
    scene "cell.ttl"
    do TakePosture(arm: lab:Iiwa-1)
}
"""


def run(folder: Path, way: str, *arguments: str) -> tuple[Result, str]:
    """Run the command line in a folder with a spoilt cell; return the result, and the name of the spoilt part."""
    random = Random(1)
    cell, part = random_cell(random).spoilt(SPOILED[way], random)
    (folder / "cell.ttl").write_text(str(cell), "utf-8")
    (folder / "cell.skill").write_text(SKILLS.replace("PART", part), "utf-8")
    result = CliRunner().invoke(skillc, [each.replace("DIR", str(folder)) for each in arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result, part


@pytest.mark.parametrize(
    ("way", "says"),
    [
        ("no-body", "has no size, so it has no body"),
        ("impossible-body", "are its diameter, so they must be equal"),
        ("out-of-reach", "is out of reach of lab:Iiwa-1 by"),
    ],
)
def test_a_task_with_a_thing_that_cannot_be_handled_is_refused_with_its_line(
    way: str, says: str, tmp_path: Path
) -> None:
    result, part = run(tmp_path, way, "run", "DIR:handle", "--backend", "kinematic", "--json")
    answer = json.loads(result.stdout)
    assert (result.exit_code, answer["status"]) == (3, "refused")
    assert answer["failure"].startswith(f"{tmp_path / 'cell.ttl'}:")
    assert f"lab:{part}" in answer["failure"] and says in answer["failure"]


def test_what_was_found_is_kept_for_the_same_facts_and_no_others(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SKILLC_CACHE", str(tmp_path / "cache"))
    words = ("run", "DIR:handle", "--backend", "kinematic", "--json")
    refused = [json.loads(run(tmp_path, "no-body", *words)[0].stdout)["failure"]]
    looked: list[object] = []
    monkeypatch.setattr(checks, "check_cell", lambda *facts: looked.append(facts) or ())
    refused.append(json.loads(run(tmp_path, "no-body", *words)[0].stdout)["failure"])
    assert refused[0] == refused[1] and "has no size" in refused[0] and looked == []
    run(tmp_path, "out-of-reach", *words)
    assert len(looked) == 1


def test_a_task_that_does_not_use_it_runs_with_a_warning(tmp_path: Path) -> None:
    result, part = run(tmp_path, "no-body", "run", "DIR:stand", "--backend", "kinematic", "--json")
    assert json.loads(result.stdout)["status"] == "succeeded", result.stderr
    assert f"lab:{part}, a skiros:Product, has no size" in result.stderr


def test_a_device_that_the_cell_does_not_have_is_named(tmp_path: Path) -> None:
    spare = "lab:Spare a skillc:WsgGripper ; skillc:hasSheet skillc:wsg50-sheet .\n"
    (tmp_path / "cell.ttl").write_text(str(random_cell(Random(0))) + spare, "utf-8")
    arguments = ["--scene", str(tmp_path / "cell.ttl"), "--call", "ActuateGripper(gripper: lab:Spare, opening: 2 cm)"]
    result = CliRunner().invoke(skillc, ["run", *arguments, "--backend", "kinematic", "--json"])
    answer = json.loads(result.stdout)
    assert answer["status"] == "failed"
    assert "the cell has no gripper lab:Spare; it has lab:Wsg-1" in answer["failure"]
    assert "KeyError" not in answer["failure"]


def test_check_reports_an_error_if_a_task_uses_it(tmp_path: Path) -> None:
    result, _ = run(tmp_path, "no-body", "check", "DIR", "--json")
    found = [(each["name"], each["severity"]) for each in json.loads(result.stdout)]
    assert ("no-body", "error") in found
    assert len(found) > 1, "the task cannot start either, and says so of the same part"
    assert result.exit_code == 1
