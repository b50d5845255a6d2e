"""A world without bodies at the level of a user: check, plan, run, why, replay and report ask nothing spatial."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

import skillc as skillc_api
from skillc.cli.main import skillc
from symbolic.ward import write_ward

MANIFEST = 'name = "ward"\n\n[tool.run]\nbackend = "symbolic"\n'
EDITION_2 = 'name = "ward"\nedition = 2\n'


@pytest.fixture
def ward(tmp_path: Path, own_cache: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = write_ward(tmp_path)
    monkeypatch.chdir(folder)
    return folder


def call(*arguments: str) -> Result:
    result = CliRunner().invoke(skillc, arguments)
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def problems(*arguments: str) -> list[str]:
    return sorted({each["name"] for each in json.loads(call("check", "--json", *arguments).stdout)})


def test_check_asks_for_bodies_unless_there_are_none(ward: Path) -> None:
    of_bodies = problems()
    spatial = {"missing-property", "no-place", "no-implementation"}
    assert spatial <= set(of_bodies)
    assert not {*spatial, "infeasible-step", "unchecked-space"} & set(problems("--backend", "symbolic"))
    assert problems() == of_bodies, "what was cached for one back end is not told of another"
    (ward / "skillc.toml").write_text(MANIFEST, encoding="utf-8")
    assert problems() == problems("--backend", "symbolic") != of_bodies


def test_a_task_chooses_its_back_end_before_its_project_does(ward: Path) -> None:
    (ward / "skillc.toml").write_text(EDITION_2, encoding="utf-8")
    tasks, of_bodies = ward / "tasks.skill", problems()
    tasks.write_text(tasks.read_text().replace('"ward.ttl"\n', '"ward.ttl"\n    backend symbolic\n'), encoding="utf-8")
    assert problems() == problems("--backend", "symbolic") != of_bodies
    assert problems("--backend", "kinematic") == of_bodies
    (ward / "skillc.toml").write_text(f'{EDITION_2}[tool.run]\nbackend = "kinematic"\n', encoding="utf-8")
    assert problems() == problems("--backend", "symbolic")
    assert "3 steps, 50 s expected" in call("plan", "deliver").stdout
    assert call("run", "deliver", "--tick-timeout", "0").exit_code == 0
    assert call("run", "deliver", "--backend", "kinematic").exit_code == 1, "its cart has no body"
    assert skillc_api.run("deliver").status == "succeeded"
    tasks.write_text(tasks.read_text().replace("symbolic", "symbolc"), encoding="utf-8")
    assert "unknown-backend" in problems()
    assert "there is no backend `symbolc`" in call("run", "deliver").stderr


def test_a_task_is_done_within_its_time_or_fails(ward: Path) -> None:
    tasks, manifest = ward / "tasks.skill", f'{EDITION_2}[tool.run]\nbackend = "symbolic"\ndeadline = 1.0\n'
    (ward / "skillc.toml").write_text(manifest, encoding="utf-8")
    within = '"ward.ttl"\n    within 40 s\n'
    carry = "do Carry(cart: lab:Cart-1, tray: lab:Tray-1, to: lab:Kitchen)"
    slow = f'task carry {{\n    scene "ward.ttl"\n    within 15 s\n    {carry}\n}}\n'
    tasks.write_text(tasks.read_text().replace('"ward.ttl"\n', within) + slow, encoding="utf-8")
    found = "no plan was found: the task has to be done within 40 s, and the plan that was found takes 50 s"
    assert found in call("plan", "deliver").stdout
    proved = "there is no plan: the task has to be done within 40 s, and any plan takes 50 s or more"
    assert proved in call("plan", "deliver", "--minimise", "makespan").stdout
    run = ("run", "--tick-timeout", "0")
    assert found in call(*run, "deliver").stdout
    assert call(*run, "deliver", "--deadline", "60").exit_code == 0, "a deadline comes before it"
    late = call(*run, "carry")
    assert late.exit_code == 3 and "the task was not done within 15 s" in late.stdout
    tasks.write_text(tasks.read_text().replace("within 15 s", ""), encoding="utf-8")
    assert "the task exceeded its deadline of 1 s" in call(*run, "carry").stdout, "that of the project"


def test_a_task_says_what_its_plan_has_little_of(ward: Path) -> None:
    """Whoever plans or runs it comes first, then the task, then its project."""
    tasks, manifest = ward / "tasks.skill", f'{EDITION_2}[tool.run]\nbackend = "symbolic"\n'
    tool = '[tool.plan]\nminimise = "makespan"\n'
    (ward / "skillc.toml").write_text(manifest, encoding="utf-8")

    def planned(*options: str) -> str:
        return str(json.loads(call("plan", "deliver", "--json", *options).stdout)["minimise"])

    assert planned() == "work"
    (ward / "skillc.toml").write_text(manifest + tool, encoding="utf-8")
    assert planned() == "makespan"
    stated = tasks.read_text()
    tasks.write_text(stated.replace('"ward.ttl"\n', '"ward.ttl"\n    minimise work\n'), encoding="utf-8")
    assert planned() == "work"
    tasks.write_text(stated.replace('"ward.ttl"\n', '"ward.ttl"\n    minimise makespan\n'), encoding="utf-8")
    (ward / "skillc.toml").write_text(manifest, encoding="utf-8")
    assert planned() == "makespan" and planned("--minimise", "work") == "work"
    assert "over after 50 s with 50 s of work, proved optimal" in call("plan", "deliver").stdout
    assert "over after 50 s" in str(skillc_api.plan("deliver"))
    assert skillc_api.plan("deliver", minimise="work").to_dict()["minimise"] == "work"
    assert "requires to minimise work" in call("plan", "deliver", "--prove").stderr
    run = ("run", "deliver", "--tick-timeout", "0", "--out")
    assert call(*run, "stated").exit_code == call(*run, "other", "--minimise", "work").exit_code == 0
    events = ((ward / each / "events.jsonl").read_text() for each in ("stated", "other"))
    started = [next(json.loads(line) for line in each.splitlines() if "task-started" in line) for each in events]
    assert [each["event"]["minimise"] for each in started] == ["makespan", "work"]


def test_a_scene_of_tasks_with_bodies_is_asked_for_them(ward: Path) -> None:
    (ward / "skillc.toml").write_text(EDITION_2, encoding="utf-8")
    tasks = ward / "tasks.skill"
    bodiless = tasks.read_text()[tasks.read_text().index("task") :].replace("deliver", "look")
    bodiless = bodiless.replace('"ward.ttl"\n', '"ward.ttl"\n    backend symbolic\n')
    before = problems()
    tasks.write_text(f"{tasks.read_text()}\n{bodiless}", encoding="utf-8")
    assert problems() == before


def test_check_goes_on_asking_for_facts(ward: Path) -> None:
    scene = ward / "ward.ttl"
    scene.write_text(scene.read_text().replace("skiros:at lab:Ward-1 ;", ""), encoding="utf-8")
    assert "unreachable-goal" in problems("--backend", "symbolic")


def test_a_project_without_bodies_is_planned_run_explained_and_repeated(ward: Path) -> None:
    (ward / "skillc.toml").write_text(MANIFEST, encoding="utf-8")
    planned = call("plan", "deliver")
    assert planned.exit_code == 0 and "3 steps, 50 s expected" in planned.stdout
    ran = call("run", "deliver", "--out", "out", "--tick-timeout", "0")
    assert ran.exit_code == 0, ran.output
    result = json.loads(Path("out/result.json").read_text())
    assert result["status"] == "succeeded" and result["verified"] is False
    assert {each["known"] for each in result["facts"]} == {"assumed"}
    assert "Carry" in call("why", "out").stdout and "20.0 - 30.0 s" in call("why", "out").stdout
    assert "the same but for wall times" in call("replay", "--check", "out").stdout
    assert call("report", "out").exit_code == 0


def test_where_bodies_are_needed_that_is_said(ward: Path) -> None:
    assert call("run", "tasks.skill:deliver", "--backend", "mujoco").exit_code == 1
    refused = call("run", "tasks.skill:deliver", "--backend", "symbolic", "--reality", "wide")
    assert refused.exit_code == 2 and "no arm or tool of the scene has imperfections" in refused.output
    connected = call("connect", "iiwa_table.ttl", "--backend", "symbolic")
    assert connected.exit_code != 0 and "it has no devices to look at" in connected.output
