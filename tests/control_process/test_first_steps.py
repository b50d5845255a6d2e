"""The first steps with a robot: it is looked at, a task is run dry, and nothing moves; then it moves slowly."""

from __future__ import annotations

import csv
import json
from collections.abc import Iterator
from importlib.metadata import EntryPoint, EntryPoints
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result

from control_process import toy_backend
from control_process.toy_link import Toy
from skillc.cli.main import skillc
from skillc.services.project import backends
from skillc_ontology import catalogue

pytestmark = pytest.mark.robot
SCENE = "ur5e_button"
PLACE = str(catalogue.scene_path(f"{SCENE}.ttl"))
ENTRY = EntryPoint("toy", "control_process.toy_backend:make_backend", backends.GROUP)


@pytest.fixture(scope="module")
def started() -> Iterator[Toy]:
    toy = Toy(SCENE)
    yield toy
    toy.close()


@pytest.fixture
def toy(started: Toy, monkeypatch: pytest.MonkeyPatch) -> Iterator[Toy]:
    """A toy robot that is known as the back end `toy`; at the end it has got no command."""
    installed = EntryPoints([*backends.find_installed(), ENTRY])
    monkeypatch.setattr(backends, "find_installed", lambda: installed)
    toy_backend.choose(started, monkeypatch)
    before = started.ask("report")
    yield started
    started.ask("condition", "ready")
    after = started.ask("report")
    assert (after["commands"], after["condition"]) == (before["commands"], "ready")
    assert np.allclose(after["q"], before["q"], atol=0.05)  # A wall has pushed it.


def type_in(*arguments: str) -> Result:
    return CliRunner().invoke(skillc, arguments, catch_exceptions=False)


def look() -> tuple[int, dict[str, Any]]:
    result = type_in("connect", PLACE, "--backend", "toy", "--json")
    return result.exit_code, json.loads(result.stdout)


def test_connecting_shows_what_is_measured_beside_the_scene(toy: Toy) -> None:
    code, seen = look()
    (arm,) = seen["cell"]["arms"]
    assert (code, seen["problems"], arm["condition"]) == (0, [], "ready")
    assert np.allclose([each["measured_rad"] for each in arm["joints"]], toy.ask("report")["q"], atol=1e-3)
    assert np.allclose([each["scene_rad"] for each in arm["joints"]], toy.ask("home"))
    assert np.linalg.norm(arm["force_n"]) < 4.0 and arm["period_s"] == 0.001
    assert seen["cell"]["grippers"][0]["opening_m"] == pytest.approx(toy.ask("fingers")[0], abs=1e-3)
    text = type_in("connect", PLACE, "--backend", "toy", "--once").stdout
    assert "ready  1000 Hz, " in text and "shoulder_pan" in text


def test_a_stop_and_a_force_that_nobody_expects_are_named(toy: Toy) -> None:
    toy.ask("put_wall", -0.02)
    toy.ask("condition", "emergency-stop")
    code, seen = look()
    toy.ask("remove_wall")
    (arm,) = seen["cell"]["arms"]
    assert (code, arm["condition"]) == (1, "emergency-stop")
    assert seen["problems"][0] == "lab:Ur5e-1: the emergency stop of the toy is pressed; release it"
    assert arm["felt"].startswith("the tool feels ")


def test_a_dry_run_sends_nothing_and_keeps_what_it_would_send(toy: Toy, tmp_path: Path) -> None:
    given = ("--dry", "--backend", "toy", "--out", str(tmp_path), "--no-film", "--json")
    result = type_in("run", "contact:press_button", *given)
    told = json.loads(result.stdout)
    assert (result.exit_code, told["status"], told["dry"], told.get("verified")) == (0, "succeeded", True, None)
    (sent,) = told["commands"]
    rows = list(csv.reader((tmp_path / "commands.csv").open(encoding="utf-8")))
    assert rows[0][:4] == ["arm", "kind", "unit", "time_s"] and len(rows) == sent["count"] + 1 > 1000
    first = np.array(rows[1][4:], dtype=float)
    assert np.allclose(first, toy.ask("report")["q"], atol=1e-2)
    assert 0.1 < sent["greatest_share"] < 1.0


def test_a_dry_run_does_not_begin_with_a_robot_that_cannot_be_run(toy: Toy) -> None:
    toy.ask("condition", "wrong-mode")
    result = type_in("run", "contact:press_button", "--dry", "--backend", "toy")
    assert result.exit_code == 3
    assert "dry" not in result.stdout.partition("\n")[0]
    assert "lab:Ur5e-1: the toy is in its manual mode; turn the key" in result.stdout


def test_a_camera_that_nothing_drives_is_told_before_a_skill_needs_it(toy: Toy, tmp_path: Path) -> None:
    scene = tmp_path / "cell.ttl"
    camera = 'lab:Camera-1 a skillc:Camera ; skillc:hasSheet skillc:depth-camera-sheet ; skiros:FrameId "camera" '
    placed = 'skiros:BaseFrameId "map" ; skiros:PositionX 0.0 ; skiros:PositionY 0.0 ; skiros:PositionZ 2.0'
    scene.write_text(f"{Path(PLACE).read_text('utf-8')}\n{camera} ; {placed} .\n", "utf-8")
    result = type_in("connect", str(scene), "--backend", "toy", "--once")
    assert result.exit_code == 1
    assert "nothing drives lab:Camera-1: this back end has no cameras; take it out of the scene" in result.stderr


@pytest.mark.parametrize("command", [("connect", PLACE), ("run", "contact:press_button", "--dry")])
def test_a_simulation_has_no_devices_to_connect_to(command: tuple[str, ...]) -> None:
    result = type_in(*command, "--backend", "mujoco")
    assert result.exit_code == 2
    assert "the backend mujoco simulates its devices: there is nothing to connect to" in result.stderr


def test_the_scene_of_a_project_has_the_terms_of_its_library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert type_in("new", "cell", "--template", "pick-place").exit_code == 0
    result = type_in("connect", "cell/cell.ttl", "--backend", "kinematic")
    assert "the backend kinematic simulates its devices" in result.stderr
    result = type_in("check", "--scene", "cell/cell.ttl", "--connect")
    assert "nothing declares terms" not in result.stderr
