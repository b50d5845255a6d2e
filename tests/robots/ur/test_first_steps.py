"""The first steps with an emulated controller: connect, look, run dry; it gets no program and no command."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from robots.ur.emulator.grippers import WSG_PORT
from robots.ur.peer import Peer, running_peer
from skillc.cli.main import skillc
from skillc_ontology.catalogue import ROOT
from skillc_runtime.world.state.terms import UR

pytest.importorskip("rtde_control", reason="ur-rtde is not installed: pip install 'skillc[ur]'")
pytestmark = [pytest.mark.robot, pytest.mark.slow]
BUTTON = ROOT / "scenes/ur5e_button.ttl"


@pytest.fixture(scope="module")
def peer() -> Iterator[Peer]:
    with running_peer("--patience", "0.2", "--library", "contact", scene=BUTTON) as running:
        yield running


@pytest.fixture
def scene(peer: Peer, tmp_path: Path) -> Path:
    """The scene with the addresses of the peer."""
    facts = (
        f'lab:Ur5e-1 skiros:DriverAddress "{peer.host}" ; skillc:stateTimeout 5.0 ; <{UR}commandTimeout> 1.0 .\n'
        f'lab:Wsg-1 skiros:DriverAddress "{peer.host}:{WSG_PORT}" .\n'
    )
    path = tmp_path / "cell.ttl"
    path.write_text(f"{BUTTON.read_text('utf-8')}\n{facts}", "utf-8")
    return path


def type_in(*arguments: str) -> Result:
    return CliRunner().invoke(skillc, arguments, catch_exceptions=False)


def test_it_is_looked_at_and_run_dry_and_gets_no_program(peer: Peer, scene: Path) -> None:
    before = peer.tell()
    result = type_in("connect", str(scene), "--backend", "ur", "--json")
    seen: dict[str, Any] = json.loads(result.stdout)
    (arm,) = seen["cell"]["arms"]
    assert (result.exit_code, arm["condition"], seen["problems"]) == (0, "ready", [])
    given = ("--scene", str(scene), "--library", "contact", "--goal", "lab:Button-1.isOn == true", "--json")
    dry = type_in("run", *given, "--dry", "--backend", "ur")
    told = json.loads(dry.stdout)
    assert (dry.exit_code, told["status"], told["dry"]) == (0, "succeeded", True), told["failure"]
    assert told["commands"][0]["kind"] == "position" and told["commands"][0]["count"] > 1000
    after = peer.tell()
    assert (after["runtime"], after["commands"]) == ("STOPPED", before["commands"])
    assert after["q"] == pytest.approx(before["q"], abs=1e-3)
